/* The transform of a line that fills the lanes by itself: against sums, and the solver in one dimension against a mesh of four equal rows, whose lines are
 * transformed side by side. SPDX-License-Identifier: GPL-3.0-or-later */
#include <stdlib.h>
#include <string.h>

#include "check.h"
#include "fft/long-line.h"
#include "poisson-fft/poisson-fft.h"

static double noise(size_t i, uint64_t what)
{
	double u[2];
	pm_random(2385, i, what, u);
	return u[0] - 0.3;
}

/* The largest difference from sum_j G_{i-j} x_j, G_d = sum_k u_k cos(2 pi k d/n), over the largest of these. */
static double against_sums(struct pm_fft_plans *planner, size_t n)
{
	double *x = pm_alloc(n, sizeof *x), *y = pm_alloc(n, sizeof *y), *cosine = pm_alloc(n, sizeof *cosine), *g = pm_alloc(n, sizeof *g);
	double *u = pm_alloc(n / 2 + 1, sizeof *u), sine, worst = 0, most = 0, sum = 0, all = 0;
	struct pm_long_line line;
	for (size_t i = 0; i < n; i++)
		x[i] = y[i] = noise(i, 3), pm_fft_circle(i, n, &cosine[i], &sine), all += x[i];
	for (size_t k = 0; k <= n / 2; k++)
		u[k] = noise(k, 4);
	if (pm_long_line_init(planner, n, u, &line))
		return check(false, "a line of %zu nodes is set up: %s", n, pm_message()), NAN;
	sum = pm_long_line_times(&line, 0.7, x);
	for (size_t d = 0; d < n; d++) {
		g[d] = u[0] + (d % 2 ? -1 : 1) * u[n / 2];
		for (size_t k = 1; k < n / 2; k++)
			g[d] += 2 * u[k] * cosine[k * d % n];
	}
	for (size_t i = 0; i < n; i++) {
		double z = 0;
		for (size_t j = 0; j < n; j++)
			z += 0.7 * g[(i + n - j) % n] * y[j];
		check_worst(&worst, fabs(x[i] - z)), check_worst(&most, fabs(z));
	}
	check(fabs(sum - all) < 1e-13 * (double)n, "%zu nodes: their sum is returned (%.15g, plainly %.15g)", n, sum, all);
	pm_long_line_free(&line);
	pm_free(x), pm_free(y), pm_free(cosine), pm_free(g), pm_free(u);
	return worst / most;
}

static struct pm_grid mesh(int dim, size_t n, const enum pm_face face[2])
{
	const size_t ends = face[0] != PM_PERIODIC, rows = dim == 2 ? 4 : 1;
	struct pm_grid g = {.dim = dim, .cells = {n, rows, 1}, .points = {n + ends, rows, 1}, .h = {0.7, 0.55, 1}};
	g.face[0][0] = face[0], g.face[0][1] = face[1];
	for (int d = 1; d < 3; d++)
		g.face[d][0] = g.face[d][1] = PM_PERIODIC;
	return g;
}

static double solve(const struct pm_grid *g, const struct pm_poisson_fft_choice *o, const double *s, double *phi)
{
	struct pm_poisson_fft_record r = {NAN, NAN, NAN};
	struct pm_poisson_fft *p = pm_poisson_fft_new(g, o);
	if (!p || pm_poisson_fft_solve(p, -1.3, s, phi, &r))
		check(false, "the solver runs (%s)", pm_message());
	pm_poisson_fft_free(p);
	return r.mean + r.incompatible;
}

/* The difference of potentials over the largest one; of the records too. */
static double against_rows(size_t n, const enum pm_face face[2], const struct pm_poisson_fft_choice *o)
{
	const struct pm_grid one = mesh(1, n, face), four = mesh(2, n, face);
	const size_t points = one.points[0];
	double *s = pm_alloc(4 * points, sizeof *s), *phi = pm_alloc(points, sizeof *phi), *rows = pm_alloc(4 * points, sizeof *rows), worst = 0, most = 0;
	for (size_t i = 0; i < 4 * points; i++)
		s[i] = noise(i % points, 5);
	const double a = solve(&one, o, s, phi), b = solve(&four, o, s, rows);
	for (size_t i = 0; i < points; i++)
		check_worst(&worst, fabs(phi[i] - rows[i])), check_worst(&most, fabs(rows[i]));
	pm_free(s), pm_free(phi), pm_free(rows);
	return fmax(worst / most, fabs(a - b));
}

static const struct { enum pm_face face[2]; const char *name; } kind[] = {{{PM_PERIODIC, PM_PERIODIC}, "periodic"}, {{PM_WALL, PM_WALL}, "walls"},
	{{PM_NEUMANN, PM_NEUMANN}, "neumann"}, {{PM_WALL, PM_NEUMANN}, "wall below neumann"}, {{PM_NEUMANN, PM_WALL}, "neumann below wall"},
	{{PM_OPEN, PM_OPEN}, "open"}, {{PM_OPEN, PM_WALL}, "open below wall"}, {{PM_NEUMANN, PM_OPEN}, "neumann below open"},
	{{PM_WALL, PM_OPEN}, "wall below open"}, {{PM_OPEN, PM_NEUMANN}, "open below neumann"}};

int main(void)
{
	/* of 4 rows and more, odd ones, with a greater prime, by FFTW, and above what is transformed in one piece */
	static const size_t size[] = {64, 80, 112, 208, 592, 3072, 4096, 4112};
	struct pm_fft_plans planner = {0};
	for (size_t i = 0; i < sizeof size / sizeof *size; i++) {
		const double worst = against_sums(&planner, size[i]);
		/* round-off of the sums, which is random: 7e-17 sqrt(n) measured, times 3 */
		check(worst < 2e-16 * sqrt((double)size[i]), "%zu nodes: a product of spectra is the convolution (difference %.1e)", size[i], worst);
	}
	pm_fft_plans_clear(&planner);
	for (size_t k = 0; k < sizeof kind / sizeof *kind; k++) {
		double worst = 0;
		for (size_t n = 16; n <= 1024; n = n == 16 ? 40 : n == 40 ? 96 : n == 96 ? 1024 : n + 1)
			for (int o = 0; o < 4; o++) {
				static const struct pm_poisson_fft_choice choice[] = {{.symbol = PM_SPECTRAL}, {.symbol = PM_FD2},
					{.symbol = PM_FD2, .screening = 0.3}, {.symbol = PM_SPECTRAL, .screening = 1.2}};
				check_worst(&worst, against_rows(n, kind[k].face, &choice[o]));
			}
		/* sums and differences of the shorter sine and cosine transforms: 4e-17 n (tests/unit/lines.c) */
		check(worst < 1e-13, "%s: a line of 16 to 1024 cells alone is one of four equal rows (difference %.1e)", kind[k].name, worst);
	}
	return check_done();
}
