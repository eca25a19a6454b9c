/* Vortices, the vorticity form of Euler's equations: lap psi = -omega, u = curl psi, vel += u.
 * In the plane a particle carries the circulation Gamma = omega times its volume, and u = (d psi/dy, -d psi/dx): a point vortex turns its surroundings at
 * u_theta = Gamma/(2 pi r), counter-clockwise for Gamma > 0. In space it carries the vector alpha = omega times its volume, and
 * D omega/Dt = (omega . grad) u, which the word stretch adds. Viscosity nu lap omega is the word diffuse.
 * Source: Cottet and Koumoutsakos 2000, sections 2.1, 3.1 and 8.2.
 * Defaults: m6prime, which keeps circulation and both impulses where particles are remeshed, and takes a fraction of the enstrophy that m4prime does (a
 * ring, core of 1.8 cells, 32 steps: 5 % against 17); spectral inverse and differences of order 6, because the velocity is smoother than the vorticity.
 * In periodic boxes the solver removes the mean of omega and reports it.
 * SPDX-License-Identifier: GPL-3.0-or-later */
#include "law/law.h"

static double coefficient(const struct pm_frame *f)
{
	(void)f;
	return -1;
}

static const struct pm_law_constant constants[] = {
	{.name = "nu", .unit = "length^2/time", .text = "kinematic viscosity"},
	{0},
};

#define IN_BOTH \
	.name = "vortex", \
	.sentence = "vortices advect each other: lap psi = -omega, velocity curl psi", \
	.source = "Cottet and Koumoutsakos 2000", \
	.density = "omega", \
	.potential = "psi", \
	.field = "u", \
	.wave = 1, \
	.of_potential = PM_CURL, \
	.sign = 1, \
	.change = "vel", \
	.of = "x", \
	.coefficient = coefficient, \
	.kernel = "m6prime", \
	.symbol = "spectral", \
	.order = "6", \
	.constants = constants

static const struct pm_law in_space = {IN_BOTH, .dims = 1u << 3, .strength = "alpha", .vector = true, .mollifier = "gaussian"};

const struct pm_law law_vortex = {IN_BOTH, .dims = 1u << 2 | 1u << 3, .strength = "circulation", .mollifier = "krasny", .in_space = &in_space};
