/* Between rows in memory and lanes in a block: 8 x 8 tiles transposed in registers, with the split of a pair transform into the spectra of its two rows
 * where they are complex: rows a and b, Z = F(a + i b), A_k = (Z_k + conj Z_{n-k})/2, B_k = (Z_k - conj Z_{n-k})/(2 i).
 * SPDX-License-Identifier: GPL-3.0-or-later */
#include <string.h>

#include "fft/fft-block.h"
#include "fft/fft-vector.h"

PM_SIMD_INLINE void transpose(pm_simd *r)
{
	pm_simd t[8], u[8];
	for (int i = 0; i < 8; i += 2) {
		t[i] = __builtin_shufflevector(r[i], r[i + 1], 0, 8, 2, 10, 4, 12, 6, 14);
		t[i + 1] = __builtin_shufflevector(r[i], r[i + 1], 1, 9, 3, 11, 5, 13, 7, 15);
	}
	for (int i = 0; i < 8; i += i & 1 ? 3 : 1) {
		u[i] = __builtin_shufflevector(t[i], t[i + 2], 0, 1, 8, 9, 4, 5, 12, 13);
		u[i + 2] = __builtin_shufflevector(t[i], t[i + 2], 2, 3, 10, 11, 6, 7, 14, 15);
	}
	for (int i = 0; i < 4; i++) {
		r[i] = __builtin_shufflevector(u[i], u[i + 4], 0, 1, 2, 3, 8, 9, 10, 11);
		r[i + 4] = __builtin_shufflevector(u[i], u[i + 4], 4, 5, 6, 7, 12, 13, 14, 15);
	}
}

/* Eight rows, eight elements of each, transposed; fewer at the ends. */
PM_SIMD_INLINE void tile_in(const double *const *row, size_t at, pm_simd *t)
{
	for (int q = 0; q < 8; q++)
		t[q] = pm_simd_load_any(row[q] + at);
	transpose(t);
}

PM_SIMD_INLINE void tile_out(pm_simd *t, size_t at, double *const *row)
{
	transpose(t);
	for (int q = 0; q < 8; q++)
		pm_simd_store_any(row[q] + at, t[q]);
}

static void part_in(const double *const *row, size_t rows, size_t at, size_t count, pm_simd *t)
{
	memset(t, 0, 8 * sizeof *t);
	for (size_t q = 0; q < 8 && q < rows; q++)
		memcpy(&t[q], row[q] + at, count * sizeof(double));
	transpose(t);
}

static void part_out(pm_simd *t, size_t rows, size_t at, size_t count, double *const *row)
{
	transpose(t);
	for (size_t q = 0; q < 8 && q < rows; q++)
		memcpy(row[q] + at, &t[q], count * sizeof(double));
}

PM_SIMD_INLINE size_t beyond(size_t rows, size_t from) { return rows > from ? rows - from : 0; }

void pm_fft_rows_in(const double *const row[PM_FFT_LINES], size_t rows, size_t n, const size_t *at, double *block)
{
	for (size_t i = 0; i < n; i += 8)
		for (size_t from = 0; from < PM_FFT_LINES; from += 8) {
			pm_simd t[8];
			if (n - i >= 8 && rows == PM_FFT_LINES) {
				tile_in(row + from, i, t);
				for (size_t q = 0; q < 8; q++)
					pm_simd_store(block + (at ? at[i + q] : i + q) * PM_FFT_LINES + from, t[q]);
				continue;
			}
			part_in(row + from, beyond(rows, from), i, n - i < 8 ? n - i : 8, t);
			for (size_t q = 0; q < 8 && i + q < n; q++)
				pm_simd_store(block + (at ? at[i + q] : i + q) * PM_FFT_LINES + from, t[q]);
		}
}

