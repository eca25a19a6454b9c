/* Remeshing: node i receives sum over particles of strength * W((x - x_i)/h), the density of p2m times the node's cell, and the nodes that
 * are not 0 are the new particles. Source: Cottet and Koumoutsakos 2000, section 7.2; Koumoutsakos 1997, J. Comput. Phys. 138, 821.
 * Conserves the kernel's moments away from faces, and the total always: at walls and neumann faces strength beyond the face is folded
 * back as an even image (odd images at walls would remove strength). A positive kernel diffuses, the others overshoot (kernels.md).
 * Cost: p2m per strength and two passes over the mesh. SPDX-License-Identifier: GPL-3.0-or-later */
#include <string.h>

#define PM_SIMD_NARROW
#include "remesh/remesh.h"
#include "base/in-order.h"
#include "base/simd.h"
#include "transfer/one-sided.h"
#include "world/world.h"

static size_t rows_of(const struct pm_remesh *r) { return r->points / r->grid.points[0]; }

/* The number in the mesh of the first row here. */
static size_t first_row(const struct pm_remesh *r) { return r->planes ? pm_planes_row(r->planes, 0) : 0; }

/* The volumes of the nodes of a row: of those at its ends, and of the others. */
struct volumes {
	double end, inner;
};
static struct volumes volumes_of(const struct pm_grid *g, size_t row)
{
	const size_t y = row % g->points[1], z = row / g->points[1];
	const double cell = pm_grid_cell(g), end = cell * pm_grid_weight(g, 0, y, z);
	return (struct volumes){end, g->points[0] > 2 ? cell * pm_grid_weight(g, 1, y, z) : end};
}

struct pm_remesh pm_remesh_on(const struct pm_grid *g, const struct pm_kernel *k)
{
	struct pm_remesh r = {.grid = *g, .kernel = k, .points = pm_grid_size(g)};
	for (int d = 0; d < g->dim; d++)
		for (int side = 0; side < 2; side++)
			if (g->face[d][side] == PM_WALL)
				r.grid.face[d][side] = PM_NEUMANN;
	return r;
}

void pm_remesh_share(struct pm_remesh *r, const struct pm_planes *planes)
{
	r->planes = planes;
	r->points = planes->here * planes->size;
}

/* One row of densities to strengths: times the volume of each node. */
static void weigh_row(const struct pm_remesh *r, size_t row, double *at)
{
	const struct volumes v = volumes_of(&r->grid, first_row(r) + row);
	const size_t n = r->grid.points[0];
	at[0] *= v.end;
	for (size_t i = 1; i + 1 < n; i++)
		at[i] *= v.inner;
	if (n > 1)
		at[n - 1] *= v.end;
}

static void weigh(const struct pm_remesh *r, double *node)
{
#pragma omp parallel for schedule(static) if (r->points > 16384)
	for (size_t row = 0; row < rows_of(r); row++)
		weigh_row(r, row, node + row * r->grid.points[0]);
}

/* Copies of the positions and strengths in which those of which[] stand in the middle of the mesh and have none. */
static double *apart(const struct pm_remesh *r, size_t n, const struct pm_one_sided_few *few, int components, const double *const q[], const double *xs[3],
	const double *qs[])
{
	const int dim = r->grid.dim;
	double *copy = pm_alloc((n + 1) * (size_t)(dim + components), sizeof *copy);
	for (int c = 0; c < dim + components && copy; c++) {
		double *to = copy + (size_t)c * n;
		memcpy(to, c < dim ? few->x[c] : q[c - dim], n * sizeof *to);
		for (size_t k = 0; k < few->count; k++)
			to[few->which[k]] = c < dim ? r->grid.lo[c] + 0.5 * (double)r->grid.cells[c] * r->grid.h[c] : 0;
		*(c < dim ? &xs[c] : &qs[c - dim]) = to;
	}
	return copy;
}

/* With bodies: the particles beside them and beside faces by one-sided kernels, all others as ever. Leaves strengths of nodes. */
static int add_beside(const struct pm_remesh *r, size_t n, const double *const x[], int components, const double *const q[], int first,
	struct pm_strays *strays)
{
	const struct pm_transfer t = {.grid = r->grid, .kernel = r->kernel, .components = components, .planes = r->planes};
	const struct pm_one_sided o = {.grid = r->grid, .kernel = r->kernel, .mask = r->mask, .planes = r->planes};
	const double *xs[3] = {NULL}, *qs[PM_REMESH_VALUES];
	struct pm_one_sided_few few;
	int status = pm_one_sided_find(&o, n, x, &few);
	double *copy = status ? NULL : apart(r, n, &few, components, q, xs, qs);
	status = pm_world_agree(status ? status : copy ? 0 : pm_failed());
	status = status ? status : pm_spread(&t, n, xs, qs, r->node + first, strays);
	for (int c = 0; c < components && !status; c++)
		weigh(r, r->node[first + c]);
	if (!status)
		status = pm_one_sided_spread(&o, &few, components, q, r->node + first);
	if (!status && few.lost) {
		*strays = (struct pm_strays){.count = few.lost, .first = few.first};
		for (int d = 0; d < r->grid.dim; d++)
			strays->x[d] = x[d][few.first];
	}
	pm_free(few.which), pm_free(copy);
	return status;
}

