/* SPDX-License-Identifier: GPL-3.0-or-later */
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "scene-parts/scene-vortex-set.h"
#include "scene-parts/scene-vortices.h"
#include "stream/declare.h"
#include "stream/parts.h"
#include "world/world.h"

int pm_scene_vortex_box(const struct pm_scene_choice *c, struct pm_frame *f, int dim, const double lo[3], const double hi[3], enum pm_face face,
	const size_t cells[3])
{
	size_t n[3] = {1, 1, 1};
	snprintf(f->law, sizeof f->law, "vortex");
	for (int d = 0; d < dim; d++) {
		f->lo[d] = c->box && face == PM_OPEN ? c->lo[d] : lo[d];
		f->hi[d] = c->box && face == PM_OPEN ? c->hi[d] : hi[d];
		n[d] = c->cells[d] ? c->cells[d] : cells[d];
		for (int side = 0; side < 2; side++) {
			f->face[d][side] = face;
			f->pface[d][side] = face == PM_PERIODIC ? PM_PFOLD : PM_POPEN;
		}
	}
	return pm_frame_mesh_new(f, "mesh", n) ? 0 : -PM_DATA;
}

double pm_scene_vortex_cell(const struct pm_scene_choice *c, double length, size_t cells)
{
	return (c->box ? c->hi[0] - c->lo[0] : length) / (double)(c->cells[0] ? c->cells[0] : cells);
}

void pm_scene_rows_here(size_t rows, size_t *first, size_t *end)
{
	const size_t ranks = (size_t)pm_world_size(), me = (size_t)pm_world_rank();
	*first = rows * me / ranks;
	*end = rows * (me + 1) / ranks;
}

/* How many all ranks have found before each; one more than ranks, free() it. */
static uint64_t *found_before(uint64_t here)
{
	const size_t ranks = (size_t)pm_world_size();
	uint64_t *from = calloc(ranks + 1, sizeof *from);
	if (from)
		from[pm_world_rank() + 1] = here;
	const int status = pm_world_count(from ? 0 : pm_no_memory(), PM_SUM_OF, ranks + 1, (int64_t *)from);
	for (size_t r = 0; r < ranks && !status; r++)
		from[r + 1] += from[r];
	if (!status)
		return from;
	free(from);
	return NULL;
}

static int ready(struct pm_field *p, const uint64_t *from)
{
	const size_t bytes = ((size_t)pm_world_size() + 1) * sizeof *from;
	uint64_t *own = pm_world_size() > 1 ? malloc(bytes) : NULL; /* whoever runs the stage frees it */
	if (pm_world_size() > 1 && !own)
		return pm_no_memory();
	if (own)
		pm_field_enter(p, memcpy(own, from, bytes));
	return pm_field_ready(p);
}

int pm_scene_vortex_inside(const struct pm_scene_choice *c, double largest, double at_the_margin)
{
	double all[] = {largest, at_the_margin};
	if (!c->box)
		return 0;
	const int status = pm_world_largest(0, 2, all);
	if (!status && !(all[0] > 0))
		return pm_fail(PM_USAGE, "no node of this box has vortices of the scene (another --box, or more --cells)");
	if (status || !(all[1] > 1e-3 * all[0]))
		return status;
	return pm_fail(PM_USAGE, "open faces cut this scene: %.2g of its largest vorticity %d cells inside of them (take a larger --box, or more --cells)",
		all[1] / all[0], PM_SCENE_MARGIN);
}

static double size_of(const struct pm_scene_choice *c, const struct pm_scene_omega *omega, const double x[3])
{
	double w[3] = {0};
	if (omega->plane)
		return fabs(omega->plane(c, x[0], x[1]));
	omega->space(c, x, w);
	return sqrt(w[0] * w[0] + w[1] * w[1] + w[2] * w[2]);
}

