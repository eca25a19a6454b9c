/* A stable order of a divided set. Each rank sorts what it has; the key at which each rank's new stretch begins is found exactly, bit by bit, by counting the
 * smaller keys of all ranks; particles with that very key go to the left in the order of the stream until the stretch before is full. What arrives comes in the
 * order of ranks, so that a stable sort of it is the order of all. Cost: two sorts of N/P keys; at most 64 counts of P - 1 numbers; of each particle that
 * changes its rank 8 bytes for its key and 8 for each component travel. SPDX-License-Identifier: GPL-3.0-or-later */
#include <stdlib.h>
#include <string.h>

#include "cell/radix-sort.h"
#include "cell/sort-ranks.h"
#include "world/world.h"

/* How many of the ascending keys are smaller than k; with k itself: or equal. */
static size_t below(size_t n, const uint64_t *key, uint64_t k, bool equal)
{
	size_t low = 0;
	while (n) {
		const size_t half = n / 2;
		if (key[low + half] < k || (equal && key[low + half] == k))
			low += half + 1, n -= half + 1;
		else
			n = half;
	}
	return low;
}

/* split[r]: the largest key with at most from[r] smaller ones among all. r = 1 .. ranks - 1. */
static int splits(int status, const uint64_t *from, size_t n, const uint64_t *sorted, uint64_t *split, int64_t *count)
{
	const int ranks = pm_world_size();
	int64_t most = (int64_t)((n && !status ? sorted[n - 1] : 0) ^ (uint64_t)1 << 63); /* unsigned keys in the order of signed ones */
	status = pm_world_count(status, PM_MOST_OF, 1, &most);
	const uint64_t largest = (uint64_t)most ^ (uint64_t)1 << 63;
	for (int bit = 63; bit >= 0 && !status; bit--) {
		if (!(largest >> bit))
			continue;
		for (int r = 1; r < ranks; r++)
			count[r] = (int64_t)below(n, sorted, split[r] | (uint64_t)1 << bit, false);
		status = pm_world_count(status, PM_SUM_OF, (size_t)ranks - 1, count + 1);
		for (int r = 1; r < ranks && !status; r++)
			if ((uint64_t)count[r] <= from[r])
				split[r] |= (uint64_t)1 << bit;
	}
	return status;
}

/* out[r]: how many of the sorted particles here go to rank r. */
static int deal(int status, const uint64_t *from, size_t n, const uint64_t *sorted, size_t *out)
{
	const int ranks = pm_world_size();
	const size_t room = (size_t)ranks + 1;
	uint64_t *split = calloc(room, sizeof *split);
	int64_t *less = calloc(3 * room, sizeof *less), *before = less + room, *cut = less + 2 * room;
	if (!split || !less)
		status = pm_no_memory();
	status = splits(status, from, n, sorted, split, less);
	for (int r = 1; r < ranks && !status; r++) {
		less[r] = cut[r] = (int64_t)below(n, sorted, split[r], false);
		before[r] = (int64_t)below(n, sorted, split[r], true) - less[r];
	}
	status = pm_world_count(status, PM_SUM_OF, (size_t)ranks - 1, less ? less + 1 : NULL);
	status = pm_world_count(status, PM_SUM_BEFORE, (size_t)ranks - 1, less ? before + 1 : NULL);
	for (int r = 1; r < ranks && !status; r++) {
		const int64_t equal = (int64_t)below(n, sorted, split[r], true) - cut[r], left = (int64_t)from[r] - less[r] - before[r];
		cut[r] += left < 0 ? 0 : left < equal ? left : equal;
	}
	if (!status)
		cut[ranks] = (int64_t)n;
	for (int r = 0; r < ranks && !status; r++)
		out[r] = (size_t)(cut[r + 1] - cut[r]);
	free(split), free(less);
	return status;
}

/* to[at[i]] = from[i], or with `take` to[i] = from[at[i]]. */
static void reorder(size_t n, size_t size, const size_t *at, bool take, const void *from, void *to)
{
#pragma omp parallel for
	for (size_t i = 0; i < n; i++) {
		const size_t j = take ? at[i] : i, k = take ? i : at[i];
		if (size == 1)
			((unsigned char *)to)[k] = ((const unsigned char *)from)[j];
		else
			((uint64_t *)to)[k] = ((const uint64_t *)from)[j];
	}
}

