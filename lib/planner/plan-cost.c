/* What a planned run costs: its steps, seconds and memory, from steps timed on the frame. Blocks of steps are repeated until their spread is known; a block
 * holds as many steps as lie between two actions that are not done in every step (remeshing). The median is the estimate, the quickest and the slower
 * blocks its uncertainty. Not included: output, the start of the program, and how the cost changes as the frame does (particles that cluster).
 * SPDX-License-Identifier: GPL-3.0-or-later */
#include <stdlib.h>
#include <string.h>

#include "planner/plan.h"
#include "step/step.h"
#include "stream/header.h"

/* ---- statistics of the blocks ---- */

static int by_size(const void *a, const void *b)
{
	const double x = *(const double *)a, y = *(const double *)b;
	return (x > y) - (x < y);
}

/* The value below which this part of the n lies (0: the least, 0.5: the median). */
static double quantile(int n, const double *x, double part)
{
	double sorted[PM_PLAN_BLOCKS];
	memcpy(sorted, x, (size_t)n * sizeof *x);
	qsort(sorted, (size_t)n, sizeof *sorted, by_size);
	const double at = part * (n - 1);
	const int i = (int)at < n - 1 ? (int)at : n > 1 ? n - 2 : 0;
	return n > 1 ? sorted[i] + (at - i) * (sorted[i + 1] - sorted[i]) : sorted[0];
}

/* One block has no spread: then the factor within which the estimates of docs/plan.md are. */
static const double unknown = 1.5;

static void spread(const struct pm_plan_timing *t, double *step, double *low, double *high)
{
	*step = quantile(t->blocks, t->wall, 0.5);
	*low = t->blocks > 1 ? quantile(t->blocks, t->wall, 0) : *step / unknown;
	*high = t->blocks > 1 ? quantile(t->blocks, t->wall, 0.9) : *step * unknown;
}

double pm_plan_word_seconds(const struct pm_plan_timing *t, int word)
{
	double x[PM_PLAN_BLOCKS];
	for (int b = 0; b < t->blocks; b++)
		x[b] = t->word[b][word];
	return quantile(t->blocks, x, 0.5);
}

/* ---- the run ---- */

static int common(int a, int b)
{
	int x = a, y = b;
	while (y) {
		const int rest = x % y;
		x = y, y = rest;
	}
	return a / x * b;
}

int pm_plan_period(const struct pm_plan *p)
{
	int steps = 1;
	for (int i = 0; i < p->neffects; i++)
		if (p->effect[i].decision.answer == PM_PUT_IN && !p->effect[i].lacking && p->effect[i].decision.every > 1)
			steps = common(steps, p->effect[i].decision.every);
	return steps;
}

/* Steps that cycle -t does: it stops at the first with time >= T - dt/2. */
static double steps_of(const struct pm_plan *p, double dt) { return fmax(0, ceil(p->scales.time / fabs(dt) - 0.5 - 1e-6)); }

static double step_of(const struct pm_frame *f, const struct pm_plan *p) { return isnan(p->method.dt) ? f->dt : p->method.dt; }

/* Of a plan that follows an orbit, by the evaluations of the force that the atlas or the trials needed. */
static double followed(const struct pm_plan *p)
{
	const struct pm_step *scheme = strcmp(p->method.scheme, "leapfrog") ? pm_step_find(p->method.scheme) : NULL;
	return isnan(p->method.follow) && isnan(p->method.tolerance) ? NAN : ceil(p->method.evaluations / (scheme ? scheme->passes : 1));
}

double pm_plan_steps(const struct pm_frame *f, const struct pm_plan *p)
{
	return isfinite(followed(p)) ? followed(p) : steps_of(p, step_of(f, p));
}

static double bytes(const struct pm_field *field) { return (double)field->count * field->components * (double)pm_type_size(field->type); }

/* Of a frame that cycle writes: without what mgrad made of the potential, and without its header. */
static double written(const struct pm_frame *g, const struct pm_law *law)
{
	double all = 0;
	for (size_t i = 0; i < g->nfields; i++) {
		const struct pm_field *field = g->fields[i];
		const bool made = field->role == PM_DERIVED && law->field && !strcmp(field->name, law->field);
		all += made || field->uniform ? 0 : bytes(field);
	}
	return all;
}

/* Fields that the timed steps copied because the frame is still needed here: a run has them once. */
static double twice(const struct pm_frame *f, const struct pm_frame *g)
{
	double all = 0;
	for (size_t i = 0; i < f->nfields; i++) {
		const struct pm_field *other = pm_frame_field(g, f->fields[i]->on, f->fields[i]->name);
		all += f->fields[i]->buffer && (!other || other->buffer != f->fields[i]->buffer) ? bytes(f->fields[i]) : 0;
	}
	return all;
}

