/* One row of a difference: by any taps, node after node; and rows of regular taps added in registers, each number read from the cache and written once, past
 * the caches on large meshes: line by line as it is computed, so that the memory is written to while the next line is computed. A component's row is written
 * as a whole before the next component's: lines of three components in turn leave the processor's buffers half filled (7.9 GB/s instead of 31 on Zen 3).
 * SPDX-License-Identifier: GPL-3.0-or-later */
#define PM_SIMD_NARROW
#include "base/simd.h"
#include "fft/fft-block.h"
#include "mesh/difference-rows.h"

enum { W = PM_SIMD_WIDTH, LINE = 8, MOST = 3 };

/* out[i] (+)= sum_k w[k] from[k][i] */
static void combine(const struct pm_taps *t, const double *const from[], bool add, size_t count, double *restrict out)
{
	size_t i = 0;
	for (; i + W <= count; i += W) {
		pm_simd sum = add ? pm_simd_load_any(out + i) : (pm_simd){0};
		for (int k = 0; k < t->n; k++)
			sum = sum + t->w[k] * pm_simd_load_any(from[k] + i);
		pm_simd_store_any(out + i, sum);
	}
	for (; i < count; i++) {
		double sum = add ? out[i] : 0;
		for (int k = 0; k < t->n; k++)
			sum += t->w[k] * from[k][i];
		out[i] = sum;
	}
}

/* The same for the regular taps: pairs up and down of weight +-w (first derivative) or w (second, with the middle behind them). */
PM_SIMD_INLINE void pairs(int n, int derivative, const struct pm_taps *t, const double *const from[], bool add, size_t count, double *restrict out)
{
	const double *u0 = from[0], *d0 = from[1], *u1 = n > 1 ? from[2] : u0, *d1 = n > 1 ? from[3] : d0, *u2 = n > 2 ? from[4] : u0,
		*d2 = n > 2 ? from[5] : d0, *c = derivative == 2 ? from[2 * n] : u0;
	const double w0 = t->w[0], w1 = n > 1 ? t->w[2] : 0, w2 = n > 2 ? t->w[4] : 0, wc = derivative == 2 ? t->w[2 * n] : 0;
	const double sign = derivative == 1 ? -1 : 1;
	for (size_t i = 0; i < count; i++) {
		double sum = w0 * (u0[i] + sign * d0[i]);
		if (n > 1)
			sum += w1 * (u1[i] + sign * d1[i]);
		if (n > 2)
			sum += w2 * (u2[i] + sign * d2[i]);
		if (derivative == 2)
			sum += wc * c[i];
		out[i] = add ? out[i] + sum : sum;
	}
}

PM_SIMD_INLINE void pairs_add(int n, int derivative, const struct pm_taps *t, const double *const from[], bool add, size_t count, double *out)
{
	if (add)
		pairs(n, derivative, t, from, true, count, out);
	else
		pairs(n, derivative, t, from, false, count, out);
}

static void regular(const struct pm_taps *t, const double *const from[], bool add, size_t count, double *out)
{
	switch (t->n) {
	case 2: pairs_add(1, 1, t, from, add, count, out); break;
	case 3: pairs_add(1, 2, t, from, add, count, out); break;
	case 4: pairs_add(2, 1, t, from, add, count, out); break;
	case 5: pairs_add(2, 2, t, from, add, count, out); break;
	case 6: pairs_add(3, 1, t, from, add, count, out); break;
	default: pairs_add(3, 2, t, from, add, count, out);
	}
}

/* Nodes from node `at` to the node `to` of a tap, along the axis that is divided: over the end where that is nearer, since halos continue a periodic
 * axis. */
static ptrdiff_t nearest(const struct pm_difference_axis *a, ptrdiff_t to, size_t at)
{
	const ptrdiff_t n = (ptrdiff_t)a->points, away = to - (ptrdiff_t)at;
	return !a->around ? away : 2 * away > n ? away - n : 2 * away < -n ? away + n : away;
}

/* From the row to that of tap k. */
PM_SIMD_INLINE ptrdiff_t tap_step(const struct pm_difference_row *r, const struct pm_taps *t, int k)
{
	return (t == &r->axis->regular ? t->at[k] : nearest(r->axis, t->at[k], r->at)) * r->axis->stride;
}

static const struct pm_taps *taps_of(const struct pm_difference_row *r)
{
	const struct pm_difference_axis *a = r->axis;
	const bool inside = r->d == 0 || (r->at >= a->low && r->at < a->points - a->high);
	return inside ? &a->regular : &a->end[r->at < a->low ? r->at : r->at + a->low + a->high - a->points];
}

/* As pairs(), for one node. */
PM_SIMD_INLINE double pairs_at(const double *in, const struct pm_taps *t, int n)
{
	const double sign = n % 2 ? 1 : -1;
	double sum = t->w[0] * (in[t->at[0]] + sign * in[t->at[1]]);
	for (int k = 2; k + 1 < n; k += 2)
		sum += t->w[k] * (in[t->at[k]] + sign * in[t->at[k + 1]]);
	return n % 2 ? sum + t->w[n - 1] * in[t->at[n - 1]] : sum;
}

