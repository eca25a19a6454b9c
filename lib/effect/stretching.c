/* Stretching: vortex lines tilted and stretched by the flow, d alpha/dt = (alpha . grad) u; zero in 2-D. In 3-D it changes strengths
 * by |grad u| T. Source: Cottet and Koumoutsakos 2000, section 3.1. SPDX-License-Identifier: GPL-3.0-or-later */
#include <stdio.h>

#include "effect-parts/effect-decision.h"
#include "effect-parts/effect-words.h"
#include "law/law.h"

static const char *lacks(const struct pm_effect_case *c)
{
	return c->scales->kind != PM_VORTICES ? "no vorticity" : c->scales->dim < 3 ? "2-D" : NULL;
}

static void decide(const struct pm_effect_case *c, struct pm_decision *d)
{
	const struct pm_scales *s = c->scales;
	const char *missing = lacks(c);
	const double share = s->strain * s->time;
	if (missing) {
		pm_effect_off(d, missing);
		return;
	}
	pm_effect_by(d, s, share, share);
	snprintf(d->text, sizeof d->text, "|grad u| T = %.2g", share);
}

static void words(const struct pm_effect_case *c, struct pm_words *w)
{
	if (c->decision->answer != PM_PUT_IN || c->method->pairs)
		return;
	pm_words_add(w, PM_SLOT_MESH, "stretch", "stretching: on, %s", c->decision->text);
	pm_words_amend(w, PM_SLOT_PARTICLES, "m2p", "", ", and the change of their strengths by stretching");
}

static bool asked(const struct pm_frame *f, const struct pm_law *law, char what[64])
{
	(void)f;
	snprintf(what, 64, "vorticity in space");
	return law->vector;
}

static bool reversible(const struct pm_effect_case *c) { return c->scales->kind == PM_VORTICES && c->scales->dim == 3; }

/* One step of the strengths, as for diffusion. */
static void test(const struct pm_effect_case *c, struct pm_effect_test *t)
{
	(void)c;
	t->of = PM_TEST_STRENGTH;
	t->steps = 1;
}

const struct pm_effect effect_stretching = {
	.name = "stretching",
	.sentence = "vortex lines stretched by the flow",
	.source = "Cottet and Koumoutsakos 2000, section 3.1",
	.word = "stretch",
	.asked = asked,
	.done_by = (const char *const[]){"stretch", "pp", NULL},
	.decide = decide,
	.lacks = lacks,
	.words = words,
	.reversible = reversible,
	.test = test,
};
