/* Plummer softening: the bare kernel at sqrt(r^2 + delta^2); in 3-D phi = -1/(4 pi (r^2 + delta^2)^(1/2)), the field of a Plummer sphere.
 * Source: Plummer 1911; Aarseth 1963; Springel and Graeter, notes, section 3. In 2-D this is krasny.
 * The blob has an algebraic tail: force/bare - 1 = -3/2 (delta/r)^2 in 3-D, never exact. SPDX-License-Identifier: GPL-3.0-or-later */
#include "mollifier/bare.h"

static double force(double r2, double delta, int dim) { return pm_bare_force(r2 + delta * delta, dim); }

static double potential(double r2, double delta, int dim) { return pm_bare_potential(r2 + delta * delta, dim); }

static double slope(double r2, double delta) { return pm_bare_slope(r2 + delta * delta); }

const struct pm_mollifier mollifier_plummer = {
	.name = "plummer",
	.sentence = "the bare kernel at sqrt(r^2 + delta^2)",
	.source = "Plummer 1911",
	.dims = 1u << 1 | 1u << 2 | 1u << 3,
	.force = force,
	.potential = potential,
	.slope = slope,
	.order = 2,
	.square = true,
};
