/* Diffusion: viscosity spreads vorticity, D omega/Dt = nu lap omega. Within the time T it changes omega by nu T |lap omega|/|omega|, both in l2 on the
 * mesh; nu dt/h^2 is its part of a step. Source: Cottet and Koumoutsakos 2000, chapter 5. SPDX-License-Identifier: GPL-3.0-or-later */
#include "effect/effect.h"

static void decide(const struct pm_scales *s, struct pm_decision *d)
{
	const double step = s->nu * s->dt / (s->h * s->h), share = s->nu * s->time * (isnan(s->rough) ? 1 / (s->nearest * s->nearest) : s->rough);
	if (s->kind != PM_VORTICES) {
		effect_off(d, "the law has no viscosity");
		return;
	}
	if (!(s->nu > 0)) {
		effect_off(d, "nu = 0");
		return;
	}
	effect_by(d, s, step, share);
	snprintf(d->text, sizeof d->text, "nu dt/h^2 = %.2g, changes omega by %.1g", step, share);
}

const struct pm_effect effect_diffusion = {
	.name = "diffusion",
	.sentence = "viscosity spreads what vortices carry",
	.source = "Cottet and Koumoutsakos 2000, chapter 5",
	.word = "diffuse",
	.decide = decide,
};
