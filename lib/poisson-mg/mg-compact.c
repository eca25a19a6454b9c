/* Compact differences of order 4 (Mehrstellen), and the smoothers without colours or with four: weighted Jacobi, four-colour Gauss-Seidel.
 *   A u = sum_d D_d u + sum_(d<e) (h_d^2 + h_e^2)/12 D_d D_e u = f + sum_d h_d^2/12 D_d f,   D_d the second difference along axis d
 * 3, 9 or 19 points; for equal spacings in 2-D (1 4 1; 4 -20 4; 1 4 1)/6h^2 (Collatz 1960; Trottenberg, Oosterlee, Schueller 2001, section 5.4.1). Without the
 * second term it is order 2. Images are even at a neumann face, where u_xxx = f_x does not vanish, so the source there gets h/3 f_x + h^2/12 f_xx one-sided:
 * (7 f_0 + 6 f_1 - f_2)/12, whose sum over the nodes is Gregory's quadrature (3/8, 7/6, 23/24, 1 ...), which the mean removed then follows.
 * Colours are ((i+k) mod 2, (j+k) mod 2), in 2-D (i mod 2, k mod 2): no two nodes of one colour are coupled. Cost: 40 operations per node in 3-D.
 * SPDX-License-Identifier: GPL-3.0-or-later */
#include "poisson-mg/mg-hierarchy.h"

#include <string.h>

enum { rows_most = 9, rows_beside = 5 }; /* itself, south, north, back, front; then the four corners in yz, of which only the node above counts */

struct around {
	const mg_number *same[rows_most], *left[rows_beside], *right[rows_beside]; /* of half a row: neighbours of node i of it stand at place i */
	mg_number end[rows_beside]; /* left of node 0 */
};

void pm_mg_compact_init(struct mg_level *l)
{
	static const int pair[3][2] = {{0, 1}, {0, 2}, {1, 2}};
	const struct mg_axis *a = l->axis;
	l->diagonal = 2 * (a[0].w + a[1].w + a[2].w);
	for (int d = 0; d < 3; d++)
		l->side[d] = a[d].w;
	for (int p = 0; p < 3 && l->order == 4; p++) {
		int d = pair[p][0], e = pair[p][1];
		l->cross[p] = a[d].w * a[e].w * (a[d].h * a[d].h + a[e].h * a[e].h) / 12;
		l->side[d] -= 2 * l->cross[p];
		l->side[e] -= 2 * l->cross[p];
		l->diagonal -= 4 * l->cross[p];
	}
}

static struct around around(const struct mg_level *l, size_t j, size_t k, int odd)
{
	const struct mg_axis *y = &l->axis[1], *z = &l->axis[2];
	const size_t js[3] = {j, mg_below(y, j), mg_above(y, j)}, ks[3] = {k, mg_below(z, k), mg_above(z, k)};
	static const int at[rows_most][2] = {{0, 0}, {1, 0}, {2, 0}, {0, 1}, {0, 2}, {1, 1}, {2, 1}, {1, 2}, {2, 2}};
	struct around a;
	for (int m = 0; m < rows_most; m++) {
		const mg_number *row = l->u + mg_plane(l, ks[at[m][1]]) + js[at[m][0]] * l->stride;
		a.same[m] = row + (odd ? l->half : 0);
		if (m >= rows_beside)
			continue;
		a.left[m] = odd ? row : row + l->half - 1;
		a.right[m] = odd ? row + 1 : row + l->half;
		a.end[m] = mg_left_end(l, row);
	}
	return a;
}

/* f - A u at place i, given the values on the left. */
static inline __attribute__((always_inline)) mg_number defect(const int dim, const struct mg_level *l, const struct around *a, const mg_number *f, size_t i,
	const mg_number left[rows_beside])
{
	const mg_number *const *s = a->same, *const *r = a->right;
	const mg_number side[3] = {(mg_number)l->side[0], (mg_number)l->side[1], (mg_number)l->side[2]}, diagonal = (mg_number)l->diagonal;
	const mg_number cross[3] = {(mg_number)l->cross[0], (mg_number)l->cross[1], (mg_number)l->cross[2]};
	mg_number sum = side[0] * (left[0] + r[0][i]);
	if (dim >= 2)
		sum += side[2] * (s[3][i] + s[4][i]) + cross[1] * ((left[3] + r[3][i]) + (left[4] + r[4][i]));
	if (dim == 3) {
		sum += side[1] * (s[1][i] + s[2][i]) + cross[0] * ((left[1] + r[1][i]) + (left[2] + r[2][i]));
		sum += cross[2] * ((s[5][i] + s[6][i]) + (s[7][i] + s[8][i]));
	}
	return f[i] - (sum - diagonal * s[0][i]);
}

static inline __attribute__((always_inline)) void defects(const int dim, const struct mg_level *l, const struct around *a, const mg_number *f, size_t from,
	size_t to,
	mg_number *restrict d)
{
	const mg_number *left[rows_beside];
	for (int m = 0; m < rows_beside; m++)
		left[m] = a->left[m];
	for (size_t i = from ? from : 1; i < to; i++) {
		const mg_number here[rows_beside] = {left[0][i], left[1][i], left[2][i], left[3][i], left[4][i]};
		d[i] = defect(dim, l, a, f, i, here);
	}
}

