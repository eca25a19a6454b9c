/* psatd by itself: plane waves of any direction at any step, Gauss's law and div B, energy, two half steps against a whole one, the same bytes for any number
 * of threads. SPDX-License-Identifier: GPL-3.0-or-later */
#include <string.h>

#include "check.h"
#include "maxwell-parts/yee-waves.h"
#include "maxwell/maxwell.h"

static const double h[3] = {0.7, 0.55, 0.9};

static bool nodal; /* of what yee_new makes */

static struct pm_yee yee_new(int dim, const size_t cells[3])
{
	struct pm_yee y = {.grid = {.dim = dim}, .c = 1.3, .eps0 = 0.7, .nodal = nodal};
	for (int d = 0; d < 3; d++) {
		y.grid.cells[d] = y.grid.points[d] = d < dim ? cells[d] : 1;
		y.grid.h[d] = d < dim ? h[d] : 1;
	}
	const size_t n = pm_grid_size(&y.grid);
	for (int d = 0; d < 3; d++) {
		y.e[d] = pm_zalloc(n, sizeof(double));
		y.b[d] = pm_zalloc(n, sizeof(double));
		y.j[d] = pm_zalloc(n, sizeof(double));
	}
	return y;
}

static void yee_free(struct pm_yee *y)
{
	for (int d = 0; d < 3; d++)
		pm_free(y->e[d]), pm_free(y->b[d]), pm_free((double *)y->j[d]);
}

static void noise(const struct pm_yee *y, double *const a[3], uint64_t seed)
{
	for (size_t i = 0; i < pm_grid_size(&y->grid); i++)
		for (int c = 0; c < 3; c++) {
			double u[2];
			pm_random(seed, i, (uint64_t)c, u);
			a[c][i] = u[0] - 0.5;
		}
}

static int step(const struct pm_yee *y, double dt) { return pm_maxwell_find("psatd")->advance(y, dt); }

/* A wave of integer mode numbers at time t where component c of E or B sits; largest difference from the mesh, which it is written to where asked. */
static double wave(struct pm_yee *y, const int mode[3], double t, bool write)
{
	const struct pm_grid *g = &y->grid;
	double k[3], k2 = 0, pol[3] = {0.3, -1.1, 0.7}, along = 0, worst = 0;
	for (int d = 0; d < 3; d++)
		k[d] = 2 * pm_pi * mode[d] / ((double)g->cells[d] * g->h[d]), k2 += k[d] * k[d];
	for (int d = 0; d < 3; d++)
		along += pol[d] * k[d] / k2;
	for (int d = 0; d < 3; d++)
		pol[d] -= along * k[d];
	for (size_t i = 0; i < pm_grid_size(g); i++)
		for (int c = 0; c < 6; c++) {
			const size_t at[3] = {i % g->points[0], i / g->points[0] % g->points[1], i / g->points[0] / g->points[1]};
			const int a = c % 3, e = (a + 1) % 3, f = (a + 2) % 3;
			double phase = -y->c * sqrt(k2) * t;
			for (int d = 0; d < 3; d++)
				phase += k[d] * ((double)at[d] + (!y->nodal && d < g->dim && (d == a) == (c < 3) ? 0.5 : 0)) * g->h[d];
			const double value = (c < 3 ? pol[a] : (k[e] * pol[f] - k[f] * pol[e]) / (y->c * sqrt(k2))) * cos(phase);
			double *to = (c < 3 ? y->e[a] : y->b[a]) + i;
			check_worst(&worst, fabs(*to - value));
			if (write)
				*to = value;
		}
	return worst;
}

static void test_waves(void)
{
	static const struct { int dim; size_t cells[3]; int mode[3]; double courant; } cases[] = {
		{1, {16, 1, 1}, {3, 0, 0}, 0.3}, {1, {17, 1, 1}, {-8, 0, 0}, 40}, {1, {257, 1, 1}, {100, 0, 0}, 1}, {2, {16, 12, 1}, {5, -3, 0}, 1.7},
		{2, {1, 9, 1}, {0, 4, 0}, 0.9}, {3, {10, 8, 12}, {4, -3, 2}, 3.1}, {3, {9, 1, 14}, {-1, 0, 6}, 0.99}, {3, {18, 7, 5}, {8, 3, -2}, 11}};
	for (size_t i = 0; i < sizeof cases / sizeof *cases; i++) {
		struct pm_yee y = yee_new(cases[i].dim, cases[i].cells);
		const double dt = cases[i].courant * 0.55 / y.c;
		wave(&y, cases[i].mode, 0, true);
		for (int n = 0; n < 200; n++)
			step(&y, dt);
		/* the phase of w t itself is rounded by w t 1e-16, w t up to 2e4 */
		check_below(wave(&y, cases[i].mode, 200 * dt, false), 2e-11, "psatd: a wave in %d-D (case %zu) moves at c for 200 steps of c dt = %g h",
			cases[i].dim, i, cases[i].courant);
		yee_free(&y);
	}
}

