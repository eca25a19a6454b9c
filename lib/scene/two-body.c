/* Two bodies on a bound orbit about their centre of mass in open space, started at the apocentre: G = 1, total mass `mass`.
 * T = 2 pi sqrt(a^3/(G M)), E = -G m1 m2/(2 a), L = mu sqrt(G M a (1 - e^2)). The step is T/200.
 * Source: Goldstein 1980, chapter 3. Exact: mass, energy, angular_momentum_z, period, energy_kinetic and energy_field_pair (for softening 0),
 * and relative_x, relative_y (body 1 minus body 0). SPDX-License-Identifier: GPL-3.0-or-later */
#include <string.h>

#include "scene-parts/scene-bodies.h"
#include "scene-parts/kepler-orbit.h"

enum { MASS, RATIO, AXIS, ECCENTRICITY, SOFTENING };

static const struct pm_scene_parameter rows[] = {
	{.name = "mass", .unit = "mass", .otherwise = 1, .low = 1e-300, .high = 1e300, .text = "total mass"},
	{.name = "ratio", .otherwise = 1, .low = 1e-12, .high = 1e12, .text = "mass of the second body over that of the first"},
	{.name = "semi-major", .unit = "length", .otherwise = 1, .low = 1e-100, .high = 1e100, .text = "semi-major axis of the relative orbit"},
	{.name = "eccentricity", .high = 0.999, .text = "0 a circle"},
	{.name = "softening", .unit = "length", .high = 1e6, .text = "softening length of direct sums; 0 is stated, so that the orbit is Kepler's"},
	{0},
};

static int make(const struct pm_scene_choice *c, struct pm_frame *f)
{
	const struct pm_scene_orbit o = {c->value[MASS], c->value[AXIS], c->value[ECCENTRICITY]};
	const double m[2] = {o.gm / (1 + c->value[RATIO]), o.gm * c->value[RATIO] / (1 + c->value[RATIO])};
	const double side = 2 * o.axis * (1 + o.e), share[2] = {-m[1] / o.gm, m[0] / o.gm};
	double x[2], v[2];
	struct pm_scene_body b;
	const double slow = fmin(1, pm_scene_orbit_pericentre(o.e) / pm_scene_orbit_pericentre(0.75));
	pm_scene_world(f, -side, side, PM_OPEN, c->value[SOFTENING], pm_scene_orbit_period(o) / 200 * slow);
	if (pm_scene_mesh(f, 64) || pm_scene_set(f, "matter", 2, true, m[0] == m[1] ? m[0] : NAN, &b))
		return -PM_DATA;
	pm_scene_orbit_at(o, 0, x, v);
	for (int i = 0; i < 2; i++) {
		for (int d = 0; d < 3; d++) {
			b.x[d][i] = d < 2 ? share[i] * x[d] : 0;
			b.v[d][i] = d < 2 ? share[i] * v[d] : 0;
		}
		if (b.mass)
			b.mass[i] = m[i];
	}
	return 0;
}

static double exact(const struct pm_frame *f, const char *quantity, double t)
{
	const struct pm_scene_orbit o = {pm_frame_parameter(f, "mass", 1), pm_frame_parameter(f, "semi-major", 1), pm_frame_parameter(f, "eccentricity", 0)};
	const double ratio = pm_frame_parameter(f, "ratio", 1), m[2] = {o.gm / (1 + ratio), o.gm * ratio / (1 + ratio)};
	double x[2], v[2];
	pm_scene_orbit_at(o, t, x, v);
	const double field = -m[0] * m[1] / hypot(x[0], x[1]), energy = -m[0] * m[1] / (2 * o.axis);
	const struct { const char *name; double value; } known[] = {
		{"mass", o.gm}, {"energy", energy}, {"energy_field_pair", field}, {"energy_kinetic", energy - field},
		{"angular_momentum_z", m[0] * m[1] / o.gm * sqrt(o.gm * o.axis * (1 - o.e * o.e))},
		{"period", pm_scene_orbit_period(o)}, {"relative_x", x[0]}, {"relative_y", x[1]},
	};
	for (size_t i = 0; i < sizeof known / sizeof *known; i++)
		if (!strcmp(quantity, known[i].name))
			return known[i].value;
	return NAN;
}

const struct pm_scene scene_two_body = {
	.name = "two-body",
	.sentence = "two bodies on a circle or an ellipse about their centre of mass",
	.source = "Goldstein 1980, chapter 3",
	.dims = 1u << 3,
	.dim = 3,
	.n = 2,
	.n_fixed = true,
	.parameters = rows,
	.make = make,
	.exact = exact,
};
