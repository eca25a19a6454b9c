/* The derivatives in grad, curl, div and lap as a list of terms, and the cases that are errors.
 * SPDX-License-Identifier: GPL-3.0-or-later */
#include <string.h>

#include "fft/axis-transform.h"
#include "mesh/gradient-parts.h"
#include "world/world.h"

const char *const pm_operator_names[] = {"grad", "curl", "div", "lap", NULL};
const char *const pm_order_names[] = {"2", "4", "6", "spectral", NULL};

int pm_order_find(const char *name)
{
	static const int order[] = {2, 4, 6, 0};
	for (int i = 0; pm_order_names[i]; i++)
		if (!strcmp(name, pm_order_names[i]))
			return order[i];
	return pm_fail(PM_USAGE, "no order '%s' (choose 2, 4, 6 or spectral)", name), -1;
}

static void add(struct pm_operator *o, int out, int in, int axis, double sign)
{
	o->term[o->nterms++] = (struct pm_operator_term){.out = out, .in = in, .as = in, .axis = axis, .sign = sign};
}

static int faces(const struct pm_operator *o)
{
	const struct pm_grid *g = &o->grid;
	for (int d = 0; d < g->dim; d++) {
		size_t need = (size_t)(o->order + o->derivative);
		for (int side = 0; side < 2; side++) {
			if (g->face[d][side] == PM_ABSORBING)
				return pm_fail(PM_DATA, "absorbing faces belong to Maxwell's equations (mgrad takes periodic, wall, neumann or open faces)");
			if (g->face[d][side] == PM_OPEN && o->order && g->points[d] < need)
				return pm_fail(PM_DATA, "order %d at an open face needs %zu nodes, axis %c has %zu (choose a lower --order or more cells)",
					o->order, need, "xyz"[d], g->points[d]);
			if (g->face[d][side] == PM_OPEN && !o->order)
				return pm_fail(PM_DATA, "--order spectral needs periodic, wall or neumann faces, axis %c is open (choose --order 2, 4 or 6)",
					"xyz"[d]);
		}
	}
	return 0;
}

int pm_operator_init(struct pm_operator *o, const struct pm_grid *g, enum pm_operator_kind kind, int order, int in, bool flow)
{
	int dim = g->dim;
	*o = (struct pm_operator){.grid = *g, .kind = kind, .order = order, .in = in, .flow = flow, .derivative = kind == PM_OP_LAP ? 2 : 1};
	if (kind == PM_OP_GRAD && in == 1) {
		o->out = dim;
		for (int d = 0; d < dim; d++)
			add(o, d, 0, d, 1);
	} else if (kind == PM_OP_LAP && in <= 3) {
		o->out = in;
		for (int c = 0; c < in; c++)
			for (int d = 0; d < dim; d++)
				add(o, c, c, d, 1);
	} else if (kind == PM_OP_DIV && in == dim) {
		o->out = 1;
		for (int d = 0; d < dim; d++)
			add(o, 0, d, d, 1);
	} else if (kind == PM_OP_CURL && dim == 3 && in == 3) {
		o->out = 3;
		for (int c = 0; c < 3; c++) {
			add(o, c, (c + 2) % 3, (c + 1) % 3, 1);
			add(o, c, (c + 1) % 3, (c + 2) % 3, -1);
		}
	} else if (kind == PM_OP_CURL && dim == 2 && in == 1) {
		o->out = 2;
		add(o, 0, 0, 1, 1);
		add(o, 1, 0, 0, -1);
	} else if (kind == PM_OP_CURL && dim == 2 && in == 2) {
		o->out = 1;
		add(o, 0, 1, 0, 1);
		add(o, 0, 0, 1, -1);
	} else {
		return pm_fail(PM_DATA, "no %s of a field of %d components in %d-D (grad takes 1, div %d, lap 1 to 3%s)", pm_operator_names[kind], in, dim, dim,
			dim == 3 ? ", curl 3" : dim == 2 ? ", curl 1 or 2" : "");
	}
	return faces(o);
}

const char *const pm_stretch_names[] = {"conservative", "classical", "transpose", "mixed", NULL};

int pm_operator_stretch(struct pm_operator *o, const struct pm_grid *g, enum pm_stretch_form form, int component, int order)
{
	*o = (struct pm_operator){.grid = *g, .kind = PM_OP_DIV, .order = order, .in = 3, .out = form == PM_STRETCH_CONSERVATIVE ? 1 : 3, .flow = true,
		.derivative = 1};
	for (int d = 0; d < 3 && form == PM_STRETCH_CONSERVATIVE; d++) {
		add(o, 0, d, d, 1); /* omega_d is even where its axis has a wall, so the product has the images of u_c */
		o->term[d].as = component;
	}
	for (int c = 0; c < 3 && form != PM_STRETCH_CONSERVATIVE; c++)
		for (int d = 0; d < 3; d++) {
			const double share = form == PM_STRETCH_MIXED ? 0.5 : 1;
			if (form != PM_STRETCH_TRANSPOSE) {
				add(o, c, c, d, share);
				o->term[o->nterms - 1].by = 1 + d;
			}
			if (form != PM_STRETCH_CLASSICAL) {
				add(o, c, d, c, share);
				o->term[o->nterms - 1].by = 1 + d;
			}
		}
	return faces(o);
}

double pm_operator_fastest(const struct pm_operator *o)
{
	const double at_grid_frequency[] = {pm_pi * pm_pi, 4, 16.0 / 3, 272.0 / 45}; /* order 0 (spectral), 2, 4, 6 */
	double sum = 0;
	for (int k = 0; k < o->nterms; k++) {
		const double h = o->grid.h[o->term[k].axis];
		sum += o->term[k].out ? 0 : fabs(o->term[k].sign) * at_grid_frequency[o->order / 2] / (h * h);
	}
	return sum;
}

int pm_operator_plan(struct pm_operator *o, struct pm_fft_plans *p)
{
	struct pm_transform line;
	o->plans = p;
	for (int d = 0; d < o->grid.dim && !o->order; d++)
		if (pm_transform_init(p, o->grid.face[d], o->grid.cells[d], &line))
			return -PM_DATA;
	return 0;
}

int pm_operator_apply(const struct pm_operator *o, double factor, const double *const in[], double *const out[], bool *seen)
{
	bool here = false;
	int status = o->order ? pm_operator_differences(o, factor, in, out, &here) : pm_operator_spectral(o, factor, in, out);
	if (seen)
		*seen = here;
	return status;
}

int pm_operator_apply_planes(const struct pm_operator *o, double factor, const struct pm_field *field, const double *const in[], double *const out[],
	bool *seen)
{
	const double *with[PM_COMPONENTS];
	struct pm_operator here = *o;
	struct pm_planes planes;
	double *room = NULL;
	if (!field->here)
		return pm_operator_apply(o, factor, in, out, seen);
	int status = pm_planes_init(&planes, &o->grid, field);
	here.planes = &planes;
	if (!o->order) { /* lines cross the planes of ranks: all work together */
		status = pm_world_agree(status);
		status = status ? status : pm_operator_apply(&here, factor, in, out, seen);
		pm_planes_free(&planes);
		return status;
	}
	status = pm_planes_halo(status, &planes, status ? 0 : pm_operator_reach(o, &planes), o->in, in, with, &room);
	if (!status && planes.here)
		status = pm_operator_apply(&here, factor, with, out, seen);
	pm_free(room);
	pm_planes_free(&planes);
	return status;
}
