/* Real transforms and spectral derivatives along an axis, by complex FFTs of pairs of real lines a + i b.
 * With length N = n (periodic) or 2n (images) and F the complex transform of the pair,
 *   Hartley: H_k = (1+i)/2 F_k + (1-i)/2 F_{N-k};  DST-I: odd images, S_k = i F_k;  DCT-I: even images, C_k = F_k.
 * A wall at one end and neumann at the other: images that change sign after 2n, waves of k + 1/2 half turns; times exp(-i pi j/N) they have
 *   period 2n: F is the transform of that, S_k = i F_k with the wall below, C_k = F_k with the wall above; frequencies k and N-1-k are conjugate.
 * Source: Bracewell 1983 (Hartley); Swarztrauber 1977 (sine, cosine and quarter-wave transforms by images).
 * Cost: n log n per line, twice that with images.
 * SPDX-License-Identifier: GPL-3.0-or-later */
#include <string.h>

#include "fft/axis-transform.h"

enum { L = PM_FFT_LINES, H = PM_FFT_LINES / 2 };

static struct pm_transform line_of(const enum pm_face face[2], size_t n)
{
	bool periodic = face[0] == PM_PERIODIC, wall[2] = {face[0] == PM_WALL, face[1] == PM_WALL};
	int open = (face[0] == PM_OPEN) + (face[1] == PM_OPEN);
	struct pm_transform line = {.face = {face[0], face[1]}, .n = n, .length = periodic ? n : open == 1 ? 4 * n : 2 * n};
	line.shifted = !periodic && !open && wall[0] != wall[1];
	line.first = wall[0];
	line.count = periodic ? n : n + 1 - wall[0] - wall[1];
	line.row = line.first + (open == 1 && face[0] == PM_OPEN ? n : 0);
	line.least = open == 1 ? wall[0] || wall[1] : wall[0] && wall[1];
	line.modes = open == 2 ? line.length : open ? 2 * n + 1 - 2 * line.least : line.count;
	return line;
}

int pm_transform_init(struct pm_fft_plans *p, const enum pm_face face[2], size_t n, struct pm_transform *line)
{
	*line = line_of(face, n);
	line->fft = line->shifted ? pm_fft_shifted(p, line->length) : pm_fft(p, line->length);
	line->map = line->fft ? line->fft->at + line->least : NULL;
	return line->fft ? 0 : -PM_DATA;
}

int pm_transform_init_real(struct pm_fft_plans *p, const enum pm_face face[2], size_t n, struct pm_transform *line)
{
	bool wall[2] = {face[0] == PM_WALL, face[1] == PM_WALL}, neumann[2] = {face[0] == PM_NEUMANN, face[1] == PM_NEUMANN};
	if (!(wall[0] || neumann[0]) || !(wall[1] || neumann[1]))
		return pm_transform_init(p, face, n, line);
	*line = line_of(face, n);
	line->fold = wall[0] ? (wall[1] ? PM_WAVES_SINE : PM_WAVES_QUARTER_SINE) : wall[1] ? PM_WAVES_QUARTER_COSINE : PM_WAVES_COSINE;
	line->fft = pm_fft_sine_cosine(p, n);
	line->map = line->fft ? line->fft->fold[line->fold] : NULL;
	return line->fft ? 0 : -PM_DATA;
}

static bool half_open(const struct pm_transform *l)
{
	return (l->face[0] == PM_OPEN) != (l->face[1] == PM_OPEN);
}

/* The second half of a line from the first. */
static void images(const struct pm_transform *l, bool flip, double *block)
{
	size_t half = l->length / 2;
	bool wall[2] = {l->face[0] == PM_WALL, l->face[1] == PM_WALL};
	if (half_open(l))
		wall[0] = wall[1] = wall[0] || wall[1];
	if (wall[0] != flip)
		memset(block, 0, L * sizeof *block);
	if (wall[1] != flip)
		memset(block + half * L, 0, L * sizeof *block);
	double sign = wall[1] != flip ? -1 : 1;
	for (size_t i = 1; i < half; i++)
		for (int q = 0; q < L; q++)
			block[(l->length - i) * L + q] = sign * block[i * L + q];
}

void pm_transform_extend(const struct pm_transform *l, bool flip, double *block)
{
	if (l->face[0] == PM_PERIODIC)
		return;
	bool both = l->face[0] == PM_OPEN && l->face[1] == PM_OPEN;
	size_t end = l->row + l->count, space = both ? l->length : l->length / 2 + 1;
	if (both || half_open(l)) {
		memset(block, 0, l->row * L * sizeof *block);
		if (end < space)
			memset(block + end * L, 0, (space - end) * L * sizeof *block);
	}
	if (!both)
		images(l, flip, block);
}

/* Rows [from, from+count) of a block times exp(-i pi j/N), or exp(+i pi j/N) back. */
static void twist(const double *half, size_t from, size_t count, bool back, double *block)
{
	for (size_t j = from; j < from + count; j++) {
		double c = half[2 * j], s = back ? -half[2 * j + 1] : half[2 * j + 1], *a = block + j * L;
		for (int q = 0; q < H; q++) {
			double re = a[q], im = a[q + H];
			a[q] = re * c + im * s, a[q + H] = im * c - re * s;
		}
	}
}

