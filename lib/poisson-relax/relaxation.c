/* Solves lap phi = c*s by sweeps of a method of lib/relax, from zero to a tolerance of the residual.
 * A sweep returns the residual before its updates; when that is near the tolerance, and from time to time, the true residual is computed, which decides. It
 * ends at the tolerance, or at round-off: the residual is no larger than the rounding errors of its own terms. Where no face fixes phi the mean of s is
 * removed, and that of phi is zero; open faces get their values from lib/james/james.c. Source of the methods: their files. Cost: N per sweep.
 * SPDX-License-Identifier: GPL-3.0-or-later */
#include "poisson-relax/relaxation.h"
#include "james/james.h"
#include "world/world.h"

#include <float.h>
#include <stdio.h>
#include <string.h>

struct pm_relaxation {
	struct pm_grid grid;
	const struct pm_relax *method;
	struct pm_laplacian lap;
	struct pm_relax_work work;
	double *f, *r; /* right-hand side; the residual */
	struct pm_laplacian_ranks ranks; /* planes.divided: lap has those of this rank */
	struct pm_james *james; /* open faces; lap is then that between walls */
};

static double factor_of(const struct pm_laplacian *l, const struct pm_relax *method, double factor)
{
	return !method->factor ? NAN : isnan(factor) ? method->factor(l) : factor;
}

int pm_relaxation_check(const struct pm_grid *given, const struct pm_relax *method, double factor)
{
	const struct pm_grid walled = pm_james_walled(given), *g = pm_james_wanted(given) ? &walled : given;
	int status = g == given ? 0 : pm_james_check(given);
	for (int d = 0; d < g->dim && !status; d++)
		if (g->face[d][0] == PM_ABSORBING || g->face[d][1] == PM_ABSORBING)
			status = pm_fail(PM_DATA, "axis %c has absorbing faces, which belong to Maxwell's equations (poisson-relax and poisson-fft take "
				"periodic, wall, neumann and open ones)",
				"xyz"[d]);
	if (status)
		return status;
	struct pm_laplacian l = pm_laplacian_of(g);
	double used = factor_of(&l, method, factor), radius = method->radius(&l, used);
	if (l.diagonal > 0 && radius >= 1 && l.singular && used <= 1)
		return pm_fail(PM_DATA, "%s does not converge where no face fixes phi: the wave that alternates from node to node stays (use weighted-jacobi, "
			"red-black or "
			"cg, or poisson-fft --symbol fd2)", method->name);
	if (l.diagonal > 0 && radius >= 1)
		return pm_fail(PM_USAGE, "%s with --relaxation %g makes the error grow %.3f times a sweep (take 1 or less, or leave the option out)",
			method->name, used, radius);
	return 0;
}

/* A mesh, with a plane more on either side where planes are divided. */
static double *mesh_new(const struct pm_relaxation *p)
{
	const size_t room = p->lap.ranks ? p->ranks.planes.size : 0;
	double *a = pm_zalloc(p->lap.size + 2 * room + 1, sizeof *a);
	return a ? a + room : NULL;
}

static void mesh_free(const struct pm_relaxation *p, double *a) { pm_free(a ? a - (p->lap.ranks ? p->ranks.planes.size : 0) : NULL); }

struct pm_relaxation *pm_relaxation_new(const struct pm_grid *g, const struct pm_relax *method) { return pm_relaxation_new_of(g, method, NULL); }

static int allocate(struct pm_relaxation *p, const struct pm_grid *g, const struct pm_relax *method, const struct pm_field *field)
{
	const struct pm_grid walled = pm_james_walled(g);
	p->grid = *g;
	p->method = method;
	p->lap = pm_laplacian_of(pm_james_wanted(g) ? &walled : g);
	if (field && field->here && pm_planes_init(&p->ranks.planes, g, field))
		return pm_failed();
	if (field && field->here)
		pm_laplacian_share(&p->lap, &p->ranks);
	p->work.lap = &p->lap;
	p->work.f = p->f = mesh_new(p);
	p->r = mesh_new(p);
	p->work.u = mesh_new(p);
	p->work.sums = pm_zalloc(p->lap.rows + 1, sizeof(double));
	bool good = p->f && p->r && p->work.u && p->work.sums;
	for (int i = 0; i < method->extra; i++)
		good = (p->work.extra[i] = mesh_new(p)) && good;
	return good ? 0 : pm_failed();
}

struct pm_relaxation *pm_relaxation_new_of(const struct pm_grid *g, const struct pm_relax *method, const struct pm_field *field)
{
	struct pm_relaxation *p = pm_zalloc(1, sizeof *p);
	int status = p ? allocate(p, g, method, field) : pm_failed();
	if (pm_james_wanted(g) && field && field->here)
		status = pm_world_agree(status);
	if (!status && pm_james_wanted(g) && !(p->james = pm_james_new(g, &p->ranks.planes)))
		status = pm_failed();
	return status ? pm_relaxation_free(p) : p;
}

