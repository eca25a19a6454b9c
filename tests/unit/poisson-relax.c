/* Relaxation and conjugate gradients against their published spectral radii, exact solutions of the differences, and themselves with other threads.
 * N10 to N14: tests/reference. SPDX-License-Identifier: GPL-3.0-or-later */
#include <stdlib.h>
#include <string.h>

#include "check.h"
#include "poisson-relax/relaxation.h"

/* faces: two letters per axis, p w n; box of lengths l */
static struct pm_grid grid(int dim, const size_t *cells, const double *l, const char *faces)
{
	struct pm_grid g = {.dim = dim};
	for (int d = 0; d < 3; d++) {
		g.cells[d] = d < dim ? cells[d] : 1;
		g.h[d] = d < dim ? l[d] / (double)cells[d] : 1;
		for (int s = 0; s < 2; s++) {
			char c = d < dim ? faces[2 * d + s] : 'p';
			g.face[d][s] = c == 'p' ? PM_PERIODIC : c == 'w' ? PM_WALL : PM_NEUMANN;
		}
		g.points[d] = d < dim ? g.cells[d] + (g.face[d][0] != PM_PERIODIC) : 1;
	}
	return g;
}
static struct pm_grid cube(int dim, size_t n, const char *faces)
{
	return grid(dim, (size_t[]){n, n, n}, (double[]){1, 1, 1}, faces);
}

static void noise(size_t n, double *a)
{
	for (size_t i = 0; i < n; i++) {
		double u[2];
		pm_random(7, i, 0, u);
		a[i] = u[0] - 0.5;
	}
}

static double residual(struct pm_relaxation *p, double *r)
{
	struct pm_relax_work *w = pm_relaxation_work(p);
	return sqrt(pm_laplacian_residual(w->lap, w->u, w->f, r, w->sums));
}

/* The factor by which the residual falls per sweep, from noise, over the sweeps from `from` to `to`. */
static double measured(const struct pm_grid *g, const struct pm_relax *method, double factor, int from, int to)
{
	size_t n = pm_grid_size(g);
	double *u = pm_zalloc(n, sizeof *u), *f = pm_zalloc(n, sizeof *f), before = 0;
	struct pm_relaxation *p = pm_relaxation_new(g, method);
	noise(n, u);
	pm_relaxation_start(p, factor, f, u);
	for (int i = 0; i < to; i++) {
		if (i == from)
			before = residual(p, u);
		method->sweep(pm_relaxation_work(p));
	}
	double rate = pow(residual(p, u) / before, 1.0 / (to - from));
	pm_relaxation_free(p);
	pm_free(u), pm_free(f);
	return rate;
}

/* N10: the numbers printed for N = 64, formula and measurement. */
static void test_printed_radii(void)
{
	struct pm_grid square = cube(2, 64, "wwww"), line = cube(1, 64, "ww");
	struct pm_laplacian l = pm_laplacian_of(&square), l1 = pm_laplacian_of(&line);
	const struct pm_relax *jacobi = pm_relax_find("jacobi"), *gs = pm_relax_find("gauss-seidel");
	check_near(jacobi->radius(&l, 1), 0.998795, 5e-7, "N10: Jacobi's radius on 64 x 64 cells between walls");
	check_near(gs->radius(&l, 1), 0.997592, 5e-7, "N10: that of Gauss-Seidel, its square");
	check_near(jacobi->radius(&l1, 1), 1 - pm_pi * pm_pi / (2 * 64 * 64), 1e-6, "N10: 1 - pi^2/(2 n^2) in 1-D, to order n^-4");
	check_near(gs->radius(&l1, 1), 1 - pm_pi * pm_pi / (64 * 64), 3e-6, "N10: 1 - pi^2/n^2 for Gauss-Seidel");
	/* after 3000 sweeps the next mode, 0.9970, has fallen to 0.5 % of the first */
	check_near(measured(&square, jacobi, 1, 3000, 5000), 0.998795456205, 2e-8, "N10: Jacobi's radius measured");
	check_near(measured(&square, gs, 1, 3000, 5000), 0.997592363336, 2e-7, "N10: that of Gauss-Seidel measured");
}

