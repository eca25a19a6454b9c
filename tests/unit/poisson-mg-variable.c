/* Multigrid with a coefficient that varies: effective conductivities, manufactured solutions, jumps, sizes, threads.
 * SPDX-License-Identifier: GPL-3.0-or-later */
#include <stdlib.h>
#include <string.h>

#include "mg-problem.h"
#include "poisson-mg/mg-variable.h"

static const struct pm_mg_choice usual = {.pre = 1, .post = 1, .smoother = PM_MG_RED_BLACK, .cycle = PM_MG_FMG, .relaxation = 1, .tolerance = 1e-11,
	.most = 60};
static const char *const axis_faces[5] = {"pp", "ww", "nn", "wn", "nw"};

/* The conductivity of a periodic unit square of eps under a mean gradient along x: chi from div(eps (grad chi + e_x)) = 0, then the mean flux. */
static double effective(size_t n, const double *eps, enum pm_mg_mean mean, const struct pm_mg_choice *o, struct pm_mg_record *r)
{
	struct pm_grid g = cube(2, n, "pppp");
	double *s = values(n * n), *chi = values(n * n), flux = 0;
	for (size_t q = 0; q < n * n; q++) {
		size_t row = q / n * n, i = q % n;
		s[q] = -(double)n * (pm_mg_face(mean, eps[q], eps[row + (i + 1) % n]) - pm_mg_face(mean, eps[row + (i + n - 1) % n], eps[q]));
	}
	struct pm_mg_variable *v = pm_mg_variable_new(&g, eps, mean);
	int status = pm_mg_variable_solve(v, o, 1, s, chi, r);
	for (size_t q = 0; q < n * n; q++) {
		size_t next = q / n * n + (q + 1) % n;
		flux += pm_mg_face(mean, eps[q], eps[next]) * (1 + (chi[next] - chi[q]) * (double)n) / (double)(n * n);
	}
	pm_mg_variable_free(v), pm_free(s), pm_free(chi);
	return status ? NAN : flux;
}

/* contrast > 0: a disc of half the area; < 0: a checkerboard of 2 x 2 fields. */
static double *medium(size_t n, double contrast)
{
	double *eps = values(n * n), radius2 = 0.5 / pm_pi;
	for (size_t q = 0; q < n * n; q++) {
		double x = ((double)(q % n) + 0.5) / (double)n - 0.5, y = ((double)(q / n) + 0.5) / (double)n - 0.5;
		eps[q] = contrast < 0 ? ((x < 0) == (y < 0) ? -contrast : 1) : x * x + y * y < radius2 ? contrast : 1;
	}
	return eps;
}

