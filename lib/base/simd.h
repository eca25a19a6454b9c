/* Eight doubles at a time: the vector extension of gcc and clang, with the approximate reciprocals of AVX-512 where there are any (14 bits, to be corrected
 * by the caller) and exact ones elsewhere. The only file that depends on the processor; no other file declares a vector type.
 * SPDX-License-Identifier: GPL-3.0-or-later */
#ifndef PM_BASE_SIMD_H
#define PM_BASE_SIMD_H

#include <math.h>
#include <stdbool.h>
#include <stdint.h>
#include <string.h>

#if defined __AVX__ || defined __SSE2__
#include <immintrin.h>
#endif
#ifndef __AVX512F__
#pragma GCC diagnostic ignored "-Wpsabi" /* how vectors are passed to functions: all of ours are inlined */
#endif

/* What one register holds: 8, 4 or 2 doubles. A compiler keeps wider vectors in memory, at six times the cost, so loops over lanes that do not know of each
 * other go part by part: the same bytes. */
#if defined __AVX512F__
enum { PM_SIMD_PART = 8 };
#elif defined __AVX__
enum { PM_SIMD_PART = 4 };
#else
enum { PM_SIMD_PART = 2 };
#endif
typedef double pm_simd_part __attribute__((vector_size(PM_SIMD_PART * sizeof(double))));
typedef int64_t pm_simd_part_bits __attribute__((vector_size(PM_SIMD_PART * sizeof(int64_t))));
typedef double pm_simd_part_at __attribute__((vector_size(PM_SIMD_PART * sizeof(double)), may_alias)); /* aligned to its size */

/* Files whose lanes are things of their own, eight of which need not be together, say PM_SIMD_NARROW and get vectors of one register; those that turn
 * matrices of four rows say PM_SIMD_FOURS and get eight lanes where a register holds them, else four. */
#if !defined PM_SIMD_NARROW && !defined PM_SIMD_FOURS || defined __AVX512F__
#define PM_SIMD_EIGHT
enum { PM_SIMD_WIDTH = 8 };
#elif defined PM_SIMD_FOURS || defined __AVX__
#define PM_SIMD_FOUR
enum { PM_SIMD_WIDTH = 4 };
#else
enum { PM_SIMD_WIDTH = 2 };
#endif
typedef double pm_simd __attribute__((vector_size(PM_SIMD_WIDTH * sizeof(double))));
typedef int64_t pm_simd_bits __attribute__((vector_size(PM_SIMD_WIDTH * sizeof(double))));
typedef uint64_t pm_simd_words __attribute__((vector_size(PM_SIMD_WIDTH * sizeof(double))));

/* Two, four and eight doubles and four whole numbers at any address: what a pointer into an array of doubles (or int32_t) may be turned into. */
typedef double pm_simd_at __attribute__((vector_size(PM_SIMD_WIDTH * sizeof(double)), may_alias)); /* aligned to its size */
typedef int64_t pm_simd_bits_at __attribute__((vector_size(PM_SIMD_WIDTH * sizeof(double)), may_alias));
typedef double pm_simd2_at __attribute__((vector_size(16), aligned(8), may_alias));
typedef double pm_simd4_at __attribute__((vector_size(32), aligned(8), may_alias));
typedef double pm_simd8_at __attribute__((vector_size(64), aligned(8), may_alias));
typedef int32_t pm_simd4_int_at __attribute__((vector_size(16), aligned(4), may_alias));
typedef int32_t pm_simd_int __attribute__((vector_size(PM_SIMD_WIDTH * sizeof(int32_t))));
typedef uint32_t pm_simd_uint __attribute__((vector_size(PM_SIMD_WIDTH * sizeof(uint32_t))));
typedef int32_t pm_simd_int_at __attribute__((vector_size(PM_SIMD_WIDTH * sizeof(int32_t)), aligned(4), may_alias));

/* Before a short loop over vectors, which must vanish if they are to stay in registers: of at most 8 turns, of at most 16. */
#ifdef __clang__
#define PM_SIMD_UNROLL _Pragma("unroll")
#define PM_SIMD_UNROLL_MORE _Pragma("unroll")
#else
#define PM_SIMD_UNROLL _Pragma("GCC unroll 8")
#define PM_SIMD_UNROLL_MORE _Pragma("GCC unroll 16")
#endif

#define PM_SIMD_INLINE static inline __attribute__((always_inline, unused))

PM_SIMD_INLINE pm_simd pm_simd_all(double x)
{
#if defined PM_SIMD_EIGHT
	return (pm_simd){x, x, x, x, x, x, x, x};
#elif defined PM_SIMD_FOUR
	return (pm_simd){x, x, x, x};
#else
	return (pm_simd){x, x};
#endif
}

/* 0, 1, 2, ... */
PM_SIMD_INLINE pm_simd_bits pm_simd_lanes(void)
{
#if defined PM_SIMD_EIGHT
	return (pm_simd_bits){0, 1, 2, 3, 4, 5, 6, 7};
#elif defined PM_SIMD_FOUR
	return (pm_simd_bits){0, 1, 2, 3};
#else
	return (pm_simd_bits){0, 1};
#endif
}

