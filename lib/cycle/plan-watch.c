/* The numbers that are watched after every step. They need no force: the largest speed beside c, which decides on relativity; the mean of the change field,
 * which the last step has left; and the rms distance from the centre. A decision is due when the first crosses its threshold, when the second is twice
 * what it was of late, or when the last has changed by a factor of two since the last decision: force and density then belong to another place of the
 * atlas. The mean is of magnitudes, so that one close pair among many does not decide; of late is the largest at the last decisions, 0.8 of it at each
 * further one, because the force of a wave vanishes twice in a period. Cost: one pass over the particles. Sums in the order of the particles, for the
 * same bits with any threads. SPDX-License-Identifier: GPL-3.0-or-later */
#include <math.h>

#include "cycle/plan-again.h"
#include "stream/field-value.h"

static bool real(const struct pm_field *f) { return f && (f->type == PM_F64 || f->type == PM_F32); }

static double length(const struct pm_field *f, size_t i)
{
	double square = 0;
	for (int c = 0; c < f->components; c++)
		square += pm_value_at(f, c, i) * pm_value_at(f, c, i);
	return sqrt(square);
}

struct pm_replan_seen pm_replan_look(const struct pm_frame *f)
{
	const struct pm_law *law = pm_law_of(f);
	struct pm_replan_seen s = {0, 0, 0};
	double n = 0, rates = 0, sum[3] = {0}, square[3] = {0};
	for (size_t k = 0; k < f->nsets; k++) {
		const struct pm_set *set = f->sets[k];
		const bool moves = pm_set_moves(f, set);
		const struct pm_field *x = pm_frame_field(f, set->name, "x"), *v = pm_frame_field(f, set->name, "v");
		const struct pm_field *a = law && law->change ? pm_frame_field(f, set->name, law->change) : NULL;
		for (size_t i = 0; moves && real(v) && i < v->count; i++)
			s.speed = fmax(s.speed, length(v, i));
		for (size_t i = 0; moves && real(a) && i < a->count; i++)
			s.rate += length(a, i), rates++;
		for (size_t i = 0; moves && real(x) && i < x->count; i++, n++)
			for (int d = 0; d < f->dim; d++) {
				const double y = pm_value_at(x, d, i) - f->lo[d]; /* from the box: no cancellation between large numbers */
				sum[d] += y, square[d] += y * y;
			}
	}
	for (int d = 0; d < f->dim && n > 0; d++)
		s.spread += fmax(0, square[d] / n - pow(sum[d] / n, 2));
	s.spread = sqrt(s.spread);
	s.rate = rates > 0 ? s.rate / rates : 0;
	return s;
}

/* Estimates are right to a factor of two, so they are compared with half the accuracy (lib/effect-parts/effect-decision.h); out at a third of that. */
static bool faster(double before, double now, double c, double accuracy)
{
	const double in = 0.5 * accuracy, a = pow(before / c, 2), b = pow(now / c, 2);
	return c > 0 && ((a <= in && b > in) || (a > in / 3 && b <= in / 3));
}

static bool doubled(double before, double now) { return before > 0 && now > 2 * before; }

struct pm_replan_seen pm_replan_remember(const struct pm_replan_seen *before, const struct pm_frame *f)
{
	struct pm_replan_seen now = pm_replan_look(f);
	now.rate = fmax(now.rate, 0.8 * before->rate);
	return now;
}

bool pm_replan_weak(const struct pm_replan_seen *before, const struct pm_frame *f) { return pm_replan_look(f).rate < 0.5 * before->rate; }

bool pm_replan_crossed(const struct pm_replan *r, const struct pm_frame *f)
{
	const struct pm_replan_seen now = pm_replan_look(f);
	if (faster(r->seen.speed, now.speed, pm_frame_constant(f, "c", NAN), r->accuracy))
		return true;
	/* not at once again: in a close encounter of a few bodies the force doubles with every step */
	return (f->step - r->decided) * 10 >= r->every && (doubled(r->seen.rate, now.rate) || doubled(r->seen.spread, now.spread) ||
		doubled(now.spread, r->seen.spread));
}
