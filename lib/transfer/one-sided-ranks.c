/* One-sided kernels where particles and planes of the mesh are divided among the ranks.
 * Spread: the position and the strengths of a particle go to every rank that has planes of its nodes, which finds its share again and adds what is for its own
 * nodes. What arrives is in the order of ranks, so of the stream: the sums of a spread alone.
 * Gather: the planes of the nodes come to the rank of the particle, some at a time, for particles in the order of planes.
 * Cost: shares of these particles are found once where they are and once for each rank of their planes (spread), or twice (gather); dim + components numbers a
 * particle and rank travel, or the planes. SPDX-License-Identifier: GPL-3.0-or-later */
#include <stdlib.h>
#include <string.h>

#include "mesh/planes-some.h"
#include "transfer/one-sided.h"
#include "world/world.h"

/* The plane of the mesh, or SIZE_MAX where there is none. */
static size_t plane_of(const struct pm_planes *p, ptrdiff_t k)
{
	const ptrdiff_t n = (ptrdiff_t)p->all;
	if (!p->axis)
		return 0;
	if (p->periodic)
		k = (k % n + n) % n;
	return k < 0 || k >= n ? SIZE_MAX : (size_t)k;
}

/* ---- spread ---- */

/* Does rank r have one of these planes? */
static bool has_some(const struct pm_planes *p, size_t r, const struct pm_one_sided_reach *reach)
{
	for (ptrdiff_t k = reach->low; k <= reach->high; k++) {
		const size_t plane = plane_of(p, k);
		if (plane != SIZE_MAX && plane >= p->from[r] && plane < p->from[r + 1])
			return true;
	}
	return false;
}

/* The records of the particles whose nodes rank r may have, in their order: where they end. to NULL: they are counted alone, in doubles. */
static size_t pack(const struct pm_one_sided *o, const struct pm_one_sided_few *few, const struct pm_one_sided_reach *reach, size_t r, int components,
	const double *const q[], double *to)
{
	size_t n = 0;
	for (size_t k = 0; k < few->count; k++) {
		if (!has_some(o->planes, r, &reach[k]))
			continue;
		for (int d = 0; d < o->grid.dim && to; d++)
			to[n + (size_t)d] = few->x[d][few->which[k]];
		for (int c = 0; c < components && to; c++)
			to[n + (size_t)(o->grid.dim + c)] = q[c][few->which[k]];
		n += (size_t)(o->grid.dim + components);
	}
	return n;
}

/* n records that came, as particles of their own. */
static int add(const struct pm_one_sided *o, const double *records, size_t n, int components, double *const node[])
{
	const size_t each = (size_t)(o->grid.dim + components);
	struct pm_one_sided_few few = {.which = pm_alloc(n + 1, sizeof *few.which), .count = n};
	double *columns = pm_alloc(n * each + 1, sizeof *columns);
	const double *q[PM_COMPONENTS];
	int status = few.which && columns ? 0 : -PM_DATA;
	for (size_t i = 0; i < n && !status; i++) {
		few.which[i] = i;
		for (size_t c = 0; c < each; c++)
			columns[c * n + i] = records[i * each + c];
	}
	for (int d = 0; d < o->grid.dim; d++)
		few.x[d] = columns + (size_t)d * n;
	for (int c = 0; c < components; c++)
		q[c] = columns + (size_t)(o->grid.dim + c) * n;
	status = status ? status : pm_one_sided_spread_here(o, &few, components, q, node);
	pm_free(few.which), pm_free(columns);
	return status;
}

int pm_one_sided_spread_ranks(const struct pm_one_sided *o, struct pm_one_sided_few *few, int components, const double *const q[], double *const node[])
{
	const size_t ranks = (size_t)pm_world_size(), each = (size_t)(o->grid.dim + components) * sizeof(double);
	struct pm_one_sided_reach *reach = pm_alloc(few->count + 1, sizeof *reach);
	size_t *bytes = calloc(2 * ranks, sizeof *bytes), all = 0, came_bytes = 0;
	double *out = NULL, *to;
	void *came = NULL;
	int status = reach && bytes ? pm_one_sided_reaches(o, few, reach) : pm_no_memory();
	for (size_t r = 0; r < ranks && !status; r++)
		all += bytes[r] = pack(o, few, reach, r, components, q, NULL) * sizeof *out;
	if (!status && !(to = out = pm_alloc(all + 1, 1)))
		status = pm_failed();
	for (size_t r = 0; r < ranks && !status; r++)
		to += pack(o, few, reach, r, components, q, to);
	status = pm_world_exchange(status, out, bytes, &came, bytes ? bytes + ranks : NULL);
	for (size_t r = 0; r < ranks && !status; r++)
		came_bytes += bytes[ranks + r];
	pm_free(out), pm_free(reach), free(bytes);
	status = status ? status : add(o, came, came_bytes / each, components, node);
	pm_free(came);
	return pm_world_agree(status);
}

