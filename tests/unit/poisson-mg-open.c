/* Multigrid in free space: the lattice Green's function, Gaussian blobs, odd sizes, stretched cells, threads. SPDX-License-Identifier: GPL-3.0-or-later */
#include <string.h>

#include "mg-problem.h"
#include "poisson-mg/mg-open-parts.h"

static struct pm_mg_choice usual(int order, int dim)
{
	struct pm_mg_choice o = {.pre = 2, .post = 2, .smoother = order == 4 ? PM_MG_FOUR_COLOUR : PM_MG_SOR, .cycle = PM_MG_FMG, .tolerance = 1e-12,
		.most = 60};
	o.relaxation = pm_mg_relaxation(o.smoother, dim, order);
	return o;
}

static struct pm_grid box(int dim, const size_t *cells, const double *l)
{
	struct pm_grid g = grid(dim, cells, l, "wwwwww");
	for (int d = 0; d < dim; d++)
		g.face[d][0] = g.face[d][1] = PM_OPEN;
	return g;
}

static const size_t *point(const struct pm_grid *g, size_t p)
{
	static size_t at[3];
	at[0] = p % g->points[0], at[1] = p / g->points[0] % g->points[1], at[2] = p / g->points[0] / g->points[1];
	return at;
}

static int solve(const struct pm_grid *g, int order, const double *s, double *phi)
{
	static struct pm_mg_record r;
	struct pm_mg_choice o = usual(order, g->dim);
	struct pm_mg_open *m = pm_mg_open_new(g, order);
	int status = m ? pm_mg_open_solve(m, &o, 1, s, phi, &r) : -PM_DATA;
	pm_mg_open_free(m);
	return status;
}

/* PS-07 */
static void test_lattice(void)
{
	struct pm_grid g = box(3, (size_t[]){80, 5, 4}, (double[]){80, 5, 4});
	double *t = values(pm_grid_size(&g));
	check(pm_mg_lattice(&g, 2, t) == 0, "PS-07: the table of the cubic lattice is made");
	check_near(-t[0], 0.252731009858663, 1e-8, "PS-07: 3-D lattice Green's function at 0"); /* 1e-8: the far form at 32 cells */
	check_near(-t[1], 0.252731009858663 - 1. / 6, 1e-8, "PS-07: 3-D, one step away");
	check_near(t[33] / t[32] / ((1 / 33. * (1 + 0.25 / 33 / 33)) / (1 / 32. * (1 + 0.25 / 32 / 32))), 1, 1e-6, "3-D: the near and the far form agree where "
		"they join");
	pm_free(t);
	g = box(2, (size_t[]){5, 4}, (double[]){5, 4});
	t = values(pm_grid_size(&g));
	check(pm_mg_lattice(&g, 2, t) == 0, "PS-07: the table of the square lattice is made");
	check_near(t[1] - t[0], 0.25, 1e-8, "PS-07: 2-D, G(1,0) - G(0,0)");
	check_near(t[7] - t[0], 1 / pm_pi, 1e-8, "PS-07: 2-D, G(1,1) - G(0,0)");
	check_near(t[0], -(0.57721566490153286 + 1.5 * log(2)) / (2 * pm_pi), 1e-8, "2-D: with the logarithm's own constant, -(gamma + 3/2 ln 2)/(2 pi) at 0");
	pm_free(t);
}

/* One charged node anywhere in the box has the lattice's potential everywhere in it. */
static void test_node(void)
{
	static const struct {
		int dim;
		size_t cells[3], at[3];
		double h[3];
	} row[] = {{1, {9, 1, 1}, {3, 0, 0}, {0.7, 1, 1}}, {2, {16, 16, 1}, {8, 8, 0}, {1, 1, 1}}, {2, {13, 30, 1}, {1, 29, 0}, {1, 0.4, 1}},
		{2, {7, 97, 1}, {2, 50, 0}, {0.3, 0.1, 1}},
		{3, {16, 16, 16}, {8, 8, 8}, {1, 1, 1}}, {3, {9, 13, 20}, {1, 12, 19}, {0.5, 0.7, 0.45}}, {3, {40, 5, 7}, {1, 1, 1}, {0.1, 0.3, 0.2}}};
	for (int order = 2; order <= 4; order += 2)
		for (size_t q = 0; q < sizeof row / sizeof *row; q++) {
			double l[3], most = 0, worst = 0;
			for (int d = 0; d < 3; d++)
				l[d] = row[q].h[d] * (double)row[q].cells[d];
			struct pm_grid g = box(row[q].dim, row[q].cells, l);
			size_t n = pm_grid_size(&g), here = row[q].at[0] + g.points[0] * (row[q].at[1] + g.points[1] * row[q].at[2]);
			double *s = values(n), *phi = values(n), *t = values(n), *mine = values(n);
			s[here] = 1;
			bool good = !pm_mg_lattice(&g, order, t) && !solve(&g, order, s, phi);
			for (size_t p = 0; p < n; p++) { /* order 4: the source is spread over the neighbours, 1 + sum of second differences / 12 */
				const size_t *at = point(&g, p);
				for (int d = -1; d < (order == 4 ? g.dim : 0); d++)
					for (int o = -1; o <= 1; o++) {
						size_t off[3];
						for (int e = 0; e < 3; e++)
							off[e] = (size_t)labs((long)at[e] - (long)row[q].at[e] - (e == d ? o : 0));
						if (d < 0 && o)
							continue;
						bool inside = off[0] < g.points[0] && off[1] < g.points[1] && off[2] < g.points[2];
						mine[p] += !inside ? NAN
							: (d < 0 ? 1 : o ? 1. / 12 : -2. / 12) * t[off[0] + g.points[0] * (off[1] + g.points[1] * off[2])];
					}
				if (isnan(mine[p]))
					continue; /* the table ends one node earlier than the sum needs */
				check_worst(&most, fabs(mine[p])), check_worst(&worst, fabs(phi[p] - mine[p]));
			}
			check(good && worst < 3e-7 * most, "order %d, %d-D, %zu x %zu x %zu, spacings %g %g %g: a charged node has the lattice's potential "
				"(relative error %.1e, tolerance 3e-7)", order,
				g.dim, g.cells[0], g.cells[1], g.cells[2], g.h[0], g.h[1], g.h[2], worst / most);
			pm_free(s), pm_free(phi), pm_free(t), pm_free(mine);
		}
}

