/* The step of few bodies that the atlas does not hold (three or more, or a pair that falls straight together): the frame itself is run for the whole time, or
 * for the first part of it that a bounded number of force evaluations reaches, with steps C/omega of the fastest orbit (dt --oscillation) and C halved again
 * and again, until the places agree as the order of the scheme asks. C then follows from their difference: it falls as C^p, and grows in time as it grew in
 * the second half of the trial, as a power of time, or by e-foldings where that power is above 4 (chaos). ias15 is taken where it needs fewer forces, by the
 * agreement of two of its tolerances; also where no C agrees, if it reaches the end. What does not agree, or would need a C much smaller
 * than any that was tried, cannot be promised: the plan says so, and keeps the energy. No clock, so the plan is the same in every run.
 * Source: Richardson 1911 (the error from two steps); Quinlan and Tremaine 1992 (chaos in few-body orbits).
 * Cost: MOST_PASSES forces at most, a second for three bodies; three times as
 * many where they never agree. SPDX-License-Identifier: GPL-3.0-or-later */
#include <string.h>

#include "planner/plan.h"
#include "planner/scales.h"
#include "step/step.h"

enum { MOST_PASSES = 60000, LEVELS = 6, COARSE_PASSES = MOST_PASSES / 16 };

static const double coarse = 0.2;  /* C of the first trial */
static const double chaotic = 4;   /* a difference that grows faster than this power of time grows by e-foldings */
static const double margin = 0.3;  /* the error aimed at, of the accuracy */

struct scheme {
	const char *name;
	double order;
};
static const struct scheme fine = {"blanes-moan6", 6}, others[] = {{"rk4", 4}, {"leapfrog", 2}};

/* The places after half of a trial and at its end. */
struct run {
	struct pm_orbit_body half[PM_SCALES_FEW], end[PM_SCALES_FEW];
	double energy, reached; /* [time] since the frame's, at the end */
	size_t n, passes;
	bool done;
};

struct trial {
	const struct pm_frame *f;
	const struct pm_plan *p;
	double time, energy; /* [time] of the run; at its start */
	size_t left;         /* passes */
	/* found */
	double until, growth; /* [time] where the places of two runs agree; the power of time with which their difference grew */
	double difference[LEVELS]; /* of the places then, between C = coarse/2^k and half of that; NAN: the longer step was unstable */
	int levels;
	size_t passes;        /* of the finest run, */
	struct run right;     /* which is the reference */
};

static double energy_of(const struct pm_frame *f, const struct pm_law *law, const struct pm_orbit_body *b, size_t n)
{
	const double soft = pm_frame_constant(f, "softening", 0), G = law->coefficient(f) / (4 * pm_pi);
	double sum = 0;
	for (size_t i = 0; i < n; i++) {
		for (int d = 0; d < 3; d++)
			sum += 0.5 * b[i].mass * b[i].v[d] * b[i].v[d];
		for (size_t j = 0; j < i; j++) {
			double r2 = soft * soft;
			for (int d = 0; d < 3; d++)
				r2 += pow(b[i].x[d] - b[j].x[d], 2);
			sum -= b[i].fixed && b[j].fixed ? 0 : G * b[i].mass * b[j].mass / sqrt(r2);
		}
	}
	return sum;
}

/* |x - x'|/|x'|, l2, of the bodies that move. */
static double apart(const struct pm_orbit_body *a, const struct pm_orbit_body *b, size_t n)
{
	double square = 0, all = 0;
	for (size_t i = 0; i < n; i++)
		for (int d = 0; d < 3 && !b[i].fixed; d++)
			square += pow(a[i].x[d] - b[i].x[d], 2), all += b[i].x[d] * b[i].x[d];
	return sqrt(square / all);
}

static struct pm_frame *leg(struct trial *t, const struct pm_frame *from, const char *scheme, double C, double span)
{
	const double back = t->f->dt < 0 ? -1 : 1, until = t->f->time + back * span;
	char step[96], words[192];
	snprintf(step, sizeof step, "dt --oscillation %.12g --until %.17g", C, until);
	if (!strcmp(scheme, "ias15")) /* C is its tolerance */
		snprintf(words, sizeof words, "pp | push ias15 --tolerance %.3g | dt --until %.17g", C, until);
	else if (strcmp(scheme, "leapfrog"))
		snprintf(words, sizeof words, "pp | %s | push %s", step, scheme);
	else
		snprintf(words, sizeof words, "%s | push kick/2 drift | pp | push kick/2", step);
	return pm_plan_run_until(from, words, until, &t->left);
}

