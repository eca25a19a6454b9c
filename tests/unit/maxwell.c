/* Yee's scheme by itself: growth beyond its limit and the energy below it (HC-11), standing waves between conductors and planes of symmetry, what absorbing
 * layers send back, the same bytes for any number of threads. SPDX-License-Identifier: GPL-3.0-or-later */
#include <string.h>

#include "check.h"
#include "maxwell/maxwell.h"

static struct pm_yee yee_new(int dim, const size_t cells[3], enum pm_face face, const double h[3])
{
	struct pm_yee y = {.grid = {.dim = dim}, .c = 1.3, .eps0 = 0.7, .layers = 10};
	for (int d = 0; d < 3; d++) {
		y.grid.cells[d] = d < dim ? cells[d] : 1;
		y.grid.h[d] = d < dim ? h[d] : 1;
		y.grid.points[d] = d < dim && face != PM_PERIODIC ? cells[d] + 1 : y.grid.cells[d];
		for (int s = 0; s < 2; s++)
			y.grid.face[d][s] = d < dim ? face : PM_PERIODIC;
	}
	const size_t n = pm_grid_size(&y.grid);
	for (int d = 0; d < 3; d++) {
		y.e[d] = pm_zalloc(n, sizeof(double));
		y.b[d] = pm_zalloc(n, sizeof(double));
		for (int k = 0; k < PM_PML_FIELDS && d < dim && pm_yee_open(face); k++)
			y.pml[d][k] = pm_zalloc(n, sizeof(double));
	}
	return y;
}

static void yee_free(struct pm_yee *y)
{
	for (int d = 0; d < 3; d++) {
		pm_free(y->e[d]);
		pm_free(y->b[d]);
		for (int k = 0; k < PM_PML_FIELDS; k++)
			pm_free(y->pml[d][k]);
	}
}

static void noise(struct pm_yee *y, uint64_t seed)
{
	for (size_t i = 0; i < pm_grid_size(&y->grid); i++)
		for (int c = 0; c < 3; c++) {
			double u[2];
			pm_random(seed, i, (uint64_t)c, u);
			y->e[c][i] = u[0] - 0.5;
		}
}

static double products(const struct pm_yee *y, double *const a[3], double *const b[3])
{
	double sum = 0;
	for (int c = 0; c < 3; c++)
		sum += pm_sum_products(pm_grid_size(&y->grid), a[c], b[c]);
	return sum;
}

static const double h[3] = {0.7, 0.55, 0.9};
static const size_t even[3] = {10, 8, 12};

static void test_limit(void)
{
	for (int dim = 1; dim <= 3; dim++) {
		struct pm_yee y = yee_new(dim, even, PM_PERIODIC, h);
		const double dt = 1.001 * pm_yee_limit(&y.grid, 1) / y.c;
		double before = 0;
		noise(&y, 5);
		for (int n = 0; n < 400; n++) {
			if (n == 300)
				before = sqrt(products(&y, y.e, y.e));
			pm_yee_magnetic(&y, dt);
			pm_yee_electric(&y, dt);
		}
		const double rate = log(sqrt(products(&y, y.e, y.e)) / before) / 100;
		/* the fastest mode alone is left: 2 acosh(1.001) */
		check_below(fabs(rate / 0.0894352672166137 - 1), 1e-6, "HC-11: %d-D at 1.001 of the limit grows by %.12f a step (0.0894352672)", dim, rate);
		yee_free(&y);
	}
}

/* Every method at 0.999 of its limit: noise stays bounded in 1-D to 3-D (E^2 may swing by 1/sqrt(1 - 0.999^2) = 22 in amplitude). */
static void test_methods(void)
{
	for (int k = 0; pm_maxwells[k]; k++)
		for (int dim = 1; dim <= 3 && !pm_maxwells[k]->advance; dim++) { /* psatd has no limit (unit psatd) */
			struct pm_yee y = yee_new(dim, even, PM_PERIODIC, h);
			const double dt = 0.999 * pm_maxwells[k]->limit(&y.grid) / y.c;
			double most = 0;
			noise(&y, 8);
			const double first = products(&y, y.e, y.e);
			for (int n = 0; n < 800; n++) {
				pm_maxwells[k]->magnetic(&y, dt);
				pm_maxwells[k]->electric(&y, dt);
				check_worst(&most, products(&y, y.e, y.e) / first);
			}
			check(most < 600, "%s in %d-D stays bounded at 0.999 of its limit (E^2 up to %.3g of the start)", pm_maxwell_names[k], dim, most);
			yee_free(&y);
		}
}

