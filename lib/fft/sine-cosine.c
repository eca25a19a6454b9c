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

PM_SIMD_INLINE struct lanes times(double p, struct lanes a) { return (struct lanes){p * a.re, p * a.im}; }
PM_SIMD_INLINE struct lanes times_i(struct lanes a) { return (struct lanes){-a.im, a.re}; }
/* times exp(-i x), w = cos x, sin x */
PM_SIMD_INLINE struct lanes twist(const double *w, struct lanes a) { return twisted(a, w, false); }

/* Nodes a and b to p*(a + b) + q*(a - b) and p*(a + b) - q*(a - b). */
PM_SIMD_INLINE void turn(double p, double q, struct c8 *x, struct c8 *y)
{
	struct lanes a = take(x), b = take(y), e = times(p, plus(a, b)), o = times(q, minus(a, b));
	put(x, plus(e, o)), put(y, minus(e, o));
}

static void sines_before(const struct pm_fft *f, struct c8 *x)
{
	size_t n = f->n, j = 1;
	put(x, (struct lanes){{0}, {0}});
	for (; j < n - j; j++)
		turn(2 * f->half[2 * j + 1], 1, x + j, x + n - j);
	if (2 * j == n)
		put(x + j, times(4, take(x + j)));
}

static void sines_after(const struct pm_fft *f, struct c8 *x)
{
	size_t n = f->n;
	struct lanes sum = times(0.5, take(x));
	put(x, sum);
	for (size_t k = 1; k < n - k; k++) {
		struct c8 *p = x + f->at[k], *q = x + f->at[n - k];
		struct lanes a = take(p), b = take(q), even = times(0.5, times_i(minus(a, b)));
		sum = plus(sum, times(0.5, plus(a, b)));
		put(p, even), put(q, sum);
	}
}

static void sines_back_before(const struct pm_fft *f, struct c8 *x)
{
	size_t n = f->n;
	struct lanes sum = {{0}, {0}};
	for (size_t k = (n - 1) / 2; k > 0; k--) {
		struct c8 *p = x + f->at[k], *q = x + f->at[n - k];
		struct lanes s = times_i(take(p));
		sum = 2 * k + 1 < n ? plus(sum, take(q)) : sum;
		put(p, minus(sum, s)), put(q, plus(sum, s));
	}
	put(x, plus(take(x), sum));
	if (n % 2 == 0)
		put(x + f->at[n / 2], (struct lanes){{0}, {0}});
}

static void sines_back_after(const struct pm_fft *f, struct c8 *x)
{
	size_t n = f->n, j = 1;
	for (; j < n - j; j++)
		turn(f->half[2 * j + 1], 0.5, x + j, x + n - j);
	if (2 * j == n)
		put(x + j, times(2, take(x + j)));
}

static void cosines_before(const struct pm_fft *f, struct c8 *x)
{
	size_t n = f->n, j = 1;
	struct lanes sum = minus(take(x), take(x + n));
	put(x, plus(take(x), take(x + n)));
	for (; j < n - j; j++) {
		sum = plus(sum, times(2 * f->half[2 * j], minus(take(x + j), take(x + n - j))));
		turn(1, 2 * f->half[2 * j + 1], x + j, x + n - j);
	}
	if (2 * j == n)
		put(x + j, times(2, take(x + j)));
	put(x + n, sum);
}

static void cosines_after(const struct pm_fft *f, struct c8 *x)
{
	size_t n = f->n;
	struct lanes sum = take(x + n);
	for (size_t k = 1; k < n - k; k++) {
		struct c8 *p = x + f->at[k], *q = x + f->at[n - k];
		struct lanes a = take(p), b = take(q), even = times(0.5, plus(a, b));
		sum = minus(sum, times(0.5, times_i(minus(a, b))));
		put(p, even), put(q, sum);
	}
}

