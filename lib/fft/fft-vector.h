/* Eight complex numbers as two vectors (base/simd.h); private to lib/fft. SPDX-License-Identifier: GPL-3.0-or-later */
#ifndef PM_FFT_VECTOR_H
#define PM_FFT_VECTOR_H

#include <stdbool.h>

#include "base/simd.h"

struct c8 {
	pm_simd re, im;
};

PM_SIMD_INLINE struct c8 plus(struct c8 a, struct c8 b) { return (struct c8){a.re + b.re, a.im + b.im}; }
PM_SIMD_INLINE struct c8 minus(struct c8 a, struct c8 b) { return (struct c8){a.re - b.re, a.im - b.im}; }

/* times exp(-i x) forward, exp(+i x) back; w = cos x, sin x */
PM_SIMD_INLINE struct c8 twisted(struct c8 a, const double *w, bool back)
{
	return back ? (struct c8){a.re * w[0] - a.im * w[1], a.im * w[0] + a.re * w[1]} :
		(struct c8){a.re * w[0] + a.im * w[1], a.im * w[0] - a.re * w[1]};
}

#endif
