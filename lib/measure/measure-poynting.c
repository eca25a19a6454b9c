/* The energy of light through a box: flux = surface sum of eps0 c^2 E x B . n over the planes half-way between the nodes of the box and those around it, where
 * B along the plane sits and E is the mean of both sides; enclosed = eps0/2 sum (E^2 + c^2 B^2) inside them, each component where it sits, those in the planes
 * with half weight. Then d enclosed/dt = -flux - (the work on charges inside), of order 2 in h and dt (Jackson 1999, section 6.7).
 * Cost: a pass over the box. SPDX-License-Identifier: GPL-3.0-or-later */
#include "measure/measure-field.h"
#include "mesh/planes.h"

/* Of the planes here; E with those of the neighbours, where ranks share them. */
struct box {
	const struct pm_grid *g;
	const struct pm_field *e, *b;
	struct pm_planes planes;
	const double *electric[3];
	size_t first[3], end[3], step[3]; /* nodes; strides */
};

/* Points of a component along an axis: the nodes, or the halves about them, of which those at both ends are in the planes. */
static size_t from_of(const struct box *x, bool half, int d) { return x->first[d] - (half && d < x->g->dim); }
static bool has(const struct box *x, bool half, int d, size_t i) { return i >= from_of(x, half, d) && i < x->end[d]; }
static double weight(const struct box *x, bool half, int d, size_t i)
{
	return half && d < x->g->dim && (i + 1 == x->first[d] || i + 1 == x->end[d]) ? 0.5 : 1;
}

enum { ELECTRIC, MAGNETIC, THROUGH, SUMS = THROUGH + 3 };

/* Of a row of the mesh. */
static void energy(const struct box *x, const struct pm_field *field, size_t from, const size_t at[3], struct pm_sum *sum)
{
	for (int c = 0; c < 3; c++) {
		const unsigned char *half = field->staggered[c];
		const double *a = pm_in(field, c) + from;
		for (size_t i = from_of(x, half[0], 0); i < x->end[0] && has(x, half[1], 1, at[1]) && has(x, half[2], 2, at[2]); i++)
			pm_sum_add(sum, 0.5 * weight(x, half[0], 0, i) * weight(x, half[1], 1, at[1]) * weight(x, half[2], 2, at[2]) * a[i] * a[i]);
	}
}

/* Of E of component c and B of component o, across axis d, in the planes behind the last node within the box and before its first one. */
static void across(const struct box *x, int d, int c, int o, double sign, size_t from, const size_t row[3], struct pm_sum *sum)
{
	const double *e = x->electric[c] + from, *b = pm_in(x->b, o) + from;
	if (d && row[d] + 1 != x->first[d] && row[d] + 1 != x->end[d])
		return;
	for (size_t i = 0; i < x->end[0]; i++) {
		const size_t at[3] = {i, row[1], row[2]};
		const bool low = at[d] + 1 == x->first[d], high = at[d] + 1 == x->end[d];
		if ((low || high) && has(x, true, c, at[c]) && has(x, false, o, at[o]))
			pm_sum_add(sum, (high ? sign : -sign) * weight(x, true, c, at[c]) * 0.5 * (e[i] + e[i + x->step[d]]) * b[i]);
	}
}

static void make(const void *data, size_t from, size_t to, void *part)
{
	const struct box *x = data;
	const size_t row = pm_planes_row(&x->planes, from), at[3] = {0, row % x->g->points[1], row / x->g->points[1]};
	struct pm_sum *sum = part;
	if (from == to)
		return;
	energy(x, x->e, from, at, &sum[ELECTRIC]);
	energy(x, x->b, from, at, &sum[MAGNETIC]);
	for (int d = 0; d < x->g->dim; d++) {
		across(x, d, (d + 1) % 3, (d + 2) % 3, 1, from, at, &sum[THROUGH + d]);
		across(x, d, (d + 2) % 3, (d + 1) % 3, -1, from, at, &sum[THROUGH + d]);
	}
}

int pm_poynting_of(const struct pm_measure *how, const struct pm_grid *g, const struct pm_field *e, const struct pm_field *b, double *flux, double *inside)
{
	struct box x = {.g = g, .e = e, .b = b, .electric = {pm_in(e, 0), pm_in(e, 1), pm_in(e, 2)}, .step = {1, g->points[0], g->points[0] * g->points[1]}};
	struct pm_sum sum[SUMS] = {{0, 0}};
	const struct pm_parts parts = {.size = sizeof sum, .make = make, .join = pm_join_sums};
	double *room = NULL, all = 0;
	for (int d = 0; d < 3; d++)
		pm_flux_nodes(how, g, d, &x.first[d], &x.end[d]);
	int status = pm_planes_init(&x.planes, g, e);
	if (x.planes.divided)
		status = pm_planes_halo(status, &x.planes, 1, 3, (const double *const[]){x.electric[0], x.electric[1], x.electric[2]}, x.electric, &room);
	if (!status)
		status = pm_planes_over(0, &x.planes, &parts, &x, sum);
	for (int d = 0; d < g->dim; d++)
		all += pm_sum_total(sum[THROUGH + d]) * pm_grid_cell(g) / g->h[d];
	*flux = all * how->c * how->c * how->eps0;
	*inside = how->eps0 * pm_grid_cell(g) * (pm_sum_total(sum[ELECTRIC]) + how->c * how->c * pm_sum_total(sum[MAGNETIC]));
	pm_planes_free(&x.planes), pm_free(room);
	return status;
}
