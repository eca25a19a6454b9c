/* f(a, b, ...) = sum of the weights of particles around (a, b, ...) over the volume of a cell, spread with a kernel of p2m, so that f integrates to the sum of
 * the weights. An axis that is a coordinate of a periodic box is periodic; at the ends of others f is continued evenly. Cost: that of a spread.
 * Source: Hockney and Eastwood 1988, section 5-3. SPDX-License-Identifier: GPL-3.0-or-later */
#include <stdio.h>
#include <string.h>

#include "measure/phase-space.h"
#include "stream/declare.h"
#include "stream/join.h"
#include "transfer/transfer.h"

/* The axis of the frame that an expression is; -1 none. */
static int coordinate(const struct pm_frame *f, const char *text)
{
	return strlen(text) == 1 && *text >= 'x' && *text - 'x' < f->dim ? *text - 'x' : -1;
}

int pm_phase_declare(const struct pm_phase_choice *c, struct pm_frame *f, struct pm_phase_sets *sets)
{
	char text[4096];
	sets->n = 0;
	if (c->set && !pm_frame_set(f, c->set))
		return pm_fail(PM_DATA, "no set '%s' (sls lists them)", c->set);
	for (size_t i = 0; i < f->nsets; i++) {
		const struct pm_set *set = f->sets[i];
		struct pm_phase_set *s = &sets->set[sets->n];
		if (c->set ? strcmp(c->set, set->name) : !set->n)
			continue;
		if (sets->n == (int)(sizeof sets->set / sizeof *sets->set))
			return pm_fail(PM_DATA, "more than %d sets (choose one: --set)", sets->n);
		const char *weight = c->weight ? c->weight : pm_frame_field(f, set->name, "mass") ? "mass" : "1";
		int n = 0;
		for (int d = 0; d < c->axes && n < (int)sizeof text; d++)
			n += snprintf(text + n, sizeof text - (size_t)n, "%s, ", c->axis[d]);
		if (n >= (int)sizeof text || (size_t)snprintf(text + n, sizeof text - (size_t)n, "%s", weight) >= sizeof text - (size_t)n)
			return pm_fail(PM_USAGE, "the expressions are too long");
		int status = pm_expression_compile(&s->e, f, set->name, text);
		if (status)
			return status;
		if (s->e.nparts != c->axes + 1)
			return pm_fail(PM_USAGE, "an axis is one expression, without commas");
		sets->n++;
	}
	return sets->n ? 0 : pm_fail(PM_DATA, "no set has particles (species and pinit make them)");
}

/* The box rounded outwards to a tenth of the power of ten below its width; of coordinates that of the frame. */
static int limits(const struct pm_phase_choice *c, const struct pm_frame *f, size_t n, double *const x[], double lo[3], double hi[3])
{
	for (int d = 0; d < c->axes; d++) {
		const int axis = coordinate(f, c->axis[d]);
		double least = INFINITY, most = -INFINITY;
		for (size_t i = 0; i < n; i++)
			least = fmin(least, x[d][i]), most = fmax(most, x[d][i]);
		const double width = most > least ? most - least : fmax(fabs(least), 1), unit = 0.1 * pow(10, floor(log10(width)));
		lo[d] = c->box ? c->box[d] : axis >= 0 ? f->lo[axis] : n ? unit * (floor(least / unit) - 1) : 0;
		hi[d] = c->box ? c->box[c->axes + d] : axis >= 0 ? f->hi[axis] : n ? unit * (ceil(most / unit) + 1) : 1;
		if (!(hi[d] > lo[d]))
			return pm_fail(PM_DATA, "the axis '%s' goes from %g to %g (--box gives all low ends, then all high ones)", c->axis[d], lo[d], hi[d]);
	}
	return 0;
}

/* What is left of the frame: its time, and a box of the axes. */
static void bare(const struct pm_phase_choice *c, struct pm_frame *f, const bool periodic[3], const double lo[3], const double hi[3])
{
	while (f->nsets)
		pm_frame_remove(f, f->sets[0]->name);
	while (f->nmeshes)
		pm_frame_remove(f, f->meshes[0]->name);
	snprintf(f->law, sizeof f->law, "free");
	json_object_clear(f->constants);
	f->dim = c->axes;
	for (int d = 0; d < c->axes; d++) {
		f->lo[d] = lo[d], f->hi[d] = hi[d];
		for (int side = 0; side < 2; side++) {
			f->face[d][side] = periodic[d] ? PM_PERIODIC : PM_NEUMANN;
			f->pface[d][side] = periodic[d] ? PM_PFOLD : PM_POPEN;
		}
	}
}

static int spread(const struct pm_phase_choice *c, struct pm_frame *f, size_t n, double *const x[], const double *weight, uint64_t *outside)
{
	const size_t cells[3] = {c->cells[0], c->axes > 1 ? c->cells[1] : 1, c->axes > 2 ? c->cells[2] : 1};
	struct pm_mesh *mesh = pm_frame_mesh_new(f, "phase", cells);
	struct pm_field *field = mesh ? pm_makes(f, "phase", "f", 1, PM_STATE) : NULL;
	struct pm_strays strays = {.count = 0};
	if (!field || pm_field_ready(field))
		return -PM_DATA;
	const struct pm_transfer t = {.grid = pm_grid_of(f, mesh), .kernel = c->kernel, .components = 1};
	double *out = pm_out(field, 0);
	int status = pm_spread(&t, n, (const double *const *)x, &weight, &out, &strays);
	*outside = strays.count;
	return status;
}

int pm_phase_frame(const struct pm_phase_choice *c, const struct pm_phase_sets *sets, struct pm_frame *f, uint64_t *outside)
{
	size_t n = 0, at = 0;
	double lo[3], hi[3], *x[4] = {NULL};
	bool periodic[3] = {false};
	for (int i = 0; i < sets->n; i++)
		n += pm_frame_set(f, sets->set[i].e.on)->n;
	x[0] = pm_alloc((size_t)(c->axes + 1) * n + 1, sizeof **x);
	if (!x[0])
		return -PM_DATA;
	for (int d = 1; d <= c->axes; d++)
		x[d] = x[0] + (size_t)d * n;
	for (int i = 0; i < sets->n; i++) {
		const struct pm_expression *e = &sets->set[i].e;
		const size_t count = pm_frame_set(f, e->on)->n;
		for (int d = 0; d <= c->axes; d++)
			pm_expression_eval(e, f, d, count, x[d] + at);
		at += count;
	}
	int status = 0;
	for (int d = 0; d <= c->axes && !status; d++)
		if (!pm_finite(n, x[d]))
			status = pm_fail(PM_NUMERICS, "'%s' is not finite for every particle", d < c->axes ? c->axis[d] : "the weight");
	status = status ? status : limits(c, f, n, x, lo, hi);
	for (int d = 0; d < c->axes && !status; d++) {
		const int axis = coordinate(f, c->axis[d]);
		periodic[d] = axis >= 0 && f->face[axis][0] == PM_PERIODIC && lo[d] == f->lo[axis] && hi[d] == f->hi[axis];
	}
	if (!status) {
		bare(c, f, periodic, lo, hi);
		status = spread(c, f, n, x, x[c->axes], outside);
	}
	pm_free(x[0]);
	return status;
}