/* ---- gather ---- */

struct place {
	struct pm_one_sided_reach reach;
	size_t k; /* its number among the few */
};

static int by_plane(const void *a, const void *b)
{
	const ptrdiff_t one = ((const struct place *)a)->reach.low, other = ((const struct place *)b)->reach.low;
	return (one > other) - (one < other);
}

/* The few by their first plane; those without a node are last. */
static int sort(const struct pm_one_sided *o, struct pm_one_sided_few *few, struct place *at, size_t *count)
{
	struct pm_one_sided_reach *reach = pm_alloc(few->count + 1, sizeof *reach);
	int status = reach ? pm_one_sided_reaches(o, few, reach) : -PM_DATA;
	*count = 0;
	for (size_t k = 0; k < few->count && !status; k++)
		if (reach[k].low <= reach[k].high)
			at[(*count)++] = (struct place){reach[k], k};
	pm_free(reach);
	if (!status)
		qsort(at, *count, sizeof *at, by_plane);
	return status;
}

/* Particles at[from..] whose nodes lie on few enough planes: which planes, and the end of the particles. */
static size_t want(const struct pm_planes *p, const struct place *at, size_t from, size_t count, unsigned char *wanted)
{
	size_t planes = 0, end = from;
	memset(wanted, 0, p->all);
	for (; end < count && (end == from || planes < pm_planes_at_once(p, 0)); end++)
		for (ptrdiff_t k = at[end].reach.low; k <= at[end].reach.high; k++) {
			const size_t plane = plane_of(p, k);
			planes += plane != SIZE_MAX && !wanted[plane];
			if (plane != SIZE_MAX)
				wanted[plane] = 1;
		}
	return end;
}

/* The values of these particles, from planes that have all their nodes. */
static int gather_some(const struct pm_one_sided *o, const struct pm_one_sided_few *few, const struct place *at, size_t n, int components,
	const struct pm_some_planes *some, double *const value[])
{
	struct pm_one_sided_few these = *few;
	double *found = pm_alloc(n * (size_t)components + 1, sizeof *found), *to[PM_COMPONENTS];
	these.which = pm_alloc(n + 1, sizeof *these.which);
	these.count = n;
	int status = found && these.which ? 0 : -PM_DATA;
	for (size_t i = 0; i < n && !status; i++)
		these.which[i] = few->which[at[i].k];
	for (int c = 0; c < components; c++)
		to[c] = found + (size_t)c * n;
	status = status ? status : pm_one_sided_gather_here(o, &these, components, some->at, to);
	for (int c = 0; c < components && !status; c++)
		for (size_t i = 0; i < n; i++)
			value[c][at[i].k] = to[c][i];
	pm_free(found), pm_free(these.which);
	return status;
}

int pm_one_sided_gather_ranks(const struct pm_one_sided *o, struct pm_one_sided_few *few, int components, const double *const mesh[], double *const value[])
{
	struct place *at = pm_alloc(few->count + 1, sizeof *at);
	unsigned char *wanted = pm_zalloc(o->planes->all + 1, 1);
	size_t count = 0, from = 0;
	int64_t left = 1;
	int status = at && wanted ? sort(o, few, at, &count) : pm_failed();
	for (int c = 0; c < components; c++)
		for (size_t k = 0; k < few->count; k++)
			value[c][k] = 0;
	while (left) {
		struct pm_some_planes some;
		const size_t end = status ? from : want(o->planes, at, from, count, wanted);
		status = pm_planes_some(status, o->planes, wanted, components, mesh, &some);
		status = status ? status : gather_some(o, few, at + from, end - from, components, &some, value);
		pm_planes_some_free(&some);
		left = (int64_t)(count - end), from = end;
		status = pm_world_count(status, PM_MOST_OF, 1, &left);
		left = status ? 0 : left;
	}
	pm_free(at), pm_free(wanted);
	return status;
}
