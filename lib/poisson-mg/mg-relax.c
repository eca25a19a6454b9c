/* Red-black Gauss-Seidel and the residual, row by row, for the 3-, 5- and 7-point Laplacian.
 *   u += (omega/D) (lap u - f) on the nodes of one colour, D = 2 (1/hx^2 + 1/hy^2 + 1/hz^2); r = f - lap u
 * (Trottenberg, Oosterlee, Schueller 2001, section 2.1.2). Colours are the parity of i+j+k, so the nodes of one colour are the even or the odd half of
 * each row (mg-level.h) and every value computed is used. On a periodic axis with an odd number of nodes two nodes of one colour are neighbours: along x
 * each uses the old value of the other, along y and z the order of the sweep decides, always the same.
 * Cost: 13 operations per node and sweep. SPDX-License-Identifier: GPL-3.0-or-later */
#include "poisson-mg/mg-vector.h"
#include "poisson-mg/mg-hierarchy.h"

#include <string.h>

PM_SIMD_INLINE struct mg_rows rows_at(const struct mg_level *l, size_t j, size_t k)
{
	const struct mg_axis *y = &l->axis[1], *z = &l->axis[2];
	mg_number *plane = l->u + mg_plane(l, k);
	size_t row = j * l->stride;
	return (struct mg_rows){.u = plane + row, .f = l->f + mg_plane(l, k) + row,
		.south = plane + mg_below(y, j) * l->stride, .north = plane + mg_above(y, j) * l->stride,
		.back = l->u + mg_plane(l, mg_below(z, k)) + row, .front = l->u + mg_plane(l, mg_above(z, k)) + row};
}

PM_SIMD_INLINE mg_vector along_y(const struct mg_rows *a, size_t i) { return mg_load(a->south + i) + mg_load(a->north + i); }
PM_SIMD_INLINE mg_vector along_z(const struct mg_rows *a, size_t i) { return mg_load(a->back + i) + mg_load(a->front + i); }

/* Laplacian from the sums of the neighbours along x, y and z and the node itself. */
#define LAPLACIAN(result, alongx, alongy, alongz, here) \
	do { \
		result = wx * (alongx); \
		if (dim == 3) \
			result += wy * (alongy); \
		if (dim >= 2) \
			result += wz * (alongz); \
		result -= diagonal * (here); \
	} while (0)

/* u += change at p, only where there is an unknown; walls and padding are in the first and the last eight of half a row. */
#define CHANGE(p, here, change, mask, i, n) \
	do { \
		if ((i) < mg_lanes || (i) + mg_lanes >= (n)) \
			change = mg_masked(change, (mask) + (i)); \
		mg_store(p, (here) + change); \
	} while (0)

/* Relaxes the even (odd = 0) or the odd half of a row. */
PM_SIMD_INLINE void relax_row(const int dim, const struct mg_level *l, mg_number factor, struct mg_rows a, const int odd)
{
	const mg_number wx = (mg_number)l->axis[0].w, wy = (mg_number)l->axis[1].w, wz = (mg_number)l->axis[2].w, diagonal = (mg_number)l->diagonal;
	const size_t at = odd ? l->half : 0, n = (l->axis[0].points + !odd) / 2;
	mg_number *other = a.u + l->half - at;
	mg_vector last = {0}, next, here, lap, sides, change;
	last += mg_left_end(l, a.u);
	if (odd)
		last = mg_load(other);
	for (size_t i = 0, end = (n + W - 1) / W * W; i < end; i += W) {
		next = mg_load(other + i + (odd ? W : 0));
		here = mg_load(a.u + at + i);
		if (odd)
			sides = last + mg_shift_down(last, next);
		else
			sides = mg_shift_up(last, next) + next;
		LAPLACIAN(lap, sides, along_y(&a, at + i), along_z(&a, at + i), here);
		change = factor * (lap - mg_load(a.f + at + i));
		CHANGE(a.u + at + i, here, change, l->mask[odd], i, n);
		last = next;
	}
	mg_close_row(l, a.u);
}

/* Relaxes the even half of row e and the odd half of row o, which are neighbours: what one has beside it along x, the other has along y, so that two
 * of five loads are saved. beyond_e and beyond_o are their outer neighbours along y. The next two rows are prefetched: pieces of half a row are too short
 * for the processor to foresee. The bytes are those of relax_row. */
PM_SIMD_INLINE void relax_pair(const struct mg_level *l, mg_number factor, struct mg_rows e, struct mg_rows o, const mg_number *beyond_e,
	const mg_number *beyond_o)
{
	enum { dim = 3 };
	const mg_number wx = (mg_number)l->axis[0].w, wy = (mg_number)l->axis[1].w, wz = (mg_number)l->axis[2].w, diagonal = (mg_number)l->diagonal;
	const size_t ahead = 2 * l->stride;
	const size_t half = l->half, n = (l->axis[0].points + 1) / 2, m = l->axis[0].points / 2;
	mg_vector e_last = {0}, e_next, o_last, o_next, here, lap, sides, change;
	e_last += mg_left_end(l, e.u);
	o_last = mg_load(o.u);
	for (size_t i = 0, end = (n + W - 1) / W * W; i < end; i += W) {
		__builtin_prefetch(e.f + ahead + i), __builtin_prefetch(o.f + ahead + half + i);
		__builtin_prefetch(e.front + ahead + i), __builtin_prefetch(o.front + ahead + half + i);
		e_next = mg_load(e.u + half + i);
		o_next = mg_load(o.u + i + W);
		here = mg_load(e.u + i);
		sides = mg_shift_up(e_last, e_next) + e_next;
		LAPLACIAN(lap, sides, mg_load(beyond_e + i) + o_last, along_z(&e, i), here);
		change = factor * (lap - mg_load(e.f + i));
		CHANGE(e.u + i, here, change, l->mask[0], i, n);
		here = mg_load(o.u + half + i);
		sides = o_last + mg_shift_down(o_last, o_next);
		LAPLACIAN(lap, sides, mg_load(beyond_o + half + i) + e_next, along_z(&o, half + i), here);
		change = factor * (lap - mg_load(o.f + half + i));
		CHANGE(o.u + half + i, here, change, l->mask[1], i, m);
		e_last = e_next;
		o_last = o_next;
	}
	mg_close_row(l, e.u);
	mg_close_row(l, o.u);
}

