/* Self field: what the particles do to each other. Within the time T of the run it changes velocities by a T over the speeds that there are; and what is small
 * may grow, at most at the frequency omega of all of them together (plasma, Jeans), so it may be left out only where (omega T)^2/2 is small too. Vortices have
 * no inertia: u T over their distance. Forces that cancel to rounding (a lattice) may grow as cosh(omega T) at most. Assumes that the force of the frame was
 * measured. Source: Birdsall and Langdon 1985, section 4-2; Binney and Tremaine 2008, section 5.2. SPDX-License-Identifier: GPL-3.0-or-later */
#include "effect/effect.h"

static const char *symbol(const struct pm_scales *s) { return s->kind == PM_CHARGES ? "omega_p" : "sqrt(4 pi G rho)"; }

static void vortices(const struct pm_scales *s, struct pm_decision *d)
{
	const double moved = s->self * s->time / s->spacing;
	effect_by(d, s, moved, moved);
	snprintf(d->text, sizeof d->text, "u T is %.2g distances of neighbours", moved);
	d->kept = d->answer == PM_LEFT_OUT; /* nothing else moves them */
	d->answer = PM_PUT_IN;
}

static void decide(const struct pm_scales *s, struct pm_decision *d)
{
	const double phase = s->omega * s->time;
	if (s->kind == PM_NO_FIELD || s->kind == PM_CARRIED) {
		effect_off(d, "the law has none");
		return;
	}
	if (s->kind == PM_VORTICES && !s->second) {
		vortices(s, d);
		return;
	}
	if (s->sources < 2 && !s->walls) {
		effect_off(d, s->sources < 1 ? "no particle has a strength" : "one particle, and no particle moves itself");
		return;
	}
	const double gain = s->self * s->time, part = gain / (gain + s->v_rms);
	effect_by(d, s, phase, fmax(0.5 * phase * phase, part));
	d->kept = d->answer == PM_PUT_IN && part <= s->accuracy;
	snprintf(d->text, sizeof d->text, "%s T = %.2g, changes speeds by %.1g%s", symbol(s), phase, part, d->kept ? " and may grow" : "");
	if (effect_cancels(s)) {
		effect_off(d, "");
		d->number = s->self / (s->omega * s->omega * s->spacing);
		snprintf(d->text, sizeof d->text, "forces cancel to %.1g, and grow by cosh(%s T) = %.1g at most", d->number, symbol(s), cosh(fmin(phase, 700)));
	}
}

const struct pm_effect effect_self_field = {
	.name = "self-field",
	.sentence = "the field that the particles make together",
	.source = "Birdsall and Langdon 1985, section 4-2",
	.decide = decide,
};
