/* A vortex tube along z, periodic along it and open around, with a Gaussian core a and a bending wave: about its centre line X = A cos(k z), Y = 0,
 *   omega = Gamma/(pi a^2) exp(-((x - X)^2 + y^2)/a^2) (X', 0, 1),
 * which has no divergence. For k A and k a << 1 the plane of the wave turns, against the sense of the vortex, as Kelvin's slowest bending wave:
 *   Omega = Gamma k^2/(4 pi) (ln(2/(k a)) - gamma + C), gamma Euler's constant, C = (gamma - ln 2)/2 of a Gaussian core (1/4 of Kelvin's uniform one).
 * Source: Thomson (Kelvin) 1880, Phil. Mag. 10, 155; Saffman 1992, sections 11.2 and 12.1. Exact: the total (0, 0, Gamma 2 pi/k), helicity 0; to the order
 * named, without viscosity, rate = -Omega, and of mode 1 omega = |Omega| and gamma = 0. Cost: nodes of the mesh. SPDX-License-Identifier: GPL-3.0-or-later */
#include <string.h>

#include "scene-parts/scene-space.h"

enum { GAMMA, WAVENUMBER, CORE, AMPLITUDE, NU };
static const double euler = 0.57721566490153286;

static const struct pm_scene_parameter rows[] = {
	{.name = "circulation", .unit = "length^2/time", .otherwise = 1, .low = -1e300, .high = 1e300, .text = "circulation of the tube"},
	{.name = "wavenumber", .unit = "1/length", .otherwise = 1, .low = 1e-300, .high = 1e300, .text = "k of mode 1; the box is 2 pi/k long"},
	{.name = "core", .unit = "1/k", .otherwise = 0.2, .low = 0.001, .high = 0.5, .text = "radius a of the core, times k"},
	{.name = "amplitude", .otherwise = 0.05, .high = 0.999, .text = "k A at the start"},
	{.name = "nu", .unit = "length^2/time", .high = 1e300, .text = "kinematic viscosity"},
	{0},
};

static void omega(const struct pm_scene_choice *c, const double x[3], double w[3])
{
	const double k = c->value[WAVENUMBER], a = c->value[CORE] / k, A = c->value[AMPLITUDE] / k, off = x[0] - A * cos(k * x[2]);
	w[2] = c->value[GAMMA] / (pm_pi * a * a) * exp(-(off * off + x[1] * x[1]) / (a * a));
	w[0] = -A * k * sin(k * x[2]) * w[2];
	w[1] = 0;
}

static int make(const struct pm_scene_choice *c, struct pm_frame *f)
{
	const double k = c->value[WAVENUMBER], a = c->value[CORE] / k, side = c->value[AMPLITUDE] / k + 8 * a;
	const double lo[3] = {-side, -side, 0}, hi[3] = {side, side, 2 * pm_pi / k}, peak = fabs(c->value[GAMMA]) / (pm_pi * a * a);
	const size_t cells[3] = {32, 32, 32};
	f->dt = 0.5 / fmax(peak, 1e-300);
	pm_frame_constant_set(f, "nu", c->value[NU]);
	if (pm_scene_space(c, f, lo, hi, PM_OPEN, cells))
		return -PM_DATA;
	for (int end = 0; end < 2; end++)
		f->face[2][end] = PM_PERIODIC, f->pface[2][end] = PM_PFOLD;
	return pm_scene_space_vorticity(f, omega, c, 1e-7 * peak);
}

static double exact(const struct pm_frame *f, const char *quantity, double t)
{
	const double gamma = pm_frame_parameter(f, "circulation", 1), k = pm_frame_parameter(f, "wavenumber", 1), ka = pm_frame_parameter(f, "core", 0.2);
	(void)t;
	if (!strcmp(quantity, "alpha_x") || !strcmp(quantity, "alpha_y") || !strcmp(quantity, "helicity"))
		return 0;
	if (!strcmp(quantity, "alpha_z"))
		return gamma * 2 * pm_pi / k;
	const double rate = -gamma * k * k / (4 * pm_pi) * (log(2 / ka) - euler + (euler - log(2)) / 2);
	if (pm_frame_parameter(f, "nu", 0) != 0)
		return NAN;
	return !strcmp(quantity, "rate") ? rate : !strcmp(quantity, "omega") ? fabs(rate) : !strcmp(quantity, "gamma") ? 0 : NAN; /* of mode 1 */
}

const struct pm_scene scene_vortex_tube = {
	.name = "vortex-tube",
	.sentence = "a vortex tube with a bending wave",
	.source = "Kelvin 1880",
	.dims = 1u << 3,
	.dim = 3,
	.n_fixed = true,
	.shared = true,
	.parameters = rows,
	.make = make,
	.exact = exact,
};
