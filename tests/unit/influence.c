/* Transforms of kernels and clouds, and the influence function of least error, in one dimension mode by mode. SPDX-License-Identifier: GPL-3.0-or-later */
#include <complex.h>
#include <stdlib.h>
#include <string.h>

#include "check.h"
#include "transfer/interlace.h"
#include "poisson-fft/influence-table.h"
#include "poisson-fft/poisson-fft.h"

static double sinc(double x) { return x == 0 ? 1 : sin(x) / x; }

static void test_windows(void)
{
	static const char *const name[] = {"ngp", "cic", "tsc", "pcs"};
	for (int p = 0; p < 4; p++) {
		double worst = 0;
		for (double theta = 0; theta < 9 * pm_pi; theta += 0.37)
			check_worst(&worst, fabs(pm_kernel_wave(pm_kernel_find(name[p]), theta) - pow(sinc(theta / 2), p + 1)));
		char text[100];
		snprintf(text, sizeof text, "the transform of %s is sinc^%d", name[p], p + 1);
		check_near(worst, 0, 1e-14, text); /* quadrature of 16 points on half cells, waves of up to 4.5 turns a cell */
	}
	for (int k = 0; pm_kernels[k]; k++)
		check(fabs(pm_kernel_wave(pm_kernels[k], 0) - 1) < 1e-13, "the transform of %s is 1 at 0", pm_kernels[k]->name);
	/* S2: 4 pi r^2 times the density 48 (1 - 2r/a)/(pi a^3) is 1, its transform by quadrature */
	double worst = 0;
	for (double u = 0.05; u < 12; u *= 1.3) {
		double sum = 0;
		for (int i = 0; i < 2000; i++) { /* midpoint rule, a = 2: r < 1, wave number u */
			double r = (i + 0.5) / 2000;
			sum += 4 * pm_pi * r * r * 6 / pm_pi * (1 - r) / 2 * sinc(u * r) / 2000;
		}
		check_worst(&worst, fabs(sum - pm_cloud_wave(u)));
	}
	check_near(worst, 0, 1e-5, "the transform of the cloud S2 is 12/u^4 (2 - 2 cos u - u sin u)"); /* the rule's (1/2000)^2 times u^2/24 */
	check_near(pm_cloud_wave(0.2), pm_cloud_wave(nextafter(0.2, 0)), 1e-12, "its series agrees with its closed form");
}

static double symbol(const void *c, double theta, double h)
{
	(void)c;
	return pm_symbol_value(PM_SPECTRAL, theta, h);
}

/* Hockney and Eastwood 1988, equation 8-45 for tsc; cic (1 + 2 cos^2(theta/2))/3. */
static void test_sums(void)
{
	const struct pm_kernel *kernel[2] = {pm_kernel_find("cic"), pm_kernel_find("tsc")};
	for (int q = 0; q < 2; q++) {
		struct pm_influence f = {.kind = PM_OPTIMAL, .kernel = kernel[q], .order = 2};
		struct pm_influence_axis a;
		pm_influence_axis_init(&a, &f, 14, 0.7, symbol, NULL);
		double worst = 0, sign = 0;
		for (size_t m = 0; m < a.count; m++) {
			double theta = 2 * pm_pi * (double)m / 14, s2 = pow(sin(theta / 2), 2), even = 0;
			check_worst(&worst, fabs(a.all[m] - (q ? 1 - s2 + 2.0 / 15 * s2 * s2 : 1 - 2.0 / 3 * s2)));
			for (int n = -2000; n <= 2000; n++)
				even += pow(sinc(theta / 2 + pm_pi * n), 4 + 2 * q) * (n % 2 ? -1 : 1);
			check_worst(&sign, fabs(a.even[m] - even));
		}
		char text[100];
		snprintf(text, sizeof text, "%s: the sum of W^2 over aliases has its closed form", kernel[q]->name);
		check_near(worst, 0, 1e-14, text);
		snprintf(text, sizeof text, "%s: so has the sum with alternating signs", kernel[q]->name);
		check_near(sign, 0, 1e-10, text);
		pm_influence_axis_free(&a);
	}
}

