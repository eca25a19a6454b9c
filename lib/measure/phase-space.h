/* Particles counted on a mesh whose axes are expressions: the distribution function, what the word phase makes. SPDX-License-Identifier: GPL-3.0-or-later */
#ifndef PM_MEASURE_PHASE_SPACE_H
#define PM_MEASURE_PHASE_SPACE_H

#include "expression/expression.h"
#include "kernel/kernel.h"

struct pm_phase_choice {
	int axes;                   /* 1..3 */
	const char *axis[3];        /* expressions over the particles */
	const char *weight;         /* expression; NULL: mass, or 1 of sets without */
	const char *set;            /* NULL: all that have particles */
	const struct pm_kernel *kernel;
	size_t cells[3];
	const double *box;          /* lo of all axes, then hi; NULL: where particles are, rounded outwards */
};

struct pm_phase_sets { /* the expressions of every set */
	int n;
	struct pm_phase_set { struct pm_expression e; } set[16];
};

/* Header: the expressions are understood; axes first, then the weight. 0 or failure. */
int pm_phase_declare(const struct pm_phase_choice *c, struct pm_frame *f, struct pm_phase_sets *sets);
/* Data: the frame becomes one of the mesh `phase` with the field f alone, in as many dimensions as axes; *outside particles are beyond the box. */
int pm_phase_frame(const struct pm_phase_choice *c, const struct pm_phase_sets *sets, struct pm_frame *f, uint64_t *outside);

#endif
