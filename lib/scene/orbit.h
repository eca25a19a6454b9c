/* The relative Kepler orbit of two bodies, started at the apocentre on the negative x axis, turning counter-clockwise.
 * SPDX-License-Identifier: GPL-3.0-or-later */
#ifndef PM_SCENE_ORBIT_H
#define PM_SCENE_ORBIT_H

#include "base/base.h"

struct scene_orbit {
	double gm;   /* [length^3/time^2] */
	double axis; /* [length] semi-major */
	double e;    /* eccentricity, 0 <= e < 1 */
};

static inline double scene_orbit_period(struct scene_orbit o) { return 2 * pm_pi * sqrt(o.axis * o.axis * o.axis / o.gm); }

/* Position and velocity at time t: M = pi + 2 pi t/T = E - e sin E by Newton's method, x = a (cos E - e), y = a sqrt(1-e^2) sin E. */
static inline void scene_orbit_at(struct scene_orbit o, double t, double x[2], double v[2])
{
	const double rate = 2 * pm_pi / scene_orbit_period(o);
	const double turn = t / scene_orbit_period(o), mean = 2 * pm_pi * (turn - floor(turn + 0.5)); /* M - pi, in [-pi, pi) */
	double f = 0; /* E - pi, so that mean = f + e sin f; from the apocentre Newton's method always converges */
	for (int i = 0; i < 60; i++)
		f -= (f + o.e * sin(f) - mean) / (1 + o.e * cos(f));
	const double b = o.axis * sqrt(1 - o.e * o.e), s = rate / (1 + o.e * cos(f));
	x[0] = o.axis * (-cos(f) - o.e), x[1] = -b * sin(f);
	v[0] = o.axis * sin(f) * s, v[1] = -b * cos(f) * s;
}

#endif
