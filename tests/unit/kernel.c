/* Every property in the kernels' table, and the numbers of RM-01, RM-02 and RM-03.
 * SPDX-License-Identifier: GPL-3.0-or-later */
#include <complex.h>
#include <string.h>

#include "check.h"
#include "kernel/kernel.h"

/* Position of the first point and the start of t relative to the base point. */
static int first_point(const struct pm_kernel *k) { return -((k->width - 1) / 2); }
static double t_low(const struct pm_kernel *k) { return k->width % 2 ? -0.5 : 0; }

/* W at distance x (particle at the origin of the kernel, point at x). */
static double kernel_at(const struct pm_kernel *k, double x)
{
	double base = floor(-x - t_low(k)), w[PM_KERNEL_WIDTH]; /* the particle sits at -x, the point at 0 */
	int i = (int)(-base) - first_point(k);
	pm_kernel_weights(k, -x - base, w);
	return i < 0 || i >= k->width ? 0 : w[i];
}

static void check_moments(const struct pm_kernel *k)
{
	double worst = 0, next = 0, least = 0;
	/* A few roundings of the largest terms: up to (width/2)^moments times weights of a tenth, and 1 at least. */
	double tolerance = 1e-14 * fmax(1, pow(0.5 * k->width, k->moments) / 10);
	for (uint64_t p = 0; p < 1000; p++) {
		double u[2], w[PM_KERNEL_WIDTH];
		pm_random(1, p, 0, u);
		double t = u[0] + t_low(k);
		pm_kernel_weights(k, t, w);
		for (int order = 0; order <= k->moments + 1; order++) {
			double sum = order == 0 ? -1 : 0;
			for (int i = 0; i < k->width; i++)
				sum += w[i] * pow(first_point(k) + i - t, order);
			if (order <= k->moments)
				check_worst(&worst, fabs(sum));
			else
				check_worst(&next, fabs(sum));
		}
		for (int i = 0; i < k->width; i++)
			check_least(&least, w[i]);
	}
	check(worst <= tolerance, "%s: moments 0..%d at 1000 random offsets are exact (worst %.2g, tolerance %.2g)", k->name, k->moments, worst,
		tolerance);
	check(next > 1e-3, "%s: moment %d is not zero, the claim is sharp (%.3g)", k->name, k->moments + 1, next);
	/* Where a weight vanishes Horner leaves one rounding of its largest term. */
	check((least >= -2e-16) == k->positive, "%s: is%s positive (least weight %.3g)", k->name, k->positive ? "" : " not", least);
}

/* The d-th derivative of the weight of point i at t, and the size of its terms. */
static double derivative(const struct pm_kernel *k, int i, int d, double t, double *size)
{
	double sum = 0;
	*size = 1;
	for (int power = k->degree; power >= d; power--) {
		double factor = 1;
		for (int m = 0; m < d; m++)
			factor *= power - m;
		sum = sum * t + factor * k->coefficients[power * k->width + i];
		check_worst(size, fabs(factor * k->coefficients[power * k->width + i]));
	}
	return sum;
}

/* When a particle crosses into the next cell, the weight of a point must be continuous. */
static void check_smooth(const struct pm_kernel *k)
{
	double jump[PM_KERNEL_WIDTH] = {0}, low = t_low(k), high = low + 1, relative = 0, size = 1;
	for (int d = 0; d <= k->smooth + 1; d++)
		for (int i = 0; i <= k->width; i++) {
			double after = i > 0 ? derivative(k, i - 1, d, low, &size) : 0, before = i < k->width ? derivative(k, i, d, high, &size) : 0;
			check_worst(&jump[d], fabs(before - after));
			if (d <= k->smooth)
				check_worst(&relative, fabs(before - after) / size);
		}
	/* 1e-14: some ten roundings of terms that cancel. */
	check(relative <= 1e-14, "%s: derivatives up to %d are continuous (jump %.2g of their largest term)", k->name, k->smooth, relative);
	check(jump[k->smooth + 1] > 0.1, "%s: derivative %d jumps, the claim is sharp (%.3g)", k->name, k->smooth + 1, jump[k->smooth + 1]);
}