/* Of absolute values. */
struct range {
	double least, most;
};

static struct range range_of(size_t n, const double *v)
{
	pm_simd most = {0}, below = {0}; /* the largest of -|v|: the least, raised like the other */
	struct range r = {INFINITY, 0};
	size_t i = 0;
	for (int l = 0; l < PM_SIMD_WIDTH; l++)
		below[l] = -INFINITY;
	for (; i + PM_SIMD_WIDTH <= n; i += PM_SIMD_WIDTH) {
		const pm_simd size = pm_simd_abs(pm_simd_load_any(v + i));
		pm_simd_raise(&most, size), pm_simd_raise(&below, -size);
	}
	for (; i < n; i++)
		r.least = fmin(r.least, fabs(v[i])), r.most = fmax(r.most, fabs(v[i]));
	for (int l = 0; l < PM_SIMD_WIDTH; l++)
		r.least = fmin(r.least, -below[l]), r.most = fmax(r.most, most[l]);
	return r;
}

/* Strengths of value i, of densities if it is to weigh them, and their range. False: one is not finite. */
static bool finish(struct pm_remesh *r, int i, bool weighs)
{
	const size_t n = r->grid.points[0];
	double most = 0, least = INFINITY;
	int bad = 0;
#pragma omp parallel for schedule(static) reduction(max : most) reduction(min : least) reduction(| : bad) if (r->points > 16384)
	for (size_t row = 0; row < rows_of(r); row++) {
		double *node = r->node[i] + row * n;
		if (weighs)
			weigh_row(r, row, node);
		bad |= !pm_finite_few(n, node);
		const struct range here = range_of(n, node);
		most = fmax(most, here.most), least = fmin(least, here.least);
	}
	r->most[i] = most, r->least[i] = least;
	return !bad;
}

int pm_remesh_add(struct pm_remesh *r, size_t n, const double *const x[], int components, const double *const q[], bool decides,
	struct pm_strays *strays)
{
	const struct pm_transfer t = {.grid = r->grid, .kernel = r->kernel, .components = components, .planes = r->planes};
	int first = r->n, status = 0;
	if (first + components > PM_REMESH_VALUES)
		return pm_fail(PM_DATA, "more than %d values per particle to remesh (leave some out with --drop)", PM_REMESH_VALUES);
	for (int c = 0; c < components && !status; c++, r->n++) {
		r->node[r->n] = pm_zalloc(r->points + 1, sizeof(double));
		status = r->node[r->n] ? 0 : -PM_DATA;
		r->field[r->n] = decides ? first : -1;
	}
	status = pm_world_agree(status);
	if (!status)
		status = r->mask ? add_beside(r, n, x, components, q, first, strays) : pm_spread(&t, n, x, q, r->node + first, strays);
	for (int i = first; i < r->n && !status; i++)
		if (!finish(r, i, !r->mask))
			status = pm_fail(PM_NUMERICS, "a remeshed strength is not finite (strengths this large overflow)");
	return pm_world_agree(status);
}

static int thresholds(const struct pm_remesh *r, double cut_off, double least[])
{
	double largest[PM_REMESH_VALUES];
	memcpy(largest, r->most, sizeof largest);
	const int status = pm_world_largest(0, (size_t)r->n, largest);
	for (int i = 0; i < r->n; i++) {
		least[i] = cut_off * largest[i];
		if (r->field[i] >= 0 && r->field[i] < i) /* components share the largest */
			for (int c = r->field[i]; c <= i; c++)
				least[c] = fmax(least[r->field[i]], least[i]);
	}
	return status;
}

