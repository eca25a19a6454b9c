/* cycle: step 120/300, time 12, 40 %, 52 steps/s, 0:03 left, energy +1.2e-05
 * The speed is that of the last ten seconds or so. The energy is the relative change since the first full step that has it (potentials at the particles or on
 * the mesh); it is measured on a copy, and takes at most a fiftieth of the run. SPDX-License-Identifier: GPL-3.0-or-later */
#include <stdio.h>
#include <string.h>
#include <sys/stat.h>
#include <unistd.h>

#include "base/status-line.h"
#include "cycle/progress.h"
#include "measure/diag-column.h"
#include "stream/run.h"

static const double often = 0.2, longest = 60, memory = 10, share = 0.02; /* [s] between two lines in place; between lines; of the speed; of the energy */

void pm_progress_begin(struct pm_progress *p, const struct pm_stage *s, const struct pm_frame *f)
{
	const double now = pm_seconds();
	p->line = !s->quiet && pm_status_possible();
	p->lines = !p->line && s->verbose;
	p->here = p->seen = f->step;
	p->began = p->told = p->at = now;
	p->pause = 1;
	p->wrote = p->rate = p->cost = p->measured = 0;
	p->first_energy = p->energy = NAN;
}

/* [energy] of the frame; NAN: it has none that is known. */
static double energy_of(const struct pm_frame *f)
{
	const struct pm_diag_request all = {0};
	struct pm_frame *copy = pm_frame_copy(f);
	struct pm_measures m;
	double e = NAN;
	if (copy && !pm_diag_reads(&all, copy)) {
		const struct pm_measure how = pm_diag_how(&all, copy);
		if (how.potential && !pm_frame_ready(copy) && !pm_measure_frame(&how, copy, &m))
			e = m.value[PM_ENERGY];
	}
	pm_frame_free(copy);
	return e;
}

static void measure(struct pm_progress *p, const struct pm_frame *f)
{
	const double now = pm_seconds();
	if (f->substep || (p->measured > 0 && now - p->measured < p->cost / share))
		return;
	const double e = energy_of(f);
	p->measured = pm_seconds();
	p->cost = p->measured - now;
	p->energy = isfinite(e) ? e : p->energy;
	p->first_energy = isfinite(p->first_energy) ? p->first_energy : e;
}

static void speed(struct pm_progress *p, const struct pm_frame *f, double now)
{
	const double passed = now - p->at;
	if (f->step == p->seen || passed <= 0)
		return;
	const double late = (double)(f->step - p->seen) / passed;
	p->rate = p->rate > 0 ? p->rate + (1 - exp(-passed / memory)) * (late - p->rate) : late;
	p->seen = f->step;
	p->at = now;
}

/* Steps that are left; NAN: unknown. */
static double steps_left(const struct pm_progress *p, const struct pm_frame *f)
{
	const double by_steps = p->steps == INT64_MIN ? NAN : (double)(p->first + p->steps - f->step), by_time = (p->to - f->time) / f->dt;
	return fmax(fmin(by_steps, by_time), 0); /* fmin and fmax leave out a NAN */
}

static void add(char text[], size_t room, const char *format, double x)
{
	const size_t n = strlen(text);
	snprintf(text + n, room - n, format, x);
}

/* 0:34, 12:05, 3:07:00. */
static void add_clock(char text[], size_t room, double seconds)
{
	const size_t n = strlen(text);
	const long long s = (long long)fmin(ceil(seconds), 1e9);
	if (s < 3600)
		snprintf(text + n, room - n, ", %lld:%02lld left", s / 60, s % 60);
	else
		snprintf(text + n, room - n, ", %lld:%02lld:%02lld left", s / 3600, s / 60 % 60, s % 60);
}

static void compose(const struct pm_progress *p, const struct pm_frame *f, bool last, char text[], size_t room)
{
	const bool ends = p->steps != INT64_MIN || !isnan(p->to);
	const double left = ends ? steps_left(p, f) : NAN, done = (double)(f->step - p->first);
	snprintf(text, room, "cycle: step %lld", (long long)f->step);
	if (p->steps != INT64_MIN && !last)
		add(text, room, "/%.0f", (double)(p->first + p->steps));
	add(text, room, last ? ", time %.6g" : ", time %.4g", f->time);
	if (ends && !last && done + left > 0)
		add(text, room, ", %.0f %%", floor(100 * done / (done + left)));
	if (last)
		add(text, room, ", %.3g s", pm_seconds() - p->began);
	const double rate = last ? (double)(f->step - p->here) / fmax(pm_seconds() - p->began, 1e-9) : p->rate;
	if (rate > 0)
		add(text, room, rate < 0.1 ? ", %.3g s a step" : ", %.3g steps/s", rate < 0.1 ? 1 / rate : rate);
	if (ends && !last && p->rate > 0)
		add_clock(text, room, left / p->rate);
	if (isfinite(p->energy) && p->first_energy != 0 && p->measured > 0)
		add(text, room, ", energy %+.1e", (p->energy - p->first_energy) / fabs(p->first_energy));
}

static bool due(const struct pm_progress *p, double now)
{
	if (p->lines)
		return now - p->told >= p->pause;
	return now - p->told >= often && (now - p->wrote >= often / 4 || now - p->told >= 5 * often);
}

void pm_progress_step(struct pm_progress *p, const struct pm_frame *f)
{
	char text[240];
	if (!p->line && !p->lines)
		return;
	const double now = pm_seconds();
	if (f->step > p->here && isnan(p->first_energy))
		measure(p, f);
	if (!due(p, now))
		return;
	measure(p, f);
	speed(p, f, now);
	compose(p, f, false, text, sizeof text);
	if (p->line)
		pm_status_line(text);
	else
		fprintf(stderr, "%s\n", text);
	p->told = now;
	p->pause = fmin(2 * p->pause, longest);
}

void pm_progress_writes(struct pm_progress *p)
{
	struct stat st;
	p->wrote = pm_seconds();
	if (p->line && !fstat(STDOUT_FILENO, &st) && S_ISFIFO(st.st_mode))
		pm_status_clear();
}

void pm_progress_end(struct pm_progress *p, const struct pm_frame *f)
{
	char text[240];
	if (!p->line && !p->lines)
		return;
	p->cost = 0; /* once more */
	measure(p, f);
	compose(p, f, true, text, sizeof text);
	pm_status_clear();
	fprintf(stderr, "%s\n", text);
}
