/* Iterative refinement: multigrid cycles in single numbers for the residual in double ones.
 *   r = f - lap u;  lap e = r by cycles on the hierarchy of mg-single.h;  u += e
 * until r is at the tolerance (Moler, J. ACM 14 (1967) 316). Vectors have twice the lanes and half the bytes. A round of cycles ends where single numbers
 * round: at 1e-5 of its residual or the rounding of the terms of lap e, which is eps/h^2 |e|. Lengths are in units of the smallest spacing and r is scaled
 * by a power of 2, so that single numbers neither overflow nor vanish. If a round does not halve the residual (at its floor, or on meshes so fine that
 * single numbers cannot resolve the differences), the solution goes on in double numbers.
 * SPDX-License-Identifier: GPL-3.0-or-later */
#include "fft/fft-block.h"
#include "poisson-mg/mg-ranks.h"
#include "poisson-mg/mg-single.h"
#include "world/world.h"

#include <string.h>

bool pm_mg_refines(struct pm_mg *mg, const struct pm_mg_choice *o)
{
	const bool colours = o->smoother == PM_MG_RED_BLACK || o->smoother == PM_MG_SOR;
	if (mg->order != 2 || o->cycle != PM_MG_FMG || o->half_weighting || !colours || mg->levels == 1 || pm_grid_size(&mg->grid) <= mg_parallel)
		return false;
	if (!mg->single) {
		struct pm_grid g = mg->grid;
		double least = INFINITY;
		for (int d = 0; d < g.dim; d++)
			least = fmin(least, g.h[d]);
		for (int d = 0; d < g.dim; d++)
			g.h[d] /= least;
		mg->single = pm_mg_single_new(&g, mg->level[0].from);
	}
	const int status = mg->status ? mg->status : mg->single ? 0 : pm_failed();
	mg->status = mg->level[0].from ? pm_world_agree(status) : status; /* every time: one rank may have its hierarchy from before, another not */
	return !mg->status;
}

/* The smallest spacing squared, by which lap of the single hierarchy is larger. */
static double unit_of(const struct pm_mg *mg)
{
	double least = INFINITY;
	for (int d = 0; d < mg->grid.dim; d++)
		least = fmin(least, mg->grid.h[d]);
	return least * least;
}

/* A power of 2 that makes a residual, root of the sum of squares, one of about 1 a node. */
static double scale_of(const struct pm_mg *mg, double residual)
{
	const double each = residual / sqrt(fmax(1, (double)pm_mg_unknowns(&mg->level[0])));
	return each > 0 && isfinite(each) ? ldexp(1, -ilogb(each)) : 1;
}

/* u += factor e in a plane that is k of e, kept closed; first: u was anything. */
static void add_plane(const struct pm_mg *mg, bool first, double factor, size_t k, double *plane)
{
	const struct mg_level *l = &mg->level[0];
	const struct mg_axis *x = &l->axis[0], *y = &l->axis[1];
	for (size_t j = y->first; j < y->end; j++) {
		double *u = plane + j * l->stride;
		const float *e[2];
		pm_mg_single_solution(mg->single, j, k, e);
		for (size_t odd = 0; odd < 2; odd++) {
			double *to = u + odd * l->half;
			const size_t n = (x->points + 1 - odd) / 2;
			if (first)
				for (size_t i = 0; i < n; i++)
					to[i] = 0 + factor * (double)e[odd][i]; /* no zero with a sign */
			else
				for (size_t i = 0; i < n; i++)
					to[i] += factor * (double)e[odd][i];
		}
		mg_close_row(l, u);
	}
}

void pm_mg_refine_source(struct pm_mg *mg, double scale, size_t j, size_t k, const double *r)
{
	const struct mg_level *l = &mg->level[0];
	float *f[2];
	pm_mg_single_source(mg->single, j, k, f);
	for (size_t odd = 0; odd < 2; odd++)
		for (size_t i = 0, n = (l->axis[0].points + 1 - odd) / 2; i < n; i++)
			f[odd][i] = (float)(scale * r[odd * l->half + i]);
}

