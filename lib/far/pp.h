/* Direct summation over all pairs (docs/methods/pp.md). SPDX-License-Identifier: GPL-3.0-or-later */
#ifndef PM_FAR_PP_H
#define PM_FAR_PP_H

#include "mollifier/mollifier.h"

PM_C_BEGIN

struct pm_pp {
	int dim;      /* 1, 2, 3 */
	double delta; /* [length] of the mollifier, >= 0 */
	const struct pm_mollifier *mollifier;
	bool half;    /* each pair once, by symmetry; else each target over all sources */
	size_t sets;  /* the particles are those of so many sets, one behind the other, the targets whole sets in front; 0: of one set, all targets or not */
	const size_t *count; /* [sets] particles of each */
	const size_t *own;   /* [2 sets] of each the first target that is wanted and the one behind the last, multiples of 4096 (of the full loop: of 256) or
	                      * the end; NULL: all */
};

/* For each of the first `targets` of n particles: gradient[c][i] = sum over j != i of q[j] d(phi1)/dx_c (x_i - x_j), and
 * potential[i] = the same sum of phi1, where lap phi1 = delta function, mollified. potential may be NULL. Pairs closer than 1e-100 and not mollified
 * exert no force; *coincident of them are counted, for the targets that are wanted, so that counts of several calls add up. The same bytes for any number of
 * threads. 0 or failure. */
int pm_pp_sum(const struct pm_pp *p, size_t targets, size_t n, const double *const *x, const double *q, double *const *gradient, double *potential,
	uint64_t *coincident);

/* The same by the plain double loop, each pair through the mollifier's functions: what the other two are tested against. */
int pm_pp_plain(const struct pm_pp *p, size_t targets, size_t n, const double *const *x, const double *q, double *const *gradient,
	double *potential, uint64_t *coincident);

PM_C_END

#endif
