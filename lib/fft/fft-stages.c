/* The stages of the transforms of eight lines side by side (fft-block.c): butterflies of radix 2, 3, 4, 5, 7, 8, 11, 13 in registers. The first stage
 * reads where the lines are and the last one writes where they go, so that nothing is copied; a convolution multiplies between the last stage forward and
 * the first one back, which work on the same rows. Blocks that exceed the L1 cache with their twiddles (above 192 rows) go through the stages after the
 * first one piece by piece. Plain vector arithmetic without fused operations: the same bytes on every processor. Cost: 5 n log2 n per line, from L1.
 * SPDX-License-Identifier: GPL-3.0-or-later */
#include <string.h>

#include "fft/butterfly.h"
#include "fft/prime-dft.h"

enum { L = PM_FFT_LINES, WHOLE = 192 };

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
		a0 = by(s, u), a1 = by(d, u + L / 2);
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
		a0 = by(a0, u), a1 = by(a1, u + L / 2), a2 = by(a2, u + L), a3 = by(a3, u + 3 * L / 2);
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
		enum { H = L / 2 };
		a.a0 = by(a.a0, u), a.a1 = by(a.a1, u + H), a.a2 = by(a.a2, u + 2 * H), a.a3 = by(a.a3, u + 3 * H);
		a.a4 = by(a.a4, u + 4 * H), a.a5 = by(a.a5, u + 5 * H), a.a6 = by(a.a6, u + 6 * H), a.a7 = by(a.a7, u + 7 * H);
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
		a[q] = by(a[q], u + q * L / 2);
	if (way == BOTH)
		dft_odd(r, f->cosine[r], f->sine[r], true, a);
	for (int p = 1; p < r && w && way != BACK; p++)
		a[p] = twisted(a[p], w + 2 * (p - 1), false);
	for (int q = 0; q < r; q++)
		put(y + (size_t)q * n, a[q]);
}

/* Where the rows of a stage are. */
struct rows {
	struct c8 *x;
	size_t step;
};

PM_SIMD_INLINE void flies(int r, const struct pm_fft *f, struct rows from, struct rows to, size_t row, size_t m, const double *w, const double *u, enum way way)
{
	PM_SIMD_UNROLL
	for (int part = 0; part < PM_FFT_PARTS; part++) {
		const struct c8 *x = part_of((const double *)(from.x + row * from.step), part);
		struct c8 *y = part_of((const double *)(to.x + row * to.step), part);
		const double *v = way == BOTH ? u + row * (L / 2) + (size_t)(part * PM_SIMD_PART) : NULL;
		if (r == 2)
			fly2(x, m * from.step, y, m * to.step, w, v, way);
		else if (r == 4)
			fly4(x, m * from.step, y, m * to.step, w, v, way);
		else if (r == 8)
			fly8(x, m * from.step, y, m * to.step, w, v, way);
		else
			fly_odd(r, f, x, m * from.step, y, m * to.step, w, v, way);
	}
}

/* Rows first to end-1, in pieces of length. */
PM_SIMD_INLINE void stage(int r, const struct pm_fft *f, size_t first, size_t end, size_t length, const double *twiddle, const double *u, enum way way,
	struct rows from, struct rows to)
{
	const size_t m = length / (size_t)r;
	if (m == 1 || way == BOTH) {
		for (size_t base = first; base < end; base += length)
			flies(r, f, from, to, base, 1, NULL, u, way);
		return;
	}
	for (size_t base = first; base < end; base += length) {
		const double *w = twiddle;
		for (size_t j = 0; j < m; j++, w += 2 * (r - 1))
			flies(r, f, from, to, base + j, m, w, NULL, way);
	}
}

/* The stages of radix f->radix[s]: forward, back, and the last one forward and back with factors between. */
#define STAGES(name, way, other) \
	static void stage_##name(const struct pm_fft *f, int s, size_t first, size_t end, size_t length, const double *factors, struct rows from, \
		struct rows to) \
	{ \
		const double *w = f->twiddle[s]; \
		switch (f->radix[s]) { \
		case 2: stage(2, f, first, end, length, w, factors, way, from, to); break; \
		case 3: stage(3, f, first, end, length, w, factors, way, from, to); break; \
		case 4: stage(4, f, first, end, length, w, factors, way, from, to); break; \
		case 5: stage(5, f, first, end, length, w, factors, way, from, to); break; \
		case 7: stage(7, f, first, end, length, w, factors, way, from, to); break; \
		case 8: stage(8, f, first, end, length, w, factors, way, from, to); break; \
		case 11: stage(11, f, first, end, length, w, factors, way, from, to); break; \
		case 13: stage(13, f, first, end, length, w, factors, way, from, to); break; \
		default: other; \
		} \
	}
#define PRIME(back) pm_prime_stage(f, s, back, (struct pm_stage_rows){first, end, length, from.x, from.step, to.x, to.step})
STAGES(forward, FORWARD, PRIME(false))
STAGES(back, BACK, PRIME(true))
STAGES(both, BOTH, return)