PM_SIMD_INLINE pm_simd pm_simd_load(const double *p) { return *(const pm_simd_at *)p; } /* 64-byte aligned */

PM_SIMD_INLINE pm_simd pm_simd_load_any(const double *p) /* anywhere */
{
	pm_simd v;
	memcpy(&v, p, sizeof v);
	return v;
}

/* A vector of its fours, in registers: a load of what two narrower stores have left waits for them. */
PM_SIMD_INLINE pm_simd pm_simd_of_fours(const pm_simd4_at *four)
{
#if defined PM_SIMD_EIGHT
	return __builtin_shufflevector(four[0], four[1], 0, 1, 2, 3, 4, 5, 6, 7);
#else
	pm_simd v;
	memcpy(&v, four, sizeof v);
	return v;
#endif
}

PM_SIMD_INLINE void pm_simd_store(double *p, pm_simd v) { *(pm_simd_at *)p = v; }

PM_SIMD_INLINE void pm_simd_store_any(double *p, pm_simd v) { memcpy(p, &v, sizeof v); }

/* x, loaded here: compilers move the factors of many rows to the front, where there are not enough registers for them. */
PM_SIMD_INLINE double pm_simd_here(double x)
{
#ifdef __SSE2__
	__asm__ volatile("" : "+x"(x));
#endif
	return x;
}

/* The same in four lanes. */
PM_SIMD_INLINE pm_simd4_at pm_simd4_here(double x)
{
	pm_simd4_at four = {x, x, x, x};
#ifdef __AVX__
	__asm__ volatile("" : "+x"(four));
#endif
	return four;
}

/* What one register holds to an aligned address, past the caches where the processor can: whole lines of 64 bytes, one after the other, and an end before
 * others read them. */
PM_SIMD_INLINE void pm_simd_part_past(double *to, pm_simd_part v)
{
#if defined __AVX512F__
	_mm512_stream_pd(to, (__m512d)v);
#elif defined __AVX__
	_mm256_stream_pd(to, (__m256d)v);
#elif defined __SSE2__
	_mm_stream_pd(to, (__m128d)v);
#else
	*(pm_simd_part_at *)to = v;
#endif
}

PM_SIMD_INLINE void pm_simd_past_end(void)
{
#ifdef __SSE2__
	_mm_sfence();
#endif
}

/* PM_SIMD_PART rows of as many numbers: rows become columns. */
PM_SIMD_INLINE void pm_simd_transpose(pm_simd_part *r)
{
#if defined __AVX512F__
	pm_simd t[8], u[8];
	PM_SIMD_UNROLL
	for (int i = 0; i < 8; i += 2) {
		t[i] = __builtin_shufflevector(r[i], r[i + 1], 0, 8, 2, 10, 4, 12, 6, 14);
		t[i + 1] = __builtin_shufflevector(r[i], r[i + 1], 1, 9, 3, 11, 5, 13, 7, 15);
	}
	PM_SIMD_UNROLL
	for (int i = 0; i < 8; i += 4) /* gcc unrolls loops with a constant step; else the rows go through memory */
		PM_SIMD_UNROLL
		for (int k = i; k < i + 2; k++) {
			u[k] = __builtin_shufflevector(t[k], t[k + 2], 0, 1, 8, 9, 4, 5, 12, 13);
			u[k + 2] = __builtin_shufflevector(t[k], t[k + 2], 2, 3, 10, 11, 6, 7, 14, 15);
		}
	PM_SIMD_UNROLL
	for (int i = 0; i < 4; i++) {
		r[i] = __builtin_shufflevector(u[i], u[i + 4], 0, 1, 2, 3, 8, 9, 10, 11);
		r[i + 4] = __builtin_shufflevector(u[i], u[i + 4], 4, 5, 6, 7, 12, 13, 14, 15);
	}
#elif defined __AVX__
	const pm_simd_part t[4] = {__builtin_shufflevector(r[0], r[1], 0, 4, 2, 6), __builtin_shufflevector(r[0], r[1], 1, 5, 3, 7),
		__builtin_shufflevector(r[2], r[3], 0, 4, 2, 6), __builtin_shufflevector(r[2], r[3], 1, 5, 3, 7)};
	r[0] = __builtin_shufflevector(t[0], t[2], 0, 1, 4, 5), r[1] = __builtin_shufflevector(t[1], t[3], 0, 1, 4, 5);
	r[2] = __builtin_shufflevector(t[0], t[2], 2, 3, 6, 7), r[3] = __builtin_shufflevector(t[1], t[3], 2, 3, 6, 7);
#else
	const pm_simd_part low = __builtin_shufflevector(r[0], r[1], 0, 2), high = __builtin_shufflevector(r[0], r[1], 1, 3);
	r[0] = low, r[1] = high;
#endif
}

/* Lanes of two vectors: which, where a vector has eight, four and two. */
#define PM_SIMD_LANES(...) __VA_ARGS__
#if defined PM_SIMD_EIGHT
#define PM_SIMD_PICK(a, b, eight, four, two) __builtin_shufflevector(a, b, PM_SIMD_LANES eight)
#elif defined PM_SIMD_FOUR
#define PM_SIMD_PICK(a, b, eight, four, two) __builtin_shufflevector(a, b, PM_SIMD_LANES four)
#else
#define PM_SIMD_PICK(a, b, eight, four, two) __builtin_shufflevector(a, b, PM_SIMD_LANES two)
#endif

