/* Jobs over the tiles of an order, at most so many particles each, and their blocks of mesh points: where points beyond a face are folded back with the sign
 * of their image. Cost: a pass over the blocks. SPDX-License-Identifier: GPL-3.0-or-later */
#include <omp.h>
#include <string.h>

#include "transfer/tile-pass.h"

enum {
	piece = PM_TILE_PIECE,
	wave = 32 /* jobs per thread between two barriers */
};

/* The slots of a tile: first cell, and how many. */
size_t pm_tile_slots(const struct pm_tile_pass *p, size_t tile, int d, size_t *first)
{
	const uint32_t *across = p->order->across;
	size_t edge = (size_t)1 << pm_tile_shift[p->order->dim][d];
	size_t at = d == 0 ? tile % across[0] : d == 1 ? tile / across[0] % across[1] : tile / across[0] / across[1];
	const struct pm_axis *a = &p->axes[d];
	*first = at * edge;
	return (a->count - *first < edge ? a->count - *first : edge) + (a->slots - a->count);
}

int pm_tile_pass_init(struct pm_tile_pass *p, const struct pm_grid *g, const struct pm_tile_order *o, const struct pm_axis *axes)
{
	*p = (struct pm_tile_pass){.grid = g, .order = o, .axes = axes};
	size_t most = o->tiles + o->n / piece;
	p->job = pm_alloc(most < o->n ? most : o->n, sizeof *p->job);
	if (!p->job)
		return -PM_DATA;
	for (size_t tile = 0; tile < o->tiles; tile++)
		for (size_t at = o->begin[tile], end = o->begin[tile + 1]; at < end; at += piece)
			p->job[p->jobs++] = (struct pm_tile_job){tile, at, end - at < piece ? end : at + piece};
	return 0;
}

/* One row of a block to the mesh, times factor; the row is zero afterwards. */
static void add_row(const struct pm_axis *a, const double *put, size_t first, size_t n, double factor, double *restrict row, double *restrict mesh)
{
	size_t slot = first, end = first + n, from = a->from < end ? a->from : end, to = a->to < end ? a->to : end;
	for (; slot < from; slot++)
		mesh[a->at[slot]] += factor * put[slot] * row[slot - first];
	if (slot < to) {
		double *restrict points = mesh + a->at[slot], *restrict values = row + (slot - first);
		size_t m = to - slot;
		for (size_t i = 0; i < m; i++)
			points[i] += factor * values[i];
		slot = to;
	}
	for (; slot < end; slot++)
		mesh[a->at[slot]] += factor * put[slot] * row[slot - first];
	memset(row, 0, n * sizeof *row);
}

const struct pm_tile_job *pm_tile_next(const struct pm_tile_pass *p, const struct pm_tile_job *j)
{
	const size_t next = (size_t)(j - p->job) + (size_t)omp_get_num_threads();
	return next < p->jobs ? &p->job[next] : NULL;
}

void pm_tile_fetch_mesh(const struct pm_tile_pass *p, const struct pm_tile_job *j, const struct pm_tile_target *t, const double *mesh)
{
	enum { line = 8 }; /* doubles per line of the cache */
	const struct pm_axis *const *a = t->axes;
	size_t first[3], n[3];
	for (int d = 0; d < 3 && j; d++)
		n[d] = pm_tile_slots(p, j->tile, d, &first[d]);
	for (size_t z = 0; j && z < n[2]; z++)
		for (size_t y = 0; y < n[1]; y++) {
			const size_t at_line = a[2]->at[first[2] + z] * p->grid->points[1] + a[1]->at[first[1] + y];
			const double *at = mesh + (at_line - t->line) * p->grid->points[0] + a[0]->at[first[0]];
			for (size_t i = 0; i < n[0] + line - 1; i += line)
				__builtin_prefetch(at + i, 0, 2);
		}
}

