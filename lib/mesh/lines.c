/* Real transforms and spectral derivatives along an axis, by complex FFTs of pairs of real lines a + i b.
 * With length N = n (periodic) or 2n (images) and F the complex transform of the pair,
 *   Hartley: H_k = (1+i)/2 F_k + (1-i)/2 F_{N-k};  DST-I: odd images, S_k = i F_k;  DCT-I: even images, C_k = F_k;
 *   an even operator with eigenvalues u_k on a and v_k on b: F'_k = (u+v)/2 F_k + (u-v)/2 conj F_{N-k}.
 * Source: Bracewell 1983 (Hartley); Swarztrauber 1977 (sine and cosine transforms by images).
 * Cost: n log n per line, twice that with images.
 * SPDX-License-Identifier: GPL-3.0-or-later */
#include <string.h>

#include "mesh/lines.h"

enum { L = PM_LANES, H = PM_LANES / 2 };

int pm_line_init(struct pm_planner *p, enum pm_face face, size_t n, struct pm_line *line)
{
	*line = (struct pm_line){.face = face, .n = n};
	line->length = face == PM_PERIODIC ? n : 2 * n;
	line->first = face == PM_WALL;
	line->count = face == PM_PERIODIC ? n : face == PM_WALL ? n - 1 : n + 1;
	line->fft = pm_fft(p, line->length);
	return line->fft ? 0 : -PM_DATA;
}

void pm_line_extend(const struct pm_line *l, bool odd, double *block)
{
	if (l->face == PM_PERIODIC)
		return;
	if (l->face == PM_OPEN) {
		if (l->count < l->length)
			memset(block + l->count * L, 0, (l->length - l->count) * L * sizeof *block);
		return;
	}
	if (odd) {
		memset(block, 0, L * sizeof *block);
		memset(block + l->n * L, 0, L * sizeof *block);
	}
	double sign = odd ? -1 : 1;
	for (size_t i = 1; i < l->n; i++)
		for (int q = 0; q < L; q++)
			block[(l->length - i) * L + q] = sign * block[i * L + q];
}

static void hartley(const struct pm_line *l, double *block)
{
	for (size_t k = 1; k < l->length - k; k++) {
		double *a = block + l->fft->at[k] * L, *b = block + l->fft->at[l->length - k] * L;
		for (int q = 0; q < H; q++) {
			double sr = 0.5 * (a[q] + b[q]), si = 0.5 * (a[q + H] + b[q + H]);
			double dr = 0.5 * (a[q] - b[q]), di = 0.5 * (a[q + H] - b[q + H]);
			a[q] = sr - di, a[q + H] = si + dr;
			b[q] = sr + di, b[q + H] = si - dr;
		}
	}
}

void pm_line_real(const struct pm_line *l, double *block)
{
	pm_line_extend(l, l->face == PM_WALL, block);
	pm_fft_forward(l->fft, block);
	if (l->face == PM_PERIODIC)
		hartley(l, block);
	for (size_t k = 1; k < l->n && l->face == PM_WALL; k++) {
		double *a = block + l->fft->at[k] * L;
		for (int q = 0; q < H; q++) {
			double re = a[q];
			a[q] = -a[q + H];
			a[q + H] = re;
		}
	}
}

/* Frequencies k and N-k of lines whose eigenvalues differ between a and b. */
static void pair_times(const double *u, double *a, double *b)
{
	for (int q = 0; q < H; q++) {
		double s = 0.5 * (u[q] + u[q + H]), d = 0.5 * (u[q] - u[q + H]);
		double ar = a[q], ai = a[q + H], br = b[q], bi = b[q + H];
		a[q] = s * ar + d * br, a[q + H] = s * ai - d * bi;
		b[q] = s * br + d * ar, b[q + H] = s * bi - d * ai;
	}
}

void pm_line_solve(const struct pm_line *l, double factor, const double *lambda, const double *mine, bool singular, double *zero, double *block)
{
	pm_line_extend(l, l->face == PM_WALL, block);
	pm_fft_forward(l->fft, block);
	*zero = block[0];
	for (size_t k = l->first; k < l->first + l->count && k <= l->length - k; k++) {
		double u[L], *a = block + l->fft->at[k] * L, *b = block + l->fft->at[k ? l->length - k : 0] * L;
		for (int q = 0; q < L; q++)
			u[q] = factor / (lambda[k - l->first] + mine[q]);
		if (k == 0 && singular)
			u[0] = 0;
		if (a == b) /* F_0 and F_{N/2}: a and b are its real and imaginary parts */
			for (int q = 0; q < L; q++)
				a[q] *= u[q];
		else
			pair_times(u, a, b);
	}
	if (l->face == PM_WALL)
		for (int q = 0; q < L; q++)
			block[q] = block[l->fft->at[l->n] * L + q] = 0;
	pm_fft_backward(l->fft, block);
}

void pm_line_derivative(const struct pm_line *l, double h, bool odd, double *block)
{
	size_t n = l->length;
	pm_line_extend(l, odd, block);
	pm_fft_forward(l->fft, block);
	memset(block, 0, L * sizeof *block);
	if (n % 2 == 0)
		memset(block + l->fft->at[n / 2] * L, 0, L * sizeof *block);
	for (size_t k = 1; k < n - k; k++) {
		double w = 2 * pm_pi * (double)k / ((double)n * h) / (double)n;
		double *a = block + l->fft->at[k] * L, *b = block + l->fft->at[n - k] * L;
		for (int q = 0; q < H; q++) {
			double ar = a[q], br = b[q];
			a[q] = -w * a[q + H], a[q + H] = w * ar;
			b[q] = w * b[q + H], b[q + H] = -w * br;
		}
	}
	pm_fft_backward(l->fft, block);
}

void pm_line_second(const struct pm_line *l, double h, bool odd, double *block)
{
	size_t n = l->length;
	pm_line_extend(l, odd, block);
	pm_fft_forward(l->fft, block);
	for (size_t k = 0; k < n; k++) {
		double w = 2 * pm_pi * (double)(k <= n - k ? k : n - k) / ((double)n * h), *a = block + l->fft->at[k] * L;
		for (int q = 0; q < L; q++)
			a[q] *= -w * w / (double)n;
	}
	pm_fft_backward(l->fft, block);
}
