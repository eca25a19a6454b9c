/* Sine and cosine transforms of lines between walls and neumann faces, nodes 0 ... n, by complex FFTs of length n instead of 2n with images.
 * Nodes j and n-j are added and subtracted, t = pi j/n:
 *   walls    y = 2 sin(t) (x_j + x_{n-j}) + (x_j - x_{n-j}): sines of y are S_2k, cosines S_{2k+1} - S_{2k-1}
 *   neumann  y = x_j + x_{n-j} + 2 sin(t) (x_j - x_{n-j}): cosines of y are C_2k, sines C_{2k-1} - C_{2k+1}, and C_1 is summed
 *   a wall opposite a neumann face: exp(-i t/2) (x_j + i x_{n-j}), its frequency k is mode 2k or 2n-1-2k (from the neumann face; signs are left out)
 * and back the transposed steps. Source: Cooley, Lewis and Welch 1970; Swarztrauber 1977; Makhoul 1980 (the last kind). Known weakness: the odd modes of
 * the first two are running sums, so round-off grows with n: there and back 4e-17 n of the largest node for noise. Cost: half of that with images.
 * SPDX-License-Identifier: GPL-3.0-or-later */
#include "fft/fft-vector.h"
#include "fft/sine-cosine.h"

PM_SIMD_INLINE struct c8 times(double p, struct c8 a) { return (struct c8){p * a.re, p * a.im}; }
PM_SIMD_INLINE struct c8 times_i(struct c8 a) { return (struct c8){-a.im, a.re}; }
/* times exp(-i x), w = cos x, sin x */
PM_SIMD_INLINE struct c8 twist(const double *w, struct c8 a) { return (struct c8){a.re * w[0] + a.im * w[1], a.im * w[0] - a.re * w[1]}; }

/* Nodes a and b to p*(a + b) + q*(a - b) and p*(a + b) - q*(a - b). */
PM_SIMD_INLINE void turn(double p, double q, struct c8 *x, struct c8 *y)
{
	struct c8 e = times(p, plus(*x, *y)), o = times(q, minus(*x, *y));
	*x = plus(e, o), *y = minus(e, o);
}

static void sines(const struct pm_fft *f, struct c8 *x)
{
	size_t n = f->n, j = 1;
	*x = (struct c8){{0}, {0}};
	for (; j < n - j; j++)
		turn(2 * f->half[2 * j + 1], 1, x + j, x + n - j);
	if (2 * j == n)
		x[j] = times(4, x[j]);
	pm_fft_forward(f, (double *)x);
	struct c8 sum = *x = times(0.5, *x);
	for (size_t k = 1; k < n - k; k++) {
		struct c8 *a = x + f->at[k], *b = x + f->at[n - k], even = times(0.5, times_i(minus(*a, *b)));
		sum = plus(sum, times(0.5, plus(*a, *b)));
		*a = even, *b = sum;
	}
}

static void sines_back(const struct pm_fft *f, struct c8 *x)
{
	size_t n = f->n, j = 1;
	struct c8 sum = {{0}, {0}};
	for (size_t k = (n - 1) / 2; k > 0; k--) {
		struct c8 *a = x + f->at[k], *b = x + f->at[n - k], s = times_i(*a);
		sum = 2 * k + 1 < n ? plus(sum, *b) : sum;
		*a = minus(sum, s), *b = plus(sum, s);
	}
	*x = plus(*x, sum);
	if (n % 2 == 0)
		x[f->at[n / 2]] = (struct c8){{0}, {0}};
	pm_fft_backward(f, (double *)x);
	for (; j < n - j; j++)
		turn(f->half[2 * j + 1], 0.5, x + j, x + n - j);
	if (2 * j == n)
		x[j] = times(2, x[j]);
}

static void cosines(const struct pm_fft *f, struct c8 *x)
{
	size_t n = f->n, j = 1;
	struct c8 sum = minus(x[0], x[n]);
	x[0] = plus(x[0], x[n]);
	for (; j < n - j; j++) {
		sum = plus(sum, times(2 * f->half[2 * j], minus(x[j], x[n - j])));
		turn(1, 2 * f->half[2 * j + 1], x + j, x + n - j);
	}
	if (2 * j == n)
		x[j] = times(2, x[j]);
	x[n] = sum;
	pm_fft_forward(f, (double *)x);
	for (size_t k = 1; k < n - k; k++) {
		struct c8 *a = x + f->at[k], *b = x + f->at[n - k], even = times(0.5, plus(*a, *b));
		sum = minus(sum, times(0.5, times_i(minus(*a, *b))));
		*a = even, *b = sum;
	}
}