/* The vector one lane on: the last of `before`, then the others of `here`; and one lane back: those of `here` but the first, then the first of `after`. */
PM_SIMD_INLINE pm_simd pm_simd_shift_up(pm_simd before, pm_simd here)
{
	return PM_SIMD_PICK(before, here, (7, 8, 9, 10, 11, 12, 13, 14), (3, 4, 5, 6), (1, 2));
}
PM_SIMD_INLINE pm_simd pm_simd_shift_down(pm_simd here, pm_simd after)
{
	return PM_SIMD_PICK(here, after, (1, 2, 3, 4, 5, 6, 7, 8), (1, 2, 3, 4), (1, 2));
}

/* The vector k lanes on, 0 < k < PM_SIMD_WIDTH, a constant: those of a from k on, then the first of b. */
PM_SIMD_INLINE pm_simd pm_simd_lanes_from(int k, pm_simd a, pm_simd b)
{
#ifdef __AVX512F__ /* of a shuffle gcc makes two instructions and a table */
#define PM_SIMD_FROM(k) (pm_simd)_mm512_alignr_epi64((__m512i)b, (__m512i)a, k)
#else
#define PM_SIMD_FROM(k) PM_SIMD_PICK(a, b, (k, k + 1, k + 2, k + 3, k + 4, k + 5, k + 6, k + 7), (k & 3, (k & 3) + 1, (k & 3) + 2, (k & 3) + 3), (1, 2))
#endif
	switch (k) {
	case 2: return PM_SIMD_FROM(2);
	case 3: return PM_SIMD_FROM(3);
	case 4: return PM_SIMD_FROM(4);
	case 5: return PM_SIMD_FROM(5);
	case 6: return PM_SIMD_FROM(6);
	case 7: return PM_SIMD_FROM(7);
	default: return PM_SIMD_FROM(1);
	}
#undef PM_SIMD_FROM
}

/* Adds v, moved k lanes up, to two vectors one behind the other, 0 < k < PM_SIMD_WIDTH, a constant. Other lanes stay, or have 0 added. */
PM_SIMD_INLINE void pm_simd_add_moved(int k, pm_simd v, pm_simd *low, pm_simd *high)
{
#ifdef __AVX512F__ /* one rotation instead of two shifts */
	const pm_simd round = pm_simd_lanes_from(PM_SIMD_WIDTH - k, v, v);
	*low = (pm_simd)_mm512_mask_add_pd((__m512d)*low, (__mmask8)(0xff << k), (__m512d)*low, (__m512d)round);
	*high = (pm_simd)_mm512_mask_add_pd((__m512d)*high, (__mmask8)(0xff >> (8 - k)), (__m512d)*high, (__m512d)round);
#else
	const pm_simd zero = {0};
	*low += pm_simd_lanes_from(PM_SIMD_WIDTH - k, zero, v);
	*high += pm_simd_lanes_from(PM_SIMD_WIDTH - k, v, zero);
#endif
}

/* Two vectors in order to the values of even and of odd number, and back. */
PM_SIMD_INLINE pm_simd pm_simd_even(pm_simd low, pm_simd high) { return PM_SIMD_PICK(low, high, (0, 2, 4, 6, 8, 10, 12, 14), (0, 2, 4, 6), (0, 2)); }
PM_SIMD_INLINE pm_simd pm_simd_odd(pm_simd low, pm_simd high) { return PM_SIMD_PICK(low, high, (1, 3, 5, 7, 9, 11, 13, 15), (1, 3, 5, 7), (1, 3)); }
PM_SIMD_INLINE pm_simd pm_simd_zip_low(pm_simd even, pm_simd odd)
{
	return PM_SIMD_PICK(even, odd, (0, 8, 1, 9, 2, 10, 3, 11), (0, 4, 1, 5), (0, 2));
}
PM_SIMD_INLINE pm_simd pm_simd_zip_high(pm_simd even, pm_simd odd)
{
	return PM_SIMD_PICK(even, odd, (4, 12, 5, 13, 6, 14, 7, 15), (2, 6, 3, 7), (1, 3));
}

PM_SIMD_INLINE pm_simd pm_simd_abs(pm_simd v) { return (pm_simd)((pm_simd_bits)v & INT64_MAX); }
PM_SIMD_INLINE pm_simd_part pm_simd_part_abs(pm_simd_part v) { return (pm_simd_part)((pm_simd_part_bits)v & INT64_MAX); }

/* Larger values take their places; NaN none. */
PM_SIMD_INLINE void pm_simd_raise(pm_simd *most, pm_simd v)
{
#if defined __AVX512F__ /* where one is NaN, or both are 0, the second */
	*most = (pm_simd)_mm512_max_pd((__m512d)v, (__m512d)*most);
#elif defined PM_SIMD_FOUR && defined __AVX__
	*most = (pm_simd)_mm256_max_pd((__m256d)v, (__m256d)*most);
#else
	const pm_simd_bits above = v > *most;
	*most = (pm_simd)(((pm_simd_bits)v & above) | ((pm_simd_bits)*most & ~above));
#endif
}

