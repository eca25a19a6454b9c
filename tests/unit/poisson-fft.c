/* The transform solver against independent direct solves: dense sine and cosine bases, direct sums, the stencils themselves.
 * SPDX-License-Identifier: GPL-3.0-or-later */
#include <gsl/gsl_sf_expint.h>
#include <stdlib.h>
#include <string.h>

#include "check.h"
#include "poisson-fft/poisson-fft.h"

static struct pm_grid grid(int dim, size_t nx, size_t ny, size_t nz, enum pm_face fx, enum pm_face fy, enum pm_face fz)
{
	struct pm_grid g = {.dim = dim, .cells = {nx, ny, nz}, .h = {0.7, 0.55, 1.3}, .lo = {-1, 2, 0.3}};
	enum pm_face face[3] = {fx, fy, fz};
	for (int d = 0; d < 3; d++) {
		if (d >= dim)
			g.cells[d] = 1, g.h[d] = 1, face[d] = PM_PERIODIC, g.lo[d] = 0;
		g.face[d][0] = g.face[d][1] = face[d];
		g.points[d] = g.cells[d] + (face[d] != PM_PERIODIC);
	}
	return g;
}

static double *noise(size_t n)
{
	double *s = malloc(n * sizeof *s), u[2];
	for (size_t i = 0; i < n; i++) {
		pm_random(2385, i, 7, u);
		s[i] = u[0] - 0.3;
	}
	return s;
}

static double removed; /* of the last solve: |mean| over the largest |s| */

/* The largest |phi| is known from the last pass, but on a line. */
static bool most_is(double most, const struct pm_grid *g, const double *phi)
{
	double largest = 0;
	for (size_t i = 0; i < pm_grid_size(g); i++)
		largest = isfinite(phi[i]) ? fmax(largest, fabs(phi[i])) : INFINITY;
	return isnan(most) ? g->dim == 1 : most == largest;
}

static double solve(const struct pm_grid *g, enum pm_symbol symbol, double c, const double *s, double *phi)
{
	struct pm_poisson_fft_record r = {NAN, NAN, NAN};
	struct pm_poisson_fft *p = pm_poisson_fft_new(g, &(struct pm_poisson_fft_choice){.symbol = symbol});
	if (!p || pm_poisson_fft_solve(p, c, s, phi, &r))
		check(false, "the solver runs (%s)", pm_message());
	pm_poisson_fft_free(p);
	if (!most_is(r.most, g, phi))
		check(false, "dim %d, %zux%zux%zu: the largest |phi| is %g", g->dim, g->cells[0], g->cells[1], g->cells[2], r.most);
	removed = r.incompatible;
	return r.mean;
}

static void between(struct pm_grid *g, int d, enum pm_face below, enum pm_face above)
{
	g->face[d][0] = below, g->face[d][1] = above;
}

/* Orthonormal basis of an axis (rows: modes) in the inner product with half weight at the ends, its weights and eigenvalues. */
static size_t basis(const struct pm_grid *g, int d, enum pm_symbol symbol, double *b, double *weight, double *lambda)
{
	size_t n = g->cells[d], points = g->points[d], modes = 0;
	enum pm_face below = g->face[d][0], above = g->face[d][1];
	double period = below == PM_PERIODIC ? (double)n : 2.0 * (double)n, shift = below == above ? 0 : 0.5;
	for (size_t i = 0; i < points; i++)
		weight[i] = (below == PM_NEUMANN && i == 0) || (above == PM_NEUMANN && i == n) ? 0.5 : 1;
	for (int odd = 0; odd < 2; odd++)
		for (size_t m = 0; 2.0 * ((double)m + shift) <= period; m++) {
			double norm = 0, *row = b + modes * points;
			for (size_t i = 0; i < points; i++) {
				double turn = fmod(((double)m + shift) * (double)i, period) / period; /* reduced, so that the argument is exact */
				row[i] = odd ? sin(2 * pm_pi * turn) : cos(2 * pm_pi * turn);
				norm += weight[i] * row[i] * row[i];
			}
			if (norm < 1e-10 || (below == PM_WALL && !odd) || (below == PM_NEUMANN && odd))
				continue;
			for (size_t i = 0; i < points; i++)
				row[i] /= sqrt(norm);
			double k = 2 * pm_pi * ((double)m + shift) / (period * g->h[d]), h2 = g->h[d] * g->h[d], s[4] = {0};
			for (int q = 1; q <= 3; q++) /* 1 - cos(q t) = 2 sin^2(q t/2), without the cancellation */
				s[q] = 2 * pow(sin(0.5 * q * k * g->h[d]), 2);
			lambda[modes++] = symbol == PM_SPECTRAL ? -k * k : symbol == PM_FD2 ? -2 * s[1] / h2 :
				symbol == PM_FD4 ? -(32 * s[1] - 2 * s[2]) / (12 * h2) : -(540 * s[1] - 54 * s[2] + 4 * s[3]) / (180 * h2);
		}
	return modes;
}

