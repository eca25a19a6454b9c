/* Complex FFT of eight lines side by side, mixed radix 2, 3, 4, 5, 7, 8, 11, 13, in place: decimation in frequency forward, which leaves the
 * frequencies in digit-reversed rows, and its exact reverse back, which takes them from there. A convolution never needs them sorted.
 *   forward stage of length N = r M:  b_p = w_N^{j p} sum_q a_q w_r^{p q},  a_q in row j + q M, b_p in row j + p M,  w_N = exp(-2 pi i/N)
 * Greater primes up to 251 are stages too, slower ones (prime-dft.c). Lengths with a prime factor above that go to FFTW, as split arrays in the same layout.
 * Source: Gentleman and Sande 1966; Cooley and Tukey 1965; the lane layout as in FFTW's and ducc's vector passes.
 * Plain vector arithmetic without fused operations: the same bytes on every processor. Cost: 5 n log2 n per line, from L1.
 * SPDX-License-Identifier: GPL-3.0-or-later */
#include <stdlib.h>
#include <string.h>

#include "fft/fft-block.h"
#include "fft/prime-dft.h"

/* -i*a forward, +i*a back */
PM_SIMD_INLINE struct lanes turn(struct lanes a, bool back) { return back ? (struct lanes){-a.im, a.re} : (struct lanes){a.im, -a.re}; }

PM_SIMD_INLINE void dft4(struct lanes *a0, struct lanes *a1, struct lanes *a2, struct lanes *a3, bool back)
{
	struct lanes s = plus(*a0, *a2), d = minus(*a0, *a2), t = plus(*a1, *a3), e = turn(minus(*a1, *a3), back);
	*a0 = plus(s, t), *a1 = plus(d, e), *a2 = minus(s, t), *a3 = minus(d, e);
}

struct eight {
	struct lanes a0, a1, a2, a3, a4, a5, a6, a7; /* named variables, because the compiler would put an array into memory */
};

PM_SIMD_INLINE void dft8(struct eight *x, bool back)
{
	const double h = 0.70710678118654752440;
	dft4(&x->a0, &x->a2, &x->a4, &x->a6, back);
	dft4(&x->a1, &x->a3, &x->a5, &x->a7, back);
	struct lanes t = turn(x->a3, back), v = turn(x->a7, back), o2 = turn(x->a5, back); /* exp(-+i pi/4) = h (1 -+ i) */
	struct lanes o1 = {h * (x->a3.re + t.re), h * (x->a3.im + t.im)}, o3 = {h * (v.re - x->a7.re), h * (v.im - x->a7.im)}, o0 = x->a1;
	struct lanes e0 = x->a0, e1 = x->a2, e2 = x->a4, e3 = x->a6;
	x->a0 = plus(e0, o0), x->a1 = plus(e1, o1), x->a2 = plus(e2, o2), x->a3 = plus(e3, o3);
	x->a4 = minus(e0, o0), x->a5 = minus(e1, o1), x->a6 = minus(e2, o2), x->a7 = minus(e3, o3);
}

/* Odd p: pairs q and p-q share their products. */
PM_SIMD_INLINE void dft_odd(int p, const double *cosine, const double *sine, bool back, struct lanes *a)
{
	struct lanes s[PM_PRIME / 2], d[PM_PRIME / 2], sum = a[0], first = a[0];
	for (int q = 1; q <= p / 2; q++) {
		s[q - 1] = plus(a[q], a[p - q]);
		d[q - 1] = turn(minus(a[q], a[p - q]), back);
		sum = plus(sum, s[q - 1]);
	}
	a[0] = sum;
	for (int k = 1; k <= p / 2; k++) {
		struct lanes even = first, odd = {{0}, {0}};
		for (int q = 1; q <= p / 2; q++) {
			double c = cosine[k * q % p], o = sine[k * q % p];
			even.re += c * s[q - 1].re, even.im += c * s[q - 1].im;
			odd.re += o * d[q - 1].re, odd.im += o * d[q - 1].im;
		}
		a[k] = plus(even, odd), a[p - k] = minus(even, odd);
	}
}

/* One butterfly of radix 2, 4, 8 in registers: written out, because the compiler would put arrays of them into memory. w: twiddles or NULL for ones. */
PM_SIMD_INLINE void fly2(struct c8 *x, size_t m, const double *w, bool back)
{
	struct lanes a0 = take(x), a1 = take(x + m);
	if (w && back)
		a1 = twisted(a1, w, true);
	struct lanes s = plus(a0, a1), d = minus(a0, a1);
	put(x, s);
	put(x + m, w && !back ? twisted(d, w, false) : d);
}

