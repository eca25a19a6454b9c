/* Red-black Gauss-Seidel and the residual, row by row, for the 3-, 5- and 7-point Laplacian.
 *   u += (omega/D) (lap u - f) on the nodes of one colour, D = 2 (1/hx^2 + 1/hy^2 + 1/hz^2); r = f - lap u
 * (Trottenberg, Oosterlee, Schueller 2001, section 2.1.2). Colours are the parity of i+j+k; a whole row is computed and the other colour masked out, with the
 * x neighbours taken from registers, so nothing just stored is loaded again. Where an odd number of nodes is periodic, two nodes of one
 * colour meet: along x each sees the old value of the other, along y and z the order of the sweep decides, always the same.
 * Cost: 14 operations per node and colour. SPDX-License-Identifier: GPL-3.0-or-later */
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
static inline double close_row(const struct mg_axis *x, double *u)
{
	u[x->points] = u[mg_above(x, x->points - 1)];
	return u[mg_below(x, 0)];
}

#define LAPLACIAN(result, here, before, after, i) \
	do { \
		result = wx * (SHIFT_UP(before, here) + SHIFT_DOWN(here, after)); \
		if (dim == 3) \
			result += wy * (CAT(a.south + (i)) + CAT(a.north + (i))); \
		if (dim >= 2) \
			result += wz * (CAT(a.back + (i)) + CAT(a.front + (i))); \
		result -= l->diagonal * (here); \
	} while (0)

static inline __attribute__((always_inline)) void relax_row(const int dim, const struct mg_level *l, double factor, struct rows a, const int64_t *mask)
{
	const double wx = l->axis[0].w, wy = l->axis[1].w, wz = l->axis[2].w;
	vec before = {0}, here, after, lap;
	before += close_row(&l->axis[0], a.u);
	here = CAT(a.u);
	for (size_t i = 0; i < l->axis[0].points; i += mg_lanes) {
		after = CAT(a.u + i + mg_lanes);
		LAPLACIAN(lap, here, before, after, i);
		vec change = factor * (lap - CAT(a.f + i));
		change = (vec)((vmask)change & *(const vmask *)(mask + i));
		AT(a.u + i) = here + change;
		before = here;
		here = after;
	}
}

/* What a row is made of without vectors or masks: the reference of relax_row, used by the tests. */
void mg_relax_plain(const struct mg_level *l, double relaxation, int colour, size_t k)
{
	const struct mg_axis *x = &l->axis[0], *y = &l->axis[1];
	double factor = relaxation / l->diagonal;
	for (size_t j = y->first; j < y->end; j++) {
		struct rows a = rows_at(l, j, k);
		double left = close_row(x, a.u);
		for (size_t i = x->first; i < x->end; i++) {
			if (((i + j + k) & 1) != (size_t)colour)
				continue;
			double lap = x->w * ((i ? a.u[i - 1] : left) + a.u[i + 1]);
			if (l->dim == 3)
				lap += y->w * (a.south[i] + a.north[i]);
			if (l->dim >= 2)
				lap += l->axis[2].w * (a.back[i] + a.front[i]);
			lap -= l->diagonal * a.u[i];
			a.u[i] = a.u[i] + factor * (lap - a.f[i]);
		}
	}
}

static inline __attribute__((always_inline)) void relax_plane(const int dim, const struct mg_level *l, double factor, int colour, size_t k)
{
	const struct mg_axis *y = &l->axis[1];
	for (size_t j = y->first; j < y->end; j++)
		relax_row(dim, l, factor, rows_at(l, j, k), l->mask[(j + k + (size_t)colour) & 1]);
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
	const double wx = l->axis[0].w, wy = l->axis[1].w, wz = l->axis[2].w;
	vec before = {0}, here, after, lap, sum = {0};
	before += close_row(&l->axis[0], a.u);
	here = CAT(a.u);
	for (size_t i = 0; i < l->axis[0].points; i += mg_lanes) {
		after = CAT(a.u + i + mg_lanes);
		LAPLACIAN(lap, here, before, after, i);
		vec v = CAT(a.f + i) - lap;
		v = (vec)((vmask)v & *(const vmask *)(l->mask[2] + i));
		sum += v * v;
		AT(r + i) = v;
		before = here;
		here = after;
	}
	return ((sum[0] + sum[4]) + (sum[1] + sum[5])) + ((sum[2] + sum[6]) + (sum[3] + sum[7]));
}

double mg_residual_row(const struct mg_level *l, size_t j, size_t k, double *r)
{
	const struct mg_axis *x = &l->axis[0];
	struct rows a = rows_at(l, j, k);
	double sum = l->dim == 3 ? residual_row(3, l, a, r) : l->dim == 2 ? residual_row(2, l, a, r) : residual_row(1, l, a, r);
	r[-1] = r[mg_below(x, 0)];
	r[x->points] = r[mg_above(x, x->points - 1)];
	return sum;
}