/* d = f - A u on the unknowns of half a row: places range[0] <= i < range[1] of it. */
static void defect_half(const struct mg_level *l, size_t j, size_t k, int odd, size_t range[2], mg_number *d)
{
	const struct mg_axis *x = &l->axis[0];
	const mg_number *f = l->f + mg_plane(l, k) + j * l->stride + (odd ? l->half : 0);
	struct around a = around(l, j, k, odd);
	range[0] = odd ? 0 : (x->first + 1) / 2;
	range[1] = odd ? x->end / 2 : (x->end + 1) / 2;
	if (range[0] == 0 && range[1]) {
		mg_number left[rows_beside];
		for (int m = 0; m < rows_beside; m++)
			left[m] = odd ? a.left[m][0] : a.end[m];
		d[0] = defect(l->dim, l, &a, f, 0, left);
	}
	if (l->dim == 3)
		defects(3, l, &a, f, range[0], range[1], d);
	else if (l->dim == 2)
		defects(2, l, &a, f, range[0], range[1], d);
	else
		defects(1, l, &a, f, range[0], range[1], d);
}

/* u -= (omega/D) (f - A u) on the nodes of one colour. */
void pm_mg_colour_plane(const struct mg_level *l, double relaxation, int colour, size_t k, mg_number *w)
{
	const struct mg_axis *y = &l->axis[1];
	const mg_number factor = (mg_number)(relaxation / l->diagonal);
	size_t shift = l->dim == 3 ? k : 0, range[2];
	int odd = (int)(((size_t)colour + shift) & 1);
	if (l->dim < 3 && (k & 1) != (size_t)(colour >> 1))
		return;
	for (size_t j = y->first; j < y->end; j++) {
		if (l->dim == 3 && ((j + k) & 1) != (size_t)(colour >> 1))
			continue;
		mg_number *row = l->u + mg_plane(l, k) + j * l->stride, *u = row + (odd ? l->half : 0);
		defect_half(l, j, k, odd, range, w);
		for (size_t i = range[0]; i < range[1]; i++)
			u[i] -= factor * w[i];
		mg_close_row(l, row);
	}
}

void pm_mg_jacobi_plane(const struct mg_level *l, double relaxation, size_t k, mg_number *w)
{
	const struct mg_axis *y = &l->axis[1];
	const mg_number factor = (mg_number)(relaxation / l->diagonal);
	size_t range[2];
	for (size_t j = y->first; j < y->end; j++)
		for (int odd = 0; odd < 2; odd++) {
			size_t at = mg_plane(l, k) + j * l->stride + (odd ? l->half : 0);
			defect_half(l, j, k, odd, range, w);
			for (size_t i = range[0]; i < range[1]; i++)
				l->v[at + i] = l->u[at + i] - factor * w[i];
		}
}

void pm_mg_keep_plane(const struct mg_level *l, size_t k)
{
	const struct mg_axis *y = &l->axis[1];
	for (size_t j = y->first; j < y->end; j++) {
		size_t at = mg_plane(l, k) + j * l->stride;
		memcpy(l->u + at, l->v + at, l->stride * sizeof *l->u); /* v is zero where there is no unknown */
		mg_close_row(l, l->u + at);
	}
}

double pm_mg_compact_residual(const struct mg_level *l, size_t j, size_t k, mg_number *r)
{
	double sum = 0;
	mg_number lane[mg_lanes] = {0};
	size_t range[2];
	memset(r, 0, l->stride * sizeof *r);
	for (int odd = 0; odd < 2; odd++) {
		mg_number *d = r + (odd ? l->half : 0);
		defect_half(l, j, k, odd, range, d);
		for (size_t i = 0; i < l->half; i += mg_lanes)
			for (size_t q = 0; q < mg_lanes; q++)
				lane[q] += d[i + q] * d[i + q];
	}
	for (int q = 0; q < mg_lanes; q++)
		sum += lane[q];
	mg_close_row(l, r);
	return sum;
}

/* h^2/12 D s at node i of n values `step` apart; ahead: those beyond a periodic end lie behind it. */
static double along(const struct pm_grid *g, int d, bool ahead, size_t i, size_t step, const double *s)
{
	size_t n = g->points[d];
	bool periodic = g->face[d][0] == PM_PERIODIC;
	if (periodic && ahead)
		return (s[-(ptrdiff_t)step] - 2 * s[0] + s[step]) / 12;
	if (!periodic && (i == 0 || i + 1 == n)) {
		ptrdiff_t in = i ? -(ptrdiff_t)step : (ptrdiff_t)step;
		if (g->face[d][i != 0] != PM_NEUMANN)
			return 0;
		return n < 3 ? (s[in] - s[0]) / 3 : (-5 * s[0] + 6 * s[in] - s[2 * in]) / 12;
	}
	const ptrdiff_t below = (ptrdiff_t)pm_index_fold((ptrdiff_t)i - 1, n, periodic) - (ptrdiff_t)i;
	const ptrdiff_t above = (ptrdiff_t)pm_index_fold((ptrdiff_t)i + 1, n, periodic) - (ptrdiff_t)i;
	return (s[below * (ptrdiff_t)step] - 2 * s[0] + s[above * (ptrdiff_t)step]) / 12;
}

void pm_mg_compact_source(const struct pm_grid *g, const struct mg_level *l, const double *s, double *out)
{
	const size_t each = g->dim == 3 ? g->points[1] : 1, first = l->first * each, rows = l->here * each; /* in 2-D planes are rows */
	#pragma omp parallel for num_threads(pm_threads()) if (pm_grid_size(g) > mg_parallel)
	for (size_t row = 0; row < rows; row++) {
		const double *from = s + row * g->points[0];
		size_t at[3] = {0, (first + row) % g->points[1], (first + row) / g->points[1]}, step[3] = {1, g->points[0], g->points[0] * g->points[1]};
		for (at[0] = 0; at[0] < g->points[0]; at[0]++) {
			double sum = 0;
			for (int d = 0; d < g->dim; d++)
				sum += along(g, d, l->from && d && d == g->dim - 1, at[d], step[d], from + at[0]);
			out[row * g->points[0] + at[0]] = from[at[0]] + sum;
		}
	}
}
