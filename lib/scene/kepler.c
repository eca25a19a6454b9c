/* A body around a sun that does not move: G M = 1, started at the apocentre (-a(1+e), 0) with v = (0, -sqrt((1-e)/(a(1+e)))).
 * The sun is the set "sun" (fixed, mass 1, at the origin). The body's own mass drops out of its orbit; it is 1, so that energies are per
 * mass: E = -1/(2a), L = sqrt(a (1 - e^2)), T = 2 pi a^(3/2). The step is T/1000.
 * Source: PM-10 of the reference cases (e = 0.9, a = 1); Springel 2005, MNRAS 364, 1105, section 4.
 * Exact: energy, energy_kinetic, energy_field_pair, angular_momentum_z, period, x, y (of the body), mass.
 * SPDX-License-Identifier: GPL-3.0-or-later */
#include <string.h>

#include "scene-parts/scene-bodies.h"
#include "scene-parts/kepler-orbit.h"

enum { AXIS, ECCENTRICITY, SOFTENING };

static const struct pm_scene_parameter rows[] = {
	{.name = "semi-major", .unit = "length", .otherwise = 1, .low = 1e-100, .high = 1e100, .text = "semi-major axis of the orbit"},
	{.name = "eccentricity", .otherwise = 0.9, .high = 0.99999, .text = "0 a circle"},
	{.name = "softening", .unit = "length", .high = 1e6, .text = "softening length of direct sums; 0 is stated, so that the orbit is Kepler's"},
	{0},
};

static int make(const struct pm_scene_choice *c, struct pm_frame *f)
{
	const struct pm_scene_orbit o = {1, c->value[AXIS], c->value[ECCENTRICITY]};
	const double side = 2 * o.axis * (1 + o.e);
	double x[2], v[2];
	struct pm_scene_body b, sun;
	const double slow = fmin(1, pm_scene_orbit_pericentre(o.e) / pm_scene_orbit_pericentre(0.9));
	pm_scene_world(f, -side, side, PM_OPEN, c->value[SOFTENING], pm_scene_orbit_period(o) / 1000 * slow);
	if (pm_scene_mesh(f, 64) || pm_scene_set(f, "matter", 1, true, 1, &b) || pm_scene_set(f, "sun", 1, false, 1, &sun))
		return -PM_DATA;
	pm_scene_orbit_at(o, 0, x, v);
	for (int d = 0; d < 3; d++) {
		b.x[d][0] = d < 2 ? x[d] : 0;
		b.v[d][0] = d < 2 ? v[d] : 0;
		sun.x[d][0] = 0;
	}
	return 0;
}

static double exact(const struct pm_frame *f, const char *quantity, double t)
{
	const struct pm_scene_orbit o = {1, pm_frame_parameter(f, "semi-major", 1), pm_frame_parameter(f, "eccentricity", 0.9)};
	double x[2], v[2];
	pm_scene_orbit_at(o, t, x, v);
	const double field = -1 / hypot(x[0], x[1]), energy = -1 / (2 * o.axis);
	const struct { const char *name; double value; } known[] = {
		{"mass", 2}, {"energy", energy}, {"energy_field_pair", field}, {"energy_kinetic", energy - field},
		{"angular_momentum_z", sqrt(o.axis * (1 - o.e * o.e))}, {"period", pm_scene_orbit_period(o)}, {"x", x[0]}, {"y", x[1]},
	};
	for (size_t i = 0; i < sizeof known / sizeof *known; i++)
		if (!strcmp(quantity, known[i].name))
			return known[i].value;
	return NAN;
}

const struct pm_scene scene_kepler = {
	.name = "kepler",
	.sentence = "a body on an ellipse around a sun that does not move",
	.source = "Springel 2005, MNRAS 364, 1105; PM-10 of the reference cases",
	.dims = 1u << 3,
	.dim = 3,
	.n = 1,
	.n_fixed = true,
	.parameters = rows,
	.make = make,
	.exact = exact,
};