/* PS-08 and HC-26 */
static void test_media(void)
{
	static struct pm_mg_record r;
	static const struct {
		const char *what;
		double contrast;
		size_t n;
		enum pm_mg_mean mean;
		double same, within; /* the reference's value of the same scheme, 1e-3 of it */
		double exact, part;  /* and its allowed distance from the exact value; 0: not tested */
	} row[] = {{"discs of contrast 10", 10, 64, PM_MG_HARMONIC, 2.4104, 1e-3, 2.41546738018724, 0},
		{"discs of contrast 10", 10, 256, PM_MG_HARMONIC, 2.4154, 1e-3, 2.41546738018724, 0.01},
		{"discs of contrast 10", 10, 256, PM_MG_ARITHMETIC, 2.4339, 1e-3, 2.41546738018724, 0.04},
		{"discs of contrast 1e6", 1e6, 128, PM_MG_HARMONIC, 3.0999, 1e-3, 3.0801890030284, 0},
		{"discs of contrast 1e6", 1e6, 256, PM_MG_HARMONIC, 3.0835, 1e-3, 3.0801890030284, 0.005},
		{"discs of contrast 1e6", 1e6, 256, PM_MG_ARITHMETIC, 3.1281, 1e-3, 3.0801890030284, 0},
		{"a checkerboard 1:4", -4, 256, PM_MG_HARMONIC, 1.9979, 1e-3, 2, 0.003},
		{"a checkerboard 1:4", -4, 256, PM_MG_ARITHMETIC, 2.0096, 1e-3, 2, 0},
		{"a checkerboard 1:10", -10, 256, PM_MG_HARMONIC, 3.1151, 1e-3, 3.16227766016838, 0.02},
		{"a checkerboard 1:1e4", -1e4, 256, PM_MG_HARMONIC, 7.8752, 1e-3, 100, 0},
		{"a checkerboard 1:1e4", -1e4, 256, PM_MG_ARITHMETIC, 1214.36, 1e-3, 100, 0}};
	double checker[2] = {0};
	for (size_t q = 0; q < sizeof row / sizeof *row; q += check_sanitized() ? 5 : 1) { /* 0, 5, 10: both means, discs and fields */
		double *eps = medium(row[q].n, row[q].contrast);
		struct pm_mg_choice o = usual;
		o.tolerance = 1e-8;
		double got = effective(row[q].n, eps, row[q].mean, &o, &r);
		const char *mean = pm_mg_mean_names[row[q].mean];
		check(fabs(got - row[q].same) <= row[q].within * row[q].same, "PS-08: %s, %zu^2, %s means conduct %.5g (got %.6g, tolerance 0.1 %%)",
			row[q].what, row[q].n, mean, row[q].same, got);
		if (row[q].part > 0)
			check(fabs(got - row[q].exact) <= row[q].part * row[q].exact, "HC-26: %s, %s means: within %g %% of the exact %.6g (got %.6g)",
				row[q].what, mean, 100 * row[q].part, row[q].exact, got);
		check(r.cycles < 60, "HC-26: %s, %s means: fewer than 60 iterations to 1e-8 (got %d)", row[q].what, mean, r.cycles);
		double worst = 0; /* over five iterations: the residual of conjugate gradients need not fall in each */
		for (int i = 5; i < r.n; i++)
			check_worst(&worst, r.history[i] / r.history[i - 5]);
		check(worst < 0.5, "HC-26: %s, %s means: the residual never stagnates (over five iterations it falls to %.2g at most)", row[q].what, mean,
			worst);
		if (row[q].contrast == -1e4)
			checker[row[q].mean] = got;
		pm_free(eps);
	}
	check(check_sanitized() || (checker[0] < 100 && checker[1] > 100),
		"HC-26: harmonic and arithmetic means bracket the exact 100 of the checkerboard 1:1e4 (%.4g, %.5g)",
		checker[0], checker[1]);
}

/* With eps = 3 it is Poisson's equation, for every mixture of faces and sizes that do not halve. */
static void test_constant(void)
{
	static struct pm_mg_record r;
	static const size_t sizes[4][3] = {{12, 18, 10}, {13, 7, 11}, {1, 2, 3}, {5, 3, 2}};
	struct pm_mg_choice o = usual;
	for (int dim = 1; dim <= 3; dim++) {
		double worst = 0;
		int most = 0;
		for (int q = 0; q < 4 * (dim == 3 ? 125 : dim == 2 ? 25 : 5); q += dim == 3 && check_sanitized() ? 7 : 1) {
			char faces[8];
			snprintf(faces, sizeof faces, "%s%s%s", axis_faces[q / 4 % 5], axis_faces[q / 20 % 5], axis_faces[q / 100]);
			struct pm_grid g = grid(dim, sizes[q % 4], (double[]){1.1, 1.3, 0.9}, faces);
			size_t n = pm_grid_size(&g);
			double *s = values(n), *a = values(n), *b = values(n), *eps = values(n);
			noise(n, s);
			for (size_t p = 0; p < n; p++)
				eps[p] = 3;
			struct pm_mg *mg = pm_mg_new(&g, 2);
			struct pm_mg_variable *v = pm_mg_variable_new(&g, eps, PM_MG_HARMONIC);
			bool good = mg && v && !pm_mg_solve(mg, &o, 1, s, a, &r) && !pm_mg_variable_solve(v, &o, 3, s, b, &r);
			check_worst(&worst, good ? largest(n, a, b) / fmax(1e-3, largest(n, a, NULL)) : INFINITY);
			most = r.cycles > most ? r.cycles : most;
			pm_mg_free(mg), pm_mg_variable_free(v), pm_free(s), pm_free(a), pm_free(b), pm_free(eps);
		}
		check(worst < 1e-8, "%d-D: a constant coefficient gives the result of poisson-mg without one, every mixture of faces, odd, prime and tiny "
			"sizes (got %g, tolerance 1e-8)", dim, worst);
		check(most <= 15, "%d-D: in at most 15 iterations (got %d)", dim, most);
	}
}

