/* Currents: moving charges make a magnetic field, whose force on others is (v/c)^2 of the electric one. c is a constant of the frame; without it the
 * law is taken to be electrostatic. Source: Birdsall and Langdon 1985, section 15-1. SPDX-License-Identifier: GPL-3.0-or-later */
#include <stdio.h>

#include "effect-parts/effect-decision.h"

static void decide(const struct pm_effect_case *c, struct pm_decision *d)
{
	const struct pm_scales *s = c->scales;
	const double beta = s->v_max / s->c;
	if (s->kind != PM_CHARGES) {
		pm_effect_off(d, "no charges");
		return;
	}
	if (isnan(s->c)) {
		pm_effect_off(d, "electrostatic: the frame has no speed of light c");
		return;
	}
	if (s->light) {
		pm_effect_by(d, s, beta, fmax(beta * beta, s->magnetic));
		d->brought = true;
		snprintf(d->text, sizeof d->text, "(v/c)^2 = %.1g, B has %.1g of the energy%s", beta * beta, s->magnetic, d->answer == PM_PUT_IN ? ""
			: "; the law has them (without: sel --drop E,B | smod --law electrostatic | plan)");
		return;
	}
	pm_effect_by(d, s, beta, beta * beta);
	snprintf(d->text, sizeof d->text, "(v/c)^2 = %.1g of the electric force%s", beta * beta, d->answer != PM_PUT_IN ? ""
		: " (with them: smod --law electromagnetic | p2m | maxwell --gauss | plan)");
}

const struct pm_effect effect_currents = {
	.name = "currents",
	.sentence = "the magnetic field of moving charges",
	.source = "Birdsall and Langdon 1985, section 15-1",
	.word = "maxwell",
	.decide = decide,
};
