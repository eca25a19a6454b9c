/* A vortex that spreads by viscosity in open space: omega = Gamma/(4 pi nu t) exp(-r^2/(4 nu t)), u_theta = Gamma/(2 pi r) (1 - exp(-r^2/
 * (4 nu t))). The frame begins at t = --start, where the vortex is no longer a point. The box is 5 of its radii sqrt(4 nu t) at 4 times that
 * age; vorticity below 1e-12 of the peak is left out.
 * Source: Lamb 1932, section 334a; Saffman 1992, section 13.1; VM-01 of the reference cases.
 * Exact: circulation, impulses, enstrophy, omega_max, palinstrophy. Cost: nodes of the mesh.
 * SPDX-License-Identifier: GPL-3.0-or-later */
#include <string.h>

#include "scene-parts/scene-vortices.h"

enum { GAMMA, NU, START, SOFTENING };

static const struct pm_scene_parameter rows[] = {
	{.name = "circulation", .unit = "length^2/time", .otherwise = 1, .low = -1e300, .high = 1e300, .text = "circulation of the vortex"},
	{.name = "nu", .unit = "length^2/time", .otherwise = 0.01, .high = 1e300, .text = "kinematic viscosity"},
	{.name = "start", .unit = "time", .otherwise = 1, .low = 1e-300, .high = 1e300, .text = "age of the vortex at the start"},
	{.name = "softening", .unit = "length", .high = 1e6, .text = "softening length of direct sums"},
	{0},
};

static double omega(const struct pm_scene_choice *c, double x, double y)
{
	const double d2 = 4 * c->value[NU] * c->value[START];
	return c->value[GAMMA] / (pm_pi * d2) * exp(-(x * x + y * y) / d2);
}

static int make(const struct pm_scene_choice *c, struct pm_frame *f)
{
	const double radius = sqrt(4 * c->value[NU] * c->value[START]);
	if (!(c->value[NU] > 0))
		return pm_fail(PM_USAGE, "a Lamb-Oseen vortex needs a viscosity (--nu above 0)");
	f->time = f->start = c->value[START];
	/* lsrk3 with 128 cells and differences of order 6 is stable up to 0.0203 of the start; |grad u| is half the vorticity of the centre, and of dt |grad u|
	 * a half keeps the particles together */
	f->dt = fmin(0.02 * c->value[START], 1 / fmax(fabs(omega(c, 0, 0)), 1e-300));
	pm_frame_constant_set(f, "nu", c->value[NU]);
	pm_frame_constant_set(f, "softening", c->value[SOFTENING]);
	if (pm_scene_plane(c, f, -10 * radius, 10 * radius, PM_OPEN, 128))
		return -PM_DATA;
	return pm_scene_vorticity(f, omega, c, 1e-12 * fabs(omega(c, 0, 0)));
}

static double exact(const struct pm_frame *f, const char *quantity, double t)
{
	const double gamma = pm_frame_parameter(f, "circulation", 1), d2 = 4 * pm_frame_parameter(f, "nu", 0.01) * t;
	const struct { const char *name; double value; } known[] = {
		{"circulation", gamma}, {"impulse_x", 0}, {"impulse_y", 0}, {"angular_impulse", -0.5 * gamma * d2},
		{"enstrophy", gamma * gamma / (4 * pm_pi * d2)}, {"omega_max", fabs(gamma) / (pm_pi * d2)},
		{"omega_centre", gamma / (pm_pi * d2)}, {"palinstrophy", gamma * gamma / (2 * pm_pi * d2 * d2)},
	};
	for (size_t i = 0; i < sizeof known / sizeof *known; i++)
		if (!strcmp(quantity, known[i].name))
			return known[i].value;
	return NAN;
}

const struct pm_scene scene_lamb_oseen = {
	.name = "lamb-oseen",
	.sentence = "a vortex that spreads by viscosity",
	.source = "Lamb 1932, section 334a",
	.dims = 1u << 2,
	.dim = 2,
	.n_fixed = true,
	.shared = true,
	.parameters = rows,
	.make = make,
	.exact = exact,
};