/* The nodes at an end of a row along it. */
static void ends(const struct pm_difference_row *r, int side, bool add, double *out)
{
	const struct pm_difference_axis *a = r->axis;
	const double *in = r->in + r->row;
	const size_t count = side ? a->high : a->low;
	const struct pm_taps *t = side ? a->end + a->low : a->end;
	double *to = side ? out + a->points - a->high : out;
	for (size_t i = 0; i < count; i++, t++) {
		double sum = 0;
		if (a->pairs)
			sum = pairs_at(in, t, a->regular.n);
		else
			for (int k = 0; k < t->n; k++)
				sum += t->w[k] * in[t->at[k]];
		to[i] = add ? to[i] + sum : sum;
	}
}

static void some(const struct pm_difference_row *r, size_t from, size_t to, bool add, double *out)
{
	const struct pm_difference_axis *a = r->axis;
	const struct pm_taps *t = taps_of(r);
	const double *at[PM_TAPS];
	if (r->d == 0) {
		ends(r, 0, add, out), ends(r, 1, add, out); /* a whole row */
		from = from > a->low ? from : a->low;
		to = to < a->points - a->high ? to : a->points - a->high;
	}
	if (from >= to)
		return;
	for (int k = 0; k < t->n; k++)
		at[k] = r->in + r->row + from + tap_step(r, t, k);
	if (pm_difference_regular(r))
		regular(t, at, add, to - from, out + from);
	else
		combine(t, at, add, to - from, out + from);
}

void pm_difference_any(const struct pm_difference_row *r, size_t n, bool add, double *out) { some(r, 0, n, add, out); }

/* The taps of rows that have the same: in registers. */
struct pair_row {
	const double *up[MOST], *down[MOST], *middle;
	double w[MOST], centre;
};

PM_SIMD_INLINE void pairs_of(int terms, int n, int derivative, const struct pm_difference_row *r, struct pair_row *p)
{
	PM_SIMD_UNROLL
	for (int m = 0; m < terms; m++) {
		const struct pm_taps *t = taps_of(&r[m]);
		p[m].middle = r[m].in + r[m].row, p[m].centre = t->w[derivative == 2 ? 2 * n : 0];
		PM_SIMD_UNROLL
		for (int k = 0; k < n; k++) {
			p[m].up[k] = p[m].middle + tap_step(&r[m], t, 2 * k), p[m].down[k] = p[m].middle + tap_step(&r[m], t, 2 * k + 1);
			p[m].w[k] = t->w[2 * k];
		}
	}
}

/* As pairs(). */
PM_SIMD_INLINE pm_simd pair_sum(int n, int derivative, const struct pair_row *p, size_t i)
{
	pm_simd sum = p->w[0] * (derivative == 1 ? pm_simd_load_any(p->up[0] + i) - pm_simd_load_any(p->down[0] + i) :
		pm_simd_load_any(p->up[0] + i) + pm_simd_load_any(p->down[0] + i));
	PM_SIMD_UNROLL
	for (int k = 1; k < n; k++)
		sum = sum + p->w[k] * (derivative == 1 ? pm_simd_load_any(p->up[k] + i) - pm_simd_load_any(p->down[k] + i) :
			pm_simd_load_any(p->up[k] + i) + pm_simd_load_any(p->down[k] + i));
	return derivative == 2 ? sum + p->centre * pm_simd_load_any(p->middle + i) : sum;
}

PM_SIMD_INLINE pm_simd sum_at(int terms, int n, int derivative, const struct pair_row *p, size_t i)
{
	pm_simd sum = pair_sum(n, derivative, &p[0], i);
	PM_SIMD_UNROLL
	for (int m = 1; m < terms; m++)
		sum = sum + pair_sum(n, derivative, &p[m], i);
	return sum;
}

/* Nodes from..to-1, at least W, to at[i]; the last vectors overlap. What is added to `wrong`: NaN stays, infinity makes one. */
PM_SIMD_INLINE pm_simd some_sums(int terms, int n, int derivative, const struct pair_row *p, size_t from, size_t to, double *at)
{
	pm_simd wrong = {0}, sum;
	for (size_t i = from; i + W <= to; i += W) {
		sum = sum_at(terms, n, derivative, p, i);
		pm_simd_store_any(at + i, sum);
		wrong = wrong + (sum - sum);
	}
	sum = sum_at(terms, n, derivative, p, to - W);
	pm_simd_store_any(at + to - W, sum);
	return wrong + (sum - sum);
}

PM_SIMD_INLINE void line_past(const pm_simd *line, double *out)
{
	PM_SIMD_UNROLL
	for (size_t q = 0; q < LINE / W; q++)
		pm_simd_part_past(out + q * W, line[q]);
}

/* Lines from..to. A line is written after the next one has been read: a processor takes a load for one of what it has just stored if the last twelve bits of
 * both addresses agree, as those of arrays of whole pages do, and waits (0.8 of the speed). */