int pm_plan_price(const struct pm_frame *f, struct pm_plan *p)
{
	struct pm_plan_timing t;
	struct pm_plan_cost *c = &p->cost;
	struct pm_frame *g = pm_plan_time(f, p->sentence, pm_plan_period(p), pm_plan_steps(f, p), &t);
	if (!g)
		return pm_failed();
	const double dt = step_of(f, p), advance = fabs(g->time - f->time) / t.steps; /* a sentence may choose its steps itself */
	spread(&t, &c->step, &c->low, &c->high);
	c->varies = fabs(advance / dt - 1) > 1e-6 && fabs(advance / -dt - 1) > 1e-6;
	c->steps = isfinite(followed(p)) ? followed(p) : steps_of(p, c->varies ? advance : dt);
	c->begin = fmax(t.first - c->step, 0);
	c->processor = t.processor;
	c->load = t.load;
	c->timed = t.timed;
	c->memory = t.peak - twice(f, g);
	c->written = written(g, p->law);
	for (int k = 0; k < p->nstages; k++)
		p->stage[k].seconds = pm_plan_word_seconds(&t, k);
	pm_frame_free(g);
	return 0;
}

bool pm_plan_too_dear(const struct pm_frame *f, struct pm_plan *p, double seconds)
{
	const double step = pm_plan_forced(p) ? pm_plan_force_seconds(&p->scales) / pm_threads() : 0;
	p->cost = (struct pm_plan_cost){.steps = pm_plan_steps(f, p), .step = step};
	return seconds > 0 && pm_plan_seconds(p) > 10 * seconds;
}

double pm_plan_seconds(const struct pm_plan *p) { return p->cost.begin + p->cost.steps * p->cost.step; }

/* Seconds per step that another sentence takes more than the plan's; spread: what of that is noise. */
double pm_plan_dearer(const struct pm_plan *p, const struct pm_plan_timing *t, double *noise)
{
	double step, low, high;
	spread(t, &step, &low, &high);
	*noise = hypot(high - low, p->cost.high - p->cost.low) / 2;
	return step - p->cost.step;
}

/* ---- as text, and for programs ---- */

const char *pm_plan_duration(double seconds, char text[32])
{
	const char *unit = seconds < 1e-3 ? "us" : seconds < 1 ? "ms" : seconds < 600 ? "s" : seconds < 36000 ? "min" : "h";
	const double scale = seconds < 1e-3 ? 1e6 : seconds < 1 ? 1e3 : seconds < 600 ? 1 : seconds < 36000 ? 1 / 60. : 1 / 3600.;
	snprintf(text, 32, isnan(seconds) ? "-" : seconds < 1e-6 ? "< 1 us" : "%.3g %s", seconds * scale, unit);
	return text;
}

static const char *size(double bytes, char text[32])
{
	const double scale = bytes < 1e6 ? 1e3 : bytes < 1e9 ? 1e6 : 1e9;
	snprintf(text, 32, "%.3g %s", bytes / scale, bytes < 1e6 ? "kB" : bytes < 1e9 ? "MB" : "GB");
	return text;
}

void pm_plan_print_cost(FILE *out, const struct pm_plan *p)
{
	const struct pm_plan_cost *c = &p->cost;
	char all[32], low[32], high[32], begin[32], work[32];
	fprintf(out, "#\n# the run            %s%.0f step%s, %s", c->varies ? "about " : "", c->steps, c->steps == 1 ? "" : "s",
		pm_plan_duration(pm_plan_seconds(p), all));
	fprintf(out, " (%s to %s), of it %s to begin; processor %s", pm_plan_duration(c->begin + c->steps * c->low, low),
		pm_plan_duration(c->begin + c->steps * c->high, high), pm_plan_duration(c->begin, begin), pm_plan_duration(c->steps * c->processor, work));
	fprintf(out, "; from %d step%s timed, without output\n", c->timed, c->timed == 1 ? "" : "s");
	if (c->load > 1.25) /* a guess: threads wait for each other on a quiet machine, too */
		fprintf(out, "# the machine is loaded: a step took %.2g times as long as the processor worked on it; its time holds on a quiet one\n", c->load);
	if (p->within > 0) {
		fprintf(out, "# within %-11s accuracy %.2g by the estimates of the atlas, on this machine",
			pm_plan_duration(p->within, all), p->scales.accuracy);
		fprintf(out, isnan(p->next) ? "\n" : p->forbidden ? "; %.2g cannot be had\n" : "; %.2g takes longer\n", p->next);
	}
	if (isnan(c->memory))
		fprintf(out, "# memory             not measured: the system does not say what a process holds at most;");
	else
		fprintf(out, "# memory             %s at most;", size(c->memory, all));
	fprintf(out, " a frame written takes %s\n", size(c->written, all));
}

json_t *pm_plan_cost_json(const struct pm_plan *p)
{
	const struct pm_plan_cost *c = &p->cost;
	return json_pack("{s:o,s:o,s:o,s:o,s:o,s:o,s:o,s:o,s:i,s:o,s:o}", "steps", pm_json_number(c->steps), "seconds_per_step", pm_json_number(c->step),
		"set_up", pm_json_number(c->begin), "seconds", pm_json_number(pm_plan_seconds(p)), "seconds_low",
		pm_json_number(c->begin + c->steps * c->low), "seconds_high", pm_json_number(c->begin + c->steps * c->high), "processor_per_step",
		pm_json_number(c->processor), "load", pm_json_number(c->load), "steps_timed",
		c->timed, "memory", pm_json_number(c->memory), "frame", pm_json_number(c->written));
}
