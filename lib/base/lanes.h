/* Eight doubles at a time, for loops over pairs: the vector extension of gcc and clang, with the approximate reciprocals of AVX-512 where there
 * are any (14 bits, to be corrected by the caller) and exact ones elsewhere. The only place where the platform shows.
 * SPDX-License-Identifier: GPL-3.0-or-later */
#ifndef PM_LANES_H
#define PM_LANES_H

#include <math.h>
#include <stdint.h>
#include <string.h>

#ifdef __AVX512F__
#include <immintrin.h>
#else
#pragma GCC diagnostic ignored "-Wpsabi" /* how vectors are passed to functions: all of ours are inlined */
#endif

enum { PM_VECTOR_LANES = 8 };
typedef double pm_lanes __attribute__((vector_size(64)));
typedef int64_t pm_lanes_bits __attribute__((vector_size(64)));

/* Before a short loop over vectors, which must vanish if they are to stay in registers. */
#ifdef __clang__
#define PM_LANES_UNROLL _Pragma("unroll")
#else
#define PM_LANES_UNROLL _Pragma("GCC unroll 8")
#endif

#define PM_LANES_INLINE static inline __attribute__((always_inline, unused))

PM_LANES_INLINE pm_lanes pm_lanes_all(double x) { return (pm_lanes){x, x, x, x, x, x, x, x}; }

PM_LANES_INLINE pm_lanes pm_lanes_load(const double *p) /* 64-byte aligned */
{
	pm_lanes v;
	memcpy(&v, __builtin_assume_aligned(p, 64), sizeof v);
	return v;
}

PM_LANES_INLINE void pm_lanes_store(double *p, pm_lanes v) { memcpy(__builtin_assume_aligned(p, 64), &v, sizeof v); }

/* Sum of the lanes, in a fixed order. */
PM_LANES_INLINE double pm_lanes_sum(pm_lanes v) { return ((v[0] + v[4]) + (v[2] + v[6])) + ((v[1] + v[5]) + (v[3] + v[7])); }

/* True if a < b in any lane. */
PM_LANES_INLINE int pm_lanes_any_below(pm_lanes a, pm_lanes b)
{
#ifdef __AVX512F__
	return _mm512_cmp_pd_mask((__m512d)a, (__m512d)b, _CMP_LT_OQ) != 0;
#else
	pm_lanes_bits m = a < b;
	return ((m[0] | m[1]) | (m[2] | m[3]) | (m[4] | m[5]) | (m[6] | m[7])) != 0;
#endif
}

/* v where a >= b, else 0. */
PM_LANES_INLINE pm_lanes pm_lanes_where_not_below(pm_lanes a, pm_lanes b, pm_lanes v)
{
#ifdef __AVX512F__
	return (pm_lanes)_mm512_maskz_mov_pd(_mm512_cmp_pd_mask((__m512d)a, (__m512d)b, _CMP_GE_OQ), (__m512d)v);
#else
	return (pm_lanes)((pm_lanes_bits)(a >= b) & (pm_lanes_bits)v);
#endif
}

/* a*b + c and c - a*b, rounded once where the machine can. */
PM_LANES_INLINE pm_lanes pm_lanes_fma(pm_lanes a, pm_lanes b, pm_lanes c)
{
#ifdef __AVX512F__
	return (pm_lanes)_mm512_fmadd_pd((__m512d)a, (__m512d)b, (__m512d)c);
#else
	return a * b + c;
#endif
}

PM_LANES_INLINE pm_lanes pm_lanes_fnma(pm_lanes a, pm_lanes b, pm_lanes c)
{
#ifdef __AVX512F__
	return (pm_lanes)_mm512_fnmadd_pd((__m512d)a, (__m512d)b, (__m512d)c);
#else
	return c - a * b;
#endif
}

/* 1/sqrt(x) and 1/x to a relative error below 2^-14. */
PM_LANES_INLINE pm_lanes pm_lanes_rsqrt_start(pm_lanes x)
{
#ifdef __AVX512F__
	return (pm_lanes)_mm512_rsqrt14_pd((__m512d)x);
#else
	pm_lanes y;
	for (int l = 0; l < PM_VECTOR_LANES; l++)
		y[l] = 1 / sqrt(x[l]);
	return y;
#endif
}

PM_LANES_INLINE pm_lanes pm_lanes_reciprocal_start(pm_lanes x)
{
#ifdef __AVX512F__
	return (pm_lanes)_mm512_rcp14_pd((__m512d)x);
#else
	return 1 / x;
#endif
}

#endif