/* n values of `size` bytes in the order of leave[] to their ranks; *in: those that arrived, pm_free. */
static int move(int status, const struct pm_sort_ranks *s, size_t size, const void *values, void **in)
{
	const size_t ranks = (size_t)pm_world_size();
	unsigned char *ordered = status ? NULL : pm_alloc(s->n ? s->n : 1, size);
	size_t *bytes = calloc(2 * ranks, sizeof *bytes);
	*in = NULL;
	if (!status && !(ordered && bytes))
		status = bytes ? -PM_DATA : pm_no_memory();
	if (!status)
		reorder(s->n, size, s->leave, true, values, ordered);
	for (size_t r = 0; r < ranks && !status; r++)
		bytes[r] = s->out[r] * size;
	status = pm_world_exchange(status, ordered, bytes, in, bytes ? bytes + ranks : NULL);
	for (size_t r = 0; r < ranks && !status; r++)
		s->in[r] = bytes[ranks + r] / size;
	pm_free(ordered), free(bytes);
	return status;
}

/* n values of `size` bytes in the order in which they arrived, to the ranks they came from; *out: as they left these, pm_free. */
static int move_back(int status, const struct pm_sort_ranks *s, size_t size, const void *values, void **out)
{
	const size_t ranks = (size_t)pm_world_size();
	size_t *bytes = calloc(2 * ranks, sizeof *bytes);
	*out = NULL;
	status = status ? status : bytes ? 0 : pm_no_memory();
	for (size_t r = 0; r < ranks && !status; r++)
		bytes[r] = s->in[r] * size;
	status = pm_world_exchange(status, values, bytes, out, bytes ? bytes + ranks : NULL);
	free(bytes);
	return status;
}

int pm_sort_ranks_init(int status, const uint64_t *from, size_t n, const uint64_t *key, struct pm_sort_ranks *s)
{
	const size_t room = n ? n : 1;
	uint64_t *work = NULL, *sorted = NULL;
	void *arrived = NULL;
	*s = (struct pm_sort_ranks){.n = n};
	if (!status) {
		s->leave = pm_alloc(room, sizeof *s->leave), s->arrive = pm_alloc(room, sizeof *s->arrive);
		s->out = calloc(2 * (size_t)pm_world_size(), sizeof *s->out);
		s->in = s->out ? s->out + pm_world_size() : NULL;
		work = pm_alloc(2 * room, sizeof *work), sorted = pm_alloc(room, sizeof *sorted);
		status = !s->out ? pm_no_memory() : s->leave && s->arrive && work && sorted ? 0 : -PM_DATA;
	}
	if (!status) {
		memcpy(sorted, key, n * sizeof *key);
		pm_keys_order(n, sorted, work, s->leave, (size_t *)(work + room));
		for (size_t i = 0; i < n; i++)
			sorted[i] = key[s->leave[i]];
	}
	status = deal(status, from, n, sorted, s->out);
	status = move(status, s, sizeof *key, key, &arrived);
	if (!status)
		pm_keys_order(n, arrived, work, s->arrive, (size_t *)(work + room));
	pm_free(work), pm_free(sorted), pm_free(arrived);
	return status;
}

int pm_sort_ranks_permute(int status, const struct pm_sort_ranks *s, struct pm_field *field)
{
	const bool bytes = field->type == PM_U8;
	for (int c = 0; c < field->components; c++) {
		void *in, *y = status ? NULL : bytes ? (void *)pm_out_u8(field, c) : (void *)pm_out(field, c); /* eight bytes of either kind */
		status = move(status, s, bytes ? 1 : sizeof(uint64_t), y, &in);
		if (!status)
			reorder(s->n, bytes ? 1 : sizeof(uint64_t), s->arrive, true, in, y);
		pm_free(in);
	}
	return status;
}

int pm_sort_ranks_return(int status, const struct pm_sort_ranks *s, struct pm_field *field)
{
	const size_t size = pm_field_memory(field);
	void *came = status ? NULL : pm_alloc(s->n + 1, size);
	status = status ? status : came ? 0 : pm_failed();
	for (int c = 0; c < field->components; c++) {
		void *left, *y = status ? NULL : size == 1 ? (void *)pm_out_u8(field, c) : (void *)pm_out(field, c);
		if (!status)
			reorder(s->n, size, s->arrive, false, y, came);
		status = move_back(status, s, size, came, &left);
		if (!status)
			reorder(s->n, size, s->leave, false, left, y);
		pm_free(left);
	}
	pm_free(came);
	return status;
}

void pm_sort_ranks_free(struct pm_sort_ranks *s)
{
	pm_free(s->leave), pm_free(s->arrive), free(s->out);
	*s = (struct pm_sort_ranks){0};
}
