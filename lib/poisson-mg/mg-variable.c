/* div(eps grad phi) = f with eps that varies and jumps: conjugate gradients preconditioned with a multigrid cycle.
 *   z = cycle(r), beta = z.(r - r_before)/(z.r)_before, d = z + beta d, alpha = d.r/d.Md, x += alpha d, r = f - M x
 * (flexible form, Notay 2000, which tolerates a cycle that is not exactly symmetric). The cycles are those of mg-variable-cycle.c over operator-dependent
 * transfers and Galerkin matrices, which are robust to jumps; conjugate gradients remove the few slow modes of jumps that cross at a corner (Kettler 1982).
 * The residual is recomputed each time, so that round-off is detected. Singular problems as in mg.c. Cost: O(N) per iteration; memory 30 values
 * per node in 3-D. SPDX-License-Identifier: GPL-3.0-or-later */
#include "poisson-mg/mg-variable-level.h"
#include "mesh/mesh-sum.h"
#include "poisson-mg/mg-ranks.h"
#include "world/over-ranks.h"

#include <float.h>
#include <string.h>

struct pm_mg_variable *pm_mg_variable_free(struct pm_mg_variable *v)
{
	for (int i = 0; v && i < mgv_levels; i++)
		pm_mgv_free(&v->level[i]);
	if (v)
		pm_free(v->eps), pm_free(v->x), pm_free(v->d), pm_free(v->q), pm_free(v->before), pm_free(v->best), pm_free(v->sums),
			pm_planes_free(&v->planes);
	return pm_free(v);
}

/* Of the planes here. */
static int check_positive(const struct pm_grid *g, const struct pm_planes *planes, const double *eps)
{
	const size_t first = planes->first * planes->size;
	for (size_t i = 0; i < planes->here * planes->size; i++)
		if (!(eps[i] > 0) || !isfinite(eps[i])) {
			const size_t p = first + i;
			pm_world_place(0, 0, 0, p);
			return pm_fail(PM_DATA, "the permittivity must be positive everywhere, and at node %zu,%zu,%zu it is %g (a conductor is a large "
				"value, not infinity)",
				p % g->points[0], p / g->points[0] % g->points[1], p / g->points[0] / g->points[1], eps[i]);
		}
	return 0;
}

static int arrays(struct pm_mg_variable *v)
{
	size_t size = v->level[0].size;
	v->x = pm_zalloc(size, sizeof(double));
	v->d = pm_zalloc(size, sizeof(double));
	v->q = pm_zalloc(size, sizeof(double));
	v->before = pm_zalloc(size, sizeof(double));
	v->best = pm_zalloc(size, sizeof(double));
	v->sums = pm_zalloc(mgv_rows(&v->level[0]) + 1, sizeof(double));
	return v->x && v->d && v->q && v->before && v->best && v->sums ? 0 : pm_failed();
}

/* The finest grid: all ranks have come so far, or none. */
static int begin(struct pm_mg_variable *v, const double *eps)
{
	const size_t more = v->planes.divided ? v->planes.size : 0, n = v->planes.here * v->planes.size + 2 * more;
	if (!(v->eps = pm_alloc(n + 1, sizeof *eps)))
		return pm_failed();
	v->constant = !eps;
	for (size_t p = 0; p < n; p++)
		v->eps[p] = eps ? *(eps + p - more) : 1;
	if (pm_mgv_finest(v))
		return pm_failed();
	return v->level[0].size ? arrays(v) : 0;
}

static int build(struct pm_mg_variable *v, const double *eps)
{
	bool more = true;
	v->status = pm_planes_agree(begin(v, eps), &v->planes);
	if (v->status || !mgv_total(&v->level[0]))
		return v->status;
	for (v->levels = 1; more && v->levels < mgv_levels; v->levels += more) {
		const bool good = pm_mgv_coarser(&v->level[v->levels - 1], &v->level[v->levels], &more);
		v->status = pm_planes_agree(good ? v->status : pm_failed(), &v->planes);
		if (v->status)
			return v->status;
	}
	return 0;
}

struct pm_mg_variable *pm_mg_variable_new_planes(const struct pm_grid *g, const double *eps, enum pm_mg_mean mean, const struct pm_planes *planes)
{
	struct pm_mg_variable *v = pm_mg_check(g) ? NULL : pm_zalloc(1, sizeof *v);
	int status = v ? pm_planes_copy(&v->planes, g, planes) : pm_failed();
	if (!status && eps)
		status = check_positive(g, &v->planes, eps);
	status = pm_planes_agree(status, planes);
	if (!status) {
		v->grid = *g;
		v->mean = mean;
		status = build(v, eps);
	}
	return status ? pm_mg_variable_free(v) : v;
}

struct pm_mg_variable *pm_mg_variable_new(const struct pm_grid *g, const double *eps, enum pm_mg_mean mean)
{
	return pm_mg_variable_new_planes(g, eps, mean, NULL);
}

