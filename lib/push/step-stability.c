/* A step held against the stability region of its scheme: |dt| times a limit of a rate (stream/limits.h) must not pass where the region ends, on the real axis
 * for a decay, on the imaginary one for an oscillation. The strain of a flow has no such end: it is told, not refused.
 * SPDX-License-Identifier: GPL-3.0-or-later */
#include <stdio.h>
#include <string.h>

#include "push/push-set.h"
#include "stream/limits.h"

/* What a step is compared with. */
struct stability {
	const char *name;
	double dt, part; /* [time] of the frame; the absolute value of what the push advances by, a kick/2 for a whole step */
	bool backwards;  /* a composition */
	bool weak;       /* no oscillation is stable, others can do better */
};

/* One axis of the stability region: does the rate stay within it? The remedy is the longest step that does. */
static int within(const struct pm_rate *r, const char *does, double rate, double limit, const struct stability *s)
{
	const struct pm_field *change = r->rate;
	char terms[PM_TERMS * (PM_NAME + 2)] = "";
	if (!(s->part * rate > limit * (1 + 1e-12)))
		return 0;
	if (limit == 0)
		return pm_fail(PM_NUMERICS, "'%s' of '%s' %s, and %s has %s (rk4, lsrk3, or --unsafe)", change->name, change->on, does, s->name,
			s->backwards ? "parts of a step that go backwards" : "a second root that grows where there is any decay");
	for (int t = 0; t < change->nterms; t++)
		snprintf(terms + strlen(terms), sizeof terms - strlen(terms), "%s%s", t ? ", " : "", change->terms[t]);
	return pm_fail(PM_NUMERICS, "dt %g is %.4g times the limit of %s: '%s' of '%s' (%s) %s at up to %g per time, and the step would grow "
		"without bound (dt up to %.6g%s, or --unsafe)", s->dt, s->part * rate / limit, s->name, change->name, change->on, terms, does, rate,
		fabs(s->dt) * limit / (s->part * rate), s->weak ? ", lsrk3, rk4 or leapfrog" : "");
}

double pm_moving_strain(const struct pm_frame *f, const struct pm_moving *m)
{
	for (int r = 0; r < m->n; r++)
		if (m->rates[r].state == m->x)
			return m->rates[r].rate->limits.strain * fabs(f->dt);
	return 0;
}

int pm_moving_stable(const struct pm_frame *f, const struct pm_moving *m, const struct pm_push *p)
{
	/* kicks, also magnetic ones: Euler's limit for decay, leapfrog's for oscillations */
	const struct pm_step *scheme = p->scheme;
	const struct stability s = {.name = scheme ? scheme->name : "a kick", .dt = f->dt, .part = fabs(f->dt) * m->part, .backwards = scheme && scheme->kicks,
		.weak = scheme && scheme->imaginary_limit == 0};
	const double decay = scheme ? scheme->real_limit : 2, turn = !scheme ? 2 : s.weak ? scheme->doubling : scheme->imaginary_limit;
	int status = 0;
	if (p->unsafe || !(scheme || p->kick > 0))
		return 0;
	for (int r = 0; r < m->n && !status; r++) {
		const struct pm_rate *rate = m->rates + r;
		struct pm_limits l = rate->rate->role == PM_CHANGE ? pm_limits_most(rate->rate, turn / s.part) : (struct pm_limits){0};
		if (s.part * l.oscillation > turn)
			l = pm_limits_of(rate->rate);
		status = within(rate, "decays", l.decay, decay, &s);
		if (!status)
			status = within(rate, "oscillates", l.oscillation, turn, &s);
	}
	return status;
}
