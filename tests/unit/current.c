/* Currents of particles: Esirkepov's example to the last digit (PIC-17), the equation of continuity for every kernel, dimension, face and length of way, the
 * sum of the current, the same bytes for any number of threads. SPDX-License-Identifier: GPL-3.0-or-later */
#include <stdlib.h>
#include <string.h>

#include "check.h"
#include "mesh/particle-faces.h"
#include "current/current.h"

enum { N = 3000, MANY = 18000 };

/* How fields and particles meet a face. */
static const struct rule {
	const char *name;
	enum pm_face face;
	enum pm_particle_face particles;
} rules[] = {{"periodic", PM_PERIODIC, PM_PFOLD}, {"wall, reflecting", PM_WALL, PM_PREFLECT}, {"wall, absorbing", PM_WALL, PM_PABSORB},
	{"neumann, reflecting", PM_NEUMANN, PM_PREFLECT}, {"open, absorbing", PM_OPEN, PM_PABSORB}, {"open, open", PM_OPEN, PM_POPEN}};
enum { RULES = sizeof rules / sizeof *rules };

static struct pm_current problem(int dim, const struct pm_kernel *k, const int rule[3])
{
	struct pm_current c = {.grid = {.dim = dim}, .kernel = k, .dt = 0.37};
	for (int d = 0; d < 3; d++) {
		const bool used = d < dim;
		c.grid.cells[d] = used ? (const size_t[]){13, 11, 10}[d] : 1;
		c.grid.lo[d] = c.lo[d] = used ? -0.3 - d / 10. : 0;
		c.grid.h[d] = used ? (const double[]){0.7, 0.55, 0.9}[d] : 1;
		c.hi[d] = c.lo[d] + (double)c.grid.cells[d] * c.grid.h[d];
		c.grid.points[d] = used && rules[rule[d]].face != PM_PERIODIC ? c.grid.cells[d] + 1 : c.grid.cells[d];
		for (int s = 0; s < 2; s++) {
			c.grid.face[d][s] = used ? rules[rule[d]].face : PM_PERIODIC;
			c.face[d][s] = used ? rules[rule[d]].particles : PM_PFOLD;
		}
	}
	return c;
}

struct state {
	double *x[3], *v[3], *q, *j[3], *rho;
	size_t points;
};

static struct state state_of(const struct pm_current *c, size_t n, double cells)
{
	struct state s = {.points = pm_grid_size(&c->grid), .q = pm_zalloc(n, sizeof(double))};
	s.rho = pm_zalloc(s.points, sizeof(double));
	for (int d = 0; d < 3; d++) {
		s.x[d] = pm_zalloc(n, sizeof(double));
		s.v[d] = pm_zalloc(n, sizeof(double));
		s.j[d] = pm_zalloc(s.points, sizeof(double));
		for (size_t p = 0; p < n; p++) {
			double u[2], w[2];
			pm_random(3, p, (uint64_t)d, u);
			pm_random(4, p, (uint64_t)d, w);
			const double place = p % 16 == 3 ? floor(u[0] * (double)c->grid.cells[d]) : u[0] * (double)c->grid.cells[d];
			s.x[d][p] = d < c->grid.dim ? fmin(c->grid.lo[d] + place * c->grid.h[d], c->hi[d]) : 0;
			s.v[d][p] = p % 32 == 5 ? 0 : cells * (2 * u[1] - 1) * c->grid.h[d] / c->dt;
			s.q[p] = w[0] - 0.4;
			if (d == 0 && c->face[0][0] == PM_PABSORB && p % 8 == 6) { /* beyond a face, and on its way in, as inject puts it */
				const double way = cells * (0.1 + 0.9 * u[1]) * c->grid.h[0];
				s.x[0][p] = p % 16 == 6 ? c->lo[0] - u[0] * way : c->hi[0] + u[0] * way;
				s.v[0][p] = (p % 16 == 6 ? way : -way) / c->dt;
			}
		}
	}
	return s;
}

static struct state state_new(const struct pm_current *c, double cells) { return state_of(c, N, cells); }

static void state_free(struct state *s)
{
	for (int d = 0; d < 3; d++) {
		pm_free(s->x[d]);
		pm_free(s->v[d]);
		pm_free(s->j[d]);
	}
	pm_free(s->q);
	pm_free(s->rho);
}

/* rho += sign times the density of the particles in the box. */
static void density(const struct pm_current *c, const struct state *s, double sign)
{
	const struct pm_transfer t = {.grid = c->grid, .kernel = c->kernel, .components = 1, .cut = true};
	double *q = pm_alloc(N, sizeof *q);
	struct pm_strays strays;
	for (size_t p = 0; p < N; p++)
		q[p] = c->face[0][0] == PM_PABSORB && (s->x[0][p] < c->lo[0] || s->x[0][p] > c->hi[0]) ? 0 : sign * s->q[p]; /* not in yet */
	pm_spread(&t, N, (const double *const *)s->x, (const double *const[]){q}, (double *const[]){s->rho}, &strays);
	pm_free(q);
}

