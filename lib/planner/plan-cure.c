/* More cells or a smoother kernel where an error of the method exceeds the accuracy: the cheapest for which the force and all such errors are small enough.
 * Up to 20 times the cost of a step; where nothing suffices the method stays, and the effect says so.
 * SPDX-License-Identifier: GPL-3.0-or-later */
#include <string.h>

#include "planner/force-error.h"
#include "planner/plan.h"

struct choice {
	const char *kernel, *order, *symbol;
	double error; /* of the force, by the atlas */
	bool conserving;
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
	q.method.conserving = k->conserving;
	if (worst(f, &q) > 0.5 * p->scales.accuracy)
		return false;
	for (int d = 0; d < f->dim; d++)
		q.method.cells[d] = factor > 1 ? (size_t)factor * (p->method.cells[d] ? p->method.cells[d] : f->meshes[0]->cells[d]) : p->method.cells[d];
	q.scales.mesh_error = fmin(k->error, p->scales.mesh_error);
	*p = q;
	return true;
}

/* E and B on Yee's mesh, of which m2p --energy-conserving is. */
static bool is_yee(const struct pm_frame *f, const struct pm_plan *p)
{
	const struct pm_field *e = p->scales.light && f->nmeshes ? pm_frame_field(f, f->meshes[0]->name, p->law->field) : NULL;
	return e && e->staggered[0][0];
}

void pm_plan_cure(const struct pm_frame *f, struct pm_plan *p)
{
	const struct pm_scales *s = &p->scales;
	const char *spectral = p->law->symbol && strcmp(p->law->symbol, "spectral") ? "spectral" : NULL;
	const struct choice same = {p->method.kernel, p->method.order, p->method.symbol, s->mesh_error, is_yee(f, p)};
	const struct choice choice[] = {{same.kernel, same.order, same.symbol, same.error, false}, same, {"tsc", "4", spectral, NAN, same.conserving},
		{"pcs", "4", spectral, NAN, same.conserving}};
	if (s->pairs || !f->nmeshes || s->kind == PM_VORTICES || !(s->length > 0 || same.conserving) || worst(f, p) <= 0.5 * s->accuracy)
		return;
	for (int factor = 1; factor <= (s->length > 0 ? 4096 : 1); factor *= 2)
		for (int i = 0; i < 4; i++) {
			struct choice k = choice[i];
			struct pm_plan q = *p;
			q.scales.h /= factor, q.scales.points *= pow(factor, s->dim);
			if (factor > 1 && (q.scales.points > 3e7 || pm_plan_cost_mesh(&q.scales) > 20 * pm_plan_cost_mesh(s)))
				return;
			const bool other = i > 1;
			if (i == 1 && !same.conserving)
				continue;
			const struct pm_atlas_force row = {.scene = "smooth", .solver = "poisson-fft", .kernel = k.kernel, .gradient = k.order};
			if (other)
				k.error = pm_force_error(&q.scales, &row, q.scales.h / s->length, 1);
			if (other && !(k.error <= fmax(pm_force_allowed(s), s->mesh_error)))
				continue;
			if (tries(f, p, &k, factor)) {
				const size_t at = strlen(p->method.why_mesh);
				snprintf(p->method.why_mesh + at, sizeof p->method.why_mesh - at, "; %s%s against grid heating",
					other ? k.kernel : k.conserving ? "m2p --energy-conserving" : "",
					factor > 1 ? i ? " and more cells" : "more cells" : "");
				return;
			}
		}
}
