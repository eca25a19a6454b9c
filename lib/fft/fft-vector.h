/* Eight doubles as one value, and eight complex numbers as two; private to lib/fft. SPDX-License-Identifier: GPL-3.0-or-later */
#ifndef PM_FFT_VECTOR_H
#define PM_FFT_VECTOR_H

#include "fft/fft-block.h"

#pragma GCC diagnostic ignored "-Wpsabi" /* vectors never cross a call: everything that passes them is inlined */
#define ALWAYS static inline __attribute__((always_inline))

typedef double v8 __attribute__((vector_size(64)));
typedef double v8_anywhere __attribute__((vector_size(64), aligned(8)));
struct c8 {
	v8 re, im;
};

#endif