/* out[m] = sum_i b[m][i] weight[i] in[i] along axis d, or the transpose where there are no weights (NULL). */
static void along(const size_t size[3], int d, size_t modes, size_t points, const double *b, const double *weight, const double *in, double *out)
{
	const bool back = !weight;
	size_t from = back ? modes : points, to = back ? points : modes, stride = 1, outer = 1;
	for (int e = 0; e < 3; e++)
		*(e < d ? &stride : &outer) *= e == d ? 1 : size[e];
	for (size_t o = 0; o < outer; o++)
		for (size_t t = 0; t < to; t++)
			for (size_t q = 0; q < stride; q++) {
				double sum = 0;
				for (size_t f = 0; f < from; f++)
					sum += (back ? b[f * points + t] : b[t * points + f] * weight[f]) * in[(o * from + f) * stride + q];
				out[(o * to + t) * stride + q] = sum;
			}
}

/* Direct solve by dense bases, axis by axis. */
static void direct(const struct pm_grid *g, enum pm_symbol symbol, double c, const double *s, double *phi)
{
	size_t total = pm_grid_size(g), size[3], modes[3];
	double *b[3], *w[3], *lambda[3], *a = malloc(total * sizeof *a), *t = malloc(total * sizeof *t);
	memcpy(a, s, total * sizeof *a);
	memcpy(size, g->points, sizeof size);
	for (int d = 0; d < 3; d++) {
		size_t p = g->points[d];
		b[d] = malloc((p + 2) * p * sizeof(double));
		w[d] = malloc(p * sizeof(double));
		lambda[d] = malloc((p + 2) * sizeof(double));
		modes[d] = basis(g, d, symbol, b[d], w[d], lambda[d]);
		along(size, d, modes[d], p, b[d], w[d], a, t);
		size[d] = modes[d];
		memcpy(a, t, total * sizeof *a);
	}
	for (size_t k = 0, i = 0; k < modes[2]; k++)
		for (size_t j = 0; j < modes[1]; j++)
			for (size_t m = 0; m < modes[0]; m++, i++) {
				double l = lambda[0][m] + lambda[1][j] + lambda[2][k];
				a[i] = l < 0 ? c * a[i] / l : 0;
			}
	for (int d = 0; d < 3; d++) {
		along(size, d, modes[d], g->points[d], b[d], NULL, a, t);
		size[d] = g->points[d];
		memcpy(a, t, total * sizeof *a);
		free(b[d]), free(w[d]), free(lambda[d]);
	}
	memcpy(phi, a, total * sizeof *phi);
	free(a), free(t);
}

static double difference(size_t n, const double *a, const double *b)
{
	double most = 0, scale = 1e-300;
	for (size_t i = 0; i < n; i++) {
		check_worst(&most, fabs(a[i] - b[i]));
		check_worst(&scale, fabs(b[i]));
	}
	return most / scale;
}

