/* What limits the time step. The strain: in a step two particles at distance d approach each other by at most dt |grad u| d, so particles cannot cross
 * if dt |grad u| < 1 in a matrix norm; here the largest row sum, which bounds distances along the axes (Cottet and Koumoutsakos 2000, section 7.1:
 * Lagrangian CFL). Plasma frequency: omega_p^2 = sum q^2/m/(eps0 V), with V the box (Birdsall and Langdon 1985, section 1-2). Cost N, points.
 * SPDX-License-Identifier: GPL-3.0-or-later */
#include <string.h>

#define PM_SIMD_NARROW
#include "base/simd.h"
#include "limit/rates.h"
#include "mesh/planes.h"
#include "stream/column.h"
#include "stream/kept.h"
#include "stream/over-stretches.h"
#include "world/world.h"

enum { BLOCK = 1024 };

/* Of at most BLOCK vectors, v[m][n]: the largest |v|^2, or with h the largest |v_d|/h_d. */
static double most_of_block(int m, size_t n, const double *const v[], const double *h)
{
	double here[BLOCK] __attribute__((aligned(64))) = {0};
	pm_simd most = {0};
	for (int d = 0; d < m; d++)
		for (size_t i = 0; i < n; i++)
			here[i] = h ? fmax(here[i], fabs(v[d][i]) / h[d]) : here[i] + v[d][i] * v[d][i];
	for (size_t i = 0; i < n; i += PM_SIMD_WIDTH) /* zero beyond n */
		pm_simd_raise(&most, pm_simd_load(here + i));
	for (int l = 1; l < PM_SIMD_WIDTH; l++)
		most[0] = fmax(most[0], most[l]);
	return most[0];
}

/* As f32 values will be at the end of the stage. */
static const double *rounded(const struct pm_column *c, size_t b, size_t n, double *few)
{
	const double *v = pm_column_take(c, b, n, few);
	for (size_t i = 0; i < n; i++)
		few[i] = (float)v[i];
	return few;
}

double pm_most(const struct pm_field *y, const double *h)
{
	double most = 0;
	int m = y->components < 3 || !h ? y->components : 3;
	struct pm_column column[PM_COMPONENTS];
	for (int d = 0; d < m; d++)
		column[d] = pm_column_of(y, d);
#pragma omp parallel for schedule(static) reduction(max : most) if (y->count > pm_many_turns())
	for (size_t b = 0; b < y->count; b += BLOCK) {
		const size_t n = y->count - b < BLOCK ? y->count - b : BLOCK;
		const double *v[PM_COMPONENTS];
		double few[PM_COMPONENTS][BLOCK];
		for (int d = 0; d < m; d++)
			v[d] = y->type == PM_F32 ? rounded(&column[d], b, n, few[d]) : pm_column_take(&column[d], b, n, few[d]);
		most = fmax(most, most_of_block(m, n, v, h));
	}
	return pm_most_of_stretches(y, most);
}

/* The neighbours along axis d of point i here, of number first + i in the mesh, and how far apart they are; points > 1. halo: beyond the ends of the axis the
 * neighbours follow. */
static double neighbours(const struct pm_grid *g, int d, ptrdiff_t i, size_t first, ptrdiff_t stride, bool halo, ptrdiff_t *below, ptrdiff_t *above)
{
	const size_t points = g->points[d], k = ((size_t)i + first) / (size_t)stride % points;
	const bool round = g->face[d][0] == PM_PERIODIC;
	const ptrdiff_t over = halo ? -1 : (ptrdiff_t)points - 1;
	*below = k ? i - stride : round ? i + over * stride : i;
	*above = k + 1 < points ? i + stride : round ? i - over * stride : i;
	return (round || (k && k + 1 < points) ? 2 : 1) * g->h[d];
}

/* Neighbours of a row along the other axes: the first of each, and the reciprocal of how far they are apart; 0: the axis has one point. */
struct beside {
	const double *below[3], *above[3];
	double per[3];
};

/* Of PM_SIMD_WIDTH points, of number i in the row. */
static inline __attribute__((always_inline)) pm_simd row_sums(int dim, size_t i, const double *before, double per, const struct beside *b)
{
	enum { ahead = 512 }; /* a page: those who fetch for us begin anew on each */
	pm_simd sum = pm_simd_abs(pm_simd_load_any(before + 2) - pm_simd_load_any(before)) * per;
	if (dim > 1)
		__builtin_prefetch(b->above[dim - 1] + i + ahead);
	for (int d = 1; d < dim; d++)
		sum += pm_simd_abs(pm_simd_load_any(b->above[d] + i) - pm_simd_load_any(b->below[d] + i)) * b->per[d];
	return sum;
}

