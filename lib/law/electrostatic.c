/* Plasmas without magnetic fields of their own: lap phi = -rho/eps0, E = -grad phi, acc += (q/m) E; m2p copies a B given on the mesh to the field bfield of
 * the particles, which the magnetic schemes of push read. rho is a density of charge: in 1-D particles are sheets (charge per area), in 2-D lines.
 * Source: Birdsall and Langdon 1985, chapters 2 and 4; Hockney and Eastwood 1988, chapters 2 and 6.
 * The constant background is a charge density that p2m adds to rho (immobile ions). In a periodic box the solver removes the mean of rho, so a background
 * changes only the mean that it reports; with other faces it changes the field.
 * Defaults: cic, the 3-point Laplacian, 2-point differences (the scheme of the textbooks: omega = omega_p cos(k dx/2), case PIC-07).
 * SPDX-License-Identifier: GPL-3.0-or-later */
#include "law/law.h"

static double coefficient(const struct pm_frame *f)
{
	return -1 / pm_frame_constant(f, "eps0", 1);
}

static const struct pm_law_constant constants[] = {
	{.name = "eps0", .unit = "charge^2 time^2/(mass length^dim)", .otherwise = 1, .text = "permittivity of free space",
		.positive = true},
	{.name = "background", .unit = "charge/length^dim", .text = "constant density of charge, added to rho by p2m"},
	{0},
};

const struct pm_law law_electrostatic = {
	.name = "electrostatic",
	.sentence = "charges of one sign repel each other: lap phi = -rho/eps0, acceleration -(q/m) grad phi",
	.source = "Birdsall and Langdon 1985",
	.dims = 1u << 1 | 1u << 2 | 1u << 3,
	.strength = "charge",
	.density = "rho",
	.background = "background",
	.potential = "phi",
	.field = "E",
	.of_potential = PM_GRADIENT,
	.sign = -1,
	.change = "acc",
	.of = "v",
	.per = "mass",
	.magnetic = "B",
	.coefficient = coefficient,
	.kernel = "cic",
	.symbol = "fd2",
	.order = "2",
	.mollifier = "plummer",
	.constants = constants,
};
