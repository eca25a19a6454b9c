/* Transforms of a few complex numbers of the lanes of a block, and butterflies made of them: the inner loops of fft-stages.c; private to lib/fft.
 * SPDX-License-Identifier: GPL-3.0-or-later */
#ifndef PM_FFT_BUTTERFLY_H
#define PM_FFT_BUTTERFLY_H

#include "fft/fft-block.h"
#include "fft/fft-vector.h"

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

/* From transforms of four of even numbers, in a0, a2, a4, a6, and of odd ones. */
PM_SIMD_INLINE void join8(struct eight *x, bool back)
{
	const double h = 0.70710678118654752440;
	struct lanes t = turn(x->a3, back), v = turn(x->a7, back), o2 = turn(x->a5, back); /* exp(-+i pi/4) = h (1 -+ i) */
	struct lanes o1 = {h * (x->a3.re + t.re), h * (x->a3.im + t.im)}, o3 = {h * (v.re - x->a7.re), h * (v.im - x->a7.im)}, o0 = x->a1;
	struct lanes e0 = x->a0, e1 = x->a2, e2 = x->a4, e3 = x->a6;
	x->a0 = plus(e0, o0), x->a1 = plus(e1, o1), x->a2 = plus(e2, o2), x->a3 = plus(e3, o3);
	x->a4 = minus(e0, o0), x->a5 = minus(e1, o1), x->a6 = minus(e2, o2), x->a7 = minus(e3, o3);
}

PM_SIMD_INLINE void dft8(struct eight *x, bool back)
{
	dft4(&x->a0, &x->a2, &x->a4, &x->a6, back);
	dft4(&x->a1, &x->a3, &x->a5, &x->a7, back);
	join8(x, back);
}

