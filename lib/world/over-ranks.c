/* Parts of all ranks joined in the order of the stream: every rank makes those of its blocks, rank 0 joins them in lots, rank after rank, and shares what they
 * give. Cost: that of the parts; messages: one for each lot of each rank, and one to all. SPDX-License-Identifier: GPL-3.0-or-later */
#include <string.h>

#include "world/over-ranks.h"

enum { LOT = 256 }; /* parts of a rank that are on rank 0 at a time; does not change the result */

/* The parts of the ranks from `first` of each on: of all ranks, or of one (only). */
static int join_lot(int status, const struct pm_parts *p, const char *parts, size_t count, size_t first, int only, void *all)
{
	const bool mine = only < 0 || only == pm_world_rank();
	const size_t left = mine && first < count ? count - first : 0, here = left < LOT ? left : LOT;
	void *lot = NULL;
	size_t bytes = 0;
	status = pm_world_gather(status, parts + (here ? first : 0) * p->size, here * p->size, &lot, &bytes);
	if (!status && lot)
		pm_join_parts(p, bytes / p->size, lot, all);
	pm_free(lot);
	return status;
}

/* The parts of this rank, `count` of them, to those of the others. */
static int join_all(int status, const struct pm_parts *p, const char *parts, size_t count, void *all)
{
	int64_t most = (int64_t)count;
	status = pm_world_count(status, PM_MOST_OF, 1, &most);
	if (!status && most <= LOT) {
		status = join_lot(status, p, parts, count, 0, -1, all);
	} else if (!status) {
		for (int rank = 0; rank < pm_world_size(); rank++)
			for (size_t first = 0; first < (size_t)most; first += LOT)
				status = join_lot(status, p, parts, count, first, rank, all);
	}
	return status;
}

int pm_world_over_set(int status, const struct pm_parts *p, const void *data, size_t here, void *all)
{
	if (pm_world_size() == 1) {
		if (!status)
			pm_over_set(p, data, here, all);
		return status;
	}
	const size_t count = (here + pm_sum_block - 1) / pm_sum_block;
	char *parts = status ? NULL : pm_alloc(count + 1, p->size);
	status = status ? status : parts ? 0 : pm_failed();
	if (!status)
		pm_parts_of_blocks(p, data, here, pm_sum_block, 0, count, parts);
	status = join_all(status, p, parts, count, all);
	pm_free(parts);
	return pm_world_share(status, 0, all, p->size);
}

int pm_world_over_mesh(int status, const struct pm_parts *p, const void *data, const size_t points[3], size_t here, void *all)
{
	double plane[PM_PART_MOST / sizeof(double)] = {0};
	if (pm_world_size() == 1) {
		if (!status)
			pm_over_mesh(p, data, points, all);
		return status;
	}
	char *parts = status ? NULL : pm_alloc(here + 1, p->size);
	status = status ? status : parts ? 0 : pm_failed();
	if (!status)
		pm_parts_of_mesh(p, data, points, 0, here, parts);
	if (p->none)
		memcpy(plane, p->none, p->size);
	status = join_all(status, p, parts, here, points[2] > 1 ? all : plane); /* in 2-D the rows are those of the only plane */
	if (points[2] <= 1 && !status && pm_world_rank() == 0)
		p->join(p->size, plane, all);
	pm_free(parts);
	return pm_world_share(status, 0, all, p->size);
}

struct values {
	const double *x, *y;
};

static void make(const void *data, size_t from, size_t to, void *part)
{
	const struct values *v = data;
	pm_sum_of_set(to - from, v->x + from, v->y ? v->y + from : NULL, part); /* one block */
}

int pm_world_sum_of_set(int status, size_t here, const double *x, const double *y, struct pm_sum *all)
{
	const struct pm_parts p = {.size = sizeof *all, .make = make, .join = pm_join_sums};
	return pm_world_over_set(status, &p, &(struct values){x, y}, here, all);
}
