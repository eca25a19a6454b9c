/* The measured atlas: errors of forces and of steps (data/atlas, docs/accuracy/README.md), built into the library by the Makefile.
 * SPDX-License-Identifier: GPL-3.0-or-later */
#ifndef PM_PLANNER_ATLAS_H
#define PM_PLANNER_ATLAS_H

#include "base/base.h"

struct pm_atlas_force {
	const char *scene;                      /* smooth, clustered */
	const char *solver, *kernel, *gradient; /* as words and options; "-" for pp */
	double h, error, ns;                    /* spacing over the scene's length; relative l2 (NAN: failed); per particle and evaluation */
};
struct pm_atlas_step {
	const char *problem, *scheme; /* kepler, kepler-circle, langmuir, vortex-patch, gyration; kdk, rk4 ...; dt-rk4: with dt --oscillation */
	/* in units of 1/omega, with dt-: of the circle at each distance, of ias15 tolerance^(1/7); relative, after the problem's time; forces in that time */
	double dt, error, evaluations;
};
extern const struct pm_atlas_force pm_atlas_forces[]; /* generated; scene NULL ends */
extern const struct pm_atlas_step pm_atlas_steps[];   /* problem NULL ends */

/* Error of a force at spacing h, interpolated linearly in the logarithms and extrapolated beyond the ends; towards small h at most as h^2.
 * NAN: this combination of words was not measured. */
double pm_atlas_force_error(const char *scene, const char *solver, const char *kernel, const char *gradient, double h);
/* Longest step, in units of 1/omega, whose error is at most this; NAN: not measured. */
double pm_atlas_longest(const char *problem, const char *scheme, double error);

struct pm_atlas_found {
	double dt, evaluations; /* of the longest step that reaches an error, in units of 1/omega, and of the force in the problem's time; NAN: not measured */
	bool outside;           /* extrapolated beyond the smallest error measured */
};
struct pm_atlas_found pm_atlas_find(const char *problem, const char *scheme, double error);
/* Orbits of this eccentricity, between those that were measured: logarithms are linear in that of (1 + e)/(1 - e)^3, the square of the pericentre's angular
 * speed. outside: e is beyond the last one measured, too. */
struct pm_atlas_found pm_atlas_orbit(double eccentricity, const char *scheme, double error);
/* The time at which these errors were measured, in units of 1/omega; NAN: no such problem. */
double pm_atlas_time(const char *problem);

#endif
