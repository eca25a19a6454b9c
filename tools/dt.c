/* dt: writes the time step that the state of a frame allows, the smallest over the rules asked for (lib/measure/timestep.c) and the sets that move.
 * Courant, Friedrichs and Lewy 1928 (cells crossed in a step); Springel 2005, MNRAS 364, 1105, eq. 34 (softening over acceleration); Cottet and
 * Koumoutsakos 2000, section 7.1 (strain); Birdsall and Langdon 1985, section 4-2 (plasma frequency). SPDX-License-Identifier: GPL-3.0-or-later */
#include <string.h>

#include "law/law.h"
#include "measure/timestep.h"
#include "stage/stage.h"

struct config {
	double courant, acceleration, strain, plasma, softening, least, most;
	const char *set;
};

static int begin(struct pm_stage *s)
{
	const struct config *cfg = s->config;
	if (!pm_given(s, "courant") && !pm_given(s, "acceleration") && !pm_given(s, "lcfl") && !pm_given(s, "plasma"))
		return pm_fail(PM_USAGE, "no rule (--courant C, --acceleration ETA, --lcfl C, --plasma C)");
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

/* The mesh field that carries particles. */
static int needs_flow(struct pm_frame *f, const struct pm_law *law)
{
	const struct pm_mesh *mesh = NULL;
	if (!law->field || strcmp(law->of, "x"))
		return pm_fail(PM_DATA, "the rule of strain needs a flow, and the law '%s' has none (laws vortex and passive)", law->name);
	for (size_t i = 0; i < f->nmeshes && !mesh; i++)
		if (pm_frame_field(f, f->meshes[i]->name, law->field))
			mesh = f->meshes[i];
	if (!mesh)
		return pm_fail(PM_MISSING, "no field '%s' on a mesh (put dt behind p2m | poisson-fft | mgrad)", law->field);
	return pm_reads(f, mesh->name, law->field) ? 0 : -PM_DATA;
}

static bool charged(const struct pm_frame *f, const struct pm_law *law, const char *set)
{
	return law->background && pm_frame_field(f, set, law->strength) && pm_frame_field(f, set, law->per);
}

static int needs_charges(struct pm_frame *f, const struct pm_law *law)
{
	size_t sets = 0;
	for (size_t i = 0; i < f->nsets; i++)
		if (charged(f, law, f->sets[i]->name)) {
			if (!pm_reads(f, f->sets[i]->name, law->strength) || !pm_reads(f, f->sets[i]->name, law->per))
				return -PM_DATA;
			sets++;
		}
	return sets ? 0 : pm_fail(PM_DATA, "no set with charge and mass under the law '%s' for the rule of the plasma frequency", law->name);
}

static double softening(const struct pm_stage *s, const struct pm_frame *f)
{
	return pm_given(s, "softening") ? ((const struct config *)s->config)->softening : pm_frame_constant(f, "softening", NAN);
}

static int declare(struct pm_stage *s, struct pm_frame *f)
{
	const struct config *cfg = s->config;
	int status = 0, sets = 0;
	if (f->substep)
		return PM_PASS;
	if (pm_given(s, "courant") && !f->nmeshes)
		return pm_fail(PM_DATA, "no mesh whose cells --courant could count (p2m -n makes one)");
	if (pm_given(s, "acceleration") && !(softening(s, f) > 0))
		return pm_fail(PM_DATA, "the rule of acceleration needs a softening length (--softening LENGTH)");
	const struct pm_law *law = pm_law_of(f);
	if (!law || (pm_given(s, "lcfl") && (status = needs_flow(f, law))) || (pm_given(s, "plasma") && (status = needs_charges(f, law))))
		return status ? status : -PM_DATA;
	for (size_t i = 0; i < f->nsets && !status; i++)
		if (takes_part(cfg, f, f->sets[i])) {
			status = needs(s, f, f->sets[i]);
			sets++;
		}
	if (!status && !sets)
		return pm_fail(PM_DATA, "no set that moves%s%s", cfg->set ? " is called " : "", cfg->set ? cfg->set : "");
	return status ? status : PM_HOLD;
}

static double strain(const struct pm_frame *f, const char *name)
{
	for (size_t i = 0; i < f->nmeshes; i++) {
		const struct pm_field *u = pm_frame_field(f, f->meshes[i]->name, name);
		const struct pm_grid g = pm_grid_of(f, f->meshes[i]);
		const double *component[PM_COMPONENTS];
		for (int c = 0; u && c < u->components; c++)
			component[c] = pm_in(u, c);
		if (u)
			return pm_strain(&g, u->components, component);
	}
	return 0;
}

static double plasma_frequency(const struct pm_frame *f, const struct pm_law *law)
{
	double sum = 0, box = 1;
	for (size_t i = 0; i < f->nsets; i++) {
		const char *set = f->sets[i]->name;
		if (charged(f, law, set))
			sum += pm_charge_over_mass(f->sets[i]->n, pm_in(pm_frame_field(f, set, law->strength), 0), pm_in(pm_frame_field(f, set, law->per), 0));
	}
	for (int d = 0; d < f->dim; d++)
		box *= f->hi[d] - f->lo[d];
	return sqrt(fabs(law->coefficient(f)) * sum / box);
}

static int frame(struct pm_stage *s, struct pm_frame *f)
{
	const struct config *cfg = s->config;
	const struct pm_law *law = pm_law_of(f);
	const double rate = pm_given(s, "lcfl") ? strain(f, law->field) : 0;
	double dt = pm_given(s, "plasma") ? cfg->plasma / plasma_frequency(f, law) : HUGE_VAL;
	dt = rate > 0 ? fmin(dt, cfg->strain / rate) : dt;
	for (size_t i = 0; i < f->nsets; i++) {
		const struct pm_set *set = f->sets[i];
		if (!takes_part(cfg, f, set))
			continue;
		if (pm_given(s, "courant"))
			dt = fmin(dt, cfg->courant / pm_most(pm_frame_field(f, set->name, velocity(f, set)), f->meshes[0]->h));
		const struct pm_field *acc = pm_given(s, "acceleration") ? pm_frame_field(f, set->name, "acc") : NULL;
		if (acc)
			dt = fmin(dt, sqrt(cfg->acceleration * softening(s, f) / sqrt(pm_most(acc, NULL))));
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
	if (pm_given(s, "lcfl")) {
		pm_report(s, f, "strain", rate);
		pm_report_count(s, f, "crossing", f->dt * rate > 1 + 1e-9);
		if (f->dt * rate > 1 + 1e-9)
			pm_say(s, "dt |grad u| = %g is above 1: particles may cross (--lcfl 1, or --max %g)", f->dt * rate, 1 / rate);
	}
	return 0;
}

static const struct pm_option options[] = {
	{.name = "courant", .kind = PM_REAL, .unit = "cells", .low = 1e-9, .high = 1e9, PM_AT(courant),
		.text = "no particle crosses more than this part of a cell of the first mesh, along any axis"},
	{.name = "acceleration", .kind = PM_REAL, .low = 1e-12, .high = 1e6, PM_AT(acceleration),
		.text = "ETA of dt = sqrt(ETA softening/|acc|), 0.01 to 0.1 for leapfrog"},
	{.name = "lcfl", .kind = PM_REAL, .low = 1e-9, .high = 1e9, PM_AT(strain),
		.text = "dt = C/|grad u| of the flow on the mesh; above 1 particles may cross, and such steps are counted"},
	{.name = "plasma", .kind = PM_REAL, .low = 1e-9, .high = 1e9, PM_AT(plasma),
		.text = "dt = C/omega_p, of the mean densities in the box; leapfrog is stable below 2, 0.2 is usual"},
	{.name = "softening", .kind = PM_REAL, .unit = "length", .high = 1e300, PM_AT(softening),
		.text = "the length in that rule; by default the frame's constant softening"},
	{.name = "max", .kind = PM_REAL, .unit = "time", .low = 1e-300, .high = 1e300, PM_AT(most), .text = "never longer"},
	{.name = "min", .kind = PM_REAL, .unit = "time", .fallback = "0", .high = 1e300, PM_AT(least),
		.text = "never shorter; counted as below_min where a rule asked for less"},
	{.name = "set", .kind = PM_TEXT, .unit = "NAME", PM_AT(set), .text = "looks at this set only"},
	{0},
};
static const struct pm_example examples[] = {
	{"the step of a star cluster from its accelerations", "pinit plummer -n 500 | pp | dt --acceleration 0.05 | sls"},
	{"a vortex whose particles never cross", "pinit ellipse --cells 32 | cycle -n 5 'p2m | poisson-fft | mgrad | dt --lcfl 0.5 | diffuse | m2p | push lsrk3 | remesh' | sls --report"},
	{"an eccentric orbit with a step that follows it",
		"pinit two-body --eccentricity 0.5 | cycle -n 50 'dt --acceleration 0.01 --softening 0.1 --max 0.1 | push kick/2 drift | pp | push kick/2' | sls"},
	{0},
};
const struct pm_tool tool_dt = {
	.name = "dt",
	.summary = "write the time step that the state allows",
	.about = "The smallest step over the rules and over the particles of every set that moves: C h/|v_d| (--courant), sqrt(ETA softening/|acc|) "
		"(--acceleration), C/|grad u| (--lcfl, where a flow is on the mesh), C/omega_p (--plasma). Written at substep 0; in the middle of a step the frame passes. A step that varies costs leapfrog its reversibility "
		"and with it the bound on the energy error.",
	.kind = PM_FILTER,
	.reads = "v or vel, acc; the flow u of the mesh; charge and mass",
	.changes = "the attribute dt",
	.config = sizeof(struct config),
	.options = options,
	.examples = examples,
	.begin = begin,
	.declare = declare,
	.frame = frame,
};