void pm_fft_rows_out(const double *block, const size_t *at, size_t n, size_t rows, double *const row[PM_FFT_LINES])
{
	for (size_t i = 0; i < n; i += 8)
		for (size_t from = 0; from < PM_FFT_LINES; from += 8) {
			pm_simd t[8];
			if (n - i >= 8 && rows == PM_FFT_LINES) {
				for (size_t q = 0; q < 8; q++)
					t[q] = pm_simd_load(block + (at ? at[i + q] : i + q) * PM_FFT_LINES + from);
				tile_out(t, i, row + from);
				continue;
			}
			for (size_t q = 0; q < 8; q++)
				t[q] = i + q < n ? pm_simd_load(block + (at ? at[i + q] : i + q) * PM_FFT_LINES + from) : (pm_simd){0};
			part_out(t, beyond(rows, from), i, n - i < 8 ? n - i : 8, row + from);
		}
}

/* Frequencies k .. k+7 of the rows in the real lanes, or in the imaginary ones. */
PM_SIMD_INLINE void unpack(const struct pm_fft *f, const struct c8 *x, size_t k, bool second, pm_simd *re, pm_simd *im)
{
	size_t n = f->n, modes = n / 2 + 1;
	for (size_t q = 0; q < 8; q++) {
		bool there = k + q < modes; /* beyond: the last one again, cleared */
		const struct c8 *z = x + f->at[there ? k + q : 0], *y = x + f->at[there && k + q ? n - k - q : 0];
		double half = there ? 0.5 : 0;
		re[q] = half * (second ? z->im + y->im : z->re + y->re);
		im[q] = half * (second ? y->re - z->re : z->im - y->im);
	}
}

void pm_spectra_out(const struct pm_fft *f, const double *block, size_t rows, double *const row[PM_FFT_LINES])
{
	for (size_t k = 0; k < f->n / 2 + 1; k += 8)
		for (size_t from = 0; from < PM_FFT_LINES; from += 8) {
			pm_simd re[8], im[8];
			unpack(f, (const struct c8 *)block, k, from > 0, re, im);
			if (rows == PM_FFT_LINES) {
				tile_out(re, 2 * k, row + from);
				tile_out(im, 2 * k + 8, row + from);
			} else {
				part_out(re, beyond(rows, from), 2 * k, 8, row + from);
				part_out(im, beyond(rows, from), 2 * k + 8, 8, row + from);
			}
		}
}

void pm_spectra_in(const struct pm_fft *f, size_t rows, const double *const row[PM_FFT_LINES], double *block)
{
	size_t n = f->n, modes = n / 2 + 1;
	struct c8 *x = (struct c8 *)block;
	for (size_t k = 0; k < modes; k += 8) {
		pm_simd ar[8], ai[8], br[8], bi[8];
		if (rows == PM_FFT_LINES) {
			tile_in(row, 2 * k, ar);
			tile_in(row, 2 * k + 8, ai);
			tile_in(row + 8, 2 * k, br);
			tile_in(row + 8, 2 * k + 8, bi);
		} else {
			part_in(row, rows, 2 * k, 8, ar);
			part_in(row, rows, 2 * k + 8, 8, ai);
			part_in(row + 8, beyond(rows, 8), 2 * k, 8, br);
			part_in(row + 8, beyond(rows, 8), 2 * k + 8, 8, bi);
		}
		for (size_t q = 0; q < 8 && k + q < modes; q++) {
			size_t i = f->at[k + q], j = f->at[k + q ? n - k - q : 0];
			x[j] = (struct c8){ar[q] + bi[q], br[q] - ai[q]};
			x[i] = i == j ? (struct c8){ar[q], br[q]} : (struct c8){ar[q] - bi[q], ai[q] + br[q]};
		}
	}
}

void pm_stream(double *to, const double *from, size_t n)
{
	size_t i = 0;
#ifdef __AVX512F__
	for (; i < n && (uintptr_t)(to + i) % 64; i++)
		to[i] = from[i];
	for (; i + 8 <= n; i += 8)
		_mm512_stream_pd(to + i, _mm512_loadu_pd(from + i));
#endif
	memcpy(to + i, from + i, (n - i) * sizeof *to);
}

void pm_stream_end(void)
{
#ifdef __AVX512F__
	_mm_sfence();
#endif
}
