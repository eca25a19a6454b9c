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

/* The weighted difference at a point; the offsets across are those of axes e and g. */
static double difference(const struct lines *l, const size_t at[3], int e, int by_e, int g, int by_g)
{
	const struct pm_grid *grid = &l->y->grid;
	const size_t *n = grid->points;
	size_t p[3] = {at[0], at[1], at[2]};
	double value[4]; /* at -3/2, -1/2, 1/2, 3/2 */
	p[e] = wrapped(at[e], by_e, n[e]);
	p[g] = wrapped(at[g], by_g, n[g]);
	for (int k = 0; k < 4; k++) {
		p[l->axis] = wrapped(at[l->axis], k - 2 + l->up, n[l->axis]);
		value[k] = l->from[(p[2] * n[1] + p[1]) * n[0] + p[0]];
	}
	return l->s->near * (value[2] - value[1]) + l->s->far * (value[3] - value[0]);
}

static void add(const struct lines *l)
{
	const struct pm_grid *g = &l->y->grid;
	const int a = l->axis, e = (a + 1) % 3, f = (a + 2) % 3;
	const double middle = l->s->middle[a], side_e = l->s->side[a][0], side_f = l->s->side[a][1], corner = l->s->corner[a];
#pragma omp parallel for collapse(2) schedule(static) if (pm_grid_size(g) > 4096)
	for (size_t k = 0; k < g->points[2]; k++)
		for (size_t j = 0; j < g->points[1]; j++)
			for (size_t i = 0; i < g->points[0]; i++) {
				const size_t at[3] = {i, j, k};
				double sum = middle * difference(l, at, e, 0, f, 0);
				if (side_e != 0)
					sum += side_e * (difference(l, at, e, 1, f, 0) + difference(l, at, e, -1, f, 0));
				if (side_f != 0)
					sum += side_f * (difference(l, at, e, 0, f, 1) + difference(l, at, e, 0, f, -1));
				if (corner != 0)
					sum += corner * (difference(l, at, e, 1, f, 1) + difference(l, at, e, -1, f, 1) + difference(l, at, e, 1, f, -1) +
						difference(l, at, e, -1, f, -1));
				l->to[(k * g->points[1] + j) * g->points[0] + i] += l->factor * sum;
			}
}

void pm_yee_wide(const struct pm_yee *y, const struct pm_yee_stencil *s, bool electric, double dt)
{
	const struct pm_grid *g = &y->grid;
	const double factor = electric ? dt * y->c * y->c : -dt;
	for (int c = 0; c < 3; c++) {
		double *to = electric ? y->e[c] : y->b[c];
		for (int k = 0; k < 2; k++) {
			const int axis = (c + 1 + k) % 3, other = (c + 2 - k) % 3;
			if (pm_yee_varies(g, axis))
				add(&(struct lines){.y = y, .s = s, .axis = axis, .up = !electric, .factor = (k ? -factor : factor) / g->h[axis],
					.from = electric ? y->b[other] : y->e[other], .to = to});
		}
		for (size_t i = 0; i < pm_grid_size(g) && electric && y->j[c]; i++)
			to[i] -= dt / y->eps0 * y->j[c][i];
	}
}
