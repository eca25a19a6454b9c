/* Points drawn from densities that are given by a table: uniform numbers through the inverse of the cumulative distribution.
 * SPDX-License-Identifier: GPL-3.0-or-later */
#ifndef PM_LOAD_INVERSE_H
#define PM_LOAD_INVERSE_H

#include "base/base.h"

/* A density that is linear between the nodes of a table; one to four columns of it in a sum, each with its weight. n intervals. */
struct pm_density_columns {
	int columns;
	const double *value[4], *sum[4]; /* at the n + 1 nodes: density; its integral from node 0 in units of the spacing */
	double weight[4];
};
/* The place in units of the spacing, 0..n, below which is the share u of the density. */
double pm_density_invert(const struct pm_density_columns *d, size_t n, double u);
/* sum[i] from value[i], i = 0..n: trapezoids, exact for what is linear between nodes. */
void pm_density_integrate(const double *value, size_t n, double *sum);

struct pm_inverse { /* of a function of one variable */
	double from, to;
	size_t n;
	double *value, *sum;
};
/* Tabulates f(context, x) at n + 1 nodes. 0, or failure: not finite, negative or zero everywhere (`what` names it). */
int pm_inverse_init(struct pm_inverse *t, size_t n, double from, double to, double (*f)(const void *context, double x), const void *context,
	const char *what);
double pm_inverse_at(const struct pm_inverse *t, double u);
void pm_inverse_free(struct pm_inverse *t);

#endif
