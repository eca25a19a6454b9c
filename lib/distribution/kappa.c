/* Kappa: f ~ (1 + v^2/(kappa theta^2))^-(kappa + 1) of three components, with tails that fall as a power; in one or two components its marginal. vth is the
 * standard deviation of a component, vth^2 = kappa theta^2/(2 kappa - 3); it becomes a Maxwellian as kappa grows.
 * v = vth z sqrt(nu - 2)/r with z normal, r of the chi distribution of nu = 2 kappa - 1 degrees of freedom (Student's t in several dimensions).
 * Source: Vasyliunas 1968, J. Geophys. Res. 73, 2839; Abdul and Mace 2015, Phys. Plasmas 22, 102107. SPDX-License-Identifier: GPL-3.0-or-later */
#include "distribution/distribution.h"
#include "scene-parts/scene-loading.h"

static int check(const struct pm_distribution_choice *c)
{
	return c->kappa > 1.5 ? 0 : pm_fail(PM_USAGE, "a kappa distribution has a temperature only for --kappa above 1.5");
}

static double freedom(const struct pm_distribution_choice *c) { return 2 * c->kappa - 1; }

/* Relative to the largest value, which stands at r^2 = nu - 1, so that large kappa does not overflow. */
static double radial(const struct pm_distribution_choice *c, double r)
{
	const double nu = freedom(c), most = sqrt(nu - 1);
	return r > 0 ? exp((nu - 1) * log(r / most) - 0.5 * (r * r - most * most)) : 0;
}

static void range(const struct pm_distribution_choice *c, double range[2])
{
	const double most = sqrt(freedom(c) - 1);
	range[0] = fmax(0, most - 9), range[1] = most + 9; /* the width is 1/sqrt 2 or less: beyond is below 1e-16 */
}

static void draw(const struct pm_distribution_choice *c, double r, const double *u, double *v)
{
	for (int d = 0; d < c->velocities; d++)
		v[d] = c->drift[d] + c->vth[d] * pm_scene_normal_of(u[d]) * sqrt(freedom(c) - 2) / r;
}

const struct pm_distribution distribution_kappa = {
	.name = "kappa",
	.sentence = "tails that fall as v^-(2 kappa + 2), --vth wide",
	.source = "Vasyliunas 1968",
	.least = 1,
	.numbers = {0, 1, 2, 3},
	.check = check,
	.radial = radial,
	.range = range,
	.draw = draw,
};