static double expint(double x) /* E1 by its series, or its continued fraction */
{
	double sum = -0.57721566490153286 - log(x), term = 1, f = 0;
	if (x > 1) {
		for (int i = 200; i > 0; i--)
			f = i / (1 + i / (x + f));
		return exp(-x) / (x + f);
	}
	for (int i = 1; i < 40; i++)
		term *= -x / i, sum -= term / i;
	return sum;
}

static double blob(int dim, double r) /* lap phi = s: PS-02 */
{
	if (dim == 3)
		return -(r > 0 ? erf(r / sqrt(2)) / r : sqrt(2 / pm_pi)) / (4 * pm_pi);
	return r > 0 ? (log(r * r) + expint(r * r / 2)) / (4 * pm_pi) : (log(2) - 0.57721566490153286) / (4 * pm_pi);
}

/* The largest error for a Gaussian of sigma 1 in a box of about 14, its centre on no node and not in the middle, relative to the largest phi. */
static double gaussian(int dim, int order, size_t n)
{
	static const double centre[3] = {6.83, 7.31, 7.04};
	struct pm_grid g = box(dim, (size_t[]){n, n + n / 4, n}, (double[]){14, 14, 14});
	size_t size = pm_grid_size(&g);
	double *s = values(size), *phi = values(size), worst = 0, most = 0;
	for (size_t p = 0; p < size; p++) {
		const size_t *at = point(&g, p);
		double r2 = 0;
		bool wall = false;
		for (int d = 0; d < dim; d++) {
			r2 += pow((double)at[d] * g.h[d] - centre[d], 2);
			wall |= at[d] == 0 || at[d] == g.cells[d];
		}
		s[p] = wall ? 0 : exp(-r2 / 2) / pow(2 * pm_pi, 0.5 * dim);
	}
	int status = solve(&g, order, s, phi);
	for (size_t p = 0; p < size; p++) {
		const size_t *at = point(&g, p);
		double r2 = 0;
		for (int d = 0; d < dim; d++)
			r2 += pow((double)at[d] * g.h[d] - centre[d], 2);
		check_worst(&most, fabs(blob(dim, sqrt(r2)))), check_worst(&worst, fabs(phi[p] - blob(dim, sqrt(r2))));
	}
	pm_free(s), pm_free(phi);
	return status ? NAN : worst / most;
}

static void test_gaussians(void)
{
	check_near(-4 * pm_pi * blob(3, 1), 0.682689492137086, 1e-14, "PS-02: 3-D, phi of the blob at 1");
	check_near(-blob(2, 1), -0.0445453673104728, 1e-14, "PS-02: 2-D, psi of the blob at 1");
	check_near(-blob(2, 3), -0.175014572272592, 1e-14, "PS-02: 2-D, psi of the blob at 3");
	for (int dim = 2; dim <= 3; dim++)
		for (int order = 2; order <= 4; order += 2) {
			double h[3], e[3];
			for (int i = 0; i < 3; i++) {
				size_t n = (size_t[]){24, 36, 48}[i] * (dim == 2 ? 2 : 1);
				h[i] = 14 / (double)n;
				e[i] = gaussian(dim, order, n);
			}
			char text[120];
			snprintf(text, sizeof text, "PS-09: %d-D, a Gaussian in free space by differences of order %d (relative error %.1e at h = %.2g)", dim,
				order, e[2], h[2]);
			check_order(3, h, e, order, text);
		}
}

static uint32_t bytes(const struct pm_grid *g, int threads)
{
	size_t n = pm_grid_size(g);
	double *s = values(n);
	noise(n, s);
	for (size_t p = 0; p < n; p++)
		for (int d = 0; d < g->dim; d++)
			s[p] *= point(g, p)[d] > 0 && point(g, p)[d] < g->cells[d];
	pm_threads_use(threads);
	solve(g, 2, s, s);
	uint32_t crc = pm_crc32c(0, s, n * sizeof *s);
	pm_free(s);
	return crc;
}

static void test_ends(void)
{
	struct pm_grid g = box(3, (size_t[]){64, 67, 70}, (double[]){1, 1, 1});
	check(bytes(&g, 1) == bytes(&g, 3), "open, 64 x 67 x 70: the same bytes for 1 and 3 threads");
	g = box(2, (size_t[]){400, 391}, (double[]){1, 1});
	check(bytes(&g, 1) == bytes(&g, 2), "open, 400 x 391: the same bytes for 1 and 2 threads");
	pm_threads_use(1);
	g = box(3, (size_t[]){8, 8, 80}, (double[]){1, 1, 1});
	check(pm_mg_open_check(&g) < 0 && strstr(pm_message(), "10 times longer than wide") && strstr(pm_message(), "poisson-fft"),
		"cells too long are refused: %s", pm_message());
	g.face[1][0] = g.face[1][1] = PM_WALL;
	check(pm_mg_open_check(&g) < 0 && strstr(pm_message(), "axis y has wall ones (use poisson-fft)"), "mixed with walls it is refused: %s", pm_message());
}

int main(void)
{
	test_lattice();
	test_node();
	test_gaussians();
	test_ends();
	return check_done();
}
