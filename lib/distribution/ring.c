/* A ring: the speed w across z has the density w exp(-(w - ring)^2/(2 vth^2)), its direction in the x-y plane is uniform; v_z is normal. vth 0: all have the
 * speed `ring`. With a magnetic field along z it is steady, and drives Bernstein waves where it has a hole.
 * Source: Birdsall and Langdon 1985, section 5-14; Umeda et al. 2007, J. Geophys. Res. 112, A04212. SPDX-License-Identifier: GPL-3.0-or-later */
#include "distribution/distribution.h"
#include "scene-parts/scene-loading.h"

static int check(const struct pm_distribution_choice *c)
{
	if (c->vth[0] != c->vth[1])
		return pm_fail(PM_USAGE, "a ring has one --vth across z (the first two numbers equal)");
	return c->ring >= 0 ? 0 : pm_fail(PM_USAGE, "a ring needs its speed (--ring)");
}

static double radial(const struct pm_distribution_choice *c, double r)
{
	const double z = c->vth[0] > 0 ? (r - c->ring) / c->vth[0] : r - c->ring;
	return (c->vth[0] > 0 ? r : 1) * exp(-0.5 * z * z);
}

/* A cold ring: as narrow as rounding lets it be. */
static void range(const struct pm_distribution_choice *c, double range[2])
{
	range[0] = fmax(0, c->ring - 9 * c->vth[0]);
	range[1] = c->ring + 9 * c->vth[0];
}

static void draw(const struct pm_distribution_choice *c, double r, const double *u, double *v)
{
	v[0] = c->drift[0] + r * cos(2 * pm_pi * u[0]);
	v[1] = c->drift[1] + r * sin(2 * pm_pi * u[0]);
	if (c->velocities > 2)
		v[2] = c->drift[2] + (c->vth[2] > 0 ? c->vth[2] * pm_scene_normal_of(u[1]) : 0);
}

const struct pm_distribution distribution_ring = {
	.name = "ring",
	.sentence = "the speed --ring, --vth wide, in all directions of the x-y plane",
	.source = "Umeda et al. 2007",
	.least = 2,
	.numbers = {0, 0, 1, 2},
	.check = check,
	.radial = radial,
	.range = range,
	.draw = draw,
};