/* Marks the nodes that become particles. */
static void mark(const struct pm_remesh *r, const double least[])
{
	bool all = false;
	for (int i = 0; i < r->n; i++)
		all = all || (r->field[i] >= 0 && r->least[i] > least[i]);
#pragma omp parallel for schedule(static) if (r->points > 16384)
	for (size_t row = 0; row < rows_of(r); row++) {
		const size_t n = r->grid.points[0];
		unsigned char *keep = r->keep + row * n;
		memset(keep, all, n);
		for (int i = 0; i < r->n && !all; i++) {
			const double *node = r->node[i] + row * n, more = least[i];
			for (size_t p = 0; p < n && r->field[i] >= 0; p++)
				keep[p] |= fabs(node[p]) > more;
		}
	}
}

/* All nodes of a row? */
static bool keeps_all(size_t n, const unsigned char *keep) { return !memchr(keep, 0, n); }

size_t pm_remesh_room(const struct pm_kernel *k) { return (size_t)(k->width + 1) / 2 + 1; }

/* May a node of a rim lie at index k of axis d? Particles there must have room to move before the kernel reaches an open face. */
static bool has_room(const struct pm_remesh *r, int d, size_t k)
{
	const size_t room = pm_remesh_room(r->kernel);
	const enum pm_face low = r->grid.face[d][0], high = r->grid.face[d][1];
	return (low == PM_PERIODIC || low == PM_NEUMANN || k >= room) && (high == PM_PERIODIC || high == PM_NEUMANN || k + room <= r->grid.cells[d]);
}

/* Every node within `rim` cells of a marked one along each axis is marked as well. Along a divided axis the marks of the neighbours' planes are brought. */
static int widen(struct pm_remesh *r, int rim)
{
	const int dim = r->grid.dim, across = r->planes && r->planes->axis ? r->planes->axis : dim;
	const size_t last = r->grid.points[dim - 1], most = (size_t)rim < last ? (size_t)rim : last - 1, beside = across < dim ? most * r->planes->size : 0;
	unsigned char *room = pm_zalloc(r->points + 2 * beside + 1, 1), *from = room ? room + beside : NULL;
	int status = pm_world_agree(room ? 0 : -PM_DATA);
	size_t stride = 1;
	for (int d = 0; d < dim && !status; stride *= r->grid.points[d++]) {
		const size_t n = r->grid.points[d], reach = (size_t)rim < n ? (size_t)rim : n - 1, first = d == across ? r->planes->first : 0;
		const bool round = r->grid.face[d][0] == PM_PERIODIC;
		const size_t turn = d == across ? 0 : n * stride; /* a halo has the planes beyond the seam where they would be */
		memcpy(from, r->keep, r->points);
		if (d == across)
			status = pm_world_halo(0, &(struct pm_halo){.from = r->planes->from, .bytes = stride, .wide = (int)reach, .periodic = round}, from);
#pragma omp parallel for schedule(static) if (r->points > 16384)
		for (size_t p = 0; p < r->points; p++) {
			const size_t k = first + p / stride % n;
			const unsigned char *at = from + p;
			bool keep = *at;
			for (size_t s = 1; s <= reach && !keep && has_room(r, d, k); s++)
				keep = (k >= s ? *(at - s * stride) : round && *(at + turn - s * stride)) ||
					(k + s < n ? *(at + s * stride) : round && *(at + s * stride - turn));
			r->keep[p] = keep && !(r->mask && r->mask[first_row(r) * r->grid.points[0] + p]);
		}
	}
	pm_free(room);
	return status;
}

/* What the nodes cut off held. */
static void make_lost(const void *data, size_t from, size_t to, void *part)
{
	const struct pm_remesh *r = data;
	struct pm_sum *lost = part;
	if (keeps_all(to - from, r->keep + from))
		return;
	for (size_t p = from; p < to; p++)
		for (int i = 0; i < r->n && !r->keep[p]; i++)
			pm_sum_add(&lost[i], r->node[i][p]);
}

/* Counts the nodes of a row that are kept, and those that are not 0 and are not. */
static size_t count_row(const struct pm_remesh *r, size_t row, uint64_t *cut)
{
	const size_t n = r->grid.points[0];
	size_t kept = 0;
	if (keeps_all(n, r->keep + row * n))
		return n;
	for (size_t p = row * n; p < (row + 1) * n; p++) {
		bool any = false;
		for (int i = 0; i < r->n && !r->keep[p]; i++)
			any = any || r->node[i][p] != 0;
		kept += r->keep[p];
		*cut += any;
	}
	return kept;
}

