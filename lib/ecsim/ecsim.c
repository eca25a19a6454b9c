/* The energy-conserving semi-implicit method, electrostatic in 1-D. In the middle of a drift-kick-drift step, at the places x there,
 *     v' = v + dt (q/m) Eh(x),   E' = E - dt/eps0 (J - <J>),   Eh = (E + E')/2,   J = sum q W (v + v')/2,
 * W cic about the points half a cell up, where E is. J is linear in Eh: J = sum q W v + M Eh with the mass matrix M_gh = sum dt q^2/(2 m) W_g W_h,
 * which has three diagonals: (1 + dt/(2 eps0) M) Eh = E - dt/(2 eps0) (sum q W v - <J>) is solved directly. The work q v.Eh on particles is what the field
 * loses, J.Eh, so the sum of both energies is constant to round-off for any dt and any spacing; no step is unstable. <J> is taken away because the mean of E
 * stays 0 in a periodic box. Momentum, and div E = rho/eps0, are kept to the order of the step alone.
 * Source: Lapenta 2017 (J. Comput. Phys. 334, 349), sections 2 and 3, without magnetic fields; Markidis and Lapenta 2011 (J. Comput. Phys. 230, 7037).
 * Cost: two passes over the particles and 4 sums of the mesh for every 16384 of them. SPDX-License-Identifier: GPL-3.0-or-later */
#include <string.h>

#include "ecsim/ecsim.h"
#include "law/law.h"
#include "mesh/grid.h"
#include "stream/declare.h"

enum { block = 16384, CURRENT = 0, DIAGONAL = 1, BESIDE = 2, SUMS = 3 };

static bool charged(const struct pm_frame *f, const struct pm_set *set)
{
	return pm_frame_field(f, set->name, "charge") && pm_frame_field(f, set->name, "x");
}

static bool moves(const struct pm_frame *f, const struct pm_set *set)
{
	return charged(f, set) && pm_set_moves(f, set) && pm_frame_field(f, set->name, "v") && pm_frame_field(f, set->name, "mass");
}

static int declare_sets(const struct pm_ecsim *c, struct pm_frame *f)
{
	for (size_t i = 0; i < f->nsets; i++) {
		const char *on = f->sets[i]->name;
		if (!charged(f, f->sets[i]) || (!c->gauss && !moves(f, f->sets[i])))
			continue;
		if (!pm_reads(f, on, "x") || !pm_reads(f, on, "charge"))
			return -PM_DATA;
		if (c->gauss)
			continue;
		if (!pm_reads(f, on, "v") || !pm_reads(f, on, "mass") || !pm_contributes(f, on, "acc", "v", 1, "self", false))
			return -PM_DATA;
	}
	return 0;
}

int pm_ecsim_declare(const struct pm_ecsim *c, struct pm_frame *f)
{
	const struct pm_mesh *m = pm_frame_mesh(f, c->mesh);
	if (!m)
		return pm_fail(PM_DATA, c->mesh ? "no mesh '%s' (sls lists them)" : "the frame has no mesh%s (pinit --cells)", c->mesh ? c->mesh : "");
	if (f->dim != 1 || strcmp(f->law, "electrostatic") != 0 || f->face[0][0] != PM_PERIODIC)
		return pm_fail(PM_DATA, "this step is of charges on a periodic line with the law electrostatic (otherwise p2m | poisson-fft | mgrad | m2p)");
	if (m->cells[0] < 3)
		return pm_fail(PM_DATA, "the mesh '%s' has %zu cells, and the field needs 3", m->name, m->cells[0]);
	const struct pm_field *e = pm_frame_field(f, m->name, "E");
	if (c->gauss && f->substep)
		return 0;
	if (!c->gauss && !(e && e->role == PM_STATE && e->components == 1 && e->staggered[0][0] && !e->uniform))
		return pm_fail(PM_DATA, "no E half a cell off the nodes of '%s' (ecsim --gauss in front of the steps makes it of the charge)", m->name);
	for (size_t i = 0; i < f->nsets && !c->gauss; i++)
		if (moves(f, f->sets[i]) && (fabs(f->sets[i]->drift - 0.5) > 1e-9 || f->sets[i]->kick != 0))
			return pm_fail(PM_DATA, "'%s' is not in the middle of a step (push drift/2 | ecsim | push kick drift/2)", f->sets[i]->name);
	struct pm_field *made = c->gauss && !e ? pm_makes(f, m->name, "E", 1, PM_STATE) : pm_changes(f, m->name, "E");
	if (!made)
		return -PM_DATA;
	if (c->gauss && (made->components != 1 || made->role != PM_STATE))
		return pm_fail(PM_DATA, "the E of '%s' was not made by ecsim (sel --drop E)", m->name);
	made->staggered[0][0] = 1;
	return declare_sets(c, f) ? -PM_DATA : 1;
}

