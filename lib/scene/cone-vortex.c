/* A round vortex with a conical profile in open space, omega = W max(0, 1 - r/R): an exact steady flow without viscosity, in which neighbouring
 * rings slide past each other; particles that are not remeshed lose their overlap and their roundness. u_theta = W (r/2 - r^2/(3R)) inside, W R^2/(6r) outside,
 * the largest 3 W R/16 at r = 3R/4. Source: Koumoutsakos 1997, J. Comput. Phys. 138, 821; scene A of the notes (W = 100, R = 0.5, dt = 5e-3).
 * Exact at any time (nu = 0): circulation, impulses, enstrophy, omega_max, speed_max. Cost: nodes of the mesh.
 * SPDX-License-Identifier: GPL-3.0-or-later */
#include <string.h>

#include "scene-parts/scene-vortices.h"

enum { PEAK, RADIUS, NU, SOFTENING };

static const struct pm_scene_parameter rows[] = {
	{.name = "peak", .unit = "1/time", .otherwise = 100, .low = -1e300, .high = 1e300, .text = "largest vorticity"},
	{.name = "radius", .unit = "length", .otherwise = 0.5, .low = 1e-300, .high = 1e300, .text = "radius of the vortex"},
	{.name = "nu", .unit = "length^2/time", .high = 1e300, .text = "kinematic viscosity"},
	{.name = "softening", .unit = "length", .high = 1e6, .text = "softening length of direct sums"},
	{0},
};

static double omega(const struct pm_scene_choice *c, double x, double y)
{
	return c->value[PEAK] * fmax(0, 1 - sqrt(x * x + y * y) / c->value[RADIUS]);
}

static int make(const struct pm_scene_choice *c, struct pm_frame *f)
{
	f->dt = 0.5 / fmax(fabs(c->value[PEAK]), 1e-300);
	pm_frame_constant_set(f, "nu", c->value[NU]);
	pm_frame_constant_set(f, "softening", c->value[SOFTENING]);
	if (pm_scene_plane(c, f, -2 * c->value[RADIUS], 2 * c->value[RADIUS], PM_OPEN, 128))
		return -PM_DATA;
	return pm_scene_vorticity(f, omega, c, 0);
}

static double exact(const struct pm_frame *f, const char *quantity, double t)
{
	const double w = pm_frame_parameter(f, "peak", 100), r = pm_frame_parameter(f, "radius", 0.5), r2 = r * r;
	const struct { const char *name; double value; } known[] = {
		{"circulation", pm_pi * w * r2 / 3}, {"impulse_x", 0}, {"impulse_y", 0}, {"angular_impulse", -pm_pi * w * r2 * r2 / 20},
		{"enstrophy", pm_pi * w * w * r2 / 12}, {"omega_max", fabs(w)}, {"speed_max", 3 * fabs(w) * r / 16},
	};
	for (size_t i = 0; i < sizeof known / sizeof *known; i++)
		if (!strcmp(quantity, known[i].name) && (t == 0 || pm_frame_parameter(f, "nu", 0) == 0))
			return known[i].value;
	return NAN;
}

const struct pm_scene scene_cone_vortex = {
	.name = "cone-vortex",
	.sentence = "a round steady vortex with straight flanks",
	.source = "Koumoutsakos 1997",
	.dims = 1u << 2,
	.dim = 2,
	.n_fixed = true,
	.shared = true,
	.parameters = rows,
	.make = make,
	.exact = exact,
};
