/* dt: writes the time step that the state of a frame allows, the smallest over the rules asked for and the particles of every set that moves.
 * Courant, Friedrichs and Lewy 1928 (cells crossed in a step); Springel 2005, MNRAS 364, 1105, eq. 34 (softening over acceleration).
 * SPDX-License-Identifier: GPL-3.0-or-later */
#include <string.h>

#include "stage/stage.h"

struct config {
	double courant, acceleration, softening, least, most;
	const char *set;
};

enum { BLOCK = 4096 };

/* Largest |y|^2 (or, with h, largest |y_d|/h_d) over the particles. */
static double largest(const struct pm_field *y, const double *h)
{
	double most = 0;
	int m = y->components < 3 || !h ? y->components : 3;
#pragma omp parallel for schedule(static) reduction(max : most)
	for (size_t b = 0; b < y->count; b += BLOCK)
		for (size_t i = b; i < y->count && i < b + BLOCK; i++) {
			double here = 0;
			for (int d = 0; d < m; d++) {
				double v = pm_in(y, d)[i];
				here = h ? fmax(here, fabs(v) / h[d]) : here + v * v;
			}
			most = fmax(most, here);
		}
	return most;
}

static int begin(struct pm_stage *s)
{
	const struct config *cfg = s->config;
	if (!pm_given(s, "courant") && !pm_given(s, "acceleration"))
		return pm_fail(PM_USAGE, "no rule (--courant C, --acceleration ETA)");
	if (cfg->least > cfg->most)
		return pm_fail(PM_USAGE, "--min %g is above --max %g", cfg->least, cfg->most);
	return 0;
}

static bool takes_part(const struct config *cfg, const struct pm_frame *f, const struct pm_set *s)
{
	const struct pm_field *x = pm_frame_field(f, s->name, "x");
	return (!cfg->set || !strcmp(cfg->set, s->name)) && !s->fixed && x && x->role == PM_STATE;
}

/* The velocity of a set: its state v, or vel where it has none. */
static const char *velocity(const struct pm_frame *f, const struct pm_set *s) { return pm_frame_field(f, s->name, "v") ? "v" : "vel"; }

static int needs(const struct pm_stage *s, struct pm_frame *f, const struct pm_set *set)
{
	const char *names[] = {pm_given(s, "courant") ? velocity(f, set) : NULL,
		pm_given(s, "acceleration") && pm_frame_field(f, set->name, "v") ? "acc" : NULL};
	for (int i = 0; i < 2; i++)
		if (names[i] && !pm_frame_field(f, set->name, names[i]))
			return pm_fail(PM_MISSING, "no field '%s' on '%s' (compute it first: p2m | poisson-fft | mgrad | m2p, or pp)", names[i], set->name);
		else if (names[i] && !pm_reads(f, set->name, names[i]))
			return -PM_DATA;
	return 0;
}

static double softening(const struct pm_stage *s, const struct pm_frame *f)
{
	return pm_given(s, "softening") ? ((const struct config *)s->config)->softening : pm_frame_constant(f, "softening", NAN);
}

static int plan(struct pm_stage *s, struct pm_frame *f)
{
	const struct config *cfg = s->config;
	int status = 0, sets = 0;
	if (f->substep)
		return PM_PASS;
	if (pm_given(s, "courant") && !f->nmeshes)
		return pm_fail(PM_DATA, "no mesh whose cells --courant could count (p2m -n makes one)");
	if (pm_given(s, "acceleration") && !(softening(s, f) > 0))
		return pm_fail(PM_DATA, "the rule of acceleration needs a softening length (--softening LENGTH)");
	for (size_t i = 0; i < f->nsets && !status; i++)
		if (takes_part(cfg, f, f->sets[i])) {
			status = needs(s, f, f->sets[i]);
			sets++;
		}
	if (!status && !sets)
		return pm_fail(PM_DATA, "no set that moves%s%s", cfg->set ? " is called " : "", cfg->set ? cfg->set : "");
	return status ? status : PM_HOLD;
}