bool pm_mg_variable_same_planes(const struct pm_mg_variable *v, const struct pm_planes *planes)
{
	const uint64_t *from = planes && planes->divided ? planes->from : NULL, *has = v->planes.divided ? v->planes.from : NULL;
	return from && has ? !memcmp(from, has, ((size_t)pm_world_size() + 1) * sizeof *from) : !from && !has;
}

bool pm_mg_variable_fits(const struct pm_mg_variable *v, const struct pm_grid *g, const double *eps, enum pm_mg_mean mean)
{
	const struct pm_grid *a = &v->grid;
	if (v->mean != mean || a->dim != g->dim || memcmp(a->points, g->points, sizeof g->points) || memcmp(a->cells, g->cells, sizeof g->cells) ||
		memcmp(a->h, g->h, sizeof g->h) || memcmp(a->face, g->face, sizeof g->face))
		return false;
	const double *own = v->eps + (v->planes.divided ? v->planes.size : 0);
	return eps ? !memcmp(own, eps, v->planes.here * v->planes.size * sizeof *eps) : v->constant;
}

/* Of the numbers that rows of the finest grid have. */
static double total(struct pm_mg_variable *v)
{
	const struct mgv_level *l = &v->level[0];
	const size_t here = l->m[l->dim - 1] * (l->dim == 3 && l->all[2] == 1 ? l->all[1] : 1); /* one plane is joined by rows, as in 2-D */
	struct pm_sum all = {0, 0};
	if (!v->planes.divided)
		return pm_sum_of_rows(l->m, v->sums);
	v->status = pm_world_over_mesh(v->status, &pm_row_sums, &(struct pm_row_values){v->sums, l->m[0]}, l->all, here, &all);
	return pm_sum_total(all);
}

static double most_of(struct pm_mg_variable *v, double here)
{
	if (v->planes.divided)
		v->status = pm_world_largest(v->status, 1, &here);
	return here;
}

/* The sum of a (b - c) over the unknowns, c NULL: of a b; rows in order. */
static double product(struct pm_mg_variable *v, const double *a, const double *b, const double *c)
{
	const struct mgv_level *l = &v->level[0];
	#pragma omp parallel for num_threads(pm_threads()) if (mgv_unknowns(l) > mgv_parallel)
	for (size_t row = 0; row < mgv_rows(l); row++) {
		double sum = 0;
		for (size_t p = mgv_row(l, row); p < mgv_row(l, row) + l->m[0]; p++)
			sum += a[p] * (c ? b[p] - c[p] : b[p]);
		v->sums[row] = sum;
	}
	return total(v);
}

/* y = x + a y, or y += a x: one of the two factors is 1. */
static void combine(const struct pm_mg_variable *v, double mine, double a, const double *x, double *y)
{
	size_t size = v->level[0].size;
	#pragma omp parallel for num_threads(pm_threads()) if (size > mgv_parallel)
	for (size_t p = 0; p < size; p++)
		y[p] = mine * y[p] + a * x[p];
}

static double mean(struct pm_mg_variable *v, const double *values)
{
	const struct pm_grid *g = &v->grid;
	double end[3][2];
	struct pm_sum all = {0, 0};
	for (int d = 0; d < 3; d++)
		end[d][0] = end[d][1] = g->points[d] > g->cells[d] ? 0.5 : 1;
	v->status = pm_planes_sum(v->status, &v->planes, values, NULL, end, &all);
	return pm_sum_total(all) / ((double)g->cells[0] * (double)g->cells[1] * (double)g->cells[2]);
}

/* Is the residual at the level of rounding errors of its terms? */
static bool at_roundoff(struct pm_mg_variable *v, double residual, double source)
{
	const struct mgv_level *l = &v->level[0];
	for (size_t row = 0; row < mgv_rows(l); row++) {
		v->sums[row] = 0;
		for (size_t p = mgv_row(l, row); p < mgv_row(l, row) + l->m[0]; p++)
			v->sums[row] += l->w[0][p] * v->x[p] * (l->w[0][p] * v->x[p]);
	}
	return residual <= 4 * DBL_EPSILON * (sqrt(total(v)) + source);
}

/* f - M x into f of the finest level; its sum, which must vanish in a singular problem, is taken out before round-off in it grows. */
static void residual(struct pm_mg_variable *v, const double *source)
{
	struct mgv_level *l = &v->level[0];
	pm_mgv_residual(l, v->x, source, l->f);
	if (v->fixed)
		return;
	for (size_t row = 0; row < mgv_rows(l); row++) {
		struct pm_sum sum = {0, 0};
		for (size_t p = mgv_row(l, row); p < mgv_row(l, row) + l->m[0]; p++)
			pm_sum_add(&sum, l->f[p]);
		v->sums[row] = pm_sum_total(sum);
	}
	const double sum = total(v);
	for (size_t row = 0; row < mgv_rows(l); row++)
		for (size_t p = mgv_row(l, row); p < mgv_row(l, row) + l->m[0]; p++)
			l->f[p] -= sum / (double)mgv_total(l);
}