/* v where the mask, aligned as a vector, is -1, and 0 where it is 0. */
PM_SIMD_INLINE pm_simd pm_simd_masked(pm_simd v, const int64_t *mask)
{
	return (pm_simd)((pm_simd_bits)v & *(const pm_simd_bits_at *)mask);
}

/* Sum of the lanes, in a fixed order: of halves, until one is left. */
PM_SIMD_INLINE double pm_simd_sum(pm_simd v)
{
	PM_SIMD_UNROLL
	for (int half = PM_SIMD_WIDTH / 2; half > 0; half /= 2)
		for (int l = 0; l < half; l++)
			v[l] += v[l + half];
	return v[0];
}

/* True if a < b in any lane. */
PM_SIMD_INLINE int pm_simd_any_below(pm_simd a, pm_simd b)
{
#ifdef __AVX512F__
	return _mm512_cmp_pd_mask((__m512d)a, (__m512d)b, _CMP_LT_OQ) != 0;
#else
	pm_simd_bits m = a < b;
	int64_t any = 0;
	PM_SIMD_UNROLL
	for (int l = 0; l < PM_SIMD_WIDTH; l++)
		any |= m[l];
	return any != 0;
#endif
}

/* v where a >= b, else 0. */
PM_SIMD_INLINE pm_simd pm_simd_where_not_below(pm_simd a, pm_simd b, pm_simd v)
{
#ifdef __AVX512F__
	return (pm_simd)_mm512_maskz_mov_pd(_mm512_cmp_pd_mask((__m512d)a, (__m512d)b, _CMP_GE_OQ), (__m512d)v);
#else
	return (pm_simd)((pm_simd_bits)(a >= b) & (pm_simd_bits)v);
#endif
}

/* yes where a < b, else no. */
PM_SIMD_INLINE pm_simd pm_simd_where_below(pm_simd a, pm_simd b, pm_simd yes, pm_simd no)
{
	const pm_simd_bits below = a < b;
	return (pm_simd)((below & (pm_simd_bits)yes) | (~below & (pm_simd_bits)no));
}

/* How many bits are set: of a byte, and of a word. */
PM_SIMD_INLINE size_t pm_simd_bits_of_byte(unsigned byte)
{
#ifdef __POPCNT__
	return (size_t)__builtin_popcount(byte);
#else
	byte -= byte >> 1 & 0x55, byte = (byte & 0x33) + (byte >> 2 & 0x33);
	return (byte + (byte >> 4)) & 15;
#endif
}
PM_SIMD_INLINE size_t pm_simd_bits_of_word(uint64_t word)
{
#ifdef __POPCNT__
	return (size_t)__builtin_popcountll(word);
#else
	word -= word >> 1 & 0x5555555555555555, word = (word & 0x3333333333333333) + (word >> 2 & 0x3333333333333333);
	return (size_t)(((word + (word >> 4)) & 0x0f0f0f0f0f0f0f0f) * 0x0101010101010101 >> 56);
#endif
}

/* The number of the k-th bit that is set, from 0; there is one. */
PM_SIMD_INLINE size_t pm_simd_bit(uint64_t bits, size_t k)
{
#ifdef __BMI2__
	return (size_t)__builtin_ctzll(_pdep_u64((uint64_t)1 << k, bits));
#else
	size_t at = 0;
	for (size_t here; (here = pm_simd_bits_of_byte(bits & 255)) <= k; bits >>= 8, at += 8) /* whole bytes first */
		k -= here;
	for (; k; k--)
		bits &= bits - 1;
	return at + (size_t)__builtin_ctzll(bits);
#endif
}

/* The lanes whose bits are set, one behind the other, from the first on; what is in the others is left open. And back: the first lanes
 * of v to the places of to[] whose bits are set; the others are not touched. */
PM_SIMD_INLINE pm_simd pm_simd_pack(pm_simd v, unsigned some)
{
#if defined __AVX512F__
	return (pm_simd)_mm512_maskz_compress_pd((__mmask8)some, (__m512d)v);
#elif defined PM_SIMD_FOUR && defined __AVX2__
	static const int32_t order[16][8] = {{0}, {0, 1}, {2, 3}, {0, 1, 2, 3}, {4, 5}, {0, 1, 4, 5}, {2, 3, 4, 5}, {0, 1, 2, 3, 4, 5}, {6, 7}, {0, 1, 6, 7},
		{2, 3, 6, 7}, {0, 1, 2, 3, 6, 7}, {4, 5, 6, 7}, {0, 1, 4, 5, 6, 7}, {2, 3, 4, 5, 6, 7}, {0, 1, 2, 3, 4, 5, 6, 7}};
	return (pm_simd)_mm256_permutevar8x32_ps((__m256)v, _mm256_loadu_si256((const __m256i *)order[some]));
#else
	double packed[PM_SIMD_WIDTH + 1] = {0};
	size_t k = 0;
	if (some == (1u << PM_SIMD_WIDTH) - 1)
		return v;
	for (size_t l = 0; l < PM_SIMD_WIDTH; l++) {
		packed[k] = v[l];
		k += some >> l & 1;
	}
	memcpy(&v, packed, sizeof v);
	return v;
#endif
}
PM_SIMD_INLINE void pm_simd_unpack_to(double *to, pm_simd v, unsigned some)
{
#if defined __AVX512F__
	_mm512_mask_storeu_pd(to, (__mmask8)some, _mm512_maskz_expand_pd((__mmask8)some, (__m512d)v));
#else
	size_t k = 0;
	for (; some; some &= some - 1)
		to[__builtin_ctz(some)] = v[k++];
#endif
}

