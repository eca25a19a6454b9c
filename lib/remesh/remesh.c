/* Remeshing: node i receives sum over particles of strength * W((x - x_i)/h), the density of p2m times the node's cell, and the nodes that
 * are not 0 are the new particles. Source: Cottet and Koumoutsakos 2000, section 7.2; Koumoutsakos 1997, J. Comput. Phys. 138, 821.
 * Conserves the kernel's moments away from faces, and the total always: at walls and neumann faces strength beyond the face is folded
 * back as an even image (odd images at walls would remove strength). A positive kernel diffuses, the others overshoot (kernels.md).
 * Cost: p2m per strength and two passes over the mesh. SPDX-License-Identifier: GPL-3.0-or-later */
#include <string.h>

#include "remesh/remesh.h"

enum { block = 4096 }; /* nodes: fixed, because losses are summed block by block */

static size_t blocks_of(const struct pm_remesh *r) { return (r->points + block - 1) / block; }
static size_t end_of(const struct pm_remesh *r, size_t b) { return (b + 1) * block < r->points ? (b + 1) * block : r->points; }

/* The place of node i along each axis. */
static void place_of(const struct pm_grid *g, size_t i, size_t at[3])
{
	at[0] = i % g->points[0];
	at[1] = i / g->points[0] % g->points[1];
	at[2] = i / g->points[0] / g->points[1];
}

static double volume_of(const struct pm_grid *g, size_t i)
{
	size_t at[3];
	place_of(g, i, at);
	return pm_grid_cell(g) * pm_grid_weight(g, at[0], at[1], at[2]);
}

struct pm_remesh pm_remesh_on(const struct pm_grid *g, const struct pm_kernel *k)
{
	struct pm_remesh r = {.grid = *g, .kernel = k, .points = pm_grid_size(g)};
	for (int d = 0; d < g->dim; d++)
		for (int side = 0; side < 2; side++)
			if (g->face[d][side] == PM_WALL)
				r.grid.face[d][side] = PM_NEUMANN;
	return r;
}

/* Densities to strengths: times the volume of each node. */
static void weigh(const struct pm_remesh *r, double *node)
{
#pragma omp parallel for schedule(static) if (r->points > 16384)
	for (size_t b = 0; b < blocks_of(r); b++)
		for (size_t i = b * block; i < end_of(r, b); i++)
			node[i] *= volume_of(&r->grid, i);
}

int pm_remesh_add(struct pm_remesh *r, size_t n, const double *const x[], int components, const double *const q[], bool decides,
	struct pm_strays *strays)
{
	const struct pm_transfer t = {.grid = r->grid, .kernel = r->kernel, .components = components};
	int first = r->n;
	if (first + components > PM_REMESH_VALUES)
		return pm_fail(PM_DATA, "more than %d values per particle to remesh (leave some out with --drop)", PM_REMESH_VALUES);
	for (int c = 0; c < components; c++, r->n++) {
		r->node[r->n] = pm_zalloc(r->points, sizeof(double));
		if (!r->node[r->n])
			return -PM_DATA;
		r->field[r->n] = decides ? first : -1;
	}
	int status = pm_spread(&t, n, x, q, r->node + first, strays);
	for (int i = first; i < r->n && !status; i++) {
		weigh(r, r->node[i]);
		if (!pm_finite(r->points, r->node[i]))
			status = pm_fail(PM_NUMERICS, "a remeshed strength is not finite (strengths this large overflow)");
	}
	return status;
}

static void thresholds(const struct pm_remesh *r, double cut_off, double least[])
{
	for (int i = 0; i < r->n; i++) {
		double most = 0;
#pragma omp parallel for schedule(static) reduction(max : most) if (r->points > 16384)
		for (size_t p = 0; p < r->points; p++)
			most = fmax(most, fabs(r->node[i][p]));
		least[i] = cut_off * most;
		if (r->field[i] >= 0 && r->field[i] < i) /* components share the largest */
			for (int c = r->field[i]; c <= i; c++)
				least[c] = fmax(least[r->field[i]], least[i]);
	}
}

/* Marks the nodes that become particles. */
static void mark(const struct pm_remesh *r, const double least[])
{
#pragma omp parallel for schedule(static) if (r->points > 16384)
	for (size_t p = 0; p < r->points; p++) {
		bool keep = false;
		for (int i = 0; i < r->n; i++)
			keep = keep || (r->field[i] >= 0 && fabs(r->node[i][p]) > least[i]);
		r->keep[p] = keep;
	}
}

size_t pm_remesh_room(const struct pm_kernel *k) { return (size_t)(k->width + 1) / 2 + 1; }

/* May a node of a rim lie at index k of axis d? Particles there must have room to move before the kernel reaches an open face. */
static bool has_room(const struct pm_remesh *r, int d, size_t k)
{
	const size_t room = pm_remesh_room(r->kernel);
	const enum pm_face low = r->grid.face[d][0], high = r->grid.face[d][1];
	return (low == PM_PERIODIC || low == PM_NEUMANN || k >= room) && (high == PM_PERIODIC || high == PM_NEUMANN || k + room <= r->grid.cells[d]);
}

