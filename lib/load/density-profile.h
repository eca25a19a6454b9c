/* A density over the box of a frame, and points drawn from it. SPDX-License-Identifier: GPL-3.0-or-later */
#ifndef PM_LOAD_DENSITY_PROFILE_H
#define PM_LOAD_DENSITY_PROFILE_H

#include "stream/frame.h"

struct pm_density_profile {
	int dim;
	double lo[3], hi[3];
	size_t n[3];               /* intervals of the table */
	double total;              /* integral over the box */
	double *value[3], *sum[3]; /* with the axes behind integrated: value[0][i], value[1][i, j], value[2][i, j, k]; sums along the last of them */
};
/* An expression in x, y, z (and names of the frame's constants). 0 or failure: not finite, negative, or 0 everywhere. */
int pm_density_profile_init(struct pm_density_profile *p, const struct pm_frame *f, const char *text);
/* x for uniform numbers u of each axis. */
void pm_density_profile_at(const struct pm_density_profile *p, const double *u, double *x);
/* The density at a point, as the table has it. */
double pm_density_profile_value(const struct pm_density_profile *p, const double *x);
void pm_density_profile_free(struct pm_density_profile *p);

/* Values of an expression whose names are given numbers: variables first, then the frame's. */
struct pm_density_names {
	const struct pm_frame *f;
	const char *const *variable; /* NULL ends */
	double number[64];
	int n;
	char name[64][PM_NAME];
};
/* For pm_expression_compile_numbers: its slot function and context. */
int pm_density_name(void *names, const char *name);

#endif
