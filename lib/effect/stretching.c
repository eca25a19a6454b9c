/* Stretching: vortex lines turned and drawn out by the flow, d alpha/dt = (alpha . grad) u; there are no such lines in the plane. In space it changes strengths
 * by |grad u| T. Source: Cottet and Koumoutsakos 2000, section 3.1. SPDX-License-Identifier: GPL-3.0-or-later */
#include "effect/effect.h"

static void decide(const struct pm_scales *s, struct pm_decision *d)
{
	const double share = s->strain * s->time;
	if (s->kind != PM_VORTICES) {
		effect_off(d, "no vorticity");
		return;
	}
	if (s->dim < 3) {
		effect_off(d, "2-D");
		return;
	}
	effect_by(d, s, share, share);
	snprintf(d->text, sizeof d->text, "|grad u| T = %.2g", share);
}

const struct pm_effect effect_stretching = {
	.name = "stretching",
	.sentence = "vortex lines drawn out by the flow",
	.source = "Cottet and Koumoutsakos 2000, section 3.1",
	.word = "stretch",
	.decide = decide,
};
