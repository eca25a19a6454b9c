/* dt: writes the time step that the state of a frame allows (lib/measure/timestep-rules.c). SPDX-License-Identifier: GPL-3.0-or-later */
#include "measure/timestep-rules.h"
#include "stage/stage.h"
#include "stream/frame-time.h"

struct config {
	struct pm_timestep_rules rules;
	double least, most, until;
};

static int begin(struct pm_stage *s)
{
	const struct config *cfg = s->config;
	if (!pm_timestep_ruled(&cfg->rules) && !pm_given(s, "until"))
		return pm_fail(PM_USAGE, "no rule (--courant C, --acceleration ETA, --lcfl C, --plasma C, --oscillation C, or --until T alone)");
	if (cfg->least > cfg->most)
		return pm_fail(PM_USAGE, "--min %g is above --max %g", cfg->least, cfg->most);
	return 0;
}

static int declare(struct pm_stage *s, struct pm_frame *f)
{
	if (f->substep)
		return PM_PASS;
	int status = pm_timestep_declare(&((const struct config *)s->config)->rules, f);
	return status ? status : PM_HOLD;
}

/* Before the end one step, or two of one length, so that the last is not so short that a run by -t ends before it. */
static double ending(double dt, double left)
{
	if (!(left > 1e-9 * dt)) /* there, but for rounding */
		return dt;
	return dt * (1 + 1e-9) >= left ? left : 2 * dt > left ? left / 2 : dt;
}

static int frame(struct pm_stage *s, struct pm_frame *f)
{
	const struct config *cfg = s->config;
	const double back = f->dt < 0 ? -1 : 1;
	double rate, dt = pm_timestep_allowed(&cfg->rules, f, &rate);
	dt = pm_timestep_ruled(&cfg->rules) ? dt : fabs(f->dt);
	pm_report(s, f, "allowed", isfinite(dt) ? dt : 0);
	dt = fmin(dt, cfg->most); /* NaN if not given, which fmin ignores */
	if (dt < cfg->least) {
		dt = cfg->least;
		pm_report_count(s, f, "below_min", 1);
	}
	if (!isfinite(dt)) /* no velocity and no acceleration */
		pm_say(s, "no rule limits the step, dt stays %g", f->dt);
	else
		pm_frame_dt_set(f, back * ending(dt, back * (cfg->until - f->time)));
	if (pm_given(s, "lcfl")) {
		pm_report(s, f, "strain", rate);
		pm_report_count(s, f, "crossing", f->dt * rate > 1 + 1e-9);
		if (f->dt * rate > 1 + 1e-9)
			pm_say(s, "dt |grad u| = %g is above 1: particles may cross (--lcfl 1, or --max %g)", f->dt * rate, 1 / rate);
	}
	return 0;
}

static bool divided(const struct pm_stage *s, const struct pm_frame *f) { return s && f; }

static const struct pm_option options[] = {
	{.name = "courant", .kind = PM_REAL, .unit = "cells", .low = 1e-9, .high = 1e9, PM_AT(rules.courant),
		.text = "no particle crosses more than this fraction of a cell of the first mesh, along any axis"},
	{.name = "acceleration", .kind = PM_REAL, .low = 1e-12, .high = 1e6, PM_AT(rules.acceleration),
		.text = "ETA of dt = sqrt(ETA softening/|acc|), 0.01 to 0.1 for leapfrog"},
	{.name = "lcfl", .kind = PM_REAL, .low = 1e-9, .high = 1e9, PM_AT(rules.strain),
		.text = "dt = C/|grad u| of the flow on the mesh; above 1 particles may cross, and such steps are counted"},
	{.name = "plasma", .kind = PM_REAL, .low = 1e-9, .high = 1e9, PM_AT(rules.plasma),
		.text = "dt = C/omega_p, of the mean densities in the box; leapfrog is stable below 2, 0.2 is usual"},
	{.name = "oscillation", .kind = PM_REAL, .low = 1e-9, .high = 1e9, PM_AT(rules.oscillation),
		.text = "dt = C/omega, omega the fastest oscillation that the words which made acc have stated, of pp the orbit of the largest acceleration"},
	{.name = "softening", .kind = PM_REAL, .unit = "length", .high = 1e300, PM_AT(rules.softening), .text = "of that rule (default: the frame's)"},
	{.name = "max", .kind = PM_REAL, .unit = "time", .low = 1e-300, .high = 1e300, PM_AT(most), .text = "upper limit of the step"},
	{.name = "min", .kind = PM_REAL, .unit = "time", .fallback = "0", .high = 1e300, PM_AT(least),
		.text = "lower limit of the step; frames whose rules need a shorter one are counted as below_min"},
	{.name = "until", .kind = PM_REAL, .unit = "time", PM_AT(until),
		.text = "the last step before this time ends at it, as a run by -t needs it; without a rule dt is left alone until then"},
	{.name = "set", .kind = PM_TEXT, .unit = "NAME", PM_AT(rules.set), .text = "use only this set"},
	{0},
};
static const struct pm_example examples[] = {
	{"the step of a star cluster from its accelerations", "pinit plummer -n 500 | pp | dt --acceleration 0.05 | sls"},
	{"a vortex whose particles never cross", "pinit ellipse --cells 32 | cycle -n 5 'p2m | poisson-fft | mgrad | dt --lcfl 0.5 | diffuse | m2p | push "
		"lsrk3 | remesh' | sls --report"},
	{"an eccentric orbit with a step that follows it",
		"pinit two-body --eccentricity 0.5 | cycle -n 50 'dt --acceleration 0.01 --softening 0.1 --max 0.1 | push kick/2 drift | pp | push kick/2' | "
		"sls"},
	{0},
};
const struct pm_tool tool_dt = {
	.name = "dt",
	.summary = "write the time step that the state allows",
	.about = "The smallest step over the rules and over the particles of every set that moves: C h/|v_d| (--courant), sqrt(ETA softening/|acc|) "
		"(--acceleration), C/|grad u| (--lcfl, with a flow on the mesh), C/omega_p (--plasma), C/omega of what oscillates fastest (--oscillation). "
		"Inside a step the frame is passed on unchanged. With a variable step leapfrog is not reversible, and its energy error is not bounded.",
	.kind = PM_FILTER,
	.reads = "v or vel, acc; the flow u of the mesh; charge and mass",
	.changes = "the attribute dt",
	.config = sizeof(struct config),
	.options = options,
	.examples = examples,
	.begin = begin,
	.declare = declare,
	.frame = frame,
	.divided = divided,
};
