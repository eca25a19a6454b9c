/* Smoothing: the softening of bodies, a constant of the frame. Between pairs, at the nearest (or the mean distance of neighbours) d, it reduces the force by
 * (3/2) (softening/d)^2, and costs nothing. A mesh smooths over a cell in any case; there the force with --green plummer is compared with the force
 * without: measured on the frame, both by the sentence of the plan. A change d of the force changes phases on orbits by d a T/(2 v); v of a cold frame is
 * that after the four steps of --check. Source: Plummer 1911; Hockney and Eastwood 1988, section 8-2.
 * SPDX-License-Identifier: GPL-3.0-or-later */
#include <stdio.h>
#include <string.h>

#include "effect-parts/effect-decision.h"
#include "effect-parts/effect-words.h"
#include "law/law.h"
#include "measure/norms.h"
#include "stream/frame.h"

/* Below that fraction of a cell the change is below 3 (softening/h)^2 = 0.003 (measured: cic, uniform and clustered bodies). */
static const double least = 0.03;

static bool on_mesh(const struct pm_effect_case *c)
{
	const struct pm_scales *s = c->scales;
	return !c->method->pairs && (s->kind == PM_MASSES || s->kind == PM_CHARGES || s->singular) && s->softening > least * s->h && !pm_effect_alone(s);
}

/* The sentence with the first word that solves for the potential in the place of `solver`; its --mesh is kept. */
static void with(const char *sentence, const char *solver, char out[2048])
{
	const char *at = strstr(sentence, "poisson-"), *end = at ? strchr(at, '|') : NULL, *mesh = at ? strstr(at, "--mesh ") : NULL;
	char own[80] = "";
	end = end ? end : at ? at + strlen(at) : sentence + strlen(sentence);
	at = at ? at : end;
	if (mesh && mesh < end)
		snprintf(own, sizeof own, " %.*s", (int)(7 + strcspn(mesh + 7, " |")), mesh);
	snprintf(out, 2048, "%.*s%s%s %s", (int)(at - sentence), sentence, solver, own, end);
}

/* |a - b|/|b| of the accelerations. */
static double change(const struct pm_effect_case *c, const struct pm_frame *a, const struct pm_frame *b)
{
	double d2 = 0, r2 = 0;
	for (size_t k = 0; k < b->nsets; k++) {
		const struct pm_field *p = pm_frame_field(a, b->sets[k]->name, c->law->change), *q = pm_frame_field(b, b->sets[k]->name, c->law->change);
		for (int i = 0; p && q && p->count == q->count && i < q->components; i++) {
			const double *x = pm_in(p, i), *y = pm_in(q, i);
			for (size_t j = 0; j < q->count; j++)
				d2 += (x[j] - y[j]) * (x[j] - y[j]), r2 += y[j] * y[j];
		}
	}
	return r2 > 0 ? sqrt(d2 / r2) : NAN;
}

static int measure(const struct pm_effect_case *c, const struct pm_effect_run *run, double own[PM_EFFECT_OWN])
{
	char soft[2048], plain[2048];
	if (!on_mesh(c))
		return 0;
	with(run->sentence, "poisson-fft --green plummer", soft);
	with(run->sentence, "poisson-fft --symbol spectral", plain);
	struct pm_frame *a = run->force(c->frame, plain), *b = a ? run->force(c->frame, soft) : NULL;
	own[0] = b ? change(c, a, b) : NAN;
	pm_frame_free(a), pm_frame_free(b);
	return b ? 0 : pm_failed();
}

static void decide(const struct pm_effect_case *c, struct pm_decision *d)
{
	const struct pm_scales *s = c->scales;
	const double ratio = s->softening / (s->pairs ? s->nearest : s->h);
	if (pm_effect_alone(s))
		pm_effect_off(d, "no self field");
	else if (s->pairs && !(s->softening > 0))
		pm_effect_off(d, "softening = 0");
	else if (s->pairs) {
		pm_effect_by(d, s, ratio, fmin(1, 1.5 * ratio * ratio));
		d->kept = d->answer == PM_LEFT_OUT; /* it has no cost */
		d->answer = PM_PUT_IN;
		snprintf(d->text, sizeof d->text, "softening is %.2g times the distance of the nearest pair", ratio);
	} else if (!isnan(c->own[0])) {
		const double gain = s->self * s->time, begun = s->self * fmin(s->time, 4 * fabs(s->dt));
		pm_effect_by(d, s, ratio, c->own[0] * (s->second ? fmax(1, 0.5 * gain / (s->v_rms + begun)) : 1));
		snprintf(d->text, sizeof d->text, "softening/h = %.2g, changes the force by %.2g", ratio, c->own[0]);
	} else {
		pm_effect_off(d, "");
		d->number = ratio;
		snprintf(d->text, sizeof d->text, s->softening > 0 ? "softening/h = %.2g; the kernel smooths over a cell"
			: "no softening; the kernel smooths over a cell", ratio);
	}
}

/* The softened function inverts the Laplacian, not differences. */
static void ask(const struct pm_effect_case *c, struct pm_method *m)
{
	if (!m->pairs && c->decision->answer == PM_PUT_IN)
		m->symbol = NULL;
}

/* pp uses the frame's softening unless --softening is given. */
static void words(const struct pm_effect_case *c, struct pm_words *w)
{
	const bool in = c->decision->answer == PM_PUT_IN, without = c->scales->softening > 0 && !in;
	pm_words_amend(w, PM_SLOT_PARTICLES, "pp", without ? " --softening 0" : "", "; smoothing: %s", c->decision->text);
	if (in && !c->method->pairs && c->scales->softening > 0)
		pm_words_amend(w, PM_SLOT_POTENTIAL, "poisson-fft", " --green plummer", "; smoothing: %s", c->decision->text);
}

static bool reversible(const struct pm_effect_case *c) { return c->scales->softening > 0 && (c->method->pairs || !isnan(c->own[0])); }

static bool asked(const struct pm_frame *f, const struct pm_law *law, char what[64])
{
	const double softening = pm_frame_constant(f, "softening", 0);
	snprintf(what, 64, "softening = %.4g", softening);
	return softening > 0 && law->strength && law->of_potential != PM_CURL;
}

static const char *const beside[] = {"poisson-fft", "poisson-mg", "poisson-relax", NULL};
static const char *const done_by[] = {"poisson-fft --green plummer", "--green gauss", "--cloud", "pp", NULL};

const struct pm_effect effect_smoothing = {
	.name = "smoothing",
	.sentence = "softened forces between bodies",
	.source = "Hockney and Eastwood 1988, section 8-2",
	.asked = asked,
	.asked_beside = beside,
	.done_by = done_by,
	.measure = measure,
	.decide = decide,
	.ask = ask,
	.words = words,
	.reversible = reversible,
};
