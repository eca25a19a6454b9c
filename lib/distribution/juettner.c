/* Maxwell and Juettner: f ~ exp(-gamma/Theta) per momentum, Theta = T/(m c^2) = (vth/c)^2, at rest isotropic; then moving with the drift, as a boost of density
 * and not of number (the flipping method: of a particle at rest frame velocity w the sign of the component along the drift V is turned with the
 * probability -V.w/c^2 where that is positive).
 * Source: Juettner 1911, Ann. Phys. 339, 856; Zenitani 2015, Phys. Plasmas 22, 042116, section III. SPDX-License-Identifier: GPL-3.0-or-later */
#include "distribution/distribution.h"

static double theta(const struct pm_distribution_choice *c) { return pow(c->vth[0] / c->c, 2); }

static int check(const struct pm_distribution_choice *c)
{
	double v2 = 0;
	if (!(c->c > 0))
		return pm_fail(PM_USAGE, "a relativistic distribution needs the speed of light (smod --constant c=1)");
	if (!(c->vth[0] > 0))
		return pm_fail(PM_USAGE, "a relativistic distribution needs --vth above 0 (for cold beams --distribution maxwellian --vth 0)");
	for (int d = 0; d < 3; d++)
		v2 += c->drift[d] * c->drift[d];
	return v2 < c->c * c->c ? 0 : pm_fail(PM_USAGE, "--drift is not below the speed of light, %g", c->c);
}

/* r = p/(m c); gamma - 1 without cancellation. */
static double radial(const struct pm_distribution_choice *c, double r) { return r * r * exp(-r * r / (1 + sqrt(1 + r * r)) / theta(c)); }

static void range(const struct pm_distribution_choice *c, double range[2])
{
	const double gamma = 1 + 45 * theta(c); /* beyond is below 1e-16 of all */
	range[0] = 0, range[1] = sqrt((gamma - 1) * (gamma + 1));
}

static void draw(const struct pm_distribution_choice *c, double r, const double *u, double *v)
{
	const double cosine = 2 * u[0] - 1, sine = sqrt(1 - cosine * cosine), phi = 2 * pm_pi * u[1], e = sqrt(1 + r * r);
	double w[3] = {r * sine * cos(phi), r * sine * sin(phi), r * cosine}, along = 0, b2 = 0, beta[3]; /* p/(m c) */
	for (int d = 0; d < 3; d++)
		beta[d] = c->drift[d] / c->c, b2 += beta[d] * beta[d], along += beta[d] * w[d];
	if (b2 > 0) {
		const bool turned = -along / e > u[2];
		for (int d = 0; d < 3 && turned; d++)
			w[d] -= 2 * along * beta[d] / b2;
		along = turned ? -along : along;
		const double g = 1 / sqrt(1 - b2);
		for (int d = 0; d < 3; d++)
			w[d] += beta[d] * (along * (g - 1) / b2 + g * e);
	}
	const double energy = sqrt(1 + w[0] * w[0] + w[1] * w[1] + w[2] * w[2]);
	for (int d = 0; d < 3; d++)
		v[d] = c->c * w[d] / energy;
}

const struct pm_distribution distribution_juettner = {
	.name = "juettner",
	.sentence = "relativistic, of the temperature m vth^2, drifting",
	.source = "Juettner 1911; Zenitani 2015",
	.least = 3,
	.isotropic = true,
	.numbers = {0, 0, 0, 3},
	.check = check,
	.radial = radial,
	.range = range,
	.draw = draw,
};