/* N11: sweeps to 1e-6 from the formulas, and counted from the lowest mode. */
static void test_sweeps(void)
{
	static const struct { size_t n; double best; int want[3]; } row[] = {{32, 1.8215, {2863, 1432, 71}}, {64, 1.9065, {11463, 5732, 141}},
		{128, 1.9521, {45865, 22933, 282}}};
	static const char *const name[] = {"jacobi", "gauss-seidel", "sor"};
	for (int q = 0; q < 3; q++) {
		struct pm_grid g = cube(2, row[q].n, "wwww");
		struct pm_laplacian l = pm_laplacian_of(&g);
		for (int m = 0; m < 3; m++) {
			const struct pm_relax *method = pm_relax_find(name[m]);
			double factor = method->factor(&l), sweeps = ceil(log(1e-6) / log(method->radius(&l, factor)));
			check(fabs(sweeps - row[q].want[m]) <= 1, "N11: %s on %zu^2 takes %d sweeps to 1e-6 by its radius (got %g, tolerance 1)", name[m],
				row[q].n, row[q].want[m], sweeps);
			if (m == 2)
				check_near(factor, row[q].best, 5e-5, "N11: Young's best factor");
		}
	}
	struct pm_grid g = cube(2, 32, "wwww");
	size_t n = pm_grid_size(&g);
	double *u = pm_zalloc(n, sizeof *u), *f = pm_zalloc(n, sizeof *f);
	for (size_t j = 0; j < 33; j++)
		for (size_t i = 0; i < 33; i++)
			u[i + 33 * j] = sin(pm_pi * (double)i / 32) * sin(pm_pi * (double)j / 32);
	for (int m = 0; m < 3; m++) {
		const struct pm_relax *method = pm_relax_find(name[m]);
		struct pm_relaxation *p = pm_relaxation_new(&g, method);
		struct pm_relax_work *w = pm_relaxation_work(p);
		pm_relaxation_start(p, method->factor(w->lap), f, u);
		double norm = sqrt(pm_laplacian_product(w->lap, u, u, w->sums));
		int sweeps = 0;
		for (; sqrt(pm_laplacian_product(w->lap, w->u, w->u, w->sums)) > 1e-6 * norm; sweeps++)
			method->sweep(w);
		/* Gauss-Seidel's lowest mode is a sine times 1 - O(h) across the square; at the best factor errors grow by a factor of order n first */
		int low = m == 2 ? 71 : row[0].want[m] * 99 / 100, high = m == 2 ? 2 * 71 : row[0].want[m] * 101 / 100;
		check(sweeps >= low && sweeps <= high, "N11: counted from the lowest mode on 32^2, %s takes %d sweeps (between %d and %d)", name[m], sweeps,
			low, high);
		pm_relaxation_free(p);
	}
	pm_free(u), pm_free(f);
}

/* N12: a sine shrinks by 1 - 2 w sin^2(k pi/2N) in a sweep, all k; the lowest by 1 - w pi^2 h^2/2. */
static void test_modes(void)
{
	enum { N = 64 };
	struct pm_grid g = cube(1, N, "ww");
	const struct pm_relax *method = pm_relax_find("weighted-jacobi");
	struct pm_relaxation *p = pm_relaxation_new(&g, method);
	static const double weight[] = {1.0 / 3, 0.5, 2.0 / 3, 1};
	double u[N + 1], f[N + 1] = {0}, worst = 0, lowest = 0;
	for (int q = 0; q < 4; q++)
		for (int k = 1; k < N; k++) {
			for (int i = 0; i <= N; i++)
				u[i] = sin(i * k % (2 * N) * pm_pi / N);
			pm_relaxation_start(p, weight[q], f, u);
			method->sweep(pm_relaxation_work(p));
			double s = sin(k * pm_pi / (2 * N)), want = 1 - 2 * weight[q] * s * s;
			for (int i = 1; i < N; i++)
				check_worst(&worst, fabs(pm_relaxation_work(p)->u[i] - want * u[i]));
			if (k == 1)
				check_worst(&lowest, fabs(want - (1 - weight[q] * pm_pi * pm_pi / (2.0 * N * N))));
		}
	check_near(worst, 0, 1e-14, "N12: a sine shrinks by 1 - 2 w sin^2(k pi/2N) per sweep, every k, w = 1/3, 1/2, 2/3, 1");
	check_near(lowest, 0, pow(pm_pi / N, 4) / 24 * 1.01, "N12: the lowest by 1 - w pi^2 h^2/2, to order h^4");
	pm_relaxation_free(p);
}