/* One iteration: from the residual in f of the finest level to the next; before: z.r of the last one, 0 at first. Returns z.r. */
static double iteration(struct pm_mg_variable *v, const struct pm_mg_choice *o, const double *source, double before)
{
	struct mgv_level *l = &v->level[0];
	pm_mgv_cycle(v, 0, o, true);
	if (o->plain) {
		combine(v, 1, 1, l->u, v->x);
		residual(v, source);
		return 0;
	}
	double now = product(v, l->u, l->f, NULL), beta = before != 0 ? product(v, l->u, l->f, v->before) / before : 0;
	combine(v, beta, 1, l->u, v->d);
	memset(l->r, 0, l->size * sizeof(double));
	pm_mgv_residual(l, v->d, l->r, v->q); /* -M d */
	double curvature = -product(v, v->d, v->q, NULL);
	combine(v, 1, curvature > 0 ? product(v, v->d, l->f, NULL) / curvature : 0, v->d, v->x);
	memcpy(v->before, l->f, l->size * sizeof(double));
	residual(v, source);
	return now;
}

/* source: the right-hand side, padded; norm: its own. */
static void iterate(struct pm_mg_variable *v, const struct pm_mg_choice *o, const double *source, double norm, struct pm_mg_record *r)
{
	struct mgv_level *l = &v->level[0];
	double before = 0;
	int first = o->cycle == PM_MG_FMG, slow = 0; /* iterations since the residual was halved */
	double best = INFINITY;
	memset(v->x, 0, l->size * sizeof(double));
	memset(v->d, 0, l->size * sizeof(double));
	memcpy(l->f, source, l->size * sizeof(double));
	if (first) {
		pm_mgv_full(v, o);
		memcpy(v->x, l->u, l->size * sizeof(double));
		residual(v, source);
	}
	for (;; r->cycles++) {
		double now = sqrt(product(v, l->f, l->f, NULL)) / norm;
		r->history[r->n++] = r->after = now;
		r->converged = now == 0 || (now <= o->tolerance && r->cycles >= first);
		slow = now < 0.5 * best ? 0 : slow + 1;
		if (now < best)
			memcpy(v->best, v->x, l->size * sizeof(double)), best = now;
		if (!r->converged && slow > 2 && at_roundoff(v, now * norm, norm))
			r->converged = r->floor = true;
		if (v->status || r->converged || r->cycles == o->most || !isfinite(now))
			break;
		before = iteration(v, o, source, before);
	}
	if (r->after > best)
		memcpy(v->x, v->best, l->size * sizeof(double)), r->after = best;
	r->before = r->history[0];
	int last = r->n - 1 - r->floor;
	if (last > 0 && r->history[0] > 0)
		r->contraction = pow(r->history[last] / r->history[0], 1.0 / last);
}

int pm_mg_variable_solve(struct pm_mg_variable *v, const struct pm_mg_choice *o, double c, const double *s, double *phi, struct pm_mg_record *r)
{
	const size_t n = v->planes.here * v->planes.size;
	double most = 0, whole = 0, *source = v->levels ? pm_zalloc(v->level[0].size, sizeof *source) : NULL;
	v->status = pm_planes_agree(v->levels && !source ? pm_failed() : 0, &v->planes);
	if (v->status)
		return pm_free(source), v->status;
	*r = (struct pm_mg_record){.singular = !v->fixed, .mean = v->fixed ? 0 : mean(v, s), .converged = true};
	for (size_t p = 0; p < n; p++)
		most = fmax(most, fabs(c * (s[p] - r->mean))), whole = fmax(whole, fabs(s[p]));
	most = most_of(v, most), whole = most_of(v, whole);
	r->incompatible = whole > 0 ? fabs(r->mean) / whole : 0;
	double unit = most > 0 && isfinite(most) ? ldexp(1, ilogb(most)) : 1; /* squares must neither vanish nor overflow */
	if (source) {
		pm_mgv_load(v, c / unit, r->mean, s, source);
		double norm = sqrt(product(v, source, source, NULL));
		memset(v->x, 0, v->level[0].size * sizeof(double));
		if (norm > 0)
			iterate(v, o, source, norm, r);
		pm_mgv_store(v, unit, v->x, phi);
	} else {
		memset(phi, 0, n * sizeof *phi);
	}
	const double shift = r->singular ? mean(v, phi) : 0;
	for (size_t p = 0; p < n && r->singular; p++)
		phi[p] -= shift;
	pm_free(source);
	return v->status ? v->status : r->converged ? 0 : pm_mg_not_converged(r, o, false);
}
