/* window: a box that moves with the light (lib/load/moving-window.c). SPDX-License-Identifier: GPL-3.0-or-later */
#include <stdio.h>

#include "load/moving-window.h"
#include "stage/stage.h"

struct config {
	const char *mesh, *axis, *profile;
	double speed, start, each;
	int64_t seed;
	struct pm_vector charges, masses, thermal;
};

static int begin(struct pm_stage *s)
{
	const struct config *o = s->config;
	const struct { const char *name; const struct pm_vector *of; } per[] = {{"charges", &o->charges}, {"masses", &o->masses}, {"thermal", &o->thermal}};
	s->advances = true;
	for (int i = 0; i < 3; i++) {
		if (per[i].of->n > 1 && per[i].of->n != s->nargs)
			return pm_fail(PM_USAGE, "--%s has %d numbers for %d sets (one for each, or one for all)", per[i].name, per[i].of->n, s->nargs);
		for (int k = 0; k < per[i].of->n && i; k++)
			if (!(per[i].of->x[k] >= 0))
				return pm_fail(PM_USAGE, "--%s %g is negative", per[i].name, per[i].of->x[k]);
	}
	return o->each == floor(o->each) ? 0 : pm_fail(PM_USAGE, "--per-cell %g is not a whole number", o->each);
}

static double of(const struct pm_vector *v, int set, double otherwise) { return v->n ? v->x[v->n > 1 ? set : 0] : otherwise; }

static struct pm_window window_of(const struct pm_stage *s, const struct pm_frame *f)
{
	const struct config *o = s->config;
	struct pm_window w = {.axis = *o->axis - 'x', .speed = o->speed, .from = o->start, .mesh = o->mesh, .sets = s->nargs, .set = s->args,
		.each = (int)o->each, .density = o->profile, .seed = pm_given(s, "seed") ? (uint64_t)o->seed : f->seed};
	for (int i = 0; i < s->nargs; i++) {
		w.charge[i] = of(&o->charges, i, -1);
		w.mass[i] = of(&o->masses, i, 1);
		w.vth[i] = of(&o->thermal, i, 0);
	}
	return w;
}

static int declare(struct pm_stage *s, struct pm_frame *f)
{
	struct pm_window w = window_of(s, f);
	int status = pm_window_declare(&w, f);
	return status < 0 ? status : status == PM_WINDOW_WAITS ? PM_PASS : PM_HOLD;
}

static int frame(struct pm_stage *s, struct pm_frame *f)
{
	const struct pm_window w = window_of(s, f);
	struct pm_window_report r;
	int status = pm_window_step(&w, f, &r);
	if (status)
		return status;
	pm_report_sum(s, f, "cells", r.shifted);
	pm_report_count(s, f, "came", r.came);
	pm_report_count(s, f, "left", r.left);
	pm_report_sum(s, f, "given_mass", r.given[0]);
	pm_report_sum(s, f, "given_charge", r.given[1]);
	for (int i = 0; i < r.behind.n; i++) {
		char name[2 * PM_STRENGTH_NAME];
		snprintf(name, sizeof name, "absorbed_%s", r.behind.of[i].name);
		pm_report_sum(s, f, name, r.behind.of[i].sum);
	}
	return 0;
}

static const char *const axes[] = {"x", "y", "z", NULL};
static const struct pm_option options[] = {
	{.name = "profile", .kind = PM_TEXT, .unit = "EXPRESSION", PM_AT(profile),
		.text = "real particles per volume of the plasma that comes in, in x, y, z and the frame's constants (default: 1)"},
	{.name = "per-cell", .letter = 'n', .kind = PM_REAL, .fallback = "2", .low = 1, .high = 100, PM_AT(each),
		.text = "particles of a set in a cell, along every axis"},
	{.name = "charges", .kind = PM_VECTOR, .unit = "charge", PM_AT(charges), .text = "of one real particle, one number or one a set (default: -1)"},
	{.name = "masses", .kind = PM_VECTOR, .unit = "mass", PM_AT(masses), .text = "the same of the mass (default: 1)"},
	{.name = "thermal", .kind = PM_VECTOR, .unit = "length/time", PM_AT(thermal), .text = "standard deviation of each component of v (default: 0)"},
	{.name = "speed", .kind = PM_REAL, .unit = "length/time", .low = 0, .high = 1e300, PM_AT(speed), .text = "of the window (default: c of the law)"},
	{.name = "start", .kind = PM_REAL, .unit = "time", .fallback = "0", .low = -1e300, .high = 1e300, PM_AT(start), .text = "when it sets out"},
	{.name = "axis", .kind = PM_WORD, .fallback = "x", .choices = axes, PM_AT(axis), .text = "along which it moves, upward"},
	{.name = "seed", .kind = PM_INTEGER, .high = 9e15, PM_AT(seed), .text = "seed of the random numbers; by default the frame's"},
	{.name = "mesh", .kind = PM_TEXT, .unit = "NAME", PM_AT(mesh), .text = "the mesh (default: the first)"},
	{0},
};
static const struct pm_example examples[] = {
	{"a pulse of light makes a wake in the plasma that it enters",
		"pinit wakefield --cells 400 | cycle -n 100 --every 50 'push boris/2 | p2m --current | maxwell | push drift | "
		"window electrons --profile \"x > 22\" | m2p | push boris/2' | diag"},
	{0},
};
const struct pm_tool tool_window = {
	.name = "window",
	.summary = "let the box move with the light: plasma comes in in front, and falls out behind",
	.about = "The box and its mesh move along --axis with --speed, by whole cells, once a step, behind the drift (push drift | window ... | m2p). Fields "
		"keep their place in space; new cells in front have none, and get --per-cell particles of each SET along every axis, with weights by "
		"--profile. Without SET nothing comes in. What is behind the window is removed, and reported. See docs/methods/window.md.",
	.kind = PM_FILTER,
	.changes = "the box, the state of the mesh, x, v, mass, charge, id",
	.config = sizeof(struct config),
	.options = options,
	.arguments = "[SET...]",
	.arguments_text = "what comes in: up to three sets of the frame",
	.most = PM_WINDOW_SETS,
	.examples = examples,
	.begin = begin,
	.declare = declare,
	.frame = frame,
};
