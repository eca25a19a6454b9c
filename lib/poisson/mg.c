/* Multigrid for lap phi = f: red-black Gauss-Seidel, full weighting, linear correction, V- and W-cycles, full multigrid with cubic interpolation.
 *   V(nu1, nu2): relax nu1 times; solve for the restricted residual on the coarser grid by the same cycle from zero; add; relax nu2 times
 * (Brandt 1977; Trottenberg, Oosterlee, Schueller 2001, sections 2.4 and 2.6). Vertex-centred, second order. The residual is looked at where it is
 * computed anyway, after the pre-smoothing of each cycle. It ends at the tolerance, or at round-off: the residual has stopped falling and is no
 * larger than what the rounding of its own terms makes. Singular problems (no wall): the mean of f is removed, the mean of phi is zero.
 * Cost: O(N) per cycle, 3-D V(2,2) about 6 passes over u and f. SPDX-License-Identifier: GPL-3.0-or-later */
#include "poisson/mg.h"
#include "poisson/mg-level.h"

#include <float.h>
#include <stdio.h>
#include <string.h>

int pm_mg_check(const struct pm_grid *g)
{
	for (int d = 0; d < g->dim; d++)
		for (int s = 0; s < 2; s++) {
			enum pm_face face = g->face[d][s];
			if (face != PM_PERIODIC && face != PM_WALL && face != PM_NEUMANN)
				return pm_fail(PM_DATA, "multigrid knows periodic, wall and neumann faces, and axis %c has %s ones (use poisson-fft, which has open faces)",
					"xyz"[d], pm_face_names[face]);
		}
	return 0;
}

struct pm_mg *pm_mg_new(const struct pm_grid *g)
{
	struct pm_mg *mg = pm_mg_check(g) ? NULL : pm_zalloc(1, sizeof *mg);
	if (mg && !mg_build(mg, g))
		mg = pm_mg_free(mg);
	return mg;
}

bool pm_mg_fits(const struct pm_mg *mg, const struct pm_grid *g)
{
	return mg->threads == pm_threads() && mg->grid.dim == g->dim && !memcmp(mg->grid.points, g->points, sizeof g->points) &&
		!memcmp(mg->grid.cells, g->cells, sizeof g->cells) && !memcmp(mg->grid.h, g->h, sizeof g->h) && !memcmp(mg->grid.face, g->face, sizeof g->face);
}

struct pm_mg *pm_mg_free(struct pm_mg *mg)
{
	if (mg)
		mg_demolish(mg);
	return pm_free(mg);
}

int pm_mg_levels(const struct pm_mg *mg) { return mg->levels; }

/* Sum over the planes of the finest grid of what `row` makes of each row; rows and planes are added in order. */
typedef double row_sum(const struct mg_level *l, size_t j, size_t k, const double *values);

static double sum_planes(struct pm_mg *mg, row_sum *row, const double *values)
{
	const struct mg_level *l = &mg->level[0];
	const struct mg_axis *x = &l->axis[0], *y = &l->axis[1], *z = &l->axis[2];
	struct pm_sum total = {0};
	#pragma omp parallel for num_threads(mg->threads) if (mg_size(l) > mg_parallel)
	for (size_t k = 0; k < z->points; k++) {
		struct pm_sum plane = {0};
		for (size_t j = 0; j < y->points; j++)
			pm_sum_add(&plane, row(l, j, k, values ? values + (k * y->points + j) * x->points : l->u + k * l->plane + j * l->stride));
		mg->sums[k] = pm_sum_total(plane);
	}
	for (size_t k = 0; k < z->points; k++)
		pm_sum_add(&total, mg->sums[k]);
	return pm_sum_total(total);
}

static double half(const struct mg_axis *a, size_t i) { return !a->periodic && (i == 0 || i + 1 == a->points) ? 0.5 : 1; }

static double row_mean(const struct mg_level *l, size_t j, size_t k, const double *v) /* with the weights of quadrature */
{
	const struct mg_axis *x = &l->axis[0];
	double sum = 0;
	for (size_t i = 0; i < x->points; i++)
		sum += half(x, i) * v[i];
	return sum * half(&l->axis[1], j) * half(&l->axis[2], k);
}

static double row_squares(const struct mg_level *l, size_t j, size_t k, const double *v)
{
	double sum = 0;
	(void)j, (void)k;
	for (size_t i = 0; i < l->axis[0].points; i++)
		sum += v[i] * v[i];
	return sum;
}

static double mean(struct pm_mg *mg, const double *values)
{
	double cells = 1;
	for (int d = 0; d < 3; d++)
		cells *= (double)mg->level[0].axis[d].cells;
	return sum_planes(mg, row_mean, values) / cells;
}

/* f = c (s - mean) on the unknowns, 0 elsewhere; u = 0. */
static void load(struct pm_mg *mg, double c, double average, const double *s, const double *u)
{
	const struct mg_level *l = &mg->level[0];
	const struct mg_axis *x = &l->axis[0], *y = &l->axis[1], *z = &l->axis[2];
	#pragma omp parallel for num_threads(mg->threads) if (mg_size(l) > mg_parallel)
	for (size_t k = 0; k < z->points; k++)
		for (size_t j = 0; j < y->points; j++) {
			bool inside = k >= z->first && k < z->end && j >= y->first && j < y->end;
			size_t from = (k * y->points + j) * x->points, to = k * l->plane + j * l->stride;
			for (size_t i = 0; i < x->points; i++) {
				bool unknown = inside && l->mask[2][i];
				l->f[to + i] = unknown ? c * (s[from + i] - average) : 0;
				l->u[to + i] = unknown && u ? u[from + i] : 0;
			}
		}
}