static void against_direct(struct pm_grid g, const char *what)
{
	size_t n = pm_grid_size(&g);
	double *s = noise(n), *phi = malloc(n * sizeof *phi), *want = malloc(n * sizeof *want), worst = 0;
	for (int symbol = PM_SPECTRAL; symbol <= PM_FD6; symbol++) {
		solve(&g, symbol, -2.385, s, phi);
		direct(&g, symbol, -2.385, s, want);
		double e = difference(n, phi, want);
		check_worst(&worst, e);
	}
	char name[160];
	snprintf(name, sizeof name, "HC-24: %s equals a direct solve, every symbol", what);
	check_near(worst, 0, 1e-12, name); /* case HC-24 needs 1e-12 */
	free(s), free(phi), free(want);
}

static void sizes(void)
{
	static const size_t awkward[] = {1, 2, 3, 5, 7, 33, 97, 127, 257};
	char what[100];
	for (size_t i = 0; i < sizeof awkward / sizeof *awkward; i++)
		for (enum pm_face f = PM_PERIODIC; f <= PM_NEUMANN; f++) {
			if (f == PM_OPEN)
				continue;
			snprintf(what, sizeof what, "1-D %s n=%zu", pm_face_names[f], awkward[i]);
			against_direct(grid(1, awkward[i], 1, 1, f, f, f), what);
			if (f == PM_PERIODIC)
				continue;
			enum pm_face other = f == PM_WALL ? PM_NEUMANN : PM_WALL;
			struct pm_grid g = grid(1, awkward[i], 1, 1, f, 0, 0);
			between(&g, 0, f, other);
			snprintf(what, sizeof what, "1-D %s below, %s above, n=%zu", pm_face_names[f], pm_face_names[other], awkward[i]);
			against_direct(g, what);
		}
	struct pm_grid g = grid(2, 33, 7, 1, PM_WALL, PM_PERIODIC, 0);
	between(&g, 0, PM_WALL, PM_NEUMANN);
	against_direct(g, "2-D wall-neumann x periodic 33x7");
	g = grid(2, 12, 19, 1, PM_WALL, PM_NEUMANN, 0);
	between(&g, 1, PM_NEUMANN, PM_WALL);
	against_direct(g, "2-D wall x neumann-wall 12x19");
	g = grid(3, 16, 17, 9, PM_WALL, PM_WALL, PM_WALL);
	between(&g, 0, PM_NEUMANN, PM_WALL), between(&g, 1, PM_WALL, PM_NEUMANN), between(&g, 2, PM_NEUMANN, PM_WALL);
	against_direct(g, "3-D neumann-wall x wall-neumann x neumann-wall 16x17x9");
	g = grid(3, 9, 6, 17, PM_PERIODIC, PM_NEUMANN, PM_WALL);
	between(&g, 2, PM_WALL, PM_NEUMANN);
	against_direct(g, "3-D periodic x neumann x wall-neumann 9x6x17");
	against_direct(grid(2, 33, 7, 1, PM_PERIODIC, PM_PERIODIC, 0), "2-D periodic 33x7");
	against_direct(grid(2, 20, 1, 1, PM_PERIODIC, PM_PERIODIC, 0), "2-D periodic 20x1");
	against_direct(grid(2, 1, 37, 1, PM_PERIODIC, PM_NEUMANN, 0), "2-D periodic x neumann 1x37");
	against_direct(grid(2, 19, 32, 1, PM_WALL, PM_PERIODIC, 0), "2-D wall x periodic 19x32");
	against_direct(grid(3, 96, 64, 20, PM_PERIODIC, PM_PERIODIC, PM_PERIODIC), "3-D periodic 96x64x20");
	against_direct(grid(3, 16, 9, 32, PM_PERIODIC, PM_PERIODIC, PM_PERIODIC), "3-D periodic 16x9x32, frequencies 0 and 8 share a place");
	against_direct(grid(2, 32, 64, 1, PM_PERIODIC, PM_PERIODIC, 0), "2-D periodic 32x64, likewise");
	against_direct(grid(3, 16, 5, 2, PM_PERIODIC, PM_PERIODIC, PM_PERIODIC), "3-D periodic 16x5x2, likewise");
	against_direct(grid(1, 48, 1, 1, PM_PERIODIC, 0, 0), "1-D periodic 48, likewise");
	against_direct(grid(3, 16, 1, 9, PM_PERIODIC, PM_PERIODIC, PM_PERIODIC), "3-D periodic 16x1x9");
	against_direct(grid(3, 9, 2, 17, PM_WALL, PM_WALL, PM_WALL), "3-D wall 9x2x17");
	against_direct(grid(3, 24, 17, 5, PM_WALL, PM_WALL, PM_WALL), "3-D wall 24x17x5");
	against_direct(grid(3, 6, 18, 33, PM_NEUMANN, PM_NEUMANN, PM_NEUMANN), "3-D neumann 6x18x33");
	against_direct(grid(3, 12, 17, 10, PM_PERIODIC, PM_WALL, PM_NEUMANN), "3-D periodic x wall x neumann 12x17x10");
	against_direct(grid(3, 7, 8, 18, PM_NEUMANN, PM_PERIODIC, PM_WALL), "3-D neumann x periodic x wall 7x8x18");
	against_direct(grid(3, 17, 1, 16, PM_WALL, PM_WALL, PM_PERIODIC), "3-D wall with one cell across: no inner node, phi = 0");
}