/* cole-karkkainen at c dt = h in cubic cells: a wave along an axis returns after one period of the box as it was. fourth: the order of its frequency. */
static void test_waves(void)
{
	double error[3];
	for (int m = 0; m < 4; m++) {
		const size_t n = m ? (size_t)8 << m : 12, cells[3] = {n, 6, 8};
		const double one[3] = {1, 1, 1};
		struct pm_yee y = yee_new(3, cells, PM_PERIODIC, one);
		const struct pm_maxwell *method = pm_maxwell_find(m ? "fourth" : "cole-karkkainen");
		const double k = 2 * pm_pi / (double)n, dt = (m ? 1e-3 : 1) / y.c;
		double a[3] = {0};
		for (size_t i = 0; i < pm_grid_size(&y.grid); i++)
			y.e[1][i] = cos(k * (double)(i % n));
		method->magnetic(&y, 0.5 * dt);
		for (int s = 0; s < 3; s++) {
			a[s] = y.e[1][0];
			method->electric(&y, dt);
			method->magnetic(&y, dt);
		}
		const double omega = 2 * asin(sqrt(fmax(0, (2 * a[1] - a[0] - a[2]) / (4 * a[1])))) / dt;
		if (m)
			error[m - 1] = fabs(omega / (y.c * k) - 1 - k * k * 1e-6 / 24);
		else
			check(fabs(omega / (y.c * k) - 1) < 1e-13, "cole-karkkainen at c dt = h has no dispersion along an axis (%.2g)", omega / (y.c * k) - 1);
		yee_free(&y);
	}
	const double order = log2(error[0] / error[2]) / 2;
	check(order > 3.9 && error[0] < 2e-4, "fourth is of order %.3f in the cell (error %.2g at 16 cells)", order, error[0]);
}

static void test_energy(void)
{
	for (int dim = 1; dim <= 3; dim++) {
		struct pm_yee y = yee_new(dim, even, PM_PERIODIC, h);
		const double dt = 0.999 * pm_yee_limit(&y.grid, 1) / y.c;
		const int steps = dim == 1 ? 100000 : 1500;
		double *old[3], first = 0, worst = 0;
		noise(&y, 6);
		for (int c = 0; c < 3; c++)
			old[c] = pm_zalloc(pm_grid_size(&y.grid), sizeof(double));
		for (int n = 0; n < steps; n++) {
			for (int c = 0; c < 3; c++)
				memcpy(old[c], y.b[c], pm_grid_size(&y.grid) * sizeof(double));
			pm_yee_magnetic(&y, dt);
			const double energy = products(&y, y.e, y.e) + y.c * y.c * products(&y, old, y.b);
			first = n ? first : energy;
			check_worst(&worst, fabs(energy / first - 1));
			pm_yee_electric(&y, dt);
		}
		check_below(worst, 1e-10, "HC-11: %d-D at 0.999 of the limit keeps E^2 + c^2 B.B over %d steps", dim, steps);
		for (int c = 0; c < 3; c++)
			pm_free(old[c]);
		yee_free(&y);
	}
}

