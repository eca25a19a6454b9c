/* Smoothing: the softening of pairs. It is the frame's constant; at the nearest pair (or the mean distance of neighbours) d it reduces the force by (3/2)
 * (softening/d)^2. On a mesh the kernel smooths over a cell in any case, and a smaller softening has no effect. Source: Plummer 1911; Hockney and
 * Eastwood 1988, section 8-2. SPDX-License-Identifier: GPL-3.0-or-later */
#include <stdio.h>

#include "effect-parts/effect-decision.h"
#include "effect-parts/effect-words.h"

static void decide(const struct pm_effect_case *c, struct pm_decision *d)
{
	const struct pm_scales *s = c->scales;
	const double ratio = s->softening / s->nearest;
	if (pm_effect_alone(s))
		pm_effect_off(d, "no self field");
	else if (!s->pairs) {
		pm_effect_off(d, "");
		d->number = s->softening / s->h;
		snprintf(d->text, sizeof d->text, s->softening > 0 ? "softening/h = %.2g; the kernel smooths over a cell"
			: "no softening; the kernel smooths over a cell", d->number);
	} else if (!(s->softening > 0))
		pm_effect_off(d, "softening = 0");
	else {
		pm_effect_by(d, s, ratio, fmin(1, 1.5 * ratio * ratio));
		d->kept = d->answer == PM_LEFT_OUT; /* it has no cost */
		d->answer = PM_PUT_IN;
		snprintf(d->text, sizeof d->text, "softening is %.2g times the distance of the nearest pair", ratio);
	}
}

/* pp uses the frame's softening unless --softening is given. */
static void words(const struct pm_effect_case *c, struct pm_words *w)
{
	const bool without = c->scales->softening > 0 && c->decision->answer != PM_PUT_IN;
	pm_words_amend(w, PM_SLOT_PARTICLES, "pp", without ? " --softening 0" : "", "; smoothing: %s", c->decision->text);
}

static bool reversible(const struct pm_effect_case *c) { return c->method->pairs && c->scales->softening > 0; }

const struct pm_effect effect_smoothing = {
	.name = "smoothing",
	.sentence = "softened forces between pairs",
	.source = "Hockney and Eastwood 1988, section 8-2",
	.decide = decide,
	.words = words,
	.reversible = reversible,
};