/* The largest sum of |du/dx_d| over d among the points from .. from+n-1 of a row. line: the first of them, between its neighbours in the row, of which per is
 * the reciprocal of how far they are apart. */
static inline __attribute__((always_inline)) double most_in_row(int dim, size_t from, size_t n, const double *line, double per, const struct beside *b)
{
	pm_simd most = {0};
	const double *before = line - 1;
	size_t i = 0;
	for (; i + PM_SIMD_WIDTH <= n; i += PM_SIMD_WIDTH)
		pm_simd_raise(&most, row_sums(dim, from + i, before + i, per, b));
	for (int l = 1; l < PM_SIMD_WIDTH; l++)
		most[0] = fmax(most[0], most[l]);
	for (; i < n; i++) {
		double sum = fabs(before[i + 2] - before[i]) * per;
		for (int d = 1; d < dim; d++)
			sum += fabs(b->above[d][from + i] - b->below[d][from + i]) * b->per[d];
		most[0] = fmax(most[0], sum);
	}
	return most[0];
}

static double most_of_row(int dim, size_t from, size_t n, const double *line, double per, const struct beside *b)
{
	return dim == 1 ? most_in_row(1, from, n, line, per, b) : dim == 2 ? most_in_row(2, from, n, line, per, b) : most_in_row(3, from, n, line, per, b);
}

/* Row by row of one component; those at the ends of a row have neighbours elsewhere. */
static double strain_of_row(const struct pm_grid *g, const struct pm_planes *p, size_t at, size_t first, const double *u)
{
	const size_t n = g->points[0];
	struct beside b = {.per = {0}};
	ptrdiff_t stride = (ptrdiff_t)n, below, above;
	double most = 0;
	for (int d = 1; d < g->dim; stride *= (ptrdiff_t)g->points[d++]) {
		b.below[d] = b.above[d] = u + at;
		if (g->points[d] > 1) {
			b.per[d] = 1 / neighbours(g, d, (ptrdiff_t)at, first, stride, p->divided && d == p->axis, &below, &above);
			b.below[d] = u + below, b.above[d] = u + above;
		}
	}
	if (n > 2)
		most = most_of_row(g->dim, 1, n - 2, u + at + 1, 1 / (2 * g->h[0]), &b);
	for (size_t end = 0; end < n; end += n > 1 ? n - 1 : 1) {
		double ends[3] = {0, 0, 0}; /* below, and above, of one point */
		const double per = n > 1 ? 1 / neighbours(g, 0, (ptrdiff_t)(at + end), first, 1, false, &below, &above) : 1;
		if (n > 1)
			ends[0] = u[below], ends[2] = u[above];
		most = fmax(most, most_of_row(g->dim, end, 1, ends + 1, per, &b));
	}
	return most;
}

double pm_strain_in_plane(const struct pm_grid *g, size_t n, const double *here, const double *below, const double *above)
{
	return most_of_row(2, 0, n, here, 1 / (2 * g->h[0]), &(struct beside){.below = {NULL, below}, .above = {NULL, above}, .per = {0, 1 / (2 * g->h[1])}});
}

static double strain(const struct pm_grid *g, const struct pm_planes *p, int components, const double *const u[])
{
	const size_t n = g->points[0], rows = p->here * p->size / n, first = p->first * p->size;
	double most = 0;
#pragma omp parallel for schedule(static) reduction(max : most) if (rows * n > pm_many_turns() / 4)
	for (size_t row = 0; row < rows; row++)
		for (int c = 0; c < components; c++)
			most = fmax(most, strain_of_row(g, p, row * n, first, u[c]));
	return most;
}

double pm_strain(const struct pm_grid *g, const struct pm_field *field, const double *const u[])
{
	const double *with[PM_COMPONENTS];
	double *room = NULL, most = 0;
	struct pm_planes p;
	int status = pm_planes_init(&p, g, field);
	if (!field->here && !status)
		return strain(g, &p, field->components, u);
	if (!pm_planes_halo(status, &p, 1, field->components, u, with, &room)) /* all ranks know of a failure */
		most = strain(g, &p, field->components, with);
	else
		pm_cannot_go_on();
	pm_free(room);
	pm_planes_free(&p);
	return pm_most_of_stretches(field, most);
}

