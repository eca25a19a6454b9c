/* A drifting Maxwellian: components independent, normal with mean drift and standard deviation vth, each its own (bi-Maxwellian); vth 0: a cold beam.
 * Source: Maxwell 1860; quantiles of the normal distribution. Cost: one quantile a component. SPDX-License-Identifier: GPL-3.0-or-later */
#include "distribution/distribution.h"
#include "scene-parts/scene-loading.h"

static void draw(const struct pm_distribution_choice *c, double r, const double *u, double *v)
{
	(void)r;
	for (int d = 0; d < c->velocities; d++)
		v[d] = c->drift[d] + (c->vth[d] > 0 ? c->vth[d] * pm_scene_normal_of(u[d]) : 0);
}

const struct pm_distribution distribution_maxwellian = {
	.name = "maxwellian",
	.sentence = "normal in every component, about --drift, --vth wide",
	.source = "Maxwell 1860",
	.least = 1,
	.numbers = {0, 1, 2, 3},
	.draw = draw,
};
