/* Diffusion: viscosity spreads vorticity, D omega/Dt = nu lap omega. Within the time T it changes omega by nu T |lap omega|/|omega|, both in l2 on the
 * mesh; nu dt/h^2 is its diffusion number per step. Points, which have no mesh, walk sqrt(2 nu T) while the flow moves them u T.
 * Source: Cottet and Koumoutsakos 2000, chapter 5; Chorin 1973, J. Fluid Mech. 57, 785. SPDX-License-Identifier: GPL-3.0-or-later */
#include <stdio.h>

#include "effect-parts/effect-decision.h"
#include "effect-parts/effect-words.h"
#include "law/law.h"

static void decide(const struct pm_effect_case *c, struct pm_decision *d)
{
	const struct pm_scales *s = c->scales;
	const double step = s->nu * fabs(s->dt) / (s->h * s->h), walked = sqrt(2 * s->nu * s->time) / (s->self * s->time);
	if (s->kind != PM_VORTICES) {
		pm_effect_off(d, "the law has no viscosity");
		return;
	}
	if (!(s->nu > 0)) {
		pm_effect_off(d, "nu = 0");
		return;
	}
	pm_effect_by(d, s, s->pairs ? walked : step, s->pairs ? fmin(1, walked) : s->nu * s->time * s->rough);
	if (s->pairs)
		snprintf(d->text, sizeof d->text, "sqrt(2 nu T) is %.2g of the distance moved with the flow", walked);
	else
		snprintf(d->text, sizeof d->text, "nu dt/h^2 = %.2g, changes omega by %.1g", step, d->share);
}

static void words(const struct pm_effect_case *c, struct pm_words *w)
{
	if (c->decision->answer != PM_PUT_IN)
		return;
	if (c->method->pairs) {
		pm_words_add(w, PM_SLOT_AFTER, "walk", "diffusion: on, %s", c->decision->text);
		return;
	}
	pm_words_add(w, PM_SLOT_MESH, "diffuse", "diffusion: on, %s", c->decision->text);
	pm_words_amend(w, PM_SLOT_PARTICLES, "m2p", "", ", and the change of their strengths by diffusion");
}

static bool asked(const struct pm_frame *f, const struct pm_law *law, char what[64])
{
	const double nu = law->of_potential == PM_CURL && law->strength ? pm_frame_constant(f, "nu", 0) : 0;
	snprintf(what, 64, "nu = %g", nu);
	return nu > 0;
}

static bool reversible(const struct pm_effect_case *c) { return c->scales->kind == PM_VORTICES && c->scales->nu > 0; }

/* On the mesh compare strengths after one step: later the particles are distorted, and the resulting noise would diffuse too. */
static void test(const struct pm_effect_case *c, struct pm_effect_test *t)
{
	t->of = c->method->pairs ? PM_TEST_WALK : PM_TEST_STRENGTH;
	t->steps = c->method->pairs ? t->steps : 1;
}

const struct pm_effect effect_diffusion = {
	.name = "diffusion",
	.sentence = "viscosity spreads vorticity",
	.source = "Cottet and Koumoutsakos 2000, chapter 5",
	.word = "diffuse",
	.asked = asked,
	.done_by = (const char *const[]){"diffuse", "pse", "walk", NULL},
	.decide = decide,
	.words = words,
	.reversible = reversible,
	.test = test,
};