/* Of four of which the last two are zero. */
PM_SIMD_INLINE void dft4_half(struct lanes a, struct lanes b, struct lanes *a0, struct lanes *a1, struct lanes *a2, struct lanes *a3)
{
	const struct lanes e = turn(b, false);
	*a0 = plus(a, b), *a1 = plus(a, e), *a2 = minus(a, b), *a3 = minus(a, e);
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

/* One butterfly of elements m rows apart in x to the same of y, n apart. Radix 2, 4, 8 are written out, because the compiler would put arrays of them into
 * memory. w: twiddles or NULL for ones; BOTH: forward, times u (of each element and lane), back. */
enum way { FORWARD, BACK, BOTH };
enum { EACH = PM_FFT_LINES / 2 }; /* from the factors of an element to those of the next one */
PM_SIMD_INLINE struct lanes by(struct lanes a, const double *u)
{
	pm_simd_part t = *(const pm_simd_part_at *)u;
	return (struct lanes){t * a.re, t * a.im};
}

PM_SIMD_INLINE void fly2(const struct c8 *x, size_t m, struct c8 *y, size_t n, const double *w, const double *u, enum way way)
{
	struct lanes a0 = take(x), a1 = take(x + m);
	if (w && way == BACK)
		a1 = twisted(a1, w, true);
	struct lanes s = plus(a0, a1), d = minus(a0, a1);
	if (way == BOTH) {
		a0 = by(s, u), a1 = by(d, u + EACH);
		s = plus(a0, a1), d = minus(a0, a1);
	}
	put(y, s);
	put(y + n, w && way != BACK ? twisted(d, w, false) : d);
}

PM_SIMD_INLINE void fly4(const struct c8 *x, size_t m, struct c8 *y, size_t n, const double *w, const double *u, enum way way)
{
	struct lanes a0 = take(x), a1 = take(x + m), a2 = take(x + 2 * m), a3 = take(x + 3 * m);
	if (w && way == BACK)
		a1 = twisted(a1, w, true), a2 = twisted(a2, w + 2, true), a3 = twisted(a3, w + 4, true);
	dft4(&a0, &a1, &a2, &a3, way == BACK);
	if (way == BOTH) {
		a0 = by(a0, u), a1 = by(a1, u + EACH), a2 = by(a2, u + 2 * EACH), a3 = by(a3, u + 3 * EACH);
		dft4(&a0, &a1, &a2, &a3, true);
	}
	if (w && way != BACK)
		a1 = twisted(a1, w, false), a2 = twisted(a2, w + 2, false), a3 = twisted(a3, w + 4, false);
	put(y, a0), put(y + n, a1), put(y + 2 * n, a2), put(y + 3 * n, a3);
}

PM_SIMD_INLINE void twist8(struct eight *a, const double *w, bool back)
{
	a->a1 = twisted(a->a1, w, back), a->a2 = twisted(a->a2, w + 2, back), a->a3 = twisted(a->a3, w + 4, back), a->a4 = twisted(a->a4, w + 6, back);
	a->a5 = twisted(a->a5, w + 8, back), a->a6 = twisted(a->a6, w + 10, back), a->a7 = twisted(a->a7, w + 12, back);
}

PM_SIMD_INLINE void fly8(const struct c8 *x, size_t m, struct c8 *y, size_t n, const double *w, const double *u, enum way way)
{
	struct eight a = {take(x), take(x + m), take(x + 2 * m), take(x + 3 * m), take(x + 4 * m), take(x + 5 * m), take(x + 6 * m), take(x + 7 * m)};
	if (w && way == BACK)
		twist8(&a, w, true);
	dft8(&a, way == BACK);
	if (way == BOTH) {
		a.a0 = by(a.a0, u), a.a1 = by(a.a1, u + EACH), a.a2 = by(a.a2, u + 2 * EACH), a.a3 = by(a.a3, u + 3 * EACH);
		a.a4 = by(a.a4, u + 4 * EACH), a.a5 = by(a.a5, u + 5 * EACH), a.a6 = by(a.a6, u + 6 * EACH), a.a7 = by(a.a7, u + 7 * EACH);
		dft8(&a, true);
	}
	if (w && way != BACK)
		twist8(&a, w, false);
	put(y, a.a0), put(y + n, a.a1), put(y + 2 * n, a.a2), put(y + 3 * n, a.a3);
	put(y + 4 * n, a.a4), put(y + 5 * n, a.a5), put(y + 6 * n, a.a6), put(y + 7 * n, a.a7);
}

PM_SIMD_INLINE void fly_odd(int r, const struct pm_fft *f, const struct c8 *x, size_t m, struct c8 *y, size_t n, const double *w, const double *u, enum way way)
{
	struct lanes a[PM_PRIME];
	for (int q = 0; q < r; q++)
		a[q] = take(x + (size_t)q * m);
	for (int p = 1; p < r && w && way == BACK; p++)
		a[p] = twisted(a[p], w + 2 * (p - 1), true);
	dft_odd(r, f->cosine[r], f->sine[r], way == BACK, a);
	for (int q = 0; q < r && way == BOTH; q++)
		a[q] = by(a[q], u + q * EACH);
	if (way == BOTH)
		dft_odd(r, f->cosine[r], f->sine[r], true, a);
	for (int p = 1; p < r && w && way != BACK; p++)
		a[p] = twisted(a[p], w + 2 * (p - 1), false);
	for (int q = 0; q < r; q++)
		put(y + (size_t)q * n, a[q]);
}

PM_SIMD_INLINE void fly(int r, const struct pm_fft *f, const struct c8 *x, size_t m, struct c8 *y, size_t n, const double *w, const double *u, enum way way)
{
	if (r == 2)
		fly2(x, m, y, n, w, u, way);
	else if (r == 4)
		fly4(x, m, y, n, w, u, way);
	else if (r == 8)
		fly8(x, m, y, n, w, u, way);
	else
		fly_odd(r, f, x, m, y, n, w, u, way);
}

/* Forward from elements of which the second half is zero, and back to the first half. */
PM_SIMD_INLINE void half_forward(int r, const struct c8 *x, size_t m, struct c8 *y, size_t n, const double *w)
{
	struct eight a;
	if (r == 8) {
		dft4_half(take(x), take(x + 2 * m), &a.a0, &a.a2, &a.a4, &a.a6);
		dft4_half(take(x + m), take(x + 3 * m), &a.a1, &a.a3, &a.a5, &a.a7);
		join8(&a, false);
		twist8(&a, w, false);
		put(y + 4 * n, a.a4), put(y + 5 * n, a.a5), put(y + 6 * n, a.a6), put(y + 7 * n, a.a7);
	} else if (r == 4) {
		dft4_half(take(x), take(x + m), &a.a0, &a.a1, &a.a2, &a.a3);
		a.a1 = twisted(a.a1, w, false), a.a2 = twisted(a.a2, w + 2, false), a.a3 = twisted(a.a3, w + 4, false);
	} else {
		a.a0 = take(x), a.a1 = twisted(a.a0, w, false);
	}
	put(y, a.a0), put(y + n, a.a1);
	if (r > 2)
		put(y + 2 * n, a.a2), put(y + 3 * n, a.a3);
}

PM_SIMD_INLINE void half_back(int r, const struct c8 *x, size_t m, struct c8 *y, size_t n, const double *w)
{
	if (r == 8) {
		struct eight a = {take(x), take(x + m), take(x + 2 * m), take(x + 3 * m), take(x + 4 * m), take(x + 5 * m), take(x + 6 * m), take(x + 7 * m)};
		twist8(&a, w, true);
		dft8(&a, true);
		put(y, a.a0), put(y + n, a.a1), put(y + 2 * n, a.a2), put(y + 3 * n, a.a3);
	} else if (r == 4) {
		struct lanes a0 = take(x), a1 = twisted(take(x + m), w, true), a2 = twisted(take(x + 2 * m), w + 2, true);
		struct lanes a3 = twisted(take(x + 3 * m), w + 4, true);
		dft4(&a0, &a1, &a2, &a3, true);
		put(y, a0), put(y + n, a1);
	} else {
		put(y, plus(take(x), twisted(take(x + m), w, true)));
	}
}

#endif