/* Where a place is among points `up` of a cell above the nodes: the lower of two neighbours, and the weight of the upper. */
static size_t below(const struct pm_grid *g, double up, double x, double *upper)
{
	const double s = (x - g->lo[0]) / g->h[0] - up, low = floor(s);
	*upper = s - low;
	const ptrdiff_t n = (ptrdiff_t)g->cells[0], i = (ptrdiff_t)low % n;
	return (size_t)(i < 0 ? i + n : i);
}

/* Sums of one set on the mesh: of the charge (up 0), or of current and mass matrix (up 1/2), by blocks of particles joined in order. */
struct deposit {
	const struct pm_grid *g;
	double dt, up;
	const double *x, *v, *q, *m; /* v NULL: the charge alone */
	double charge, mass;         /* of each, where q, m are NULL */
};

static void deposit_block(const struct deposit *d, size_t from, size_t to, double *sum)
{
	const size_t n = d->g->cells[0];
	for (size_t p = from; p < to; p++) {
		const double q = d->q ? d->q[p] : d->charge, m = d->m ? d->m[p] : d->mass;
		double w;
		const size_t i = below(d->g, d->up, d->x[p], &w), j = i + 1 < n ? i + 1 : 0;
		const double strength = d->v ? q * d->v[p] : q, matrix = d->v ? 0.5 * d->dt * q * q / m : 0;
		sum[CURRENT * n + i] += strength * (1 - w);
		sum[CURRENT * n + j] += strength * w;
		if (!d->v)
			continue;
		sum[DIAGONAL * n + i] += matrix * (1 - w) * (1 - w);
		sum[DIAGONAL * n + j] += matrix * w * w;
		sum[BESIDE * n + i] += matrix * w * (1 - w); /* of i and the one above */
	}
}

static int deposit(const struct deposit *d, size_t count, double *sum)
{
	const size_t n = d->g->cells[0], blocks = (count + block - 1) / block;
	double *own = pm_zalloc(blocks * SUMS * n + 1, sizeof *own);
	if (!own)
		return -PM_DATA;
#pragma omp parallel for schedule(static)
	for (size_t b = 0; b < blocks; b++)
		deposit_block(d, b * block, b * block + block < count ? b * block + block : count, own + b * SUMS * n);
	for (size_t b = 0; b < blocks; b++)
		for (size_t i = 0; i < SUMS * n; i++)
			sum[i] += own[b * SUMS * n + i] / d->g->h[0];
	pm_free(own);
	return 0;
}

static int deposit_all(const struct pm_frame *f, const struct pm_grid *g, bool currents, double *sum)
{
	int status = 0;
	for (size_t i = 0; i < f->nsets && !status; i++) {
		const char *on = f->sets[i]->name;
		if (!charged(f, f->sets[i]) || (currents && !moves(f, f->sets[i])))
			continue;
		const struct pm_field *x = pm_frame_field(f, on, "x"), *q = pm_frame_field(f, on, "charge"), *m = pm_frame_field(f, on, "mass");
		const struct deposit d = {.g = g, .dt = f->dt, .up = currents ? 0.5 : 0, .x = pm_in(x, 0),
			.v = currents ? pm_in(pm_frame_field(f, on, "v"), 0) : NULL, .q = q->uniform ? NULL : pm_in(q, 0), .charge = q->value[0],
			.m = currents && !m->uniform ? pm_in(m, 0) : NULL, .mass = currents ? m->value[0] : 1};
		status = deposit(&d, x->count, sum);
	}
	return status;
}

/* Solves the cyclic system with the diagonal a and b[i] between i and i + 1, for two right sides at once; a and room are changed. Thomas' algorithm on the
 * matrix less a dyad at its corners (Sherman and Morrison 1950); positive definite, so without pivots. room: n. */
static void solve(size_t n, double *a, const double *b, double *r[2], double *room)
{
	const double corner = b[n - 1], gamma = -a[0];
	double *u = room;
	memset(u, 0, n * sizeof *u);
	u[0] = gamma;
	u[n - 1] = corner;
	a[0] -= gamma;
	a[n - 1] -= corner * corner / gamma;
	double *const all[3] = {r[0], r[1], u};
	for (size_t i = 1; i < n; i++) {
		const double part = b[i - 1] / a[i - 1];
		a[i] -= part * b[i - 1];
		for (int k = 0; k < 3; k++)
			all[k][i] -= part * all[k][i - 1];
	}
	for (size_t i = n; i-- > 0;)
		for (int k = 0; k < 3; k++)
			all[k][i] = (all[k][i] - (i + 1 < n ? b[i] * all[k][i + 1] : 0)) / a[i];
	const double whole = 1 + u[0] + corner / gamma * u[n - 1];
	for (int k = 0; k < 2; k++) {
		const double part = (r[k][0] + corner / gamma * r[k][n - 1]) / whole;
		for (size_t i = 0; i < n; i++)
			r[k][i] -= part * u[i];
	}
}

