/* Scheme and step of a plan, by the measured atlas: the fastest process in the frame (an orbit, the plasma frequency, vorticity, an encounter) is compared
 * with the measured problem. Errors are assumed to grow linearly in time, on orbits quadratically if the scheme does not conserve energy.
 * SPDX-License-Identifier: GPL-3.0-or-later */
#include <string.h>

#include "effect-parts/body-in-flow.h"
#include "planner/atlas.h"
#include "mesh/gradient.h"
#include "planner/plan.h"
#include "step/step.h"

struct clock {
	const char *problem;
	double omega;        /* [1/time] */
	bool steady;         /* it is constant in time, so steps may be longer than the frame's */
	const char *what;
};

static double at_error(const char *problem, const char *scheme, const struct clock *c, const struct pm_scales *s)
{
	double grown = fmax(1, c->omega * s->time / pm_atlas_time(problem));
	if (!strncmp(problem, "kepler", 6) && strcmp(scheme, "kdk"))
		grown *= grown; /* on an orbit that loses energy the phase error grows quadratically */
	return pm_atlas_longest(problem, scheme, s->accuracy / grown);
}

/* [time] longest step of a scheme. */
static double longest(const struct clock *c, const char *scheme, const struct pm_scales *s) { return at_error(c->problem, scheme, c, s) / c->omega; }

static struct clock clock_of(const struct pm_plan *p)
{
	const struct pm_scales *s = &p->scales;
	struct clock c = {.problem = "langmuir", .omega = s->omega, .steady = s->kind == PM_CHARGES,
		.what = s->kind == PM_CHARGES ? "omega_p" : "orbits"};
	if (s->kind == PM_VORTICES && (s->pairs || s->singular))
		c = (struct clock){.problem = "kepler-circle", .omega = fmax(s->encounter, s->self_max / s->spread), .steady = s->n < 64,
			.what = "the nearest pair"};
	else if (s->kind == PM_VORTICES)
		c = (struct clock){.problem = "vortex-patch", .omega = s->omega, .steady = true, .what = "the vorticity"};
	else if (s->kind == PM_CHARGES && s->cyclotron * s->time > s->accuracy && (s->cyclotron > s->omega || s->sources < 2))
		c = (struct clock){.problem = "gyration", .omega = s->cyclotron, .steady = true, .what = "the gyration"};
	else if (s->pairs)
		c = (struct clock){.problem = "langmuir", .omega = fmax(s->omega, sqrt(s->self_max / s->spread)), .steady = false,
			.what = "orbits"};
	return c;
}

/* The waves of the atlas are cold: in the long steps of a composition no particle may pass through structures of the mesh. */
static bool crosses(const struct pm_scales *s, double dt) { return !s->pairs && s->v_max * dt > s->h; }

/* The cheapest scheme and its longest step. */
static double cheapest(struct pm_plan *p, const struct clock *c)
{
	static const char *const second[] = {"kdk", "rk4", "lsrk3", "yoshida4", "yoshida6", "blanes-moan4", "blanes-moan6", NULL},
		*const first[] = {"lsrk3", "rk4", NULL}, *const magnetic[] = {"boris", NULL};
	const struct pm_scales *s = &p->scales;
	const bool turns = s->cyclotron * s->time > s->accuracy, field = s->kind == PM_VORTICES && !s->pairs && !s->singular;
	const bool heavy = s->v_max * s->v_max > 0.5 * s->accuracy * s->c * s->c; /* relativity comes in: its kick is one of leapfrog */
	static const char *const kicks[] = {"kdk", NULL};
	double least = HUGE_VAL, dt = NAN;
	for (const char *const *name = turns ? magnetic : heavy && s->second ? kicks : s->second ? second : first; *name; name++) {
		const char *word = !strcmp(*name, "kdk") || !strcmp(*name, "boris") ? "leapfrog" : *name;
		const struct pm_step *step = strcmp(word, "leapfrog") ? pm_step_find(word) : NULL;
		const double here = longest(c, turns && strcmp(c->problem, "gyration") ? "kdk" : *name, s), cost = (step ? step->passes : 1) / here;
		if (step && step->drifts && crosses(s, here))
			continue;
		const bool steady = c->steady || !strcmp(word, "leapfrog") || !s->second;
		if (here > 0 && steady && cost < (least < HUGE_VAL ? 0.8 : 1) * least && (!field || !strcmp(word, "lsrk3")))
			least = cost, dt = here, p->method.scheme = word;
	}
	return dt;
}