/* RM-02: the weights add to 1, on 501 shifts as the reference, ends included. */
static void check_unity(const struct pm_kernel *k)
{
	double worst = 0, w[PM_KERNEL_WIDTH];
	for (int s = 0; s <= 500; s++) {
		double sum = -1;
		pm_kernel_weights(k, s / 500. + t_low(k), w);
		for (int i = 0; i < k->width; i++)
			sum += w[i];
		check_worst(&worst, fabs(sum));
	}
	/* The case allows 1e-13; with t from the nearest node all kernels have only a few rounding errors. */
	check(worst <= 1e-15, "RM-02: the weights of %s add to 1 within %.2g (tolerance 1e-15)", k->name, worst);
}

/* For a particle on a node an interpolating kernel gives exactly 0 at all other nodes. */
static void check_node(const struct pm_kernel *k)
{
	double w[PM_KERNEL_WIDTH], beside = 0;
	int node = -first_point(k);
	if (k->width % 2 || k->moments < 2)
		return;
	pm_kernel_weights(k, 0, w);
	for (int i = 0; i < k->width; i++)
		beside += i == node ? 0 : fabs(w[i]);
	check(w[node] == 1 && beside == 0, "%s: a particle at a node gives everything to that node, exactly", k->name);
}

/* RM-01: no wave grows, for any shift: |sum_i W(i - t) exp(-i kh)| <= 1. 1e-9 as the reference. */
static void check_von_neumann(const struct pm_kernel *k)
{
	double most = 0, w[PM_KERNEL_WIDTH];
	for (int s = 0; s <= 100; s++)
		for (int m = 0; m <= 200; m++) {
			double complex sum = 0;
			pm_kernel_weights(k, s / 100. + t_low(k), w);
			for (int i = 0; i < k->width; i++)
				sum += w[i] * cexp(-I * pm_pi * m / 200 * i);
			check_worst(&most, cabs(sum));
		}
	check(most <= 1 + 1e-9, "RM-01: no wave grows in a remeshing with %s, at any shift (largest factor 1 %+.2g)", k->name, most - 1);
}

/* RM-03: the largest and least value after one remesh of a unit step are partial sums of the weights. */
static void check_overshoot(const char *name, double want, double tolerance)
{
	const struct pm_kernel *k = pm_kernel_find(name);
	double over = 0, under = 0, w[PM_KERNEL_WIDTH];
	for (int s = 0; s <= 60000; s++) {
		double sum = 0;
		pm_kernel_weights(k, s / 60000. + t_low(k), w);
		for (int i = 0; i < k->width; i++) {
			sum += w[i];
			check_worst(&over, sum - 1);
			check_least(&under, sum);
		}
	}
	check(fabs(over - want) <= tolerance && fabs(under + want) <= tolerance,
		"RM-03: a step remeshed by %s overshoots by %.8g and undershoots by %.8g (want %.8g, tolerance %.2g)", name, over, -under, want, tolerance);
}

enum { RM01_VALUES = 17 };
struct rm01 { /* tests/reference/values.csv, RM-01 */
	const char *name;
	double w[RM01_VALUES]; /* at 0, 1/4, ..., 4 */
	double moment;         /* the first moment that is not exact, at x = 3/10 */
	double error[4];       /* of one remesh, N = 32, 64, 128, 256 */
	double shifts[3];      /* amplitude after 100 shifts of 0.3 h at kh = pi/16, pi/8, pi/4 */
};