/* As push: x += v dt, then the faces; absorbed particles lose their charge. */
static void move(const struct pm_current *c, struct state *s)
{
	unsigned char *gone = pm_zalloc(N, 1);
	for (int d = 0; d < c->grid.dim; d++) {
		for (size_t p = 0; p < N; p++)
			s->x[d][p] += c->dt * s->v[d][p];
		const bool mirror[2] = {c->face[d][0] == PM_PREFLECT, c->face[d][1] == PM_PREFLECT};
		const bool absorb[2] = {c->face[d][0] == PM_PABSORB, c->face[d][1] == PM_PABSORB};
		if (c->face[d][0] == PM_PFOLD)
			pm_particle_faces_fold(N, c->lo[d], c->hi[d], s->x[d]);
		if (mirror[0])
			pm_particle_faces_reflect(N, c->lo[d], c->hi[d], mirror, s->x[d], 0, NULL);
		pm_particle_faces_absorb(N, c->lo[d], c->hi[d], absorb, s->x[d], gone);
	}
	for (size_t p = 0; p < N; p++)
		for (int d = 0; d < 3 && gone[p]; d++)
			s->q[p] = 0, s->x[d][p] = c->lo[d];
	pm_free(gone);
}

/* div j at a node; at a neumann face the current through it has the opposite image. */
static double divergence(const struct pm_grid *g, double *const j[3], const size_t at[3], bool *known)
{
	const size_t stride[3] = {1, g->points[0], g->points[0] * g->points[1]}, i = at[0] + at[1] * stride[1] + at[2] * stride[2];
	double sum = 0;
	*known = true;
	for (int d = 0; d < g->dim; d++) {
		const bool periodic = g->face[d][0] == PM_PERIODIC, low = at[d] == 0 && !periodic, high = at[d] == g->cells[d] && !periodic;
		const double here = high ? 0 : j[d][i];
		const double below = low ? 0 : at[d] ? j[d][i - stride[d]] : j[d][i + (g->cells[d] - 1) * stride[d]];
		*known = *known && ((!low && !high) || g->face[d][0] == PM_NEUMANN);
		sum += (low ? 2 * here : high ? -2 * below : here - below) / g->h[d];
	}
	return sum;
}

/* Largest |drho/dt + div j| over the largest |div j|. */
static double error(const struct pm_current *c, const struct state *s)
{
	double worst = 0, most = 0;
	size_t at[3];
	for (at[2] = 0; at[2] < c->grid.points[2]; at[2]++)
		for (at[1] = 0; at[1] < c->grid.points[1]; at[1]++)
			for (at[0] = 0; at[0] < c->grid.points[0]; at[0]++) {
				bool known;
				const double div = divergence(&c->grid, s->j, at, &known);
				const double rate = s->rho[at[0] + c->grid.points[0] * (at[1] + c->grid.points[1] * at[2])] / c->dt;
				if (known)
					check_worst(&worst, fabs(rate + div));
				if (known)
					check_worst(&most, fabs(div));
			}
	return worst / most;
}

static double continuity(const struct pm_current *c, double cells, double *total)
{
	struct state s = state_new(c, cells);
	size_t stray;
	density(c, &s, -1);
	double want = 0, got = 0, scale = 0;
	for (size_t p = 0; p < N; p++)
		want += s.q[p] * s.v[0][p], scale += fabs(s.q[p] * s.v[0][p]);
	if (pm_current_add(c, N, (const double *const *)s.x, (const double *const *)s.v, s.q, s.j, &stray))
		printf("# %s, stray %zu\n", pm_message(), stray);
	for (size_t i = 0; i < s.points; i++)
		got += s.j[0][i] * pm_grid_cell(&c->grid);
	*total = fabs(got - want) / scale;
	move(c, &s);
	density(c, &s, 1);
	const double worst = error(c, &s);
	state_free(&s);
	return worst;
}

static void test_continuity(void)
{
	for (int k = 0; pm_kernels[k]; k++)
		for (int dim = 1; dim <= (pm_kernels[k]->star ? 1 : 3); dim++) { /* p2m --current refuses a star, no product of the axes */
			double worst = 0, sum = 0;
			const char *where = "";
			for (int r = 0; r < RULES; r++)
				for (int far = 0; far < 2; far++) {
					double total;
					const struct pm_current c = problem(dim, pm_kernels[k], (const int[]){r, (r + dim) % RULES, 0});
					if (check_worst(&worst, continuity(&c, far ? 2.7 : 0.9, &total)))
						where = rules[r].name;
					if (dim == 1 && r == 0) /* no faces */
						check_worst(&sum, total);
				}
			/* rounding of 3000 particles in at least 13 nodes */
			check(worst < 2e-13, "%s in %d-D keeps charge at every face, for ways of 0.9 and 2.7 cells (worst %.2g, %s)", pm_kernels[k]->name,
				dim, worst, where);
			if (dim == 1 && pm_kernels[k]->moments > 0) /* ngp has no centre */
				check(sum < 1e-14, "%s: the sum of J is the sum of q v (off by %.2g)", pm_kernels[k]->name, sum);
		}
}

