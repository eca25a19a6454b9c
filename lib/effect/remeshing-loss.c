/* Loss by remeshing: interpolation to the nodes by m6prime flattens what is only a few cells wide. The largest vorticity changes by (h k)^5/2 in a run, k^2 =
 * |lap omega|/|omega|: the order of the kernel, and a factor measured with planned runs (docs/plan.md). Below h k = 0.5 the l2 norm of the vorticity
 * changes by more, 0.15 (h k)^2.7, for flanks are less smooth than tops (cone-vortex, h k = 0.25 and 0.32: 0.0035, 0.0049; shear-layer, 0.29: 0.0058).
 * The particles are the nodes of the frame's mesh, so only the frame can have more. Source: Koumoutsakos 1997, J. Comput. Phys. 138, 821.
 * SPDX-License-Identifier: GPL-3.0-or-later */
#include <stdio.h>
#include <string.h>

#include "effect-parts/effect-decision.h"
#include "effect-parts/effect-words.h"

static void decide(const struct pm_effect_case *c, struct pm_decision *d)
{
	const struct pm_scales *s = c->scales;
	const double hk = s->h * sqrt(s->rough);
	if (s->kind != PM_VORTICES || s->pairs || s->singular || isnan(hk) || !pm_effect_in(c, "remeshing")) {
		pm_effect_off(d, "nothing is remeshed");
		return;
	}
	pm_effect_by(d, s, hk, fmin(1, fmax(0.5 * pow(hk, 5), 0.15 * pow(hk, 2.7))));
	d->answer = d->share > s->accuracy ? PM_PUT_IN : PM_LEFT_OUT; /* not half of it: the spacing is the user's */
	snprintf(d->text, sizeof d->text, "h k = %.2g: remeshing changes the vorticity by %.1g", hk, d->share);
	if (d->answer == PM_PUT_IN) /* the spacing that would suffice */
		snprintf(d->text + strlen(d->text), sizeof d->text - strlen(d->text), ", more than asked for (pinit --cells %.0f)",
			ceil(s->box / s->h * hk / fmin(pow(2 * s->accuracy, 0.2), pow(s->accuracy / 0.15, 1 / 2.7))));
}

const struct pm_effect effect_remeshing_loss = {
	.name = "remeshing-loss",
	.sentence = "what remeshing flattens",
	.source = "Koumoutsakos 1997",
	.numerical = true,
	.decide = decide,
};
