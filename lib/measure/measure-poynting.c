/* The energy of light through a box: flux = surface sum of eps0 c^2 E x B . n over the planes half-way between the nodes of the box and those around it, where
 * B along the plane sits and E is the mean of both sides; enclosed = eps0/2 sum (E^2 + c^2 B^2) inside them, each component where it sits, those in the planes
 * with half weight. Then d enclosed/dt = -flux - (the work on charges inside), of order 2 in h and dt (Jackson 1999, section 6.7).
 * Cost: a pass over the box. SPDX-License-Identifier: GPL-3.0-or-later */
#include "base/base.h"
#include "measure/measure-field.h"

struct box {
	const struct pm_grid *g;
	const struct pm_field *e, *b;
	size_t first[3], end[3]; /* nodes */
	double c, eps0;
};

/* Points of a component along an axis: the nodes, or the halves about them, of which those at both ends are in the planes. */
static size_t from(const struct box *x, bool half, int d) { return x->first[d] - (half && d < x->g->dim); }
static double weight(const struct box *x, bool half, int d, size_t i)
{
	return half && d < x->g->dim && (i + 1 == x->first[d] || i + 1 == x->end[d]) ? 0.5 : 1;
}

static double energy(const struct box *x, const struct pm_field *field)
{
	struct pm_sum sum = {0, 0};
	for (int c = 0; c < 3; c++) {
		const unsigned char *half = field->staggered[c];
		const double *a = pm_in(field, c);
		for (size_t k = from(x, half[2], 2); k < x->end[2]; k++)
			for (size_t j = from(x, half[1], 1); j < x->end[1]; j++)
				for (size_t i = from(x, half[0], 0); i < x->end[0]; i++) {
					const double y = a[i + x->g->points[0] * (j + x->g->points[1] * k)];
					pm_sum_add(&sum, 0.5 * weight(x, half[0], 0, i) * weight(x, half[1], 1, j) * weight(x, half[2], 2, k) * y * y);
				}
	}
	return pm_sum_total(sum) * pm_grid_cell(x->g);
}

/* Of E of component c and B of component o, across axis d, in the plane behind node p of this axis. */
static void across(const struct box *x, int d, size_t p, int c, int o, double sign, struct pm_sum *sum)
{
	const size_t step[3] = {1, x->g->points[0], x->g->points[0] * x->g->points[1]};
	const double *e = pm_in(x->e, c), *b = pm_in(x->b, o);
	for (size_t m = from(x, true, c); m < x->end[c]; m++)
		for (size_t n = x->first[o]; n < x->end[o]; n++) {
			const size_t at = p * step[d] + m * step[c] + n * step[o];
			pm_sum_add(sum, sign * weight(x, true, c, m) * 0.5 * (e[at] + e[at + step[d]]) * b[at]);
		}
}

static double through(const struct box *x)
{
	double all = 0;
	for (int d = 0; d < x->g->dim; d++) {
		struct pm_sum sum = {0, 0};
		for (int side = 0; side < 2; side++) {
			const size_t p = side ? x->end[d] - 1 : x->first[d] - 1;
			across(x, d, p, (d + 1) % 3, (d + 2) % 3, side ? 1 : -1, &sum);
			across(x, d, p, (d + 2) % 3, (d + 1) % 3, side ? -1 : 1, &sum);
		}
		all += pm_sum_total(sum) * pm_grid_cell(x->g) / x->g->h[d];
	}
	return all * x->eps0 * x->c * x->c;
}

void pm_poynting_of(const struct pm_measure *how, const struct pm_grid *g, const struct pm_field *e, const struct pm_field *b, double *flux, double *inside)
{
	struct box x = {.g = g, .e = e, .b = b, .c = how->c, .eps0 = how->eps0};
	for (int d = 0; d < 3; d++)
		pm_flux_nodes(how, g, d, &x.first[d], &x.end[d]);
	*flux = through(&x);
	*inside = x.eps0 * (energy(&x, e) + x.c * x.c * energy(&x, b));
}
