/* Between rows in memory and lanes in a block: tiles of 8 x 8 (or 4 x 4, 2 x 2: what registers hold) transposed, with the split of a pair transform into the
 * spectra of its two rows where they are complex: rows a and b, Z = F(a + i b), A_k = (Z_k + conj Z_{n-k})/2, B_k = (Z_k - conj Z_{n-k})/(2 i).
 * SPDX-License-Identifier: GPL-3.0-or-later */
#include <string.h>

#include "fft/fft-block.h"
#include "fft/fft-vector.h"

enum { W = PM_SIMD_PART };
#ifdef __SSE2__
#include <immintrin.h>
#define PM_STREAMS
#endif

/* W rows, W elements of each, transposed; fewer at the ends. */
PM_SIMD_INLINE void tile_in(const double *const *row, size_t at, pm_simd_part *t)
{
	for (int q = 0; q < W; q++)
		memcpy(&t[q], row[q] + at, sizeof *t);
	pm_simd_transpose(t);
}

PM_SIMD_INLINE void tile_out(pm_simd_part *t, size_t at, double *const *row)
{
	pm_simd_transpose(t);
	for (int q = 0; q < W; q++)
		memcpy(row[q] + at, &t[q], sizeof *t);
}

static void part_in(const double *const *row, size_t rows, size_t at, size_t count, pm_simd_part *t)
{
	memset(t, 0, W * sizeof *t);
	for (size_t q = 0; q < W && q < rows; q++)
		memcpy(&t[q], row[q] + at, count * sizeof(double));
	pm_simd_transpose(t);
}

static void part_out(pm_simd_part *t, size_t rows, size_t at, size_t count, double *const *row)
{
	pm_simd_transpose(t);
	for (size_t q = 0; q < W && q < rows; q++)
		memcpy(row[q] + at, &t[q], count * sizeof(double));
}

PM_SIMD_INLINE size_t beyond(size_t rows, size_t from) { return rows > from ? rows - from : 0; }

/* The lanes from `from` on of element i, which has its row in the block. */
PM_SIMD_INLINE pm_simd_part_at *lane(const double *block, const size_t *at, size_t i, size_t from)
{
	return (pm_simd_part_at *)(block + (at ? at[i] : i) * PM_FFT_LINES + from);
}

void pm_fft_rows_in(const double *const row[PM_FFT_LINES], size_t rows, size_t n, const size_t *at, double *block)
{
	for (size_t i = 0; i < n; i += W)
		for (size_t from = 0; from < PM_FFT_LINES; from += W) {
			pm_simd_part t[W];
			if (n - i >= W && rows == PM_FFT_LINES) {
				tile_in(row + from, i, t);
				for (size_t q = 0; q < W; q++)
					*lane(block, at, i + q, from) = t[q];
				continue;
			}
			part_in(row + from, beyond(rows, from), i, n - i < W ? n - i : W, t);
			for (size_t q = 0; q < W && i + q < n; q++)
				*lane(block, at, i + q, from) = t[q];
		}
}

void pm_fft_rows_out(const double *block, const size_t *at, size_t n, size_t rows, double *const row[PM_FFT_LINES])
{
	for (size_t i = 0; i < n; i += W)
		for (size_t from = 0; from < PM_FFT_LINES; from += W) {
			pm_simd_part t[W];
			if (n - i >= W && rows == PM_FFT_LINES) {
				for (size_t q = 0; q < W; q++)
					t[q] = *lane(block, at, i + q, from);
				tile_out(t, i, row + from);
				continue;
			}
			for (size_t q = 0; q < W; q++)
				t[q] = i + q < n ? (pm_simd_part)*lane(block, at, i + q, from) : (pm_simd_part){0};
			part_out(t, beyond(rows, from), i, n - i < W ? n - i : W, row + from);
		}
}

