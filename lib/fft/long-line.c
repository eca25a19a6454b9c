/* A long real line as sixteen interleaved ones: with n = 16 m, node 16 j + q is element j of line q, so that the line is a block as it lies in memory, lines q
 * and q+8 as the real and imaginary part of a lane. Their spectra S_q of length m give that of the line by transforms of sixteen across the lanes,
 *   X_{k + m p} = sum_q w_16^{p q} w_n^{k q} S_q(k),   w_n = exp(-2 pi i/n),   k = 0 ... m/2, p = 0 ... 15,
 * of four and four: p = p1 + 4 p2, q = q1 + 4 q2. They are multiplied (p above 7 is frequency n - k - m p) and turned back in the L1 cache, W values of k
 * side by side. Source: Gentleman and Sande 1966; the split as in Bailey 1990 (four steps).
 * Cost: two transforms of m rows and one pass; memory 12 bytes a node for twiddles and factors. SPDX-License-Identifier: GPL-3.0-or-later */
#include "fft/butterfly.h"
#include "fft/long-line.h"

enum { L = PM_FFT_LINES, H = L / 2, W = PM_SIMD_PART };

static size_t groups(const struct pm_long_line *line) { return (line->n / L / 2 + W) / W; }

/* In a group of W values of k, for each p a vector of factors; half of them, since the split of the lanes leaves out its halves. Twiddles: for each q from 1 on
 * a vector of cosines and one of sines. Lanes beyond m/2 repeat it. */
int pm_long_line_init(struct pm_fft_plans *planner, size_t n, const double *u, struct pm_long_line *line)
{
	const size_t m = n / L;
	*line = (struct pm_long_line){.n = n, .fft = pm_fft(planner, m)};
	if (!line->fft)
		return -PM_DATA;
	line->factors = pm_alloc(groups(line) * L * W, sizeof *line->factors);
	line->twiddle = pm_alloc(groups(line) * (L - 1) * 2 * W, sizeof *line->twiddle);
	if (!line->factors || !line->twiddle)
		return -PM_DATA;
	for (size_t i = 0; i < groups(line) * W; i++) {
		const size_t k = i < m / 2 ? i : m / 2, group = i / W, lane = i % W;
		for (size_t p = 0; p < L; p++) {
			const size_t frequency = k + m * p;
			line->factors[(group * L + p) * W + lane] = 0.5 * u[2 * frequency <= n ? frequency : n - frequency];
		}
		for (size_t q = 1; q < L; q++) {
			double *w = line->twiddle + (group * (L - 1) + q - 1) * 2 * W + lane;
			pm_fft_circle(k * q, n, &w[0], &w[W]);
		}
	}
	return 0;
}

void pm_long_line_free(struct pm_long_line *line)
{
	pm_free(line->twiddle), pm_free(line->factors);
	*line = (struct pm_long_line){0};
}

/* Lane by lane times exp(-i x) forward, exp(+i x) back; w: W cosines, W sines. */
PM_SIMD_INLINE struct lanes twisted_each(struct lanes a, const double *w, bool back)
{
	const pm_simd_part c = *(const pm_simd_part_at *)w, s = *(const pm_simd_part_at *)(w + W);
	return back ? (struct lanes){a.re * c - a.im * s, a.im * c + a.re * s} : (struct lanes){a.re * c + a.im * s, a.im * c - a.re * s};
}

/* Forward from a[q1 + 4 q2] to a[4 p1 + p2], where frequency p1 + 4 p2 is then; back from there. */
PM_SIMD_INLINE void dft16(struct lanes *a, bool back)
{
	static const double w[4][4][2] = {{{1, 0}, {1, 0}, {1, 0}, {1, 0}},
		{{1, 0}, {0.92387953251128675613, 0.38268343236508977173}, {0.70710678118654752440, 0.70710678118654752440}, {0.38268343236508977173,
			0.92387953251128675613}},
		{{1, 0}, {0.70710678118654752440, 0.70710678118654752440}, {0, 1}, {-0.70710678118654752440, 0.70710678118654752440}},
		{{1, 0}, {0.38268343236508977173, 0.92387953251128675613}, {-0.70710678118654752440, 0.70710678118654752440}, {-0.92387953251128675613,
			-0.38268343236508977173}}};
	PM_SIMD_UNROLL
	for (int p = 0; p < 4 && back; p++) {
		dft4(&a[4 * p], &a[4 * p + 1], &a[4 * p + 2], &a[4 * p + 3], true);
		for (int q = 1; q < 4 && p; q++)
			a[4 * p + q] = twisted(a[4 * p + q], w[p][q], true);
	}
	PM_SIMD_UNROLL
	for (int q = 0; q < 4; q++) {
		dft4(&a[q], &a[4 + q], &a[8 + q], &a[12 + q], back);
		for (int p = 1; p < 4 && q && !back; p++)
			a[4 * p + q] = twisted(a[4 * p + q], w[p][q], false);
	}
	PM_SIMD_UNROLL
	for (int p = 0; p < 4 && !back; p++)
		dft4(&a[4 * p], &a[4 * p + 1], &a[4 * p + 2], &a[4 * p + 3], false);
}