/* u = X(x) Y(y) Z(z) with faces as in poisson-mg-order, eps = exp(sum a_d x_d): s = eps (lap u + a.grad u). */
static void profile(int face, double x, double v[3])
{
	double y = face == 4 ? 1 - x : x, e = exp(y), a = 2 * pm_pi;
	if (face == 0)
		v[0] = sin(a * x), v[1] = a * cos(a * x), v[2] = -a * a * v[0];
	else if (face == 1)
		v[0] = x * (1 - x) * e, v[1] = (1 - x - x * x) * e, v[2] = -x * (3 + x) * e;
	else if (face == 2)
		v[0] = (-x * x + 3 * x - 3) * e, v[1] = x * (1 - x) * e, v[2] = (1 - x - x * x) * e;
	else
		v[0] = (2 - y) * e - 2, v[1] = (face == 4 ? -1 : 1) * (1 - y) * e, v[2] = -y * e;
}

static double manufactured(int dim, const int face[3], size_t n)
{
	static struct pm_mg_record r;
	char faces[8];
	snprintf(faces, sizeof faces, "%s%s%s", axis_faces[face[0]], axis_faces[face[1]], axis_faces[face[2]]);
	struct pm_grid g = cube(dim, n, faces);
	size_t size = pm_grid_size(&g);
	double *s = values(size), *u = values(size), *exact = values(size), *eps = values(size), mean[2] = {0}, weight = 0, most = 0, e = 0;
	for (size_t p = 0; p < size; p++) {
		size_t at[3] = {p % g.points[0], p / g.points[0] % g.points[1], p / g.points[0] / g.points[1]};
		double v[3][3] = {{1, 0, 0}, {1, 0, 0}, {1, 0, 0}}, slope[3] = {0}, log_eps = 0;
		for (int d = 0; d < dim; d++) {
			double x = (double)at[d] / (double)n, a = 2 * pm_pi;
			profile(face[d], x, v[d]);
			log_eps += face[d] ? (d + 1) * x : sin(a * x);
			slope[d] = face[d] ? d + 1 : a * cos(a * x);
		}
		eps[p] = exp(log_eps);
		exact[p] = v[0][0] * v[1][0] * v[2][0];
		for (int d = 0; d < dim; d++)
			s[p] += eps[p] * (v[d][2] + slope[d] * v[d][1]) * v[(d + 1) % 3][0] * v[(d + 2) % 3][0];
	}
	struct pm_mg_variable *m = pm_mg_variable_new(&g, eps, PM_MG_HARMONIC);
	bool good = m && !pm_mg_variable_solve(m, &usual, 1, s, u, &r);
	for (size_t p = 0; p < size && r.singular; p++) {
		double w = pm_grid_weight(&g, p % g.points[0], p / g.points[0] % g.points[1], p / g.points[0] / g.points[1]);
		weight += w, mean[0] += w * u[p], mean[1] += w * exact[p];
	}
	for (size_t p = 0; p < size; p++) {
		check_worst(&most, fabs(exact[p]));
		check_worst(&e, fabs(u[p] - exact[p] - (r.singular ? (mean[0] - mean[1]) / weight : 0)));
	}
	pm_mg_variable_free(m), pm_free(s), pm_free(u), pm_free(exact), pm_free(eps);
	return good ? e / most : NAN;
}

static void test_orders(void)
{
	for (int dim = 1; dim <= 3; dim++) {
		const int step = dim < 3 || getenv("PM_LONG") ? 1 : check_sanitized() ? 23 : 7;
		double least = 9;
		for (int q = 0; q < (dim == 3 ? 125 : dim == 2 ? 25 : 5); q += step) {
			int face[3] = {q % 5, q / 5 % 5, q / 25};
			double sx = 0, sy = 0, sxx = 0, sxy = 0;
			for (int i = 0; i < 3; i++) {
				size_t n = (size_t[]){12, 18, 27}[i] * (dim == 3 ? 1 : 2);
				double x = -log((double)n), y = log(manufactured(dim, face, n));
				sx += x, sy += y, sxx += x * x, sxy += x * y;
			}
			double order = (3 * sxy - sx * sy) / (3 * sxx - sx * sx);
			check_least(&least, order); /* a failure to solve is NaN, and is kept */
		}
		check(least >= 1.9, "%d-D: a coefficient that varies smoothly by exp(%d), %s mixture of faces: orders fitted over three grids are at least "
			"%.2f", dim, dim * (dim + 1) / 2, step == 23 ? "every 23rd" : step > 1 ? "every seventh" : "every", least);
	}
}