static int frame(struct pm_stage *s, struct pm_frame *f)
{
	const struct config *cfg = s->config;
	double dt = HUGE_VAL;
	for (size_t i = 0; i < f->nsets; i++) {
		const struct pm_set *set = f->sets[i];
		if (!takes_part(cfg, f, set))
			continue;
		if (pm_given(s, "courant"))
			dt = fmin(dt, cfg->courant / largest(pm_frame_field(f, set->name, velocity(f, set)), f->meshes[0]->h));
		const struct pm_field *acc = pm_given(s, "acceleration") ? pm_frame_field(f, set->name, "acc") : NULL;
		if (acc)
			dt = fmin(dt, sqrt(cfg->acceleration * softening(s, f) / sqrt(largest(acc, NULL))));
	}
	pm_report(s, f, "allowed", isfinite(dt) ? dt : 0);
	dt = fmin(dt, cfg->most); /* not a number where not typed, which fmin passes over */
	if (dt < cfg->least) {
		dt = cfg->least;
		pm_report_count(s, f, "below_min", 1);
	}
	if (!isfinite(dt)) /* nothing moves and nothing pulls */
		pm_say(s, "no rule limits the step, dt stays %g", f->dt);
	else
		f->dt = dt;
	return 0;
}

#define AT(member) offsetof(struct config, member)
static const struct pm_option options[] = {
	{.name = "courant", .kind = PM_REAL, .unit = "cells", .low = 1e-9, .high = 1e9, .offset = AT(courant),
		.text = "no particle crosses more than this part of a cell of the first mesh, along any axis"},
	{.name = "acceleration", .kind = PM_REAL, .low = 1e-12, .high = 1e6, .offset = AT(acceleration),
		.text = "ETA of dt = sqrt(ETA softening/|acc|), 0.01 to 0.1 for leapfrog"},
	{.name = "softening", .kind = PM_REAL, .unit = "length", .low = 0, .high = 1e300, .offset = AT(softening),
		.text = "the length in that rule; by default the frame's constant softening"},
	{.name = "max", .kind = PM_REAL, .unit = "time", .low = 1e-300, .high = 1e300, .offset = AT(most), .text = "never longer"},
	{.name = "min", .kind = PM_REAL, .unit = "time", .fallback = "0", .low = 0, .high = 1e300, .offset = AT(least),
		.text = "never shorter; counted as below_min where a rule asked for less"},
	{.name = "set", .kind = PM_TEXT, .unit = "NAME", .offset = AT(set), .text = "looks at this set only"},
	{0},
};
static const struct pm_example examples[] = {
	{"the step of a star cluster from its accelerations", "pinit plummer -n 500 | pp | dt --acceleration 0.05 | sls"},
	{"an eccentric orbit with a step that follows it",
		"pinit two-body --eccentricity 0.5 | cycle -n 50 'dt --acceleration 0.01 --softening 0.1 --max 0.1 | push kick/2 drift | pp | push kick/2' | sls"},
	{0},
};
const struct pm_tool tool_dt = {
	.name = "dt",
	.summary = "write the time step that the state allows",
	.about = "The smallest step over the rules and over the particles of every set that moves: C h/|v_d| (--courant), sqrt(ETA softening/|acc|) "
		"(--acceleration). Written at substep 0; in the middle of a step the frame passes. A step that varies costs leapfrog its reversibility "
		"and with it the bound on the energy error. The rules of plasmas and vortices (omega_p dt, dt |grad u|) come with their laws.",
	.kind = PM_FILTER,
	.reads = "v or vel, acc",
	.changes = "the attribute dt",
	.config = sizeof(struct config),
	.options = options,
	.examples = examples,
	.begin = begin,
	.plan = plan,
	.frame = frame,
};
