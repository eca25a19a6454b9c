/* A stage of a transform whose radix is a prime above 13; private to lib/fft. SPDX-License-Identifier: GPL-3.0-or-later */
#ifndef PM_FFT_PRIME_DFT_H
#define PM_FFT_PRIME_DFT_H

#include "fft/fft-block.h"
#include "fft/fft-vector.h"

enum { PM_PRIME_MOST = 251 };

/* Stage s of f, of radix at most PM_PRIME_MOST, on blocks of `length` rows of x. */
void pm_prime_stage(const struct pm_fft *f, int s, size_t length, bool back, struct c8 *x);

#endif