/* Layers along x: with harmonic means the potential of a plane capacitor is exact at the nodes when the jump lies between them. */
static void test_layers(void)
{
	static struct pm_mg_record r;
	enum { n = 40 };
	struct pm_grid g = grid(1, (size_t[]){n, 1, 1}, (double[]){1, 1, 1}, "ww");
	double eps[n + 1], s[n + 1] = {0}, u[n + 1], worst = 0;
	for (int i = 0; i <= n; i++)
		eps[i] = i < 20 ? 1 : 1e6;
	s[10] = n; /* a charged sheet of 1: its field splits by the two capacities between it and the walls */
	double left = 0.25, right = 9.5 / n + 0.5 / n * 1 + 20. / n / 1e6 - 0.5 / n * (1 - 1e-6), top = 1 / (1 / left + 1 / right);
	struct pm_mg_variable *v = pm_mg_variable_new(&g, eps, PM_MG_HARMONIC);
	pm_mg_variable_solve(v, &(struct pm_mg_choice){.pre = 1, .post = 1, .cycle = PM_MG_V, .relaxation = 1, .tolerance = 1e-13, .most = 50}, -1, s, u, &r);
	for (int i = 0; i <= 10; i++)
		check_worst(&worst, fabs(u[i] - top * i / 10.));
	check(worst < 1e-11, "a charged sheet before a layer of 1e6: the potential is exact at the nodes (got %g, tolerance 1e-11)", worst);
	pm_mg_variable_free(v);
}

/* Discs, balls and noise of contrast 1e6 with every kind of face, stretched cells, sizes of all kinds. */
static void test_hard(void)
{
	static struct pm_mg_record r;
	static const struct {
		int dim;
		size_t cells[3];
		double ratio[3];
	} row[] = {{2, {64, 64, 1}, {1, 1, 1}}, {2, {97, 127, 1}, {1, 1, 1}}, {2, {65, 33, 1}, {1, 1000, 1}}, {2, {60, 64, 1}, {1000, 1, 1}},
		{3, {32, 32, 32}, {1, 1, 1}}, {3, {31, 20, 7}, {1, 1, 1}}, {3, {17, 24, 19}, {1, 100, 1000}}};
	struct pm_mg_choice o = usual;
	o.tolerance = 1e-8, o.cycle = PM_MG_V, o.pre = o.post = 2, o.most = 100;
	for (size_t q = 0; q < sizeof row / sizeof *row; q++) {
		int most[2] = {0}, failed = 0;
		for (int f = 0; f < 5; f += check_sanitized() ? 4 : 2)
			for (int kind = 0; kind < 2; kind++) {
				char faces[8];
				double l[3];
				snprintf(faces, sizeof faces, "%s%s%s", axis_faces[f], axis_faces[(f + 1) % 5], axis_faces[(f + 3) % 5]);
				for (int d = 0; d < 3; d++)
					l[d] = row[q].ratio[d] * (double)row[q].cells[d];
				struct pm_grid g = grid(row[q].dim, row[q].cells, l, faces);
				size_t n = pm_grid_size(&g);
				double *s = values(n), *u = values(n), *eps = values(n);
				noise(n, s);
				noise(n, eps);
				for (size_t p = 0; p < n; p++) {
					double x = 0;
					size_t at[3] = {p % g.points[0], p / g.points[0] % g.points[1], p / g.points[0] / g.points[1]};
					for (int d = 0; d < g.dim; d++)
						x += pow(((double)at[d] / (double)g.cells[d] - 0.5), 2);
					eps[p] = kind ? pow(10, 6 * eps[p]) : x < 0.1 ? 1e6 : 1;
				}
				struct pm_mg_variable *v = pm_mg_variable_new(&g, eps, PM_MG_HARMONIC);
				failed += !v || pm_mg_variable_solve(v, &o, 1, s, u, &r) != 0;
				most[kind] = r.cycles > most[kind] ? r.cycles : most[kind];
				pm_mg_variable_free(v), pm_free(s), pm_free(u), pm_free(eps);
			}
		check(!failed && most[0] <= 20 && most[1] < 100,
			"HC-26: %zu x %zu x %zu, spacings 1:%g:%g, three kinds of faces: balls of contrast 1e6 take at most 20 iterations, noise "
			"of contrast 1e6 fewer than 100, to 1e-8 or round-off (got %d, %d, %d failed)", row[q].cells[0], row[q].cells[1], row[q].cells[2],
				row[q].ratio[1] / row[q].ratio[0],
			row[q].ratio[2] / row[q].ratio[0], most[0], most[1], failed);
	}
}

