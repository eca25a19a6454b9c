/* The Lamb-Chaplygin dipole: a pair of vortices in a circle of radius a that moves along x with the speed U as it is,
 *     omega = -2 U k J1(k r) sin(theta)/J0(k a) for r < a, 0 beyond, k a = 3.831705970207512, the first zero of J1.
 * Source: Lamb 1932, section 165; Chaplygin 1903; Meleshko and van Heijst 1994, J. Fluid Mech. 272, 157; VM-06 of the reference cases.
 * Exact without viscosity: circulation 0, impulses (2 pi U a^2, 0), angular impulse 0, enstrophy pi (k a)^2 U^2, energy 2 pi U^2 a^2, omega_max. The
 * vorticity has a kink at r = a. Cost: nodes of the mesh. SPDX-License-Identifier: GPL-3.0-or-later */
#include <string.h>

#include "scene-parts/scene-vortices.h"

enum { SPEED, RADIUS, NU };
static const double ka = 3.831705970207512, peak = 11.0713069764; /* omega_max of U = a = 1, at r = 0.48051280434 */

static const struct pm_scene_parameter rows[] = {
	{.name = "speed", .unit = "length/time", .otherwise = 1, .high = 1e300, .text = "speed of the dipole"},
	{.name = "radius", .unit = "length", .otherwise = 1, .low = 1e-300, .high = 1e300, .text = "radius of the circle that holds its vorticity"},
	{.name = "nu", .unit = "length^2/time", .high = 1e300, .text = "kinematic viscosity"},
	{0},
};

static double omega(const struct pm_scene_choice *c, double x, double y)
{
	const double a = c->value[RADIUS], r = hypot(x, y), k = ka / a;
	return r > 0 && r < a ? -2 * c->value[SPEED] * k * j1(k * r) / j0(ka) * (y / r) : 0;
}

static int make(const struct pm_scene_choice *c, struct pm_frame *f)
{
	const double a = c->value[RADIUS];
	f->dt = a / fmax(peak * c->value[SPEED], 1e-300);
	pm_frame_constant_set(f, "nu", c->value[NU]);
	return pm_scene_plane(c, f, -2 * a, 2 * a, PM_OPEN, 128) ? -PM_DATA : pm_scene_vorticity(f, omega, c, 0);
}

static double exact(const struct pm_frame *f, const char *quantity, double t)
{
	const double a = pm_frame_parameter(f, "radius", 1), u = pm_frame_parameter(f, "speed", 1);
	const double steady = t == 0 || pm_frame_parameter(f, "nu", 0) == 0 ? 1 : NAN, energy = 2 * pm_pi * u * u * a * a * steady;
	const struct { const char *name; double value; } known[] = {
		{"circulation", 0}, {"impulse_x", 2 * pm_pi * u * a * a}, {"impulse_y", 0}, {"angular_impulse", 0},
		{"enstrophy", pm_pi * ka * ka * u * u * steady}, {"energy", energy}, {"energy_field_mesh", energy}, {"omega_max", peak * u / a * steady},
	};
	for (size_t i = 0; i < sizeof known / sizeof *known; i++)
		if (!strcmp(quantity, known[i].name))
			return known[i].value;
	return NAN;
}

const struct pm_scene scene_lamb_dipole = {
	.name = "lamb-dipole",
	.sentence = "a pair of vortices in a circle that moves as it is",
	.source = "Lamb 1932, section 165",
	.dims = 1u << 2,
	.dim = 2,
	.n_fixed = true,
	.shared = true,
	.parameters = rows,
	.make = make,
	.exact = exact,
};
