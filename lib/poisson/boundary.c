/* Known boundary values moved to the right-hand side: A phi = f, phi = u + K, where K has the known values and is 0 at the unknown nodes, so A u = f - A K and
 * u has homogeneous faces. Order 2, per axis: a node beside a wall gets phi_wall/h^2; a node on a neumann face, whose neighbour beyond is
 * phi(-h) = phi(h) + 2 h g (g = d phi/dn outward), gets 2 g/h. With eps the wall's term has eps half-way, the flux that of the node. Compact differences of
 * order 4 (mg-compact.c) reach diagonal neighbours, so K is needed beyond edges too: there phi(-h) = phi(h) + 2 h g + h^3/3 phi_nnn, phi_nnn = f_n - lap_t g;
 * f_n is in the one-sided source of that file, and beyond an edge g is continued by a cubic.
 * Exact for constants and linear functions; corners are not used by order 2. Source: Press et al., Numerical Recipes, section 20.4; LeVeque 2007, section 2.12.
 * Cost: nodes of the faces. SPDX-License-Identifier: GPL-3.0-or-later */
#include <string.h>

#include "base/in-order.h"
#include "poisson/boundary.h"
#include "world/world.h"

struct stencil {
	int order;
	double side[3], cross[3][3]; /* [1/length^2] */
	unsigned faces; /* bits 2 axis + side */
};

static void across(int d, int t[2])
{
	t[0] = d == 0;
	t[1] = d == 2 ? 1 : 2;
}

size_t pm_boundary_points(const struct pm_grid *g, int d)
{
	int t[2];
	across(d, t);
	return g->points[t[0]] * g->points[t[1]];
}

int pm_boundary_room(struct pm_boundary *b, int d, int side)
{
	if (!b->value[d][side])
		b->value[d][side] = pm_zalloc(pm_boundary_points(&b->grid, d), sizeof(double));
	return b->value[d][side] ? 0 : -PM_DATA;
}

void pm_boundary_free(struct pm_boundary *b)
{
	for (int d = 0; d < 3; d++)
		for (int side = 0; side < 2; side++)
			b->value[d][side] = pm_free(b->value[d][side]);
}

/* Rows of the mesh that are here, and the number of the first. */
static size_t rows_here(const struct pm_boundary *b, size_t *first)
{
	const struct pm_grid *g = &b->grid;
	*first = b->planes ? pm_planes_row(b->planes, 0) : 0;
	return b->planes ? b->planes->here * b->planes->size / g->points[0] : g->points[1] * g->points[2];
}

void pm_boundary_here(const struct pm_boundary *b, int d, int side, size_t *from, size_t *to)
{
	const struct pm_planes *p = b->planes;
	const size_t n = pm_boundary_points(&b->grid, d);
	*from = 0, *to = n;
	if (!p || !p->divided)
		return;
	const size_t each = n / p->all, end = side && p->axis ? p->all - 1 : 0; /* a plane of the mesh has a row of the face, or, at an end, all of it */
	if (d != p->axis)
		*from = each * p->first, *to = each * (p->first + p->here);
	else if (end < p->first || end >= p->first + p->here)
		*to = 0;
}

size_t pm_boundary_node(const struct pm_boundary *b, int d, int side, size_t i)
{
	const size_t *n = b->grid.points, step[3] = {1, n[0], n[0] * n[1]};
	int t[2];
	across(d, t);
	return i % n[t[0]] * step[t[0]] + i / n[t[0]] * step[t[1]] + (side ? n[d] - 1 : 0) * step[d] - (b->planes ? b->planes->first * b->planes->size : 0);
}

int pm_boundary_share(int status, const struct pm_boundary *b, int d, int side, double *value)
{
	const struct pm_planes *p = b->planes;
	size_t from, to, bytes = 0, n = pm_boundary_points(&b->grid, d);
	void *all = NULL;
	if (!p || !p->divided)
		return status;
	pm_boundary_here(b, d, side, &from, &to);
	status = pm_world_gather(status, value + from, (to - from) * sizeof *value, &all, &bytes);
	if (all)
		memcpy(value, all, bytes);
	pm_free(all);
	return pm_world_share(status, 0, value, n * sizeof *value);
}

