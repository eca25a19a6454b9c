/* Red-black Gauss-Seidel and the residual, row by row, for the 3-, 5- and 7-point Laplacian.
 *   u += (omega/D) (lap u - f) on the nodes of one colour, D = 2 (1/hx^2 + 1/hy^2 + 1/hz^2); r = f - lap u
 * (Trottenberg, Oosterlee, Schueller 2001, section 2.1.2). Colours are the parity of i+j+k, so the nodes of one colour are the even or the odd half of
 * each row (mg-level.h) and nothing is computed in vain. Where an odd number of nodes is periodic, two nodes of one colour meet: along x each sees
 * the old value of the other, along y and z the order of the sweep decides, always the same.
 * Cost: 13 operations per node and sweep. SPDX-License-Identifier: GPL-3.0-or-later */
#include "poisson/mg-level.h"

typedef double vec __attribute__((vector_size(8 * mg_lanes), may_alias));
typedef int64_t vmask __attribute__((vector_size(8 * mg_lanes), may_alias));

#define AT(p) (*(vec *)(p))
#define CAT(p) (*(const vec *)(p))
#define SHIFT_UP(before, here) __builtin_shufflevector(before, here, 7, 8, 9, 10, 11, 12, 13, 14)
#define SHIFT_DOWN(here, after) __builtin_shufflevector(here, after, 1, 2, 3, 4, 5, 6, 7, 8)

struct rows {
	double *u;
	const double *f, *south, *north, *back, *front; /* neighbours along y and z */
};

static struct rows rows_at(const struct mg_level *l, size_t j, size_t k)
{
	const struct mg_axis *y = &l->axis[1], *z = &l->axis[2];
	double *plane = l->u + k * l->plane;
	size_t row = j * l->stride;
	return (struct rows){.u = plane + row, .f = l->f + k * l->plane + row,
		.south = plane + mg_below(y, j) * l->stride, .north = plane + mg_above(y, j) * l->stride,
		.back = l->u + mg_below(z, k) * l->plane + row, .front = l->u + mg_above(z, k) * l->plane + row};
}

/* The neighbours of the ends of a row: the right one is put behind the row, the left one is returned. */
static inline double close_row(const struct mg_level *l, double *u)
{
	const struct mg_axis *x = &l->axis[0];
	u[mg_slot(l, x->points)] = u[mg_slot(l, mg_above(x, x->points - 1))];
	return u[mg_slot(l, mg_below(x, 0))];
}

/* lap u of nodes i ... i+mg_lanes-1 of the half at offset at; sides is the sum of their neighbours along x. */
#define LAPLACIAN(result, here, sides, at, i) \
	do { \
		result = wx * (sides); \
		if (dim == 3) \
			result += wy * (CAT(a.south + (at) + (i)) + CAT(a.north + (at) + (i))); \
		if (dim >= 2) \
			result += wz * (CAT(a.back + (at) + (i)) + CAT(a.front + (at) + (i))); \
		result -= diagonal * (here); \
	} while (0)

/* Relaxes the even (odd = 0) or the odd half of a row. */
static inline __attribute__((always_inline)) void relax_row(const int dim, const struct mg_level *l, double factor, struct rows a, const int odd)
{
	const double wx = l->axis[0].w, wy = l->axis[1].w, wz = l->axis[2].w, diagonal = l->diagonal;
	const size_t at = odd ? l->half : 0, n = (l->axis[0].points + !odd) / 2;
	const int64_t *mask = l->mask[odd];
	double *other = a.u + l->half - at;
	vec last = {0}, next, here, lap, sides, change;
	last += close_row(l, a.u);
	if (odd)
		last = CAT(other);
	for (size_t i = 0; i < n; i += mg_lanes) {
		next = CAT(other + i + (odd ? mg_lanes : 0));
		here = CAT(a.u + at + i);
		if (odd)
			sides = last + SHIFT_DOWN(last, next);
		else
			sides = SHIFT_UP(last, next) + next;
		LAPLACIAN(lap, here, sides, at, i);
		change = factor * (lap - CAT(a.f + at + i));
		AT(a.u + at + i) = here + (vec)((vmask)change & *(const vmask *)(mask + i));
		last = next;
	}
}

/* What a row is made of without vectors or masks: the reference of relax_row, used by the tests. */
void mg_relax_plain(const struct mg_level *l, double relaxation, int colour, size_t k)
{
	const struct mg_axis *x = &l->axis[0], *y = &l->axis[1];
	double factor = relaxation / l->diagonal;
	for (size_t j = y->first; j < y->end; j++) {
		struct rows a = rows_at(l, j, k);
		double left = close_row(l, a.u);
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
	}
}

static inline __attribute__((always_inline)) void relax_plane(const int dim, const struct mg_level *l, double factor, int colour, size_t k)
{
	const struct mg_axis *y = &l->axis[1];
	for (size_t j = y->first; j < y->end; j++)
		if ((j + k + (size_t)colour) & 1)
			relax_row(dim, l, factor, rows_at(l, j, k), 1);
		else
			relax_row(dim, l, factor, rows_at(l, j, k), 0);
}

void mg_relax_plane(const struct mg_level *l, double relaxation, int colour, size_t k)
{
	double factor = relaxation / l->diagonal;
	if (l->dim == 3)
		relax_plane(3, l, factor, colour, k);
	else if (l->dim == 2)
		relax_plane(2, l, factor, colour, k);
	else
		relax_plane(1, l, factor, colour, k);
}

static inline __attribute__((always_inline)) double residual_row(const int dim, const struct mg_level *l, struct rows a, double *restrict r)
{
	const double wx = l->axis[0].w, wy = l->axis[1].w, wz = l->axis[2].w, diagonal = l->diagonal;
	const size_t half = l->half;
	const int64_t *mask[2] = {l->mask[0], l->mask[1]};
	vec before = {0}, even, odd, after, lap, v, w, sum = {0};
	before += close_row(l, a.u);
	even = CAT(a.u);
	for (size_t i = 0; 2 * i < l->axis[0].points; i += mg_lanes) {
		odd = CAT(a.u + half + i);
		after = CAT(a.u + i + mg_lanes);
		LAPLACIAN(lap, even, SHIFT_UP(before, odd) + odd, 0, i);
		v = (vec)((vmask)(CAT(a.f + i) - lap) & *(const vmask *)(mask[0] + i));
		LAPLACIAN(lap, odd, even + SHIFT_DOWN(even, after), half, i);
		w = (vec)((vmask)(CAT(a.f + half + i) - lap) & *(const vmask *)(mask[1] + i));
		sum += v * v + w * w;
		AT(r + i) = v;
		AT(r + half + i) = w;
		before = odd;
		even = after;
	}
	return ((sum[0] + sum[4]) + (sum[1] + sum[5])) + ((sum[2] + sum[6]) + (sum[3] + sum[7]));
}

double mg_residual_row(const struct mg_level *l, size_t j, size_t k, double *r)
{
	struct rows a = rows_at(l, j, k);
	double sum = l->dim == 3 ? residual_row(3, l, a, r) : l->dim == 2 ? residual_row(2, l, a, r) : residual_row(1, l, a, r);
	close_row(l, r);
	return sum;
}
