/* Newtonian gravity: lap phi = 4 pi G rho, g = -grad phi, acc += g; in 3-D phi = -G m / r, in 2-D (infinite lines of mass per length)
 * phi = 2 G m ln r, in 1-D (infinite sheets of mass per area) phi = 2 pi G m |x|.
 * Source: Hockney and Eastwood 1988, section 1-5 and chapter 6; notes in docs/methods/gravity.md.
 * Defaults: cic with differences of order 4, because the spectral gradient of a density made with cic oscillates along the axes (case PM-02).
 * Periodic boxes lose the mean of rho (the solver reports it). SPDX-License-Identifier: GPL-3.0-or-later */
#include "law/law.h"

static double coefficient(const struct pm_frame *f)
{
	return 4 * pm_pi * pm_frame_constant(f, "G", 1);
}

static const struct pm_law_constant constants[] = {
	{.name = "G", .unit = "length^dim/(mass time^2)", .otherwise = 1, .text = "constant of gravity"},
	{0},
};

const struct pm_law law_gravity = {
	.name = "gravity",
	.sentence = "masses attract each other: lap phi = 4 pi G rho, acceleration -grad phi",
	.source = "Hockney and Eastwood 1988",
	.dims = 1u << 1 | 1u << 2 | 1u << 3,
	.strength = "mass",
	.density = "rho",
	.potential = "phi",
	.field = "g",
	.of_potential = PM_GRADIENT,
	.sign = -1,
	.change = "acc",
	.of = "v",
	.coefficient = coefficient,
	.kernel = "cic",
	.symbol = "spectral",
	.order = "4",
	.mollifier = "plummer",
	.constants = constants,
};