static struct stencil stencil_of(const struct pm_grid *g, int order, unsigned faces)
{
	struct stencil s = {.order = order, .faces = faces};
	for (int d = 0; d < g->dim; d++)
		s.side[d] = 1 / (g->h[d] * g->h[d]);
	for (int d = 0; d < g->dim && order == 4; d++)
		for (int e = d + 1; e < g->dim; e++) {
			double w = (1 / (g->h[d] * g->h[d]) + 1 / (g->h[e] * g->h[e])) / 12; /* (h_d^2 + h_e^2)/(12 h_d^2 h_e^2) */
			s.cross[d][e] = w;
			s.side[d] -= 2 * w;
			s.side[e] -= 2 * w;
		}
	return s;
}

/* The value on a face at (i, j) of its axes: wrapped where periodic, else beyond an end continued by a cubic (or lower, on few points). */
static double on_face(const struct pm_boundary *b, int d, int side, const int t[2], ptrdiff_t i, ptrdiff_t j, int axis)
{
	static const double weight[5][4] = {{0}, {1}, {2, -1}, {3, -3, 1}, {4, -6, 4, -1}};
	const struct pm_grid *g = &b->grid;
	const ptrdiff_t at[2] = {i, j};
	for (; axis < 2; axis++) {
		ptrdiff_t n = (ptrdiff_t)g->points[t[axis]], from = at[axis] < 0 ? 0 : n - 1, step = at[axis] < 0 ? 1 : -1;
		double sum = 0;
		if (at[axis] >= 0 && at[axis] < n)
			continue;
		int terms = n < 4 ? (int)n : 4;
		bool wraps = g->face[t[axis]][0] == PM_PERIODIC;
		for (int k = 0; k < (wraps ? 1 : terms); k++) {
			ptrdiff_t there = wraps ? (at[axis] + n) % n : from + k * step;
			sum += (wraps ? 1 : weight[terms][k]) * on_face(b, d, side, t, axis == 0 ? there : i, axis == 1 ? there : j, axis + 1);
		}
		return sum;
	}
	return b->value[d][side][(size_t)i + g->points[t[0]] * (size_t)j];
}

/* What phi beyond a neumann face is above phi as far inside. */
static double beyond(const struct pm_boundary *b, const struct stencil *s, int d, int side, const ptrdiff_t at[3])
{
	const struct pm_grid *g = &b->grid;
	int t[2];
	across(d, t);
	if (!b->value[d][side] || !(s->faces >> (2 * d + side) & 1))
		return 0;
	const ptrdiff_t i = at[t[0]], j = at[t[1]];
	double h = g->h[d], sum = 2 * h * on_face(b, d, side, t, i, j, 0);
	for (int k = 0; k < 2 && s->order == 4; k++) {
		ptrdiff_t n = (ptrdiff_t)g->points[t[k]], m = at[t[k]], low = g->face[t[k]][0] == PM_PERIODIC ? m : m < 1 ? 1 : m > n - 2 ? n - 2 : m;
		ptrdiff_t p[3][2] = {{i, j}, {i, j}, {i, j}};
		if (t[k] >= g->dim || n < 3)
			continue;
		for (int q = 0; q < 3; q++)
			p[q][k] = low + q - 1;
		sum -= h * h * h / 3 * (on_face(b, d, side, t, p[0][0], p[0][1], 0) - 2 * on_face(b, d, side, t, p[1][0], p[1][1], 0) +
			on_face(b, d, side, t, p[2][0], p[2][1], 0)) / (g->h[t[k]] * g->h[t[k]]);
	}
	return sum;
}

