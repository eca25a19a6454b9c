/* What chaos and rounding leave of a run: the planned sentence runs from the frame and from a copy whose numbers are moved by their last bit, a piece at a
 * time, until the two differ by more than the accuracy. Near orbits part as exp(lambda t); in clusters of a few hundred bodies lambda is 1 to 4 times
 * sqrt(4 pi G rho) (Goodman, Heggie and Hut 1993; 3 measured for pinit plummer -n 200), so where exp(4 omega T) times the last bit stays below the
 * accuracy nothing is run. Cost: two runs, up to a budget of estimated nanoseconds.
 * SPDX-License-Identifier: GPL-3.0-or-later */
#include <float.h>

#include "planner/plan-compare.h"
#include "planner/sentence-edit.h"
#include "push/state-perturb.h"
#include "stream/run.h"

enum { PIECES = 32 };
static const double fastest = 4 /* of lambda/omega */, budget = 6e8 /* ns */;

struct pm_frame *pm_digits_moved(const struct pm_frame *f, uint64_t seed)
{
	const struct pm_perturb p = {.seed = seed};
	struct pm_frame *g = pm_plan_bare(f);
	int status = g ? pm_perturb_declare(&p, g) : -PM_DATA;
	if (status >= 0)
		status = pm_frame_ready(g);
	if (status >= 0)
		pm_perturb_apply(&p, g), status = pm_frame_settle(g);
	return status < 0 ? pm_frame_free(g) : g;
}

/* Bodies that meet one by one, three or more; a field that many sample has no such growth. */
static bool may_part(const struct pm_plan *p)
{
	const struct pm_scales *s = &p->scales;
	const bool points = s->pairs || s->singular || s->n < PM_DIGITS_FEW;
	return points && s->sources > 2 && (s->kind == PM_MASSES || s->kind == PM_VORTICES) && pm_plan_forced(p) &&
		fastest * s->omega * s->time > log(s->accuracy / DBL_EPSILON);
}

/* Of both runs from frame x on, over a part of the time. Its mesh may have grown; f, the first, has the step that was not cut to end a piece. */
static bool affordable(const struct pm_frame *f, const struct pm_frame *x, const struct pm_plan *p, double part)
{
	struct pm_edit e;
	if (!pm_edit_read(&e, p->sentence))
		return false;
	const double dt = pm_edit_step(&e, f), known = isnan(dt) ? pm_plan_steps(f, p) : p->scales.time / fabs(dt);
	return 2 * part * (isfinite(known) ? known : 5000 /* a guess, of a sentence that chooses its steps */) * pm_edit_cost(&e, x, p) < budget;
}

/* One piece of both runs; x and y are replaced by their ends. */
static int piece(const struct pm_plan *p, double to, struct pm_frame **x, struct pm_frame **y)
{
	struct pm_plan_span a, b;
	int status = pm_plan_run_span(*x, p->sentence, HUGE_VAL, to, INT64_MAX, &a);
	if (status)
		return status;
	pm_frame_free(*x), *x = a.end;
	pm_frame_free(a.half);
	status = pm_plan_run_span(*y, p->sentence, HUGE_VAL, to, INT64_MAX, &b);
	if (status)
		return status;
	pm_frame_free(*y), *y = b.end;
	pm_frame_free(b.half);
	return 0;
}

static void refuse(struct pm_plan *p, const char *of, double held, double at, double difference)
{
	snprintf(p->refused, sizeof p->refused, "accuracy %g of %s refused: rounding and chaos forbid it after t = %.3g: runs that differ in the last bit of "
		"their input differ by %.2g at t = %.3g (-t %.3g, or read sums over many bodies)", p->scales.accuracy, of, held, difference, at, held);
}

int pm_plan_digits(const struct pm_frame *f, struct pm_plan *p)
{
	p->refused[0] = 0;
	if (!may_part(p))
		return 0;
	if (!affordable(f, f, p, 1)) {
		snprintf(p->unproved, sizeof p->unproved,
			"single orbits may part: sqrt(4 pi G rho) T = %.2g; two runs are too long to test it here (the word digits does)",
			p->scales.omega * p->scales.time);
		return 0;
	}
	const char *of = pm_compare_what(f, p);
	const double T = (f->dt < 0 ? -1 : 1) * p->scales.time;
	struct pm_frame *x = pm_plan_bare(f), *y = x ? pm_digits_moved(f, 1) : NULL;
	int status = y ? 0 : pm_failed();
	double held = f->time;
	for (int k = 1; k <= PIECES && !status; k++) {
		const struct pm_frame *scaled[3] = {f, NULL, NULL};
		if ((f->time + T * k / PIECES - x->time) / T <= 1e-9) /* the last step went beyond it */
			continue;
		status = piece(p, f->time + T * k / PIECES, &x, &y);
		scaled[1] = x;
		const double d = status ? NAN : pm_compare(y, x, scaled, p, of);
		if (d > p->scales.accuracy) {
			refuse(p, of, held, x->time, d);
			break;
		}
		held = status ? held : x->time;
		if (!status && k < PIECES && !affordable(f, x, p, 1 - (double)k / PIECES)) {
			snprintf(p->unproved, sizeof p->unproved, "single orbits may part: two runs agree to t = %.3g, where the mesh has grown so far "
				"that the rest is too long to test here (the word digits does)", held);
			break;
		}
	}
	pm_frame_free(x), pm_frame_free(y);
	return status;
}
