/* A convolution along one line of real numbers, which has no neighbours to fill the lanes of a block (fft/fft-block.h).
 * SPDX-License-Identifier: GPL-3.0-or-later */
#ifndef PM_FFT_LONG_LINE_H
#define PM_FFT_LONG_LINE_H

#include "fft/fft-block.h"

enum { PM_LONG_LEAST = 4 * PM_FFT_LINES }; /* shorter lines gain nothing */

struct pm_long_line {
	size_t n;                 /* nodes, a multiple of PM_FFT_LINES */
	const struct pm_fft *fft; /* of n/PM_FFT_LINES; of the planner */
	double *twiddle, *factors;
};

static inline bool pm_long_line_suits(size_t n) { return n % PM_FFT_LINES == 0 && n >= PM_LONG_LEAST; }

/* u: of frequencies 0 ... n/2, what multiplies them. 0 or failure; free in any case, before the planner. */
int pm_long_line_init(struct pm_fft_plans *planner, size_t n, const double *u, struct pm_long_line *line);
void pm_long_line_free(struct pm_long_line *line);

/* The spectrum of x[n] times factor and u, and back, not normalised (both together multiply by n); x 64-byte aligned. Returns the sum of x. */
double pm_long_line_times(const struct pm_long_line *line, double factor, double *x);

#endif