static double largest(const struct pm_yee *y, const double *a)
{
	double most = 0;
	for (size_t i = 0; i < pm_grid_size(&y->grid); i++)
		most = fmax(most, fabs(a[i]));
	return most;
}

/* Where fields are on the nodes they have no shortest waves: these are taken out of a. */
static void without_shortest(const struct pm_yee *y, double *a)
{
	const size_t *n = y->grid.points;
	for (int d = 0; d < 3 && y->nodal; d++) {
		const size_t step = d == 0 ? 1 : d == 1 ? n[0] : n[0] * n[1];
		for (size_t i = 0; i < pm_grid_size(&y->grid) && n[d] % 2 == 0; i++)
			if (i / step % n[d] == 0) {
				double sum = 0;
				for (size_t q = 0; q < n[d]; q++)
					sum += (q % 2 ? -1 : 1) * a[i + q * step] / (double)n[d];
				for (size_t q = 0; q < n[d]; q++)
					a[i + q * step] -= (q % 2 ? -1 : 1) * sum;
			}
	}
}

/* (div E' - div E)/dt by waves against -div J/eps0 by two-point differences, all of them noise, Nyquist waves included. */
static void test_gauss(void)
{
	static const size_t sizes[3][3] = {{10, 8, 12}, {9, 7, 5}, {16, 1, 6}};
	for (int i = 0; i < 9; i++) {
		struct pm_yee y = yee_new(1 + i % 3, sizes[i / 3]), current = y;
		y.drift[0] = 0.7, current.nodal = false;
		const size_t n = pm_grid_size(&y.grid);
		double *before = pm_alloc(n, sizeof *before), *after = pm_alloc(n, sizeof *after), *flow = pm_alloc(n, sizeof *flow), worst = 0;
		noise(&y, y.e, 3), noise(&y, y.b, 4);
		for (int d = 0; d < 3; d++)
			current.e[d] = (double *)y.j[d];
		noise(&y, current.e, 5);
		pm_yee_divergence(&current, NULL, flow);
		pm_yee_waves_divergence(&y, NULL, before);
		step(&y, 2.2);
		pm_yee_waves_divergence(&y, NULL, after);
		for (size_t q = 0; q < n; q++)
			before[q] -= after[q];
		without_shortest(&y, flow);
		for (size_t q = 0; q < n; q++)
			check_worst(&worst, fabs(-before[q] + 2.2 * flow[q] / y.eps0));
		check_below(worst / largest(&y, after), 2e-14, "psatd: Gauss's law of waves follows the current of two-point differences (%d-D, sizes %d)",
			y.grid.dim, i / 3);
		pm_yee_waves_divergence(&y, flow, after);
		pm_yee_waves_correct(&y, after);
		pm_yee_waves_divergence(&y, flow, after);
		double mean = 0; /* which no field has */
		for (size_t q = 0; q < n; q++)
			mean += after[q] / (double)n;
		for (size_t q = 0; q < n; q++)
			after[q] -= mean;
		check_below(largest(&y, after) / largest(&y, flow), 2e-14, "psatd: E corrected has the charge (%d-D, sizes %d)", y.grid.dim, i / 3);
		pm_free(before), pm_free(after), pm_free(flow);
		yee_free(&y);
	}
}