/* phi at a node of one or several walls. */
static double wall_value(const struct pm_boundary *b, unsigned faces, const ptrdiff_t at[3], bool *wall)
{
	const struct pm_grid *g = &b->grid;
	double sum = 0;
	int walls = 0;
	for (int d = 0; d < g->dim; d++)
		for (int side = 0; side < 2; side++) {
			int t[2];
			across(d, t);
			if (g->face[d][side] != PM_WALL || at[d] != (side ? (ptrdiff_t)g->cells[d] : 0))
				continue;
			walls++;
			if (b->value[d][side] && faces >> (2 * d + side) & 1)
				sum += b->value[d][side][(size_t)at[t[0]] + g->points[t[0]] * (size_t)at[t[1]]];
		}
	*wall = walls > 0;
	return walls ? sum / walls : 0;
}

/* K at a node, or one beyond a neumann or periodic face. */
static double known_at(const struct pm_boundary *b, const struct stencil *s, const ptrdiff_t from[3])
{
	const struct pm_grid *g = &b->grid;
	ptrdiff_t at[3] = {from[0], from[1], from[2]};
	double sum = 0;
	bool wall;
	for (int d = 0; d < g->dim; d++) {
		ptrdiff_t n = (ptrdiff_t)g->points[d];
		if (at[d] >= 0 && at[d] < n)
			continue;
		int side = at[d] >= n;
		if (g->face[d][side] == PM_PERIODIC) {
			at[d] = (at[d] + n) % n;
			continue;
		}
		sum += beyond(b, s, d, side, at);
		at[d] = n < 2 ? 0 : side ? n - 2 : 1;
	}
	return sum + wall_value(b, s->faces, at, &wall);
}

static double differences(const struct pm_boundary *b, const struct stencil *s, const ptrdiff_t at[3])
{
	double sum = 0;
	for (int d = 0; d < b->grid.dim; d++)
		for (int up = -1; up <= 1; up += 2) {
			ptrdiff_t p[3] = {at[0], at[1], at[2]};
			p[d] += up;
			sum += s->side[d] * known_at(b, s, p);
			for (int e = d + 1; e < b->grid.dim && s->order == 4; e++)
				for (int over = -1; over <= 1; over += 2) {
					ptrdiff_t q[3] = {p[0], p[1], p[2]};
					q[e] += over;
					sum += s->cross[d][e] * known_at(b, s, q);
				}
		}
	return sum;
}

/* Order 2 with eps. */
static double with_eps(const struct pm_boundary *b, const struct stencil *s, const struct pm_boundary_eps *e, const ptrdiff_t at[3])
{
	const struct pm_grid *g = &b->grid;
	const size_t step[3] = {1, g->points[0], g->points[0] * g->points[1]};
	const size_t first = b->planes ? b->planes->first * b->planes->size : 0;
	const double *eps = e->eps + ((size_t)at[0] + step[1] * (size_t)at[1] + step[2] * (size_t)at[2] - first);
	double sum = 0;
	for (int d = 0; d < g->dim; d++)
		for (int side = 0; side < 2; side++) {
			ptrdiff_t p[3] = {at[0], at[1], at[2]}, n = (ptrdiff_t)g->points[d];
			p[d] += side ? 1 : -1;
			bool out = p[d] < 0 || p[d] >= n;
			double value = known_at(b, s, p);
			if (value != 0) /* a neighbour across a periodic face is no wall */
				sum += s->side[d] * value * (out ? *eps : e->between(*eps, side ? eps[step[d]] : *(eps - step[d])));
		}
	return sum;
}

/* Is node `at` of axis d so near to a face with values that a stencil reaches it? */
static bool near_face(const struct pm_boundary *b, int d, size_t at)
{
	return (b->value[d][0] && at <= 1) || (b->value[d][1] && at + 2 >= b->grid.points[d]);
}

