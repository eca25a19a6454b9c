/* Boundary layer of a body on the mesh: its thickness delta = sqrt(nu D/U) beside the spacing. The error of the drag is 0.2 (h/delta)^1.75 by three runs of
 * the cylinder at Re = 100, 0.148, 0.089, 0.044 too large at h/delta = 0.83, 0.63, 0.42; the cavity's velocities are within a factor of two of it, the
 * sphere's drag is less by a factor of two to three (docs/methods/penalize.md). Source: Schlichting and Gersten 2017, Boundary-Layer Theory, section 2.2.
 * SPDX-License-Identifier: GPL-3.0-or-later */
#include <stdio.h>
#include <string.h>

#include "effect-parts/body-in-flow.h"
#include "effect-parts/effect-decision.h"
#include "effect-parts/effect-words.h"

static const double factor = 0.2, power = 1.75;

/* own: delta. */
static int measure(const struct pm_effect_case *c, const struct pm_effect_run *run, double own[PM_EFFECT_OWN])
{
	(void)run;
	if (c->scales->kind == PM_VORTICES && !c->scales->pairs && c->frame->nmeshes)
		own[0] = pm_effect_layer_thickness(c->frame, c->scales->nu, c->scales->self);
	return 0;
}

static void decide(const struct pm_effect_case *c, struct pm_decision *d)
{
	const struct pm_scales *s = c->scales;
	const double cells = c->own[0] / s->h;
	struct pm_scene_solid b;
	if (!(cells > 0)) {
		const bool body = s->kind == PM_VORTICES && pm_effect_body(c->frame, &b);
		pm_effect_off(d, s->kind != PM_VORTICES ? "no vorticity" : !body ? "no body on the mesh" : "no viscosity, or the body is not in the box");
		return;
	}
	pm_effect_by(d, s, cells, fmin(1, factor * pow(cells, -power)));
	d->answer = d->share > s->accuracy ? PM_PUT_IN : PM_LEFT_OUT; /* as for remeshing-loss, the spacing is the user's */
	snprintf(d->text, sizeof d->text, "the layer, sqrt(nu D/U) = %.2g, is %.2g cells: %.1g of the drag", c->own[0], cells, d->share);
	if (d->answer == PM_PUT_IN)
		snprintf(d->text + strlen(d->text), sizeof d->text - strlen(d->text), " (%.2g times the cells)",
			pow(factor / s->accuracy, 1 / power) / cells);
}

/* Of a body that the sentence has. */
static void reconsider(const struct pm_effect_case *c, struct pm_decision *d)
{
	if (d->answer == PM_PUT_IN && !pm_effect_in(c, "penalization"))
		pm_effect_off(d, "the body is left out");
}

const struct pm_effect effect_boundary_layer = {
	.name = "boundary-layer",
	.sentence = "a body's layer beside the cells",
	.source = "Schlichting and Gersten 2017, section 2.2",
	.numerical = true,
	.measure = measure,
	.decide = decide,
	.reconsider = reconsider,
};