static void store(const struct pm_mg *mg, double factor, double average, double *phi)
{
	const struct mg_level *l = &mg->level[0];
	const struct mg_axis *x = &l->axis[0], *y = &l->axis[1];
	#pragma omp parallel for num_threads(mg->threads) if (mg_size(l) > mg_parallel)
	for (size_t k = 0; k < l->axis[2].points; k++)
		for (size_t j = 0; j < y->points; j++)
			for (size_t i = 0; i < x->points; i++)
				phi[(k * y->points + j) * x->points + i] = factor * (l->u[k * l->plane + j * l->stride + i] - average);
}

void pm_mg_start(struct pm_mg *mg, const double *f, const double *u) { load(mg, 1, 0, f, u); }

void pm_mg_once(struct pm_mg *mg, const struct pm_mg_choice *o)
{
	if (mg->levels == 1) {
		mg_solve_coarsest(mg);
		return;
	}
	mg_cycle_down(mg, 0, o, false);
	mg_cycle_up(mg, 0, o);
}

double pm_mg_residual(const struct pm_mg *mg)
{
	const struct mg_level *l = &mg->level[0];
	double sum = 0;
	for (size_t k = l->axis[2].first; k < l->axis[2].end; k++)
		for (size_t j = l->axis[1].first; j < l->axis[1].end; j++)
			sum += mg_residual_row(l, j, k, mg->scratch + mg_lanes);
	return sqrt(sum / fmax(1, (double)mg_unknowns(l)));
}

void pm_mg_values(const struct pm_mg *mg, double *u) { store(mg, 1, 0, u); }

/* Is a sum of squares of the residual what the rounding of its terms makes? Each of the 2 dim + 2 terms of f - lap u is rounded to half a unit. */
static bool at_roundoff(struct pm_mg *mg, double squares, double source)
{
	double terms = mg->level[0].diagonal * sqrt(sum_planes(mg, row_squares, NULL)) + source;
	return sqrt(squares) <= 2 * DBL_EPSILON * terms;
}

static int not_converged(const struct pm_mg_record *r, const struct pm_mg_choice *o)
{
	char text[400] = "";
	size_t used = 0;
	for (int i = r->n > 8 ? r->n - 8 : 0; i < r->n && used < sizeof text; i++)
		used += (size_t)snprintf(text + used, sizeof text - used, " %.2e", r->history[i]);
	return pm_fail(PM_NUMERICS, "multigrid did not converge: %d cycles left a relative residual of %.3e, tolerance %g; the last residuals:%s "
		"(allow more with --max-cycles, smooth more with --smooth 3,3, or use poisson-fft)", r->cycles, r->after, o->tolerance, text);
}

/* The cycles until the tolerance, round-off or the last one. */
static void iterate(struct pm_mg *mg, const struct pm_mg_choice *o, double source, struct pm_mg_record *r)
{
	int least = o->cycle == PM_MG_FMG; /* full multigrid includes a cycle on the finest grid */
	for (;; r->cycles++) {
		double squares = mg_cycle_down(mg, 0, o, false), now = sqrt(squares) / source;
		r->history[r->n++] = r->after = now;
		r->converged = now <= o->tolerance && r->cycles >= least;
		bool slow = r->n > 1 && !(now < 0.5 * r->history[r->n - 2]);
		if (!r->converged && slow && at_roundoff(mg, squares, source))
			r->converged = r->floor = true;
		if (r->converged || r->cycles == o->most || !(now < 1e3 * r->history[0]))
			break;
		mg_cycle_up(mg, 0, o);
	}
	r->before = r->history[0];
	int last = r->n - 1 - r->floor;
	if (last > 0)
		r->contraction = pow(r->history[last] / r->history[0], 1.0 / last);
}

int pm_mg_solve(struct pm_mg *mg, const struct pm_mg_choice *o, double c, const double *s, double *phi, struct pm_mg_record *r)
{
	struct mg_level *l = &mg->level[0];
	size_t n = l->axis[0].points * l->axis[1].points * l->axis[2].points;
	double most = 0;
	*r = (struct pm_mg_record){.singular = !l->fixed, .mean = l->fixed ? 0 : mean(mg, s)};
	for (size_t i = 0; i < n; i++)
		most = fmax(most, fabs(c * (s[i] - r->mean)));
	double unit = most > 0 && isfinite(most) ? ldexp(1, ilogb(most)) : 1; /* squares must neither vanish nor overflow; a power of 2 rounds nothing */
	load(mg, c / unit, r->mean, s, NULL);
	double squares = 0;
	for (size_t k = l->axis[2].first; k < l->axis[2].end; k++)
		for (size_t j = l->axis[1].first; j < l->axis[1].end; j++)
			squares += row_squares(l, j, k, l->f + k * l->plane + j * l->stride);
	r->converged = squares == 0 || mg->levels == 1;
	if (squares != 0 && mg->levels == 1)
		mg_solve_coarsest(mg);
	if (!r->converged) {
		if (o->cycle == PM_MG_FMG)
			mg_start_full(mg, o);
		iterate(mg, o, sqrt(squares), r);
	}
	store(mg, unit, l->fixed ? 0 : mean(mg, NULL), phi);
	return r->converged ? 0 : not_converged(r, o);
}
