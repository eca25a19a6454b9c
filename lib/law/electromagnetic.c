/* Plasmas with the fields they make: B' = -curl E, E' = c^2 curl B - J/eps0, (gamma v)' = (q/m) (E + v x B). E and B are states of the mesh with three
 * components in every dimension, E half a cell up its own axis, B half a cell up the two others (Yee 1966); p2m --current makes J, maxwell advances E and B,
 * m2p takes both to the particles (acc, bfield). mu0 = 1/(eps0 c^2). rho is wanted by maxwell --gauss and by diag alone; background is added to it.
 * Source: Birdsall and Langdon 1985, chapter 15; Yee 1966. In 1-D particles are sheets (charge per area), in 2-D lines.
 * SPDX-License-Identifier: GPL-3.0-or-later */
#include "law/law.h"

static const struct pm_law_constant constants[] = {
	{.name = "c", .unit = "length/time", .otherwise = 1, .text = "speed of light", .positive = true},
	{.name = "eps0", .unit = "charge^2 time^2/(mass length^dim)", .otherwise = 1, .text = "permittivity of free space",
		.positive = true},
	{.name = "background", .unit = "charge/length^dim", .text = "constant density of charge, added to rho by p2m"},
	{0},
};

const struct pm_law law_electromagnetic = {
	.name = "electromagnetic",
	.sentence = "charges and the fields they make: Maxwell's equations, (gamma v)' = (q/m) (E + v x B)",
	.source = "Birdsall and Langdon 1985",
	.dims = 1u << 1 | 1u << 2 | 1u << 3,
	.strength = "charge",
	.density = "rho",
	.background = "background",
	.field = "E",
	.wave = 1,
	.sign = 1,
	.change = "acc",
	.of = "v",
	.per = "mass",
	.magnetic = "B",
	.evolves = true,
	.relativistic = true,
	.kernel = "cic",
	.constants = constants,
};
