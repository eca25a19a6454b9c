/* The relative Kepler orbit of two bodies, started at the apocentre on the negative x axis, turning counter-clockwise.
 * SPDX-License-Identifier: GPL-3.0-or-later */
#ifndef PM_KEPLER_ORBIT_H
#define PM_KEPLER_ORBIT_H

#include "base/base.h"

struct pm_scene_orbit {
	double gm;   /* [length^3/time^2] */
	double axis; /* [length] semi-major */
	double e;    /* eccentricity, 0 <= e < 1 */
};

double pm_scene_orbit_period(struct pm_scene_orbit o);
double pm_scene_orbit_pericentre(double e); /* mean motion over the angular velocity at the pericentre, sqrt((1 - e)^3/(1 + e)) */
/* Position and velocity at time t: M = pi + 2 pi t/T = E - e sin E by Newton's method, x = a (cos E - e), y = a sqrt(1-e^2) sin E. */
void pm_scene_orbit_at(struct pm_scene_orbit o, double t, double x[2], double v[2]);

#endif
