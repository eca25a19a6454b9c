/* Two equal Gaussian vortices a distance b apart, omega = Gamma/(pi a^2) exp(-r^2/a^2) each, which turn about each other and merge once a, which grows
 * by viscosity as a^2 + 4 nu t, is more than about a quarter of b. Source: Melander, Zabusky, McWilliams 1988, J. Fluid Mech. 195, 303; Meunier, Ehrenstein,
 * Leweke, Rossi 2002, Phys. Fluids 14, 2757 (0.24 b).
 * Exact: circulation 2 Gamma, impulses 0, angular impulse -Gamma (a^2 + b^2/4 + 4 nu t). Cost: nodes of the mesh. SPDX-License-Identifier: GPL-3.0-or-later */
#include <string.h>

#include "scene-parts/scene-vortices.h"

enum { GAMMA, RADIUS, DISTANCE, NU };

static const struct pm_scene_parameter rows[] = {
	{.name = "circulation", .unit = "length^2/time", .otherwise = 1, .low = -1e300, .high = 1e300, .text = "circulation of each"},
	{.name = "radius", .unit = "length", .otherwise = 0.25, .low = 1e-300, .high = 1e300, .text = "radius a of each, exp(-(r/a)^2)"},
	{.name = "distance", .unit = "length", .otherwise = 1, .low = 1e-300, .high = 1e300, .text = "between the two"},
	{.name = "nu", .unit = "length^2/time", .otherwise = 1e-4, .high = 1e300, .text = "kinematic viscosity"},
	{0},
};

static double omega(const struct pm_scene_choice *c, double x, double y)
{
	const double a2 = c->value[RADIUS] * c->value[RADIUS], far = 0.5 * c->value[DISTANCE];
	const double both = exp(-((x - far) * (x - far) + y * y) / a2) + exp(-((x + far) * (x + far) + y * y) / a2);
	return c->value[GAMMA] / (pm_pi * a2) * both;
}

/* The vorticity ends 4.5 a beyond the centres, where it is 2e-9 of the largest; the box leaves as much again for the filaments. */
static int make(const struct pm_scene_choice *c, struct pm_frame *f)
{
	const double a = c->value[RADIUS], side = 0.5 * c->value[DISTANCE] + 6 * a, peak = fabs(c->value[GAMMA]) / (pm_pi * a * a);
	f->dt = 0.5 / fmax(peak, 1e-300);
	pm_frame_constant_set(f, "nu", c->value[NU]);
	return pm_scene_plane(c, f, -side, side, PM_OPEN, 128) ? -PM_DATA : pm_scene_vorticity(f, omega, c, 1e-9 * peak);
}

static double exact(const struct pm_frame *f, const char *quantity, double t)
{
	const double gamma = pm_frame_parameter(f, "circulation", 1), a = pm_frame_parameter(f, "radius", 0.25), b = pm_frame_parameter(f, "distance", 1);
	const double square = a * a + b * b / 4 + 4 * pm_frame_parameter(f, "nu", 1e-4) * t;
	const struct { const char *name; double value; } known[] = {
		{"circulation", 2 * gamma}, {"impulse_x", 0}, {"impulse_y", 0}, {"angular_impulse", -gamma * square},
	};
	for (size_t i = 0; i < sizeof known / sizeof *known; i++)
		if (!strcmp(quantity, known[i].name))
			return known[i].value;
	return NAN;
}

const struct pm_scene scene_vortex_merger = {
	.name = "vortex-merger",
	.sentence = "two equal vortices that merge into one",
	.source = "Melander, Zabusky, McWilliams 1988",
	.dims = 1u << 2,
	.dim = 2,
	.n_fixed = true,
	.shared = true,
	.parameters = rows,
	.make = make,
	.exact = exact,
};