/* acc += (q/m) E at the particles of all sets. */
static void accelerate(struct pm_frame *f, const struct pm_grid *g, const double *e)
{
	const size_t n = g->cells[0];
	for (size_t k = 0; k < f->nsets; k++) {
		const char *on = f->sets[k]->name;
		if (!moves(f, f->sets[k]))
			continue;
		const struct pm_field *q = pm_frame_field(f, on, "charge"), *m = pm_frame_field(f, on, "mass");
		struct pm_field *acc = pm_frame_field(f, on, "acc");
		const double *x = pm_in(pm_frame_field(f, on, "x"), 0), *charge = q->uniform ? NULL : pm_in(q, 0), *mass = m->uniform ? NULL : pm_in(m, 0);
		double *a = pm_out(acc, 0);
#pragma omp parallel for schedule(static) if (acc->count > block)
		for (size_t p = 0; p < acc->count; p++) {
			double w;
			const size_t i = below(g, 0.5, x[p], &w), j = i + 1 < n ? i + 1 : 0;
			a[p] += (charge ? charge[p] : q->value[0]) / (mass ? mass[p] : m->value[0]) * ((1 - w) * e[i] + w * e[j]);
		}
	}
}

static double energy_of(const struct pm_grid *g, double eps0, const double *e)
{
	return 0.5 * eps0 * g->h[0] * pm_sum_products(g->cells[0], e, e);
}

static int advance(struct pm_frame *f, const struct pm_grid *g, double *e, double *room, struct pm_ecsim_record *r)
{
	const size_t n = g->cells[0];
	const double eps0 = pm_law_constant(f, "eps0", 1), part = 0.5 * f->dt / eps0;
	double *a = room + DIAGONAL * n, *b = room + BESIDE * n, *half = room + SUMS * n, *one = half + n, *more = one + n;
	int status = deposit_all(f, g, true, room);
	for (size_t i = 0; i < n; i++) {
		half[i] = e[i] - part * room[CURRENT * n + i];
		one[i] = 1;
		a[i] = 1 + part * a[i];
		b[i] *= part;
	}
	solve(n, a, b, (double *[2]){half, one}, more);
	const double mean = pm_sum_array(n, half) / pm_sum_array(n, one);
	for (size_t i = 0; i < n; i++) {
		half[i] -= mean * one[i];
		e[i] = 2 * half[i] - e[i];
	}
	if (!status)
		accelerate(f, g, half);
	r->energy = energy_of(g, eps0, e);
	return status;
}

/* E whose differences are the charge on the nodes less its mean, and whose mean is 0. */
static int project(struct pm_frame *f, const struct pm_grid *g, double *e, double *room, struct pm_ecsim_record *r)
{
	const size_t n = g->cells[0];
	const double eps0 = pm_law_constant(f, "eps0", 1);
	const int status = deposit_all(f, g, false, room);
	const double mean = pm_sum_array(n, room) / (double)n;
	double most = 0, largest = 0, last = 0;
	for (size_t i = 0; i < n; i++) {
		const double rho = (room[i] - mean) / eps0;
		most = fmax(most, fabs((e[i] - e[i ? i - 1 : n - 1]) / g->h[0] - rho));
		largest = fmax(largest, fabs(rho));
		room[i] = rho;
	}
	for (size_t i = 0; i < n; i++)
		e[i] = last += g->h[0] * room[i];
	const double level = pm_sum_array(n, e) / (double)n;
	for (size_t i = 0; i < n; i++)
		e[i] -= level;
	*r = (struct pm_ecsim_record){.residual = largest > 0 ? most / largest : most, .energy = energy_of(g, eps0, e)};
	return status;
}

int pm_ecsim_step(const struct pm_ecsim *c, struct pm_frame *f, struct pm_ecsim_record *r)
{
	const struct pm_mesh *m = pm_frame_mesh(f, c->mesh);
	const struct pm_grid g = pm_grid_of(f, m);
	double *e = pm_out(pm_frame_field(f, m->name, "E"), 0), *room = pm_zalloc((SUMS + 3) * g.cells[0], sizeof *room);
	*r = (struct pm_ecsim_record){0, 0};
	const int status = !room ? -PM_DATA : c->gauss ? project(f, &g, e, room, r) : advance(f, &g, e, room, r);
	pm_free(room);
	return status;
}