/* 1-D, n cells: mean over the positions of source and test particle of (force - exact)^2, when mode m of the influence function is scaled by 1 + change.
 * The force is computed by spread, modes, slope and gather written out here; exact is the force of a point, x/L - sign(x)/2, as a series of 200 waves. */
static double mean_square(const struct pm_influence *f, size_t n, size_t mode, double change)
{
	enum { fine = 12 };
	struct pm_influence_axis axis[3];
	double G[16], sum = 0;
	for (int d = 0; d < 3; d++)
		pm_influence_axis_init(&axis[d], f, d ? 1 : n, 1, symbol, NULL);
	pm_influence_row(f, axis, 0, 0, 0, G);
	G[mode] *= 1 + change;
	for (int a = 0; a < fine; a++)
		for (int b = 0; b < fine * (int)n; b++) {
			double x = (a + 0.5) / fine, y = (b + 0.25) / fine, force = 0, wanted = 0;
			for (size_t m = 1; m < axis[0].count; m++) { /* D.(-G) sum over both copies of the meshes */
				double complex in = 0, out = 0;
				double theta = 2 * pm_pi * (double)m / (double)n;
				for (int half = 0; half <= f->interlaced; half++) {
					double wx[PM_KERNEL_WIDTH], wy[PM_KERNEL_WIDTH], ux = x - 0.5 * half, uy = y - 0.5 * half;
					double nx = f->kernel->width % 2 ? floor(ux + 0.5) : floor(ux), ny = f->kernel->width % 2 ? floor(uy + 0.5) : floor(uy);
					int first = -((f->kernel->width - 1) / 2);
					pm_kernel_weights(f->kernel, ux - nx, wx);
					pm_kernel_weights(f->kernel, uy - ny, wy);
					for (int i = 0; i < f->kernel->width; i++) {
						in += wx[i] * cexp(-I * theta * (nx + first + i + 0.5 * half)) / (1 + f->interlaced);
						out += wy[i] * cexp(I * theta * (ny + first + i + 0.5 * half)) / (1 + f->interlaced);
					}
				}
				force += (2 * m == n ? 1 : 2) * creal(-I * axis[0].slope[m] * G[m] * in * out) / (double)n;
			}
			for (int m = 1; m <= 200; m++)
				wanted -= sin(2 * pm_pi * m * (y - x) / (double)n) / (pm_pi * m);
			sum += pow(force - wanted, 2);
		}
	for (int d = 0; d < 3; d++)
		pm_influence_axis_free(&axis[d]);
	return sum / (fine * fine * (double)n);
}

/* By 2 % either way the error is larger. */
static void test_least(void)
{
	static const struct { const char *kernel; int order; bool interlaced; } row[] = {{"ngp", 2, false}, {"cic", 2, false}, {"cic", 4, false},
		{"tsc", 4, false}, {"tsc", 0, false}, {"cic", 2, true}, {"tsc", 6, true}};
	for (size_t q = 0; q < sizeof row / sizeof *row; q++) {
		struct pm_influence f = {.kind = PM_OPTIMAL, .kernel = pm_kernel_find(row[q].kernel), .order = row[q].order, .interlaced = row[q].interlaced},
			g = f;
		bool least = true;
		for (size_t m = 1; m < 4; m++) {
			double here = mean_square(&f, 8, m, 0);
			least = least && mean_square(&f, 8, m, 0.02) > here && mean_square(&f, 8, m, -0.02) > here;
		}
		g.kind = PM_PLAIN;
		double plain = mean_square(&g, 8, 1, 0), best = mean_square(&f, 8, 1, 0);
		check(least && best < plain, "%s, order %d%s: no other value of any mode makes the mean square error of the force smaller (%.4f, the symbol "
			"alone %.4f)", row[q].kernel, row[q].order, row[q].interlaced ? ", interlaced" : "", best, plain);
	}
}

