/* Numbers that a sentence states: its scheme and step, the cells of its mesh, and what a step of it costs. SPDX-License-Identifier: GPL-3.0-or-later */
#include <stdlib.h>
#include <string.h>

#include "planner/sentence-edit.h"
#include "step/step.h"

static const struct pm_edit_option dt = {"dt", 0}, tolerance = {"tolerance", 0}, cells = {"cells", 'n'};

static const struct pm_step *scheme(const struct pm_edit *e)
{
	const struct pm_step *found = NULL;
	for (int w = -1; (w = pm_edit_find(e, "push", w + 1)) >= 0 && !found;)
		for (int i = 0; pm_steps[i] && !found; i++)
			if (pm_steps[i]->kind == PM_SCHEME && pm_edit_says(e, w, pm_steps[i]->name))
				found = pm_steps[i];
	return found;
}

int pm_edit_passes(const struct pm_edit *e)
{
	const struct pm_step *s = scheme(e);
	return s ? s->passes : 1;
}

int pm_edit_order(const struct pm_edit *e)
{
	const struct pm_step *s = scheme(e);
	return s ? s->order : 2; /* kick/2, drift, kick/2, or with boris */
}

int pm_edit_setter(const struct pm_edit *e, char value[64])
{
	for (int w = -1; (w = pm_edit_find(e, "push", w + 1)) >= 0;)
		if (pm_edit_value(e, w, dt, value))
			return w;
	return -1;
}

int pm_edit_chooser(const struct pm_edit *e, char value[64])
{
	for (int w = -1; (w = pm_edit_find(e, "push", w + 1)) >= 0;)
		if (pm_edit_says(e, w, "ias15")) {
			if (!pm_edit_value(e, w, tolerance, value))
				snprintf(value, 64, "1e-9");
			return strtod(value, NULL) > 0 ? w : -1;
		}
	return -1;
}

double pm_edit_step(const struct pm_edit *e, const struct pm_frame *f)
{
	char value[64];
	return pm_edit_find(e, "dt", 0) >= 0 || pm_edit_chooser(e, value) >= 0 ? NAN : pm_edit_setter(e, value) >= 0 ? strtod(value, NULL) : f->dt;
}

bool pm_edit_cells(const struct pm_edit *e, const struct pm_frame *f, size_t n[3])
{
	char value[64], *end = value;
	const int w = pm_edit_find(e, "p2m", 0);
	if (w < 0)
		return false;
	n[0] = n[1] = n[2] = 1;
	if (!pm_edit_value(e, w, cells, value)) {
		if (!f->nmeshes)
			return false;
		memcpy(n, f->meshes[0]->cells, 3 * sizeof n[0]);
		return true;
	}
	for (int d = 0; d < f->dim; d++)
		n[d] = d && *end != 'x' ? n[d - 1] : strtoul(d ? end + 1 : value, &end, 10);
	return true;
}

double pm_edit_points(const struct pm_edit *e, const struct pm_frame *f)
{
	size_t n[3];
	return pm_edit_cells(e, f, n) ? (double)n[0] * (double)n[1] * (double)n[2] : 0;
}

/* Of one core, with all words of a sentence: a pair, a point of the mesh, a particle, a pass. */
static const double ns_pair = 0.39, ns_point = 40, ns_particle = 150, ns_pass = 2e4;

double pm_edit_cost(const struct pm_edit *e, const struct pm_frame *f, const struct pm_plan *p)
{
	const struct pm_scales *s = &p->scales;
	const double points = pm_edit_points(e, f), open = s->open ? pow(2, f->dim) : 1, slow = pm_edit_find(e, "poisson-mg", 0) >= 0 ? 4 : 1;
	const double pairs = pm_edit_find(e, "pp", 0) >= 0 ? ns_pair * s->n * s->sources : 0;
	return pm_edit_passes(e) * (ns_pass + ns_particle * s->n + ns_point * points * open * slow + pairs);
}
