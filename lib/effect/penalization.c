/* Penalization: a solid body on the mesh, whose wall makes vorticity. Its number is the vorticity that one step with `penalize` makes, sum |dq|, over that of
 * the frame, sum |q|; in the time T the wall makes T/dt times as much at most. The body takes on its velocity within a step, eta = dt, in which the
 * stream goes U dt/h cells. Source: Angot, Bruneau and Fabrie 1999; Coquerelle and Cottet 2008. SPDX-License-Identifier: GPL-3.0-or-later */
#include <stdio.h>
#include <string.h>

#include "effect-parts/body-in-flow.h"
#include "effect-parts/effect-decision.h"
#include "effect-parts/effect-words.h"
#include "stream/field-value.h"

/* Sum of |field| of the sets that move. */
static double sum(const struct pm_frame *f, const char *name)
{
	double all = 0;
	for (size_t k = 0; k < f->nsets; k++) {
		const struct pm_field *q = pm_set_moves(f, f->sets[k]) ? pm_frame_field(f, f->sets[k]->name, name) : NULL;
		for (size_t i = 0; q && i < q->count; i++) {
			double one = 0;
			for (int d = 0; d < q->components; d++)
				one = hypot(one, pm_value_at(q, d, i));
			all += one;
		}
	}
	return all;
}

/* own: what a step makes, and what is there. */
static int measure(const struct pm_effect_case *c, const struct pm_effect_run *run, double own[PM_EFFECT_OWN])
{
	struct pm_scene_solid b;
	const char *at = strstr(run->sentence, "| m2p");
	char penalize[320], sentence[2048], change[PM_NAME + 2];
	if (c->scales->kind != PM_VORTICES || c->scales->pairs || !at || !pm_effect_body(c->frame, &b))
		return 0;
	pm_effect_penalize(c->frame, penalize);
	snprintf(sentence, sizeof sentence, "%.*s| %s %s", (int)(at - run->sentence), run->sentence, penalize, at);
	struct pm_frame *g = run->force(c->frame, sentence);
	if (!g)
		return pm_failed();
	snprintf(change, sizeof change, "d%s", c->law->strength);
	own[0] = sum(g, change) * fabs(c->frame->dt), own[1] = sum(g, c->law->strength);
	pm_frame_free(g);
	return 0;
}

static void decide(const struct pm_effect_case *c, struct pm_decision *d)
{
	const struct pm_scales *s = c->scales;
	struct pm_scene_solid b;
	if (isnan(c->own[0])) {
		const bool body = s->kind == PM_VORTICES && pm_effect_body(c->frame, &b);
		pm_effect_off(d, s->kind != PM_VORTICES ? "no vorticity" : !body ? "no body on the mesh" : "pairs are summed, there is no mesh");
		return;
	}
	pm_effect_body(c->frame, &b);
	const double made = c->own[0] * fmax(1, s->time / fabs(c->frame->dt));
	pm_effect_by(d, s, c->own[0] / c->own[1], made / (made + c->own[1]));
	snprintf(d->text, sizeof d->text, "the wall makes %.1g of the vorticity in a step, eta = dt = %.2g (the flow goes %.2g cells)", d->number, fabs(s->dt),
		fmax(b.speed, s->self) * fabs(s->dt) / s->h);
}

static void words(const struct pm_effect_case *c, struct pm_words *w)
{
	char words[320];
	if (c->decision->answer != PM_PUT_IN || c->method->pairs)
		return;
	pm_effect_penalize(c->frame, words);
	pm_words_add(w, PM_SLOT_MESH, words, "penalization: on, %s", c->decision->text);
	pm_words_amend(w, PM_SLOT_PARTICLES, "m2p", "", ", and the change of their strengths at the wall");
}

static const char *lacks(const struct pm_effect_case *c)
{
	struct pm_scene_solid b;
	return c->scales->kind == PM_VORTICES && pm_effect_body(c->frame, &b) ? NULL : "no body in this frame (the mesh state `body`, or a scene that has one)";
}

static bool reversible(const struct pm_effect_case *c)
{
	struct pm_scene_solid b;
	return c->scales->kind == PM_VORTICES && !c->scales->pairs && pm_effect_body(c->frame, &b);
}

static void test(const struct pm_effect_case *c, struct pm_effect_test *t)
{
	(void)c;
	t->of = PM_TEST_STRENGTH;
	t->steps = 1;
}

const struct pm_effect effect_penalization = {
	.name = "penalization",
	.sentence = "a solid body on the mesh",
	.source = "Angot, Bruneau and Fabrie 1999",
	.word = "penalize",
	.measure = measure,
	.decide = decide,
	.words = words,
	.lacks = lacks,
	.reversible = reversible,
	.test = test,
};
