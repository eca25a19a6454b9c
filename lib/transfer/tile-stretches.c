/* A spread over jobs on several threads: jobs one after the other are a stretch, which a thread does with one block. A line of the mesh that no stretch before
 * touches is added to at once, while the block is in the cache; the other rows are kept until all stretches have been, and added in their order. So a point's
 * sum has the order of the tiles, as on one thread: the same bytes. Cost: what is kept is written and read once more: some planes of the
 * mesh, by wide kernels and on many threads, whose stretches are a tile or two, up to a few times the mesh.
 * SPDX-License-Identifier: GPL-3.0-or-later */
#include <string.h>

#include "transfer/tile-stretches.h"

enum { EACH = 4 }; /* stretches a thread, so that one that is late is waited for less */

/* Boundaries after equal parts of the work, of which half a tile's cells are for its block. */
static void divide(struct pm_tile_stretches *s, const struct pm_tile_pass *p)
{
	size_t all = 0, done = 0, k = 0;
	for (size_t j = 0; j < p->jobs; j++)
		all += p->job[j].to - p->job[j].from + PM_TILE_CELLS / 2;
	for (size_t j = 0; j < p->jobs; j++) {
		if (k + 1 < s->count && j > s->stretch[k].from && done >= all / s->count * (k + 1))
			s->stretch[k].to = j, s->stretch[++k].from = j;
		done += p->job[j].to - p->job[j].from + PM_TILE_CELLS / 2;
	}
	s->stretch[k].to = p->jobs;
	s->count = k + 1;
}

/* The line of the mesh of a slot along y and one along z. */
static size_t line_of(const struct pm_tile_pass *p, const struct pm_tile_target *t, size_t y, size_t z)
{
	return t->axes[2]->at[z] * p->grid->points[1] + t->axes[1]->at[y];
}

/* Who touches a line first, and how many rows wait for others. Tiles beside each other along x have the same lines. */
static void find_owners(struct pm_tile_stretches *s, const struct pm_tile_pass *p, const struct pm_tile_target *t)
{
	size_t first[3], n[3];
	for (size_t k = 0; k < s->count; k++) {
		size_t waits = 0, before = SIZE_MAX;
		for (size_t j = s->stretch[k].from; j < s->stretch[k].to; j++) {
			const size_t row = p->job[j].tile / p->order->across[0];
			for (int d = 0; d < 3; d++)
				n[d] = pm_tile_slots(p, p->job[j].tile, d, &first[d]);
			if (row != before)
				waits = 0;
			for (size_t z = 0; z < n[2] && row != before; z++)
				for (size_t y = 0; y < n[1]; y++) {
					uint32_t *owner = &s->owner[line_of(p, t, first[1] + y, first[2] + z)];
					*owner = *owner < k ? *owner : (uint32_t)k;
					waits += *owner < k;
				}
			before = row;
			s->stretch[k].kept += waits;
		}
		s->stretch[k].first_kept = s->rows;
		s->rows += s->stretch[k].kept;
	}
}

int pm_tile_stretches_init(struct pm_tile_stretches *s, const struct pm_tile_pass *p, const struct pm_tile_target *t, int threads)
{
	const size_t most = threads == 1 ? 1 : EACH * (size_t)threads, lines = p->grid->points[1] * p->grid->points[2];
	*s = (struct pm_tile_stretches){.count = most < p->jobs ? most : p->jobs + !p->jobs};
	s->stretch = pm_zalloc(s->count, sizeof *s->stretch);
	if (!s->stretch)
		return -PM_DATA;
	divide(s, p);
	if (s->count == 1)
		return 0;
	if (!(s->owner = pm_alloc(lines, sizeof *s->owner)))
		return -PM_DATA;
	memset(s->owner, 0xff, lines * sizeof *s->owner);
	find_owners(s, p, t);
	s->row = pm_alloc(s->rows + 1, sizeof *s->row);
	s->values = s->row ? pm_alloc((s->rows + 1) * (size_t)pm_block_row[p->grid->dim], sizeof *s->values) : NULL;
	return s->values ? 0 : -PM_DATA;
}

void pm_tile_stretches_free(struct pm_tile_stretches *s)
{
	pm_free(s->values);
	pm_free(s->row);
	pm_free(s->owner);
	pm_free(s->stretch);
}

void pm_tile_stretch_add(const struct pm_tile_stretches *s, size_t stretch, const struct pm_tile_pass *p, const struct pm_tile_job *j,
	const struct pm_tile_target *t, double *block, double *mesh, size_t *kept)
{
	const size_t row = (size_t)pm_block_row[p->grid->dim], plane = row * (size_t)pm_block_rows[p->grid->dim];
	size_t first[3], n[3];
	for (int d = 0; d < 3; d++)
		n[d] = pm_tile_slots(p, j->tile, d, &first[d]);
	for (size_t z = 0; z < n[2]; z++)
		for (size_t y = 0; y < n[1]; y++) {
			const size_t line = line_of(p, t, first[1] + y, first[2] + z);
			double *from = block + z * plane + y * row;
			if (s->owner && s->owner[line] < stretch) {
				const size_t at = s->stretch[stretch].first_kept + (*kept)++;
				s->row[at] = (struct pm_tile_row){line, first[0], n[0], first[1] + y, first[2] + z};
				memcpy(s->values + at * row, from, n[0] * sizeof *from);
				memset(from, 0, n[0] * sizeof *from);
			} else
				pm_tile_add_row(t, first, n[0], z, y, from, mesh + (line - t->line) * p->grid->points[0]);
		}
}

void pm_tile_stretches_add_kept(const struct pm_tile_stretches *s, const struct pm_tile_pass *p, const struct pm_tile_target *t, int thread, int threads,
	double *mesh)
{
	for (size_t i = 0; i < s->rows; i++) {
		const struct pm_tile_row *r = &s->row[i];
		const size_t first[3] = {r->first, 0, 0};
		if (r->line % (size_t)threads == (size_t)thread)
			pm_tile_add_row(t, first, r->n, r->z, r->y, s->values + i * (size_t)pm_block_row[p->grid->dim],
				mesh + (r->line - t->line) * p->grid->points[0]);
	}
}