static double weighted_mean(const struct pm_grid *g, const double *a)
{
	double sum = 0, weight = 0;
	for (size_t k = 0, q = 0; k < g->points[2]; k++)
		for (size_t j = 0; j < g->points[1]; j++)
			for (size_t i = 0; i < g->points[0]; i++, q++)
				sum += pm_grid_weight(g, i, j, k) * a[q], weight += pm_grid_weight(g, i, j, k);
	return sum / weight;
}

static void means(void)
{
	struct pm_grid g[] = {grid(3, 12, 7, 10, PM_PERIODIC, PM_PERIODIC, PM_PERIODIC), grid(2, 11, 6, 1, PM_NEUMANN, PM_NEUMANN, 0),
		grid(3, 5, 6, 8, PM_NEUMANN, PM_PERIODIC, PM_NEUMANN)};
	for (int i = 0; i < 3; i++) {
		size_t n = pm_grid_size(&g[i]);
		double *s = noise(n), *phi = malloc(n * sizeof *phi);
		for (size_t q = 0; q < n; q++)
			s[q] += 1;
		double mean = solve(&g[i], PM_SPECTRAL, 1, s, phi);
		check_near(mean, weighted_mean(&g[i], s), 1e-14, "HC-23: the mean removed is the mean of s, end nodes with half weight");
		check_near(weighted_mean(&g[i], phi), 0, 1e-12, "HC-23: the mean of phi is zero");
		double largest = 0;
		for (size_t q = 0; q < n; q++)
			check_worst(&largest, fabs(s[q]));
		check_near(removed, fabs(mean) / largest, 1e-15, "HC-23: incompatible data are reported: the mean over the largest value");
		for (size_t q = 0; q < n; q++)
			s[q] -= mean;
		solve(&g[i], PM_SPECTRAL, 1, s, phi);
		check_near(removed, 0, 1e-15, "HC-23: data that fit the faces are reported as such");
		free(s), free(phi);
	}
	struct pm_grid w = grid(2, 8, 8, 1, PM_WALL, PM_PERIODIC, 0);
	double *s = noise(72), phi[72];
	check(solve(&w, PM_SPECTRAL, 1, s, phi) == 0, "with a wall nothing is removed");
	free(s);
}

/* -u'' = sin(m x) on [0, 2 pi), n = 32: u_h/u. */
static void ratios(void)
{
	static const struct { int m; enum pm_symbol symbol; double want; } row[] = {{1, PM_FD2, 1.0032189644401}, {4, PM_FD2, 1.0530292875455},
		{1, PM_FD4, 1.0000164584665}, {4, PM_FD4, 1.0040176283913}, {1, PM_SPECTRAL, 1}, {4, PM_SPECTRAL, 1}};
	struct pm_grid g = grid(1, 32, 1, 1, PM_PERIODIC, 0, 0);
	g.h[0] = 2 * pm_pi / 32;
	for (size_t i = 0; i < sizeof row / sizeof *row; i++) {
		double s[32], phi[32], ratio = 0;
		for (int q = 0; q < 32; q++)
			s[q] = sin(row[i].m * q * g.h[0]);
		solve(&g, row[i].symbol, -1, s, phi);
		for (int q = 0; q < 32; q++)
			ratio += phi[q] * s[q] * row[i].m * row[i].m / 16;
		char name[100];
		snprintf(name, sizeof name, "PS-06: amplitude ratio m=%d %s", row[i].m, pm_symbol_names[row[i].symbol]);
		check_near(ratio, row[i].want, 1e-12, name);
	}
}