struct pm_relaxation *pm_relaxation_free(struct pm_relaxation *p)
{
	if (!p)
		return NULL;
	mesh_free(p, p->f), mesh_free(p, p->r), mesh_free(p, p->work.u), pm_free(p->work.sums);
	for (int i = 0; i < PM_RELAX_EXTRA; i++)
		mesh_free(p, p->work.extra[i]);
	pm_planes_free(&p->ranks.planes);
	pm_james_free(p->james);
	return pm_free(p);
}

bool pm_relaxation_fits(const struct pm_relaxation *p, const struct pm_grid *g, const struct pm_relax *method)
{
	return p->method == method && p->grid.dim == g->dim && !memcmp(p->grid.points, g->points, sizeof g->points) &&
		!memcmp(p->grid.cells, g->cells, sizeof g->cells) && !memcmp(p->grid.h, g->h, sizeof g->h) && !memcmp(p->grid.face, g->face, sizeof g->face);
}

bool pm_relaxation_same_planes(const struct pm_relaxation *p, const struct pm_field *field)
{
	const uint64_t *from = p->ranks.planes.from;
	bool same = (field && field->here) == (from != NULL);
	for (int r = 0; r <= pm_world_size() && from && same; r++)
		same = from[r] * p->ranks.planes.size == field->from[r];
	return same;
}

bool pm_relaxation_shares(const struct pm_grid *g, const struct pm_relax *method) { return method->in_planes && g->dim > 1; }

bool pm_relaxation_open(const struct pm_grid *g) { return pm_james_wanted(g); }
struct pm_relax_work *pm_relaxation_work(struct pm_relaxation *p) { return &p->work; }

/* to = factor (from - average) on the unknowns, 0 elsewhere; from NULL: 0. */
static void load(const struct pm_laplacian *l, double factor, double average, const double *from, double *to)
{
	const struct pm_laplacian_axis *x = &l->axis[0];
	size_t ny = l->axis[1].points;
	for (size_t q = 0; q < l->rows; q++)
		for (size_t i = 0; i < x->points; i++) {
			bool unknown = from && i >= x->first && i < x->end && pm_laplacian_inside(l, (l->first + q) % ny, (l->first + q) / ny);
			to[q * x->points + i] = unknown ? factor * (from[q * x->points + i] - average) : 0;
		}
}

void pm_relaxation_start(struct pm_relaxation *p, double factor, const double *f, const double *u)
{
	load(&p->lap, 1, 0, f, p->f);
	load(&p->lap, 1, 0, u, p->work.u);
	p->work.factor = factor;
	p->work.fresh = true;
}

static double norm(struct pm_relaxation *p, const double *a) { return sqrt(pm_laplacian_product(&p->lap, a, a, p->work.sums)); }

/* Is the residual what the rounding of its terms makes? Each of the 2 dim + 2 terms of lap u - f is rounded to half a unit. */
static bool at_roundoff(struct pm_relaxation *p, double residual, double source)
{
	return residual <= 2 * DBL_EPSILON * (p->lap.diagonal * norm(p, p->work.u) + source);
}

static int not_converged(const struct pm_relax *method, const struct pm_relaxation_record *r, const struct pm_relaxation_choice *o)
{
	char text[500] = "";
	size_t used = 0;
	for (int i = 0; i < r->n && used < sizeof text; i++)
		used += (size_t)snprintf(text + used, sizeof text - used, " %lld: %.2e", (long long)r->sweep[i], r->history[i]);
	return pm_fail(PM_NUMERICS, "%s did not converge: %lld sweeps left a relative residual of %.3e, tolerance %g; residual by sweep:%s "
		"(allow more with --max-sweeps, or use --method cg, poisson-mg or poisson-fft --symbol fd2)", method->name, (long long)r->sweeps, r->after,
		o->tolerance, text);
}

/* The true residual decides; what a method remembers is given up where it says otherwise. */
static void look(struct pm_relaxation *p, const struct pm_relaxation_choice *o, double source, struct pm_relaxation_record *r)
{
	double residual = sqrt(pm_laplacian_residual(&p->lap, p->work.u, p->f, p->r, p->work.sums));
	r->after = residual / source;
	r->converged = r->after <= o->tolerance;
	if (!r->converged && at_roundoff(p, residual, source))
		r->converged = r->floor = true;
}