static void cosines_back(const struct pm_fft *f, struct c8 *x)
{
	size_t n = f->n, j = 1;
	struct c8 sum = {{0}, {0}};
	for (size_t k = (n - 1) / 2; k > 0; k--) {
		struct c8 *a = x + f->at[k], *b = x + f->at[n - k], even = *a;
		sum = plus(sum, times(2 * k + 1 == n ? 0.5 : 1, *b));
		*a = minus(even, times_i(sum)), *b = plus(even, times_i(sum));
	}
	sum = times(2, plus(sum, times(n == 1 ? 0.5 : 1, x[n])));
	pm_fft_backward(f, (double *)x);
	x[n] = minus(x[0], sum);
	x[0] = plus(x[0], sum);
	for (; j < n - j; j++) {
		struct c8 e = times(0.5, plus(x[j], x[n - j]));
		struct c8 o = minus(times(f->half[2 * j], sum), times(f->half[2 * j + 1], minus(x[j], x[n - j])));
		x[j] = plus(e, o), x[n - j] = minus(e, o);
	}
}

static void quarters(const struct pm_fft *f, bool wall_below, struct c8 *x)
{
	size_t n = f->n;
	if (wall_below)
		x[0] = x[n];
	for (size_t j = 1; j <= n - j; j++) {
		struct c8 a = wall_below ? x[n - j] : x[j], b = wall_below ? x[j] : x[n - j];
		x[j] = twist(f->quarter + 2 * j, plus(a, times_i(b)));
		x[n - j] = twist(f->quarter + 2 * (n - j), plus(b, times_i(a)));
	}
	pm_fft_forward(f, (double *)x);
}

/* exp(i t/2) a + exp(-i t/2) b */
PM_SIMD_INLINE struct c8 untwist(const double *w, struct c8 a, struct c8 b)
{
	const double back[2] = {w[0], -w[1]};
	return plus(twist(back, a), twist(w, b));
}

static void quarters_back(const struct pm_fft *f, bool wall_below, struct c8 *x)
{
	size_t n = f->n;
	pm_fft_backward(f, (double *)x);
	x[0] = times(2, x[0]);
	if (wall_below)
		x[n] = x[0];
	for (size_t j = 1; j <= n - j; j++) {
		struct c8 a = x[j], b = x[n - j], low = untwist(f->quarter + 2 * j, a, b), high = untwist(f->quarter + 2 * (n - j), b, a);
		x[j] = wall_below ? high : low;
		x[n - j] = wall_below ? low : high;
	}
}

void pm_sine_cosine(enum pm_waves fold, const struct pm_fft *f, double *block)
{
	struct c8 *x = (struct c8 *)block;
	if (fold == PM_WAVES_SINE)
		sines(f, x);
	else if (fold == PM_WAVES_COSINE)
		cosines(f, x);
	else
		quarters(f, fold == PM_WAVES_QUARTER_SINE, x);
}

void pm_sine_cosine_back(enum pm_waves fold, const struct pm_fft *f, double *block)
{
	struct c8 *x = (struct c8 *)block;
	if (fold == PM_WAVES_SINE)
		sines_back(f, x);
	else if (fold == PM_WAVES_COSINE)
		cosines_back(f, x);
	else
		quarters_back(f, fold == PM_WAVES_QUARTER_SINE, x);
}

/* The row of mode number `mode` (0: the lowest), on both ways. */
static size_t row_of(enum pm_waves fold, const struct pm_fft *f, size_t mode)
{
	size_t n = f->n;
	if (fold == PM_WAVES_SINE)
		return f->at[mode == 0 ? 0 : (mode + 1) % 2 ? n - mode / 2 : (mode + 1) / 2]; /* mode 0 is S_1 */
	if (fold == PM_WAVES_COSINE)
		return mode == 1 ? n : f->at[mode % 2 ? n - mode / 2 : mode / 2];
	return f->at[mode % 2 ? n - (mode + 1) / 2 : mode / 2];
}

static size_t *rows_of(enum pm_waves fold, const struct pm_fft *f)
{
	size_t modes = fold == PM_WAVES_SINE ? f->n - 1 : fold == PM_WAVES_COSINE ? f->n + 1 : f->n, *row = pm_alloc(modes + 1, sizeof *row);
	for (size_t m = 0; row && m < modes; m++)
		row[m] = row_of(fold, f, m);
	return row;
}

const struct pm_fft *pm_fft_sine_cosine(struct pm_fft_plans *p, size_t n)
{
	struct pm_fft *f = pm_fft_shifted(p, n);
	if (!f || f->quarter)
		return f;
	f->quarter = pm_alloc(2 * (n + 1), sizeof *f->quarter);
	for (size_t i = 0; f->quarter && i <= n; i++)
		pm_fft_circle(i, 4 * n, &f->quarter[2 * i], &f->quarter[2 * i + 1]);
	bool good = f->quarter != NULL;
	for (enum pm_waves fold = PM_WAVES_SINE; fold <= PM_WAVES_QUARTER_COSINE && good; fold++)
		good = (f->fold[fold] = rows_of(fold, f)) != NULL;
	return good ? f : NULL;
}
