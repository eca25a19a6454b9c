/* Counter-rotating vortices in a periodic box of side 2 pi/k: omega = 2 U k sin(kx) sin(ky) exp(-2 nu k^2 t), an exact solution of the
 * Navier-Stokes equations: the flow stays as it is and decays. (U = 1, k = 1 give VM-02 of the reference cases.)
 * Source: Taylor 1923, Phil. Mag. 46, 671; Taylor, Green 1937. Exact: circulation, impulses, energy, enstrophy, omega_max, palinstrophy.
 * Cost: nodes of the mesh.
 * SPDX-License-Identifier: GPL-3.0-or-later */
#include <string.h>

#include "scene-parts/scene-vortices.h"

enum { SPEED, LENGTH, NU };

static const struct pm_scene_parameter rows[] = {
	{.name = "speed", .unit = "length/time", .otherwise = 1, .high = 1e300, .text = "largest speed"},
	{.name = "length", .unit = "length", .otherwise = 2 * 3.14159265358979323846, .low = 1e-300, .high = 1e300, .text = "side of the box"},
	{.name = "nu", .unit = "length^2/time", .otherwise = 0.01, .high = 1e300, .text = "kinematic viscosity"},
	{0},
};

static double omega(const struct pm_scene_choice *c, double x, double y)
{
	const double k = 2 * pm_pi / c->value[LENGTH];
	return 2 * c->value[SPEED] * k * sin(k * x) * sin(k * y);
}

static int make(const struct pm_scene_choice *c, struct pm_frame *f)
{
	f->dt = 0.05 * c->value[LENGTH] / (2 * pm_pi) / fmax(c->value[SPEED], 1e-300);
	pm_frame_constant_set(f, "nu", c->value[NU]);
	return pm_scene_plane(c, f, 0, c->value[LENGTH], PM_PERIODIC, 64) ? -PM_DATA : pm_scene_vorticity(f, omega, c, -1);
}

static double exact(const struct pm_frame *f, const char *quantity, double t)
{
	const double length = pm_frame_parameter(f, "length", 2 * pm_pi), k = 2 * pm_pi / length, area = length * length;
	const double u = pm_frame_parameter(f, "speed", 1) * exp(-2 * pm_frame_parameter(f, "nu", 0.01) * k * k * t), z = 0.5 * u * u * k * k * area;
	const struct { const char *name; double value; } known[] = {
		{"circulation", 0}, {"energy", 0.25 * u * u * area}, {"energy_field_mesh", 0.25 * u * u * area}, {"enstrophy", z},
		{"omega_max", 2 * u * k}, {"palinstrophy", 2 * k * k * z},
	};
	for (size_t i = 0; i < sizeof known / sizeof *known; i++)
		if (!strcmp(quantity, known[i].name))
			return known[i].value;
	return NAN;
}

const struct pm_scene scene_taylor_green_2d = {
	.name = "taylor-green-2d",
	.sentence = "vortices that decay and stay where they are, periodic",
	.source = "Taylor 1923",
	.dims = 1u << 2,
	.dim = 2,
	.n_fixed = true,
	.shared = true,
	.parameters = rows,
	.make = make,
	.exact = exact,
};
