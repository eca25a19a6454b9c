/* Divergence of the vorticity in space: stretching and remeshing make it where the mesh does not resolve the vorticity, and the word reproject takes it away.
 * Its number is |alpha - alpha'|/|alpha| with the strengths alpha' of a run with reproject in every step, after 1 and 3 steps with stretching and remeshing,
 * from where it grows in proportion to time. Source: Cottet and Koumoutsakos 2000, section 3.3; Cocle, Winckelmans and Daeninck 2008.
 * SPDX-License-Identifier: GPL-3.0-or-later */
#include <stdio.h>
#include <string.h>

#include "effect-parts/effect-decision.h"
#include "effect-parts/effect-words.h"
#include "law/law.h"
#include "stream/field-value.h"
#include "stream/frame.h"

/* |a - b|/|b| of the strengths; NAN where they are not of the same particles. */
static double change(const struct pm_effect_case *c, const struct pm_frame *a, const struct pm_frame *b)
{
	double off = 0, all = 0;
	for (size_t k = 0; k < b->nsets; k++) {
		const struct pm_field *p = pm_frame_field(a, b->sets[k]->name, c->law->strength), *q = pm_frame_field(b, b->sets[k]->name, c->law->strength);
		if (p && q && p->count != q->count)
			return NAN;
		for (int d = 0; p && q && d < q->components; d++)
			for (size_t i = 0; i < q->count; i++)
				off += pow(pm_value_at(p, d, i) - pm_value_at(q, d, i), 2), all += pow(pm_value_at(q, d, i), 2);
	}
	return all > 0 ? sqrt(off / all) : NAN;
}

/* The force of the sentence with stretching, a step and a remeshing, and `more`. */
static bool with_stretching(const struct pm_effect_case *c, const char *sentence, const char *more, char out[2048])
{
	const char *at = strstr(sentence, "| m2p");
	snprintf(out, 2048, "%.*s| stretch %s | remesh --cut-off 0%s%s", at ? (int)(at - sentence) : 0, sentence, at ? at : "",
		c->scales->open ? " --outside grow" : "", more);
	return at;
}

/* own: the change after a step and after three. */
static int measure(const struct pm_effect_case *c, const struct pm_effect_run *run, double own[PM_EFFECT_OWN])
{
	char plain[2048], cured[2048];
	if (c->scales->kind != PM_VORTICES || c->scales->dim < 3 || c->scales->pairs || !with_stretching(c, run->sentence, "", plain) ||
		!with_stretching(c, run->sentence, " | reproject", cured))
		return 0;
	const struct pm_effect_run without = {run->steps, run->force, plain}, with = {run->steps, run->force, cured};
	struct pm_frame *a = run->steps(&without, c->frame, 1), *b = a ? run->steps(&with, c->frame, 1) : NULL;
	struct pm_frame *a3 = b ? run->steps(&without, a, 2) : NULL, *b3 = a3 ? run->steps(&with, b, 2) : NULL;
	own[0] = b3 ? change(c, a, b) : NAN;
	own[1] = b3 ? change(c, a3, b3) : NAN;
	own[2] = b3 ? fabs(a3->time - a->time) : NAN;
	pm_frame_free(a), pm_frame_free(b), pm_frame_free(a3), pm_frame_free(b3);
	return b3 ? 0 : pm_failed();
}

static void decide(const struct pm_effect_case *c, struct pm_decision *d)
{
	const struct pm_scales *s = c->scales;
	if (isnan(c->own[1])) {
		pm_effect_off(d, s->kind != PM_VORTICES ? "no vorticity" : s->dim < 3 ? "2-D" : s->pairs ? "pairs are summed, nothing is remeshed" :
			"not measured: with reproject other nodes have become particles");
		return;
	}
	const double end = c->own[0] + fmax(0, c->own[1] - c->own[0]) * s->time / c->own[2];
	pm_effect_by(d, s, c->own[0], fmin(1, end));
	d->answer = end > s->accuracy ? PM_PUT_IN : PM_LEFT_OUT; /* not half of it: cells too few are hidden by it, not cured */
	snprintf(d->text, sizeof d->text, "changes the strengths by %.1g in a step, by %.1g in the time T", c->own[0], fmin(1, end));
}

static void words(const struct pm_effect_case *c, struct pm_words *w)
{
	if (c->decision->answer == PM_PUT_IN && !c->method->pairs && pm_effect_in(c, "remeshing"))
		pm_words_add(w, PM_SLOT_AFTER, "reproject", "divergence of the vorticity: removed, it %s", c->decision->text);
}

const struct pm_effect effect_vorticity_divergence = {
	.name = "vorticity-divergence",
	.sentence = "vorticity that is no curl",
	.source = "Cottet and Koumoutsakos 2000, section 3.3",
	.word = "reproject",
	.measure = measure,
	.decide = decide,
	.words = words,
};
