/* Options and reports of error-controlled steps. SPDX-License-Identifier: GPL-3.0-or-later */
#include <float.h>
#include <inttypes.h>
#include <stdlib.h>

#include "stage/control-options.h"
#include "stage/strength-report.h"
#include "stream/acting-forces.h"

bool pm_control_chosen(const struct pm_push *p) { return p->scheme && pm_step_decides(p->scheme); }

int pm_control_begin(const struct pm_stage *s, const struct pm_push *p)
{
	const char *const names[] = {"tolerance", "min", "max"};
	for (int i = 0; i < 3; i++)
		if (pm_given(s, names[i]) && !(pm_control_chosen(p) && pm_step_adapts(p->scheme)))
			return pm_fail(PM_USAGE, "--%s belongs to a scheme that chooses its steps by their error (push ias15, rk45, rk23, rk4-double, "
				"midpoint-double)", names[i]);
	if (p->dense && !(p->scheme && p->scheme->embedded))
		return pm_fail(PM_USAGE, "--dense belongs to an embedded pair (push rk45, rk23, rk4-double, midpoint-double)");
	if (p->scheme && p->scheme->embedded && p->tolerance > 0 && p->tolerance < DBL_EPSILON)
		return pm_fail(PM_USAGE, "--tolerance %g of the state is below rounding, %.2g, and no step meets it (1e-14 is the least that makes sense)",
			p->tolerance, DBL_EPSILON);
	if (p->floor > p->most)
		return pm_fail(PM_USAGE, "--min %g is above --max %g", p->floor, p->most);
	if (pm_control_chosen(p) && pm_step_adapts(p->scheme) && p->tolerance > 0 && pm_given(s, "dt"))
		return pm_fail(PM_USAGE, "%s chooses its steps (smod --dt before it gives the first one, --min and --max limit them; with --tolerance 0 all "
			"are --dt)", p->scheme->name);
	return 0;
}

static void tell(struct pm_stage *s, struct pm_frame *f, const struct pm_step *scheme, const struct pm_controlled *done)
{
	if (!scheme->embedded)
		pm_report_count(s, f, "iterations", (uint64_t)done->iterations);
	if (scheme->implicit) {
		if (done->beyond)
			pm_report_count(s, f, "beyond", done->beyond);
		if (done->beyond)
			pm_tell_once(s, "the step to time %.9g: for %" PRIu64 " particles dt %g is beyond 1/growth, or another solution than the one "
				"that goes over into the start as dt falls was found (det(1 - dt J) < 0; counted as beyond; a shorter dt)", f->time,
				done->beyond, done->dt);
		return;
	}
	pm_report(s, f, "error", done->error);
	pm_report_count(s, f, "rejected", done->rejected);
	pm_report_count(s, f, "below_min", done->least);
	if (scheme->embedded)
		pm_report_count(s, f, "steps", done->completed);
	if (scheme->control) {
		pm_report_count(s, f, "rounded", done->rounded);
		pm_report_count(s, f, "unconverged", done->unconverged);
	}
	if (done->rejected)
		pm_say(s, "the step from time %.9g is rejected: with dt %g its error is %.3g (again with %g)", f->start, done->dt, done->error, done->next);
	if (done->unconverged)
		pm_tell_once(s, "the step to time %.9g: %d iterations did not converge with dt %g (counted as unconverged; --max makes steps shorter)", f->time,
			done->iterations, done->dt);
}

static void count(struct pm_control_tally *t, const struct pm_controlled *done)
{
	const double dt = fabs(done->dt);
	t->rejected += done->rejected;
	t->iterations += done->iterations > 0 ? (uint64_t)done->iterations : 0;
	if (!done->completed)
		return;
	t->shortest = t->steps ? fmin(t->shortest, dt) : dt;
	t->longest = fmax(t->longest, dt);
	t->steps++;
}

int pm_control_end(const struct pm_stage *s, const struct pm_push *p, const struct pm_control_tally *t)
{
	if (t->steps < 2)
		return 0;
	if (p->scheme->implicit)
		pm_note(s, "%s: %" PRIu64 " steps, %.3g iterations each", p->scheme->name, t->steps, (double)t->iterations / (double)t->steps);
	else
		pm_note(s, "%s: %" PRIu64 " steps of %.3g to %.3g, %" PRIu64 " rejected", p->scheme->name, t->steps, t->shortest, t->longest, t->rejected);
	return 0;
}

int pm_control_pass(struct pm_stage *s, struct pm_frame *f, size_t n, struct pm_moving *moving, const struct pm_push *p, struct pm_control_tally *tally)
{
	struct pm_controlled done;
	struct pm_strengths after, *given = calloc(n + 1, sizeof *given);
	if (!given)
		return pm_no_memory();
	for (size_t i = 0; i < n; i++)
		for (int r = 0; r < moving[i].n; r++)
			pm_acting_note(f, moving[i].rates[r].rate);
	for (size_t i = 0; i < n; i++)
		pm_moving_given(f, &moving[i], &given[i]);
	const int status = pm_control_run(f, n, moving, p, &done);
	for (size_t i = 0; i < n && !status; i++) {
		pm_moving_given(f, &moving[i], &after);
		pm_report_strengths(s, f, "given", &given[i], &after);
	}
	free(given);
	if (!status && (done.completed || done.rejected)) {
		tell(s, f, p->scheme, &done);
		count(tally, &done);
	}
	return status;
}