/* HC-23, HC-28, and errors. */
static void test_ends(void)
{
	static struct pm_mg_record r;
	enum { n = 48 };
	double *eps = medium(n, 1e6), *s = values(n * n), *u = values(n * n);
	struct pm_grid g = cube(2, n, "pppp");
	struct pm_mg_choice o = usual;
	noise(n * n, s);
	for (size_t p = 0; p < n * n; p++)
		s[p] += 1;
	struct pm_mg_variable *v = pm_mg_variable_new(&g, eps, PM_MG_HARMONIC);
	int status = pm_mg_variable_solve(v, &o, 1, s, u, &r);
	check(!status && r.singular && fabs(r.mean - pm_sum_array(n * n, s) / (n * n)) < 1e-13,
		"HC-23: variable coefficient: the mean of s is removed and reported");
	check(fabs(pm_sum_array(n * n, u)) / (n * n) < 1e-12 * largest(n * n, u, NULL), "HC-23: variable coefficient: the mean of phi is zero");
	o.tolerance = 1e-18;
	status = pm_mg_variable_solve(v, &o, 1, s, u, &r);
	check(!status && r.floor && r.cycles < 50 && r.after < 1e-11,
		"HC-28: variable coefficient: tolerance 1e-18 stops at round-off (after %d iterations, residual %.1e)", r.cycles, r.after);
	o.tolerance = 1e-10, o.most = 2;
	status = pm_mg_variable_solve(v, &o, 1, s, u, &r);
	check(status == -PM_NUMERICS && strstr(pm_message(), "did not converge: 2 cycles"), "too few iterations are a failure with the history: %s",
		pm_message());
	pm_mg_variable_free(v);
	eps[77] = 0;
	v = pm_mg_variable_new(&g, eps, PM_MG_HARMONIC);
	check(!v && strstr(pm_message(), "must be positive everywhere, and at node 29,1,0 it is 0"), "a coefficient of zero is refused: %s", pm_message());
	pm_mg_variable_free(v), pm_free(eps), pm_free(s), pm_free(u);
}

static uint32_t bytes(const struct pm_grid *g, int threads)
{
	static struct pm_mg_record r;
	size_t n = pm_grid_size(g);
	double *s = values(n), *eps = values(n);
	noise(n, s);
	for (size_t p = 0; p < n; p++)
		eps[p] = exp(9 * s[p]);
	pm_threads_use(threads);
	struct pm_mg_choice o = usual;
	o.tolerance = 1e-6;
	struct pm_mg_variable *v = pm_mg_variable_new(g, eps, PM_MG_HARMONIC);
	pm_mg_variable_solve(v, &o, 1, s, s, &r);
	uint32_t crc = pm_crc32c(pm_crc32c(0, s, n * sizeof *s), r.history, (size_t)r.n * sizeof(double));
	pm_mg_variable_free(v), pm_free(s), pm_free(eps);
	return crc;
}

static void test_threads(void)
{
	const struct pm_grid grids[] = {cube(2, 260, "wwnn"), cube(2, 259, "pppp"), cube(3, 41, "pppppp"), cube(3, 42, "wnppnn")};
	for (size_t i = 0; i < sizeof grids / sizeof *grids; i += check_sanitized() ? 3 : 1) { /* 0, 3: a plane and a box */
		uint32_t one = bytes(&grids[i], 1);
		bool same = true;
		for (int t = 2; t <= 5; t += check_sanitized() ? 3 : 1)
			same &= bytes(&grids[i], t) == one;
		check(same, "%d-D, %zu cells, variable coefficient: the same bytes for 1 to 5 threads", grids[i].dim, grids[i].cells[0]);
	}
	pm_threads_use(1);
}

int main(void)
{
	test_constant();
	test_orders();
	test_layers();
	test_media();
	test_hard();
	test_ends();
	test_threads();
	return check_done();
}