/* done: it reached the end within the passes that are left, of which it uses at most `most`. A run whose scheme became unstable is not done. */
static void run(struct trial *t, const char *scheme, double C, double span, size_t most, struct run *r)
{
	const size_t kept = t->left > most ? t->left - most : 0, before = t->left;
	t->left -= kept;
	struct pm_frame *half = leg(t, t->f, scheme, C, span / 2), *end = half && t->left ? leg(t, half, scheme, C, span) : NULL;
	const struct pm_frame *last = end ? end : half;
	*r = (struct run){.energy = NAN, .passes = before - kept - t->left, .done = end && t->left > 0};
	t->left += kept;
	if (last) {
		r->reached = fabs(last->time - t->f->time);
		r->n = pm_orbit_bodies(half, t->p->law, r->half);
		pm_orbit_bodies(last, t->p->law, r->end);
		r->energy = energy_of(last, t->p->law, r->end, r->n);
		r->done = r->done && isfinite(r->energy);
	}
	pm_frame_free(half);
	pm_frame_free(end);
}

/* Halves C until the places at `span` agree. */
static bool agrees(struct trial *t, double span)
{
	struct run *r = pm_alloc(2, sizeof *r);
	bool found = false;
	t->levels = 0;
	if (!r)
		return false;
	run(t, fine.name, coarse, span, t->left, &r[0]);
	for (int k = 1; k < LEVELS && !found && t->left > 0; k++) {
		struct run *now = &r[k % 2], *before = &r[(k - 1) % 2];
		run(t, fine.name, coarse * pow(0.5, k), span, t->left, now);
		const double d = before->done && now->done ? fmax(apart(before->end, now->end, now->n), 1e-15) : NAN;
		found = d < 1e-9 || (d < 0.1 && k > 1 && d < t->difference[k - 2] / 8); /* order 3 at least */
		t->difference[t->levels++] = d;
		if (!found)
			continue;
		const double first = apart(before->half, now->half, now->n);
		t->until = span, t->passes = now->passes, t->right = *now;
		t->growth = fmax(1, first > 1e-12 ? log2(d / first) : 0);
	}
	pm_free(r);
	return found;
}

/* The longest step whose error is at most this: between two that were tried the logarithms are linear, beyond the finest the error falls as the order says. */
static double longest(const struct trial *t, double most)
{
	int k = t->levels - 1;
	const double *d = t->difference;
	if (d[k] > most)
		return coarse * pow(0.5, k) * pow(most / d[k], 1 / fine.order);
	while (k > 0 && d[k - 1] <= most)
		k--;
	return coarse * pow(0.5, k) * (k > 0 && isfinite(d[k - 1]) ? pow(2, log(most / d[k]) / log(d[k - 1] / d[k])) : 1);
}

/* The difference at the end of the run that belongs to this one at the end of the trial, over it. */
static double grown(const struct trial *t)
{
	const double further = t->time / t->until;
	return t->growth <= chaotic ? pow(further, fmax(2, t->growth)) : pow(2, t->growth * 2 * (further - 1));
}

static void choose(struct pm_plan *p, const char *scheme, double C, double evaluations)
{
	struct pm_method *m = &p->method;
	m->scheme = scheme, m->follow = C, m->dt = NAN, m->evaluations = evaluations;
}

/* The cheapest scheme that reaches the accuracy; of the others by one run, and one to confirm it. */
static void cheapest(struct trial *t, struct pm_plan *p)
{
	const double most = margin * p->scales.accuracy / grown(t), times = t->time / t->until, C = longest(t, most);
	struct run r;
	choose(p, fine.name, C, (double)t->passes * times * coarse * pow(0.5, t->levels) / C);
	for (size_t i = 0; i < sizeof others / sizeof *others && t->left > 0; i++) {
		run(t, others[i].name, 0.05, t->until, t->left, &r);
		const double d = r.done ? apart(r.end, t->right.end, r.n) : NAN, c = fmin(coarse, 0.05 * pow(0.5 * most / d, 1 / others[i].order));
		const double cost = (double)r.passes * times * 0.05 / c;
		if (!(d < 0.3 && cost < 0.8 * p->method.evaluations) || !t->left)
			continue;
		run(t, others[i].name, c, t->until, t->left, &r);
		if (r.done && apart(r.end, t->right.end, r.n) < most)
			choose(p, others[i].name, c, cost);
	}
}

