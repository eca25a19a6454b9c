/* An antenna: the current K = -2 eps0 c E0(t) in a sheet sends the wave E0(t - |x - a|/c) to both sides, by the jump of B across it, mu0 K. On the mesh the
 * sheet is one plane of nodes, where E along the sheet sits, and J = K/h at the middle of the step. Of order 2 in h and dt. Where E0 changes along its own
 * direction the current leaves charge in the sheet, as a real one does.
 * Source: Jackson 1999, section 7.4 and problem 7.4; Taflove and Hagness 2005, 5.2. Cost: an expression per node of the plane.
 * SPDX-License-Identifier: GPL-3.0-or-later */
#include <stdio.h>
#include <string.h>

#include "law/law.h"
#include "maxwell-step/antenna.h"
#include "maxwell-step/maxwell-frame.h"
#include "stream/declare.h"

enum { TIME = 3, FIXED };

static int slot(void *context, const char *name)
{
	struct pm_antenna *a = context;
	const double value = pm_frame_constant(a->f, name, NAN);
	int k = 0;
	while (k < a->n && strcmp(a->name[k], name))
		k++;
	if (k < a->n)
		return k + 1;
	if (isnan(value) || a->n == PM_ANTENNA_NAMES || strlen(name) >= PM_NAME)
		return 0;
	snprintf(a->name[a->n], PM_NAME, "%s", name);
	a->number[a->n++] = value;
	return a->n;
}

static int read_wave(const struct pm_antenna_choice *c, struct pm_antenna *a, const char *text)
{
	char name[PM_NAME];
	const char *expression;
	int status = pm_expression_named(text, name, &expression);
	const int k = name[0] == 'E' && name[1] >= 'x' && name[1] <= 'z' && !name[2] ? name[1] - 'x' : -1;
	if (status)
		return status;
	if (k < 0 || a->sends[k])
		return pm_fail(PM_USAGE, "'%s' is not 'Ex = EXPRESSION', 'Ey = ...' or 'Ez = ...', each once", text);
	if (k == c->axis)
		return pm_fail(PM_USAGE, "light that goes along %c has no E%c (--axis)", "xyz"[k], "xyz"[k]);
	a->sends[k] = true;
	return pm_expression_compile_numbers(&a->wave[k], slot, a, "coordinate or constant", expression);
}

static int place(const struct pm_antenna_choice *c, const struct pm_frame *f, const struct pm_mesh *m, struct pm_antenna *a)
{
	const int d = c->axis;
	const bool layer = pm_yee_open(f->face[d][0]);
	const double at = isnan(c->place) ? m->lo[d] + (PM_ANTENNA_LAYERS + 2) * m->h[d] : c->place, node = floor((at - m->lo[d]) / m->h[d] + 0.5);
	if (isnan(c->place) && !layer)
		return pm_fail(PM_USAGE, "the face below along %c is not open: give the place of the sheet (--place X)", "xyz"[d]);
	if (!(node >= 0 && node < (double)a->yee.grid.points[d]))
		return pm_fail(PM_USAGE, "the sheet at %c = %g is outside the mesh '%s' (--place)", "xyz"[d], at, m->name);
	a->plane = (size_t)node;
	return 0;
}

int pm_antenna_declare(const struct pm_antenna_choice *c, struct pm_frame *f, struct pm_antenna *a)
{
	const struct pm_law *law = pm_law_of(f);
	const struct pm_mesh *m = pm_frame_mesh(f, c->mesh);
	if (!law)
		return -PM_DATA;
	if (!law->evolves)
		return pm_fail(PM_DATA, "the law '%s' has no light (smod --law electromagnetic)", f->law);
	if (!m)
		return pm_fail(PM_DATA, "no mesh%s%s (p2m -n CELLS makes one)", c->mesh ? " " : "", c->mesh ? c->mesh : "");
	if (c->axis >= f->dim)
		return pm_fail(PM_DATA, "a sheet across %c in %d-D (--axis)", "xyz"[c->axis], f->dim);
	*a = (struct pm_antenna){.yee = pm_yee_of(f, m), .f = f, .axis = c->axis};
	static const char *const first[FIXED] = {"x", "y", "z", "time"};
	for (a->n = 0; a->n < FIXED; a->n++)
		snprintf(a->name[a->n], PM_NAME, "%s", first[a->n]);
	int status = 0;
	for (int i = 0; i < c->waves && !status; i++)
		status = read_wave(c, a, c->wave[i]);
	status = status ? status : place(c, f, m, a);
	if (status)
		return status;
	const struct pm_field *E = pm_frame_field(f, m->name, law->field);
	const struct pm_field *J = pm_frame_field(f, m->name, "J");
	a->made = !J;
	for (int i = 0; J && i < J->nterms; i++)
		if (!strcmp(J->terms[i], c->term))
			return pm_fail(PM_DATA, "'J' on mesh '%s' already holds the term '%s' (--term names a second one)", m->name, c->term);
	a->current = pm_contributes(f, m->name, "J", law->field, 3, c->term, false);
	if (!a->current)
		return -PM_DATA;
	for (int d = 0; d < f->dim && a->made; d++)
		a->current->staggered[d][d] = 1;
	if (a->made) {
		snprintf(a->current->kernel, sizeof a->current->kernel, "%s", E && *E->kernel ? E->kernel : law->kernel);
		snprintf(a->current->unit, sizeof a->current->unit, "charge/(time length^%d)", f->dim - 1);
	}
	if (pm_yee_staggered(a->current, f->dim, true))
		return 0;
	return pm_fail(PM_DATA, "'J' on mesh '%s' does not sit where E does (p2m --current makes it)", m->name);
}

/* Point number i of the sheet, and its coordinates where component c of E sits. */
static size_t point(const struct pm_antenna *a, size_t i, int c, double x[3])
{
	const struct pm_grid *g = &a->yee.grid;
	size_t at[3], rest = i;
	for (int d = 0; d < 3; d++) {
		at[d] = d == a->axis ? a->plane : rest % g->points[d];
		rest /= d == a->axis ? 1 : g->points[d];
		x[d] = d < g->dim ? g->lo[d] + ((double)at[d] + (d == c ? 0.5 : 0)) * g->h[d] : 0;
	}
	return at[0] + g->points[0] * (at[1] + g->points[1] * at[2]);
}

int pm_antenna_add(struct pm_antenna *a, const struct pm_frame *f)
{
	const struct pm_grid *g = &a->yee.grid;
	const size_t n = pm_grid_size(g), plane = n / g->points[a->axis];
	const double factor = -2 * a->yee.eps0 * a->yee.c / g->h[a->axis];
	a->number[TIME] = f->time + 0.5 * f->dt;
	for (int c = 0; c < 3; c++) {
		double *J = pm_out(a->current, c), x[3];
		if (a->made)
			memset(J, 0, n * sizeof *J);
		for (size_t i = 0; i < plane && a->sends[c]; i++) {
			const size_t k = point(a, i, c, x);
			memcpy(a->number, x, sizeof x);
			const double e = pm_expression_number(&a->wave[c], a->number);
			if (!isfinite(e))
				return pm_fail(PM_NUMERICS, "E%c of the antenna is %g at (%g, %g, %g), time %g", "xyz"[c], e, x[0], x[1], x[2],
					a->number[TIME]);
			J[k] += factor * e;
		}
	}
	return 0;
}
