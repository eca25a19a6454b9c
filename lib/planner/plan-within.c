/* The most accurate plan whose run takes no longer than a given time on this machine: bisection over accuracies from 1 to 1e-6, four in a decade, each
 * planned and priced. Assumes that a more accurate run takes longer, and that what chaos forbids it forbids to all finer ones; the plan returned does fit,
 * whether or not the first holds. What costs ten times too much by the atlas' cost of a force is not timed. Cost: about seven plans.
 * SPDX-License-Identifier: GPL-3.0-or-later */
#include <stdlib.h>
#include <string.h>

#include "planner/plan.h"

int pm_plan_budget(const char *text, double *seconds)
{
	static const struct {
		const char *unit;
		double seconds;
	} units[] = {{"us", 1e-6}, {"ms", 1e-3}, {"s", 1}, {"min", 60}, {"h", 3600}, {"", 1}}; /* as pareto --within */
	char *end;
	*seconds = strtod(text, &end);
	for (size_t i = 0; i < sizeof units / sizeof *units; i++)
		if (*seconds > 0 && isfinite(*seconds) && strspn(text, "0123456789.") && !strpbrk(text, "xX") && !strcmp(end, units[i].unit)) {
			*seconds *= units[i].seconds;
			return 0;
		}
	return pm_fail(PM_USAGE, "option '--within': '%s' is not a time (2s, 50ms, 1.5min)", text);
}

enum { FINEST = 24 };

static double accuracy(int k)
{
	static const double steps[] = {1, 0.5, 0.3, 0.2};
	return steps[k % 4] * pow(10, -(k / 4));
}

static int try(const struct pm_frame *f, struct pm_plan_choice c, int k, double seconds, struct pm_plan *p)
{
	c.accuracy = accuracy(k);
	c.cost = true;
	c.within = seconds;
	return pm_plan_frame(f, &c, p);
}

int pm_plan_within(const struct pm_frame *f, const struct pm_plan_choice *c, struct pm_plan *p)
{
	char has[32], needs[32];
	struct pm_plan q;
	int status = try(f, *c, 0, c->within, p), good = 0, bad = FINEST + 1;
	if (status)
		return status;
	p->next = NAN, p->forbidden = false;
	if (!(pm_plan_seconds(p) <= c->within))
		return pm_fail(PM_DATA, "no plan takes as little as %s on this machine: at accuracy 1 it is %s (an earlier end -t, or more time)",
			pm_plan_duration(c->within, has), pm_plan_duration(pm_plan_seconds(p), needs));
	p->within = c->within;
	while (bad - good > 1 && !*p->refused) {
		const int k = (good + bad) / 2;
		status = try(f, *c, k, c->within, &q);
		if (status && status != -PM_NUMERICS)
			return status;
		const bool had = !status && !*q.refused && !*q.unproved; /* chaos or rounding forbid it, or may: too dear to test */
		q.next = p->next, q.forbidden = p->forbidden, q.within = c->within;
		if (had && pm_plan_seconds(&q) <= c->within)
			good = k, *p = q;
		else
			bad = k, p->next = accuracy(k), p->forbidden = !had;
	}
	return 0;
}
