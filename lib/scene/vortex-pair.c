/* Two point vortices in open space, distance --distance apart along x: if equal and of opposite sign they move straight at Gamma/(2 pi d), else they turn about
 * their centre of circulation at (Gamma1 + Gamma2)/(2 pi d^2). Source: Saffman 1992, section 7.2; VM-08 of the reference cases.
 * Exact: circulation, impulses, angular_impulse, rate or speed, energy_field_pair. 
 * SPDX-License-Identifier: GPL-3.0-or-later */
#include <string.h>

#include "scene-parts/scene-vortices.h"

enum { GAMMA1, GAMMA2, DISTANCE, SOFTENING };

static const struct pm_scene_parameter rows[] = {
	{.name = "circulation1", .unit = "length^2/time", .otherwise = 1, .low = -1e300, .high = 1e300, .text = "circulation of the left one"},
	{.name = "circulation2", .unit = "length^2/time", .otherwise = 2, .low = -1e300, .high = 1e300, .text = "circulation of the right one"},
	{.name = "distance", .unit = "length", .otherwise = 1, .low = 1e-300, .high = 1e300, .text = "between the two"},
	{.name = "softening", .unit = "length", .high = 1e6, .text = "softening length of direct sums"},
	{0},
};

static int make(const struct pm_scene_choice *c, struct pm_frame *f)
{
	const double g[2] = {c->value[GAMMA1], c->value[GAMMA2]}, d = c->value[DISTANCE], sum = fabs(g[0]) + fabs(g[1]);
	struct pm_scene_vortices v;
	f->dt = 4 * pm_pi * pm_pi * d * d / fmax(sum, 1e-300) / 200;
	pm_frame_constant_set(f, "nu", 0);
	pm_frame_constant_set(f, "softening", c->value[SOFTENING]);
	if (pm_scene_plane(c, f, -4 * d, 4 * d, PM_OPEN, 128) || pm_scene_vortices(f, 2, d * d, &v))
		return -PM_DATA;
	for (int i = 0; i < 2; i++) {
		v.x[0][i] = i ? d / 2 : -d / 2;
		v.x[1][i] = 0;
		v.circulation[i] = g[i];
	}
	return 0;
}

static double exact(const struct pm_frame *f, const char *quantity, double t)
{
	const double g[2] = {pm_frame_parameter(f, "circulation1", 1), pm_frame_parameter(f, "circulation2", 2)}, sum = g[0] + g[1];
	const double d = pm_frame_parameter(f, "distance", 1);
	const struct { const char *name; double value; } known[] = {
		{"circulation", sum}, {"impulse_x", 0}, {"impulse_y", 0.5 * d * (g[0] - g[1])}, {"angular_impulse", -d * d * sum / 8},
		{"energy_field_pair", -g[0] * g[1] * log(d) / (2 * pm_pi)}, {"rate", sum / (2 * pm_pi * d * d)},
		{"speed", sum == 0 ? fabs(g[0]) / (2 * pm_pi * d) : NAN},
	};
	(void)t;
	for (size_t i = 0; i < sizeof known / sizeof *known; i++)
		if (!strcmp(quantity, known[i].name))
			return known[i].value;
	return NAN;
}

const struct pm_scene scene_vortex_pair = {
	.name = "vortex-pair",
	.sentence = "two point vortices, going straight or turning",
	.source = "Saffman 1992, section 7.2",
	.dims = 1u << 2,
	.dim = 2,
	.n = 2,
	.n_fixed = true,
	.parameters = rows,
	.make = make,
	.exact = exact,
};