/* [time] Step of leapfrog for the encounters of many bodies: C/omega, with omega = sqrt(2 G m/softening^3) of the deepest, once bodies move far enough to
 * meet. Measured errors of velocities, C = 0.06, 0.2, 0.6, 2: 1e-4, 4e-4, 3e-3, 0.05 of warm bodies (plummer), and up to 2e-3, 0.01, 0.3, 0.8 of cold ones,
 * which fall onto each other (cold-sphere; docs/plan.md). Others: a quarter of the limit of stability for the nearest pair. */
static double encounter_step(const struct pm_scales *s)
{
	if (s->kind != PM_MASSES || !(s->softening > 0))
		return 0.5 / s->encounter;
	const double moved = s->v_rms * s->time + 0.5 * s->self_max * s->time * s->time;
	const double omega = s->encounter * (moved > 0.3 * s->nearest ? pow(fmax(1, s->nearest / s->softening), 1.5) : 1);
	const bool cold = s->v_thermal * s->v_thermal < 0.1 * s->self * s->spread;
	return fmin(cold ? 0.5 : 2, cold ? 0.8 * sqrt(s->accuracy) : sqrt(s->accuracy / 0.02)) / omega;
}

/* Limits for vortices on a mesh: particles must not cross, and viscosity must be stable. */
static double bounded(const struct pm_frame *f, const struct pm_plan *p, double dt, const char **what)
{
	const struct pm_scales *s = &p->scales;
	const double strain = fmin(pow(s->accuracy, 0.3), 4 * sqrt(s->accuracy)) / s->strain; /* what one step distorts, by measurement: docs/plan.md */
	double viscous = HUGE_VAL;
	if (s->kind == PM_CHARGES && !s->pairs && s->v_rms * dt > s->h && dt > fabs(f->dt))
		*what = "a cell in a step", dt = fmax(fabs(f->dt), s->h / s->v_rms);
	const bool meet = s->pairs || (s->kind == PM_MASSES && s->dim > 1 && s->softening > s->h); /* on a mesh, where it resolves the softening */
	if (meet && s->second && !(s->pairs && s->few > 1) && dt > encounter_step(s))
		*what = "encounters", dt = encounter_step(s);
	if (s->kind != PM_VORTICES || s->pairs || (s->singular && !(s->nu > 0)))
		return dt;
	for (double fastest = 0; s->nu > 0 && fastest == 0;) {
		struct pm_operator lap;
		const struct pm_grid g = pm_grid_of(f, f->meshes[0]);
		if (pm_operator_init(&lap, &g, PM_OP_LAP, pm_order_find(p->law->order), 1, false))
			break;
		fastest = pm_operator_fastest(&lap);
		struct pm_scene_solid body;
		const double wall = pm_effect_body(f, &body); /* penalize decays at 1/dt, which push adds to the rate of diffusion */
		viscous = 0.9 * (pm_step_find(p->method.scheme)->real_limit - wall) / (s->nu * fastest);
	}
	if (strain < dt)
		*what = "the strain";
	if (viscous < fmin(dt, strain))
		*what = "stable diffusion";
	return fmin(dt, fmin(strain, viscous));
}

/* Steps that follow the fastest orbit: they need no comparison with the frame's. */
static void follow(const struct pm_frame *f, struct pm_plan *p, const char *what)
{
	struct pm_method *m = &p->method;
	m->until = f->time + (f->dt < 0 ? -1 : 1) * p->scales.time;
	if (!isnan(m->tolerance))
		snprintf(m->why_step, sizeof m->why_step, "%s, tolerance %.2g: for %.1g by %s", m->scheme, m->tolerance, p->scales.accuracy, what);
	else
		snprintf(m->why_step, sizeof m->why_step, "%s, steps of %.2g/omega of the fastest orbit: for %.1g by %s", m->scheme, m->follow,
			p->scales.accuracy, what);
}

/* [1/time] The phase of an oscillation in leapfrog's steps is off by (omega dt)^2/24, of a gyration by (omega_c dt)^2/12: the step for an error of the
 * accuracy in T. Birdsall and Langdon 1985, 4-2 and 4-4. */