static int count(struct pm_remesh *r)
{
	const size_t rows = rows_of(r);
	uint64_t cut = 0;
	struct pm_sum lost[PM_REMESH_VALUES] = {{0, 0}};
	const struct pm_parts parts = {.size = (size_t)(r->n ? r->n : 1) * sizeof *lost, .make = make_lost, .join = pm_join_sums};
#pragma omp parallel for schedule(static) reduction(+ : cut) if (r->points > 16384)
	for (size_t row = 0; row < rows; row++)
		r->before[row + 1] = count_row(r, row, &cut);
	r->before[0] = 0;
	for (size_t row = 0; row < rows; row++)
		r->before[row + 1] += r->before[row];
	int64_t all = (int64_t)cut;
	int status = pm_world_count(0, PM_SUM_OF, 1, &all);
	if (r->planes)
		status = pm_planes_over(status, r->planes, &parts, r, lost);
	else
		pm_over_mesh(&parts, r, r->grid.points, lost);
	for (int i = 0; i < r->n; i++)
		r->lost[i] = pm_sum_total(lost[i]);
	r->cut = (uint64_t)all;
	r->kept = r->before[rows];
	return status;
}

int pm_remesh_keep(struct pm_remesh *r, double cut_off, int rim)
{
	double least[PM_REMESH_VALUES];
	r->keep = pm_alloc(r->points + 1, 1);
	r->before = pm_alloc(rows_of(r) + 1, sizeof *r->before);
	int status = pm_world_agree(r->keep && r->before ? 0 : -PM_DATA);
	status = status ? status : thresholds(r, cut_off, least);
	if (!status) {
		mark(r, least);
		status = rim ? widen(r, rim) : 0;
	}
	return status ? status : count(r);
}

double pm_remesh_total(const struct pm_remesh *r, int i)
{
	struct pm_sum all = {0, 0};
	if (!r->planes)
		pm_sum_of_mesh(r->grid.points, r->node[i], NULL, NULL, &all);
	else if (pm_planes_sum(0, r->planes, r->node[i], NULL, NULL, &all))
		pm_cannot_go_on();
	return pm_sum_total(all);
}

static bool is_full(const struct pm_remesh *r, size_t row) { return r->before[row + 1] - r->before[row] == r->grid.points[0]; }

void pm_remesh_value(const struct pm_remesh *r, int i, double *out)
{
	const size_t n = r->grid.points[0];
#pragma omp parallel for schedule(static) if (r->points > 16384)
	for (size_t row = 0; row < rows_of(r); row++) {
		size_t to = r->before[row];
		if (is_full(r, row))
			memcpy(out + to, r->node[i] + row * n, n * sizeof *out);
		else
			for (size_t p = row * n; p < (row + 1) * n; p++)
				if (r->keep[p])
					out[to++] = r->node[i][p];
	}
}

void pm_remesh_position(const struct pm_remesh *r, int d, double *x)
{
	const size_t n = r->grid.points[0], first = first_row(r);
#pragma omp parallel for schedule(static) if (r->points > 16384)
	for (size_t row = 0; row < rows_of(r); row++) {
		const size_t at = d == 1 ? (first + row) % r->grid.points[1] : (first + row) / r->grid.points[1];
		const double lo = r->grid.lo[d], h = r->grid.h[d], here = lo + (double)at * h;
		const bool all = is_full(r, row);
		size_t to = r->before[row];
		for (int i = 0; i < (all ? (int)n : 0); i++) /* int: what becomes a double four at a time */
			x[to + (size_t)i] = d ? here : lo + (double)i * h;
		for (size_t i = 0; i < n && !all; i++)
			if (r->keep[row * n + i])
				x[to++] = d ? here : lo + (double)i * h;
	}
}

void pm_remesh_volume(const struct pm_remesh *r, double *volume)
{
	const size_t n = r->grid.points[0], first = first_row(r);
#pragma omp parallel for schedule(static) if (r->points > 16384)
	for (size_t row = 0; row < rows_of(r); row++) {
		const struct volumes v = volumes_of(&r->grid, first + row);
		const bool all = is_full(r, row);
		for (size_t i = 0, to = r->before[row]; i < n; i++)
			if (all || r->keep[row * n + i])
				volume[to++] = i && i + 1 < n ? v.inner : v.end;
	}
}

bool pm_remesh_is_finite(const struct pm_remesh *r)
{
	bool finite = isfinite(pm_grid_cell(&r->grid));
	for (int d = 0; d < r->grid.dim; d++)
		finite = finite && isfinite(r->grid.lo[d]) && isfinite(r->grid.lo[d] + (double)r->grid.points[d] * r->grid.h[d]);
	return finite;
}

void pm_remesh_free(struct pm_remesh *r)
{
	for (int i = 0; i < r->n; i++)
		pm_free(r->node[i]);
	pm_free(r->keep);
	pm_free(r->before);
	*r = (struct pm_remesh){.n = 0};
}