/* A row without vectors or masks: the reference for relax_row in tests. */
void pm_mg_relax_plain(const struct mg_level *l, double relaxation, int colour, size_t k)
{
	const struct mg_axis *x = &l->axis[0], *y = &l->axis[1];
	double factor = relaxation / l->diagonal;
	for (size_t j = y->first; j < y->end; j++) {
		struct mg_rows a = rows_at(l, j, k);
		double left = mg_left_end(l, a.u);
		for (size_t i = x->first; i < x->end; i++) {
			size_t at = mg_slot(l, i);
			if (((i + j + k) & 1) != (size_t)colour)
				continue;
			double lap = x->w * ((i ? a.u[mg_slot(l, i - 1)] : left) + a.u[mg_slot(l, i + 1)]);
			if (l->dim == 3)
				lap += y->w * (a.south[at] + a.north[at]);
			if (l->dim >= 2)
				lap += l->axis[2].w * (a.back[at] + a.front[at]);
			lap -= l->diagonal * a.u[at];
			a.u[at] = a.u[at] + factor * (lap - a.f[at]);
		}
		mg_close_row(l, a.u);
	}
}

PM_SIMD_INLINE void relax_rows(const int dim, const struct mg_level *l, mg_number factor, int colour, size_t j, size_t k)
{
	if ((j + k + (size_t)colour) & 1)
		relax_row(dim, l, factor, rows_at(l, j, k), 1);
	else
		relax_row(dim, l, factor, rows_at(l, j, k), 0);
}

/* Two rows at a time, unless they meet across the seam of a periodic axis too. */
static void relax_plane(const struct mg_level *l, mg_number factor, int colour, size_t k)
{
	const struct mg_axis *y = &l->axis[1];
	size_t j = y->first;
	for (; j + 1 < y->end && y->points > 2; j += 2) {
		struct mg_rows a = rows_at(l, j, k), b = rows_at(l, j + 1, k);
		if ((j + k + (size_t)colour) & 1)
			relax_pair(l, factor, b, a, b.north, a.south);
		else
			relax_pair(l, factor, a, b, a.south, b.north);
	}
	for (; j < y->end; j++)
		relax_rows(3, l, factor, colour, j, k);
}

void pm_mg_relax_plane(const struct mg_level *l, double relaxation, int colour, size_t k)
{
	const mg_number factor = (mg_number)(relaxation / l->diagonal);
	if (l->dim == 3)
		relax_plane(l, factor, colour, k);
	else if (l->dim == 2)
		relax_rows(2, l, factor, colour, 0, k);
	else
		relax_rows(1, l, factor, colour, 0, k);
}

PM_SIMD_INLINE double residual_row(const int dim, const struct mg_level *l, struct mg_rows a, mg_number *restrict r)
{
	const mg_number wx = (mg_number)l->axis[0].w, wy = (mg_number)l->axis[1].w, wz = (mg_number)l->axis[2].w, diagonal = (mg_number)l->diagonal;
	const size_t half = l->half;
	const mg_mask *mask[2] = {l->mask[0], l->mask[1]};
	mg_vector before = {0}, even, odd, after, lap, v, w, sum[mg_lanes / W] = {{0}};
	before += mg_left_end(l, a.u);
	even = mg_load(a.u);
	for (size_t block = 0; 2 * block < l->axis[0].points; block += mg_lanes) {
		PM_SIMD_UNROLL
		for (size_t part = 0; part < mg_lanes / W; part++) {
			const size_t i = block + part * W;
			odd = mg_load(a.u + half + i);
			after = mg_load(a.u + i + W);
			LAPLACIAN(lap, mg_shift_up(before, odd) + odd, along_y(&a, i), along_z(&a, i), even);
			v = mg_masked(mg_load(a.f + i) - lap, mask[0] + i);
			LAPLACIAN(lap, even + mg_shift_down(even, after), along_y(&a, half + i), along_z(&a, half + i), odd);
			w = mg_masked(mg_load(a.f + half + i) - lap, mask[1] + i);
			sum[part] += v * v + w * w;
			mg_store(r + i, v);
			mg_store(r + half + i, w);
			before = odd;
			even = after;
		}
	}
	mg_number lane[mg_lanes];
	double s[8];
	memcpy(lane, sum, sizeof lane);
	for (size_t q = 0; q < 8; q++)
		s[q] = mg_lanes > 8 ? (double)lane[q] + (double)lane[(q + 8) % mg_lanes] : (double)lane[q];
	return ((s[0] + s[4]) + (s[1] + s[5])) + ((s[2] + s[6]) + (s[3] + s[7]));
}

double pm_mg_residual_of(const struct mg_level *l, struct mg_rows a, mg_number *r)
{
	double sum = l->dim == 3 ? residual_row(3, l, a, r) : l->dim == 2 ? residual_row(2, l, a, r) : residual_row(1, l, a, r);
	mg_close_row(l, r);
	return sum;
}

double pm_mg_residual_row(const struct mg_level *l, size_t j, size_t k, mg_number *r)
{
	return l->order == 4 ? pm_mg_compact_residual(l, j, k, r) : pm_mg_residual_of(l, rows_at(l, j, k), r);
}