/* v in lanes from..to-1, else other. */
PM_SIMD_INLINE pm_simd pm_simd_between(size_t from, size_t to, pm_simd v, pm_simd other)
{
#ifdef __AVX512F__
	return (pm_simd)_mm512_mask_mov_pd((__m512d)other, (__mmask8)(((1u << (to < 8 ? to : 8)) - 1) & ~((1u << (from < 8 ? from : 8)) - 1)), (__m512d)v);
#else
	pm_simd_bits lane = pm_simd_lanes(), in = (lane >= (int64_t)from) & (lane < (int64_t)to);
	return (pm_simd)((in & (pm_simd_bits)v) | (~in & (pm_simd_bits)other));
#endif
}

/* a*b + c and c - a*b, rounded once where the machine can. */
PM_SIMD_INLINE pm_simd pm_simd_fma(pm_simd a, pm_simd b, pm_simd c)
{
#ifdef __AVX512F__
	return (pm_simd)_mm512_fmadd_pd((__m512d)a, (__m512d)b, (__m512d)c);
#else
	return a * b + c;
#endif
}

PM_SIMD_INLINE pm_simd pm_simd_fnma(pm_simd a, pm_simd b, pm_simd c)
{
#ifdef __AVX512F__
	return (pm_simd)_mm512_fnmadd_pd((__m512d)a, (__m512d)b, (__m512d)c);
#else
	return c - a * b;
#endif
}

/* a*b + c, rounded once on any machine. */
PM_SIMD_INLINE pm_simd pm_simd_fma_once(pm_simd a, pm_simd b, pm_simd c)
{
#if defined PM_SIMD_FOUR && defined __FMA__
	return (pm_simd)_mm256_fmadd_pd((__m256d)a, (__m256d)b, (__m256d)c);
#elif defined __AVX512F__
	return pm_simd_fma(a, b, c);
#else
	for (int l = 0; l < PM_SIMD_WIDTH; l++)
		c[l] = fma(a[l], b[l], c[l]);
	return c;
#endif
}

/* a/b, rounded once, where r is 1/b: with multiply-adds by Markstein's correction (IBM J. Res. Dev. 34 (1990) 111), which is three operations instead of
 * one that takes as long as sixteen. Quotients below 1e-290 may be rounded twice; infinite ones are NaN. */
PM_SIMD_INLINE pm_simd pm_simd_divide(pm_simd a, pm_simd b, pm_simd r)
{
#ifdef __AVX512F__
	pm_simd q = a * r;
	return pm_simd_fma(pm_simd_fnma(q, b, a), r, q);
#elif defined PM_SIMD_FOUR && defined __FMA__
	__m256d q = (__m256d)(a * r);
	return (pm_simd)_mm256_fmadd_pd(_mm256_fnmadd_pd(q, (__m256d)b, (__m256d)a), (__m256d)r, q);
#else
	(void)r;
	return a / b;
#endif
}

/* Lanes with not low <= v <= high, NaN included, as bits. */
PM_SIMD_INLINE unsigned pm_simd_outside(pm_simd v, pm_simd low, pm_simd high)
{
#ifdef __AVX512F__
	return (unsigned)_mm512_cmp_pd_mask((__m512d)v, (__m512d)low, _CMP_NGE_UQ) | (unsigned)_mm512_cmp_pd_mask((__m512d)v, (__m512d)high, _CMP_NLE_UQ);
#elif defined PM_SIMD_FOUR && defined __AVX__
	return 15u ^ (unsigned)_mm256_movemask_pd((__m256d)((v >= low) & (v <= high)));
#else
	pm_simd_bits in = (v >= low) & (v <= high);
	unsigned out = 0;
	for (int l = 0; l < PM_SIMD_WIDTH; l++)
		out |= (unsigned)!in[l] << l;
	return out;
#endif
}

/* Is a bit set? */
PM_SIMD_INLINE bool pm_simd_any_bit(pm_simd_bits v)
{
#ifdef __AVX512F__
	return _mm512_test_epi64_mask((__m512i)v, (__m512i)v) != 0;
#else
	int64_t bits = 0;
	for (int l = 0; l < PM_SIMD_WIDTH; l++)
		bits |= v[l];
	return bits != 0;
#endif
}