int pm_scene_vortex_lost(const struct pm_scene_choice *c, const struct pm_frame *f, const struct pm_scene_omega *omega, double least, double kept,
	const size_t margin[3])
{
	const struct pm_mesh *m = pm_frame_mesh(f, "mesh");
	size_t n[3], first, end, bytes;
	double sum[2] = {kept, 0}, *all = NULL; /* of all on rank 0, which speaks */
	if (!c->cut || !(margin[0] || margin[1] || margin[2]))
		return 0;
	pm_mesh_points(f, m, n);
	pm_scene_rows_here(n[1] * n[2], &first, &end);
	for (size_t row = first; row < end; row++) {
		const size_t j = row % n[1], k = row / n[1];
		const bool outside = j < margin[1] || j + margin[1] >= n[1] || k < margin[2] || k + margin[2] >= n[2];
		for (size_t i = 0; i < n[0]; i++) {
			if (!outside && i == margin[0] && n[0] > 2 * margin[0])
				i = n[0] - margin[0];
			if (i == n[0])
				break;
			const size_t at[3] = {i, j, k};
			double x[3] = {0};
			for (int d = 0; d < f->dim; d++)
				x[d] = m->lo[d] + (double)at[d] * m->h[d];
			const double size = size_of(c, omega, x);
			sum[1] += size > least ? size : 0;
		}
	}
	const int status = pm_world_gather(0, sum, sizeof sum, (void **)&all, &bytes);
	double total[2] = {0};
	for (size_t r = 0; !status && r < bytes / sizeof sum; r++)
		total[0] += all[2 * r], total[1] += all[2 * r + 1];
	*c->cut = total[1] > 0 ? total[1] / (total[0] + total[1]) : 0;
	pm_free(all);
	return status;
}

int pm_scene_vortex_cut(struct pm_frame *f)
{
	const char *const names[] = {"x", f->dim == 2 ? "circulation" : "alpha", "id"};
	const struct pm_set *set = pm_frame_set(f, "vortices");
	if (pm_world_size() == 1)
		return 0;
	uint64_t *from = found_before(pm_frame_field(f, "vortices", "x")->count), *to = from ? pm_division_new(set->n, pm_sum_block) : NULL;
	int status = pm_world_agree(to ? 0 : pm_failed());
	for (size_t i = 0; i < sizeof names / sizeof *names && !status; i++)
		status = pm_field_recut(status, pm_frame_field(f, "vortices", names[i]), from, to);
	free(from), free(to);
	return status;
}

int pm_scene_vortex_set(struct pm_frame *f, int dim, uint64_t n, double volume, double *x[], double *strength[])
{
	const char *on = "vortices";
	const int components = dim == 2 ? 1 : 3;
	uint64_t *from = found_before(n);
	struct pm_set *set = from ? pm_frame_set_new(f, on, from[pm_world_size()]) : NULL;
	struct pm_field *at = set ? pm_makes(f, on, "x", dim, PM_STATE) : NULL;
	struct pm_field *q = at ? pm_makes(f, on, dim == 2 ? "circulation" : "alpha", components, PM_STATE) : NULL;
	struct pm_field *w = q ? pm_makes(f, on, "volume", 1, PM_STATE) : NULL;
	struct pm_field *id = w ? pm_makes(f, on, "id", 1, PM_STATE) : NULL;
	if (!id) {
		free(from);
		return from ? -PM_DATA : pm_failed();
	}
	snprintf(at->unit, sizeof at->unit, "length");
	snprintf(q->unit, sizeof q->unit, "length^%d/time", dim);
	snprintf(w->unit, sizeof w->unit, "length^%d", dim);
	q->extensive = w->extensive = true;
	w->uniform = true;
	w->value[0] = volume;
	id->type = PM_I64;
	const uint64_t first = from[pm_world_rank()];
	const int status = pm_world_agree(ready(at, from) || ready(q, from) || ready(id, from) ? pm_failed() : 0);
	free(from);
	if (status)
		return status;
	for (int d = 0; d < dim; d++)
		x[d] = pm_out(at, d);
	for (int d = 0; d < components; d++)
		strength[d] = pm_out(q, d);
	for (uint64_t i = 0; i < n; i++)
		pm_out_i64(id, 0)[i] = (int64_t)(first + i);
	return 0;
}

void pm_scene_vortex_dt(struct pm_frame *f, const struct pm_mesh *m)
{
	const double nu = pm_frame_constant(f, "nu", 0);
	double sum = 0;
	for (int d = 0; d < f->dim; d++)
		sum += 1 / (m->h[d] * m->h[d]);
	if (nu > 0)
		f->dt = fmin(f->dt, 0.986 * 2.5127 * 45 / 272 / (nu * sum));
}
