/* The multigrid solver against exact solutions of the differences, published convergence factors, and itself with other threads.
 * SPDX-License-Identifier: GPL-3.0-or-later */
#include <stdlib.h>
#include <string.h>

#include "mg-problem.h"
#include "poisson-mg/mg-hierarchy.h"

static const struct pm_mg_choice usual = {.pre = 2, .post = 2, .cycle = PM_MG_FMG, .relaxation = 1, .tolerance = 1e-11, .most = 50};

/* Mode m of an axis: an eigenvector of the second difference with its faces, wave number k. */
static double wave_number(const struct pm_grid *g, int d, int m)
{
	double length = g->h[d] * (double)g->cells[d];
	if (g->face[d][0] == PM_PERIODIC)
		return 2 * pm_pi * m / length;
	return pm_pi * (g->face[d][0] == g->face[d][1] ? m : m - 0.5) / length;
}
static double mode(const struct pm_grid *g, int d, int m, size_t i)
{
	double x = wave_number(g, d, m) * g->h[d] * (double)i;
	if (g->face[d][0] == PM_PERIODIC)
		return cos(x - 0.7);
	return g->face[d][0] == PM_WALL ? sin(x) : cos(x);
}
static double lambda(const struct pm_grid *g, int d, int m) /* of the second difference */
{
	double s = 2 / g->h[d] * sin(wave_number(g, d, m) * g->h[d] / 2);
	return g->points[d] == 1 ? 0 : -s * s;
}

/* s: sum of two product modes; phi: the exact solution of the differences (discrete) or of the equation. A mode that is zero on the nodes or for the
 * differences is left out. */
static void modes(const struct pm_grid *g, const int m[2][3], bool discrete, double *s, double *phi)
{
	memset(s, 0, pm_grid_size(g) * sizeof *s);
	memset(phi, 0, pm_grid_size(g) * sizeof *phi);
	for (int o = 0; o < 2; o++) {
		double sum = 0, *v[3];
		for (int d = 0; d < 3; d++) {
			sum += d >= g->dim ? 0 : discrete ? lambda(g, d, m[o][d]) : -wave_number(g, d, m[o][d]) * wave_number(g, d, m[o][d]);
			v[d] = values(g->points[d]);
			for (size_t i = 0; i < g->points[d]; i++)
				v[d][i] = d < g->dim ? mode(g, d, m[o][d], i) : 1;
		}
		for (size_t k = 0, p = 0; fabs(sum) > 1e-9 && k < g->points[2]; k++)
			for (size_t j = 0; j < g->points[1]; j++)
				for (size_t i = 0; i < g->points[0]; i++, p++) {
					s[p] += v[0][i] * v[1][j] * v[2][k];
					phi[p] += v[0][i] * v[1][j] * v[2][k] / sum;
				}
		for (int d = 0; d < 3; d++)
			pm_free(v[d]);
	}
}

/* The largest error of phi, relative to its largest value, with the given choice; cycles out. */
static double error(const struct pm_grid *g, const int m[2][3], bool discrete, const struct pm_mg_choice *o, struct pm_mg_record *r)
{
	size_t n = pm_grid_size(g);
	double *s = values(n), *phi = values(n), *exact = values(n), e = NAN;
	modes(g, m, discrete, s, exact);
	struct pm_mg *mg = pm_mg_new(g, 2);
	if (mg && !pm_mg_solve(mg, o, 1, s, phi, r))
		e = largest(n, phi, exact) / fmax(largest(n, exact, NULL), 1e-6); /* no modes at all: what is left is their round-off */
	pm_mg_free(mg);
	pm_free(s), pm_free(phi), pm_free(exact);
	return e;
}

static const int low_modes[2][3] = {{1, 1, 2}, {3, 2, 1}};
static const int lowest_modes[2][3] = {{1, 1, 2}, {2, 1, 1}}; /* for orders, so that 20 cells resolve them */
static const char *const axis_faces[5] = {"pp", "ww", "nn", "wn", "nw"};