static const struct rm01 rm01[] = {
	{"ngp", {1, 1, -1}, 3. / 10, {7.486028e-02, 3.789186e-02, 1.893984e-02, 9.476784e-03}, {1, 1, 1}}, /* W(1/2): ties are a convention */
	{"cic", {1, 3. / 4, 1. / 2, 1. / 4}, 21. / 100, {1.716133e-02, 4.489063e-03, 1.135035e-03, 2.845624e-04},
		{0.6668793588, 0.1969824138, 0.001411251773}},
	{"tsc", {3. / 4, 11. / 16, 1. / 2, 9. / 32, 1. / 8, 1. / 32}, 1. / 4, {2.048712e-02, 5.347768e-03, 1.351461e-03, 3.387791e-04},
		{0.6174153865, 0.1447912004, 0.0004143175183}},
	{"pcs", {2. / 3, 235. / 384, 23. / 48, 121. / 384, 1. / 6, 9. / 128, 1. / 48, 1. / 384}, 1. / 3,
		{2.723932e-02, 7.124469e-03, 1.801562e-03, 4.516809e-04}, {0.5258042882, 0.07618229684, 3.186958023e-05}},
	{"m4prime", {1, 111. / 128, 9. / 16, 29. / 128, 0, -9. / 128, -1. / 16, -3. / 128}, -21. / 250,
		{1.981238e-03, 1.971525e-04, 2.257449e-05, 2.751654e-06}, {0.9975540722, 0.9619883394, 0.5519685161}},
	{"lambda-2-1", {1, 111. / 128, 9. / 16, 29. / 128, 0, -9. / 128, -1. / 16, -3. / 128}, -21. / 250,
		{1.981238e-03, 1.971525e-04, 2.257449e-05, 2.751654e-06}, {0.9975540722, 0.9619883394, 0.5519685161}},
	{"lambda-2-2", {1, 915. / 1024, 9. / 16, 205. / 1024, 0, -81. / 1024, -1. / 16, -15. / 1024}, -3423. / 25000,
		{2.479234e-03, 2.937250e-04, 3.587612e-05, 4.459280e-06}, {0.9978152615, 0.9660087992, 0.5894920224}},
	{"m6prime", {1, 3665. / 4096, 75. / 128, 955. / 4096, 0, -893. / 8192, -25. / 256, -295. / 8192, 0, 117. / 8192, 3. / 256, 23. / 8192},
		3423. / 6250, {3.535358e-04, 1.054591e-05, 3.257318e-07, 1.013588e-08}, {0.9999824009, 0.9988947768, 0.9363965074}},
	{"lambda-4-2", {1, 3665. / 4096, 75. / 128, 955. / 4096, 0, -893. / 8192, -25. / 256, -295. / 8192, 0, 117. / 8192, 3. / 256, 23. / 8192},
		3423. / 6250, {3.535358e-04, 1.054591e-05, 3.257318e-07, 1.013588e-08}, {0.9999824009, 0.9988947768, 0.9363965074}},
	{"lambda-6-4", {1, 1902663. / 2097152, 1225. / 2048, 499737. / 2097152, 0, -1383669. / 10485760, -245. / 2048, -469611. / 10485760, 0,
		301063. / 10485760, 49. / 2048, 62937. / 10485760, 0, -34209. / 10485760, -5. / 2048, -2751. / 10485760}, -343539063. / 50000000,
		{8.684725e-05, 7.838840e-07, 6.390892e-09, 5.023482e-11}, {0.9999998686, 0.9999672286, 0.9924783294}},
};

static double bump(double x)
{
	x -= 2 * floor((x + 1) / 2);
	return exp(-x * x / (2 * 0.15 * 0.15));
}

/* Particles start at the nodes of [-1,1) with u = exp(-x^2/(2 0.15^2)), move by 0.3 h and are remeshed: the greatest error at a node. */
static double remesh_error(const struct pm_kernel *k, int n)
{
	double h = 2.0 / n, worst = 0, w[PM_KERNEL_WIDTH];
	pm_kernel_weights(k, 0.3, w);
	for (int j = 0; j < n; j++) {
		double sum = 0, x = -1 + j * h;
		for (int i = 0; i < k->width; i++)
			sum += w[i] * bump(x - (first_point(k) + i) * h);
		check_worst(&worst, fabs(sum - bump(x - 0.3 * h)));
	}
	return worst;
}

static double shifted(const struct pm_kernel *k, double kh)
{
	double complex sum = 0;
	double w[PM_KERNEL_WIDTH];
	pm_kernel_weights(k, 0.3, w);
	for (int i = 0; i < k->width; i++)
		sum += w[i] * cexp(-I * kh * (first_point(k) + i));
	return pow(cabs(sum), 100);
}

