/* Successive over-relaxation of the red, then the black nodes: the steps of red-black times omega, by default Young's best factor (lib/relax/sor.c).
 * The radius is that of sor, omega - 1, also on periodic axes of even length, for which it is only approximate in the order of memory; all rows of a colour
 * go to the threads. Source: Young 1954. Cost: N per sweep, of order n sweeps. SPDX-License-Identifier: GPL-3.0-or-later */
#include "relax-parts/red-black-sweep.h"
#include "relax-parts/young-theory.h"

const struct pm_relax relax_red_black_sor = {
	.name = "red-black-sor",
	.sentence = "over-relaxation of every second node, then of the others, by default with Young's best factor",
	.source = "Young 1954",
	.factor = pm_young_best,
	.in_planes = true,
	.radius = pm_red_black_radius,
	.sweep = pm_red_black_sweep,
};
