/* Complex FFT of eight lines side by side, mixed radix 2, 3, 4, 5, 7, 8, 11, 13, in place: decimation in frequency forward, which leaves the
 * frequencies in digit-reversed rows, and its exact reverse back, which takes them from there. A convolution never needs them sorted.
 *   forward stage of length N = r M:  b_p = w_N^{j p} sum_q a_q w_r^{p q},  a_q in row j + q M, b_p in row j + p M,  w_N = exp(-2 pi i/N)
 * Lengths with a greater prime factor go to FFTW, as split arrays in the same layout.
 * Source: Gentleman and Sande 1966; Cooley and Tukey 1965; the lane layout as in FFTW's and ducc's vector passes.
 * Plain vector arithmetic without fused operations: the same bytes on every processor. Cost: 5 n log2 n per line, from L1.
 * SPDX-License-Identifier: GPL-3.0-or-later */
#include <stdlib.h>
#include <string.h>

#include "mesh/lanes.h"

typedef double v8 __attribute__((vector_size(64)));
struct c8 {
	v8 re, im;
};

#define ALWAYS static inline __attribute__((always_inline))

ALWAYS struct c8 plus(struct c8 a, struct c8 b) { return (struct c8){a.re + b.re, a.im + b.im}; }
ALWAYS struct c8 minus(struct c8 a, struct c8 b) { return (struct c8){a.re - b.re, a.im - b.im}; }
/* -i*a forward, +i*a back */
ALWAYS struct c8 turn(struct c8 a, bool back) { return back ? (struct c8){-a.im, a.re} : (struct c8){a.im, -a.re}; }
/* times exp(-i x) forward, exp(+i x) back; w = cos x, sin x */
ALWAYS struct c8 twist(struct c8 a, const double *w, bool back)
{
	return back ? (struct c8){a.re * w[0] - a.im * w[1], a.im * w[0] + a.re * w[1]} :
		(struct c8){a.re * w[0] + a.im * w[1], a.im * w[0] - a.re * w[1]};
}

ALWAYS void dft4(struct c8 *a0, struct c8 *a1, struct c8 *a2, struct c8 *a3, bool back)
{
	struct c8 s = plus(*a0, *a2), d = minus(*a0, *a2), t = plus(*a1, *a3), e = turn(minus(*a1, *a3), back);
	*a0 = plus(s, t), *a1 = plus(d, e), *a2 = minus(s, t), *a3 = minus(d, e);
}

ALWAYS void dft8(struct c8 *a, bool back)
{
	const double h = 0.70710678118654752440;
	dft4(&a[0], &a[2], &a[4], &a[6], back);
	dft4(&a[1], &a[3], &a[5], &a[7], back);
	struct c8 u = turn(a[3], back), v = turn(a[7], back), w = turn(a[5], back); /* exp(-+i pi/4) = h (1 -+ i) */
	u = (struct c8){h * (a[3].re + u.re), h * (a[3].im + u.im)};
	v = (struct c8){h * (v.re - a[7].re), h * (v.im - a[7].im)};
	struct c8 e[4] = {a[0], a[2], a[4], a[6]}, o[4] = {a[1], u, w, v};
	for (int k = 0; k < 4; k++)
		a[k] = plus(e[k], o[k]), a[k + 4] = minus(e[k], o[k]);
}

/* Odd p: pairs q and p-q share their products. */
ALWAYS void dft_odd(int p, const double *cosine, const double *sine, bool back, struct c8 *a)
{
	struct c8 s[PM_PRIME / 2], d[PM_PRIME / 2], sum = a[0], first = a[0];
	for (int q = 1; q <= p / 2; q++) {
		s[q - 1] = plus(a[q], a[p - q]);
		d[q - 1] = turn(minus(a[q], a[p - q]), back);
		sum = plus(sum, s[q - 1]);
	}
	a[0] = sum;
	for (int k = 1; k <= p / 2; k++) {
		struct c8 even = first, odd = {{0}, {0}};
		for (int q = 1; q <= p / 2; q++) {
			double c = cosine[k * q % p], o = sine[k * q % p];
			even.re += c * s[q - 1].re, even.im += c * s[q - 1].im;
			odd.re += o * d[q - 1].re, odd.im += o * d[q - 1].im;
		}
		a[k] = plus(even, odd), a[p - k] = minus(even, odd);
	}
}