/* The residual of plane k, times scale, is the right-hand side of the single hierarchy; its sum of squares. */
static double residual_plane(struct pm_mg *mg, double scale, size_t k, double *room)
{
	const struct mg_level *l = &mg->level[0];
	struct pm_sum sum = {0, 0};
	for (size_t j = l->axis[1].first; j < l->axis[1].end; j++) {
		pm_sum_add(&sum, pm_mg_residual_row(l, j, k, room));
		pm_mg_refine_source(mg, scale, j, k, room);
	}
	return pm_sum_total(sum);
}

/* Adds the correction and finds the residual, root of the sum of squares. A plane has its residual as soon as the one behind it is corrected, while it is in
 * the cache; the first and the last plane of a thread wait for other threads and ranks. */
static double correct(struct pm_mg *mg, bool first, double factor, double scale)
{
	struct mg_level *l = &mg->level[0];
	const struct mg_axis *z = &l->axis[2];
	const size_t parts = (size_t)mg->threads;
	size_t range[2];
	mg_range(l, range);
	const size_t n = range[1] - range[0];
	#pragma omp parallel for num_threads(mg->threads) schedule(static, 1) if (parts > 1)
	for (size_t p = 0; p < parts; p++) {
		const size_t from = range[0] + n * p / parts, to = range[0] + n * (p + 1) / parts;
		for (size_t k = from; k < to; k++) {
			add_plane(mg, first, factor, k, l->u + mg_plane(l, k));
			if (k > from + 1)
				mg->sums[k - 1] = residual_plane(mg, scale, k - 1, mg->scratch + p * mg->room);
		}
	}
	pm_mg_beside(mg, l, l->u, 1);
	#pragma omp parallel for num_threads(mg->threads) schedule(static, 1) if (parts > 1)
	for (size_t p = 0; p < parts; p++) {
		const size_t from = range[0] + n * p / parts, to = range[0] + n * (p + 1) / parts;
		for (size_t k = from; k < to; k++)
			if (k == from || k + 1 == to)
				mg->sums[k] = residual_plane(mg, scale, k, mg->scratch + p * mg->room);
	}
	return sqrt(pm_mg_total(mg, z->first, z->end));
}

/* May one round do, and do threads have planes enough for store_once? */
bool pm_mg_refines_once(const struct pm_mg *mg, const struct pm_mg_choice *o)
{
	const struct mg_level *l = &mg->level[0];
	return o->tolerance >= 1e-5 && l->fixed && !l->from && l->axis[2].end - l->axis[2].first >= 3 * (size_t)mg->threads;
}

/* Plane k, folded at the faces, of factor e: on a wall 0, which nobody changes, otherwise in one of the three places at ring. */
static double *plane_once(struct pm_mg *mg, double factor, ptrdiff_t k, double *ring)
{
	const struct mg_level *l = &mg->level[0];
	const struct mg_axis *z = &l->axis[2];
	const size_t at = mg_fold(k, z);
	double *plane = ring + (size_t)(k + 3) % 3 * l->plane;
	if (at < z->first || at >= z->end)
		return l->u + mg_plane(l, at);
	add_plane(mg, true, factor, at, plane);
	return plane;
}

/* Planes from <= k < to of what correct and pm_mg_store do, plane by plane in the cache; neither u nor f is written, but for three planes of u. */
static void store_once(struct pm_mg *mg, const struct mg_once *once, double factor, size_t from, size_t to, double *room)
{
	const struct mg_level *l = &mg->level[0];
	const struct mg_axis *x = &l->axis[0], *y = &l->axis[1];
	double *ring = l->u + mg_plane(l, from), *f = room, *residual = f + l->stride, *row = residual + l->stride, largest = 0;
	const double *below = plane_once(mg, factor, (ptrdiff_t)from - 1, ring);
	double *here = plane_once(mg, factor, (ptrdiff_t)from, ring);
	for (size_t k = from; k < to; k++) {
		double *above = plane_once(mg, factor, (ptrdiff_t)k + 1, ring);
		struct pm_sum sum = {0, 0};
		for (size_t j = 0; j < y->points; j++) {
			const size_t at = j * l->stride, node = (k * y->points + j) * x->points;
			if (j >= y->first && j < y->end) {
				pm_mg_load_row(l, once->c / once->unit, 0, once->s + node, f, &largest);
				pm_sum_add(&sum, pm_mg_residual_of(l, (struct mg_rows){.u = here + at, .f = f, .south = here + mg_below(y, j) * l->stride,
					.north = here + mg_above(y, j) * l->stride, .back = below + at, .front = above + at}, residual));
			}
			pm_mg_store_row(l, once->unit, 0, here + at, row);
			pm_stream(once->phi + node, row, x->points);
		}
		mg->sums[k] = pm_sum_total(sum);
		below = here, here = above;
	}
}