static double phase_step(const struct pm_scales *s, double omega, double part) { return sqrt(part * s->accuracy / fmax(omega * s->time, 1)) / omega; }

/* Light: at most 0.999 of what is stable, for the nearer to it the less dispersion. */
static double light_step(const struct pm_scales *s, const char **what)
{
	double dt = 0.999 * s->courant;
	*what = "light on the mesh";
	if (s->omega > 0 && phase_step(s, s->omega, 24) < dt)
		dt = phase_step(s, s->omega, 24), *what = "omega_p";
	if (s->cyclotron * s->time > s->accuracy && phase_step(s, s->cyclotron, 12) < dt)
		dt = phase_step(s, s->cyclotron, 12), *what = "the gyration";
	return dt;
}

/* A step of the frame that is allowed stays: a run is compared with others of its scene. */
static void of_light(const struct pm_frame *f, struct pm_plan *p)
{
	struct pm_method *m = &p->method;
	struct pm_scales *s = &p->scales;
	const char *what;
	const double allowed = light_step(s, &what), dt = fabs(f->dt);
	if (dt > 0 && dt <= allowed) {
		snprintf(m->why_step, sizeof m->why_step, "dt = %.3g of the frame, c dt is %.2g of what is stable; %.2g is short enough for %.1g: %s", f->dt,
			dt / s->courant, allowed, s->accuracy, what);
		return;
	}
	m->dt = (f->dt < 0 ? -1 : 1) * s->time / ceil(s->time / allowed - 1e-9);
	s->dt = m->dt;
	snprintf(m->why_step, sizeof m->why_step, "dt = %.3g, c dt is %.2g of what is stable: for %.1g by %s", m->dt, fabs(m->dt) / s->courant,
		s->accuracy, what);
}

int pm_plan_step(const struct pm_frame *f, struct pm_plan *p)
{
	struct pm_method *m = &p->method;
	struct pm_scales *s = &p->scales;
	struct clock c = clock_of(p);
	if (s->light) {
		of_light(f, p);
		return 0;
	}
	const bool few = s->pairs && s->second && s->few > 1 && s->self > 0 && !(s->cyclotron > 0) && !(s->given > 0);
	const bool pair = few && s->few < 3 && !isnan(s->orbit) && !(pow(s->softening / s->pericentre, 2) > 0.01 * s->accuracy) && pm_plan_orbit(f, p);
	int status = few && !pair ? pm_plan_trial(f, p) : 0;
	char orbit[64] = "trials with these bodies";
	if (status)
		return status;
	if (pair)
		snprintf(orbit, sizeof orbit, "the orbit, e = %.4g", s->eccentricity), c.steady = true;
	if (!isnan(m->follow) || !isnan(m->tolerance)) {
		follow(f, p, orbit);
		return 0;
	}
	struct pm_scene_solid body;
	c.steady = c.steady && !(s->kind == PM_VORTICES && pm_effect_body(f, &body)); /* penalize takes the step of the frame, push --dt comes after it */
	const char *what = few ? orbit : c.what;
	double allowed = few ? m->dt : c.omega > 0 ? cheapest(p, &c) : NAN;
	m->dt = NAN;
	allowed = bounded(f, p, isnan(allowed) ? HUGE_VAL : allowed, &what);
	const double dt = fabs(f->dt), back = f->dt < 0 ? -1 : 1;
	if (!isfinite(allowed)) {
		snprintf(m->why_step, sizeof m->why_step, "%s, dt = %.3g of the frame", m->scheme, f->dt);
	} else if (dt > 0 && allowed > (few ? 1 : 0.9) * dt && (allowed < 1.25 * dt || !c.steady)) {
		snprintf(m->why_step, sizeof m->why_step, "%s, dt = %.3g of the frame; %.2g is short enough for %.1g: %s", m->scheme, f->dt, allowed,
			s->accuracy, what);
	} else {
		m->dt = back * s->time / ceil(s->time / allowed - 1e-9);
		s->dt = m->dt;
		snprintf(m->why_step, sizeof m->why_step, "%s, dt = %.3g: for %.1g by %s", m->scheme, m->dt, s->accuracy, what);
	}
	return 0;
}