/* A mesh of n cells of h along every axis, all faces the same. */
static struct pm_grid cube(int dim, size_t n, double h, enum pm_face face)
{
	struct pm_grid g = grid(dim, n, n, n, face, face, face);
	for (int d = 0; d < dim; d++)
		g.h[d] = h, g.lo[d] = 0;
	return g;
}

static double distance(const struct pm_grid *g, size_t q, const double centre[3])
{
	size_t at[3] = {q % g->points[0], q / g->points[0] % g->points[1], q / g->points[0] / g->points[1]};
	double r2 = 0;
	for (int d = 0; d < g->dim; d++)
		r2 += pow(g->h[d] * (double)at[d] - centre[d], 2);
	return sqrt(r2);
}

/* Potential of a Gaussian of unit strength and width: lap phi = -4 pi rho in 3-D, lap psi = -w in 2-D, phi'' = s in 1-D. */
static double exact(int dim, double r)
{
	if (dim == 3)
		return r > 0 ? erf(r / sqrt(2)) / r : sqrt(2 / pm_pi);
	if (dim == 1) /* phi'' = s */
		return 0.5 * (r * erf(r / sqrt(2)) + sqrt(2 / pm_pi) * exp(-r * r / 2));
	return r > 0 ? -(log(r * r) + gsl_sf_expint_E1(r * r / 2)) / (4 * pm_pi) : -(log(2) - 0.57721566490153286) / (4 * pm_pi);
}

/* Largest error of the solver on PS-09's box of 12 with n cells (oblong ones: n, 3n/4, 5n/4), and the value at the centre. */
static double gaussian(int dim, size_t n, bool oblong, double *middle)
{
	struct pm_grid g = cube(dim, n, 12.0 / (double)n, PM_OPEN);
	for (int d = 1; d < dim && oblong; d++) {
		g.cells[d] = d == 1 ? 3 * n / 4 : 5 * n / 4;
		g.points[d] = g.cells[d] + 1;
		g.h[d] = 12.0 / (double)g.cells[d];
	}
	size_t total = pm_grid_size(&g);
	double *s = calloc(total, sizeof *s), *phi = calloc(total, sizeof *phi), error = 0;
	const double centre[3] = {6, 6, 6};
	for (size_t q = 0; q < total; q++)
		s[q] = exp(-pow(distance(&g, q, centre), 2) / 2) / pow(2 * pm_pi, 0.5 * dim);
	solve(&g, PM_SPECTRAL, dim == 3 ? -4 * pm_pi : dim == 2 ? -1 : 1, s, phi);
	for (size_t q = 0; q < total; q++) {
		double r = distance(&g, q, centre);
		check_worst(&error, fabs(phi[q] - exact(dim, r)));
		if (r == 0)
			*middle = phi[q];
	}
	free(s), free(phi);
	return error;
}

