/* Between rows in memory and lanes in a block: tiles of 8 x 8 (or 4 x 4, 2 x 2: what registers hold) transposed, with the split of a pair transform into the
 * spectra of its two rows where they are complex: rows a and b, Z = F(a + i b), A_k = (Z_k + conj Z_{n-k})/2, B_k = (Z_k - conj Z_{n-k})/(2 i).
 * SPDX-License-Identifier: GPL-3.0-or-later */
#include <string.h>

#include "fft/fft-block.h"
#include "fft/fft-vector.h"

enum { W = PM_SIMD_PART };

enum { L = PM_FFT_LINES, H = L / 2, REACH = 64 }; /* REACH: elements of all lines that are moved before the next ones, in the L1 cache */

/* W rows, W elements of each, transposed; fewer at the ends. */
PM_SIMD_INLINE void tile_in(const double *const *row, size_t at, pm_simd_part *t)
{
	PM_SIMD_UNROLL
	for (int q = 0; q < W; q++)
		memcpy(&t[q], row[q] + at, sizeof *t);
	pm_simd_transpose(t);
}

PM_SIMD_INLINE void tile_out(pm_simd_part *t, size_t at, double *const *row)
{
	pm_simd_transpose(t);
	PM_SIMD_UNROLL
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
PM_SIMD_INLINE size_t least(size_t a, size_t b) { return a < b ? a : b; }

/* The lanes from `from` on of element i, which has its row in the block. */
PM_SIMD_INLINE pm_simd_part_at *lane(const double *block, const size_t *at, size_t i, size_t from)
{
	return (pm_simd_part_at *)(block + (at ? at[i] : i) * L + from);
}

/* Whole tiles of elements i to end-1 of W lines. */
PM_SIMD_INLINE void lines_in(const double *const *row, size_t i, size_t end, size_t from, const size_t *at, double *block)
{
	const double *own[W];
	memcpy(own, row, sizeof own);
	for (; i < end; i += W) {
		pm_simd_part t[W];
		tile_in(own, i, t);
		PM_SIMD_UNROLL
		for (size_t q = 0; q < W; q++)
			*lane(block, at, i + q, from) = t[q];
	}
}

PM_SIMD_INLINE void lines_out(const double *block, const size_t *at, size_t i, size_t end, size_t from, double *const *row)
{
	double *own[W];
	memcpy(own, row, sizeof own);
	for (; i < end; i += W) {
		pm_simd_part t[W];
		PM_SIMD_UNROLL
		for (size_t q = 0; q < W; q++)
			t[q] = *lane(block, at, i + q, from);
		tile_out(t, i, own);
	}
}

void pm_fft_rows_in(const double *const row[PM_FFT_LINES], size_t rows, size_t n, const size_t *at, double *block)
{
	const size_t whole = rows == L ? n - n % W : 0;
	for (size_t i = 0; i < whole; i += REACH)
		for (size_t from = 0; from < L; from += W)
			if (at)
				lines_in(row + from, i, least(i + REACH, whole), from, at, block);
			else
				lines_in(row + from, i, least(i + REACH, whole), from, NULL, block);
	for (size_t i = whole; i < n; i += W)
		for (size_t from = 0; from < L; from += W) {
			pm_simd_part t[W];
			part_in(row + from, beyond(rows, from), i, least(n - i, W), t);
			for (size_t q = 0; q < W && i + q < n; q++)
				*lane(block, at, i + q, from) = t[q];
		}
}

void pm_fft_rows_out(const double *block, const size_t *at, size_t n, size_t rows, double *const row[PM_FFT_LINES])
{
	const size_t whole = rows == L ? n - n % W : 0;
	for (size_t i = 0; i < whole; i += REACH)
		for (size_t from = 0; from < L; from += W)
			if (at)
				lines_out(block, at, i, least(i + REACH, whole), from, row + from);
			else
				lines_out(block, NULL, i, least(i + REACH, whole), from, row + from);
	for (size_t i = whole; i < n; i += W)
		for (size_t from = 0; from < L; from += W) {
			pm_simd_part t[W];
			for (size_t q = 0; q < W; q++)
				t[q] = i + q < n ? (pm_simd_part)*lane(block, at, i + q, from) : (pm_simd_part){0};
			part_out(t, beyond(rows, from), i, least(n - i, W), row + from);
		}
}

/* Real and imaginary part of frequency k of the rows in the real lanes, or in the imaginary ones. */
PM_SIMD_INLINE void unpack(const struct pm_fft *f, const struct c8 *x, size_t k, bool second, pm_simd_part *re, pm_simd_part *im)
{
	const struct c8 *z = x + f->at[k], *y = x + f->at[f->n - k];
	*re = 0.5 * (second ? z->im + y->im : z->re + y->re);
	*im = 0.5 * (second ? y->re - z->re : z->im - y->im);
}

/* Where the real part of frequency k is in a row of modes: eight of these, then their imaginary parts. */
PM_SIMD_INLINE size_t mode(size_t k) { return 2 * k - k % 8; }

/* Frequencies k .. k+W-1 of W rows; shared: frequency n/2, which is real, is the imaginary part of frequency 0. */
PM_SIMD_INLINE void spectrum(const struct pm_fft *f, const struct c8 *x, size_t k, bool second, bool shared, pm_simd_part *re, pm_simd_part *im)
{
	PM_SIMD_UNROLL
	for (size_t q = 0; q < W; q++)
		unpack(f, x, k + q, second, &re[q], &im[q]);
	if (shared && k == 0)
		im[0] = second ? x[f->at[f->n / 2]].im : x[f->at[f->n / 2]].re;
}

PM_SIMD_INLINE void spectra_out(const struct pm_fft *f, const struct c8 *x, bool second, bool shared, size_t end, double *const *row)
{
	double *own[W];
	memcpy(own, row, sizeof own);
	for (size_t k = 0; k < end; k += W) {
		pm_simd_part re[W], im[W];
		spectrum(f, x, k, second, shared, re, im);
		tile_out(re, mode(k), own);
		tile_out(im, mode(k) + 8, own);
	}
}

/* Beyond the last frequency there are zeros. */
static void spectra_end(const struct pm_fft *f, const struct c8 *x, bool second, bool shared, size_t k, size_t rows, double *const *row)
{
	const size_t modes = f->n / 2 + 1 - shared;
	for (; k < (modes + 7) / 8 * 8; k += W) {
		pm_simd_part re[W] = {{0}}, im[W] = {{0}};
		for (size_t q = 0; q < W && k + q < modes; q++)
			unpack(f, x, k + q, second, &re[q], &im[q]);
		if (shared && k == 0)
			im[0] = second ? x[f->at[f->n / 2]].im : x[f->at[f->n / 2]].re;
		part_out(re, rows, mode(k), W, row);
		part_out(im, rows, mode(k) + 8, W, row);
	}
}

void pm_spectra_out(const struct pm_fft *f, const double *block, size_t rows, bool shared, double *const row[PM_FFT_LINES])
{
	const size_t modes = f->n / 2 + 1 - shared, whole = rows == L ? modes - modes % W : 0;
	for (size_t from = 0; from < H; from += W) {
		const struct c8 *x = part_of(block, (int)(from / W));
		spectra_out(f, x, false, shared, whole, row + from);
		spectra_out(f, x, true, shared, whole, row + from + H);
		spectra_end(f, x, false, shared, whole, beyond(rows, from), row + from);
		spectra_end(f, x, true, shared, whole, beyond(rows, from + H), row + from + H);
	}
}

/* Frequency k of pairs of rows. */
PM_SIMD_INLINE void pack(const struct pm_fft *f, size_t k, pm_simd_part ar, pm_simd_part ai, pm_simd_part br, pm_simd_part bi, struct c8 *x)
{
	put(x + f->at[f->n - k], (struct lanes){ar + bi, br - ai});
	put(x + f->at[k], (struct lanes){ar - bi, ai + br});
}

/* Those that are their own partners. */
PM_SIMD_INLINE void pack_real(const struct pm_fft *f, bool shared, pm_simd_part ar, pm_simd_part ai, pm_simd_part br, pm_simd_part bi, struct c8 *x)
{
	put(x + f->at[0], (struct lanes){ar, br});
	if (shared)
		put(x + f->at[f->n / 2], (struct lanes){ai, bi});
}

PM_SIMD_INLINE void spectra_in(const struct pm_fft *f, const double *const *first, const double *const *second, bool shared, size_t end, struct c8 *x)
{
	const double *a[W], *b[W];
	memcpy(a, first, sizeof a), memcpy(b, second, sizeof b);
	for (size_t k = 0; k < end; k += W) {
		pm_simd_part ar[W], ai[W], br[W], bi[W];
		tile_in(a, mode(k), ar), tile_in(b, mode(k) + 8, bi);
		tile_in(b, mode(k), br), tile_in(a, mode(k) + 8, ai);
		PM_SIMD_UNROLL
		for (size_t q = 0; q < W; q++)
			pack(f, k + q, ar[q], ai[q], br[q], bi[q], x);
		if (k == 0)
			pack_real(f, shared, ar[0], ai[0], br[0], bi[0], x);
	}
}

static void spectra_in_end(const struct pm_fft *f, size_t rows, const double *const *row, size_t from, bool shared, size_t k, struct c8 *x)
{
	const size_t modes = f->n / 2 + 1 - shared;
	for (; k < modes; k += W) {
		pm_simd_part ar[W], ai[W], br[W], bi[W];
		part_in(row + from, beyond(rows, from), mode(k), W, ar);
		part_in(row + from, beyond(rows, from), mode(k) + 8, W, ai);
		part_in(row + from + H, beyond(rows, from + H), mode(k), W, br);
		part_in(row + from + H, beyond(rows, from + H), mode(k) + 8, W, bi);
		for (size_t q = 0; q < W && k + q < modes; q++)
			if (2 * (k + q) == f->n)
				put(x + f->at[k + q], (struct lanes){ar[q], br[q]});
			else
				pack(f, k + q, ar[q], ai[q], br[q], bi[q], x);
		if (k == 0)
			pack_real(f, shared, ar[0], ai[0], br[0], bi[0], x);
	}
}

void pm_spectra_in(const struct pm_fft *f, size_t rows, const double *const row[PM_FFT_LINES], bool shared, double *block)
{
	const size_t modes = f->n / 2 + (f->n % 2 && !shared), whole = rows == L ? modes - modes % W : 0;
	for (size_t from = 0; from < H; from += W) {
		struct c8 *x = part_of(block, (int)(from / W));
		spectra_in(f, row + from, row + from + H, shared, whole, x);
		spectra_in_end(f, rows, row, from, shared, whole, x);
	}
}

void pm_stream(double *to, const double *from, size_t n)
{
	size_t i = 0;
#ifdef __SSE2__
	for (; i < n && (uintptr_t)(to + i) % 64; i++)
		to[i] = from[i];
	for (; i + 8 <= n; i += 8) /* whole lines of the cache */
		PM_SIMD_UNROLL
		for (size_t q = 0; q < 8; q += W) {
			pm_simd_part v;
			memcpy(&v, from + i + q, sizeof v);
			pm_simd_part_past(to + i + q, v);
		}
#endif
	memcpy(to + i, from + i, (n - i) * sizeof *to);
}

void pm_stream_end(void) { pm_simd_past_end(); }
