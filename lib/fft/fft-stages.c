/* The stages of the transforms of eight lines side by side (fft-block.c): butterflies of radix 2, 3, 4, 5, 7, 8, 11, 13 in registers. The first stage reads
 * where the lines are and the last one writes where they go, so that nothing is copied; a convolution multiplies between the last stage forward and the first
 * one back, which work on the same rows. Of lines whose second half is zero, or not wanted, those two leave out its rows. Blocks that exceed the L1 cache
 * with their twiddles (above 192 rows) go through the stages after the first one piece by piece. Plain vector arithmetic without fused operations: the same
 * bytes on every processor. Cost: 5 n log2 n per line, from L1.
 * SPDX-License-Identifier: GPL-3.0-or-later */
#include <string.h>

#include "fft/butterfly.h"
#include "fft/prime-dft.h"

enum { L = PM_FFT_LINES, WHOLE = 192 };

/* Rows that are fetched into the L2 cache while butterflies are computed, so many for 16 that these read. */
struct soon {
	const char *at;
	size_t step, left; /* [bytes]; rows */
	int rows;
};

/* Where the rows of a stage are. */
struct rows {
	struct c8 *x;
	size_t step;
};

/* Rows first to end-1, in pieces of length. */
struct span {
	size_t first, end, length;
	struct soon *soon; /* or NULL */
};

PM_SIMD_INLINE void fetch(struct soon *soon, int r)
{
	for (int i = 0; soon && soon->left && i < (soon->rows * r + 15) / 16; i++, soon->at += soon->step, soon->left--)
		__builtin_prefetch(soon->at, 0, 1), __builtin_prefetch(soon->at + 64, 0, 1);
}

PM_SIMD_INLINE void flies(int r, const struct pm_fft *f, struct rows from, struct rows to, size_t row, size_t m, const double *w, const double *u, enum way way)
{
	PM_SIMD_UNROLL
	for (int part = 0; part < PM_FFT_PARTS; part++) {
		const struct c8 *x = part_of((const double *)(from.x + row * from.step), part);
		struct c8 *y = part_of((const double *)(to.x + row * to.step), part);
		const double *v = way == BOTH ? u + row * (L / 2) + (size_t)(part * PM_SIMD_PART) : NULL;
		fly(r, f, x, m * from.step, y, m * to.step, w, v, way);
	}
}

PM_SIMD_INLINE void stage(int r, const struct pm_fft *f, struct span span, const double *twiddle, const double *u, enum way way, struct rows from,
	struct rows to)
{
	const size_t m = span.length / (size_t)r;
	if (m == 1 || way == BOTH) {
		for (size_t base = span.first; base < span.end; base += span.length) {
			fetch(span.soon, r);
			flies(r, f, from, to, base, 1, NULL, u, way);
		}
		return;
	}
	for (size_t base = span.first; base < span.end; base += span.length) {
		const double *w = twiddle;
		for (size_t j = 0; j < m; j++, w += 2 * (r - 1)) {
			fetch(span.soon, r);
			flies(r, f, from, to, base + j, m, w, NULL, way);
		}
	}
}

/* The stages of radix f->radix[s]: forward, back, and the last one forward and back with factors between. */
#define RADICES(way, span, other) \
	switch (f->radix[s]) { \
	case 2: stage(2, f, span, w, factors, way, from, to); break; \
	case 3: stage(3, f, span, w, factors, way, from, to); break; \
	case 4: stage(4, f, span, w, factors, way, from, to); break; \
	case 5: stage(5, f, span, w, factors, way, from, to); break; \
	case 7: stage(7, f, span, w, factors, way, from, to); break; \
	case 8: stage(8, f, span, w, factors, way, from, to); break; \
	case 11: stage(11, f, span, w, factors, way, from, to); break; \
	case 13: stage(13, f, span, w, factors, way, from, to); break; \
	default: other; \
	}
#define STAGES(name, way, other) \
	static void stage_##name(const struct pm_fft *f, int s, struct span span, const double *factors, struct rows from, struct rows to) \
	{ \
		const double *w = f->twiddle[s]; \
		const struct span alone = {span.first, span.end, span.length, NULL}; /* without a question at every butterfly */ \
		if (span.soon) \
			RADICES(way, span, other) \
		else \
			RADICES(way, alone, other) \
	}