struct charges {
	struct pm_column q, m;
};

static void make_squares(const void *data, size_t from, size_t to, void *part)
{
	const struct charges *c = data;
	for (size_t p = from; p < to; p++)
		pm_sum_add(part, pm_column_at(&c->q, p) * pm_column_at(&c->q, p) / pm_column_at(&c->m, p));
}

static const struct pm_parts squares = {.size = sizeof(struct pm_sum), .make = make_squares, .join = pm_join_sums};

double pm_charge_over_mass(size_t n, const double *q, const double *m)
{
	struct pm_sum sum = {0, 0};
	pm_over_set(&squares, &(struct charges){pm_column_doubles(q), pm_column_doubles(m)}, n, &sum);
	return pm_sum_total(sum);
}

/* sum q^2/m of a set; kept as long as charges and masses stay. */
static struct pm_sum set_sum(const struct pm_field *q, const struct pm_field *m)
{
	static const char name[] = "sum of q^2/m";
	const struct pm_sum *kept = pm_kept(q, m, name);
	struct pm_sum sum = {0, 0}, *copy;
	if (kept)
		return *kept;
	pm_over_stretches(q, &squares, &(struct charges){pm_column_of(q, 0), pm_column_of(m, 0)}, &sum);
	if ((copy = pm_alloc(1, sizeof *copy))) {
		*copy = sum;
		if (!pm_keep(q, m, name, copy))
			pm_free(copy);
	}
	return sum;
}

double pm_plasma_frequency(const struct pm_frame *f, const struct pm_law *law)
{
	struct pm_sum sum = {0, 0};
	double box = 1;
	for (size_t i = 0; i < f->nsets; i++) {
		const struct pm_field *q = pm_frame_field(f, f->sets[i]->name, law->strength), *m = pm_frame_field(f, f->sets[i]->name, law->per);
		if (q && m && pm_set_moves(f, f->sets[i])) {
			const struct pm_sum of_set = set_sum(q, m);
			pm_join_sums(sizeof sum, &of_set, &sum);
		}
	}
	for (int d = 0; d < f->dim; d++)
		box *= f->hi[d] - f->lo[d];
	return sqrt(fabs(law->coefficient(f)) * pm_sum_total(sum) / box);
}

static void make_sizes(const void *data, size_t from, size_t to, void *part)
{
	const struct pm_field *q = data;
	const double *each = q->uniform ? NULL : pm_in(q, 0);
	struct pm_sum sum = *(struct pm_sum *)part; /* in registers */
	for (size_t p = from; p < to; p++)
		pm_sum_add(&sum, fabs(each ? each[p] : q->value[0]));
	*(struct pm_sum *)part = sum;
}

/* Of the first set, kept; a uniform strength may be given another value. */
struct total {
	bool uniform;
	double value;
	struct pm_sum sum;
};

double pm_strength_total(const struct pm_frame *f, const char *strength)
{
	static const char name[] = "sum of |strength|";
	const struct total *kept;
	const struct pm_parts parts = {.size = sizeof(struct pm_sum), .make = make_sizes, .join = pm_join_sums};
	struct pm_sum sum = {0, 0};
	for (size_t i = 0; i < f->nsets; i++) {
		const struct pm_field *q = pm_frame_field(f, f->sets[i]->name, strength);
		const bool first = sum.sum == 0 && sum.carry == 0;
		if (q && first && (kept = pm_kept(q, NULL, name)) && kept->uniform == q->uniform && kept->value == q->value[0]) {
			sum = kept->sum;
			continue;
		}
		if (q && !q->uniform)
			pm_field_bring(q);
		if (q)
			pm_over_stretches(q, &parts, q, &sum);
		struct total *copy = q && first ? pm_alloc(1, sizeof *copy) : NULL;
		if (copy)
			*copy = (struct total){q->uniform, q->value[0], sum};
		if (copy && !pm_keep(q, NULL, name, copy))
			pm_free(copy);
	}
	return pm_sum_total(sum);
}

double pm_orbit_rate(int dim, double most, double pull)
{
	if (dim < 2 || !(most > 0) || !(pull > 0))
		return 0;
	return dim == 2 ? most * most * 2 * pm_pi / pull : most * sqrt(most * 4 * pm_pi / pull);
}