/* E_z = f(k x) g(l y) in a box: sines between conductors, cosines between planes of symmetry. */
static void test_cavity(void)
{
	for (int neumann = 0; neumann < 2; neumann++) {
		const size_t cells[3] = {20, 14, 1};
		struct pm_yee y = yee_new(2, cells, neumann ? PM_NEUMANN : PM_WALL, h);
		const double dt = 0.9 * pm_yee_limit(&y.grid, 1) / y.c, k[2] = {pm_pi / 20, 2 * pm_pi / 14}; /* per cell */
		const double s = y.c * dt * hypot(sin(k[0] / 2) / h[0], sin(k[1] / 2) / h[1]), want = 1 - 2 * s * s; /* cos(omega dt) */
		double worst = 0, a[3] = {0};
		for (size_t j = 0; j < y.grid.points[1]; j++)
			for (size_t i = 0; i < y.grid.points[0]; i++)
				y.e[2][j * y.grid.points[0] + i] = neumann ? cos(k[0] * (double)i) * cos(k[1] * (double)j)
					: sin(k[0] * (double)i) * sin(k[1] * (double)j);
		const size_t at = 3 * y.grid.points[0] + 4;
		pm_yee_magnetic(&y, 0.5 * dt);
		for (int n = 0; n < 200; n++) {
			a[0] = a[1], a[1] = a[2], a[2] = y.e[2][at];
			if (n > 1)
				check_worst(&worst, fabs(a[0] + a[2] - 2 * want * a[1]));
			pm_yee_electric(&y, dt);
			pm_yee_magnetic(&y, dt);
		}
		check(worst < 1e-13, "a mode between %s has its frequency (off by %.2g)", neumann ? "planes of symmetry" : "conductors", worst);
		yee_free(&y);
	}
}

/* A pulse in the middle of a box, run until it has left: what is left of it over what was there. */
static double left(int dim, size_t n, int layers, int steps, double *probe)
{
	const size_t cells[3] = {n, n, 1};
	const double one[3] = {1, 1, 1};
	struct pm_yee y = yee_new(dim, cells, PM_OPEN, one);
	y.layers = layers;
	const double dt = 0.9 * pm_yee_limit(&y.grid, 1) / y.c;
	const size_t middle = n / 2, row = y.grid.points[0], centre = dim > 1 ? middle * row + middle : middle;
	double most = 0;
	for (size_t j = 0; j < y.grid.points[1]; j++)
		for (size_t i = 0; i < row; i++) {
			const double x = (double)i - (double)middle, z = dim > 1 ? (double)j - (double)middle : 0;
			y.e[2][j * row + i] = exp(-(x * x + z * z) / 18);
		}
	pm_yee_magnetic(&y, 0.5 * dt);
	for (int k = 0; k < steps; k++) {
		pm_yee_electric(&y, dt);
		pm_yee_magnetic(&y, dt);
		probe[k] = y.e[2][centre + 12];
	}
	for (size_t i = 0; i < pm_grid_size(&y.grid); i++)
		most = fmax(most, fabs(y.e[2][i]));
	yee_free(&y);
	return most;
}

static void test_layers(void)
{
	static double small[400], large[400];
	const double thin = left(1, 80, 5, 200, small), thick = left(1, 80, 10, 200, small);
	check(thin < 2e-4 && thick < 1e-6, "a pulse leaves a line through layers of 5 and 10 cells (%.2g and %.2g are left)", thin, thick);
	double worst = 0;
	left(2, 60, 10, 160, small);
	left(2, 400, 10, 160, large);
	for (int k = 0; k < 160; k++)
		check_worst(&worst, fabs(small[k] - large[k]));
	check(worst < 1e-4, "in the plane layers of 10 cells send back %.2g of a pulse, against a box that no echo crosses", worst);
}

static void test_threads(void)
{
	double *kept = NULL;
	bool same = true;
	for (int t = 0; t < 3; t++) {
		const size_t cells[3] = {33, 30, 31};
		struct pm_yee y = yee_new(3, cells, PM_OPEN, h);
		y.layers = 6;
		noise(&y, 7);
		pm_threads_use((const int[]){1, 2, 7}[t]);
		for (int n = 0; n < 3; n++) {
			pm_yee_magnetic(&y, 0.1);
			pm_yee_electric(&y, 0.2);
		}
		const size_t bytes = pm_grid_size(&y.grid) * sizeof(double);
		kept = kept ? kept : memcpy(pm_alloc(bytes, 1), y.e[1], bytes);
		same = same && !memcmp(kept, y.e[1], bytes);
		yee_free(&y);
	}
	pm_free(kept);
	check(same, "1, 2 and 7 threads give the same bytes");
}

int main(void)
{
	test_limit();
	test_methods();
	test_waves();
	test_energy();
	test_cavity();
	test_layers();
	test_threads();
	return check_done();
}