void pm_boundary_known(const struct pm_boundary *b, int order, unsigned faces, const struct pm_boundary_eps *eps, double *known)
{
	const struct pm_grid *g = &b->grid;
	const struct stencil s = stencil_of(g, order, faces);
	const size_t *n = g->points;
	size_t first;
	const size_t rows = rows_here(b, &first);
#pragma omp parallel for schedule(static) num_threads(pm_threads())
	for (size_t row = 0; row < rows; row++) {
		size_t j = (first + row) % n[1], k = (first + row) / n[1];
		bool all = near_face(b, 1, j) || near_face(b, 2, k);
		for (size_t i = 0; i < n[0]; i++) {
			const ptrdiff_t at[3] = {(ptrdiff_t)i, (ptrdiff_t)j, (ptrdiff_t)k};
			bool wall = true;
			if (all || near_face(b, 0, i))
				wall_value(b, faces, at, &wall);
			known[row * n[0] + i] = wall ? 0 : eps ? with_eps(b, &s, eps, at) : differences(b, &s, at);
		}
	}
}

void pm_boundary_set(const struct pm_boundary *b, double *phi)
{
	const size_t *n = b->grid.points;
	size_t first;
	const size_t rows = rows_here(b, &first);
	for (size_t row = 0; row < rows; row++)
		for (size_t i = 0; i < n[0]; i++) {
			const size_t j = (first + row) % n[1], k = (first + row) / n[1];
			const ptrdiff_t at[3] = {(ptrdiff_t)i, (ptrdiff_t)j, (ptrdiff_t)k};
			bool wall = false, all = near_face(b, 1, j) || near_face(b, 2, k);
			double value = all || near_face(b, 0, i) ? wall_value(b, PM_BOUNDARY_ALL, at, &wall) : 0;
			if (wall)
				phi[row * n[0] + i] = value;
		}
}

/* A face of the box, a mesh of the two other axes. */
struct face {
	const struct pm_grid *g;
	const double *value, *eps; /* of the nodes of the face; eps NULL: 1 */
	int d, side, t[2];
};

/* The flux through a row of a face, and without its sign. */
static void make_flux(const void *data, size_t from, size_t to, void *part)
{
	const struct face *f = data;
	const struct pm_grid *g = f->g;
	struct pm_sum *sum = part;
	for (size_t i = from; i < to; i++) {
		size_t at[3] = {0, 0, 0};
		at[f->t[0]] = i - from, at[f->t[1]] = from / (to - from);
		double weight = pm_grid_cell(g) / g->h[f->d];
		for (int k = 0; k < 2; k++)
			if (f->t[k] < g->dim && g->points[f->t[k]] > g->cells[f->t[k]] && (at[f->t[k]] == 0 || at[f->t[k]] == g->cells[f->t[k]]))
				weight *= 0.5;
		weight *= f->eps ? f->eps[i] : 1;
		pm_sum_add(&sum[0], weight * f->value[i]);
		pm_sum_add(&sum[1], fabs(weight * f->value[i]));
	}
}

int pm_boundary_flux(int status, const struct pm_boundary *b, const struct pm_boundary_eps *eps, struct pm_boundary_flux *flux)
{
	const struct pm_grid *g = &b->grid;
	struct pm_sum sum[2] = {{0, 0}};
	const struct pm_parts parts = {.size = sizeof sum, .make = make_flux, .join = pm_join_sums};
	for (int a = 0; a < 2 * g->dim; a++) {
		const int d = a / 2, side = a % 2;
		struct face face = {.g = g, .value = b->value[d][side], .d = d, .side = side};
		size_t from, to;
		if (g->face[d][side] != PM_NEUMANN || !face.value)
			continue;
		double *here = eps && !status ? pm_alloc(pm_boundary_points(g, d), sizeof *here) : NULL;
		status = status || !eps || here ? status : -PM_DATA;
		pm_boundary_here(b, d, side, &from, &to);
		for (size_t i = from; here && i < to; i++)
			here[i] = eps->eps[pm_boundary_node(b, d, side, i)];
		if (eps)
			status = pm_boundary_share(status, b, d, side, here);
		face.eps = here;
		across(d, face.t);
		if (!status)
			pm_over_mesh(&parts, &face, (const size_t[3]){g->points[face.t[0]], g->points[face.t[1]], 1}, sum);
		pm_free(here);
	}
	*flux = (struct pm_boundary_flux){pm_sum_total(sum[0]), pm_sum_total(sum[1])};
	return status;
}
