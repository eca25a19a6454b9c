/* Two layers of shear in a periodic unit box that roll up: u = tanh(rho (y - 1/4)) for y <= 1/2, tanh(rho (3/4 - y)) above, v = delta
 * sin(2 pi x); omega = dv/dx - du/dy. rho = 80, delta = 0.05, nu = 1e-4 is the thin layer of Brown and Minion, in which an under-resolved computation makes
 * a spurious vortex: omega at (0, 1/4) at t = 1 is -26.070867, the centre of a braid (VM-16 of the reference cases). rho = 30 is the thick one.
 * Source: Bell, Colella, Glaz 1989, J. Comput. Phys. 85, 257; Brown, Minion 1995, J. Comput. Phys. 122, 165.
 * Exact: circulation; of the defaults omega_centre at (0, 1/4), energy, enstrophy, omega_max at t = 0.4, 0.8, 1 (pseudo-spectral, 1024^2). Cost: nodes.
 * SPDX-License-Identifier: GPL-3.0-or-later */
#include <string.h>

#include "scene-parts/scene-vortices.h"

enum { RHO, DELTA, NU };

static const struct pm_scene_parameter rows[] = {
	{.name = "rho", .unit = "1/length", .otherwise = 80, .low = 1e-300, .high = 1e300, .text = "steepness of the layers: 80 thin, 30 thick"},
	{.name = "delta", .unit = "length/time", .otherwise = 0.05, .low = -1e300, .high = 1e300, .text = "speed of the disturbance"},
	{.name = "nu", .unit = "length^2/time", .otherwise = 1e-4, .high = 1e300, .text = "kinematic viscosity"},
	{0},
};

static double omega(const struct pm_scene_choice *c, double x, double y)
{
	const double s = y <= 0.5 ? c->value[RHO] * (y - 0.25) : c->value[RHO] * (0.75 - y), sech = 1 / cosh(s);
	return 2 * pm_pi * c->value[DELTA] * cos(2 * pm_pi * x) + (y <= 0.5 ? -1 : 1) * c->value[RHO] * sech * sech;
}

static int make(const struct pm_scene_choice *c, struct pm_frame *f)
{
	f->dt = 0.005 * fmin(10, rows[RHO].otherwise / c->value[RHO]); /* 0.4 of 1/rho, the time of the strain; of thick layers a part of L/u */
	pm_frame_constant_set(f, "nu", c->value[NU]);
	return pm_scene_plane(c, f, 0, 1, PM_PERIODIC, 256) ? -PM_DATA : pm_scene_vorticity(f, omega, c, -1);
}

static double exact(const struct pm_frame *f, const char *quantity, double t)
{
	static const struct { double t; const char *name; double value; } known[] = {
		{0.4, "energy", 0.4683194628}, {0.4, "enstrophy", 80.0145242}, {0.4, "omega_max", 60.66112}, {0.8, "energy", 0.4625872548},
		{0.8, "enstrophy", 62.4543471}, {0.8, "omega_max", 59.01787}, {1, "energy", 0.4602858183}, {1, "enstrophy", 52.9735215},
		{1, "omega_max", 58.56492}, {1, "omega_centre", -26.070867},
	};
	bool standard = true;
	for (int i = 0; rows[i].name; i++)
		standard = standard && pm_frame_parameter(f, rows[i].name, rows[i].otherwise) == rows[i].otherwise;
	if (!strcmp(quantity, "circulation") || !strcmp(quantity, "place_x"))
		return 0;
	if (!strcmp(quantity, "place_y"))
		return 0.25;
	for (size_t i = 0; i < sizeof known / sizeof *known && standard; i++)
		if (!strcmp(quantity, known[i].name) && fabs(t - known[i].t) < 1e-9)
			return known[i].value;
	return NAN;
}

const struct pm_scene scene_shear_layer = {
	.name = "shear-layer",
	.sentence = "two layers of shear that roll up, periodic",
	.source = "Brown and Minion 1995",
	.dims = 1u << 2,
	.dim = 2,
	.n_fixed = true,
	.shared = true,
	.parameters = rows,
	.make = make,
	.exact = exact,
};