/* Every mixture of faces. 1e-9: the tolerance 1e-11 of the residual, times ten for the amplification of its lowest mode, times ten. */
static void test_mixtures(void)
{
	static struct pm_mg_record r;
	for (int dim = 1; dim <= 3; dim++) {
		double worst = 0, slope = 9;
		int most = 0;
		for (int q = 0; q < (dim == 3 ? 125 : dim == 2 ? 25 : 5); q++) {
			char faces[8];
			snprintf(faces, sizeof faces, "%s%s%s", axis_faces[q % 5], axis_faces[q / 5 % 5], axis_faces[q / 25]);
			struct pm_grid g = grid(dim, (size_t[]){12, 18, 10}, (double[]){1.1, 1.3, 0.9}, faces);
			double e = error(&g, low_modes, true, &usual, &r);
			check_worst(&worst, e);
			most = r.cycles > most ? r.cycles : most;
			double x[3], y[3];
			for (int i = 0; i < 3 && q % (dim == 3 ? 7 : 1) == 0; i++) {
				size_t n = (size_t[]){20, 28, 40}[i];
				struct pm_grid finer = grid(dim, (size_t[]){n, n, n}, (double[]){1.1, 1.3, 0.9}, faces);
				x[i] = log(1 / (double)n), y[i] = log(error(&finer, lowest_modes, false, &usual, &r));
			}
			if (q % (dim == 3 ? 7 : 1) == 0) /* in 3-D every seventh, to be quick: each pair of faces occurs on each axis */
				check_least(&slope, (y[2] - y[1]) / (x[2] - x[1])), check_least(&slope, (y[1] - y[0]) / (x[1] - x[0]));
		}
		check(worst < 1e-9, "%d-D: the differences are solved exactly in every mixture of periodic, wall and neumann faces (got %g, want 0, "
			"tolerance 1e-9)", dim, worst);
		check(most <= 15, "%d-D: at most 15 cycles in every mixture (got %d)", dim, most);
		check(slope >= 1.9, "%d-D: smooth solutions converge with order 2 in every mixture: lowest order between neighbours of three grids %.3f", dim,
			slope);
	}
}

/* PS-05: -lap u = 1 in the unit square. */
static void test_square(void)
{
	static struct pm_mg_record r;
	const double centre = 0.073671353281513816, integral = 0.035144253738788429;
	double h[4], ec[4], ei[4];
	for (int i = 0; i < 4; i++) {
		size_t n = (size_t[]){16, 32, 64, 48}[i], p = n + 1;
		struct pm_grid g = cube(2, n, "wwww");
		double *s = values(p * p), *u = values(p * p), sum = 0;
		for (size_t q = 0; q < p * p; q++)
			s[q] = 1;
		struct pm_mg *mg = pm_mg_new(&g, 2);
		check(pm_mg_solve(mg, &usual, -1, s, u, &r) == 0, "PS-05: %zu^2 converges", n);
		for (size_t q = 0; q < p * p; q++)
			sum += u[q] / (double)(n * n);
		h[i] = 1 / (double)n, ec[i] = fabs(u[n / 2 * p + n / 2] - centre), ei[i] = fabs(sum - integral);
		pm_mg_free(mg), pm_free(s), pm_free(u);
	}
	check_order(3, h, ec, 2, "PS-05: u at the centre of a square with walls");
	check_order(3, h, ei, 2, "PS-05: the integral of u over a square with walls");
	/* 0.0625 and 0.0703125 on 2^2 and 4^2 cells by hand, errors 0.0447 h^2 and 0.0537 h^2; the reference's remark 0.021 h^2 does not belong to this node */
	check_near(ec[2] / (h[2] * h[2]), 0.058, 0.001, "PS-05: the error at the centre is 0.058 h^2");
}

