/* Every promise of the kernels' table, and the numbers of RM-01.
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
				worst = fmax(worst, fabs(sum));
			else
				next = fmax(next, fabs(sum));
		}
		for (int i = 0; i < k->width; i++)
			least = fmin(least, w[i]);
	}
	/* 1e-14: a few roundings of terms not larger than width^moments. */
	check(worst <= 1e-14, "%s: moments 0..%d at 1000 random offsets are exact (worst %.2g, tolerance 1e-14)", k->name, k->moments, worst);
	check(next > 1e-3, "%s: moment %d is not zero, the claim is sharp (%.3g)", k->name, k->moments + 1, next);
	/* Where a weight vanishes Horner leaves one rounding of its largest term. */
	check((least >= -2e-16) == k->positive, "%s: is%s positive (least weight %.3g)", k->name, k->positive ? "" : " not", least);
}

/* The d-th derivative of the weight of point i at t. */
static double derivative(const struct pm_kernel *k, int i, int d, double t)
{
	double sum = 0;
	for (int power = k->degree; power >= d; power--) {
		double factor = 1;
		for (int m = 0; m < d; m++)
			factor *= power - m;
		sum = sum * t + factor * k->coefficients[power * k->width + i];
	}
	return sum;
}

/* A point's weight when the particle leaves its cell upwards is the weight it has as the point below in the next cell. */
static void check_smooth(const struct pm_kernel *k)
{
	double jump[PM_KERNEL_WIDTH] = {0}, low = t_low(k), high = low + 1;
	for (int d = 0; d <= k->smooth + 1; d++)
		for (int i = 0; i <= k->width; i++) {
			double before = i < k->width ? derivative(k, i, d, high) : 0, after = i > 0 ? derivative(k, i - 1, d, low) : 0;
			jump[d] = fmax(jump[d], fabs(before - after));
		}
	double worst = 0;
	for (int d = 0; d <= k->smooth; d++)
		worst = fmax(worst, jump[d]);
	check(worst <= 1e-14, "%s: derivatives up to %d are continuous (jump %.2g)", k->name, k->smooth, worst);
	check(jump[k->smooth + 1] > 0.1, "%s: derivative %d jumps, the claim is sharp (%.3g)", k->name, k->smooth + 1, jump[k->smooth + 1]);
}

struct rm01 { /* tests/reference/values.csv, RM-01 */
	const char *name;
	double w[9];      /* at 0, 1/4, ..., 2 */
	double moment;    /* the first moment that is not exact, at x = 3/10 */
	double error[4];  /* of one remesh, N = 32, 64, 128, 256 */
	double shifts[3]; /* amplitude after 100 shifts of 0.3 h at kh = pi/16, pi/8, pi/4 */
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
		worst = fmax(worst, fabs(sum - bump(x - 0.3 * h)));
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
	for (int i = 0; i < 9; i++)
		if (r->w[i] != -1)
			worst = fmax(worst, fmax(fabs(kernel_at(k, i / 4.) - r->w[i]), fabs(kernel_at(k, -i / 4.) - r->w[i])));
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

int main(void)
{
	for (int i = 0; pm_kernels[i]; i++) {
		const struct pm_kernel *k = pm_kernels[i];
		check(pm_kernel_find(k->name) == k && k->width >= 1 && k->width <= PM_KERNEL_WIDTH, "%s: is found by its name, %d points wide", k->name,
			k->width);
		check_moments(k);
		check_smooth(k);
	}
	for (size_t i = 0; i < sizeof rm01 / sizeof *rm01; i++)
		check_rm01(&rm01[i]);
	check(!pm_kernel_find("witch-hat"), "an unknown kernel is not found");
	return check_done();
}