/* N13: twice the spacing, four times the distance of the radius from 1. N14: what a mode becomes on every second node. */
static void test_coarse(void)
{
	const struct pm_relax *method = pm_relax_find("weighted-jacobi");
	struct pm_grid fine = cube(1, 64, "ww"), coarse = cube(1, 32, "ww");
	struct pm_laplacian a = pm_laplacian_of(&fine), b = pm_laplacian_of(&coarse);
	double ratio = (1 - method->radius(&b, 2.0 / 3)) / (1 - method->radius(&a, 2.0 / 3));
	check_near(ratio, 4, 0.01, "N13: on 2h the error of the lowest mode falls by 1 - O(4 h^2)");
	static const double best[] = {2.0 / 3, 4.0 / 5, 6.0 / 7}, smooth[] = {1.0 / 3, 3.0 / 5, 5.0 / 7};
	for (int dim = 1; dim <= 3; dim++) {
		struct pm_grid g = cube(dim, 8, "pppppp");
		struct pm_laplacian l = pm_laplacian_of(&g);
		double w = method->factor(&l), worst = 0;
		check_near(w, best[dim - 1], 1e-15, "the default weight is 2/3, 4/5, 6/7");
		for (int q = 0; q < 8 * 8 * 8; q++) { /* short on at least one axis: |m| >= n/4 */
			int m[3] = {q % 8, q / 8 % 8, q / 64};
			double mu = 0;
			bool high = false;
			for (int d = 0; d < dim; d++)
				mu += cos(2 * pm_pi * m[d] / 8) / dim, high = high || (m[d] >= 2 && m[d] <= 6);
			check_worst(&worst, high ? fabs(1 - w * (1 - mu)) : 0);
		}
		check_near(worst, smooth[dim - 1], 1e-14, "PS-10: it shrinks short waves by 1/3, 3/5, 5/7");
	}
	double same = 0, alias = 0;
	for (int j = 0; j <= 6; j++) {
		check_worst(&same, fabs(sin(4 * (2 * j) * pm_pi / 12) - sin(4 * j * pm_pi / 6)));
		check_worst(&alias, fabs(sin(8 * (2 * j) * pm_pi / 12) + sin(4 * (2 * j) * pm_pi / 12)));
	}
	check_near(same, 0, 1e-14, "N14: mode 4 of 12 cells is mode 4 of 6 on every second node");
	check_near(alias, 0, 1e-14, "N14: mode 8 of 12 looks like minus mode 4 there");
	struct pm_grid g12 = cube(1, 12, "ww"), g6 = cube(1, 6, "ww");
	double rate[2], zero[13] = {0}, u[13];
	for (int q = 0; q < 2; q++) {
		struct pm_relaxation *p = pm_relaxation_new(q ? &g6 : &g12, method);
		for (int i = 0; i <= 12 >> q; i++)
			u[i] = sin(4 * i * pm_pi / (12 >> q));
		pm_relaxation_start(p, 2.0 / 3, zero, u);
		method->sweep(pm_relaxation_work(p));
		rate[q] = pm_relaxation_work(p)->u[1] / u[1];
		pm_relaxation_free(p);
	}
	check_near(rate[0], 2.0 / 3, 1e-14, "N14: k/N = 1/3, mode 4 of 12 shrinks to 2/3, 1 - 4/3 sin^2(pi/6)");
	check_near(rate[1], 0, 1e-14, "N14: k/N = 2/3, the same mode on 6 cells vanishes, 1 - 4/3 sin^2(pi/3)");
}