/* PS-06: the amplitude of a sine in a periodic line, square and box; the reference ratios are those of one axis. */
static void test_sines(void)
{
	static struct pm_mg_record r;
	static const double ratio[2] = {1.0032189644401, 1.0530292875455};
	for (int dim = 1; dim <= 3; dim++)
		for (int q = 0; q < 2; q++) {
			int m = q ? 4 : 1;
			struct pm_grid g = grid(dim, (size_t[]){32, 32, 32}, (double[]){2 * pm_pi, 2 * pm_pi, 2 * pm_pi}, "pppppp");
			size_t n = pm_grid_size(&g), at = (size_t)(8 / m);
			double *s = values(n), *u = values(n);
			for (size_t p = 0; p < n; p++)
				s[p] = sin(m * g.h[0] * (double)(p % 32));
			struct pm_mg *mg = pm_mg_new(&g, 2);
			pm_mg_solve(mg, &(struct pm_mg_choice){.pre = 2, .post = 2, .cycle = PM_MG_FMG, .relaxation = 1, .tolerance = 1e-14, .most = 50}, -1,
				s, u, &r);
			char text[80];
			snprintf(text, sizeof text, "PS-06: %d-D, sin %dx is amplified by the inverse of the second difference", dim, m);
			check_near(u[at] * m * m, ratio[q], 1e-12, text);
			pm_mg_free(mg), pm_free(s), pm_free(u);
		}
}

static double factor(struct pm_grid g, int pre, int post, enum pm_mg_cycle cycle, double relaxation)
{
	return factor_of(g, 2, (struct pm_mg_choice){.pre = pre, .post = post, .cycle = cycle, .relaxation = relaxation});
}

static void test_factors(void)
{
	static const struct {
		int dim, pre, post;
		enum pm_mg_cycle cycle;
		double relaxation, want;
	} row[] = {{2, 1, 0, PM_MG_V, 1, 0.3532}, {2, 1, 1, PM_MG_V, 1, 0.1164}, {2, 2, 2, PM_MG_V, 1, 0.0614}, {2, 1, 0, PM_MG_W, 1, 0.2479},
		{2, 1, 1, PM_MG_W, 1, 0.0735}, {2, 2, 2, PM_MG_W, 1, 0.0406}, {3, 1, 1, PM_MG_V, 1, 0.2254}, {3, 2, 2, PM_MG_V, 1, 0.1125},
		{3, 1, 1, PM_MG_W, 1, 0.1930}, {3, 2, 2, PM_MG_W, 1, 0.0774}, {3, 1, 1, PM_MG_V, 1.15, 0.1188}, {3, 2, 2, PM_MG_V, 1.15, 0.0645}};
	for (size_t i = 0; i < sizeof row / sizeof *row; i++) {
		struct pm_grid g = row[i].dim == 2 ? cube(2, 256, "wwww") : cube(3, 64, "wwwwww");
		char text[120];
		snprintf(text, sizeof text, "PS-10: %s, %c(%d,%d), relaxation %g: %g per cycle", row[i].dim == 2 ? "256^2" : "64^3", "VW"[row[i].cycle],
			row[i].pre, row[i].post, row[i].relaxation, row[i].want);
		check_near(factor(g, row[i].pre, row[i].post, row[i].cycle, row[i].relaxation), row[i].want, 0.01, text); /* the reference's own +-0.01 */
	}
}

/* PS-10: u = x(1-x) y(1-y) exp(x-y) in the unit square; error of one pass of full multigrid against that of the differences. */
static void test_full(void)
{
	static struct pm_mg_record r;
	size_t n = 256, p = n + 1;
	struct pm_grid g = cube(2, n, "wwww");
	double *f = values(p * p), *exact = values(p * p), *u = values(p * p);
	for (size_t q = 0; q < p * p; q++) {
		double x = (double)(q % p) / (double)n, y = (double)(q / p) / (double)n, e = exp(x - y), a = x * (1 - x), b = y * (1 - y);
		exact[q] = a * b * e;
		f[q] = e * b * (a + 2 * (1 - 2 * x) - 2) + e * a * (b - 2 * (1 - 2 * y) - 2);
	}
	struct pm_mg *mg = pm_mg_new(&g, 2);
	pm_mg_solve(mg, &usual, 1, f, u, &r);
	double differences = largest(p * p, u, exact);
	check_near(differences, 5.222570e-07, 1e-3 * 5.22e-7, "PS-10: the error of the differences themselves");
	struct pm_mg_choice o = {.pre = 1, .post = 1, .cycle = PM_MG_FMG, .relaxation = 1, .tolerance = 0.9, .most = 5};
	pm_mg_start(mg, f, NULL);
	pm_mg_start_sources(mg);
	pm_mg_start_full(mg, &o);
	pm_mg_once(mg, &o);
	pm_mg_values(mg, u);
	check_near(largest(p * p, u, exact) / differences, 1.70, 0.17, "PS-10: one pass of full multigrid with V(1,1) leaves 1.70 times that error");
	bool good = pm_mg_solve(mg, &o, 1, f, u, &r) == 0;
	check(good && r.cycles == 1, "full multigrid with a loose tolerance is one pass (got %d cycles)", r.cycles);
	check(largest(p * p, u, exact) / differences < 1.87, "PS-10: so is what poisson-mg makes of it (got %.3f)", largest(p * p, u, exact) / differences);
	pm_mg_free(mg), pm_free(f), pm_free(exact), pm_free(u);
}

