/* Scheme and step of two bodies in orbit, by the measured atlas: steps of one length, or steps that follow the orbit (dt --oscillation), whatever needs the
 * fewest evaluations of the force. Errors were measured at the apocentre after one turn. They grow in proportion to time where a scheme keeps the energy, else
 * with its square. They are mostly a delay, so at another place they are larger by the ratio of v/r there and at the apocentre: Kepler's equation tells
 * where the run ends. ias15 has its tolerance instead of a step. Assumes that no third body disturbs the two.
 * SPDX-License-Identifier: GPL-3.0-or-later */
#include <string.h>

#include "planner/atlas.h"
#include "planner/plan.h"
#include "scene-parts/kepler-orbit.h"
#include "step/step.h"

/* v/r at the end of the run over v/r at the apocentre, at least 1. */
static double hurry(const struct pm_scales *s)
{
	const double e = s->eccentricity, n = s->orbit, end = s->anomaly + n * s->time;
	const struct pm_scene_orbit o = {.gm = n * n, .axis = 1, .e = e};
	double x[2], v[2];
	pm_scene_orbit_at(o, (end - pm_pi) / n, x, v); /* its time begins at the apocentre */
	return fmax(1, hypot(v[0], v[1]) / hypot(x[0], x[1]) / (n * sqrt((1 - e) / (1 + e)) / (1 + e)));
}

static double angle(double e, double mean)
{
	double low = mean - e - 1e-9, high = mean + e + 1e-9;
	for (int i = 0; i < 60; i++) {
		const double E = 0.5 * (low + high);
		*(E - e * sin(E) < mean ? &low : &high) = E;
	}
	return low;
}

/* Steps in proportion to 1/omega, r^(3/2), from the eccentric anomaly E to F: the integral of dt r^(-3/2), dt = (1 - e cos E) dE. */
static double steps(double e, double E, double F)
{
	enum { PARTS = 4096 };
	double sum = 0;
	for (int i = 0; i < PARTS; i++)
		sum += (F - E) / PARTS / sqrt(1 - e * cos(E + (i + 0.5) * (F - E) / PARTS));
	return sum;
}

/* The steps of the run over those of a turn. */
static double part(const struct pm_scales *s)
{
	const double e = s->eccentricity, turns = s->time * s->orbit / (2 * pm_pi), rest = s->anomaly + 2 * pm_pi * (turns - floor(turns));
	return floor(turns) + steps(e, angle(e, s->anomaly), angle(e, rest)) / steps(e, 0, 2 * pm_pi);
}

/* Is the error of a scheme proportional to time? With steps of changing length no scheme is symplectic. */
static bool keeps_energy(const char *scheme)
{
	return !strcmp(scheme, "kdk") || (strncmp(scheme, "dt-", 3) && strcmp(scheme, "ias15") && pm_step_find(scheme)->drifts);
}

bool pm_plan_smooth(const struct pm_frame *f)
{
	for (int a = 0; a < 2 * f->dim; a++)
		if (f->pface[a / 2][a % 2] == PM_PREFLECT || f->pface[a / 2][a % 2] == PM_PABSORB)
			return false;
	for (size_t i = 0; i < f->nfields; i++)
		if ((!strcmp(f->fields[i]->name, "x") || !strcmp(f->fields[i]->name, "v")) && f->fields[i]->type != PM_F64)
			return false;
	return f->dt != 0;
}

/* The error aimed at, of the accuracy: between two eccentricities of the atlas those of compositions are up to 2.3 times the interpolated ones, of the others
 * 1.2 times. */
static double margin(const char *scheme) { return strstr(scheme, "moan") || strstr(scheme, "yoshida") || !strcmp(scheme, "ias15") ? 0.35 : 0.7; }

bool pm_plan_orbit(const struct pm_frame *f, struct pm_plan *p)
{
	/* Of equal cost the first. lsrk3 at most up to e = 0.9 */
	static const char *const schemes[] = {"kdk", "dt-kdk", "rk4", "lsrk3", "dt-rk4", "yoshida4", "yoshida6", "blanes-moan4", "blanes-moan6", "dt-yoshida4",
		"dt-yoshida6", "dt-blanes-moan4", "dt-blanes-moan6", "ias15"};
	static const double loosest = 0.3728; /* 1e-3^(1/7): above, the iterations of ias15 may not converge */
	static const double longest = 0.25; /* [1/omega] in twenty steps a turn the error depends on where they fall */
	const struct pm_scales *s = &p->scales;
	struct pm_method *m = &p->method;
	const double turns = fmax(1, s->time * s->orbit / (2 * pm_pi)), most = s->accuracy / hurry(s);
	double least = HUGE_VAL;
	for (size_t i = 0; i < sizeof schemes / sizeof *schemes; i++) {
		const bool follows = !strncmp(schemes[i], "dt-", 3), chooses = !strcmp(schemes[i], "ias15");
		const char *name = schemes[i] + (follows ? 3 : 0);
		struct pm_atlas_found found = pm_atlas_orbit(s->eccentricity, schemes[i],
			margin(name) * most / (keeps_energy(schemes[i]) ? turns : turns * turns));
		if (follows && found.dt > longest)
			found.evaluations *= found.dt / longest, found.dt = longest;
		if (chooses && found.dt > loosest)
			found.evaluations *= found.dt / loosest, found.dt = loosest;
		if (found.outside || (chooses && !pm_plan_smooth(f)))
			continue;
		if (!(found.evaluations < (least < HUGE_VAL ? 0.8 : 1) * least)) /* leapfrog stays if it costs a quarter more */
			continue;
		least = found.evaluations;
		m->scheme = strcmp(name, "kdk") ? name : "leapfrog";
		m->follow = follows ? found.dt * s->stated : NAN;
		m->tolerance = chooses ? pow(found.dt, 7) : NAN;
		m->dt = follows || chooses ? NAN : found.dt / s->orbit;
	}
	m->evaluations = least * (isnan(m->follow) && isnan(m->tolerance) ? s->time * s->orbit / (2 * pm_pi) : part(s));
	return least < HUGE_VAL;
}
