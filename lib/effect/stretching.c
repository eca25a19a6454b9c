/* Stretching: vortex lines tilted and stretched by the flow, d alpha/dt = (alpha . grad) u; zero in 2-D. In 3-D it changes strengths
 * by |grad u| T. Source: Cottet and Koumoutsakos 2000, section 3.1. SPDX-License-Identifier: GPL-3.0-or-later */
#include <stdio.h>

#include "effect-parts/effect-decision.h"

static void decide(const struct pm_effect_case *c, struct pm_decision *d)
{
	const struct pm_scales *s = c->scales;
	const double share = s->strain * s->time;
	if (s->kind != PM_VORTICES) {
		pm_effect_off(d, "no vorticity");
		return;
	}
	if (s->dim < 3) {
		pm_effect_off(d, "2-D");
		return;
	}
	pm_effect_by(d, s, share, share);
	snprintf(d->text, sizeof d->text, "|grad u| T = %.2g", share);
}

const struct pm_effect effect_stretching = {
	.name = "stretching",
	.sentence = "vortex lines stretched by the flow",
	.source = "Cottet and Koumoutsakos 2000, section 3.1",
	.word = "stretch",
	.decide = decide,
};
