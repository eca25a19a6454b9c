/* Particles as a function: u_eps(x) = sum of strength_p zeta_eps(x - x_p), its gradient and its Laplacian, at any points (docs/methods/sample.md).
 * SPDX-License-Identifier: GPL-3.0-or-later */
#ifndef PM_NEAR_SAMPLE_H
#define PM_NEAR_SAMPLE_H

#include "cell/cell-list.h"

enum pm_sample_kind { PM_SAMPLE_GAUSSIAN, PM_SAMPLE_ALGEBRAIC };
enum pm_sample_operator { PM_SAMPLE_VALUE, PM_SAMPLE_GRAD, PM_SAMPLE_LAP, PM_SAMPLE_FIRST, PM_SAMPLE_SECOND };
enum { PM_SAMPLE_SUMS = 10 };
extern const char *const pm_sample_kind_names[], *const pm_sample_operator_names[]; /* NULL ends; of the first three */

struct pm_sample {
	int dim, order;  /* 1, 2, 3; of a Gaussian 2 or 4, of the algebraic one 4 */
	enum pm_sample_kind kind;
	enum pm_sample_operator operator; /* first: the value and its moments by z = (x - x_p)/eps; second: and by z z */
	bool even;             /* images at walls count as they are, instead of negative: of volumes */
	double eps, reach; /* [length] */
};

double pm_sample_cutoff(enum pm_sample_kind kind, int order); /* the default, in eps */
double pm_sample_overlap(enum pm_sample_kind kind); /* the default eps over the spacing: a lattice sums to 1 to round-off (Gaussian), 2e-5 */
/* zeta, and its first two derivatives by s = (r/eps)^2: w[0..2]. */
void pm_sample_mollifier(const struct pm_sample *o, double s, double w[3]);
int pm_sample_components(const struct pm_sample *o); /* of out */
/* The places of the list: sources have a strength, others 0; at: the particles of the list (numbers before it was ordered) first..first+targets-1.
 * out[c][k], one component, or dim of a gradient, 1 + dim of first moments, and dim (dim + 1)/2 more of second
 * (sample-correction.h). The same bytes for any number of threads. 0 or failure. */
int pm_sample_sum(const struct pm_sample *o, const struct pm_cell_list *l, const double *strength, size_t first, size_t targets, double *const out[]);

#endif
