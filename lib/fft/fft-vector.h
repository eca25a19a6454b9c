/* Eight complex numbers as two vectors (base/simd.h); private to lib/fft. SPDX-License-Identifier: GPL-3.0-or-later */
#ifndef PM_FFT_VECTOR_H
#define PM_FFT_VECTOR_H

#include "base/simd.h"

struct c8 {
	pm_simd re, im;
};

PM_SIMD_INLINE struct c8 plus(struct c8 a, struct c8 b) { return (struct c8){a.re + b.re, a.im + b.im}; }
PM_SIMD_INLINE struct c8 minus(struct c8 a, struct c8 b) { return (struct c8){a.re - b.re, a.im - b.im}; }

#endif
