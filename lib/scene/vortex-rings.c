/* Two coaxial vortex rings about the z axis at -d/2 and d/2, with Gaussian cores as in vortex-ring. Of equal circulations they pass through each other in turn
 * (leapfrog); of opposite ones, --circulation2 -1, they collide and spread.
 * Source: Saffman 1992, section 10.2; Oshima 1978, J. Phys. Soc. Jpn. 45, 660 (collision); Dyson 1893, Phil. Trans. A 184, 1041 (leapfrog).
 * Exact: totals 0, impulse pi sum Gamma_i (R_i^2 + a_i^2/2) with and without viscosity, helicity and angular impulse 0.
 * Cost: nodes of the mesh. SPDX-License-Identifier: GPL-3.0-or-later */
#include <string.h>

#include "scene-parts/scene-space.h"

enum { LOWER, UPPER, RADIUS, CORE, DISTANCE, NU };

static const struct pm_scene_parameter rows[] = {
	{.name = "circulation1", .unit = "length^2/time", .otherwise = 1, .low = -1e300, .high = 1e300, .text = "circulation of the lower ring"},
	{.name = "circulation2", .unit = "length^2/time", .otherwise = 1, .low = -1e300, .high = 1e300, .text = "of the upper ring; -1: they collide"},
	{.name = "radius", .unit = "length", .otherwise = 1, .low = 1e-300, .high = 1e300, .text = "radius of both rings"},
	{.name = "core", .unit = "radius", .otherwise = 0.15, .low = 0.001, .high = 0.3, .text = "radius a of the core, over that of the ring"},
	{.name = "distance", .unit = "length", .otherwise = 1, .low = 1e-300, .high = 1e300, .text = "distance of the planes of the rings"},
	{.name = "nu", .unit = "length^2/time", .high = 1e300, .text = "kinematic viscosity"},
	{0},
};

static void omega(const struct pm_scene_choice *c, const double x[3], double w[3])
{
	const double R = c->value[RADIUS], a2 = pow(c->value[CORE] * R, 2), r = hypot(x[0], x[1]);
	double around = 0;
	for (int ring = 0; ring < 2; ring++) {
		const double z = x[2] + (ring ? -0.5 : 0.5) * c->value[DISTANCE], gamma = c->value[ring ? UPPER : LOWER];
		around += gamma / (pm_pi * a2) * (exp(-((r - R) * (r - R) + z * z) / a2) - exp(-((r + R) * (r + R) + z * z) / a2));
	}
	w[0] = r > 0 ? -around * x[1] / r : 0;
	w[1] = r > 0 ? around * x[0] / r : 0;
	w[2] = 0;
}

static int make(const struct pm_scene_choice *c, struct pm_frame *f)
{
	const double R = c->value[RADIUS], a = c->value[CORE] * R, side = R + 8 * a, high = 0.5 * c->value[DISTANCE] + 8 * a;
	const double lo[3] = {-side, -side, -high}, hi[3] = {side, side, high};
	const double peak = fmax(fabs(c->value[LOWER]), fabs(c->value[UPPER])) / (pm_pi * a * a);
	const size_t cells[3] = {64, 64, 48};
	f->dt = 0.5 / fmax(peak, 1e-300);
	pm_frame_constant_set(f, "nu", c->value[NU]);
	return pm_scene_space(c, f, lo, hi, PM_OPEN, cells) ? -PM_DATA : pm_scene_space_vorticity(f, omega, c, 1e-7 * peak);
}

static double exact(const struct pm_frame *f, const char *quantity, double t)
{
	const double gamma = pm_frame_parameter(f, "circulation1", 1) + pm_frame_parameter(f, "circulation2", 1);
	const double R = pm_frame_parameter(f, "radius", 1), a = R * pm_frame_parameter(f, "core", 0.15), impulse = pm_pi * gamma * (R * R + a * a / 2);
	const struct { const char *name; double value; } known[] = {
		{"alpha_x", 0}, {"alpha_y", 0}, {"alpha_z", 0}, {"impulse_x", 0}, {"impulse_y", 0}, {"impulse_z", impulse},
		{"angular_impulse_x", 0}, {"angular_impulse_y", 0}, {"angular_impulse_z", 0}, {"helicity", 0},
	};
	(void)t;
	for (size_t i = 0; i < sizeof known / sizeof *known; i++)
		if (!strcmp(quantity, known[i].name))
			return known[i].value;
	return NAN;
}

const struct pm_scene scene_vortex_rings = {
	.name = "vortex-rings",
	.sentence = "two vortex rings that leapfrog or collide",
	.source = "Saffman 1992, section 10.2",
	.dims = 1u << 3,
	.dim = 3,
	.n_fixed = true,
	.shared = true,
	.parameters = rows,
	.make = make,
	.exact = exact,
};