static void gaussians(void)
{
	/* Bounds: the errors of PS-09 times its factor 1.2, for Hockney and Eastwood's 1/h and the cell average at r = 0. */
	static const double bound3[] = {7.881e-2, 2.035e-2, 5.127e-3}, bound2[] = {8.636e-4, 2.205e-4, 5.542e-5};
	double h[3], error[3], middle = NAN;
	for (int l = 0; l < 3; l++) {
		h[l] = 12.0 / (16u << l);
		error[l] = gaussian(3, 16u << l, false, &middle);
		check(error[l] < 1.2 * bound3[l] * sqrt(2 / pm_pi), "PS-09: 3-D Gaussian, %u^3: error %.2e of the maximum, bound %.2e", 16u << l,
			error[l] / sqrt(2 / pm_pi), 1.2 * bound3[l]);
	}
	check_order(3, h, error, 4, "PS-02: 3-D free space, smooth source");
	check_near(middle, 0.797884560802865, 1e-4, "PS-02: 3-D, phi at the centre"); /* h = 0.19: error 1.05e-5 */
	for (int l = 0; l < 3; l++) {
		h[l] = 12.0 / (32u << l);
		error[l] = gaussian(2, 32u << l, false, &middle);
		check(error[l] < 1.2 * bound2[l], "PS-09: 2-D Gaussian, %u^2: error %.2e, bound %.2e", 32u << l, error[l], 1.2 * bound2[l]);
	}
	check_order(3, h, error, 4, "PS-02: 2-D free space, smooth source");
	check_near(middle, -0.0092255368885859, 1e-6, "PS-02: 2-D, psi at the centre"); /* h = 0.094: error 2e-8 */
	for (int dim = 1; dim <= 3; dim++) {
		for (int l = 0; l < 3; l++) {
			h[l] = 12.0 / (16u << l);
			error[l] = gaussian(dim, 16u << l, dim > 1, &middle);
		}
		char name[80];
		snprintf(name, sizeof name, "%d-D free space%s", dim, dim > 1 ? ", oblong cells" : "");
		check_order(3, h, error, 4, name);
	}
}

/* A Gaussian 3 sigma from one end of the box: a longer box must change nothing; periodic images would show as a difference. */
static void no_wrap(void)
{
	struct pm_grid g = cube(3, 32, 0.375, PM_OPEN), wide = g;
	const double centre[3] = {3, 6, 6};
	wide.cells[0] = 70, wide.points[0] = 71;
	size_t n = pm_grid_size(&g), m = pm_grid_size(&wide);
	double *s = calloc(n, sizeof *s), *t = calloc(m, sizeof *t), *phi = malloc(n * sizeof *phi), *psi = malloc(m * sizeof *psi), worst = 0;
	for (size_t q = 0; q < n; q++) {
		double weight = q % 33 == 32 ? 0.5 : 1; /* the end of the short box is inside the long one */
		s[q] = exp(-pow(distance(&g, q, centre), 2) / 2) / pow(2 * pm_pi, 1.5);
		t[q % 33 + 71 * (q / 33)] = weight * s[q];
	}
	solve(&g, PM_SPECTRAL, -4 * pm_pi, s, phi);
	solve(&wide, PM_SPECTRAL, -4 * pm_pi, t, psi);
	for (size_t q = 0; q < n; q++)
		check_worst(&worst, fabs(phi[q] - psi[q % 33 + 71 * (q / 33)]));
	check_near(worst, 0, 1e-13, "HC-29: a source near an end, free space: nothing wraps around, anywhere");
	/* 1.35e-3 of the mass lies outside the box; at the far corner, r = 12.4, that is 1.1e-4 of phi. */
	check_near(phi[n - 1] / exact(3, distance(&g, n - 1, centre)), 1 - 1.35e-3, 2e-4,
		"HC-29: the potential at the far corner is that of the mass in the box");
	free(s), free(t), free(phi), free(psi);
}

/* The unit cube in free space: nodes as the middles of its cells, h = 1/31, and with nodes on its faces, h = 1/32. */
static void cube_of_one(void)
{
	for (int on_face = 0; on_face < 2; on_face++) {
		struct pm_grid g = cube(3, 32, on_face ? 1.0 / 32 : 1.0 / 31, PM_OPEN);
		size_t n = pm_grid_size(&g);
		double *s = calloc(n, sizeof *s), *phi = malloc(n * sizeof *phi);
		for (size_t k = !on_face; k < 33u - !on_face; k++)
			for (size_t j = !on_face; j < 33u - !on_face; j++)
				for (size_t i = !on_face; i < 33u - !on_face; i++)
					s[i + 33 * (j + 33 * k)] = 1; /* end nodes weigh half */
		solve(&g, PM_SPECTRAL, -4 * pm_pi, s, phi);
		if (on_face)
			check_near(phi[0], 1.1900386819897768, 1e-3, "PS-03: potential at the corner of the unit cube");
		else
			check_near(phi[n / 2], 2.3800773639795535, 1e-3, "PS-03: potential at the centre of the unit cube");
		/* The remaining error is that of the sum over a cube's nodes instead of the integral: 4 pi h^2/12 on faces, 4 pi h^2/24 the other way with
		 * middles. */
		double want = on_face ? -4 * pm_pi / 12 : 4 * pm_pi / 24;
		check_near((phi[n / 2] - 2.3800773639795535) / (g.h[0] * g.h[0]), want, 0.05 * fabs(want),
			"PS-03: the error at the centre is that of the sum over nodes");
		free(s), free(phi);
	}
}

