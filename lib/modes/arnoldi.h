/* Arnoldi's iteration: eigenvalues of largest magnitude of a linear map that is known by its action alone. SPDX-License-Identifier: GPL-3.0-or-later */
#ifndef PM_MODES_ARNOLDI_H
#define PM_MODES_ARNOLDI_H

#include "base/base.h"

/* out = A in, n numbers; 0 or failure. */
typedef int (*pm_linear_map)(void *with, const double *in, double *out);

struct pm_ritz {
	double re, im;   /* the eigenvalue */
	double residual; /* |A y - lambda y| of the unit vector y */
};

struct pm_arnoldi {
	size_t n;
	int vectors, values;  /* of the basis; eigenvalues with im >= 0, by falling magnitude */
	double *basis;        /* vectors + 1 columns of n numbers, orthonormal */
	struct pm_ritz *ritz; /* values of them */
	double *coefficient;  /* 2*vectors numbers for each value: real and imaginary part of its vector in the basis */
	bool whole;           /* the basis spans all that the start reaches: the residuals are 0 up to the errors of the map */
};

/* At most `most` vectors, fewer where the leading one has a residual below tolerance times its magnitude, twice in succession. The start is random, from
 * the seed. 0 or failure; free in any case. */
int pm_arnoldi_run(struct pm_arnoldi *a, size_t n, int most, double tolerance, uint64_t seed, pm_linear_map map, void *with);
/* The vector of a value: n numbers each; of unit length together. */
void pm_arnoldi_vector(const struct pm_arnoldi *a, int value, double *re, double *im);
void pm_arnoldi_free(struct pm_arnoldi *a);

#endif