/* HC-23 */
static void test_singular(void)
{
	static struct pm_mg_record r;
	static const char *const faces[] = {"pppppp", "nnnnnn", "ppnnpp"};
	for (int q = 0; q < 3; q++) {
		struct pm_grid g = grid(3, (size_t[]){12, 9, 16}, (double[]){1, 2, 1.5}, faces[q]);
		size_t n = pm_grid_size(&g);
		double *s = values(n), *u = values(n), sum = 0, cells = 0, removed = 0;
		noise(n, s);
		for (size_t p = 0; p < n; p++)
			s[p] += 1;
		struct pm_mg *mg = pm_mg_new(&g, 2);
		bool good = pm_mg_solve(mg, &usual, 2.5, s, u, &r) == 0;
		for (size_t k = 0, p = 0; k < g.points[2]; k++)
			for (size_t j = 0; j < g.points[1]; j++)
				for (size_t i = 0; i < g.points[0]; i++, p++) {
					double w = pm_grid_weight(&g, i, j, k);
					sum += w * u[p], removed += w * s[p], cells += w;
				}
		check(good && r.singular, "HC-23: %s with a mean of about 1 converges", faces[q]);
		check_near(r.mean, removed / cells, 1e-13, "HC-23: the mean of s is removed and reported");
		check_near(sum / cells / largest(n, u, NULL), 0, 1e-12, "HC-23: the mean of phi is zero");
		pm_mg_free(mg), pm_free(s), pm_free(u);
	}
}

/* HC-24: sizes of every kind. */
static void test_sizes(void)
{
	static struct pm_mg_record r;
	static const size_t sizes[] = {1, 2, 3, 5, 7, 9, 17, 33, 65, 96, 97, 127, 129};
	for (int dim = 1; dim <= 3; dim++) {
		double worst = 0;
		int most = 0;
		for (size_t i = 0; i < sizeof sizes / sizeof *sizes; i++)
			for (int q = 0; q < 5 && (dim < 3 || sizes[i] < 66); q++) {
				char faces[8];
				snprintf(faces, sizeof faces, "%s%s%s", axis_faces[q], axis_faces[q], axis_faces[(q + 1) % 5]);
				struct pm_grid g = cube(dim, sizes[i], faces);
				double e = error(&g, low_modes, true, &usual, &r);
				check_worst(&worst, e);
				most = r.cycles > most ? r.cycles : most;
			}
		check(worst < 1e-9, "HC-24: %d-D, sizes 1 to 129, odd and even: the differences are solved (got %g, tolerance 1e-9)", dim, worst);
		check(most <= 18, "HC-24: %d-D, in at most 18 cycles (got %d)", dim, most);
	}
	struct pm_grid g = grid(3, (size_t[]){96, 64, 20}, (double[]){96, 64, 20}, "ppwwnn");
	double e = error(&g, low_modes, true, &usual, &r);
	check(e < 1e-9 && r.cycles <= 12, "HC-24: 96 x 64 x 20 converges (error %g, %d cycles)", e, r.cycles);
	g = grid(3, (size_t[]){33, 1, 20}, (double[]){1, 1, 1}, "wwpppp");
	check(error(&g, low_modes, true, &usual, &r) < 1e-9, "HC-24: one periodic cell along y makes it a plane problem");
}

