/* Where the run ends by -t is decided from the header alone. Without --exact it is the step nearest to the end. With --exact a step that would pass the end
 * is made with dt = end - time; then the time is set to the end itself, since time + (end - time) may differ from it in the last bit, and dt to what it was:
 * dt is the length of the steps to come. Both set since anew (stream/frame-time.h). Ends that a whole number of steps reaches to 1e-9 dt need no shorter
 * step, so that the bytes are those without --exact. SPDX-License-Identifier: GPL-3.0-or-later */
#include <string.h>

#include "cycle/run-end.h"
#include "step/step.h"
#include "stream/frame-time.h"

static const double round_off = 1e-9; /* of dt; a time is rounded to 1e-16 of itself, so after 1e6 steps to 1e-10 dt */

/* [time] to the end, positive before it. */
static double left(const struct pm_run_end *e, const struct pm_frame *f) { return f->dt < 0 ? f->time - e->time : e->time - f->time; }

/* The word that sets dt, as typed; NULL none. */
static const char *setter(const struct pm_sentence *s)
{
	const struct pm_stage *w;
	for (int i = 0; i < pm_sentence_words(s); i++)
		if ((w = pm_sentence_stage(s, i)) && (!strcmp(w->tool->name, "dt") || pm_given(w, "dt")))
			return w->word;
	return NULL;
}

/* Is there a scheme that chooses its steps? */
static bool chooses(const struct pm_sentence *s)
{
	bool found = false;
	for (int i = 0; i < pm_sentence_words(s) && !found; i++) {
		const struct pm_stage *w = pm_sentence_stage(s, i);
		for (int k = 0; w && k < w->nargs && !found; k++)
			for (int j = 0; pm_steps[j] && !found; j++)
				found = pm_step_adapts(pm_steps[j]) && !strcmp(w->args[k], pm_step_names[j]);
	}
	return found;
}

int pm_run_end_check(struct pm_run_end *e, const struct pm_sentence *s)
{
	e->chosen = e->exact && chooses(s);
	const char *word = e->exact ? setter(s) : NULL;
	return word ? pm_fail(PM_USAGE, "--exact makes the last step shorter, but '%s' sets dt in every step (leave one of them out; smod --dt before cycle "
		"sets dt once)", word) : 0;
}

bool pm_run_end_reached(const struct pm_run_end *e, const struct pm_frame *f)
{
	const double nearest = e->time - f->dt / 2;
	if (isnan(e->time))
		return false;
	return e->exact ? left(e, f) <= fabs(f->dt) * round_off : f->dt < 0 ? f->time <= nearest : f->time >= nearest;
}

void pm_run_end_shorten(struct pm_run_end *e, struct pm_frame *f)
{
	if (!e->exact || f->substep || isnan(e->time) || !(left(e, f) < fabs(f->dt) * (1 - round_off)))
		return;
	e->dt = f->dt;
	pm_frame_dt_set(f, e->time - f->time);
}

int pm_run_end_restore(struct pm_run_end *e, struct pm_frame *f)
{
	if (e->dt == 0 || f->substep)
		return 0;
	const bool there = fabs(f->time - e->time) <= 1e-6 * fabs(e->dt);
	if (!there && e->chosen) { /* the step to the end was rejected: another follows */
		e->dt = 0;
		return 0;
	}
	if (!there)
		return pm_fail(PM_USAGE, "--exact: the last step ended at time %.9g, not at %.9g: a word of the sentence sets dt or time", f->time, e->time);
	f->time = f->start = e->time;
	f->dt = e->dt;
	pm_frame_since_renew(f);
	e->dt = 0;
	return 0;
}

void pm_run_end_tell(struct pm_run_end *e, const struct pm_stage *cycle, const struct pm_sentence *s, const struct pm_frame *f, int64_t steps, double began)
{
	const double span = fabs(e->time - began), off = fabs(e->time - f->time), step = fabs(f->dt);
	const bool exactly = step > span || chooses(s); /* steps that a scheme chooses are long, and nobody knows where they end */
	if (e->told || isnan(e->time) || !(off > (exactly ? round_off * fmax(step, span) : 0.01 * span)))
		return;
	e->told = true;
	if (steps && f->dt < 0 && e->time > began)
		pm_note(cycle, "ended at time %.9g after %lld step%s of dt %.9g: it goes back in time, away from -t %.9g (-n STEPS, or a time before %.9g)",
			f->time, (long long)steps, steps == 1 ? "" : "s", f->dt, e->time, began);
	else if (!steps && off > step)
		pm_note(cycle, "no step: the frame is at time %.9g, beyond -t %.9g (-t is the time at the end, not the length of the run)", f->time, e->time);
	else if (chooses(s))
		pm_note(cycle, "ended at time %.9g after %lld step%s, not at %.9g: it ends at the nearest step (--exact makes the last one shorter)", f->time,
			(long long)steps, steps == 1 ? "" : "s", e->time);
	else
		pm_note(cycle, "ended at time %.9g after %lld step%s of dt %.9g, not at %.9g: it ends at the nearest step (%s)", f->time, (long long)steps,
			steps == 1 ? "" : "s", f->dt, e->time, setter(s) ? "a shorter dt" : "--exact makes the last one shorter, or a shorter dt");
}