#define PRIME(back) pm_prime_stage(f, s, back, (struct pm_stage_rows){span.first, span.end, span.length, from.x, from.step, to.x, to.step})
STAGES(forward, FORWARD, PRIME(false))
STAGES(back, BACK, PRIME(true))
STAGES(both, BOTH, return)

/* The first stage, of even radix, with `some` = n/2 or n/2+1 rows that are not zero; and the way back to so many. Elements 0, n/2 and those between them of
 * this distance are a butterfly of their own. */
PM_SIMD_INLINE void half_stage(int r, const struct pm_fft *f, bool back, size_t some, struct rows from, struct rows to)
{
	const size_t m = f->n / (size_t)r;
	const double *w = f->twiddle[0];
	PM_SIMD_UNROLL
	for (int part = 0; part < PM_FFT_PARTS; part++) {
		struct c8 own[8] __attribute__((aligned(64)));
		const struct c8 *x = part_of((const double *)from.x, part);
		struct c8 *y = part_of((const double *)to.x, part);
		memset(own, 0, sizeof own);
		for (int q = 0; q < r && !back; q++)
			if ((size_t)q * m < some)
				put(own + q, take(x + (size_t)q * m * from.step));
		if (back)
			fly(r, f, x, m * from.step, own, 1, NULL, NULL, BACK);
		else
			fly(r, f, own, 1, y, m * to.step, NULL, NULL, FORWARD);
		for (int q = 0; q < r && back; q++)
			if ((size_t)q * m < some)
				put(y + (size_t)q * m * to.step, take(own + q));
	}
	for (size_t j = 1; j < m; j++) {
		w += 2 * (r - 1);
		PM_SIMD_UNROLL
		for (int part = 0; part < PM_FFT_PARTS; part++) {
			const struct c8 *x = part_of((const double *)(from.x + j * from.step), part);
			struct c8 *y = part_of((const double *)(to.x + j * to.step), part);
			(back ? half_back : half_forward)(r, x, m * from.step, y, m * to.step, w);
		}
	}
}

#define HALF(name, back) \
	static void half_stage_##name(const struct pm_fft *f, size_t some, struct rows from, struct rows to) \
	{ \
		if (f->radix[0] == 8) \
			half_stage(8, f, back, some, from, to); \
		else if (f->radix[0] == 4) \
			half_stage(4, f, back, some, from, to); \
		else \
			half_stage(2, f, back, some, from, to); \
	}
HALF(forward, false)
HALF(back, true)

static bool halved(const struct pm_fft *f, size_t some)
{
	return f->stages && f->n % 2 == 0 && (some == f->n / 2 || some == f->n / 2 + 1);
}

static void first_stage(const struct pm_fft *f, size_t some, struct soon *soon, struct rows from, struct rows to)
{
	if (some)
		half_stage_forward(f, some, from, to);
	else
		stage_forward(f, 0, (struct span){0, f->n, f->n, soon}, NULL, from, to);
}

static void last_stage(const struct pm_fft *f, size_t some, struct soon *soon, struct rows from, struct rows to)
{
	if (some)
		half_stage_back(f, some, from, to);
	else
		stage_back(f, 0, (struct span){0, f->n, f->n, soon}, NULL, from, to);
}

static struct rows rows_of(struct pm_fft_place p) { return (struct rows){(struct c8 *)p.at, p.step / L}; }

/* Two lines a row, over so many stages. */
static struct soon soon_of(const struct pm_fft *f, struct pm_fft_place from, bool both)
{
	const int stages = (both ? 2 * f->stages - 1 : f->stages) - (from.some ? 1 + both : 0);
	const size_t rows = from.some ? from.some : f->n;
	return (struct soon){(const char *)from.next, from.step * sizeof(double), rows, stages > 0 ? (from.some ? 8 : 16) / stages + 1 : 0};
}

static void copy(size_t n, struct pm_fft_place from, struct pm_fft_place to)
{
	for (size_t i = 0; i < n && from.at != to.at; i++)
		memcpy(to.at + i * to.step, from.at + i * from.step, L * sizeof(double));
}