static const char *const axis_faces[5] = {"pp", "ww", "nn", "wn", "nw"};

/* Every method whose formula holds, every mixture of faces in 2-D, unequal spacings; differences in units of 1 - radius. From L/3 to L = 25/(1 - radius)
 * sweeps the residual falls by e^-17, the next modes much more. From the optimal over-relaxation factor on it falls as n rho^n or oscillates about rho^n, by
 * a factor of about 3 over the range: 0.15 is log(3)/17 doubled. */
static void test_formulas(void)
{
	static const double share[] = {1, 0.8, 1.03}; /* of the method's own factor */
	for (int m = 0; pm_relaxs[m]; m++) {
		const struct pm_relax *method = pm_relaxs[m];
		double worst = 0, where = 0;
		int compared = 0;
		for (int q = 0; q < 25 * 3 && !method->bound; q++) {
			char faces[8];
			snprintf(faces, sizeof faces, "%s%s", axis_faces[q / 3 % 5], axis_faces[q / 15]);
			struct pm_grid g = grid(2, (size_t[]){10, 12}, (double[]){1.1, 0.9}, faces);
			struct pm_laplacian l = pm_laplacian_of(&g);
			double factor = method->factor(&l) * share[q % 3], want = method->radius(&l, factor);
			if (isnan(want) || want >= 1 || factor >= 2)
				continue;
			double length = fmin(4000, 25 / (1 - want)), got = measured(&g, method, factor, (int)(length / 3), (int)length);
			double off = fabs(got - want) / (1 - want) / (method->factor(&l) > 1 && share[q % 3] >= 1 ? 0.15 : 1e-3);
			if (check_worst(&worst, off))
				where = q;
			compared++;
		}
		if (!method->bound)
			check(compared >= 16 && worst < 1, "%s: the radius measured is that of the formula, in %d mixtures of faces and factors (worst %.2g "
				"of the tolerance, at %g)", method->name, compared, worst, where);
	}
}

static double mode(const struct pm_grid *g, int d, int m, size_t i, double *k) /* a mode of the axis with its faces, and its wave number times h */
{
	double n = (double)g->cells[d];
	if (d >= g->dim)
		return *k = 0, 1;
	*k = g->face[d][0] == PM_PERIODIC ? 2 * pm_pi * m / n : pm_pi * (g->face[d][0] == g->face[d][1] ? m : m - 0.5) / n;
	return g->face[d][0] == PM_WALL ? sin(*k * (double)i) : g->face[d][0] == PM_NEUMANN ? cos(*k * (double)i) : cos(*k * (double)i - 0.7);
}

/* The error of the solution for a product mode, plus a constant 0.3 where the problem is singular, relative to the largest value. */
static double solved(const struct pm_grid *g, const struct pm_relax *method, double scale, struct pm_relaxation_record *r)
{
	size_t n = pm_grid_size(g), p = 0;
	double *s = pm_zalloc(n, sizeof *s), *u = pm_zalloc(n, sizeof *u), worst = 0, k[3];
	struct pm_laplacian l = pm_laplacian_of(g);
	for (size_t c = 0; c < g->points[2]; c++)
		for (size_t b = 0; b < g->points[1]; b++)
			for (size_t a = 0; a < g->points[0]; a++, p++) {
				u[p] = mode(g, 0, 1, a, &k[0]) * mode(g, 1, 2, b, &k[1]) * mode(g, 2, 1, c, &k[2]);
				double lambda = 0;
				for (int d = 0; d < g->dim; d++)
					lambda -= pow(2 / g->h[d] * sin(k[d] / 2), 2);
				s[p] = scale * (lambda * u[p] + (l.singular ? 0.3 : 0));
			}
	struct pm_relaxation_choice o = {.method = method, .factor = NAN, .tolerance = 1e-11, .most = 100000};
	struct pm_relaxation *solver = pm_relaxation_new(g, method);
	int status = pm_relaxation_solve(solver, &o, 1, s, s, r);
	for (size_t i = 0; i < n; i++)
		check_worst(&worst, fabs(s[i] / scale - u[i]));
	pm_relaxation_free(solver);
	pm_free(s), pm_free(u);
	return status ? NAN : worst;
}

