/* Remeshing: particles that represent a field are put back on the lattice before they lose overlap. The distortion |H - H0|/H0 is their error for a
 * constant (lib/remesh/distortion.c) and must stay below the accuracy: measured after 1, 2, 4, 8 steps without remeshing, extrapolated as t^2. Shear
 * along the mesh gives none by this measure, so the strain e = |grad u| t counts too, as (e/4)^2 (a lattice stretched 1.25, 1.5, 1.75 times has 0.0032, 0.0106,
 * 0.0336, docs/methods/remesh.md) or e^(10/3) if that is larger (the error of taylor-green-2d after many remeshings: 0.006, 0.074 at e = 0.25, 0.5). Point
 * particles have no lattice to return to. Source: Hieber and Koumoutsakos 2005, J. Comput. Phys. 210, 342.
 * SPDX-License-Identifier: GPL-3.0-or-later */
#include <stdio.h>
#include <string.h>

#include "effect-parts/effect-decision.h"
#include "effect-parts/effect-words.h"
#include "effect-parts/set-overlap.h"
#include "law/law.h"
#include "stream/frame.h"

/* After 1, 2, 4, 8 steps; own[0..3]. */
enum { MEASURED = 4 };

/* Mean |H - H0|/H0 of all sets that move and have as many particles as before; weighted by strength: particles without strength cause no error. */
static double change(const struct pm_frame *f, const struct pm_frame *g, const char *strength)
{
	double sum = 0, all = 0;
	for (size_t k = 0; k < f->nsets; k++) {
		const struct pm_set *set = f->sets[k];
		if (!pm_set_moves(f, set) || !set->n)
			continue;
		double *H0 = pm_alloc(set->n, sizeof *H0), *H = pm_alloc(set->n, sizeof *H);
		bool ok = H0 && H && !pm_set_overlap(f, set->name, f->meshes[0], H0) && !pm_set_overlap(g, set->name, g->meshes[0], H);
		const struct pm_field *q = pm_frame_field(f, set->name, strength);
		for (size_t i = 0; ok && q && i < set->n; i++) {
			const double weight = q->uniform ? 1 : fabs(pm_in(q, 0)[i]);
			sum += H0[i] > 0 ? weight * fabs(H[i] - H0[i]) / H0[i] : 0;
			all += weight;
		}
		pm_free(H0), pm_free(H);
	}
	return all > 0 ? sum / all : NAN;
}

/* Runs steps without remeshing until the distortion is too large. */
static int measure(const struct pm_effect_case *c, const struct pm_effect_run *run, double own[PM_EFFECT_OWN])
{
	const struct pm_scales *s = c->scales;
	if (s->kind != PM_VORTICES || c->method->pairs || s->singular || isnan(s->overlap))
		return 0;
	struct pm_frame *g = pm_frame_copy(c->frame);
	for (int i = 0; i < MEASURED && g; i++) {
		struct pm_frame *next = run->steps(run, g, i ? 1 << (i - 1) : 1);
		pm_frame_free(g);
		g = next;
		own[i] = g ? change(c->frame, g, c->law->strength) : NAN;
		if (!(own[i] <= s->accuracy))
			break;
	}
	int status = g ? 0 : pm_failed();
	pm_frame_free(g);
	return status;
}

/* The measured distortion after a number of steps: from the longest measured time below it, extrapolated as t^2. */
static double measured(const struct pm_effect_case *c, double steps)
{
	double known = 0;
	for (int i = 0; i < MEASURED && !isnan(c->own[i]); i++)
		known = 1 << i <= steps || !i ? c->own[i] * pow(steps / (1 << i), 2) : known;
	return known;
}

/* The larger of the measured distortion and the estimate by the strain. */
static double distortion(const struct pm_effect_case *c, double steps)
{
	const double strain = c->scales->strain * fabs(c->scales->dt) * steps;
	return fmax(measured(c, steps), fmax(strain * strain / 16, pow(strain, 10. / 3)));
}

