/* A stage of a transform whose radix is a prime above 13; private to lib/fft. SPDX-License-Identifier: GPL-3.0-or-later */
#ifndef PM_FFT_PRIME_DFT_H
#define PM_FFT_PRIME_DFT_H

#include "fft/fft-block.h"
#include "fft/fft-vector.h"

enum { PM_PRIME_MOST = 251 };

/* Where a stage works: rows first to end-1, in pieces of length, of x and of y, whose rows are so many apart. */
struct pm_stage_rows {
	size_t first, end, length;
	const struct c8 *x;
	size_t x_step;
	struct c8 *y;
	size_t y_step;
};

/* Stage s of f, of radix at most PM_PRIME_MOST. */
void pm_prime_stage(const struct pm_fft *f, int s, bool back, struct pm_stage_rows at);

#endif