/* HC-25: stretched cells. */
static void test_stretched(void)
{
	double worst = 0;
	for (int q = 0; q < 6; q++) {
		double ratio = (double[]){1.2, 1.4, 1.45, 3, 100, 1000}[q];
		check_worst(&worst, factor(grid(2, (size_t[]){64, 48}, (double[]){64 * ratio, 48}, "wwww"), 2, 2, PM_MG_V, 1));
		check_worst(&worst, factor(grid(2, (size_t[]){63, 64}, (double[]){63, 64 * ratio}, "wwnw"), 2, 2, PM_MG_V, 1));
		check_worst(&worst, factor(grid(3, (size_t[]){24, 20, 31}, (double[]){24, 20 * ratio, 31 * sqrt(ratio)}, "ppwwnn"), 2, 2, PM_MG_V, 1));
	}
	check(worst < 0.25, "HC-25: spacings in ratios from 1.2 to 1000 converge faster than 0.25 per cycle (got %.3f, demanded 0.5)", worst);
}

/* HC-28, and failures to converge. */
static void test_floor(void)
{
	static struct pm_mg_record r;
	struct pm_mg_choice o = usual;
	o.tolerance = 1e-18;
	for (int dim = 1; dim <= 3; dim++)
		for (int q = 0; q < 2; q++) {
			struct pm_grid g = cube(dim, dim == 3 ? 33 : 128, q ? "pppppp" : "wwnnww");
			double e = error(&g, low_modes, true, &o, &r);
			check(r.floor && r.converged && r.cycles < 50, "HC-28: %d-D, tolerance 1e-18 stops at round-off (after %d cycles)", dim, r.cycles);
			check(r.after < 1e-11 && e < 1e-11, "HC-28: %d-D, and the residual there is small (residual %g, error %g)", dim, r.after, e);
		}
	struct pm_grid g = cube(2, 64, "wwww");
	o.most = 2, o.tolerance = 1e-10;
	check(isnan(error(&g, low_modes, true, &o, &r)) && r.cycles == 2 && !r.converged, "two cycles are not enough, which is a failure");
	check(strstr(pm_message(), "did not converge: 2 cycles") && strstr(pm_message(), "--max-cycles"), "and the message has the remedy: %s", pm_message());
}

/* Cycles in single numbers with residuals in double ones, against cycles in double ones. */
static void test_single(void)
{
	static struct pm_mg_record r[2];
	const struct pm_grid grids[] = {grid(3, (size_t[]){56, 49, 60}, (double[]){1e-9, 1.2e-9, 1e-9}, "nnwwpp"), grid(2, (size_t[]){373, 380},
		(double[]){3e20, 1e20}, "pppp"), grid(3, (size_t[]){64, 64, 33}, (double[]){1, 1, 6}, "wwwnpp"), cube(1, 140000, "wn")};
	for (size_t i = 0; i < 4; i++) {
		const struct pm_grid *g = &grids[i];
		const size_t n = pm_grid_size(g);
		double *s = values(n), *phi[2] = {values(n), values(n)}, most;
		struct pm_mg *mg = pm_mg_new(g, 2);
		bool single[2];
		noise(n, s);
		for (int q = 0; q < 2; q++) {
			struct pm_mg_choice o = usual;
			o.cycle = q ? PM_MG_V : PM_MG_FMG, o.tolerance = 1e-12;
			single[q] = pm_mg_refines(mg, &o);
			if (pm_mg_solve(mg, &o, 1e25, s, phi[q], &r[q]))
				check(false, "%s", pm_message());
		}
		most = largest(n, phi[1], NULL);
		check(single[0] && !single[1], "%d-D, %zu cells: full multigrid refines, V-cycles do not", g->dim, g->cells[0]);
		/* noise has 1/sqrt(n) of f in the longest wave, where a residual of 1e-12 may be: 1e-12 sqrt(n) */
		check_near(largest(n, phi[0], phi[1]) / most, 0, i == 3 ? 1e-6 : 5e-10, "with the same solution");
		check(r[0].after <= fmax(1e-12, 2 * r[1].after), "and residual: %.1e, %.1e", r[0].after, r[1].after);
		check(r[0].cycles <= r[1].cycles + (i == 3 ? 8 : 1), "and no more cycles: %d, %d", r[0].cycles, r[1].cycles);
		struct pm_mg_choice again = usual;
		again.cycle = PM_MG_FMG, again.tolerance = 1e-12;
		check(!pm_mg_solve(mg, &again, 1e25, s, phi[1], &r[1]) && !memcmp(phi[0], phi[1], n * sizeof *s), "and the same bytes after another solve");
		memset(s, 0, n * sizeof *s);
		check(!pm_mg_solve(mg, &again, 1, s, phi[1], &r[1]) && largest(n, phi[1], NULL) == 0, "and no potential where there is no source");
		pm_mg_free(mg), pm_free(s), pm_free(phi[0]), pm_free(phi[1]);
	}
}

