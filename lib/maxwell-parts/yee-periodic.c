/* Curls with wider differences, in periodic boxes. The derivative along axis a is [near (f(1/2) - f(-1/2)) + far (f(3/2) - f(-3/2))]/h, and of it the mean
 * over neighbours across: middle times its own value, plus side[e] times the two along each other axis e, plus corner times the four along both.
 * Cost: the number of points of the stencil a component. SPDX-License-Identifier: GPL-3.0-or-later */
#include "maxwell-parts/yee.h"

struct lines {
	const struct pm_yee *y;
	const struct pm_yee_stencil *s;
	int axis;
	bool up;
	double factor;
	const double *from;
	double *to;
};

static size_t wrapped(size_t i, int k, size_t n) { return (i + (size_t)((ptrdiff_t)n + k) % n) % n; }

/* A row along x, and how far to go along it. */
struct row {
	const double *at;
	int by;
};

static struct row row_of(const struct lines *l, const int by[3], size_t j, size_t k)
{
	const size_t *n = l->y->grid.points;
	const struct pm_planes *p = l->y->planes;
	if (p && p->axis == 2)
		return (struct row){l->from + (((ptrdiff_t)(k - p->first) + by[2]) * (ptrdiff_t)n[1] + (ptrdiff_t)wrapped(j, by[1], n[1])) * (ptrdiff_t)n[0],
			by[0]};
	if (p)
		return (struct row){l->from + ((ptrdiff_t)(j - p->first) + by[1]) * (ptrdiff_t)n[0], by[0]};
	return (struct row){l->from + (wrapped(k, by[2], n[2]) * n[1] + wrapped(j, by[1], n[1])) * n[0], by[0]};
}

/* to += weight (high - low) */
static void add_row(size_t n, double weight, struct row high, struct row low, double *to)
{
	const size_t edge = n > 4 ? 2 : n, end = n > 4 ? n - 2 : n;
	for (size_t i = 0; i < n; i = i + 1 == edge ? end : i + 1)
		to[i] += weight * (high.at[wrapped(i, high.by, n)] - low.at[wrapped(i, low.by, n)]);
	if (n <= 4)
		return;
	const double *const h = high.at + high.by, *const b = low.at + low.by;
	for (size_t i = edge; i < end; i++)
		to[i] += weight * (h[i] - b[i]);
}

/* The differences of a row of points beside them by `by`. */
static void differences(const struct lines *l, const int by[3], double weight, size_t j, size_t k, double *to)
{
	const size_t n = l->y->grid.points[0];
	struct row row[4]; /* at -3/2, -1/2, 1/2, 3/2 */
	for (int q = 0; q < 4; q++) {
		int at[3] = {by[0], by[1], by[2]};
		at[l->axis] = q - 2 + l->up;
		row[q] = row_of(l, at, j, k);
	}
	add_row(n, weight * l->s->near, row[2], row[1], to);
	if (l->s->far != 0)
		add_row(n, weight * l->s->far, row[3], row[0], to);
}

static void add(const struct lines *l)
{
	const struct pm_grid *g = &l->y->grid;
	const struct pm_planes *p = l->y->planes;
	const int a = l->axis, e = (a + 1) % 3, f = (a + 2) % 3;
	const size_t row = p ? pm_planes_row(p, 0) : 0;
	size_t first[3] = {0}, end[3] = {0, g->points[1], g->points[2]};
	if (p)
		first[p->axis] = p->first, end[p->axis] = p->first + p->here;
#pragma omp parallel for collapse(2) schedule(static) num_threads(pm_threads()) if (pm_grid_size(g) > 4096)
	for (size_t k = first[2]; k < end[2]; k++)
		for (size_t j = first[1]; j < end[1]; j++)
			for (int q = 0; q < 9; q++) {
				int by[3] = {0};
				by[e] = q % 3 - 1, by[f] = q / 3 - 1;
				const double weight = by[e] && by[f] ? l->s->corner[a] : by[e] ? l->s->side[a][0] : by[f] ? l->s->side[a][1] : l->s->middle[a];
				if (weight != 0)
					differences(l, by, l->factor * weight, j, k, l->to + (k * g->points[1] + j - row) * g->points[0]);
			}
}

void pm_yee_wide(const struct pm_yee *y, const struct pm_yee_stencil *s, bool electric, double dt)
{
	const struct pm_grid *g = &y->grid;
	const double factor = electric ? dt * y->c * y->c : -dt;
	const size_t here = y->planes ? y->planes->here * y->planes->size : pm_grid_size(g);
	for (int c = 0; c < 3; c++) {
		double *to = electric ? y->e[c] : y->b[c];
		for (int k = 0; k < 2; k++) {
			const int axis = (c + 1 + k) % 3, other = (c + 2 - k) % 3;
			if (pm_yee_varies(g, axis))
				add(&(struct lines){.y = y, .s = s, .axis = axis, .up = !electric, .factor = (k ? -factor : factor) / g->h[axis],
					.from = y->planes ? y->beside[other] : electric ? y->b[other] : y->e[other], .to = to});
		}
		for (size_t i = 0; i < here && electric && y->j[c]; i++)
			to[i] -= dt / y->eps0 * y->j[c][i];
	}
}
