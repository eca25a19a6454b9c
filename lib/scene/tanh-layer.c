/* A layer of shear u = U tanh(y/d), periodic along x and between walls at 10 d, displaced by a wave: the instability of Kelvin and Helmholtz.
 *     omega = -(U/d) sech^2((y - a cos kx)/d),   k a = the amplitude
 * Without viscosity a wave grows at the rate of Rayleigh's equation: 0.139491, 0.189702, 0.107735 U/d at k d = 0.2, 0.4446, 0.8 (VM-11 of the reference
 * cases; the largest is 0.18970210 at 0.444918), and waves with k d > 1 do not. The walls change it by exp(-20 k d).
 * Source: Michalke 1964, J. Fluid Mech. 19, 543. Exact: circulation; the rate at these k. Cost: nodes of the mesh. SPDX-License-Identifier: GPL-3.0-or-later */
#include <string.h>

#include "scene-parts/scene-vortex-set.h"
#include "scene-parts/scene-vortices.h"

enum { SPEED, THICKNESS, WAVENUMBER, AMPLITUDE, NU };
enum { HALF_HEIGHT = 10 }; /* [thickness]; sech^2 is 8e-9 there */

static const struct pm_scene_parameter rows[] = {
	{.name = "speed", .unit = "length/time", .otherwise = 1, .low = 1e-300, .high = 1e300, .text = "speed of each side"},
	{.name = "thickness", .unit = "length", .otherwise = 1, .low = 1e-300, .high = 1e300, .text = "d in tanh(y/d)"},
	{.name = "wavenumber", .unit = "1/length", .otherwise = 0.4446, .low = 1e-300, .high = 1e300, .text = "k of mode 1; the box is 2 pi/k long"},
	{.name = "amplitude", .otherwise = 1e-3, .high = 0.999, .text = "k A at the start"},
	{.name = "nu", .unit = "length^2/time", .high = 1e300, .text = "kinematic viscosity"},
	{0},
};

static double omega(const struct pm_scene_choice *c, double x, double y)
{
	const double k = c->value[WAVENUMBER], sech = 1 / cosh((y - c->value[AMPLITUDE] / k * cos(k * x)) / c->value[THICKNESS]);
	return -c->value[SPEED] / c->value[THICKNESS] * sech * sech;
}

static int make(const struct pm_scene_choice *c, struct pm_frame *f)
{
	const double d = c->value[THICKNESS], lo[3] = {0, -HALF_HEIGHT * d}, hi[3] = {2 * pm_pi / c->value[WAVENUMBER], HALF_HEIGHT * d};
	const size_t cells[3] = {64, 96, 1};
	f->dt = 0.25 * d / c->value[SPEED];
	pm_frame_constant_set(f, "nu", c->value[NU]);
	if (pm_scene_vortex_box(c, f, 2, lo, hi, PM_PERIODIC, cells))
		return -PM_DATA;
	for (int side = 0; side < 2; side++)
		f->face[1][side] = PM_WALL, f->pface[1][side] = PM_PREFLECT;
	return pm_scene_vorticity(f, omega, c, 1e-7 * c->value[SPEED] / d); /* nothing on the walls */
}

static double exact(const struct pm_frame *f, const char *quantity, double t)
{
	static const struct { double kd, rate; } known[] = {{0.2, 0.139491176634992}, {0.4446, 0.189702025682916}, {0.8, 0.107735163134836}};
	const double u = pm_frame_parameter(f, "speed", 1), d = pm_frame_parameter(f, "thickness", 1), k = pm_frame_parameter(f, "wavenumber", 0.4446);
	(void)t;
	if (!strcmp(quantity, "circulation"))
		return -4 * pm_pi * u / k;
	for (size_t i = 0; i < sizeof known / sizeof *known && !strcmp(quantity, "gamma"); i++)
		if (fabs(k * d - known[i].kd) < 1e-9 && pm_frame_parameter(f, "nu", 0) == 0)
			return known[i].rate * u / d;
	return NAN;
}

const struct pm_scene scene_tanh_layer = {
	.name = "tanh-layer",
	.sentence = "a layer of shear between walls, unstable by Kelvin and Helmholtz",
	.source = "Michalke 1964",
	.dims = 1u << 2,
	.dim = 2,
	.n_fixed = true,
	.shared = true,
	.parameters = rows,
	.make = make,
	.exact = exact,
};
