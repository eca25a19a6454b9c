/* Multigrid for lap phi = f: red-black Gauss-Seidel, full weighting, linear correction, V- and W-cycles, full multigrid with cubic interpolation.
 *   V(nu1, nu2): relax nu1 times; solve for the restricted residual on the coarser grid by the same cycle from zero; add; relax nu2 times
 * (Brandt 1977; Trottenberg, Oosterlee, Schueller 2001, sections 2.4 and 2.6). Vertex-centred, second order. The residual is tested where it is computed
 * anyway, after the pre-smoothing of each cycle. It ends at the tolerance, or at round-off: the residual has stopped falling and is no larger than the
 * rounding errors of its own terms. Singular problems (no wall): the mean of f is removed, the mean of phi is zero.
 * Cost: O(N) per cycle, 3-D V(2,2) about 6 passes over u and f. SPDX-License-Identifier: GPL-3.0-or-later */
#include "poisson-mg/mg.h"
#include "poisson-mg/mg-ranks.h"
#include "poisson-mg/mg-single.h"
#include "world/world.h"

#include <float.h>
#include <stdio.h>
#include <string.h>

const char *const pm_mg_smoother_names[] = {"red-black", "sor", "jacobi", "four-colour", NULL};

double pm_mg_relaxation(enum pm_mg_smoother smoother, int dim, int order)
{
	if (smoother == PM_MG_JACOBI && dim > 1 && order == 4)
		return dim == 2 ? 2. / 3 : 4. / 7; /* the diagonal is 5/6 and 2/3 of that of order 2, and the largest eigenvalue on stretched cells the same */
	if (smoother == PM_MG_JACOBI)
		return dim == 1 ? 2. / 3 : dim == 2 ? 4. / 5 : 6. / 7; /* Trottenberg, Oosterlee, Schueller 2001, sections 1.4.2, 2.1.2 and 2.9.1 */
	return smoother == PM_MG_SOR ? 1.15 : 1;
}

int pm_mg_check(const struct pm_grid *g)
{
	for (int d = 0; d < g->dim; d++)
		for (int s = 0; s < 2; s++) {
			enum pm_face face = g->face[d][s];
			if (face != PM_PERIODIC && face != PM_WALL && face != PM_NEUMANN)
				return pm_fail(PM_DATA, "multigrid handles periodic, wall and neumann faces, but axis %c has %s ones (use poisson-fft)",
					"xyz"[d], pm_face_names[face]);
		}
	return 0;
}

struct pm_mg *pm_mg_new_planes(const struct pm_grid *g, int order, const struct pm_planes *planes)
{
	struct pm_mg *mg = pm_mg_check(g) ? NULL : pm_zalloc(1, sizeof *mg);
	if (mg && !pm_mg_build(mg, g, order, planes))
		mg = pm_mg_free(mg);
	return mg;
}

struct pm_mg *pm_mg_new(const struct pm_grid *g, int order) { return pm_mg_new_planes(g, order, NULL); }

bool pm_mg_same_planes(const struct pm_mg *mg, const struct pm_planes *planes)
{
	const uint64_t *from = planes && planes->divided ? planes->from : NULL, *has = mg->level[0].from;
	return from && has ? !memcmp(from, has, ((size_t)pm_world_size() + 1) * sizeof *from) : !from && !has;
}

bool pm_mg_fits(const struct pm_mg *mg, const struct pm_grid *g, int order)
{
	return mg->order == order && mg->threads == pm_threads() && mg->grid.dim == g->dim && !memcmp(mg->grid.points, g->points, sizeof g->points) &&
		!memcmp(mg->grid.cells, g->cells, sizeof g->cells) && !memcmp(mg->grid.h, g->h, sizeof g->h) && !memcmp(mg->grid.face, g->face, sizeof g->face);
}

struct pm_mg *pm_mg_free(struct pm_mg *mg)
{
	if (mg)
		pm_mg_single_free(mg->single), pm_mg_demolish(mg);
	return pm_free(mg);
}

int pm_mg_levels(const struct pm_mg *mg) { return mg->levels; }

