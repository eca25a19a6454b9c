/* A vortex ring about the z axis that moves along it: omega_phi = Gamma/(pi a^2) (exp(-((r - R)^2 + z^2)/a^2) - exp(-((r + R)^2 + z^2)/a^2)), where the
 * second part makes it smooth on the axis. Its speed without viscosity, for a << R, is that of a Gaussian core,
 *     U = Gamma/(4 pi R) (ln(8 R/a) - (1 - gamma + ln 2)/2) = Gamma/(4 pi R) (ln(8 R/a) - 0.557966),
 * with an error of order (a/R)^2 ln(R/a); VM-10 of the reference cases.
 * Source: Saffman 1970, Stud. Appl. Math. 49, 371; Saffman 1992, section 10.3.
 * Exact, but for exp(-(R/a)^2): total, circulation, impulse and its radius, all conserved without viscosity; to that order speed and position.
 * Cost: nodes of the mesh. SPDX-License-Identifier: GPL-3.0-or-later */
#include <string.h>

#include "scene-parts/scene-space.h"

enum { GAMMA, RADIUS, CORE, NU };
static const double core_constant = 0.557965757829206; /* (1 - Euler's gamma + ln 2)/2 */

static const struct pm_scene_parameter rows[] = {
	{.name = "circulation", .unit = "length^2/time", .otherwise = 1, .low = -1e300, .high = 1e300, .text = "circulation of the ring"},
	{.name = "radius", .unit = "length", .otherwise = 1, .low = 1e-300, .high = 1e300, .text = "radius of the ring"},
	{.name = "core", .unit = "radius", .otherwise = 0.1, .low = 0.001, .high = 0.3, .text = "radius a of the core, over that of the ring"},
	{.name = "nu", .unit = "length^2/time", .high = 1e300, .text = "kinematic viscosity"},
	{0},
};

static void omega(const struct pm_scene_choice *c, const double x[3], double w[3])
{
	const double R = c->value[RADIUS], a2 = pow(c->value[CORE] * R, 2), r = hypot(x[0], x[1]), z2 = x[2] * x[2];
	const double around = c->value[GAMMA] / (pm_pi * a2) * (exp(-((r - R) * (r - R) + z2) / a2) - exp(-((r + R) * (r + R) + z2) / a2));
	w[0] = r > 0 ? -around * x[1] / r : 0;
	w[1] = r > 0 ? around * x[0] / r : 0;
	w[2] = 0;
}

/* The vorticity ends 4 a beyond the ring, the box 8 a, as far along the axis as half of the box across. */
static int make(const struct pm_scene_choice *c, struct pm_frame *f)
{
	const double R = c->value[RADIUS], a = c->value[CORE] * R, side = R + 8 * a, lo[3] = {-side, -side, -side / 2}, hi[3] = {side, side, side / 2};
	const double peak = fabs(c->value[GAMMA]) / (pm_pi * a * a);
	const size_t cells[3] = {64, 64, 32};
	f->dt = 0.5 / fmax(peak, 1e-300); /* |grad u| is half the vorticity of the centre */
	pm_frame_constant_set(f, "nu", c->value[NU]);
	return pm_scene_space(c, f, lo, hi, PM_OPEN, cells) ? -PM_DATA : pm_scene_space_vorticity(f, omega, c, 1e-7 * peak);
}

static double exact(const struct pm_frame *f, const char *quantity, double t)
{
	const double gamma = pm_frame_parameter(f, "circulation", 1), R = pm_frame_parameter(f, "radius", 1), a = R * pm_frame_parameter(f, "core", 0.1);
	const double inviscid = pm_frame_parameter(f, "nu", 0) == 0 ? 1 : NAN, speed = gamma / (4 * pm_pi * R) * (log(8 * R / a) - core_constant);
	const double impulse = pm_pi * gamma * (R * R + a * a / 2);
	const struct { const char *name; double value; } known[] = {
		{"alpha_x", 0}, {"alpha_y", 0}, {"alpha_z", 0}, {"impulse_x", 0}, {"impulse_y", 0}, {"impulse_z", impulse},
		{"angular_impulse_x", 0}, {"angular_impulse_y", 0}, {"angular_impulse_z", 0}, {"helicity", 0},
		{"ring_circulation", t == 0 ? gamma : gamma * inviscid}, {"ring_radius", (t == 0 ? 1 : inviscid) * sqrt(R * R + a * a / 2)},
		{"ring_position", t == 0 ? 0 : speed * t * inviscid}, {"ring_speed", speed * inviscid},
	};
	for (size_t i = 0; i < sizeof known / sizeof *known; i++)
		if (!strcmp(quantity, known[i].name))
			return known[i].value;
	return NAN;
}

const struct pm_scene scene_vortex_ring = {
	.name = "vortex-ring",
	.sentence = "a thin vortex ring that moves along its axis",
	.source = "Saffman 1970",
	.dims = 1u << 3,
	.dim = 3,
	.n_fixed = true,
	.shared = true,
	.parameters = rows,
	.make = make,
	.exact = exact,
};
