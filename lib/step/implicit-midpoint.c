/* Implicit midpoint: Y = y0 + dt/2 f(Y), y1 = 2 Y - y0, found by iteration (push/implicit-run.c).
 * Source: Hairer, Lubich and Wanner 2006, section II.1.1. A-stable, symmetric, symplectic also where the force depends on v or the Hamiltonian does not split;
 * keeps every quadratic invariant. A decay much faster than 1/dt changes sign in every step instead of vanishing.
 * SPDX-License-Identifier: GPL-3.0-or-later */
#include "step/step.h"

static const struct pm_implicit implicit = {.start = 0, .part = 0.5, .beyond = 2, .at = 0.5};

const struct pm_step step_implicit_midpoint = {
	.name = "implicit-midpoint",
	.sentence = "implicit midpoint rule, second order, symplectic",
	.source = "Hairer, Lubich and Wanner 2006, II.1.1",
	.kind = PM_SCHEME,
	.passes = 4,
	.registers = PM_IMPLICIT_REGISTERS,
	.order = 2,
	.real_limit = INFINITY,
	.imaginary_limit = INFINITY,
	.implicit = &implicit,
};