/* The residual, root of the sum of squares, and phi if it is at the tolerance, with the bytes of correct and pm_mg_store; otherwise f and what correct does. */
static double finish_once(struct pm_mg *mg, const struct pm_mg_choice *o, struct mg_once *once, double source, double factor, double scale)
{
	const struct mg_level *l = &mg->level[0];
	const struct mg_axis *z = &l->axis[2];
	const size_t parts = (size_t)mg->threads, n = z->end - z->first, plane = l->axis[0].points * l->axis[1].points;
	#pragma omp parallel for num_threads(mg->threads) schedule(static, 1) if (parts > 1)
	for (size_t p = 0; p < parts; p++)
		store_once(mg, once, factor, z->first + n * p / parts, z->first + n * (p + 1) / parts, mg->scratch + p * mg->room);
	for (size_t k = 0; k < z->points; k++)
		if (k < z->first || k >= z->end)
			memset(once->phi + k * plane, 0, plane * sizeof *once->phi);
	double residual = sqrt(pm_mg_total(mg, z->first, z->end)), largest;
	once->stored = residual / source <= o->tolerance;
	if (once->stored)
		return residual;
	pm_mg_load(mg, once->c / once->unit, 0, once->s, MG_LOAD_OWN, &largest);
	return correct(mg, true, factor, scale);
}

static void record(struct pm_mg_record *r, double now)
{
	r->history[r->cycles] = r->after = now;
	r->n = r->cycles + 1;
}

/* Cycles until single numbers have given what they can; at: the residual of the round's beginning; factor: from the residual of the single hierarchy to ours,
 * relative to the source. */
static void round_of_cycles(struct pm_mg *mg, const struct pm_mg_choice *o, bool full, double at, double factor, struct pm_mg_record *r)
{
	double limit = 1e-5 * at, before = INFINITY;
	for (int i = 0;; i++) {
		const double now = factor * pm_mg_single_down(mg->single, o, !full && !i); /* smoothed once more than u will be */
		const double next = i ? now * now / before : now;
		record(r, now);
		if ((now <= o->tolerance && r->cycles) || r->cycles == o->most || pm_mg_single_status(mg->single))
			return;
		pm_mg_single_up(mg->single, o);
		r->cycles++;
		if (next * (i ? 4 : 1) <= o->tolerance) /* the residual in double numbers tells */
			return;
		if (!i) /* by now |e| has about its final size */
			limit = fmax(limit, factor * pm_mg_single_noise(mg->single));
		if (now < 10 * limit || !(now < 0.5 * before)) /* the next cycle would end at the limit */
			return;
		before = now;
	}
}

bool pm_mg_refine(struct pm_mg *mg, const struct pm_mg_choice *o, double source, struct mg_once *once, struct pm_mg_record *r)
{
	double before = 1, scale = 1;
	for (bool full = true;; full = false) {
		const int first = r->cycles;
		pm_mg_single_start(mg->single, o, full, mg->status);
		round_of_cycles(mg, o, full, before, 1 / (scale * source), r);
		mg->status = pm_mg_single_status(mg->single);
		const double factor = unit_of(mg) / scale;
		scale = scale_of(mg, r->after * source);
		const double now = (once && full ? finish_once(mg, o, once, source, factor, scale) : correct(mg, full, factor, scale)) / source;
		record(r, now);
		for (int i = first; i < r->cycles; i++) /* what single numbers saw beyond the rounding of double ones was not there */
			r->history[i] = fmax(r->history[i], now);
		const bool slow = !(now < 0.5 * before);
		r->converged = now == 0 || (now <= o->tolerance && r->cycles >= 1);
		if (!mg->status && !r->converged && r->cycles < o->most && slow) {
			r->n = r->cycles; /* the next residual is of the same cycle */
			return false;
		}
		if (mg->status || r->converged || r->cycles == o->most)
			break;
		before = now;
	}
	r->before = r->history[0];
	const int last = r->n - 1 - r->floor;
	if (last > 0)
		r->contraction = pow(r->history[last] / r->history[0], 1.0 / last);
	return true;
}