/* Where one round of cycles may do, phi is stored while the residual is found, unless it replaces s: the bytes of both ways, where one round does and where it
 * does not. */
static void test_once(void)
{
	static struct pm_mg_record r[2];
	const struct pm_grid grids[] = {cube(3, 55, "nnwwpp"), cube(3, 52, "wwppnn"), cube(2, 384, "wnnn")};
	for (size_t i = 0; i < 3; i++) {
		const size_t n = pm_grid_size(&grids[i]);
		double *s = values(n), *a = values(n), *b = values(n);
		bool same = true, scaled = true, one = true;
		for (int round = 0; round < 4; round++) {
			struct pm_mg_choice o = usual;
			o.pre = o.post = 1, o.tolerance = round % 2 ? 1e-5 : 0.9;
			pm_threads_use(1 + round / 2 * 2);
			struct pm_mg *mg = pm_mg_new(&grids[i], 2);
			one &= pm_mg_refines(mg, &o) && pm_mg_refines_once(mg, &o);
			noise(n, s), noise(n, a);
			same &= pm_mg_solve(mg, &o, 1, s, b, &r[0]) == pm_mg_solve(mg, &o, 1, a, a, &r[1]) && !memcmp(a, b, n * sizeof *a);
			same &= r[0].n == r[1].n && !memcmp(r[0].history, r[1].history, (size_t)r[0].n * sizeof(double)) && r[0].after == r[1].after;
			for (int e = -700; e <= 700 && round < 2; e += 1400) {
				pm_mg_solve(mg, &o, ldexp(1, e), s, b, &r[1]);
				for (size_t k = 0; k < n; k++)
					scaled &= b[k] == ldexp(a[k], e);
			}
			pm_mg_free(mg);
		}
		check(one && same, "%d-D, %zu cells: a solution stored with its residual has the bytes of one that replaces its source", grids[i].dim,
			grids[i].cells[0]);
		check(scaled, "and a factor of 2^-700 or 2^700 changes nothing but the factor");
		pm_free(s), pm_free(a), pm_free(b);
	}
	pm_threads_use(1);
}

static void test_scales(void)
{
	struct pm_grid g = grid(2, (size_t[]){24, 20}, (double[]){1, 1}, "wwnn");
	size_t n = pm_grid_size(&g);
	static struct pm_mg_record r;
	double *s = values(n), *a = values(n), *b = values(n), most = 0;
	noise(n, s);
	struct pm_mg *mg = pm_mg_new(&g, 2);
	pm_mg_solve(mg, &usual, 1, s, a, &r);
	for (int e = -900; e <= 900; e += 300) {
		pm_mg_solve(mg, &usual, ldexp(1, e), s, b, &r);
		for (size_t i = 0; i < n; i++)
			check_worst(&most, fabs(ldexp(b[i], -e) - a[i]));
	}
	check(most == 0, "a factor of 2^-900 to 2^900 changes nothing but the factor (got %g)", most);
	memset(s, 0, n * sizeof *s);
	check(pm_mg_solve(mg, &usual, 1, s, b, &r) == 0 && largest(n, b, NULL) == 0 && r.cycles == 0, "no source, no potential, no cycles");
	noise(n, s);
	pm_mg_solve(mg, &usual, 1, s, s, &r);
	check(!memcmp(s, a, n * sizeof *s), "the solution may replace its source, and does not depend on earlier solves");
	pm_mg_free(mg), pm_free(s), pm_free(a), pm_free(b);
}

