/* The transform of an odd number p of elements from its definition, of eight lines at a time: elements q and p-q share their products,
 *   b_k, b_{p-k} = a_0 + sum_{q<=p/2} cos(2 pi kq/p) (a_q + a_{p-q}) -+ i sin(2 pi kq/p) (a_q - a_{p-q}).
 * Two k at a time, so that sums and differences are read half as often. Plain vector arithmetic without fused operations: the same bytes on every
 * processor. Cost: p^2 multiplications and additions per line, from L1: a third of the time of FFTW's measured plans up to p = 67, half at 127, 0.9 to
 * 1.4 of it at 251 (docs/speed.md). SPDX-License-Identifier: GPL-3.0-or-later */
#include "fft/prime-dft.h"

enum { HALF = PM_PRIME_MOST / 2 };

struct sums {
	struct lanes even, odd;
};

/* Adds to the sums of one k what elements q and p-q contribute; w = cos, sin of 2 pi kq/p. */
PM_SIMD_INLINE void add(struct sums *b, const double *w, const struct lanes *sum, const struct lanes *difference)
{
	b->even.re += w[0] * sum->re, b->even.im += w[0] * sum->im;
	b->odd.re += w[1] * difference->re, b->odd.im += w[1] * difference->im;
}

static int next(int at, int k, int p) { return at + k < p ? at + k : at + k - p; }

/* circle: cos, sin of 2 pi i/p. */
static void dft(int p, const double *circle, bool back, struct lanes *a)
{
	struct lanes sum[HALF], difference[HALF], all = a[0], first = a[0];
	const int half = p / 2;
	for (int q = 1; q <= half; q++) {
		struct lanes d = minus(a[q], a[p - q]);
		sum[q - 1] = plus(a[q], a[p - q]);
		difference[q - 1] = back ? (struct lanes){-d.im, d.re} : (struct lanes){d.im, -d.re};
		all = plus(all, sum[q - 1]);
	}
	a[0] = all;
	for (int k = 1; k <= half; k += 2) {
		struct sums b = {first, {{0}, {0}}}, c = b;
		for (int q = 0, i = k, j = k + 1; q < half; q++, i = next(i, k, p), j = next(j, k + 1, p)) {
			add(&b, circle + 2 * i, sum + q, difference + q);
			add(&c, circle + 2 * j, sum + q, difference + q);
		}
		a[k] = plus(b.even, b.odd), a[p - k] = minus(b.even, b.odd);
		if (k < half)
			a[k + 1] = plus(c.even, c.odd), a[p - k - 1] = minus(c.even, c.odd);
	}
}

void pm_prime_stage(const struct pm_fft *f, int s, bool back, struct pm_stage_rows at)
{
	const size_t r = (size_t)f->radix[s], m = at.length / r;
	struct lanes a[PM_PRIME_MOST];
	for (size_t base = at.first; base < at.end; base += at.length)
		for (size_t i = 0; i < m * PM_FFT_PARTS; i++) {
			const size_t j = i / PM_FFT_PARTS;
			const double *w = f->twiddle[s] + 2 * (r - 1) * j;
			const struct c8 *x = part_of((const double *)(at.x + (base + j) * at.x_step), (int)(i % PM_FFT_PARTS));
			struct c8 *y = part_of((const double *)(at.y + (base + j) * at.y_step), (int)(i % PM_FFT_PARTS));
			for (size_t q = 0; q < r; q++)
				a[q] = back && q && m > 1 ? twisted(take(x + q * m * at.x_step), w + 2 * (q - 1), true) : take(x + q * m * at.x_step);
			dft((int)r, f->circle[s], back, a);
			for (size_t q = 0; q < r; q++)
				put(y + q * m * at.y_step, !back && q && m > 1 ? twisted(a[q], w + 2 * (q - 1), false) : a[q]);
		}
}