static void check_rm01(const struct rm01 *r)
{
	const struct pm_kernel *k = pm_kernel_find(r->name);
	double worst = 0, moment = 0, w[PM_KERNEL_WIDTH], error[4];
	for (int i = 0; i < RM01_VALUES; i++)
		if (r->w[i] != -1)
			check_worst(&worst, fabs(kernel_at(k, i / 4.) - r->w[i])), check_worst(&worst, fabs(kernel_at(k, -i / 4.) - r->w[i]));
	check(worst <= 1e-14, "RM-01: %s has the rational values at multiples of 1/4 (worst %.2g, tolerance 1e-14)", k->name, worst);
	pm_kernel_weights(k, 0.3, w);
	for (int i = 0; i < k->width; i++)
		moment += w[i] * pow(0.3 - first_point(k) - i, k->moments + 1);
	check_near(moment, r->moment, 1e-14, "RM-01: the first moment that is not exact");
	for (int i = 0; i < 4; i++) {
		error[i] = remesh_error(k, 32 << i);
		check_near(error[i], r->error[i], 1e-3 * r->error[i], "RM-01: the error of one remesh");
	}
	const double kh[3] = {pm_pi / 16, pm_pi / 8, pm_pi / 4};
	for (int i = 0; i < 3; i++) /* the reference has ten digits */
		check_near(shifted(k, kh[i]), r->shifts[i], 1e-9, "RM-01: the amplitude after 100 shifts of 0.3 h");
	const double h[3] = {1. / 64, 1. / 128, 1. / 256};
	check_order(3, h, error + 1, k->moments + 1, k->name);
}

/* Three points, exact to the second moment; beyond it u^3 - u, and the scheme of Lax and Wendroff, |g|^2 = 1 - 4 c^2 (1 - c^2) sin^4(kh/2) at a shift c. */
static void check_three_points(void)
{
	const struct pm_kernel *k = pm_kernel_find("lambda-2");
	double w[PM_KERNEL_WIDTH], third = 0;
	pm_kernel_weights(k, 0.3, w);
	for (int i = 0; i < 3; i++)
		third += w[i] * pow(0.3 - first_point(k) - i, 3);
	check_near(third, 0.027 - 0.3, 1e-15, "lambda-2: the third moment is u^3 - u");
	check_near(kernel_at(k, 0.25), 15. / 16, 1e-15, "lambda-2 at 1/4");
	check_near(kernel_at(k, -0.75), 5. / 32, 1e-15, "lambda-2 at -3/4");
	check_near(kernel_at(k, 1.25), -3. / 32, 1e-15, "lambda-2 at 5/4");
	check_near(kernel_at(k, 0.5 - 1e-9) - kernel_at(k, 0.5 + 1e-9), 3. / 8, 1e-8, "lambda-2 jumps by 3/8 at 1/2");
	check_near(kernel_at(k, 1.5 - 1e-9), -1. / 8, 1e-8, "lambda-2 jumps from -1/8 at 3/2");
	const double s = sin(pm_pi / 16);
	check_near(shifted(k, pm_pi / 8), pow(1 - 4 * 0.09 * 0.91 * s * s * s * s, 50), 1e-13, "lambda-2: a wave of 16 cells after 100 shifts of 0.3 h");
}

/* The star along dim axes at a shift of half a cell amplifies a wave along the diagonal, |g|^2 = (1 - dim (1 - c)/4)^2 + dim^2 (1 - c^2)/4, c = cos kh: at
 * most 4/3 in the plane, 7/3 in space; no other kernel does. It has no mixed moment: that of the nearest point is off by t_x t_y. */
static void check_star(void)
{
	const struct pm_kernel *k = pm_kernel_find("star"), *one = pm_kernel_find("lambda-2");
	double w[PM_KERNEL_WIDTH], most[4] = {0};
	check(k->star && !memcmp(k->coefficients, one->coefficients, 9 * sizeof(double)), "star: along one axis it is lambda-2");
	pm_kernel_weights(k, 0.5, w);
	for (int dim = 2; dim <= 3; dim++)
		for (int m = 0; m <= 3000; m++) {
			double complex sum = 1;
			for (int i = 0; i < 3; i++)
				sum += dim * w[i] * (cexp(-I * pm_pi * m / 3000 * (i - 1)) - 1);
			check_worst(&most[dim], cabs(sum) * cabs(sum));
		}
	check_near(most[2], 4. / 3, 1e-6, "star: a wave in the plane grows at most by this, squared, in a remeshing");
	check_near(most[3], 7. / 3, 1e-6, "star: and in space");
}

