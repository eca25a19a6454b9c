/* One register of single numbers at a time: what base/simd.h (with PM_SIMD_NARROW) has for double ones. SPDX-License-Identifier: GPL-3.0-or-later */
#ifndef PM_BASE_SIMD_SINGLE_H
#define PM_BASE_SIMD_SINGLE_H

#include "base/simd.h"

enum { PM_SINGLE_WIDTH = 2 * PM_SIMD_PART };
typedef float pm_single __attribute__((vector_size(PM_SINGLE_WIDTH * sizeof(float))));
typedef int32_t pm_single_bits __attribute__((vector_size(PM_SINGLE_WIDTH * sizeof(float))));
typedef float pm_single_at __attribute__((vector_size(PM_SINGLE_WIDTH * sizeof(float)), may_alias)); /* aligned to its size */
typedef int32_t pm_single_bits_at __attribute__((vector_size(PM_SINGLE_WIDTH * sizeof(float)), may_alias));

PM_SIMD_INLINE pm_single pm_single_load(const float *p) { return *(const pm_single_at *)p; }
PM_SIMD_INLINE void pm_single_store(float *p, pm_single v) { *(pm_single_at *)p = v; }

/* Lanes of two vectors: which, where a vector has sixteen, eight and four. */
#if defined __AVX512F__
#define PM_SINGLE_PICK(a, b, sixteen, eight, four) __builtin_shufflevector(a, b, PM_SIMD_LANES sixteen)
#elif defined __AVX__
#define PM_SINGLE_PICK(a, b, sixteen, eight, four) __builtin_shufflevector(a, b, PM_SIMD_LANES eight)
#else
#define PM_SINGLE_PICK(a, b, sixteen, eight, four) __builtin_shufflevector(a, b, PM_SIMD_LANES four)
#endif

/* As those of base/simd.h: a lane on and a lane back, the values of even and of odd number and back, v where the mask is -1. */
PM_SIMD_INLINE pm_single pm_single_shift_up(pm_single before, pm_single here)
{
	return PM_SINGLE_PICK(before, here, (15, 16, 17, 18, 19, 20, 21, 22, 23, 24, 25, 26, 27, 28, 29, 30), (7, 8, 9, 10, 11, 12, 13, 14), (3, 4, 5, 6));
}
PM_SIMD_INLINE pm_single pm_single_shift_down(pm_single here, pm_single after)
{
	return PM_SINGLE_PICK(here, after, (1, 2, 3, 4, 5, 6, 7, 8, 9, 10, 11, 12, 13, 14, 15, 16), (1, 2, 3, 4, 5, 6, 7, 8), (1, 2, 3, 4));
}
PM_SIMD_INLINE pm_single pm_single_even(pm_single low, pm_single high)
{
	return PM_SINGLE_PICK(low, high, (0, 2, 4, 6, 8, 10, 12, 14, 16, 18, 20, 22, 24, 26, 28, 30), (0, 2, 4, 6, 8, 10, 12, 14), (0, 2, 4, 6));
}
PM_SIMD_INLINE pm_single pm_single_odd(pm_single low, pm_single high)
{
	return PM_SINGLE_PICK(low, high, (1, 3, 5, 7, 9, 11, 13, 15, 17, 19, 21, 23, 25, 27, 29, 31), (1, 3, 5, 7, 9, 11, 13, 15), (1, 3, 5, 7));
}
PM_SIMD_INLINE pm_single pm_single_zip_low(pm_single even, pm_single odd)
{
	return PM_SINGLE_PICK(even, odd, (0, 16, 1, 17, 2, 18, 3, 19, 4, 20, 5, 21, 6, 22, 7, 23), (0, 8, 1, 9, 2, 10, 3, 11), (0, 4, 1, 5));
}
PM_SIMD_INLINE pm_single pm_single_zip_high(pm_single even, pm_single odd)
{
	return PM_SINGLE_PICK(even, odd, (8, 24, 9, 25, 10, 26, 11, 27, 12, 28, 13, 29, 14, 30, 15, 31), (4, 12, 5, 13, 6, 14, 7, 15), (2, 6, 3, 7));
}
PM_SIMD_INLINE pm_single pm_single_masked(pm_single v, const int32_t *mask)
{
	return (pm_single)((pm_single_bits)v & *(const pm_single_bits_at *)mask);
}

#endif
