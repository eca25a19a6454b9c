/* Kepler's equation solved by Newton's method. Cost: 60 pairs of sine and cosine.
 * SPDX-License-Identifier: GPL-3.0-or-later */
#include "scene-parts/kepler-orbit.h"

double pm_scene_orbit_period(struct pm_scene_orbit o) { return 2 * pm_pi * sqrt(o.axis * o.axis * o.axis / o.gm); }

double pm_scene_orbit_pericentre(double e) { return sqrt((1 - e) * (1 - e) * (1 - e) / (1 + e)); }

void pm_scene_orbit_at(struct pm_scene_orbit o, double t, double x[2], double v[2])
{
	const double rate = 2 * pm_pi / pm_scene_orbit_period(o);
	const double turn = t / pm_scene_orbit_period(o), mean = 2 * pm_pi * (turn - floor(turn + 0.5)); /* M - pi, in [-pi, pi) */
	double f = 0; /* E - pi, so that mean = f + e sin f; from the apocentre Newton's method always converges */
	for (int i = 0; i < 60; i++)
		f -= (f + o.e * sin(f) - mean) / (1 + o.e * cos(f));
	const double b = o.axis * sqrt(1 - o.e * o.e), s = rate / (1 + o.e * cos(f));
	x[0] = o.axis * (-cos(f) - o.e), x[1] = -b * sin(f);
	v[0] = o.axis * sin(f) * s, v[1] = -b * cos(f) * s;
}