/* 1e-9: the tolerance times ten for the amplification of the lowest mode, times ten. */
static void test_mixtures(void)
{
	for (int m = 0; pm_relaxs[m]; m++) {
		double worst = 0, mean = 0;
		int refused = 0, done = 0;
		for (int dim = 1; dim <= 3; dim++)
			for (int q = 0; q < (dim == 3 ? 125 : dim == 2 ? 25 : 5); q += dim == 3 ? 3 : 1) {
				char faces[8];
				snprintf(faces, sizeof faces, "%s%s%s", axis_faces[q % 5], axis_faces[q / 5 % 5], axis_faces[q / 25]);
				struct pm_grid g = grid(dim, (size_t[]){7, 9, 6}, (double[]){1.1, 1.3, 0.9}, faces);
				struct pm_relaxation_record r;
				if (pm_relaxation_check(&g, pm_relaxs[m], NAN)) {
					refused++;
					continue;
				}
				double e = solved(&g, pm_relaxs[m], 1, &r);
				check_worst(&worst, e);
				check_worst(&mean, r.singular ? fabs(r.mean - 0.3) : 0);
				done++;
			}
		check(worst < 1e-9 && done + refused == 72, "%s: solves the differences in every mixture of faces, 1-D to 3-D (worst error %g of %d, "
			"tolerance 1e-9)", pm_relaxs[m]->name, worst, done);
		check(mean < 1e-13, "%s: the mean removed is that of the source (worst difference %g)", pm_relaxs[m]->name, mean);
		check((refused > 0) == !strcmp(pm_relaxs[m]->name, "jacobi"), "%s: %d mixtures refused, only Jacobi's where the nodes can alternate",
			pm_relaxs[m]->name, refused);
	}
	struct pm_grid g = grid(2, (size_t[]){9, 12}, (double[]){1, 2}, "wwnw");
	for (int q = 0; q < 2; q++) {
		struct pm_relaxation_record r;
		check_near(solved(&g, pm_relax_find("cg"), q ? 1e300 : 1e-300, &r), 0, 1e-9, "sources of 1e300 and 1e-300 neither overflow nor underflow");
	}
}

/* Axelsson's factor, 2/(1 + sqrt(2 (1 - mu))) with mu = cos(pi/n) between walls; the optimum is flat, so that sweeps do not tell. */
static void test_ssor_factor(void)
{
	struct pm_grid g = cube(2, 48, "wwww");
	struct pm_laplacian l = pm_laplacian_of(&g);
	check_near(pm_relax_find("ssor-cg")->factor(&l), 2 / (1 + 2 * sin(pm_pi / 96)), 1e-14, "ssor-cg: the factor is Axelsson's");
}