#ifdef __AVX512F__
#define PM_SIMD_DOWN 1
/* a + b, rounded down; and of each number the lower half of its bits. */
PM_SIMD_INLINE pm_simd pm_simd_add_down(pm_simd a, pm_simd b)
{
	return (pm_simd)_mm512_add_round_pd((__m512d)a, (__m512d)b, _MM_FROUND_TO_NEG_INF | _MM_FROUND_NO_EXC);
}
PM_SIMD_INLINE pm_simd_int pm_simd_low_halves(pm_simd v) { return (pm_simd_int)_mm512_cvtepi64_epi32((__m512i)v); }
#else
#define PM_SIMD_DOWN 0
#endif

/* The whole part of v >= 0, below 2^31, and what is left of v. */
PM_SIMD_INLINE pm_simd pm_simd_split(pm_simd v, pm_simd_int *whole)
{
#ifdef __AVX512F__
	__m256i cell = _mm512_cvttpd_epi32((__m512d)v);
	*whole = (pm_simd_int)cell;
	return v - (pm_simd)_mm512_cvtepi32_pd(cell);
#elif defined PM_SIMD_FOUR && defined __AVX__
	__m128i cell = _mm256_cvttpd_epi32((__m256d)v);
	*whole = (pm_simd_int)cell;
	return v - (pm_simd)_mm256_cvtepi32_pd(cell);
#else
	*whole = __builtin_convertvector(v, pm_simd_int);
	return v - __builtin_convertvector(*whole, pm_simd);
#endif
}

/* 0, 1, 2, ... */
PM_SIMD_INLINE pm_simd_int pm_simd_int_lanes(void) { return __builtin_convertvector(pm_simd_lanes(), pm_simd_int); }

/* Bit l: lane l is not n. */
PM_SIMD_INLINE unsigned pm_simd_int_others(pm_simd_int v, int32_t n)
{
#ifdef __AVX512VL__
	return _mm256_cmpneq_epi32_mask((__m256i)v, _mm256_set1_epi32(n));
#elif defined PM_SIMD_FOUR && defined __SSE2__
	return 15u ^ (unsigned)_mm_movemask_ps(_mm_castsi128_ps(_mm_cmpeq_epi32((__m128i)v, _mm_set1_epi32(n))));
#else
	unsigned others = 0;
	for (int l = 0; l < PM_SIMD_WIDTH; l++)
		others |= (unsigned)(v[l] != n) << l;
	return others;
#endif
}

/* The split of four. */
PM_SIMD_INLINE pm_simd4_at pm_simd4_split(pm_simd4_at v, pm_simd4_int_at *whole)
{
#ifdef __AVX__
	__m128i cell = _mm256_cvttpd_epi32((__m256d)v);
	*whole = (pm_simd4_int_at)cell;
	return v - (pm_simd4_at)_mm256_cvtepi32_pd(cell);
#else
	*whole = __builtin_convertvector(v, pm_simd4_int_at);
	return v - __builtin_convertvector(*whole, pm_simd4_at);
#endif
}

/* Which of four masks, 0 or -1, are set, as bits. */
PM_SIMD_INLINE unsigned pm_simd4_bits(pm_simd4_at mask)
{
#ifdef __AVX__
	return (unsigned)_mm256_movemask_pd((__m256d)mask);
#else
	unsigned bits = 0;
	for (int l = 0; l < 4; l++)
		bits |= (unsigned)signbit(mask[l]) << l;
	return bits;
#endif
}

/* Lanes of b where a bit of the constant is set, else of a. Not a shuffle: of a number in all lanes gcc would make three instructions of it. */
#ifdef __AVX__
#define pm_simd4_blend(a, b, bits) ((pm_simd4_at)_mm256_blend_pd((__m256d)(a), (__m256d)(b), bits))
#else
#define pm_simd4_blend(a, b, bits) ((pm_simd4_at){(bits) & 1 ? (b)[0] : (a)[0], (bits) & 2 ? (b)[1] : (a)[1], (bits) & 4 ? (b)[2] : (a)[2], \
	(bits) & 8 ? (b)[3] : (a)[3]})
#endif

/* 1 - x four times, then x four times. */
PM_SIMD_INLINE pm_simd8_at pm_simd8_below_above(double x)
{
#ifdef __AVX512F__
	return (pm_simd8_at)_mm512_mask_sub_pd(_mm512_set1_pd(x), 0x0f, _mm512_set1_pd(1), _mm512_set1_pd(x));
#else
	const double y = 1 - x;
	return (pm_simd8_at){y, y, y, y, x, x, x, x};
#endif
}