/* u on the unknowns. */
static void load_start(struct pm_mg *mg, const double *u)
{
	struct mg_level *l = &mg->level[0];
	const struct mg_axis *x = &l->axis[0], *y = &l->axis[1], *z = &l->axis[2];
	for (size_t k = z->first; k < z->end; k++)
		for (size_t j = y->first; j < y->end; j++) {
			double *row = l->u + mg_plane(l, k) + j * l->stride;
			for (size_t i = x->first; i < x->end; i++)
				row[mg_slot(l, i)] = u[(k * y->points + j) * x->points + i];
			mg_close_row(l, row);
		}
}

void pm_mg_start(struct pm_mg *mg, const double *f, const double *u)
{
	double largest;
	pm_mg_load(mg, 1, 0, f, MG_LOAD_OWN, &largest);
	pm_mg_clear(mg);
	if (u)
		load_start(mg, u);
}

void pm_mg_once(struct pm_mg *mg, const struct pm_mg_choice *o)
{
	if (mg->levels == 1) {
		pm_mg_solve_coarsest(mg);
		return;
	}
	if (pm_mg_room(mg, o)) {
		pm_mg_cycle_down(mg, 0, o, false);
		pm_mg_cycle_up(mg, 0, o);
	}
}

double pm_mg_residual(const struct pm_mg *mg)
{
	const struct mg_level *l = &mg->level[0];
	const struct mg_axis *y = &l->axis[1], *z = &l->axis[2];
	for (size_t k = z->first; k < z->end; k++) {
		struct pm_sum plane = {0, 0};
		for (size_t j = y->first; j < y->end; j++)
			pm_sum_add(&plane, pm_mg_residual_row(l, j, k, mg->scratch + mg_lanes));
		mg->sums[k] = pm_sum_total(plane);
	}
	return sqrt(pm_mg_planes(z->end - z->first, mg->sums + z->first) / fmax(1, (double)pm_mg_unknowns(l)));
}

void pm_mg_values(const struct pm_mg *mg, double *u) { pm_mg_store(mg, 1, 0, u); }

/* Is the residual (root of the sum of squares, as the source) at the level of rounding errors of its terms? Each of the 2 dim + 2 terms of f - lap u is
 * rounded to half a unit. */
bool pm_mg_at_roundoff(struct pm_mg *mg, double residual, double source)
{
	double terms = mg->level[0].diagonal * sqrt(pm_mg_squares(mg, mg->level[0].u)) + source;
	return residual <= 2 * DBL_EPSILON * terms;
}

int pm_mg_not_converged(const struct pm_mg_record *r, const struct pm_mg_choice *o, bool transforms)
{
	char text[640] = "";
	size_t used = 0;
	int from = r->n > 60 ? r->n - 60 : 0;
	for (int i = from; i < r->n && used < sizeof text; i++)
		used += (size_t)snprintf(text + used, sizeof text - used, " %.2e", r->history[i]);
	return pm_fail(PM_NUMERICS, "multigrid did not converge: %d cycles left a relative residual of %.3e, tolerance %g; the %sresiduals:%s "
		"(allow more with --max-cycles%s smooth more with --smooth 3,3%s)", r->cycles, r->after, o->tolerance, from ? "last 60 " : "", text,
		transforms ? "," : " or",
		transforms ? ", or use poisson-fft" : "");
}

/* The cycles until the tolerance, round-off or the last one. */
static void iterate(struct pm_mg *mg, const struct pm_mg_choice *o, double source, struct pm_mg_record *r)
{
	int least = o->cycle == PM_MG_FMG; /* full multigrid includes a cycle on the finest grid */
	for (;; r->cycles++) {
		double residual = sqrt(pm_mg_cycle_down(mg, 0, o, false)), now = residual / source;
		r->history[r->n++] = r->after = now;
		r->converged = now == 0 || (now <= o->tolerance && r->cycles >= least);
		bool slow = r->n > 1 && !(now < 0.5 * r->history[r->n - 2]);
		if (!r->converged && slow && pm_mg_at_roundoff(mg, residual, source))
			r->converged = r->floor = true;
		if (mg->status || r->converged || r->cycles == o->most || !(now < 1e3 * r->history[0]))
			break;
		pm_mg_cycle_up(mg, 0, o);
	}
	r->before = r->history[0];
	int last = r->n - 1 - r->floor;
	if (last > 0)
		r->contraction = pow(r->history[last] / r->history[0], 1.0 / last);
}