static struct rows rows_of(struct pm_fft_place p) { return (struct rows){(struct c8 *)p.at, p.step / L}; }

static void copy(size_t n, struct pm_fft_place from, struct pm_fft_place to)
{
	for (size_t i = 0; i < n && from.at != to.at; i++)
		memcpy(to.at + i * to.step, from.at + i * from.step, L * sizeof(double));
}

static void by_fftw(const struct pm_fft *f, bool back, double *block)
{
	enum { H = L / 2 };
	if (f->forward && !back)
		fftw_execute_split_dft(f->forward, block, block + H, block, block + H);
	if (f->backward && back)
		fftw_execute_split_dft(f->backward, block + H, block, block + H, block); /* as planned: parts exchanged */
}

static void times(const struct pm_fft *f, const double *u, double *block)
{
	for (size_t i = 0; i < f->n; i++, u += L / 2, block += L)
		for (int q = 0; q < L / 2; q++)
			block[q] *= u[q], block[q + L / 2] *= u[q];
}

/* The rows that the stages after the first one work on together: all, or where these do not fit into the L1 cache one piece of it. */
static size_t piece(const struct pm_fft *f) { return f->n > WHOLE ? f->n / (size_t)f->radix[0] : f->n; }

/* Stages 1 to last-1 of a piece, forward; block is their work. Returns the length of the next one. */
static size_t down(const struct pm_fft *f, int last, size_t first, size_t end, struct rows block, struct rows to)
{
	size_t length = f->n / (size_t)f->radix[0];
	for (int s = 1; s < last; length /= (size_t)f->radix[s++])
		stage_forward(f, s, first, end, length, NULL, block, s == f->stages - 1 ? to : block);
	return length;
}

/* Stages `from`-1 to 1 of a piece, back. */
static void up(const struct pm_fft *f, int last, size_t first, size_t end, size_t length, struct rows from, struct rows block)
{
	for (int s = last - 1; s > 0; s--)
		stage_back(f, s, first, end, length *= (size_t)f->radix[s], NULL, s == f->stages - 1 ? from : block, block);
}

void pm_fft_forward_moving(const struct pm_fft *f, struct pm_fft_place from, double *block, struct pm_fft_place to)
{
	const struct rows x = rows_of(from), work = {(struct c8 *)block, 1}, y = rows_of(to);
	const struct pm_fft_place own = {block, L};
	if (!f->stages) {
		copy(f->n, from, own), by_fftw(f, false, block), copy(f->n, own, to);
		return;
	}
	stage_forward(f, 0, 0, f->n, f->n, NULL, x, f->stages > 1 ? work : y);
	for (size_t first = 0, size = piece(f); first < f->n && f->stages > 1; first += size)
		down(f, f->stages, first, first + size, work, y);
}

void pm_fft_backward_moving(const struct pm_fft *f, struct pm_fft_place from, double *block, struct pm_fft_place to)
{
	const struct rows x = rows_of(from), work = {(struct c8 *)block, 1}, y = rows_of(to);
	const struct pm_fft_place own = {block, L};
	if (!f->stages) {
		copy(f->n, from, own), by_fftw(f, true, block), copy(f->n, own, to);
		return;
	}
	for (size_t first = 0, size = piece(f); first < f->n && f->stages > 1; first += size)
		up(f, f->stages, first, first + size, 1, x, work);
	stage_back(f, 0, 0, f->n, f->n, NULL, f->stages > 1 ? work : x, y);
}

void pm_fft_times_moving(const struct pm_fft *f, struct pm_fft_place from, const double *u, double *block, struct pm_fft_place to)
{
	const struct rows x = rows_of(from), work = {(struct c8 *)block, 1}, y = rows_of(to);
	const struct pm_fft_place own = {block, L};
	const int last = f->stages - 1;
	if (last < 0 || f->radix[last] > PM_PRIME) {
		pm_fft_forward_moving(f, from, block, own);
		times(f, u, block);
		pm_fft_backward_moving(f, own, block, to);
		return;
	}
	if (last == 0) {
		stage_both(f, 0, 0, f->n, f->n, u, x, y);
		return;
	}
	stage_forward(f, 0, 0, f->n, f->n, NULL, x, work);
	for (size_t first = 0, size = piece(f); first < f->n; first += size) {
		const size_t length = down(f, last, first, first + size, work, work);
		stage_both(f, last, first, first + size, length, u, work, work);
		up(f, last, first, first + size, length, work, work);
	}
	stage_back(f, 0, 0, f->n, f->n, NULL, work, y);
}

void pm_fft_forward(const struct pm_fft *f, double *block)
{
	const struct pm_fft_place own = {block, L};
	pm_fft_forward_moving(f, own, block, own);
}

void pm_fft_backward(const struct pm_fft *f, double *block)
{
	const struct pm_fft_place own = {block, L};
	pm_fft_backward_moving(f, own, block, own);
}