PM_SIMD_INLINE pm_simd lines_past(int terms, int n, int derivative, const struct pair_row *p, const double *ahead, size_t from, size_t to, double *out)
{
	pm_simd wrong = {0}, line[LINE / W], wait[LINE / W] = {{0}};
	for (size_t i = from; i < to; i += LINE) {
		if (ahead)
			__builtin_prefetch(ahead + i);
		PM_SIMD_UNROLL
		for (size_t q = 0; q < LINE / W; q++) {
			line[q] = sum_at(terms, n, derivative, p, i + q * W);
			wrong = wrong + (line[q] - line[q]);
		}
		if (i > from)
			line_past(wait, out + i - LINE);
		PM_SIMD_UNROLL
		for (size_t q = 0; q < LINE / W; q++)
			wait[q] = line[q];
	}
	if (to > from)
		line_past(wait, out + to - LINE);
	return wrong;
}

static size_t line_from(const double *out, size_t i) { return i + -((uintptr_t)(out + i) / sizeof *out) % LINE; }

/* The ends of row `number` of the block by their own taps, to out[node of the block]; side 0 the low one. */
static bool row_end(int terms, const struct pm_difference_row *given, const struct pm_difference_block *b, size_t number, int side, double *out)
{
	const size_t start = number * b->n, low = start + (side ? b->n - b->high : 0), high = side ? start + b->n : start + b->low;
	for (int m = 0; m < terms; m++) {
		struct pm_difference_row r = given[m];
		r.row += start;
		if (r.d == 0)
			ends(&r, side, m, out + start);
		else
			some(&r, low - start, high - start, m, out + start);
	}
	return pm_finite_few(high - low, out + low);
}

/* Regular taps as if rows went on into each other, then the ends of rows. */
PM_SIMD_INLINE bool block_near(int terms, int n, int derivative, const struct pm_difference_row *r, const struct pm_difference_block *b, double *out)
{
	struct pair_row p[MOST];
	bool finite = true;
	pairs_of(terms, n, derivative, r, p);
	const pm_simd wrong = some_sums(terms, n, derivative, p, b->low, b->n * b->rows - b->high, out);
	for (size_t q = 0; q < b->rows && b->low; q++)
		finite = row_end(terms, r, b, q, 0, out) && row_end(terms, r, b, q, 1, out) && finite;
	return pm_simd_sum(wrong) == 0 && finite;
}

/* The same, lines past the caches; those with ends of rows in them through a buffer. */
PM_SIMD_INLINE bool block_past(int terms, int n, int derivative, const struct pm_difference_row *r, const struct pm_difference_block *b, double *out)
{
	struct pair_row p[MOST];
	const size_t all = b->n * b->rows, rows = b->low ? b->rows : 1, long_row = b->low ? b->n : all;
	double buffer[8 * LINE];
	pm_simd wrong = {0};
	bool finite = true;
	pairs_of(terms, n, derivative, r, p);
	for (size_t q = 0, done = 0; q <= rows; q++) {
		const size_t row = q * long_row, from = q < rows ? line_from(out, row + b->low) : all;
		const size_t first = q ? done : b->low, last = q < rows ? from : all - b->high;
		double *at = buffer + LINE - done; /* of node 0 */
		if (last > first)
			wrong = wrong + some_sums(terms, n, derivative, p, first, last < first + W && q < rows ? first + W : last, at);
		if (q && b->high)
			finite = row_end(terms, r, b, q - 1, 1, at) && finite;
		if (q < rows && b->low)
			finite = row_end(terms, r, b, q, 0, at) && finite;
		if (from > done)
			pm_stream(out + done, buffer + LINE, from - done);
		if (q == rows)
			break;
		done = from + (row + long_row - b->high - from) / LINE * LINE;
		wrong = wrong + lines_past(terms, n, derivative, p, b->ahead, from, done, out);
	}
	return pm_simd_sum(wrong) == 0 && finite;
}

PM_SIMD_INLINE bool block_of(int terms, bool past, const struct pm_difference_row *r, const struct pm_difference_block *b, double *out)
{
#define BLOCK(n, derivative) (past ? block_past(terms, n, derivative, r, b, out) : block_near(terms, n, derivative, r, b, out))
	switch (r->axis->regular.n) {
	case 2: return BLOCK(1, 1);
	case 3: return BLOCK(1, 2);
	case 4: return BLOCK(2, 1);
	case 5: return BLOCK(2, 2);
	case 6: return BLOCK(3, 1);
	default: return BLOCK(3, 2);
	}
#undef BLOCK
}

bool pm_difference_sum(int terms, const struct pm_difference_row *r, struct pm_difference_block b, double *out)
{
	for (int m = 0; m < terms; m++)
		if (r[m].d == 0)
			b.low = r[m].axis->low, b.high = r[m].axis->high;
	if (b.past)
		return terms == 1 ? block_of(1, true, r, &b, out) : terms == 2 ? block_of(2, true, r, &b, out) : block_of(3, true, r, &b, out);
	return terms == 1 ? block_of(1, false, r, &b, out) : terms == 2 ? block_of(2, false, r, &b, out) : block_of(3, false, r, &b, out);
}
