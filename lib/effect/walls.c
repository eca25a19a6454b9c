/* Walls: closed curves or surfaces of panels, the fixed set with `corners` that the word panels makes. Nothing flows through them; the fluid slips. The number
 * is the change of the velocities by `panels`, l2 over the particles that move, over the velocities with it; it acts at once, as a given field does.
 * Source: Martensen 1959; Hess and Smith 1967. SPDX-License-Identifier: GPL-3.0-or-later */
#include <stdio.h>
#include <string.h>

#include "effect-parts/body-in-flow.h"
#include "effect-parts/effect-decision.h"
#include "effect-parts/effect-words.h"
#include "stream/field-value.h"
#include "stream/frame.h"

static const struct pm_set *panels_of(const struct pm_frame *f)
{
	for (size_t k = 0; k < f->nsets; k++)
		if (pm_frame_field(f, f->sets[k]->name, "corners"))
			return f->sets[k];
	return NULL;
}

/* panels with its options. */
static void word(const struct pm_frame *f, char words[160])
{
	const struct pm_set *panels = panels_of(f);
	struct pm_scene_solid b;
	char stream[96];
	pm_effect_body(f, &b);
	const double U = pm_effect_stream(f, &b, stream);
	snprintf(words, 160, "panels");
	if (f->dim == 2 && pm_frame_field(f, panels->name, "source"))
		snprintf(words + strlen(words), 160 - strlen(words), " --kind source");
	if (strcmp(panels->name, "panels"))
		snprintf(words + strlen(words), 160 - strlen(words), " --panels %s", panels->name);
	if (U > 0)
		snprintf(words + strlen(words), 160 - strlen(words), " --stream '%s'", stream);
}

/* Sums over the particles that move of |a - b|^2 and |a|^2. */
static void differ(const struct pm_frame *a, const struct pm_frame *b, const char *name, double sum[2])
{
	for (size_t k = 0; k < a->nsets; k++) {
		const char *set = a->sets[k]->name;
		const struct pm_field *u = pm_frame_field(a, set, name), *v = pm_frame_field(b, set, name);
		if (!pm_set_moves(a, a->sets[k]) || !u || !v || u->count != v->count)
			continue;
		for (int d = 0; d < a->dim; d++)
			for (size_t i = 0; i < u->count; i++)
				sum[0] += pow(pm_value_at(u, d, i) - pm_value_at(v, d, i), 2), sum[1] += pow(pm_value_at(u, d, i), 2);
	}
}

/* own: the part of the velocities. */
static int measure(const struct pm_effect_case *c, const struct pm_effect_run *run, double own[PM_EFFECT_OWN])
{
	char words[160], sentence[2048];
	double sum[2] = {0, 0};
	if (c->scales->kind != PM_VORTICES || !panels_of(c->frame))
		return 0;
	word(c->frame, words);
	snprintf(sentence, sizeof sentence, "%s | %s", run->sentence, words);
	struct pm_frame *with = run->force(c->frame, sentence), *without = with ? run->force(c->frame, run->sentence) : NULL;
	if (without)
		differ(with, without, c->law->change, sum);
	const int status = without ? 0 : pm_failed();
	own[0] = sum[1] > 0 ? sqrt(sum[0] / sum[1]) : 0;
	pm_frame_free(with), pm_frame_free(without);
	return status;
}

static void decide(const struct pm_effect_case *c, struct pm_decision *d)
{
	const struct pm_scales *s = c->scales;
	const struct pm_set *panels = s->kind == PM_VORTICES ? panels_of(c->frame) : NULL;
	if (!panels) {
		pm_effect_off(d, s->kind != PM_VORTICES ? "no vorticity" :
			s->walls ? "those of the faces are in the Poisson solution; no panels" : "no panels");
		return;
	}
	if (isnan(c->own[0])) { /* not measured: cycle asks */
		*d = (struct pm_decision){.answer = PM_PUT_IN, .number = NAN, .share = NAN};
		snprintf(d->text, sizeof d->text, "%llu panels of '%s'", (unsigned long long)panels->n, panels->name);
		return;
	}
	pm_effect_by(d, s, c->own[0], fmin(1, c->own[0]));
	snprintf(d->text, sizeof d->text, "%llu panels make %.1g of the velocities; the fluid slips%s", (unsigned long long)panels->n, d->share,
		s->nu > 0 ? " (nu > 0: noslip, penalize)" : "");
}

static void words(const struct pm_effect_case *c, struct pm_words *w)
{
	char words[160];
	if (c->decision->answer != PM_PUT_IN)
		return;
	word(c->frame, words);
	pm_words_add(w, PM_SLOT_FORCES, words, "walls: on, %s", c->decision->text);
}

static bool asked(const struct pm_frame *f, const struct pm_law *law, char what[64])
{
	const struct pm_set *panels = law->of_potential == PM_CURL && law->strength ? panels_of(f) : NULL;
	snprintf(what, 64, "walls of panels");
	return panels;
}

static const char *lacks(const struct pm_effect_case *c)
{
	return panels_of(c->frame) ? NULL : "no panels in this frame (panels --curve or --surface makes them)";
}

static bool reversible(const struct pm_effect_case *c) { return c->scales->kind == PM_VORTICES && panels_of(c->frame); }

const struct pm_effect effect_walls = {
	.name = "walls",
	.sentence = "walls of panels that nothing flows through",
	.source = "Martensen 1959; Hess and Smith 1967",
	.word = "panels",
	.asked = asked,
	.done_by = (const char *const[]){"panels", "noslip", "penalize", NULL},
	.measure = measure,
	.decide = decide,
	.words = words,
	.lacks = lacks,
	.reversible = reversible,
};
