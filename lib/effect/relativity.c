/* Relativity: momentum grows as gamma v, gamma = 1/sqrt(1 - v^2/c^2); without it the error is of order (v/c)^2. c is a constant of the frame; if missing, c is
 * infinite. Source: Birdsall and Langdon 1985, section 15-4. SPDX-License-Identifier: GPL-3.0-or-later */
#include <stdio.h>
#include <string.h>

#include "effect-parts/effect-decision.h"
#include "effect-parts/effect-words.h"
#include "law/law.h"

static const char *lacks(const struct pm_effect_case *c)
{
	return !c->scales->second ? "the particles have no inertia" : isnan(c->scales->c) ? "the frame has no speed of light c" : NULL;
}

static void decide(const struct pm_effect_case *c, struct pm_decision *d)
{
	const struct pm_scales *s = c->scales;
	const char *missing = lacks(c);
	const double beta = s->v_max / s->c;
	if (missing) {
		pm_effect_off(d, missing);
		return;
	}
	pm_effect_by(d, s, beta, beta * beta);
	if (d->answer == PM_PUT_IN)
		snprintf(d->text, sizeof d->text, "max v/c = %.2g", beta);
	else
		snprintf(d->text, sizeof d->text, "max v/c = %.2g, error below %.1g", beta, pow(10, ceil(log10(fmax(beta * beta, 1e-300)))));
}

/* The kick of gamma v, which turns it about a magnetic field, too; a whole scheme has none. */
static void ask(const struct pm_effect_case *c, struct pm_method *m)
{
	if (pm_effect_in(c, "radiation-reaction")) /* whose kick is relativistic */
		return;
	if (c->law->relativistic) { /* its boris turns gamma v; in crossed fields higuera-cary drifts at E x B/B^2, whatever the speed */
		m->kick = c->scales->v_max > 0.9 * c->scales->c ? "higuera-cary/2" : m->kick;
		return;
	}
	if (c->decision->answer != PM_PUT_IN)
		return;
	m->kick = "relativistic/2";
	m->scheme = "leapfrog";
}

static void words(const struct pm_effect_case *c, struct pm_words *w)
{
	if (c->decision->answer == PM_PUT_IN)
		pm_words_amend(w, PM_SLOT_OPENING, "push", "", "; relativity: on, %s", c->decision->text);
}

static bool reversible(const struct pm_effect_case *c)
{
	return c->scales->second && !isnan(c->scales->c) && !c->law->relativistic && !pm_effect_in(c, "radiation-reaction");
}

const struct pm_effect effect_relativity = {
	.name = "relativity",
	.sentence = "inertia grows with the speed",
	.source = "Birdsall and Langdon 1985, section 15-4",
	.word = "push relativistic/2",
	.decide = decide,
	.lacks = lacks,
	.ask = ask,
	.words = words,
	.reversible = reversible,
};
