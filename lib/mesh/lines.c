/* Real transforms and spectral derivatives along an axis, by complex FFTs of packed pairs of real lines.
 * A real-linear map of a + i b is the map of a plus i times the map of b, so two neighbouring lines travel as one complex line and the
 * SIMD transforms of FFTW do the work of its scalar r2r codelets. With length N = n (periodic) or 2n (images),
 *   Hartley: H_k = (1+i)/2 F_k + (1-i)/2 F_{N-k};  DST-I: odd images, S_k = i F_k;  DCT-I: even images, C_k = F_k.
 * Source: Bracewell 1983 (Hartley); Swarztrauber 1977 (sine and cosine transforms by images).
 * Cost: n log n per line, twice that with images.
 * SPDX-License-Identifier: GPL-3.0-or-later */
#include <string.h>

#include "mesh/lines.h"

enum { L = PM_LANES };

int pm_line_init(struct pm_planner *p, enum pm_face face, size_t n, struct pm_line *line)
{
	*line = (struct pm_line){.face = face, .n = n};
	line->length = face == PM_PERIODIC ? n : 2 * n;
	line->first = face == PM_WALL;
	line->count = face == PM_PERIODIC ? n : face == PM_WALL ? n - 1 : n + 1;
	if (line->length > 1 && !(line->forward = pm_plan(p, PM_BLOCK_FORWARD, line->length)))
		return -PM_DATA;
	return 0;
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

static void transform(const struct pm_line *l, double *block)
{
	if (l->forward)
		fftw_execute_dft(l->forward, (fftw_complex *)block, (fftw_complex *)block);
}

static void hartley(const struct pm_line *l, double *block)
{
	for (size_t k = 1; k < l->length - k; k++) {
		double *a = block + k * L, *b = block + (l->length - k) * L;
		for (int q = 0; q < L; q += 2) {
			double sr = 0.5 * (a[q] + b[q]), si = 0.5 * (a[q + 1] + b[q + 1]);
			double dr = 0.5 * (a[q] - b[q]), di = 0.5 * (a[q + 1] - b[q + 1]);
			a[q] = sr - di, a[q + 1] = si + dr;
			b[q] = sr + di, b[q + 1] = si - dr;
		}
	}
}

void pm_line_real(const struct pm_line *l, double *block)
{
	pm_line_extend(l, l->face == PM_WALL, block);
	transform(l, block);
	if (l->face == PM_PERIODIC)
		hartley(l, block);
	if (l->face == PM_WALL)
		for (size_t k = 1; k < l->n; k++)
			for (int q = 0; q < L; q += 2) {
				double re = block[k * L + q];
				block[k * L + q] = -block[k * L + q + 1];
				block[k * L + q + 1] = re;
			}
}

/* The inverse transform of a spectrum is the forward one read backwards: k -> N-k is folded into the factors, so one plan serves. */
void pm_line_derivative(const struct pm_line *l, double h, bool odd, double *block)
{
	size_t n = l->length;
	pm_line_extend(l, odd, block);
	transform(l, block);
	for (int q = 0; q < L; q++)
		block[q] = 0;
	if (n % 2 == 0)
		memset(block + n / 2 * L, 0, L * sizeof *block);
	for (size_t k = 1; k < n - k; k++) {
		double w = 2 * pm_pi * (double)k / ((double)n * h) / (double)n;
		double *a = block + k * L, *b = block + (n - k) * L;
		for (int q = 0; q < L; q += 2) {
			double ar = -w * a[q + 1], ai = w * a[q], br = w * b[q + 1], bi = -w * b[q];
			a[q] = br, a[q + 1] = bi;
			b[q] = ar, b[q + 1] = ai;
		}
	}
	transform(l, block);
}

void pm_line_second(const struct pm_line *l, double h, bool odd, double *block)
{
	size_t n = l->length;
	pm_line_extend(l, odd, block);
	transform(l, block);
	for (int q = 0; q < L; q++)
		block[q] = 0;
	for (size_t k = 1; k <= n - k; k++) {
		double w = 2 * pm_pi * (double)k / ((double)n * h);
		w = -w * w / (double)n;
		double *a = block + k * L, *b = block + (n - k) * L;
		for (int q = 0; q < L; q++) {
			double t = w * a[q];
			a[q] = w * b[q];
			b[q] = t;
		}
	}
	transform(l, block);
}