static const char *lacks(const struct pm_effect_case *c)
{
	return c->scales->kind != PM_VORTICES || isnan(c->scales->overlap) ? "the particles do not carry a field on a lattice" : NULL;
}

static void decide(const struct pm_effect_case *c, struct pm_decision *d)
{
	const struct pm_scales *s = c->scales;
	const char *missing = lacks(c);
	const double end = distortion(c, s->time / fabs(s->dt));
	if (missing) {
		pm_effect_off(d, missing);
		return;
	}
	if (s->pairs || s->singular) {
		pm_effect_off(d, "");
		d->number = s->overlap;
		snprintf(d->text, sizeof d->text, "point vortices: sqrt(volume)/h = %.2g, off a lattice by %.2g", s->width / s->h, s->overlap);
		return;
	}
	pm_effect_by(d, s, end, fmin(1, end));
	if (d->answer == PM_LEFT_OUT) {
		snprintf(d->text, sizeof d->text, "distortion reaches %.1g in the time T", end);
		return;
	}
	d->kept = measured(c, s->time / fabs(s->dt)) <= s->accuracy; /* too small in the measured steps for --check to find it */
	for (d->every = 1; d->every < 16 && distortion(c, d->every + 1) <= s->accuracy;)
		d->every++;
	d->number = distortion(c, d->every);
	snprintf(d->text, sizeof d->text, "distortion reaches %.2g", d->number);
}

/* Every remeshing adds a rim of nodes around the particles. */
static void ask(const struct pm_effect_case *c, struct pm_method *m)
{
	m->grow = m->grow || (c->scales->open && c->decision->answer == PM_PUT_IN);
}

static void words(const struct pm_effect_case *c, struct pm_words *w)
{
	const struct pm_decision *d = c->decision;
	const struct pm_frame *f = c->frame;
	char words[160], kernel[64] = "", every[32] = "", edge[96] = "";
	bool open = false;
	if (d->answer != PM_PUT_IN)
		return;
	for (int k = 0; k < 2 * f->dim; k++)
		open = open || f->face[k / 2][k % 2] != PM_PERIODIC;
	if (d->every > 1)
		snprintf(every, sizeof every, " --every %d", d->every);
	if (open) /* only nodes with strength become particles; those that diffusion needs are kept, and the mesh grows with them */
		snprintf(edge, sizeof edge, " --cut-off %.2g%s%s", c->scales->accuracy * 1e-3, pm_effect_in(c, "diffusion") ? " --rim 2" : "",
			c->method->grow ? " --outside grow" : "");
	if (strcmp(c->method->kernel, c->law->kernel))
		snprintf(kernel, sizeof kernel, " --kernel %s", c->method->kernel);
	snprintf(words, sizeof words, "remesh%s%s%s", kernel, every, edge);
	if (d->every > 1)
		pm_words_add(w, PM_SLOT_AFTER, words, "remesh: every %d steps, %s", d->every, d->text);
	else
		pm_words_add(w, PM_SLOT_AFTER, words, "remesh: every step, %s", d->text);
}

static bool reversible(const struct pm_effect_case *c) { return c->scales->kind == PM_VORTICES && !c->method->pairs && !c->scales->singular; }

/* At least one remeshing must fall within the steps. */
static void test(const struct pm_effect_case *c, struct pm_effect_test *t)
{
	t->of = PM_TEST_DENSITY;
	t->steps = t->steps < 2 * c->decision->every ? 2 * c->decision->every : t->steps;
}

const struct pm_effect effect_remeshing = {
	.name = "remeshing",
	.sentence = "particles back on the lattice",
	.source = "Hieber and Koumoutsakos 2005",
	.word = "remesh",
	.replaces = true,
	.measure = measure,
	.decide = decide,
	.lacks = lacks,
	.ask = ask,
	.words = words,
	.reversible = reversible,
	.test = test,
};
