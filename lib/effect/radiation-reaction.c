/* Radiation reaction: an accelerated charge radiates, and loses the energy. Of the rate, tau gamma^2 (f^2 - (v.a)^2/c^2)/c^2 in units of m c^2 with f the force
 * over m without radiation and tau = |q/m| radiation_time, the fastest particle in the largest fields gives the part of the kinetic energy that is lost in the
 * run, x/(1 + x), x = tau gamma^2 f^2 T/(c^2 (gamma - 1)): exact at gamma >> 1 about B, where gamma falls as 1/(1/gamma_0 + tau omega_c^2 T); below
 * c 2 tau omega_c^2 T. The constant radiation_time asks for it; without, it is 0.
 * Source: Landau and Lifshitz 1975, section 76; Tamburini et al. 2010, New J. Phys. 12, 123005. SPDX-License-Identifier: GPL-3.0-or-later */
#include <stdio.h>

#include "effect-parts/effect-decision.h"
#include "effect-parts/effect-words.h"
#include "law/law.h"

static double time_of(const struct pm_frame *f) { return pm_frame_constant(f, "radiation_time", 0); }

static double lost(const struct pm_effect_case *c)
{
	const struct pm_scales *s = c->scales;
	const double v = fmin(s->v_max / s->c, 1 - 1e-15), gamma2 = 1 / (1 - v * v), kinetic = gamma2 * v * v / (1 + sqrt(gamma2)); /* gamma - 1 */
	const double given = isnan(s->given) ? 0 : s->given, gain = given * s->time / s->c;
	const double force = (s->v_max * s->cyclotron + given) / s->c;
	const double x = s->ratio * time_of(c->frame) * gamma2 * force * force * s->time / fmax(kinetic, sqrt(1 + gain * gain) - 1);
	return x / (1 + x);
}

static const char *lacks(const struct pm_effect_case *c)
{
	const struct pm_scales *s = c->scales;
	if (!s->second || s->kind != PM_CHARGES)
		return "no charges move";
	if (!(time_of(c->frame) > 0))
		return "the frame has no radiation_time";
	return isnan(s->c) ? "the frame has no speed of light c" : isnan(s->cyclotron) ? "no magnetic field, which the kick landau-lifshitz needs" : NULL;
}

static void decide(const struct pm_effect_case *c, struct pm_decision *d)
{
	const struct pm_scales *s = c->scales;
	const char *missing = lacks(c);
	if (missing) {
		pm_effect_off(d, missing);
		return;
	}
	const double share = lost(c);
	pm_effect_by(d, s, share, share);
	snprintf(d->text, sizeof d->text, "the fastest particle loses %.2g of its kinetic energy", share);
}

static void ask(const struct pm_effect_case *c, struct pm_method *m)
{
	if (c->decision->answer != PM_PUT_IN)
		return;
	m->kick = "landau-lifshitz/2";
	m->scheme = "leapfrog";
}

static void words(const struct pm_effect_case *c, struct pm_words *w)
{
	if (c->decision->answer == PM_PUT_IN)
		pm_words_amend(w, PM_SLOT_OPENING, "push", "", "; radiation reaction: on, %s", c->decision->text);
}

static bool asked(const struct pm_frame *f, const struct pm_law *law, char what[64])
{
	snprintf(what, 64, "radiation_time = %g", time_of(f));
	return law->magnetic && time_of(f) > 0;
}

static bool reversible(const struct pm_effect_case *c)
{
	const struct pm_scales *s = c->scales;
	return s->second && s->kind == PM_CHARGES && time_of(c->frame) > 0 && !isnan(s->c) && !isnan(s->cyclotron);
}

const struct pm_effect effect_radiation_reaction = {
	.name = "radiation-reaction",
	.sentence = "light that accelerated charges send out takes their energy",
	.source = "Landau and Lifshitz 1975, section 76",
	.word = "push landau-lifshitz/2",
	.asked = asked,
	.done_by = (const char *const[]){"landau-lifshitz", NULL},
	.decide = decide,
	.lacks = lacks,
	.ask = ask,
	.words = words,
	.reversible = reversible,
};
