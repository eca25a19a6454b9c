/* Planes to lines along the divided axis and back. Planes come from their rank in order, rank after rank, so what arrives is in order already; on the way
 * back what leaves is. Cost: one exchange each way, of which the part 1 - 1/ranks travels; a second copy of what is here, and a third while it is exchanged.
 * SPDX-License-Identifier: GPL-3.0-or-later */
#include <stdlib.h>
#include <string.h>

#include "mesh/planes.h"
#include "world/world.h"

/* The first column of rank r. */
static size_t column(const struct pm_planes *p, size_t r)
{
	const size_t unit = p->axis == 2 ? p->points[0] : 16, units = (p->size + unit - 1) / unit, at = units * r / (size_t)pm_world_size() * unit;
	return at < p->size ? at : p->size;
}

/* The planes here to the pieces of all ranks, or back. */
static void pack(const struct pm_planes *p, double *pieces, double *planes, bool back)
{
	for (size_t r = 0; r < (size_t)pm_world_size(); r++) {
		const size_t first = column(p, r), n = column(p, r + 1) - first;
		for (size_t k = 0; k < p->here; k++) {
			double *in_plane = planes + k * p->size + first, *in_piece = pieces + first * p->here + k * n;
			memcpy(back ? in_plane : in_piece, back ? in_piece : in_plane, n * sizeof *planes);
		}
	}
}

int pm_planes_turn(int status, const struct pm_planes *p, const double *in, double **lines, size_t *columns)
{
	const size_t ranks = (size_t)pm_world_size(), me = (size_t)pm_world_rank();
	size_t *bytes = calloc(2 * ranks, sizeof *bytes);
	double *pieces = status ? NULL : pm_alloc(p->here * p->size + 1, sizeof *pieces);
	void *arrived = NULL;
	if (!status && !(bytes && pieces))
		status = pm_no_memory();
	for (size_t r = 0; r < ranks && bytes; r++)
		bytes[r] = (column(p, r + 1) - column(p, r)) * p->here * sizeof *pieces;
	if (!status)
		pack(p, pieces, (double *)(uintptr_t)in, false);
	status = pm_world_exchange(status, pieces, bytes, &arrived, bytes ? bytes + ranks : NULL);
	pm_free(pieces), free(bytes);
	*columns = column(p, me + 1) - column(p, me);
	*lines = status ? NULL : arrived;
	return status;
}

int pm_planes_turn_back(int status, const struct pm_planes *p, double **lines, double *out)
{
	const size_t ranks = (size_t)pm_world_size(), me = (size_t)pm_world_rank();
	size_t *bytes = calloc(2 * ranks, sizeof *bytes);
	void *arrived = NULL;
	if (!status && !bytes)
		status = pm_no_memory();
	for (size_t r = 0; r < ranks && bytes; r++)
		bytes[r] = (column(p, me + 1) - column(p, me)) * (size_t)(p->from[r + 1] - p->from[r]) * sizeof *out;
	status = pm_world_exchange(status, *lines, bytes, &arrived, bytes ? bytes + ranks : NULL);
	if (!status)
		pack(p, arrived, out, true);
	*lines = pm_free(*lines);
	pm_free(arrived), free(bytes);
	return status;
}