/* Every node within `rim` cells of a marked one along each axis is marked as well. */
static int widen(struct pm_remesh *r, int rim)
{
	unsigned char *from = pm_alloc(r->points, 1);
	size_t stride = 1;
	for (int d = 0; d < r->grid.dim && from; stride *= r->grid.points[d++]) {
		const size_t n = r->grid.points[d], reach = (size_t)rim < n ? (size_t)rim : n - 1;
		const bool round = r->grid.face[d][0] == PM_PERIODIC;
		memcpy(from, r->keep, r->points);
#pragma omp parallel for schedule(static) if (r->points > 16384)
		for (size_t p = 0; p < r->points; p++) {
			const size_t k = p / stride % n, row = p - k * stride;
			bool keep = from[p];
			for (size_t s = 1; s <= reach && !keep && has_room(r, d, k); s++)
				keep = (k >= s ? from[row + (k - s) * stride] : round && from[row + (k + n - s) * stride]) ||
					(k + s < n ? from[row + (k + s) * stride] : round && from[row + (k + s - n) * stride]);
			r->keep[p] = keep;
		}
	}
	pm_free(from);
	return from ? 0 : -PM_DATA;
}

/* One block: counts, and sums what is cut; the number kept. */
static size_t count_block(const struct pm_remesh *r, size_t b, size_t *cut, struct pm_sum lost[])
{
	size_t kept = 0;
	*cut = 0;
	for (int i = 0; i < r->n; i++)
		lost[i] = (struct pm_sum){0, 0};
	for (size_t p = b * block; p < end_of(r, b); p++) {
		bool any = false;
		for (int i = 0; i < r->n; i++)
			any = any || r->node[i][p] != 0;
		kept += r->keep[p];
		*cut += any && !r->keep[p];
		for (int i = 0; i < r->n && any && !r->keep[p]; i++)
			pm_sum_add(&lost[i], r->node[i][p]);
	}
	return kept;
}

static void count(struct pm_remesh *r, size_t cut[], struct pm_sum lost[])
{
	const size_t blocks = blocks_of(r);
#pragma omp parallel for schedule(static) if (r->points > 16384)
	for (size_t b = 0; b < blocks; b++)
		r->before[b + 1] = count_block(r, b, &cut[b], &lost[b * (size_t)r->n]);
	r->before[0] = r->cut = 0;
	for (size_t b = 0; b < blocks; b++) {
		r->before[b + 1] += r->before[b];
		r->cut += cut[b];
		for (int i = 0; i < r->n; i++)
			r->lost[i] += pm_sum_total(lost[b * (size_t)r->n + (size_t)i]);
	}
	r->kept = r->before[blocks];
}

int pm_remesh_keep(struct pm_remesh *r, double cut_off, int rim)
{
	const size_t blocks = blocks_of(r);
	double least[PM_REMESH_VALUES];
	r->keep = pm_alloc(r->points, 1);
	r->before = pm_alloc(blocks + 1, sizeof *r->before);
	size_t *cut = pm_alloc(blocks, sizeof *cut);
	struct pm_sum *lost = pm_alloc(blocks * (size_t)r->n + 1, sizeof *lost);
	int status = r->keep && r->before && cut && lost ? 0 : -PM_DATA;
	if (!status) {
		thresholds(r, cut_off, least);
		mark(r, least);
		status = rim ? widen(r, rim) : 0;
	}
	if (!status)
		count(r, cut, lost);
	pm_free(cut);
	pm_free(lost);
	return status;
}

void pm_remesh_value(const struct pm_remesh *r, int i, double *out)
{
#pragma omp parallel for schedule(static) if (r->points > 16384)
	for (size_t b = 0; b < blocks_of(r); b++)
		for (size_t p = b * block, to = r->before[b]; p < end_of(r, b); p++)
			if (r->keep[p])
				out[to++] = r->node[i][p];
}

void pm_remesh_position(const struct pm_remesh *r, int d, double *x)
{
#pragma omp parallel for schedule(static) if (r->points > 16384)
	for (size_t b = 0; b < blocks_of(r); b++)
		for (size_t p = b * block, to = r->before[b], at[3]; p < end_of(r, b); p++)
			if (r->keep[p]) {
				place_of(&r->grid, p, at);
				x[to++] = r->grid.lo[d] + (double)at[d] * r->grid.h[d];
			}
}

void pm_remesh_volume(const struct pm_remesh *r, double *volume)
{
#pragma omp parallel for schedule(static) if (r->points > 16384)
	for (size_t b = 0; b < blocks_of(r); b++)
		for (size_t p = b * block, to = r->before[b]; p < end_of(r, b); p++)
			if (r->keep[p])
				volume[to++] = volume_of(&r->grid, p);
}

void pm_remesh_free(struct pm_remesh *r)
{
	for (int i = 0; i < r->n; i++)
		pm_free(r->node[i]);
	pm_free(r->keep);
	pm_free(r->before);
	*r = (struct pm_remesh){.n = 0};
}
