/* The overlap H of a set's particles. Cost: that of a p2m and a m2p. SPDX-License-Identifier: GPL-3.0-or-later */
#include "effect-parts/set-overlap.h"
#include "mesh/grid.h"
#include "remesh/distortion.h"

int pm_set_overlap(const struct pm_frame *f, const char *set, const struct pm_mesh *m, double *H)
{
	const struct pm_field *x = pm_frame_field(f, set, "x"), *v = pm_frame_field(f, set, "volume");
	const struct pm_grid g = pm_grid_of(f, m);
	const double *place[3] = {NULL};
	double *volumes = pm_alloc(x->count + 1, sizeof *volumes);
	v = v && v->role == PM_STATE && (v->type == PM_F64 || v->type == PM_F32) ? v : NULL;
	for (int d = 0; d < f->dim; d++)
		place[d] = pm_in(x, d);
	for (size_t i = 0; volumes && i < x->count; i++)
		volumes[i] = !v ? pm_grid_cell(&g) : v->uniform && !v->buffer ? v->value[0] : pm_in(v, 0)[i];
	int status = volumes ? pm_overlap(&g, NULL, x->count, place, volumes, H) : -PM_DATA;
	pm_free(volumes);
	return status;
}