#if defined PM_SIMD_EIGHT || defined PM_SIMD_FOUR
/* A matrix of 4 rows to columns, of 4 x 8 in two halves: lane l of v[k] becomes lane k of to[l], and lane 4 + l lane 4 + k. */
PM_SIMD_INLINE void pm_simd_turn(const pm_simd v[4], pm_simd to[4])
{
#ifdef PM_SIMD_EIGHT
#define PM_SIMD_TURN(a, b, eight, four) __builtin_shufflevector(a, b, PM_SIMD_LANES eight)
#else
#define PM_SIMD_TURN(a, b, eight, four) __builtin_shufflevector(a, b, PM_SIMD_LANES four)
#endif
	const pm_simd a = PM_SIMD_TURN(v[0], v[1], (0, 8, 2, 10, 4, 12, 6, 14), (0, 4, 2, 6));
	const pm_simd b = PM_SIMD_TURN(v[0], v[1], (1, 9, 3, 11, 5, 13, 7, 15), (1, 5, 3, 7));
	const pm_simd c = PM_SIMD_TURN(v[2], v[3], (0, 8, 2, 10, 4, 12, 6, 14), (0, 4, 2, 6));
	const pm_simd d = PM_SIMD_TURN(v[2], v[3], (1, 9, 3, 11, 5, 13, 7, 15), (1, 5, 3, 7));
	to[0] = PM_SIMD_TURN(a, c, (0, 1, 8, 9, 4, 5, 12, 13), (0, 1, 4, 5));
	to[1] = PM_SIMD_TURN(b, d, (0, 1, 8, 9, 4, 5, 12, 13), (0, 1, 4, 5));
	to[2] = PM_SIMD_TURN(a, c, (2, 3, 10, 11, 6, 7, 14, 15), (2, 3, 6, 7));
	to[3] = PM_SIMD_TURN(b, d, (2, 3, 10, 11, 6, 7, 14, 15), (2, 3, 6, 7));
#undef PM_SIMD_TURN
}

/* Four values at each address: those of at[k], and in eight lanes those of at[k + 4]. */
PM_SIMD_INLINE pm_simd pm_simd_fours(const double *const at[], size_t k)
{
#if defined PM_SIMD_FOUR
	return pm_simd_load_any(at[k]);
#elif defined __AVX512F__
	return (pm_simd)_mm512_insertf64x4(_mm512_castpd256_pd512(_mm256_loadu_pd(at[k])), _mm256_loadu_pd(at[k + 4]), 1);
#else
	const double *a = at[k], *b = at[k + 4];
	return (pm_simd){a[0], a[1], a[2], a[3], b[0], b[1], b[2], b[3]};
#endif
}

/* The columns of such a matrix one behind the other. */
PM_SIMD_INLINE void pm_simd_store_columns(double *to, const pm_simd v[4])
{
	pm_simd u[4];
	pm_simd_turn(v, u);
#ifdef PM_SIMD_EIGHT
	for (int k = 0; k < 4; k += 2) {
		pm_simd_store_any(to + 4 * k, __builtin_shufflevector(u[k], u[k + 1], 0, 1, 2, 3, 8, 9, 10, 11));
		pm_simd_store_any(to + 4 * k + 16, __builtin_shufflevector(u[k], u[k + 1], 4, 5, 6, 7, 12, 13, 14, 15));
	}
#else
	for (int k = 0; k < 4; k++)
		pm_simd_store_any(to + 4 * k, u[k]);
#endif
}

/* Rows of four, of as many things as there are lanes, to one vector of the things for each of the four. */
PM_SIMD_INLINE void pm_simd_rows_to_lanes(const pm_simd4_at row[], pm_simd to[4])
{
	pm_simd v[4];
	PM_SIMD_UNROLL
	for (int k = 0; k < 4; k++)
#ifdef PM_SIMD_EIGHT
		v[k] = __builtin_shufflevector(row[k], row[k + 4], 0, 1, 2, 3, 4, 5, 6, 7);
#else
		v[k] = row[k];
#endif
	pm_simd_turn(v, to);
}

/* Two neighbours at each of four addresses: the first ones and the second ones. */
PM_SIMD_INLINE void pm_simd4_pairs(const double *const at[4], size_t on, pm_simd4_at to[2])
{
	pm_simd2_at p[4];
	PM_SIMD_UNROLL
	for (int l = 0; l < 4; l++)
		p[l] = *(const pm_simd2_at *)(at[l] + on);
	const pm_simd4_at even = __builtin_shufflevector(p[0], p[2], 0, 1, 2, 3), odd = __builtin_shufflevector(p[1], p[3], 0, 1, 2, 3);
	to[0] = __builtin_shufflevector(even, odd, 0, 4, 2, 6);
	to[1] = __builtin_shufflevector(even, odd, 1, 5, 3, 7);
}

/* a[l], b[l] to[l]. */
PM_SIMD_INLINE void pm_simd_to_pairs(pm_simd a, pm_simd b, pm_simd2_at to[])
{
#ifdef PM_SIMD_EIGHT
	const pm_simd even = __builtin_shufflevector(a, b, 0, 8, 2, 10, 4, 12, 6, 14), odd = __builtin_shufflevector(a, b, 1, 9, 3, 11, 5, 13, 7, 15);
	to[4] = __builtin_shufflevector(even, even, 4, 5), to[6] = __builtin_shufflevector(even, even, 6, 7);
	to[5] = __builtin_shufflevector(odd, odd, 4, 5), to[7] = __builtin_shufflevector(odd, odd, 6, 7);
#else
	const pm_simd even = __builtin_shufflevector(a, b, 0, 4, 2, 6), odd = __builtin_shufflevector(a, b, 1, 5, 3, 7);
#endif
	to[0] = __builtin_shufflevector(even, even, 0, 1), to[2] = __builtin_shufflevector(even, even, 2, 3);
	to[1] = __builtin_shufflevector(odd, odd, 0, 1), to[3] = __builtin_shufflevector(odd, odd, 2, 3);
}
#endif