static void square_with_walls(void)
{
	for (int symbol = PM_SPECTRAL; symbol <= PM_FD6; symbol++) {
		double h[3], error[3], total[3];
		for (int l = 0; l < 3; l++) {
			size_t n = 16u << l;
			struct pm_grid g = cube(2, n, 1 / (double)n, PM_WALL);
			size_t points = pm_grid_size(&g);
			double *s = malloc(points * sizeof *s), *u = malloc(points * sizeof *u), sum = 0;
			for (size_t q = 0; q < points; q++)
				s[q] = 1;
			solve(&g, symbol, -1, s, u);
			for (size_t q = 0; q < points; q++)
				sum += u[q] * g.h[0] * g.h[1];
			h[l] = g.h[0];
			error[l] = fabs(u[points / 2] - 0.0736713532815138);
			total[l] = fabs(sum - 0.0351442537387884);
			free(s), free(u);
		}
		char name[100];
		/* The odd image of a constant jumps at the walls: order 2 with any symbol. */
		snprintf(name, sizeof name, "PS-05: square with walls, u at the centre, %s", pm_symbol_names[symbol]);
		check_order(3, h, error, 2, name);
		snprintf(name, sizeof name, "PS-05: square with walls, integral of u, %s", pm_symbol_names[symbol]);
		check_order(3, h, total, 2, name);
		if (symbol == PM_FD2) /* four unknowns by hand: u = 9/128 on 4 x 4 cells, 0.0537 h^2 too low */
			check_near(error[2] / (h[2] * h[2]), 0.058, 0.001, "PS-05: the error of fd2 at the centre is 0.058 h^2");
	}
}

/* Smooth sources with each kind of face: order of the stencils, and the spectral solver exact. */
static void orders(void)
{
	for (enum pm_face face = PM_PERIODIC; face <= PM_NEUMANN; face++)
		for (int symbol = PM_SPECTRAL; symbol <= PM_FD6 && face != PM_OPEN; symbol++) {
			double h[3], error[3] = {0};
			for (int l = 0; l < 3; l++) {
				size_t n = 24u << l;
				struct pm_grid g = cube(1, n, 2 / (double)n, face);
				double s[100], phi[100], mean = 0, want[100];
				for (size_t i = 0; i < g.points[0]; i++) { /* phi = f(cos or sin of x), so that images are smooth */
					double x = pm_pi * (double)i * g.h[0];
					want[i] = face == PM_NEUMANN ? exp(cos(x)) : sinh(sin(x));
					s[i] = pm_pi * pm_pi * (face == PM_NEUMANN ? (sin(x) * sin(x) - cos(x)) * want[i] :
						cos(x) * cos(x) * want[i] - sin(x) * cosh(sin(x)));
				}
				solve(&g, symbol, 1, s, phi);
				mean = face == PM_WALL ? 0 : weighted_mean(&g, want);
				h[l] = g.h[0];
				for (size_t i = 0; i < g.points[0]; i++)
					check_worst(&error[l], fabs(phi[i] - (want[i] - mean)));
			}
			char name[100];
			snprintf(name, sizeof name, "%s with %s faces", pm_symbol_names[symbol], pm_face_names[face]);
			if (symbol == PM_SPECTRAL)
				check_near(error[1], 0, 1e-13, name); /* 48 cells resolve it to round-off */
			else
				check_order(3, h, error, 2 * symbol, name);
		}
}