static void test_villasenor(void)
{
	for (int dim = 1; dim <= 3; dim++) {
		double total, worst;
		struct pm_current c = problem(dim, pm_kernel_find("cic"), (const int[]){0, 1, 4});
		c.deposit = PM_VILLASENOR_BUNEMAN;
		worst = continuity(&c, 0.9, &total);
		check(worst < 2e-13, "Villasenor and Buneman's current in %d-D keeps charge (off by %.2g)", dim, worst);
	}
}

/* Esirkepov's example in exact fractions: cic in the plane, (0.3, 0.6) to (1.1, 0.9), q = h = dt = 1. */
static void test_example(void)
{
	struct pm_current c = {.grid = {.dim = 2, .cells = {8, 8, 1}, .points = {8, 8, 1}, .h = {1, 1, 1}}, .kernel = pm_kernel_find("cic"), .dt = 1};
	double x[2] = {0.3, 0.6}, v[2] = {0.8, 0.3}, q = 1, jx[64] = {0}, jy[64] = {0}, jz[64] = {0}, worst = 0;
	const double want_x[4] = {7. / 40, 21. / 40, 1. / 40, 3. / 40}, want_y[3] = {21. / 200, 9. / 50, 3. / 200};
	size_t stray;
	const double *at[3] = {&x[0], &x[1], NULL}, *speed[3] = {&v[0], &v[1], NULL};
	pm_current_add(&c, 1, at, speed, &q, (double *const[]){jx, jy, jz}, &stray);
	for (size_t i = 0; i < 2; i++)
		for (size_t j = 0; j < 2; j++)
			check_worst(&worst, fabs(jx[8 * j + i] - want_x[2 * i + j]));
	for (size_t i = 0; i < 3; i++)
		check_worst(&worst, fabs(jy[i] - want_y[i]));
	check(worst <= 2e-16, "PIC-17: Esirkepov's example in fractions (off by %.2g)", worst);
}

static void test_threads(void)
{
	for (int dim = 1; dim <= 3; dim++) {
		const struct pm_current c = problem(dim, pm_kernel_find("tsc"), (const int[]){0, 1, 4});
		struct state s[3];
		size_t stray;
		bool same = true;
		for (int t = 0; t < 3; t++) {
			s[t] = state_new(&c, 1.4);
			pm_threads_use((const int[]){1, 2, 7}[t]);
			pm_current_add(&c, N, (const double *const *)s[t].x, (const double *const *)s[t].v, s[t].q, s[t].j, &stray);
			for (int d = 0; d < 3; d++)
				same = same && !memcmp(s[0].j[d], s[t].j[d], s[t].points * sizeof(double));
		}
		for (int t = 0; t < 3; t++)
			state_free(&s[t]);
		check(same, "in %d-D 1, 2 and 7 threads give the same bytes", dim);
	}
}

/* A tile with many ways has sums of cells, one with few has none: all ways at once and by 500 give the same current but for the order of sums.
 * 1e-14: up to 1400 terms a point. */
static void sums_of_cells(int dim, const char *kernel, int rule)
{
	const double cells = rule % 2 ? 0.9 : 0.3; /* most ways leave their points, or few */
	const struct pm_current c = problem(dim, pm_kernel_find(kernel), (const int[]){rule, 0, (rule + 2) % RULES});
	struct state s = state_of(&c, MANY, cells), t = state_of(&c, MANY, cells);
	double most = 0, off = 0;
	bool bytes = true;
	size_t stray;
	pm_current_add(&c, MANY, (const double *const *)s.x, (const double *const *)s.v, s.q, s.j, &stray);
	for (size_t p = 0; p < MANY; p += 500) {
		const double *x[3] = {NULL}, *v[3];
		for (int d = 0; d < 3; d++)
			x[d] = d < dim ? t.x[d] + p : NULL, v[d] = t.v[d] + p;
		pm_current_add(&c, 500, x, v, t.q + p, t.j, &stray);
	}
	for (int d = 0; d < 3; d++)
		for (size_t i = 0; i < s.points; i++) {
			check_worst(&most, fabs(s.j[d][i]));
			check_worst(&off, fabs(s.j[d][i] - t.j[d][i]));
			bytes = bytes && s.j[d][i] == t.j[d][i];
		}
	check(off <= 1e-14 * most && !bytes, "%s in %d-D, %s: sums of cells are the sums of ways, in another order (off by %.2g of %.2g)", kernel, dim,
		rules[rule].name, off, most);
	state_free(&s), state_free(&t);
}

static void test_cells(void)
{
	static const char *const kernels[] = {"cic", "tsc", "pcs"};
	for (int dim = 1; dim <= 3; dim++)
		for (int k = 0; k < (dim == 1 ? 3 : 2); k++)
			for (int rule = 0; rule < RULES; rule++)
				sums_of_cells(dim, kernels[k], rule);
}

int main(void)
{
	test_example();
	test_cells();
	test_continuity();
	test_villasenor();
	test_threads();
	return check_done();
}
