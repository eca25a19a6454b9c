/* An elliptical Gaussian vortex in a periodic box of side 2 pi: omega = W exp(-(X^2/(2 a^2) + Y^2/(2 b^2))) about its centre. It turns, ejects
 * filaments and becomes round. The default is VM-17 of the reference cases (W = 10, a = 1/2, b = 1/4, nu = 5e-4); --nu 0 is VM-21, whose vorticity
 * must never exceed its initial maximum. The solver removes the mean of omega. Source: Melander, McWilliams, Zabusky 1987, J. Fluid Mech. 178, 137.
 * Exact: circulation (the tails reach 3e-9 of the peak at the edge), with nu = 0 also omega_max and enstrophy. Cost: nodes of the mesh.
 * SPDX-License-Identifier: GPL-3.0-or-later */
#include <string.h>

#include "scene-parts/scene-vortices.h"

enum { PEAK, A, B, NU };

static const struct pm_scene_parameter rows[] = {
	{.name = "peak", .unit = "1/time", .otherwise = 10, .low = -1e300, .high = 1e300, .text = "largest vorticity"},
	{.name = "a", .unit = "length", .otherwise = 0.5, .low = 1e-300, .high = 1e300, .text = "standard deviation along x"},
	{.name = "b", .unit = "length", .otherwise = 0.25, .low = 1e-300, .high = 1e300, .text = "standard deviation along y"},
	{.name = "nu", .unit = "length^2/time", .otherwise = 5e-4, .high = 1e300, .text = "kinematic viscosity"},
	{0},
};

static double omega(const struct pm_scene_choice *c, double x, double y)
{
	const double X = (x - pm_pi) / c->value[A], Y = (y - pm_pi) / c->value[B];
	return c->value[PEAK] * exp(-0.5 * (X * X + Y * Y));
}

static int make(const struct pm_scene_choice *c, struct pm_frame *f)
{
	f->dt = 0.5 / fmax(fabs(c->value[PEAK]), 1e-300);
	pm_frame_constant_set(f, "nu", c->value[NU]);
	return pm_scene_plane(c, f, 0, 2 * pm_pi, PM_PERIODIC, 128) ? -PM_DATA : pm_scene_vorticity(f, omega, c, -1);
}

static double exact(const struct pm_frame *f, const char *quantity, double t)
{
	const double peak = pm_frame_parameter(f, "peak", 10), ab = pm_frame_parameter(f, "a", 0.5) * pm_frame_parameter(f, "b", 0.25);
	const bool same = t == 0 || pm_frame_parameter(f, "nu", 5e-4) == 0;
	if (!strcmp(quantity, "circulation"))
		return 2 * pm_pi * peak * ab;
	if (same && !strcmp(quantity, "omega_max"))
		return fabs(peak);
	if (same && !strcmp(quantity, "enstrophy"))
		return 0.5 * pm_pi * peak * peak * ab;
	return NAN;
}

const struct pm_scene scene_ellipse = {
	.name = "ellipse",
	.sentence = "an elliptical vortex that becomes round, periodic",
	.source = "Melander, McWilliams, Zabusky 1987",
	.dims = 1u << 2,
	.dim = 2,
	.n_fixed = true,
	.shared = true,
	.parameters = rows,
	.make = make,
	.exact = exact,
};