/* What a sweep met may be far from what it left (over-relaxation), but the ratio of the two is steady: `left` is that of the last look. */
static void iterate(struct pm_relaxation *p, const struct pm_relaxation_choice *o, double source, struct pm_relaxation_record *r)
{
	double met = 1, left = 1;
	while (o->exactly && r->sweeps < o->most && !p->ranks.status)
		p->method->sweep(&p->work), r->sweeps++;
	if (o->exactly) {
		look(p, o, source, r);
		r->converged = true;
		return;
	}
	while (!r->converged && r->sweeps < o->most && met < 1e30 && !p->ranks.status) {
		met = sqrt(p->method->sweep(&p->work)) / source;
		r->sweeps++;
		bool mark = (r->sweeps & (r->sweeps - 1)) == 0 && r->n < PM_RELAXATION_MARKS;
		bool near = met * left <= fmax(2 * o->tolerance, DBL_EPSILON);
		if (near || mark || r->sweeps % 64 == 0) {
			look(p, o, source, r);
			left = fmax(r->after / met, DBL_EPSILON);
		}
		if (mark) {
			r->sweep[r->n] = r->sweeps;
			r->history[r->n++] = r->after;
		}
		p->work.fresh = near && !r->converged && p->method->bound; /* the recursion of conjugate gradients has left the residual */
	}
	look(p, o, source, r);
	int from = r->n > 1 && r->sweep[r->n - 1] > r->sweeps / 2 ? r->n - 2 : r->n - 1;
	if (r->sweeps >= 4 && r->history[from] > 0 && r->after > 0)
		r->radius = pow(r->after / r->history[from], 1 / (double)(r->sweeps - r->sweep[from]));
}

static double largest(size_t n, const double *s)
{
	double most = 0;
	for (size_t i = 0; i < n; i++)
		most = fmax(most, fabs(s[i]));
	return most;
}

/* The power of two at the largest |c (s - average)|: squares must neither vanish nor overflow, and it rounds nothing. */
static double unit_of(const struct pm_laplacian *l, double c, double average, const double *s)
{
	double most = 0;
	for (size_t i = 0; i < l->size; i++)
		most = fmax(most, fabs(c * (s[i] - average)));
	most = pm_laplacian_most(l, most);
	return most > 0 && isfinite(most) ? ldexp(1, ilogb(most)) : 1;
}

/* Between the faces of lap. */
static int solve(struct pm_relaxation *p, const struct pm_relaxation_choice *o, double c, const double *s, double *phi, struct pm_relaxation_record *r)
{
	const struct pm_laplacian *l = &p->lap;
	*r = (struct pm_relaxation_record){.singular = l->singular, .factor = factor_of(l, p->method, o->factor), .radius = NAN};
	p->ranks.status = 0;
	r->mean = l->singular ? pm_laplacian_mean(l, s, p->work.sums) : 0;
	r->incompatible = r->mean != 0 ? fabs(r->mean) / pm_laplacian_most(l, largest(l->size, s)) : 0;
	r->expected = l->diagonal > 0 ? p->method->radius(l, r->factor) : NAN;
	double unit = unit_of(l, c, r->mean, s);
	if (o->start)
		unit = fmax(unit, unit_of(l, 1, 0, o->start));
	load(l, c / unit, r->mean, s, p->f);
	load(l, 1 / unit, 0, o->start, p->work.u);
	p->work.factor = r->factor;
	p->work.fresh = true;
	double source = norm(p, p->f);
	r->converged = (source == 0 && !o->start) || l->diagonal == 0 || l->unknowns == 0;
	if (!r->converged)
		iterate(p, o, source, r);
	double mean = l->singular ? pm_laplacian_mean(l, p->work.u, p->work.sums) : 0;
	for (size_t i = 0; i < l->size; i++)
		phi[i] = unit * (p->work.u[i] - mean);
	if (p->ranks.status)
		return p->ranks.status;
	return r->converged ? 0 : not_converged(p->method, r, o);
}

/* Grounded, then with the boundary values of free space; the record is that of the second solution, with the sweeps of both. */
static int solve_open(struct pm_relaxation *p, const struct pm_relaxation_choice *o, double c, const double *s, double *phi, struct pm_relaxation_record *r)
{
	const double *f;
	double *u = pm_alloc(p->lap.size + 1, sizeof *u);
	int status = pm_planes_agree(u ? 0 : pm_failed(), &p->ranks.planes);
	if (!status)
		status = solve(p, o, c, s, u, r);
	int64_t sweeps = status ? 0 : r->sweeps;
	bool floor = !status && r->floor;
	status = pm_james_source(status, p->james, c, s, u, phi, &f);
	if (!status)
		status = solve(p, o, 1, f, phi, r);
	if (!status)
		pm_james_set(p->james, phi);
	r->sweeps += sweeps;
	r->floor |= floor;
	pm_free(u);
	return status;
}

int pm_relaxation_solve(struct pm_relaxation *p, const struct pm_relaxation_choice *o, double c, const double *s, double *phi,
	struct pm_relaxation_record *r)
{
	return p->james ? solve_open(p, o, c, s, phi, r) : solve(p, o, c, s, phi, r);
}
