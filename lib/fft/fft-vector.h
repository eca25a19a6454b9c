/* Complex numbers of the lanes of a block as vectors (base/simd.h); private to lib/fft. SPDX-License-Identifier: GPL-3.0-or-later */
#ifndef PM_FFT_VECTOR_H
#define PM_FFT_VECTOR_H

#include <stdbool.h>

#include "base/simd.h"

/* A row of a block: the eight complex numbers of its lanes, of which those of one part are meant, the part that the pointer begins at. */
struct c8 {
	pm_simd_part_at re;
	double other_re[PM_SIMD_WIDTH - PM_SIMD_PART];
	pm_simd_part_at im;
	double other_im[PM_SIMD_WIDTH - PM_SIMD_PART];
};
enum { PM_FFT_PARTS = PM_SIMD_WIDTH / PM_SIMD_PART };
PM_SIMD_INLINE struct c8 *part_of(const double *block, int part) { return (struct c8 *)(block + part * PM_SIMD_PART); }

/* Those numbers in registers. */
struct lanes {
	pm_simd_part re, im;
};

PM_SIMD_INLINE struct lanes take(const struct c8 *x) { return (struct lanes){x->re, x->im}; }
PM_SIMD_INLINE void put(struct c8 *x, struct lanes a) { x->re = a.re, x->im = a.im; }

PM_SIMD_INLINE struct lanes plus(struct lanes a, struct lanes b) { return (struct lanes){a.re + b.re, a.im + b.im}; }
PM_SIMD_INLINE struct lanes minus(struct lanes a, struct lanes b) { return (struct lanes){a.re - b.re, a.im - b.im}; }

/* The larger of most and |v|, lane by lane; most where v is NaN. */
PM_SIMD_INLINE pm_simd_part larger(pm_simd_part most, pm_simd_part v)
{
	const __typeof__(v > most) size = (__typeof__(v > most))v & INT64_MAX, more = (pm_simd_part)size > most;
	return (pm_simd_part)((size & more) | ((__typeof__(size))most & ~more));
}

/* times exp(-i x) forward, exp(+i x) back; w = cos x, sin x */
PM_SIMD_INLINE struct lanes twisted(struct lanes a, const double *w, bool back)
{
	return back ? (struct lanes){a.re * w[0] - a.im * w[1], a.im * w[0] + a.re * w[1]} :
		(struct lanes){a.re * w[0] + a.im * w[1], a.im * w[0] - a.re * w[1]};
}

#endif