/* The published polynomial of the innermost branch, rational values of the others, the ninth moment at 3/10, and order 9 for a periodic function. */
static void check_ten_points(void)
{
	const struct pm_kernel *k = pm_kernel_find("lambda-8-4");
	static const double published[] = {1, 0, -205. / 144, 0, 91. / 192, -6181. / 320, 6337. / 96, -2745. / 32, 28909. / 576, -3569. / 320};
	static const double quarters[] = {-1184697. / 8388608, -2205. / 16384, -478107. / 8388608, 0, 2260799. / 58720256, 567. / 16384, 678501. / 58720256, 0,
		-1763379. / 234881024, -405. / 65536, -325785. / 234881024};
	double worst = 0, ninth = 0, w[PM_KERNEL_WIDTH], error[3], h[3];
	for (double x = 0; x <= 1; x += 1. / 64) {
		double sum = 0;
		for (int power = 9; power >= 0; power--)
			sum = sum * x + published[power];
		check_worst(&worst, fabs(kernel_at(k, x) - sum));
		check_worst(&worst, fabs(kernel_at(k, -x) - sum));
	}
	for (int i = 0; i < 11; i++)
		check_worst(&worst, fabs(kernel_at(k, 1.25 + i / 4.) - quarters[i]));
	check(worst <= 1e-13, "lambda-8-4: the published branch for |x| < 1, rational values at quarters beyond (worst %.2g, tolerance 1e-13)", worst);
	pm_kernel_weights(k, 0.3, w);
	for (int i = 0; i < k->width; i++)
		ninth += w[i] * pow(0.3 - first_point(k) - i, 9);
	check_near(ninth, 1370738943. / 12500000, 1e-10, "lambda-8-4: the first moment that is not exact");
	check_near(shifted(k, pm_pi / 4), 0.9989982865, 1e-9, "lambda-8-4: a wave of 8 cells after 100 shifts of 0.3 h");
	for (int m = 0; m < 3; m++) {
		const int n = 40 + 20 * m + 5 * m * (m - 1);
		h[m] = 2 * pm_pi / n, error[m] = 0;
		for (int j = 0; j < n; j++) {
			double sum = -exp(sin(h[m] * (j + 0.3)));
			for (int i = 0; i < k->width; i++)
				sum += w[i] * exp(sin(h[m] * (j + first_point(k) + i)));
			check_worst(&error[m], fabs(sum));
		}
	}
	check_order(3, h, error, 9, k->name);
}

int main(void)
{
	check_three_points();
	check_ten_points();
	check_star();
	for (int i = 0; pm_kernels[i]; i++) {
		const struct pm_kernel *k = pm_kernels[i];
		check(pm_kernel_find(k->name) == k && k->width >= 1 && k->width <= PM_KERNEL_WIDTH, "%s: is found by its name, %d points wide", k->name,
			k->width);
		check_moments(k);
		check_smooth(k);
		check_unity(k);
		check_node(k);
		check_von_neumann(k);
	}
	for (size_t i = 0; i < sizeof rm01 / sizeof *rm01; i++)
		check_rm01(&rm01[i]);
	const char *const monotone[] = {"ngp", "cic", "tsc", "pcs"};
	for (int i = 0; i < 4; i++)
		check_overshoot(monotone[i], 0, 4.5e-16); /* two roundings of 1 */
	check_overshoot("m4prime", 2. / 27, 1e-9);
	check_overshoot("lambda-2", 1. / 8, 1e-9);
	check_overshoot("lambda-2-2", 0.08251744, 1e-6);
	check_overshoot("m6prime", 0.10156766, 1e-6);
	check_overshoot("lambda-6-4", 0.11657810, 1e-6);
	check_overshoot("lambda-8-4", 0.12114576, 1e-6);
	check(!pm_kernel_find("witch-hat"), "an unknown kernel is not found");
	return check_done();
}
