/* More cells or a smoother kernel where an error of the method exceeds the accuracy: the cheapest for which the force and all such errors are small enough.
 * Up to 20 times the cost of a step; where nothing suffices the method stays, and the effect says so.
 * SPDX-License-Identifier: GPL-3.0-or-later */
#include <stdio.h>
#include <string.h>

#include "planner/force-error.h"
#include "planner/plan.h"

struct choice {
	const char *kernel, *order, *symbol;
	double error; /* of the force, by the atlas */
};

/* The largest share of the effects that can say theirs for another method. */
static double worst(const struct pm_frame *f, const struct pm_plan *p)
{
	struct pm_effect_case c;
	double most = 0;
	for (int i = 0; i < p->neffects; i++)
		if (p->effect[i].effect->share) {
			pm_plan_case(f, p, i, &c);
			most = fmax(most, p->effect[i].effect->share(&c));
		}
	return most;
}

static bool tries(const struct pm_frame *f, struct pm_plan *p, const struct choice *k, int factor)
{
	struct pm_plan q = *p;
	q.scales.h /= factor, q.scales.points *= pow(factor, q.scales.dim);
	q.method.kernel = k->kernel, q.method.order = k->order, q.method.symbol = k->symbol;
	if (worst(f, &q) > 0.5 * p->scales.accuracy)
		return false;
	for (int d = 0; d < f->dim; d++)
		q.method.cells[d] = factor > 1 ? (size_t)factor * (p->method.cells[d] ? p->method.cells[d] : f->meshes[0]->cells[d]) : p->method.cells[d];
	q.scales.mesh_error = fmin(k->error, p->scales.mesh_error);
	*p = q;
	return true;
}

/* With light: is energy kept by m2p --energy-conserving? It is for Yee's mesh; a beam near the speed of light would radiate more with short
 * steps (docs/methods/maxwell.md), so that it keeps m2p. */
static bool keeps_energy(const struct pm_frame *f, const struct pm_plan *p)
{
	const struct pm_field *e = p->scales.light ? pm_frame_field(f, f->meshes[0]->name, p->law->field) : NULL;
	return e && e->staggered[0][0] && !(p->scales.drift > 0.9 * p->scales.c);
}

static void say(struct pm_plan *p, const char *what, const char *more)
{
	const size_t at = strlen(p->method.why_mesh);
	snprintf(p->method.why_mesh + at, sizeof p->method.why_mesh - at, "; %s%s against grid heating", what, more);
}

void pm_plan_cure(const struct pm_frame *f, struct pm_plan *p)
{
	const struct pm_scales *s = &p->scales;
	const char *spectral = p->law->symbol && strcmp(p->law->symbol, "spectral") ? "spectral" : NULL;
	const struct choice choice[] = {{p->method.kernel, p->method.order, p->method.symbol, s->mesh_error}, {"tsc", "4", spectral, NAN},
		{"pcs", "4", spectral, NAN}};
	if (s->pairs || !f->nmeshes || s->kind == PM_VORTICES || !(s->length > 0 || s->light) || worst(f, p) <= 0.5 * s->accuracy)
		return;
	p->method.conserving = keeps_energy(f, p);
	if (p->method.conserving)
		say(p, "m2p --energy-conserving", "");
	for (int factor = 1; factor <= (s->light ? 1 : 4096); factor *= 2) /* the mesh of light is the frame's */
		for (int i = 0; i < 3; i++) {
			struct choice k = choice[i];
			struct pm_plan q = *p;
			q.scales.h /= factor, q.scales.points *= pow(factor, s->dim);
			if (factor > 1 && (q.scales.points > 3e7 || pm_plan_cost_mesh(&q.scales) > 20 * pm_plan_cost_mesh(s)))
				return;
			const struct pm_atlas_force row = {.scene = "smooth", .solver = "poisson-fft", .kernel = k.kernel, .gradient = k.order};
			if (i)
				k.error = pm_force_error(&q.scales, &row, q.scales.h / s->length, 1);
			if (i && !(k.error <= fmax(pm_force_allowed(s), s->mesh_error)))
				continue;
			if (tries(f, p, &k, factor)) {
				if (i || factor > 1)
					say(p, i ? k.kernel : "", factor > 1 ? i ? " and more cells" : "more cells" : "");
				return;
			}
		}
}
