/* Diffusion: viscosity spreads vorticity, D omega/Dt = nu lap omega. Within the time T it changes omega by nu T |lap omega|/|omega|, both in l2 on the
 * mesh; nu dt/h^2 is its part of a step. Points, which have no mesh, walk sqrt(2 nu T) while the flow takes them u T.
 * Source: Cottet and Koumoutsakos 2000, chapter 5; Chorin 1973, J. Fluid Mech. 57, 785. SPDX-License-Identifier: GPL-3.0-or-later */
#include "effect/effect.h"

static void decide(const struct pm_scales *s, struct pm_decision *d)
{
	const double step = s->nu * fabs(s->dt) / (s->h * s->h), walked = sqrt(2 * s->nu * s->time) / (s->self * s->time);
	if (s->kind != PM_VORTICES) {
		effect_off(d, "the law has no viscosity");
		return;
	}
	if (!(s->nu > 0)) {
		effect_off(d, "nu = 0");
		return;
	}
	effect_by(d, s, s->pairs ? walked : step, s->pairs ? fmin(1, walked) : s->nu * s->time * s->rough);
	if (s->pairs)
		snprintf(d->text, sizeof d->text, "sqrt(2 nu T) = %.2g of the way with the flow", walked);
	else
		snprintf(d->text, sizeof d->text, "nu dt/h^2 = %.2g, changes omega by %.1g", step, d->share);
}

const struct pm_effect effect_diffusion = {
	.name = "diffusion",
	.sentence = "viscosity spreads what vortices carry",
	.source = "Cottet and Koumoutsakos 2000, chapter 5",
	.word = "diffuse",
	.decide = decide,
};