/* One wave of current across x that moves on in a step, by --current-drift and by many short steps. */
static void test_drift(void)
{
	double error[3];
	for (int fine = 0; fine < 3; fine++) {
		struct pm_yee y = yee_new(1, (const size_t[]){16, 1, 1}), s = y;
		const double k = 2 * pm_pi * 3 / (16 * h[0]), v = 0.8, dt = 1.1;
		const int n = 25 << fine;
		double *j = (double *)y.j[1], *e = pm_zalloc(16, sizeof *e), *b = pm_zalloc(16, sizeof *b);
		for (int i = 0; i < 16; i++)
			j[i] = cos(k * i * h[0]);
		y.drift[0] = v;
		step(&y, dt);
		memcpy(e, y.e[1], 16 * sizeof *e), memcpy(b, y.b[2], 16 * sizeof *b);
		memset(y.e[1], 0, 16 * sizeof *e), memset(y.b[2], 0, 16 * sizeof *b);
		error[fine] = 0;
		for (int q = 0; q < n; q++) {
			for (int i = 0; i < 16; i++) /* over the mean of the factor, as psatd does */
				j[i] = cos(k * (i * h[0] - v * dt * ((q + 0.5) / n - 0.5))) / (sin(k * v * dt / 2) / (k * v * dt / 2));
			step(&s, dt / n);
		}
		for (int i = 0; i < 16; i++)
			check_worst(&error[fine], fmax(fabs(y.e[1][i] - e[i]), fabs(y.b[2][i] - b[i])));
		pm_free(e), pm_free(b);
		yee_free(&y);
	}
	const double order = log2(error[0] / error[2]) / 2;
	check(order > 1.95 && error[2] < 2e-4, "psatd: a current that drifts is what short steps give, to their order %.3f (%.2g with 100)", order, error[2]);
}

static double energy(const struct pm_yee *y)
{
	double sum = 0;
	for (int c = 0; c < 3; c++)
		sum += pm_sum_products(pm_grid_size(&y->grid), y->e[c], y->e[c]) +
			y->c * y->c * pm_sum_products(pm_grid_size(&y->grid), y->b[c], y->b[c]);
	return sum;
}

/* Noise without a current keeps its energy; with a constant one, two steps end where one of twice dt does. */
static void test_steps(void)
{
	for (int dim = 1; dim <= 3; dim++) {
		const size_t cells[3] = {10, 9, 6};
		struct pm_yee y = yee_new(dim, cells), half = yee_new(dim, cells), still = y;
		double worst = 0;
		for (int d = 0; d < 3; d++)
			still.j[d] = NULL;
		noise(&y, y.e, 6), noise(&y, y.b, 7), noise(&y, half.b, 7), noise(&y, half.e, 6);
		noise(&y, (double *const[3]){(double *)y.j[0], (double *)y.j[1], (double *)y.j[2]}, 8);
		noise(&y, (double *const[3]){(double *)half.j[0], (double *)half.j[1], (double *)half.j[2]}, 8);
		step(&y, 1.5);
		step(&half, 0.75), step(&half, 0.75);
		for (int c = 0; c < 3; c++)
			for (size_t i = 0; i < pm_grid_size(&y.grid); i++)
				check_worst(&worst, fmax(fabs(y.e[c][i] - half.e[c][i]), fabs(y.b[c][i] - half.b[c][i])));
		check_below(worst, 3e-14, "psatd: a step is two half steps with the same current (%d-D)", dim);
		step(&still, 5); /* on the nodes: without the shortest waves */
		const double first = energy(&y);
		for (int n = 0; n < 300; n++)
			step(&still, 5);
		check_below(fabs(energy(&y) / first - 1), 1e-12, "psatd: 300 steps of noise keep E^2 + c^2 B^2 (%d-D)", dim);
		yee_free(&y), yee_free(&half);
	}
}

static void test_threads(void)
{
	double *kept = NULL;
	bool same = true;
	for (int t = 0; t < 3; t++) {
		struct pm_yee y = yee_new(3, (const size_t[]){33, 30, 31});
		noise(&y, y.e, 9);
		pm_threads_use((const int[]){1, 2, 7}[t]);
		step(&y, 1), step(&y, 1);
		const size_t bytes = pm_grid_size(&y.grid) * sizeof(double);
		kept = kept ? kept : memcpy(pm_alloc(bytes, 1), y.b[1], bytes);
		same = same && !memcmp(kept, y.b[1], bytes);
		yee_free(&y);
	}
	pm_free(kept);
	check(same, "psatd: 1, 2 and 7 threads give the same bytes");
}

int main(void)
{
	for (int i = 0; i < 2; i++) {
		nodal = i;
		printf("# fields %s\n", nodal ? "on the nodes" : "where Yee has them");
		test_waves();
		test_gauss();
		test_drift();
		test_steps();
	}
	test_threads();
	return check_done();
}