/* Nodes of a line open at both ends, which has zeros behind them. */
static struct pm_fft_place place(const struct pm_transform *l, double *block)
{
	const bool both = l->face[0] == PM_OPEN && l->face[1] == PM_OPEN;
	return (struct pm_fft_place){block, L, both ? l->count : 0, NULL};
}

void pm_transform_forward(const struct pm_transform *l, bool flip, double *block)
{
	if (place(l, block).some) {
		pm_fft_forward_moving(l->fft, place(l, block), block, (struct pm_fft_place){block, L, 0, NULL});
		return;
	}
	pm_transform_extend(l, flip, block);
	if (l->shifted)
		twist(l->fft->half, 0, l->length, false, block);
	pm_fft_forward(l->fft, block);
}

void pm_transform_backward(const struct pm_transform *l, double *block)
{
	pm_fft_backward_moving(l->fft, (struct pm_fft_place){block, L, 0, NULL}, block, place(l, block));
	if (l->shifted)
		twist(l->fft->half, 0, l->n + 1, true, block);
}

/* H_k = (1 + i)/2 F_k + (1 - i)/2 F_{N-k}; back F_k = (1 - i)/2 H_k + (1 + i)/2 H_{N-k}. */
static void hartley(const struct pm_transform *l, bool back, double *block)
{
	double turn = back ? -0.5 : 0.5;
	for (size_t k = 1; k < l->length - k; k++) {
		double *a = block + l->fft->at[k] * L, *b = block + l->fft->at[l->length - k] * L;
		for (int q = 0; q < H; q++) {
			double sr = 0.5 * (a[q] + b[q]), si = 0.5 * (a[q + H] + b[q + H]);
			double dr = turn * (a[q] - b[q]), di = turn * (a[q + H] - b[q + H]);
			a[q] = sr - di, a[q + H] = si + dr;
			b[q] = sr + di, b[q + H] = si - dr;
		}
	}
}

static bool whole(const struct pm_transform *l)
{
	return l->face[0] == PM_PERIODIC || (l->face[0] == PM_OPEN && l->face[1] == PM_OPEN);
}

/* Modes times i. */
static void turn(const struct pm_transform *l, double *block)
{
	for (size_t m = 0; m < l->modes; m++) {
		double *a = block + l->map[m] * L;
		for (int q = 0; q < H; q++) {
			double re = a[q];
			a[q] = -a[q + H];
			a[q + H] = re;
		}
	}
}

static bool sines(const struct pm_transform *l)
{
	return l->face[0] == PM_WALL || (half_open(l) && l->face[1] == PM_WALL);
}

void pm_transform_real(const struct pm_transform *l, double *block)
{
	if (l->fold) {
		pm_sine_cosine(l->fold, l->fft, block);
		return;
	}
	pm_transform_forward(l, false, block);
	if (whole(l))
		hartley(l, false, block);
	else if (sines(l))
		turn(l, block);
}

/* From sines or cosines the frequencies that they are made of: F_k = C_k = F_N-k, F_k = -i S_k = -F_N-k. */
static void mirror(const struct pm_transform *l, double *block)
{
	double sign = sines(l) ? -1 : 1;
	if (sign < 0)
		turn(l, block);
	if (l->least) {
		memset(block, 0, L * sizeof *block);
		memset(block + l->fft->at[l->length / 2] * L, 0, L * sizeof *block);
	}
	for (size_t k = l->least; k < l->least + l->modes; k++) {
		double *a = block + l->fft->at[k] * L, *b = block + l->fft->at[pm_transform_partner(l, k)] * L;
		for (int q = 0; q < L && a != b; q++) {
			b[q] = a[q];
			a[q] *= sign;
		}
	}
}

void pm_transform_real_back(const struct pm_transform *l, double *block)
{
	if (l->fold) {
		pm_sine_cosine_back(l->fold, l->fft, block);
		return;
	}
	if (whole(l))
		hartley(l, true, block);
	else
		mirror(l, block);
	pm_transform_backward(l, block);
}

void pm_transform_derivative(const struct pm_transform *l, double h, bool flip, double *block)
{
	size_t n = l->length;
	pm_transform_forward(l, flip, block);
	if (!l->shifted)
		memset(block, 0, L * sizeof *block);
	if (!l->shifted && n % 2 == 0)
		memset(block + l->fft->at[n / 2] * L, 0, L * sizeof *block);
	for (size_t k = !l->shifted; k < pm_transform_partner(l, k); k++) {
		double w = 2 * pm_pi * ((double)k + 0.5 * l->shifted) / ((double)n * h) / (double)n;
		double *a = block + l->fft->at[k] * L, *b = block + l->fft->at[pm_transform_partner(l, k)] * L;
		for (int q = 0; q < H; q++) {
			double ar = a[q], br = b[q];
			a[q] = -w * a[q + H], a[q + H] = w * ar;
			b[q] = w * b[q + H], b[q + H] = -w * br;
		}
	}
	pm_transform_backward(l, block);
}

void pm_transform_second(const struct pm_transform *l, double h, bool flip, double *block)
{
	size_t n = l->length;
	pm_transform_forward(l, flip, block);
	for (size_t k = 0; k < n; k++) {
		size_t p = pm_transform_partner(l, k);
		double w = 2 * pm_pi * ((double)(k <= p ? k : p) + 0.5 * l->shifted) / ((double)n * h), *a = block + l->fft->at[k] * L;
		for (int q = 0; q < L; q++)
			a[q] *= -w * w / (double)n;
	}
	pm_transform_backward(l, block);
}