/* The spread on two meshes against its definition, and the gather against the spread: <gather f, q> = h^d <f, spread q>. */
static void test_interlaced(void)
{
	static const struct { int dim; size_t n[3]; const char *kernel; } row[] = {{1, {16, 1, 1}, "cic"}, {2, {10, 7, 1}, "tsc"}, {3, {6, 9, 34}, "ngp"},
		{3, {12, 5, 8}, "pcs"}};
	for (size_t q = 0; q < sizeof row / sizeof *row; q++) {
		enum { N = 50 };
		struct pm_grid g = {.dim = row[q].dim, .cells = {1, 1, 1}, .points = {1, 1, 1}, .lo = {0.3, -2, 5}, .h = {1, 1, 1}};
		for (int d = 0; d < g.dim; d++)
			g.cells[d] = g.points[d] = row[q].n[d], g.h[d] = 0.7 + 0.2 * d;
		size_t size = pm_grid_size(&g);
		struct pm_transfer t = {.grid = g, .kernel = pm_kernel_find(row[q].kernel), .components = 1};
		struct pm_fft_plans planner = {0};
		double x[3][N], s[N], out[N] = {0}, *rho = pm_zalloc(size, sizeof *rho), *f = pm_zalloc(size, sizeof *f), left = 0, right = 0, total = 0,
			sum = 0;
		for (size_t i = 0; i < N; i++)
			for (int d = 0; d < 3; d++) {
				double u[2];
				pm_random(3, i, (uint64_t)d, u);
				x[d][i] = g.lo[d] + u[0] * g.h[d] * (double)g.cells[d];
				s[i] = u[1] - 0.3;
			}
		for (size_t i = 0; i < size; i++) {
			double u[2];
			pm_random(4, i, 0, u);
			f[i] = u[0] - 0.5;
		}
		const double *at[3] = {x[0], x[1], x[2]};
		struct pm_strays strays;
		struct pm_interlaced both;
		int bad = pm_interlace_check(&t);
		bad |= pm_interlace_spread(&t, &planner, N, at, (const double *[]){s}, (double *[]){rho}, &strays);
		bad |= pm_interlace_init(&both, &t, &planner, (const double *[]){f});
		bad |= pm_interlace_gather(&both, &t, N, at, NULL, (double *[]){out}, &strays);
		for (size_t i = 0; i < N; i++)
			left += out[i] * s[i], total += s[i];
		for (size_t i = 0; i < size; i++)
			right += rho[i] * f[i] * pm_grid_cell(&g), sum += rho[i] * pm_grid_cell(&g);
		check(!bad && fabs(left - right) < 1e-13 * N, "%s, %d-D: the interlaced gather is the transpose of the spread (difference %g)", row[q].kernel,
			g.dim, left - right);
		check_near(sum, total, 1e-13 * N, "and the total on the mesh is that of the particles");
		if (g.dim == 1) { /* every mode by definition */
			double worst = 0;
			for (size_t m = 0; 2 * m < g.cells[0]; m++) {
				double complex got = 0, want = 0;
				double theta = 2 * pm_pi * (double)m / (double)g.cells[0];
				for (size_t i = 0; i < size; i++)
					got += rho[i] * g.h[0] * cexp(-I * theta * (double)i);
				for (size_t i = 0; i < N; i++)
					for (int half = 0; half < 2; half++) {
						double u = (x[0][i] - g.lo[0]) / g.h[0] - 0.5 * half, fl = floor(u), w[PM_KERNEL_WIDTH];
						pm_kernel_weights(t.kernel, u - fl, w);
						want += 0.5 * s[i] *
						(w[0] * cexp(-I * theta * (fl + 0.5 * half)) + w[1] * cexp(-I * theta * (fl + 1 + 0.5 * half)));
					}
				check_worst(&worst, cabs(got - want));
			}
			check_near(worst, 0, 1e-13, "its waves are the mean of those of the two meshes");
		}
		pm_interlace_free(&both);
		pm_fft_plans_clear(&planner);
		pm_free(rho), pm_free(f);
	}
}

int main(void)
{
	pm_threads_use(1);
	test_windows();
	test_sums();
	test_least();
	test_interlaced();
	return check_done();
}