/* f = c/unit (s - average), the root of its sum of squares. Squares must neither vanish nor overflow, of single numbers either; the unit is a power of 2, which
 * rounds nothing, and 1 where values are near it, so that s need not be read before. */
static double load(struct pm_mg *mg, double c, double average, const double *s, int to, double *unit)
{
	double most, squares = pm_mg_load(mg, c, average, s, to, &most);
	most = pm_mg_most(mg, most);
	*unit = 1;
	if (most == 0 || !isfinite(most) || (most > 0x1p-30 && most < 0x1p30))
		return sqrt(squares);
	*unit = ldexp(1, ilogb(most));
	return sqrt(pm_mg_load(mg, c / *unit, average, s, to, &most));
}

int pm_mg_solve_differences(struct pm_mg *mg, const struct pm_mg_choice *o, double c, const double *s, const double *point, double *phi,
	struct pm_mg_record *r)
{
	struct mg_level *l = &mg->level[0];
	mg->status = pm_mg_room(mg, o) ? 0 : pm_failed();
	if (l->from)
		mg->status = pm_world_agree(mg->status);
	if (mg->status)
		return mg->status;
	const size_t here = l->here * l->axis[0].points * l->axis[1].points;
	*r = (struct pm_mg_record){.singular = !l->fixed, .mean = l->fixed ? 0 : pm_mg_mean(mg, s)};
	double whole = l->fixed ? 0 : pm_mg_most(mg, pm_mg_largest(here, 1, 0, s));
	r->incompatible = whole > 0 ? fabs(r->mean) / whole : 0;
	const bool refines = pm_mg_refines(mg, o);
	struct mg_once once = {.c = c, .s = s, .phi = phi};
	const bool hopes = refines && s != phi && pm_mg_refines_once(mg, o);
	double unit, source = load(mg, c, r->mean, s, hopes ? MG_LOAD_SINGLE : refines ? MG_LOAD_OWN | MG_LOAD_SINGLE : MG_LOAD_OWN, &unit);
	once.unit = unit;
	r->converged = source == 0 || mg->levels == 1;
	if (!refines || source == 0)
		pm_mg_clear(mg);
	if (source != 0 && mg->levels == 1)
		pm_mg_solve_coarsest(mg);
	if (!r->converged && !(refines && pm_mg_refine(mg, o, source, hopes ? &once : NULL, r))) {
		if (!refines && o->cycle == PM_MG_FMG && (!point || (!pm_mg_pyramid(mg, c / unit, point) && !l->from)))
			pm_mg_start_sources(mg);
		if (!refines && o->cycle == PM_MG_FMG)
			pm_mg_start_full(mg, o);
		iterate(mg, o, source, r);
	}
	if (!once.stored)
		pm_mg_store(mg, unit, 0, phi);
	if (r->singular)
		pm_mg_store(mg, unit, pm_mg_mean(mg, phi), phi);
	if (mg->status)
		return mg->status;
	return r->converged ? 0 : pm_mg_not_converged(r, o, true);
}

int pm_mg_solve(struct pm_mg *mg, const struct pm_mg_choice *o, double c, const double *s, double *phi, struct pm_mg_record *r)
{
	const struct mg_level *l = &mg->level[0];
	const size_t plane = l->axis[0].points * l->axis[1].points, here = l->here * plane, own = l->from ? mg_beyond * plane : 0;
	double *compact = mg->order == 4 ? pm_alloc(here + 1, sizeof *compact) : NULL, *with = compact && own ? pm_alloc(here + 2 * own, sizeof *with) : NULL;
	int status = mg->order == 4 && (!compact || (own && !with)) ? -PM_DATA : 0;
	mg->status = l->from ? pm_world_agree(status) : status;
	if (with && !mg->status)
		memcpy(with + own, s, here * sizeof *with);
	if (mg->order == 4)
		pm_mg_beside_own(mg, l, with ? with + own : NULL, plane * sizeof *with, 2);
	status = mg->status;
	if (compact && !status)
		pm_mg_compact_source(&mg->grid, l, with ? with + own : s, compact);
	pm_free(with);
	for (size_t i = 0; compact && o->known && i < here; i++)
		compact[i] -= o->known[i] / c;
	if (!status)
		status = pm_mg_solve_differences(mg, o, c, compact ? compact : s, compact && !o->known ? s : NULL, phi, r);
	pm_free(compact);
	return status;
}