/* The checksum of a solution with T threads. */
static uint32_t bytes(const struct pm_grid *g, int threads)
{
	static struct pm_mg_record r;
	size_t n = pm_grid_size(g);
	double *s = values(n);
	noise(n, s);
	pm_threads_use(threads);
	struct pm_mg *mg = pm_mg_new(g, 2);
	pm_mg_solve(mg, &usual, 1, s, s, &r);
	uint32_t crc = pm_crc32c(pm_crc32c(0, s, n * sizeof *s), r.history, (size_t)r.n * sizeof(double));
	pm_mg_free(mg), pm_free(s);
	return crc;
}

static void test_threads(void)
{
	const struct pm_grid grids[] = {cube(2, 384, "wwnn"), cube(2, 383, "pppp"), cube(3, 56, "pppppp"), cube(3, 55, "pppppp"), cube(3, 51, "wwppnn"),
		cube(3, 53, "nnwwpp")}; /* large enough for threads, see mg_parallel */
	for (size_t i = 0; i < sizeof grids / sizeof *grids; i++) {
		uint32_t one = bytes(&grids[i], 1);
		bool same = true;
		for (int t = 2; t <= 5; t++)
			same &= bytes(&grids[i], t) == one;
		check(same, "%d-D, %zu cells: phi and the residuals are the same bytes for 1, 2, 3, 4 and 5 threads", grids[i].dim, grids[i].cells[0]);
	}
	pm_threads_use(1);
}

/* The vector sweep in tiles against one node at a time, stage by stage. */
static void test_sweeps(void)
{
	const struct pm_grid grids[] = {cube(1, 100, "wn"), cube(2, 385, "pppp"), cube(2, 370, "nwwn"), cube(3, 53, "pppppp"), cube(3, 35, "pppppp"),
		cube(3, 54, "wnppnw")};
	static const enum mg_stage stages[4] = {MG_RED, MG_BLACK, MG_RED, MG_BLACK};
	for (size_t i = 0; i < sizeof grids / sizeof *grids; i++) {
		size_t n = pm_grid_size(&grids[i]);
		double *f = values(n), *u = values(n), *fast = values(n), *plain = values(n);
		noise(n, f);
		noise(n, u);
		struct pm_mg *mg = pm_mg_new(&grids[i], 2);
		pm_mg_start(mg, f, u); /* 53^3 and 385^2 are cut into tiles, the others are not */
		pm_mg_sweep(mg, 0, 1.1, 4, stages);
		pm_mg_values(mg, fast);
		pm_mg_start(mg, f, u);
		const struct mg_axis *z = &mg->level[0].axis[2];
		for (int s = 0; s < 4; s++)
			for (size_t k = 0; k < z->points; k++) {
				size_t plane = z->periodic ? (k + 1) % z->points : k; /* the seam last */
				if (plane >= z->first && plane < z->end)
					pm_mg_relax_plain(&mg->level[0], 1.1, s & 1, plane);
			}
		pm_mg_values(mg, plain);
		check(!memcmp(fast, plain, n * sizeof *fast) && memcmp(fast, u, n * sizeof *u),
			"%d-D, %zu cells: vector sweeps in tiles give the bytes of the plain loop", grids[i].dim, grids[i].cells[0]);
		pm_mg_free(mg), pm_free(f), pm_free(u), pm_free(fast), pm_free(plain);
	}
}