ALWAYS void dft(int r, const struct pm_fft *f, bool back, struct c8 *a)
{
	if (r == 2) {
		struct c8 t = a[1];
		a[1] = minus(a[0], t), a[0] = plus(a[0], t);
	} else if (r == 4) {
		dft4(&a[0], &a[1], &a[2], &a[3], back);
	} else if (r == 8) {
		dft8(a, back);
	} else {
		dft_odd(r, f->cosine[r], f->sine[r], back, a);
	}
}

ALWAYS void stage(int r, const struct pm_fft *f, size_t length, const double *twiddle, bool back, struct c8 *x)
{
	size_t m = length / (size_t)r;
	for (size_t base = 0; base < f->n; base += length) {
		const double *w = twiddle;
		for (size_t j = 0; j < m; j++, w += 2 * (r - 1)) {
			struct c8 a[PM_PRIME], *at = x + base + j;
			for (int q = 0; q < r; q++)
				a[q] = at[(size_t)q * m];
			for (int p = 1; p < r && back && m > 1; p++)
				a[p] = twist(a[p], w + 2 * (p - 1), true);
			dft(r, f, back, a);
			for (int p = 1; p < r && !back && m > 1; p++)
				a[p] = twist(a[p], w + 2 * (p - 1), false);
			for (int q = 0; q < r; q++)
				at[(size_t)q * m] = a[q];
		}
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
		default: stage(13, f, length, w, back, x); \
		} \
	}
STAGES(false)
STAGES(true)

void pm_fft_forward(const struct pm_fft *f, double *block)
{
	size_t length = f->n;
	if (f->forward)
		fftw_execute_split_dft(f->forward, block, block + PM_LANES / 2, block, block + PM_LANES / 2);
	for (int s = 0; s < f->stages; length /= (size_t)f->radix[s++])
		stage_false(f, s, length, (struct c8 *)block);
}

void pm_fft_backward(const struct pm_fft *f, double *block)
{
	size_t length = 1;
	if (f->backward)
		fftw_execute_split_dft(f->backward, block + PM_LANES / 2, block, block + PM_LANES / 2, block); /* as planned: parts exchanged */
	for (int s = f->stages - 1; s >= 0; s--)
		stage_true(f, s, length *= (size_t)f->radix[s], (struct c8 *)block);
}

/* cos and sin of 2 pi i/n from an eighth of the circle, so that they are good to the last bit. */
static void circle(size_t i, size_t n, double *c, double *s)
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
	static const int odd[] = {3, 5, 7, 11, 13};
	size_t n = f->n;
	int twos = 0;
	for (; n % 2 == 0; n /= 2)
		twos++;
	while (twos) {
		int take = twos == 2 || twos == 4 ? 2 : twos < 3 ? twos : 3;
		f->radix[f->stages++] = 1 << take;
		twos -= take;
	}
	for (size_t i = 0; i < sizeof odd / sizeof *odd; i++)
		for (; n % (size_t)odd[i] == 0; n /= (size_t)odd[i])
			f->radix[f->stages++] = odd[i];
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
				circle(j * p, length, &w[0], &w[1]);
		for (size_t i = 0; i < r && r != 8; i++)
			circle(i, r, &f->cosine[r][i], &f->sine[r][i]);
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
		pm_free(f->twiddle[s]);
	if (f)
		pm_free(f->at);
	free(f);
	return NULL;
}