/* The rows of a job's block that belong to this thread. */
void pm_tile_add_block(const struct pm_tile_pass *p, const struct pm_tile_job *j, const struct pm_tile_target *t, int thread, int threads,
	double *block, double *mesh)
{
	const struct pm_grid *g = p->grid;
	const unsigned char *flip = t->flip;
	const struct pm_axis *const *a = t->axes;
	size_t first[3], n[3], row = (size_t)pm_block_row[g->dim], plane = row * (size_t)pm_block_rows[g->dim];
	for (int d = 0; d < 3; d++)
		n[d] = pm_tile_slots(p, j->tile, d, &first[d]);
	for (size_t z = 0; z < n[2]; z++)
		for (size_t y = 0; y < n[1]; y++) {
			size_t sz = first[2] + z, sy = first[1] + y, line = a[2]->at[sz] * g->points[1] + a[1]->at[sy];
			if (line % (size_t)threads == (size_t)thread)
				add_row(a[0], a[0]->put[flip[0]], first[0], n[0], t->scale * a[2]->put[flip[2]][sz] * a[1]->put[flip[1]][sy],
					block + z * plane + y * row, mesh + (line - t->line) * g->points[0]);
		}
}

/* Threads worth starting for n particles. */
int pm_tile_threads(size_t n)
{
	size_t most = n / 4096 + 1;
	return (size_t)pm_threads() < most ? pm_threads() : (int)most;
}

/* One thread adds each block at once, while it is in the cache. */
size_t pm_tile_under_way(int threads) { return threads == 1 ? 1 : wave * (size_t)threads; }

void pm_tile_pass_free(struct pm_tile_pass *p)
{
	pm_free(p->job);
	p->job = NULL;
}

/* A row of the mesh to a block. */
static void load_row(const struct pm_axis *a, const double *get, size_t first, size_t n, double factor, const double *restrict mesh,
	double *restrict row)
{
	size_t slot = first, end = first + n, from = a->from < end ? a->from : end, to = a->to < end ? a->to : end;
	for (; slot < from; slot++)
		row[slot - first] = factor * get[slot] * mesh[a->at[slot]];
	if (slot < to) {
		const double *points = mesh + a->at[slot];
		for (size_t i = slot; i < to; i++)
			row[i - first] = factor * points[i - slot];
		slot = to;
	}
	for (; slot < end; slot++)
		row[slot - first] = factor * get[slot] * mesh[a->at[slot]];
}

void pm_tile_load_block(const struct pm_tile_pass *p, const struct pm_tile_job *j, const struct pm_tile_target *t, const double *mesh, double *block)
{
	const struct pm_grid *g = p->grid;
	const unsigned char *flip = t->flip;
	const struct pm_axis *const *a = t->axes;
	size_t first[3], n[3], row = (size_t)pm_block_row[g->dim], plane = row * (size_t)pm_block_rows[g->dim];
	for (int d = 0; d < 3; d++)
		n[d] = pm_tile_slots(p, j->tile, d, &first[d]);
	for (size_t z = 0; z < n[2]; z++)
		for (size_t y = 0; y < n[1]; y++) {
			size_t sz = first[2] + z, sy = first[1] + y, line = a[2]->at[sz] * g->points[1] + a[1]->at[sy];
			load_row(a[0], a[0]->get[flip[0]], first[0], n[0], a[2]->get[flip[2]][sz] * a[1]->get[flip[1]][sy],
				mesh + (line - t->line) * g->points[0], block + z * plane + y * row);
		}
}

/* ---- row by row, for blocks whose rows are on other ranks or wait for others ---- */

void pm_tile_add_row(const struct pm_tile_target *t, const size_t first[3], size_t n, size_t z, size_t y, double *row, double *line)
{
	const struct pm_axis *const *a = t->axes;
	add_row(a[0], a[0]->put[t->flip[0]], first[0], n, t->scale * a[2]->put[t->flip[2]][first[2] + z] * a[1]->put[t->flip[1]][first[1] + y], row, line);
}

void pm_tile_load_row(const struct pm_tile_target *t, const size_t first[3], size_t n, size_t z, size_t y, const double *line, double *row)
{
	const struct pm_axis *const *a = t->axes;
	load_row(a[0], a[0]->get[t->flip[0]], first[0], n, a[2]->get[t->flip[2]][first[2] + z] * a[1]->get[t->flip[1]][first[1] + y], line, row);
}
