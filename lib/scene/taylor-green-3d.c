/* The Taylor-Green vortex in a periodic box of side 2 pi/k, which makes ever smaller vortices and decays:
 *     u = U (sin kx cos ky cos kz, -cos kx sin ky cos kz, 0),  omega = U k (-cos kx sin ky sin kz, -sin kx cos ky sin kz, 2 sin kx sin ky cos kz).
 * Source: Taylor and Green 1937; Brachet et al. 1983. Exact: energy and enstrophy at the start, helicity 0, totals 0; of U = k = 1 the dissipation of a
 * spectral code at Re = 1/nu = 100, 400, 1600 (VM-19, VM-20 of the reference cases, 192^3 and more) at the times listed there.
 * Cost: nodes of the mesh. SPDX-License-Identifier: GPL-3.0-or-later */
#include <string.h>

#include "scene-parts/scene-space.h"

enum { SPEED, LENGTH, NU };

static const struct pm_scene_parameter rows[] = {
	{.name = "speed", .unit = "length/time", .otherwise = 1, .high = 1e300, .text = "largest speed"},
	{.name = "length", .unit = "length", .otherwise = 2 * 3.14159265358979323846, .low = 1e-300, .high = 1e300, .text = "side of the box"},
	{.name = "nu", .unit = "length^2/time", .otherwise = 0.01, .high = 1e300, .text = "kinematic viscosity"},
	{0},
};

static void omega(const struct pm_scene_choice *c, const double x[3], double w[3])
{
	const double k = 2 * pm_pi / c->value[LENGTH], uk = c->value[SPEED] * k;
	w[0] = -uk * cos(k * x[0]) * sin(k * x[1]) * sin(k * x[2]);
	w[1] = -uk * sin(k * x[0]) * cos(k * x[1]) * sin(k * x[2]);
	w[2] = 2 * uk * sin(k * x[0]) * sin(k * x[1]) * cos(k * x[2]);
}

static int make(const struct pm_scene_choice *c, struct pm_frame *f)
{
	const double side = c->value[LENGTH], lo[3] = {0}, hi[3] = {side, side, side};
	const size_t cells[3] = {32, 32, 32};
	f->dt = 0.05 * side / (2 * pm_pi) / fmax(c->value[SPEED], 1e-300);
	pm_frame_constant_set(f, "nu", c->value[NU]);
	return pm_scene_space(c, f, lo, hi, PM_PERIODIC, cells) ? -PM_DATA : pm_scene_space_vorticity(f, omega, c, -1);
}

/* Dissipation per mass; NAN where the table has none. */
static double dissipation(double nu, double t)
{
	static const struct { double nu, t, value; } known[] = {
		{0.01, 1, 0.00776856199}, {0.01, 2, 0.00926578743}, {0.01, 4, 0.0125755127}, {0.01, 8, 0.00870774903},
		{0.0025, 2, 0.0027124}, {0.0025, 4, 0.0060457}, {0.0025, 6, 0.010782}, {0.0025, 8, 0.010683},
		{0.000625, 9, 0.012802},
	};
	for (size_t i = 0; i < sizeof known / sizeof *known; i++)
		if (fabs(nu - known[i].nu) < 1e-12 && fabs(t - known[i].t) < 1e-9)
			return known[i].value;
	return NAN;
}

static double exact(const struct pm_frame *f, const char *quantity, double t)
{
	const double length = pm_frame_parameter(f, "length", 2 * pm_pi), k = 2 * pm_pi / length, volume = length * length * length;
	const double u = pm_frame_parameter(f, "speed", 1), nu = pm_frame_parameter(f, "nu", 0.01), now = t == 0 ? 1 : NAN;
	const double energy = 0.125 * u * u * volume * now, enstrophy = 0.375 * u * u * k * k * volume * now;
	const struct { const char *name; double value; } known[] = {
		{"alpha_x", 0}, {"alpha_y", 0}, {"alpha_z", 0}, {"helicity", 0}, {"energy", energy}, {"energy_field_mesh", energy}, {"energy_flow", energy},
		{"enstrophy", enstrophy}, {"omega_max", 2 * u * k * now},
		{"dissipation", t == 0 ? 2 * nu * enstrophy : u == 1 && k == 1 ? volume * dissipation(nu, t) : NAN},
	};
	for (size_t i = 0; i < sizeof known / sizeof *known; i++)
		if (!strcmp(quantity, known[i].name))
			return known[i].value;
	return NAN;
}

const struct pm_scene scene_taylor_green_3d = {
	.name = "taylor-green-3d",
	.sentence = "vortices in space that break up and decay, periodic",
	.source = "Taylor and Green 1937",
	.dims = 1u << 3,
	.dim = 3,
	.n_fixed = true,
	.shared = true,
	.parameters = rows,
	.make = make,
	.exact = exact,
};