static void threads(void)
{
	enum pm_face face[] = {PM_PERIODIC, PM_OPEN, PM_WALL};
	for (int i = 0; i < 3; i++) {
		struct pm_grid g = grid(3, 17, 24, 10, face[i], face[i], face[i]);
		size_t n = pm_grid_size(&g);
		double *s = noise(n), *a = malloc(n * sizeof *a), *b = malloc(n * sizeof *b);
		bool same = true;
		for (int t = 1; t <= 3; t++) {
			pm_threads_use(t);
			solve(&g, PM_SPECTRAL, 1.7, s, t == 1 ? a : b);
			same = same && (t == 1 || !memcmp(a, b, n * sizeof *a));
		}
		memcpy(b, s, n * sizeof *s);
		solve(&g, PM_SPECTRAL, 1.7, b, b);
		check(same, "%s: the same bytes with 1, 2 and 3 threads", pm_face_names[face[i]]);
		check(!memcmp(a, b, n * sizeof *a), "%s: source and result may be one array", pm_face_names[face[i]]);
		free(s), free(a), free(b);
	}
}

/* A periodic mesh beyond the caches, whose modes are turned from planes to pencils in the work array and back in phi where that is aligned. */
static void turned(void)
{
	struct pm_grid g = grid(3, 64, 60, 80, PM_PERIODIC, PM_PERIODIC, PM_PERIODIC);
	const size_t n = pm_grid_size(&g);
	double *s = noise(n), *a = pm_alloc(n + 1, sizeof *a), *b = pm_alloc(n + 1, sizeof *b);
	against_direct(g, "64 x 60 x 80");
	for (int t = 1; t <= 3; t++) {
		pm_threads_use(t);
		for (size_t off = 0; off < 2; off++) {
			solve(&g, PM_SPECTRAL, 1.7, s, t == 1 && !off ? a : b + off);
			check((t == 1 && !off) || !memcmp(a, b + off, n * sizeof *a), "64 x 60 x 80: the same bytes with %d threads, phi %s", t,
				off ? "not aligned" : "aligned");
		}
	}
	memcpy(b, s, n * sizeof *s);
	solve(&g, PM_SPECTRAL, 1.7, b, b);
	check(!memcmp(a, b, n * sizeof *a), "64 x 60 x 80: source and result may be one array");
	free(s), pm_free(a), pm_free(b);
}

static void refusals(void)
{
	struct pm_grid open = cube(3, 8, 1, PM_OPEN);
	open.face[1][0] = PM_ABSORBING;
	check(pm_poisson_fft_check(&open, &(struct pm_poisson_fft_choice){.symbol = PM_SPECTRAL}) == -PM_DATA, "absorbing: %s", pm_message());
}

/* One number that is not finite is found, wherever it is. */
static void infinite(void)
{
	const enum pm_face faces[] = {PM_PERIODIC, PM_WALL, PM_OPEN};
	for (size_t k = 0; k < 3 * 2; k++) {
		const struct pm_grid g = grid(2 + k % 2, 9, 5, k % 2 ? 6 : 1, faces[k / 2], faces[k / 2], faces[k / 2]);
		const size_t n = pm_grid_size(&g);
		double *s = noise(n), *phi = malloc(n * sizeof *phi);
		solve(&g, PM_SPECTRAL, 1e308, s, phi); /* fails where r.most is not INFINITY */
		for (size_t i = 0; i < n; i++)
			s[i] *= 1e308;
		solve(&g, PM_SPECTRAL, 1e308, s, phi);
		size_t not_finite = 0;
		for (size_t i = 0; i < n; i++)
			not_finite += !isfinite(phi[i]);
		check(not_finite, "%s, dim %d: a solution that is not finite is told", pm_face_names[faces[k / 2]], g.dim);
		free(s), free(phi);
	}
}

int main(void)
{
	infinite();
	sizes();
	means();
	ratios();
	gaussians();
	no_wrap();
	cube_of_one();
	square_with_walls();
	orders();
	threads();
	turned();
	refusals();
	return check_done();
}