PM_SIMD_INLINE void fly4(struct c8 *x, size_t m, const double *w, bool back)
{
	struct lanes a0 = take(x), a1 = take(x + m), a2 = take(x + 2 * m), a3 = take(x + 3 * m);
	if (w && back)
		a1 = twisted(a1, w, true), a2 = twisted(a2, w + 2, true), a3 = twisted(a3, w + 4, true);
	dft4(&a0, &a1, &a2, &a3, back);
	if (w && !back)
		a1 = twisted(a1, w, false), a2 = twisted(a2, w + 2, false), a3 = twisted(a3, w + 4, false);
	put(x, a0), put(x + m, a1), put(x + 2 * m, a2), put(x + 3 * m, a3);
}

PM_SIMD_INLINE void twist8(struct eight *a, const double *w, bool back)
{
	a->a1 = twisted(a->a1, w, back), a->a2 = twisted(a->a2, w + 2, back), a->a3 = twisted(a->a3, w + 4, back), a->a4 = twisted(a->a4, w + 6, back);
	a->a5 = twisted(a->a5, w + 8, back), a->a6 = twisted(a->a6, w + 10, back), a->a7 = twisted(a->a7, w + 12, back);
}

PM_SIMD_INLINE void fly8(struct c8 *x, size_t m, const double *w, bool back)
{
	struct eight a = {take(x), take(x + m), take(x + 2 * m), take(x + 3 * m), take(x + 4 * m), take(x + 5 * m), take(x + 6 * m), take(x + 7 * m)};
	if (w && back)
		twist8(&a, w, true);
	dft8(&a, back);
	if (w && !back)
		twist8(&a, w, false);
	put(x, a.a0), put(x + m, a.a1), put(x + 2 * m, a.a2), put(x + 3 * m, a.a3);
	put(x + 4 * m, a.a4), put(x + 5 * m, a.a5), put(x + 6 * m, a.a6), put(x + 7 * m, a.a7);
}

PM_SIMD_INLINE void fly_odd(int r, const struct pm_fft *f, struct c8 *x, size_t m, const double *w, bool back)
{
	struct lanes a[PM_PRIME];
	for (int q = 0; q < r; q++)
		a[q] = take(x + (size_t)q * m);
	for (int p = 1; p < r && w && back; p++)
		a[p] = twisted(a[p], w + 2 * (p - 1), true);
	dft_odd(r, f->cosine[r], f->sine[r], back, a);
	for (int p = 1; p < r && w && !back; p++)
		a[p] = twisted(a[p], w + 2 * (p - 1), false);
	for (int q = 0; q < r; q++)
		put(x + (size_t)q * m, a[q]);
}

PM_SIMD_INLINE void fly(int r, const struct pm_fft *f, struct c8 *x, size_t m, const double *w, bool back)
{
	if (r == 2)
		fly2(x, m, w, back);
	else if (r == 4)
		fly4(x, m, w, back);
	else if (r == 8)
		fly8(x, m, w, back);
	else
		fly_odd(r, f, x, m, w, back);
}

PM_SIMD_INLINE void parts(int r, const struct pm_fft *f, struct c8 *x, size_t m, const double *w, bool back)
{
	for (int part = 0; part < PM_FFT_PARTS; part++)
		fly(r, f, part_of((const double *)x, part), m, w, back);
}

PM_SIMD_INLINE void stage(int r, const struct pm_fft *f, size_t length, const double *twiddle, bool back, struct c8 *x)
{
	size_t m = length / (size_t)r;
	if (m == 1) {
		for (size_t base = 0; base < f->n; base += length)
			parts(r, f, x + base, 1, NULL, back);
		return;
	}
	for (size_t base = 0; base < f->n; base += length) {
		const double *w = twiddle;
		for (size_t j = 0; j < m; j++, w += 2 * (r - 1))
			parts(r, f, x + base + j, m, w, back);
	}
}

#define STAGES(back) \
	static void stage_##back(const struct pm_fft *f, int s, size_t length, struct c8 *x) \
	{ \
		const double *w = f->twiddle[s]; \
		switch (f->radix[s]) { \
		case 2: stage(2, f, length, w, back, x); break; \
		case 3: stage(3, f, length, w, back, x); break; \
		case 4: stage(4, f, length, w, back, x); break; \
		case 5: stage(5, f, length, w, back, x); break; \
		case 7: stage(7, f, length, w, back, x); break; \
		case 8: stage(8, f, length, w, back, x); break; \
		case 11: stage(11, f, length, w, back, x); break; \
		case 13: stage(13, f, length, w, back, x); break; \
		default: pm_prime_stage(f, s, length, back, x); \
		} \
	}
STAGES(false)
STAGES(true)

void pm_fft_forward(const struct pm_fft *f, double *block)
{
	size_t length = f->n;
	if (f->forward)
		fftw_execute_split_dft(f->forward, block, block + PM_FFT_LINES / 2, block, block + PM_FFT_LINES / 2);
	for (int s = 0; s < f->stages; length /= (size_t)f->radix[s++])
		stage_false(f, s, length, (struct c8 *)block);
}