static double weighted(const struct mg_level *l, const double *a, const double *b) /* sum over unknowns of W a b */
{
	double sum = 0;
	for (size_t k = l->axis[2].first; k < l->axis[2].end; k++)
		for (size_t j = l->axis[1].first; j < l->axis[1].end; j++)
			for (size_t i = l->axis[0].first; i < l->axis[0].end; i++) {
				size_t at[3] = {i, j, k};
				double w = 1;
				for (int d = 0; d < 3; d++) {
					const struct mg_axis *x = &l->axis[d];
					w *= !x->periodic && (at[d] == 0 || at[d] + 1 == x->points) ? x->h / 2 : x->h;
				}
				size_t p = k * l->plane + j * l->stride + mg_slot(l, i);
				sum += w * a[p] * b[p];
			}
	return sum;
}

static void fill(const struct mg_level *l, double *a, uint64_t seed)
{
	memset(a, 0, mg_size(l) * sizeof *a);
	for (size_t k = l->axis[2].first; k < l->axis[2].end; k++)
		for (size_t j = l->axis[1].first; j < l->axis[1].end; j++)
			for (size_t i = l->axis[0].first; i < l->axis[0].end; i++) {
				double u[2];
				pm_random(seed, (k * l->axis[1].points + j) * l->axis[0].points + i, 0, u);
				a[k * l->plane + j * l->stride + mg_slot(l, i)] = u[0] - 0.5;
			}
}

/* Interpolated from 1 at every node, walls too: the largest difference from 1. */
static double constant_lost(struct pm_mg *mg, int level)
{
	struct mg_level *f = &mg->level[level], *c = f + 1;
	double most = 0;
	for (size_t i = 0; i < mg_size(c); i++)
		c->u[i] = 1;
	pm_mg_sweep(mg, level, 1, 2, (enum mg_stage[]){MG_ZERO, MG_CORRECT});
	for (size_t k = f->axis[2].first; k < f->axis[2].end; k++)
		for (size_t j = f->axis[1].first; j < f->axis[1].end; j++)
			for (size_t i = f->axis[0].first; i < f->axis[0].end; i++)
				check_worst(&most, fabs(f->u[k * f->plane + j * f->stride + mg_slot(f, i)] - 1));
	memset(c->u, 0, mg_size(c) * sizeof *c->u);
	return most;
}

/* Restriction is the transpose of interpolation in the scalar products of the two grids. */
static void test_adjoint(void)
{
	double worst = 0, constant = 0;
	for (int q = 0; q < 125; q++) {
		char faces[8];
		snprintf(faces, sizeof faces, "%s%s%s", axis_faces[q % 5], axis_faces[q / 5 % 5], axis_faces[q / 25]);
		struct pm_grid g = grid(3, (size_t[]){10 + (size_t)q % 7, 11, 8 + (size_t)q % 3}, (double[]){1, 1.5, 1.2}, faces);
		struct pm_mg *mg = pm_mg_new(&g, 2);
		for (int l = 0; l + 1 < mg->levels; l++) {
			struct mg_level *f = &mg->level[l], *c = f + 1;
			check_worst(&constant, constant_lost(mg, l));
			fill(f, f->f, 1);
			fill(c, c->u, 2);
			pm_mg_sweep(mg, l, 1, 2, (enum mg_stage[]){MG_ZERO, MG_CORRECT});
			double up = weighted(f, f->f, f->u), size = sqrt(weighted(f, f->f, f->f) * weighted(f, f->u, f->u));
			pm_mg_sweep(mg, l, 1, 1, (enum mg_stage[]){MG_ZERO}); /* the residual is f */
			pm_mg_restrict(mg, l, false);
			check_worst(&worst, fabs(up - weighted(c, c->f, c->u)) / fmax(size, 1e-300));
		}
		pm_mg_free(mg);
	}
	check(constant < 1e-15, "interpolation keeps a constant on every level of every mixture of faces (got %g, tolerance 1e-15)", constant);
	check(worst < 1e-14, "restriction and interpolation are adjoint on every level of every mixture of faces (got %g, tolerance 1e-14)", worst);
}

int main(void)
{
	pm_threads_use(1); /* small grids; test_threads goes through the others */
	test_sweeps();
	test_adjoint();
	test_mixtures();
	test_square();
	test_sines();
	test_factors();
	test_full();
	test_singular();
	test_sizes();
	test_stretched();
	test_floor();
	test_single();
	test_once();
	test_scales();
	test_threads();
	return check_done();
}