/* The rows that are not zero, with zeros behind them, to the block. */
static void fill(const struct pm_fft *f, struct pm_fft_place from, double *block)
{
	copy(from.some, from, (struct pm_fft_place){block, L, 0, NULL});
	memset(block + from.some * L, 0, (f->n - from.some) * L * sizeof *block);
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
static size_t down(const struct pm_fft *f, int last, struct span piece, struct rows block, struct rows to)
{
	for (int s = 1; s < last; piece.length /= (size_t)f->radix[s++])
		stage_forward(f, s, piece, NULL, block, s == f->stages - 1 ? to : block);
	return piece.length;
}

/* Stages `from`-1 to 1 of a piece, back. */
static void up(const struct pm_fft *f, int last, struct span piece, struct rows from, struct rows block)
{
	for (int s = last - 1; s > 0; s--) {
		piece.length *= (size_t)f->radix[s];
		stage_back(f, s, piece, NULL, s == f->stages - 1 ? from : block, block);
	}
}

void pm_fft_forward_moving(const struct pm_fft *f, struct pm_fft_place from, double *block, struct pm_fft_place to)
{
	struct soon ahead = soon_of(f, from, false), *soon = from.next ? &ahead : NULL;
	const struct rows x = rows_of(from), work = {(struct c8 *)block, 1}, y = rows_of(to);
	const struct pm_fft_place own = {block, L, 0, NULL};
	if (from.some && !halved(f, from.some)) {
		fill(f, from, block);
		pm_fft_forward_moving(f, own, block, to);
		return;
	}
	if (!f->stages) {
		copy(f->n, from, own), by_fftw(f, false, block), copy(f->n, own, to);
		return;
	}
	first_stage(f, from.some, soon, x, f->stages > 1 ? work : y);
	for (size_t first = 0, size = piece(f); first < f->n && f->stages > 1; first += size)
		down(f, f->stages, (struct span){first, first + size, f->n / (size_t)f->radix[0], soon}, work, y);
}

void pm_fft_backward_moving(const struct pm_fft *f, struct pm_fft_place from, double *block, struct pm_fft_place to)
{
	struct soon ahead = soon_of(f, from, false), *soon = from.next ? &ahead : NULL;
	const struct rows x = rows_of(from), work = {(struct c8 *)block, 1}, y = rows_of(to);
	const struct pm_fft_place own = {block, L, 0, NULL};
	if (to.some && !halved(f, to.some)) {
		pm_fft_backward_moving(f, from, block, own);
		copy(to.some, own, to);
		return;
	}
	if (!f->stages) {
		copy(f->n, from, own), by_fftw(f, true, block), copy(f->n, own, to);
		return;
	}
	for (size_t first = 0, size = piece(f); first < f->n && f->stages > 1; first += size)
		up(f, f->stages, (struct span){first, first + size, 1, soon}, x, work);
	last_stage(f, to.some, soon, f->stages > 1 ? work : x, y);
}

void pm_fft_times_moving(const struct pm_fft *f, struct pm_fft_place from, const double *u, double *block, struct pm_fft_place to)
{
	struct soon ahead = soon_of(f, from, true), *soon = from.next ? &ahead : NULL;
	const struct rows x = rows_of(from), work = {(struct c8 *)block, 1}, y = rows_of(to);
	const struct pm_fft_place own = {block, L, 0, NULL};
	const int last = f->stages - 1;
	const bool some = from.some || to.some;
	if (last < 0 || f->radix[last] > PM_PRIME || (some && (last == 0 || !halved(f, from.some) || !halved(f, to.some)))) {
		pm_fft_forward_moving(f, from, block, own);
		times(f, u, block);
		pm_fft_backward_moving(f, own, block, to);
		return;
	}
	if (last == 0) {
		stage_both(f, 0, (struct span){0, f->n, f->n, soon}, u, x, y);
		return;
	}
	first_stage(f, from.some, soon, x, work);
	for (size_t first = 0, size = piece(f); first < f->n; first += size) {
		struct span span = {first, first + size, f->n / (size_t)f->radix[0], soon};
		span.length = down(f, last, span, work, work);
		stage_both(f, last, span, u, work, work);
		up(f, last, span, work, work);
	}
	last_stage(f, to.some, soon, work, y);
}

void pm_fft_forward(const struct pm_fft *f, double *block)
{
	const struct pm_fft_place own = {block, L, 0, NULL};
	pm_fft_forward_moving(f, own, block, own);
}

void pm_fft_backward(const struct pm_fft *f, double *block)
{
	const struct pm_fft_place own = {block, L, 0, NULL};
	pm_fft_backward_moving(f, own, block, own);
}