void pm_fft_backward(const struct pm_fft *f, double *block)
{
	size_t length = 1;
	if (f->backward)
		fftw_execute_split_dft(f->backward, block + PM_FFT_LINES / 2, block, block + PM_FFT_LINES / 2, block); /* as planned: parts exchanged */
	for (int s = f->stages - 1; s >= 0; s--)
		stage_true(f, s, length *= (size_t)f->radix[s], (struct c8 *)block);
}

void pm_fft_circle(size_t i, size_t n, double *c, double *s)
{
	size_t quarter = 4 * (i % n) / n, r = 4 * (i % n) - quarter * n;
	bool far = 2 * r > n;
	double x = (double)(far ? n - r : r) / (double)n * (pm_pi / 2), co = far ? sin(x) : cos(x), si = far ? cos(x) : sin(x);
	*c = quarter == 0 ? co : quarter == 1 ? -si : quarter == 2 ? -co : si;
	*s = quarter == 0 ? si : quarter == 1 ? co : quarter == 2 ? -si : -co;
}

/* Stages of radix 8 and 4 for the twos, then the odd primes; 0 if a greater one is left. */
static int factors(struct pm_fft *f)
{
	size_t n = f->n;
	int twos = 0;
	for (; n % 2 == 0; n /= 2)
		twos++;
	while (twos) {
		int take = twos == 2 || twos == 4 ? 2 : twos < 3 ? twos : 3;
		f->radix[f->stages++] = 1 << take;
		twos -= take;
	}
	for (int r = 3; r <= PM_PRIME_MOST; r += 2)
		for (; n % (size_t)r == 0; n /= (size_t)r)
			f->radix[f->stages++] = r;
	if (n > 1)
		f->stages = 0;
	return f->stages;
}

static int tables(struct pm_fft *f)
{
	size_t length = f->n;
	for (int s = 0; s < f->stages; s++) {
		size_t r = (size_t)f->radix[s], m = length / r;
		double *w = f->twiddle[s] = pm_alloc(2 * m * (r - 1), sizeof *w);
		if (!w)
			return -PM_DATA;
		for (size_t j = 0; j < m; j++)
			for (size_t p = 1; p < r; p++, w += 2)
				pm_fft_circle(j * p, length, &w[0], &w[1]);
		for (size_t i = 0; i < r && r <= PM_PRIME && r != 8; i++)
			pm_fft_circle(i, r, &f->cosine[r][i], &f->sine[r][i]);
		if (r > PM_PRIME && !(f->circle[s] = pm_alloc(2 * r, sizeof *w)))
			return -PM_DATA;
		for (size_t i = 0; i < r && r > PM_PRIME; i++)
			pm_fft_circle(i, r, &f->circle[s][2 * i], &f->circle[s][2 * i + 1]);
		length = m;
	}
	for (size_t k = 0; k < f->n; k++) {
		size_t rest = k, m = f->n;
		f->at[k] = f->stages ? 0 : k;
		for (int s = 0; s < f->stages; s++) {
			m /= (size_t)f->radix[s];
			f->at[k] += rest % (size_t)f->radix[s] * m;
			rest /= (size_t)f->radix[s];
		}
	}
	return 0;
}

static void *fft_free(void *fft)
{
	struct pm_fft *f = fft;
	for (int s = 0; f && s < f->stages; s++)
		pm_free(f->twiddle[s]), pm_free(f->circle[s]);
	if (f)
		pm_free(f->at), pm_free(f->half), pm_free(f->quarter);
	for (int i = 0; f && i < 5; i++)
		pm_free(f->fold[i]);
	free(f);
	return NULL;
}

struct pm_fft *pm_fft(struct pm_fft_plans *p, size_t n)
{
	for (int i = 0; i < p->nmade; i++)
		if (((struct pm_fft *)p->made[i])->n == n)
			return p->made[i];
	struct pm_fft *f = calloc(1, sizeof *f);
	if (!f || p->nmade == PM_FFT_PLANS) {
		f ? pm_fail(PM_DATA, "no transform of length %zu", n) : pm_no_memory();
		free(f);
		return NULL;
	}
	f->n = n;
	f->at = pm_alloc(n, sizeof *f->at);
	bool good = f->at != NULL;
	if (good && n > 1 && !factors(f))
		good = (f->forward = pm_plan(p, PM_BLOCK_FORWARD, n)) && (f->backward = pm_plan(p, PM_BLOCK_BACKWARD, n));
	if (!good || tables(f))
		return fft_free(f);
	p->unmake = fft_free;
	return p->made[p->nmade++] = f;
}

struct pm_fft *pm_fft_shifted(struct pm_fft_plans *p, size_t n)
{
	struct pm_fft *f = pm_fft(p, n);
	if (!f || f->half)
		return f;
	f->half = pm_alloc(2 * n, sizeof *f->half);
	for (size_t i = 0; f->half && i < n; i++)
		pm_fft_circle(i, 2 * n, &f->half[2 * i], &f->half[2 * i + 1]);
	return f->half ? f : NULL;
}