/* Rows of a block, and the part of it that is meant. */
PM_SIMD_INLINE void tile(double *const *row, size_t part, pm_simd_part *t)
{
	PM_SIMD_UNROLL
	for (int i = 0; i < W; i++)
		t[i] = *(const pm_simd_part_at *)(row[i] + part);
	pm_simd_transpose(t);
}

PM_SIMD_INLINE void tile_back(pm_simd_part *t, size_t rows, double *const *row, size_t part)
{
	pm_simd_transpose(t);
	for (size_t i = 0; i < rows; i++)
		*(pm_simd_part_at *)(row[i] + part) = t[i];
}

/* Rows k and m-k to twice the spectra of the sixteen lines. */
PM_SIMD_INLINE void lines_of(double *const *row, double *const *partner, struct lanes *a)
{
	PM_SIMD_UNROLL
	for (size_t from = 0; from < H; from += W) {
		pm_simd_part zr[W], zi[W], yr[W], yi[W];
		tile(row, from, zr), tile(row, from + H, zi), tile(partner, from, yr), tile(partner, from + H, yi);
		PM_SIMD_UNROLL
		for (size_t q = 0; q < W; q++) {
			a[from + q] = (struct lanes){zr[q] + yr[q], zi[q] - yi[q]};
			a[from + q + H] = (struct lanes){zi[q] + yi[q], yr[q] - zr[q]};
		}
	}
}

/* Back, the first `rows` of them. */
PM_SIMD_INLINE void rows_of(struct lanes *a, size_t rows, double *const *row, double *const *partner)
{
	PM_SIMD_UNROLL
	for (size_t from = 0; from < H; from += W) {
		pm_simd_part zr[W], zi[W], yr[W], yi[W];
		PM_SIMD_UNROLL
		for (size_t q = 0; q < W; q++) {
			const struct lanes x = a[from + q], y = a[from + q + H];
			zr[q] = x.re - y.im, zi[q] = x.im + y.re;
			yr[q] = x.re + y.im, yi[q] = y.re - x.im;
		}
		tile_back(yr, rows, partner, from), tile_back(yi, rows, partner, from + H);
		tile_back(zr, rows, row, from), tile_back(zi, rows, row, from + H);
	}
}

/* Frequencies k ... k+W-1 of the lines, as far as there are any up to m/2. Returns the first one of the line, before it is multiplied. */
static double across(const struct pm_long_line *line, size_t k, double factor, double *block)
{
	const size_t m = line->n / L, left = m / 2 + 1 - k;
	const double *w = line->twiddle + k * (L - 1) * 2, *u = line->factors + k * L;
	double *row[W], *partner[W];
	struct lanes a[L];
	for (size_t i = 0; i < W; i++) {
		const size_t own = i < left ? k + i : m / 2;
		row[i] = block + line->fft->at[own] * L, partner[i] = block + line->fft->at[m - own] * L;
	}
	lines_of(row, partner, a);
	for (int q = 1; q < L; q++)
		a[q] = twisted_each(a[q], w + (q - 1) * 2 * W, false);
	dft16(a, false);
	const double first = 0.5 * a[0].re[0];
	for (int p1 = 0; p1 < 4; p1++)
		for (int p2 = 0; p2 < 4; p2++) {
			const pm_simd_part times = factor * *(const pm_simd_part_at *)(u + (p1 + 4 * p2) * W);
			struct lanes *x = &a[4 * p1 + p2];
			*x = (struct lanes){times * x->re, times * x->im};
		}
	dft16(a, true);
	for (int q = 1; q < L; q++)
		a[q] = twisted_each(a[q], w + (q - 1) * 2 * W, true);
	rows_of(a, left < W ? left : W, row, partner);
	return first;
}

double pm_long_line_times(const struct pm_long_line *line, double factor, double *x)
{
	pm_fft_forward(line->fft, x);
	const double sum = across(line, 0, factor, x);
	for (size_t k = W; k <= line->n / L / 2; k += W)
		across(line, k, factor, x);
	pm_fft_backward(line->fft, x);
	return sum;
}