/* Frequencies k .. k+W-1 of the rows in the real lanes, or in the imaginary ones. */
PM_SIMD_INLINE void unpack(const struct pm_fft *f, const struct c8 *x, size_t k, bool second, pm_simd_part *re, pm_simd_part *im)
{
	size_t n = f->n, modes = n / 2 + 1;
	for (size_t q = 0; q < W; q++) {
		bool there = k + q < modes; /* beyond: the last one again, cleared */
		const struct c8 *z = x + f->at[there ? k + q : 0], *y = x + f->at[there && k + q ? n - k - q : 0];
		double half = there ? 0.5 : 0;
		re[q] = half * (second ? z->im + y->im : z->re + y->re);
		im[q] = half * (second ? y->re - z->re : z->im - y->im);
	}
}

/* Where the real part of frequency k is in a row of modes: eight of these, then their imaginary parts. */
PM_SIMD_INLINE size_t mode(size_t k) { return 2 * k - k % 8; }

void pm_spectra_out(const struct pm_fft *f, const double *block, size_t rows, double *const row[PM_FFT_LINES])
{
	for (size_t k = 0; k < (f->n / 2 + 8) / 8 * 8; k += W)
		for (size_t from = 0; from < PM_FFT_LINES; from += W) {
			pm_simd_part re[W], im[W];
			unpack(f, part_of(block, (int)(from % 8 / W)), k, from >= 8, re, im);
			if (rows == PM_FFT_LINES) {
				tile_out(re, mode(k), row + from);
				tile_out(im, mode(k) + 8, row + from);
			} else {
				part_out(re, beyond(rows, from), mode(k), W, row + from);
				part_out(im, beyond(rows, from), mode(k) + 8, W, row + from);
			}
		}
}

/* Frequencies k .. k+W-1 of W pairs of rows, the lanes of one part. */
PM_SIMD_INLINE void pack(const struct pm_fft *f, size_t rows, const double *const *row, size_t from, size_t k, struct c8 *x)
{
	size_t n = f->n, modes = n / 2 + 1;
	pm_simd_part ar[W], ai[W], br[W], bi[W];
	if (rows == PM_FFT_LINES) {
		tile_in(row + from, mode(k), ar);
		tile_in(row + from, mode(k) + 8, ai);
		tile_in(row + from + 8, mode(k), br);
		tile_in(row + from + 8, mode(k) + 8, bi);
	} else {
		part_in(row + from, beyond(rows, from), mode(k), W, ar);
		part_in(row + from, beyond(rows, from), mode(k) + 8, W, ai);
		part_in(row + from + 8, beyond(rows, from + 8), mode(k), W, br);
		part_in(row + from + 8, beyond(rows, from + 8), mode(k) + 8, W, bi);
	}
	for (size_t q = 0; q < W && k + q < modes; q++) {
		size_t i = f->at[k + q], j = f->at[k + q ? n - k - q : 0];
		put(x + j, (struct lanes){ar[q] + bi[q], br[q] - ai[q]});
		put(x + i, i == j ? (struct lanes){ar[q], br[q]} : (struct lanes){ar[q] - bi[q], ai[q] + br[q]});
	}
}

void pm_spectra_in(const struct pm_fft *f, size_t rows, const double *const row[PM_FFT_LINES], double *block)
{
	for (size_t k = 0; k < f->n / 2 + 1; k += W)
		for (size_t from = 0; from < 8; from += W)
			pack(f, rows, row, from, k, part_of(block, (int)(from / W)));
}

#ifdef PM_STREAMS
/* One register. */
PM_SIMD_INLINE void past(double *to, const double *from)
{
#if defined __AVX512F__
	_mm512_stream_pd(to, _mm512_loadu_pd(from));
#elif defined __AVX__
	_mm256_stream_pd(to, _mm256_loadu_pd(from));
#else
	_mm_stream_pd(to, _mm_loadu_pd(from));
#endif
}
#endif

void pm_stream(double *to, const double *from, size_t n)
{
	size_t i = 0;
#ifdef PM_STREAMS
	for (; i < n && (uintptr_t)(to + i) % 64; i++)
		to[i] = from[i];
	for (; i + 8 <= n; i += 8) /* whole lines of the cache */
		PM_SIMD_UNROLL
		for (size_t q = 0; q < 8; q += W)
			past(to + i + q, from + i + q);
#endif
	memcpy(to + i, from + i, (n - i) * sizeof *to);
}

void pm_stream_end(void)
{
#ifdef PM_STREAMS
	_mm_sfence();
#endif
}