const struct pm_fft *pm_fft(struct pm_planner *p, size_t n)
{
	for (int i = 0; i < p->nmade; i++)
		if (((struct pm_fft *)p->made[i])->n == n)
			return p->made[i];
	struct pm_fft *f = calloc(1, sizeof *f);
	if (!f || p->nmade == PM_PLANS) {
		free(f);
		pm_fail(PM_DATA, "no transform of length %zu", n);
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

ALWAYS void transpose(v8 *r)
{
	v8 t[8], u[8];
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

void pm_lanes_in(const double *rows, size_t stride, size_t count, double *block)
{
	for (size_t i = 0; i < count; i += 8)
		for (int half = 0; half < 2; half++) {
			v8 t[8];
			for (int q = 0; q < 8; q++)
				t[q] = *(const v8 *)(rows + (size_t)(8 * half + q) * stride + i);
			transpose(t);
			for (size_t q = 0; q < 8 && i + q < count; q++)
				*(v8 *)(block + (i + q) * PM_LANES + 8 * half) = t[q];
		}
}

void pm_lanes_out(const double *block, const size_t *at, size_t count, size_t stride, double *rows)
{
	for (size_t i = 0; i < count; i += 8)
		for (int half = 0; half < 2; half++) {
			v8 t[8] = {{0}};
			for (size_t q = 0; q < 8 && i + q < count; q++)
				t[q] = *(const v8 *)(block + (at ? at[i + q] : i + q) * PM_LANES + 8 * half);
			transpose(t);
			for (int q = 0; q < 8; q++)
				*(v8 *)(rows + (size_t)(8 * half + q) * stride + i) = t[q];
		}
}

static void store(v8 *t, int from, int count, size_t at, double *const row[PM_LANES])
{
	transpose(t);
	for (int q = 0; q < 8 && from + q < count; q++)
		*(v8 *)(row[from + q] + at) = t[q];
}

void pm_spectra_out(const struct pm_fft *f, const double *block, int count, double *const row[PM_LANES])
{
	size_t n = f->n, modes = n / 2 + 1;
	for (size_t k = 0; k < modes; k += 8) {
		struct c8 a[8] = {{{0}, {0}}}, b[8] = {{{0}, {0}}};
		v8 t[8];
		for (size_t q = 0; q < 8 && k + q < modes; q++) {
			const struct c8 *z = (const struct c8 *)block + f->at[k + q], *y = (const struct c8 *)block + f->at[(n - k - q) % n];
			a[q] = (struct c8){0.5 * (z->re + y->re), 0.5 * (z->im - y->im)};
			b[q] = (struct c8){0.5 * (z->im + y->im), 0.5 * (y->re - z->re)};
		}
		for (int part = 0; part < 4; part++) {
			for (int q = 0; q < 8; q++)
				t[q] = part == 0 ? a[q].re : part == 1 ? a[q].im : part == 2 ? b[q].re : b[q].im;
			store(t, part / 2 * 8, count, 2 * k + (size_t)(part % 2) * 8, row);
		}
	}
}

static void load(int from, int count, size_t at, const double *const row[PM_LANES], v8 *t)
{
	for (int q = 0; q < 8; q++)
		t[q] = from + q < count ? *(const v8 *)(row[from + q] + at) : (v8){0};
	transpose(t);
}

void pm_spectra_in(const struct pm_fft *f, int count, const double *const row[PM_LANES], double *block)
{
	size_t n = f->n, modes = n / 2 + 1;
	struct c8 *x = (struct c8 *)block;
	for (size_t k = 0; k < modes; k += 8) {
		v8 ar[8], ai[8], br[8], bi[8];
		load(0, count, 2 * k, row, ar);
		load(0, count, 2 * k + 8, row, ai);
		load(8, count, 2 * k, row, br);
		load(8, count, 2 * k + 8, row, bi);
		for (size_t q = 0; q < 8 && k + q < modes; q++) {
			size_t i = f->at[k + q], j = f->at[(n - k - q) % n];
			if (i == j) {
				x[i] = (struct c8){ar[q], br[q]};
				continue;
			}
			x[i] = (struct c8){ar[q] - bi[q], ai[q] + br[q]};
			x[j] = (struct c8){ar[q] + bi[q], br[q] - ai[q]};
		}
	}
}
