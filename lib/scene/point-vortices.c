/* Point vortices at random in a disc of radius 1 in open space, of either sign with equal chance (--mixed 0: all of one sign); each has the
 * circulation --circulation over n in magnitude. Invariants: circulation, impulse, angular impulse, and the energy of the pairs.
 * Source: Aref 1983, Annu. Rev. Fluid Mech. 15, 345. Exact: none, because the sums depend on the seed. Cost N.
 * SPDX-License-Identifier: GPL-3.0-or-later */
#include <string.h>

#include "scene-parts/scene-vortices.h"

enum { GAMMA, MIXED, SOFTENING };

static const struct pm_scene_parameter rows[] = {
	{.name = "circulation", .unit = "length^2/time", .otherwise = 1, .low = -1e300, .high = 1e300, .text = "circulation of all, in magnitude"},
	{.name = "mixed", .otherwise = 1, .high = 1, .text = "1: of either sign by chance; 0: all of one sign"},
	{.name = "softening", .unit = "length", .otherwise = 0.02, .high = 1e6, .text = "softening length of direct sums"},
	{0},
};

static int make(const struct pm_scene_choice *c, struct pm_frame *f)
{
	struct pm_scene_vortices v;
	f->dt = 0.01 / (c->value[GAMMA] != 0 ? fabs(c->value[GAMMA]) : 1);
	pm_frame_constant_set(f, "nu", 0);
	pm_frame_constant_set(f, "softening", c->value[SOFTENING]);
	if (pm_scene_plane(c, f, -2, 2, PM_OPEN, 128) || pm_scene_vortices(f, c->n, c->n ? pm_pi / (double)c->n : 0, &v))
		return -PM_DATA;
#pragma omp parallel for schedule(static) if (c->n > 16384)
	for (uint64_t i = 0; i < c->n; i++) {
		double u[2], w[2];
		pm_random(c->seed, i, 0, u);
		pm_random(c->seed, i, 1, w);
		v.x[0][i] = sqrt(u[0]) * cos(2 * pm_pi * u[1]);
		v.x[1][i] = sqrt(u[0]) * sin(2 * pm_pi * u[1]);
		v.circulation[i] = c->value[GAMMA] / (double)c->n * (c->value[MIXED] > 0 && w[0] < 0.5 ? -1 : 1);
	}
	return 0;
}

static double exact(const struct pm_frame *f, const char *quantity, double t)
{
	(void)t;
	return !strcmp(quantity, "circulation") && pm_frame_parameter(f, "mixed", 1) == 0 ? pm_frame_parameter(f, "circulation", 1) : NAN;
}

const struct pm_scene scene_point_vortices = {
	.name = "point-vortices",
	.sentence = "point vortices at random in a disc",
	.source = "Aref 1983",
	.dims = 1u << 2,
	.dim = 2,
	.n = 1000,
	.random = true,
	.parameters = rows,
	.make = make,
	.exact = exact,
};