static void test_threads(void)
{
	static const char *const faces[] = {"pppppp", "wnppnn"};
	for (int m = 0; pm_relaxs[m]; m++)
		for (int q = 0; q < 2; q++) {
			struct pm_grid g = q ? cube(3, 28, faces[q]) : grid(3, (size_t[]){29, 27, 31}, (double[]){1, 1, 1}, faces[q]);
			size_t n = pm_grid_size(&g);
			double *s = pm_zalloc(n, sizeof *s), *phi[3];
			struct pm_relaxation_choice o = {.method = pm_relaxs[m], .factor = NAN, .most = 5};
			struct pm_relaxation_record r;
			noise(n, s);
			for (int t = 0; t < 3; t++) {
				pm_threads_use(t + 1);
				phi[t] = pm_zalloc(n, sizeof(double));
				struct pm_relaxation *p = pm_relaxation_new(&g, pm_relaxs[m]);
				pm_relaxation_solve(p, &o, 1, s, phi[t], &r);
				pm_relaxation_free(p);
			}
			check(!memcmp(phi[0], phi[1], n * sizeof *s) && !memcmp(phi[0], phi[2], n * sizeof *s) && phi[0][n / 2 + 1] != 0,
				"%s: equal bytes for 1, 2 and 3 threads, %s", pm_relaxs[m]->name, faces[q]);
			for (int t = 0; t < 3; t++)
				pm_free(phi[t]);
			pm_free(s);
		}
	pm_threads_use(1);
}

/* HC-28: a tolerance that cannot be reached ends at round-off, with every method. HC-24: sizes down to 1. */
static void test_ends(void)
{
	struct pm_grid g = cube(2, 12, "wwnn");
	double s[12 * 14] = {0}, phi[12 * 14];
	for (size_t i = 0; i < 12 * 14; i++)
		s[i] = sin(0.37 * (double)i) * cos(0.1 * (double)i);
	g = grid(2, (size_t[]){11, 13}, (double[]){1, 1}, "wwnn");
	for (int m = 0; pm_relaxs[m]; m++) {
		struct pm_relaxation_choice o = {.method = pm_relaxs[m], .factor = NAN, .tolerance = 1e-18, .most = 100000};
		struct pm_relaxation_record r;
		struct pm_relaxation *p = pm_relaxation_new(&g, pm_relaxs[m]);
		int status = pm_relaxation_solve(p, &o, 1, s, phi, &r);
		check(!status && r.floor && r.after < 1e-12, "HC-28: %s stops at round-off (%lld sweeps, residual %g)", pm_relaxs[m]->name,
			(long long)r.sweeps, r.after);
		pm_relaxation_free(p);
	}
	double worst = 0;
	for (int m = 0; pm_relaxs[m]; m++)
		for (size_t n = 1; n <= 3; n++)
			for (int q = 0; q < 5; q++) {
				struct pm_grid small = cube(1, n, axis_faces[q]);
				double f[4] = {1, -2, 0.5, 3}, u[4] = {NAN, NAN, NAN, NAN};
				struct pm_relaxation_choice o = {.method = pm_relaxs[m], .factor = NAN, .tolerance = 1e-13, .most = 10000};
				struct pm_relaxation_record r;
				if (pm_relaxation_check(&small, o.method, NAN))
					continue;
				struct pm_relaxation *p = pm_relaxation_new(&small, o.method);
				check_worst(&worst, fabs((double)pm_relaxation_solve(p, &o, 1, f, u, &r)));
				struct pm_laplacian l = pm_laplacian_of(&small);
				double h2 = small.h[0] * small.h[0];
				for (size_t i = l.axis[0].first; i < l.axis[0].end; i++) {
					double lap = l.axis[0].w * (u[pm_laplacian_below(&l.axis[0], i)] + u[pm_laplacian_above(&l.axis[0], i)] - 2 * u[i]);
					check_worst(&worst, h2 * fabs(lap - (f[i] - r.mean)));
				}
				pm_relaxation_free(p);
			}
	check(worst < 1e-12, "HC-24: meshes of 1, 2 and 3 cells are solved with all faces (worst residual %g)", worst);
}

int main(void)
{
	pm_threads_use(1); /* the meshes are small */
	test_printed_radii();
	test_sweeps();
	test_modes();
	test_coarse();
	test_formulas();
	test_mixtures();
	test_ssor_factor();
	test_threads();
	test_ends();
	return check_done();
}
