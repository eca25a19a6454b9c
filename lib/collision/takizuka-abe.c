/* Takizuka and Abe: tan(theta/2) is normal with variance s/2. Right while s is small; where the variance exceeds 1 the direction is isotropic.
 * Source: Takizuka and Abe 1977, Journal of Computational Physics 25, 205. Cost: a normal number. SPDX-License-Identifier: GPL-3.0-or-later */
#include "collision/collision.h"

static double turned(double s, uint64_t key, uint64_t id, uint64_t counter)
{
	double z[2], u[2];
	if (s > 2) {
		pm_random(key, id, counter, u);
		return 2 * u[0];
	}
	pm_random_normal(key, id, counter, z);
	const double square = 0.5 * s * z[0] * z[0];
	return 2 * square / (1 + square);
}

const struct pm_collision collision_takizuka_abe = {
	.name = "takizuka-abe",
	.sentence = "tangent of half the angle normal; small angles a step",
	.source = "Takizuka and Abe 1977",
	.turned = turned,
};