static void cosines_back_before(const struct pm_fft *f, struct c8 *x)
{
	size_t n = f->n;
	struct lanes sum = {{0}, {0}};
	for (size_t k = (n - 1) / 2; k > 0; k--) {
		struct c8 *p = x + f->at[k], *q = x + f->at[n - k];
		struct lanes even = take(p);
		sum = plus(sum, times(2 * k + 1 == n ? 0.5 : 1, take(q)));
		put(p, minus(even, times_i(sum))), put(q, plus(even, times_i(sum)));
	}
	put(x + n, times(2, plus(sum, times(n == 1 ? 0.5 : 1, take(x + n)))));
}

static void cosines_back_after(const struct pm_fft *f, struct c8 *x)
{
	size_t n = f->n, j = 1;
	struct lanes first = take(x), sum = take(x + n);
	put(x + n, minus(first, sum));
	put(x, plus(first, sum));
	for (; j < n - j; j++) {
		struct lanes a = take(x + j), b = take(x + n - j), e = times(0.5, plus(a, b));
		struct lanes o = minus(times(f->half[2 * j], sum), times(f->half[2 * j + 1], minus(a, b)));
		put(x + j, plus(e, o)), put(x + n - j, minus(e, o));
	}
}

static void quarters_before(const struct pm_fft *f, bool wall_below, struct c8 *x)
{
	size_t n = f->n;
	if (wall_below)
		put(x, take(x + n));
	for (size_t j = 1; j <= n - j; j++) {
		struct lanes a = take(x + (wall_below ? n - j : j)), b = take(x + (wall_below ? j : n - j));
		put(x + j, twist(f->quarter + 2 * j, plus(a, times_i(b))));
		put(x + n - j, twist(f->quarter + 2 * (n - j), plus(b, times_i(a))));
	}
}

/* exp(i t/2) a + exp(-i t/2) b */
PM_SIMD_INLINE struct lanes untwist(const double *w, struct lanes a, struct lanes b)
{
	const double back[2] = {w[0], -w[1]};
	return plus(twist(back, a), twist(w, b));
}

static void quarters_back_after(const struct pm_fft *f, bool wall_below, struct c8 *x)
{
	size_t n = f->n;
	put(x, times(2, take(x)));
	if (wall_below)
		put(x + n, take(x));
	for (size_t j = 1; j <= n - j; j++) {
		struct lanes a = take(x + j), b = take(x + n - j), low = untwist(f->quarter + 2 * j, a, b), high = untwist(f->quarter + 2 * (n - j), b, a);
		put(x + j, wall_below ? high : low);
		put(x + n - j, wall_below ? low : high);
	}
}

void pm_sine_cosine(enum pm_waves fold, const struct pm_fft *f, double *block)
{
	for (int part = 0; part < PM_FFT_PARTS; part++)
		if (fold == PM_WAVES_SINE)
			sines_before(f, part_of(block, part));
		else if (fold == PM_WAVES_COSINE)
			cosines_before(f, part_of(block, part));
		else
			quarters_before(f, fold == PM_WAVES_QUARTER_SINE, part_of(block, part));
	pm_fft_forward(f, block);
	for (int part = 0; part < PM_FFT_PARTS; part++)
		if (fold == PM_WAVES_SINE)
			sines_after(f, part_of(block, part));
		else if (fold == PM_WAVES_COSINE)
			cosines_after(f, part_of(block, part));
}

void pm_sine_cosine_back(enum pm_waves fold, const struct pm_fft *f, double *block)
{
	for (int part = 0; part < PM_FFT_PARTS; part++)
		if (fold == PM_WAVES_SINE)
			sines_back_before(f, part_of(block, part));
		else if (fold == PM_WAVES_COSINE)
			cosines_back_before(f, part_of(block, part));
	pm_fft_backward(f, block);
	for (int part = 0; part < PM_FFT_PARTS; part++)
		if (fold == PM_WAVES_SINE)
			sines_back_after(f, part_of(block, part));
		else if (fold == PM_WAVES_COSINE)
			cosines_back_after(f, part_of(block, part));
		else
			quarters_back_after(f, fold == PM_WAVES_QUARTER_SINE, part_of(block, part));
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