/* exp(x) for |x| <= 700, to 4e-16: 2^n exp(r) with |r| <= ln(2)/2, the polynomial of degree 10 with the least relative error there (2.1e-16; Remez's
 * exchange). Lanes beyond hold anything. */
PM_SIMD_INLINE pm_simd pm_simd_exp(pm_simd x)
{
	const double magic = 0x1.8p52, /* brings the whole number into the last bits */ of[] = {1, 1.0000000000000064426, 0.49999999999997286939,
		0.16666666666557740923, 0.0416666666684260609, 0.0083333333846659047921, 0.0013888888499128804452, 0.00019841171384084617397,
		0.000024801917696315434502, 2.7639768308281270114e-6, 2.7488440881408338451e-7};
	pm_simd whole = pm_simd_fma(x, pm_simd_all(1.4426950408889634), pm_simd_all(magic)), n = whole - pm_simd_all(magic);
	pm_simd r = pm_simd_fnma(n, pm_simd_all(0x1.62e42feep-1), x), p = pm_simd_all(of[10]);
	r = pm_simd_fnma(n, pm_simd_all(0x1.a39ef35793c76p-33), r); /* ln 2 in two parts, the first of 32 bits */
	PM_SIMD_UNROLL
	for (int k = 9; k >= 2; k--)
		p = pm_simd_fma(p, r, pm_simd_all(of[k]));
	p = pm_simd_fma(pm_simd_fma(p, r, pm_simd_all(of[1])), r, pm_simd_all(of[0]));
	return (pm_simd)((pm_simd_words)p + ((pm_simd_words)whole << 52));
}

PM_SIMD_INLINE pm_simd pm_simd_sqrt(pm_simd x)
{
#if defined __AVX512F__
	return (pm_simd)_mm512_sqrt_pd((__m512d)x);
#elif defined PM_SIMD_FOUR && defined __AVX__
	return (pm_simd)_mm256_sqrt_pd((__m256d)x);
#else /* compilers take one lane after the other where there are more in a register */
	for (int l = 0; l < PM_SIMD_WIDTH; l++)
		x[l] = sqrt(x[l]);
	return x;
#endif
}

/* 1/sqrt(x) and 1/x to a relative error below 2^-14. */
PM_SIMD_INLINE pm_simd pm_simd_rsqrt_start(pm_simd x)
{
#ifdef __AVX512F__
	return (pm_simd)_mm512_rsqrt14_pd((__m512d)x);
#else
	return 1 / pm_simd_sqrt(x);
#endif
}

/* 1/sqrt(x) to 1.5 round-offs, x finite and above 0: of a start of 2^-14 and the terms to third order (35/128 e^4 are left, e below 2^-13); a root and a
 * quotient take the divider three times as long. */
PM_SIMD_INLINE pm_simd pm_simd_rsqrt(pm_simd x)
{
	const pm_simd y = pm_simd_rsqrt_start(x);
#ifdef __AVX512F__
	const pm_simd e = pm_simd_fnma(x * y, y, pm_simd_all(1));
	return pm_simd_fma(y * e, pm_simd_fma(e, pm_simd_fma(e, pm_simd_all(0.3125), pm_simd_all(0.375)), pm_simd_all(0.5)), y);
#else
	return y;
#endif
}

/* The same to half a last digit and little more: with what rounding leaves out of x y, and the terms to fourth order, which have one sign. Elsewhere a root
 * and a quotient, to one and a half. */
PM_SIMD_INLINE pm_simd pm_simd_rsqrt_near(pm_simd x)
{
	const pm_simd y = pm_simd_rsqrt_start(x);
#ifdef __AVX512F__
	const pm_simd z = x * y, e = pm_simd_fnma(pm_simd_fma(x, y, -z), y, pm_simd_fnma(z, y, pm_simd_all(1)));
	const pm_simd terms = pm_simd_fma(e, pm_simd_fma(e, pm_simd_all(35. / 128), pm_simd_all(0.3125)), pm_simd_all(0.375));
	return pm_simd_fma(y * e, pm_simd_fma(e, terms, pm_simd_all(0.5)), y);
#else
	return y;
#endif
}

PM_SIMD_INLINE pm_simd pm_simd_reciprocal_start(pm_simd x)
{
#ifdef __AVX512F__
	return (pm_simd)_mm512_rcp14_pd((__m512d)x);
#else
	return 1 / x;
#endif
}

/* A loop that is compiled for each kernel, width and dimension is compiled once and called under the sanitizers, for which its copies took a third of the
 * time of the whole build (pse.c: 31 s, now 0.6). */
#ifdef PM_SANITIZED
#undef PM_SIMD_UNROLL
#define PM_SIMD_UNROLL
#undef PM_SIMD_UNROLL_MORE
#define PM_SIMD_UNROLL_MORE
#undef PM_SIMD_INLINE
#define PM_SIMD_INLINE static __attribute__((noinline, unused))
#endif

#endif