/* The loosest tolerance of ias15 whose places at `span` are those of a tighter one, if that is cheaper than what was chosen. */
static bool controlled(struct trial *t, struct pm_plan *p, double span, double most)
{
	static const double tolerance[] = {1e-3, 1e-4, 1e-5, 1e-7, 1e-9};
	struct run *r = pm_plan_smooth(t->f) ? pm_alloc(2, sizeof *r) : NULL;
	bool found = false;
	for (size_t k = 0; r && k < sizeof tolerance / sizeof *tolerance && !found && t->left > 0; k++) {
		struct run *now = &r[k % 2], *before = &r[(k + 1) % 2];
		run(t, "ias15", tolerance[k], span, t->left, now);
		const double cost = (double)(k ? before : now)->passes * t->time / span;
		if (!now->done || !(cost < (isfinite(p->method.evaluations) ? 0.8 * p->method.evaluations : HUGE_VAL)))
			break;
		found = k > 0 && apart(before->end, now->end, now->n) < most;
		if (found) {
			choose(p, "ias15", NAN, cost);
			p->method.tolerance = tolerance[k - 1];
		}
	}
	pm_free(r);
	return found;
}

/* No places: as long a step as keeps the energy, as far as it can be tried. 0 or failure. */
static int keep_energy(struct trial *t, struct pm_plan *p)
{
	const double accuracy = p->scales.accuracy;
	struct run r;
	double off = NAN;
	for (double C = coarse / 2; C > 0.02 && !(off < 0.1 * accuracy); C /= 2) {
		t->left = MOST_PASSES / 2;
		run(t, fine.name, C, t->time, t->left, &r);
		off = fabs(r.energy / t->energy - 1);
		choose(p, fine.name, C, r.done ? (double)r.passes : NAN);
	}
	if (!(off < accuracy))
		return pm_fail(PM_NUMERICS, "no plan for these %g bodies: steps of %g/omega of their fastest orbit change the energy by %.2g within "
			"t = %.3g, more than %g (a softening, a shorter run, or a sentence of your own)", p->scales.few,
			p->method.follow, off, r.reached, accuracy);
	snprintf(p->method.warning, sizeof p->method.warning, "the places of these %g bodies are not promised to %g at T = %.6g: trials with two steps agree "
		"until %.3g only (chaos, docs/plan.md); the energy is right to %.1g%s", p->scales.few, accuracy, t->time, t->until, fmax(off, 1e-15),
		r.done ? "" : ", as far as it was tried");
	return 0;
}

int pm_plan_trial(const struct pm_frame *f, struct pm_plan *p)
{
	struct trial t = {.f = f, .p = p, .time = p->scales.time, .left = MOST_PASSES};
	struct pm_orbit_body b[PM_SCALES_FEW];
	const size_t n = pm_orbit_bodies(f, p->law, b);
	struct run first;
	t.energy = energy_of(f, p->law, b, n);
	run(&t, fine.name, coarse, t.time, COARSE_PASSES, &first);
	double span = t.time;
	while (!first.done && first.reached > 0 && span > first.reached)
		span /= 2;
	bool whole = agrees(&t, span);
	for (int k = 1; k < 6 && !whole && !(t.until > 0); k++) { /* until when do they agree? */
		span /= 2;
		t.left = MOST_PASSES >> k;
		agrees(&t, span);
	}
	const double most = whole ? margin * p->scales.accuracy / grown(&t) : NAN;
	if (whole && longest(&t, most) > coarse * pow(0.5, t.levels + 2)) {
		cheapest(&t, p);
		controlled(&t, p, t.until, most);
		return 0;
	}
	t.left = 2 * MOST_PASSES;
	if (controlled(&t, p, t.time, margin * p->scales.accuracy))
		return 0;
	return keep_energy(&t, p);
}
