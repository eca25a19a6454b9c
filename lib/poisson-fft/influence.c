/* Influence functions of the particle-mesh force, in place of 1/lambda, W the transform of the kernel, S that of a cloud of diameter a (S2: density falling
 * linearly to 0 at a/2; 1 for points), k_n = k + 2 pi n/h, D the transform of the gradient:
 *   plain        S(k)^2 / lambda(k)
 *   deconvolved  S(k)^2 / (lambda(k) W(k)^2): one W for the way to the mesh, one for the way back
 *   optimal      - sum_n D.k_n/k_n^2 S(k_n)^2 W(k_n)^2 / (|D|^2 (sum_n W(k_n)^2)^2)
 * A softened Green's function multiplies S^2 by its factor of K epsilon, K^2 = k_n^2 + screening^2.
 * optimal minimises the mean square error of the force over all positions of two clouds in their cells. Interlaced: sums over n1 + n2 + n3 even.
 * Source: Hockney and Eastwood 1988, equations 8-22 and 8-3 ff.; sums of W^2 by Poisson's formula from the autocorrelation of the kernel.
 * Assumes p2m and m2p with the same kernel. Cost: the optimal one (2 reach + 1)^dim terms a mode, once per mesh. SPDX-License-Identifier: GPL-3.0-or-later */
#include "poisson-fft/influence-table.h"

#include <gsl/gsl_errno.h>
#include <gsl/gsl_integration.h>
#include <string.h>

const char *const pm_influence_names[] = {"plain", "deconvolved", "optimal", NULL};
enum { points = 16, reach_most = 4 };

bool pm_influence_same(const struct pm_influence *a, const struct pm_influence *b)
{
	return a->kind == b->kind && a->kernel == b->kernel && a->interlaced == b->interlaced && a->order == b->order && a->cloud == b->cloud;
}

int pm_influence_check(const struct pm_influence *f, const struct pm_grid *g)
{
	for (int d = 0; d < g->dim && pm_influence_any(f); d++)
		if (g->face[d][0] != PM_PERIODIC || g->face[d][1] != PM_PERIODIC)
			return pm_fail(PM_DATA, "--influence and --cloud are for boxes periodic along every axis, and axis %c is %s (leave them out: "
				"--influence plain)", "xyz"[d], pm_face_names[g->face[d][0]]);
	if (f->kind != PM_PLAIN && !f->kernel)
		return pm_fail(PM_DATA, "--influence %s needs the kernel that made the density, and the field carries none (p2m makes one, or --influence "
			"plain)", pm_influence_names[f->kind]);
	if (f->kind != PM_PLAIN && f->kernel->star && g->dim > 1)
		return pm_fail(PM_DATA, "--influence %s is for kernels that are a product of the axes, and %s is not (p2m --kernel tsc, or --influence plain)",
			pm_influence_names[f->kind], f->kernel->name);
	if (f->cloud > 0 && g->dim < 3)
		return pm_fail(PM_DATA, "--cloud is a ball, for boxes in 3-D (leave it out: points)");
	return 0;
}

/* W at distance x [cells]. */
static double value(const struct pm_kernel *k, double x)
{
	double w[PM_KERNEL_WIDTH], node = k->width % 2 ? floor(x + 0.5) : ceil(x);
	int i = (int)node + (k->width - 1) / 2;
	if (i < 0 || i >= k->width)
		return 0;
	pm_kernel_weights(k, node - x, w);
	return w[i];
}

/* Integral of W(x) W(x + shift), or of W(x) cos(theta x): over half cells, in each of which W and its neighbour at a half-integer shift are polynomials. */
static double integral(const struct pm_kernel *k, bool product, double parameter)
{
	gsl_error_handler_t *handler = gsl_set_error_handler_off(); /* GSL's own aborts where memory is short */
	gsl_integration_glfixed_table *t = gsl_integration_glfixed_table_alloc(points);
	gsl_set_error_handler(handler);
	if (!t)
		return pm_no_memory(), NAN;
	double sum = 0;
	for (int i = -k->width; i < k->width; i++)
		for (size_t q = 0; q < points; q++) {
			double x, w;
			gsl_integration_glfixed_point(0.5 * i, 0.5 * (i + 1), q, &x, &w, t);
			sum += w * value(k, x) * (product ? value(k, x + parameter) : cos(parameter * x));
		}
	gsl_integration_glfixed_table_free(t);
	return sum;
}

double pm_kernel_wave(const struct pm_kernel *k, double theta) { return integral(k, false, theta); }

double pm_cloud_wave(double u)
{
	double u2 = u * u;
	if (u < 0.2) /* the closed form loses 4 eps/u^4 */
		return 1 - u2 / 15 * (1 - u2 * (3.0 / 112) * (1 - u2 * (2.0 / 135)));
	return 12 / (u2 * u2) * (2 - 2 * cos(u) - u * sin(u));
}

static double slope(int order, double theta)
{
	if (order == 2)
		return sin(theta);
	if (order == 4)
		return (8 * sin(theta) - sin(2 * theta)) / 6;
	return order == 6 ? (45 * sin(theta) - 9 * sin(2 * theta) + sin(3 * theta)) / 30 : theta;
}

/* W^2 falls as theta^-2, -4, -6 ...: the terms left out are below 1e-3 of a sum. */
static int reach_of(const struct pm_influence *f)
{
	if (f->kind != PM_OPTIMAL)
		return 0;
	return f->kernel->smooth < 0 ? reach_most : f->kernel->smooth == 0 && !(f->cloud > 0) ? 3 : 2;
}

/* Sums of W^2 over the aliases of theta: all, and with the sign (-1)^n, from the autocorrelation at whole and at half cells. */
static void sums(const struct pm_kernel *kernel, const double *whole, const double *half, double theta, double *all, double *sign)
{
	*all = whole[0];
	*sign = 0;
	for (int j = 1; j < kernel->width; j++)
		*all += 2 * whole[j] * cos(j * theta);
	for (int j = 0; j < kernel->width; j++)
		*sign += 2 * half[j] * cos((j + 0.5) * theta);
}

int pm_influence_axis_init(struct pm_influence_axis *a, const struct pm_influence *f, size_t n, double h,
	double (*lambda)(const void *c, double theta, double h), const void *context)
{
	const int reach = n > 1 ? reach_of(f) : 0;
	double whole[PM_KERNEL_WIDTH], half[PM_KERNEL_WIDTH];
	*a = (struct pm_influence_axis){.count = n / 2 + 1, .aliases = 2 * reach + 1};
	size_t modes = a->count, waves = modes * (size_t)a->aliases;
	if (!(a->lambda = pm_zalloc(4 * modes + 2 * waves, sizeof *a->lambda)))
		return -PM_DATA;
	a->slope = a->lambda + modes, a->all = a->slope + modes, a->even = a->all + modes, a->k = a->even + modes, a->window = a->k + waves;
	for (int j = 0; f->kernel && j < f->kernel->width; j++)
		whole[j] = integral(f->kernel, true, j), half[j] = integral(f->kernel, true, j + 0.5);
	for (size_t m = 0; m < modes; m++) {
		double theta = 2 * pm_pi * (double)m / (double)n;
		a->lambda[m] = lambda(context, theta, h);
		a->slope[m] = 2 * m == n ? 0 : slope(f->order, theta) / h;
		a->all[m] = a->even[m] = 1;
		if (f->kind == PM_OPTIMAL && n > 1)
			sums(f->kernel, whole, half, theta, &a->all[m], &a->even[m]);
		for (int s = -reach; s <= reach; s++) {
			size_t at = m * (size_t)a->aliases + (size_t)(s + reach);
			double wave = theta + 2 * pm_pi * s, w = n > 1 && f->kind != PM_PLAIN ? pm_kernel_wave(f->kernel, wave) : 1;
			a->k[at] = wave / h;
			a->window[at] = w * w;
			if (f->kind == PM_DECONVOLVED && fabs(w) < 1e-3)
				return pm_fail(PM_DATA, "kernel %s has a zero transform at wave %zu of %zu cells, so that division is impossible "
					"(--influence optimal, or --kernel tsc)",
					f->kernel->name, m, n);
		}
	}
	return 0;
}

void pm_influence_axis_free(struct pm_influence_axis *a) { a->lambda = pm_free(a->lambda); }

/* S^2, and the factor of a softened Green's function. */
static double cloud2(const struct pm_influence *f, double k2, double screening2)
{
	double s = f->cloud > 0 ? pm_cloud_wave(0.5 * sqrt(k2) * f->cloud) : 1;
	return s * s * (f->factor ? f->factor(sqrt(k2 + screening2) * f->softening) : 1);
}

/* Sum over aliases of D.k/(k^2 + K^2) S^2 W^2. */
static double numerator(const struct pm_influence *f, const struct pm_influence_axis axis[3], double screening2, const size_t mode[3])
{
	const int n[3] = {axis[0].aliases, axis[1].aliases, axis[2].aliases};
	const double *kx = axis[0].k + mode[0] * (size_t)n[0], *wx = axis[0].window + mode[0] * (size_t)n[0];
	double sum = 0;
	for (int c = 0; c < n[2]; c++)
		for (int b = 0; b < n[1]; b++) {
			double ky = axis[1].k[mode[1] * (size_t)n[1] + (size_t)b], kz = axis[2].k[mode[2] * (size_t)n[2] + (size_t)c];
			double w = axis[1].window[mode[1] * (size_t)n[1] + (size_t)b] * axis[2].window[mode[2] * (size_t)n[2] + (size_t)c];
			double across = axis[1].slope[mode[1]] * ky + axis[2].slope[mode[2]] * kz, k2 = ky * ky + kz * kz;
			for (int i = 0; i < n[0]; i++) {
				bool odd = (i - n[0] / 2 + b - n[1] / 2 + c - n[2] / 2) & 1;
				double q2 = k2 + kx[i] * kx[i];
				if (!(odd && f->interlaced) && q2 > 0)
					sum += w * wx[i] * (across + axis[0].slope[mode[0]] * kx[i]) / (q2 + screening2) * cloud2(f, q2, screening2);
			}
		}
	return sum;
}

static double optimal(const struct pm_influence *f, const struct pm_influence_axis axis[3], double screening2, const size_t mode[3])
{
	double slope2 = 0, all = 1, even = 1;
	for (int d = 0; d < 3; d++) {
		const struct pm_influence_axis *a = &axis[d];
		slope2 += a->slope[mode[d]] * a->slope[mode[d]];
		all *= a->all[mode[d]];
		even *= a->even[mode[d]];
	}
	double sum = f->interlaced ? 0.5 * (all + even) : all;
	return slope2 > 0 ? -numerator(f, axis, screening2, mode) / (slope2 * sum * sum) : 0; /* a mode on which the gradient is 0 gives no force */
}

void pm_influence_row(const struct pm_influence *f, const struct pm_influence_axis axis[3], double screening2, size_t j, size_t k, double *row)
{
	for (size_t i = 0; i < axis[0].count; i++) {
		const size_t mode[3] = {i, j, k};
		if (f->kind == PM_OPTIMAL) {
			row[i] = optimal(f, axis, screening2, mode);
			continue;
		}
		double sum = -screening2, k2 = 0, window = 1;
		for (int d = 0; d < 3; d++) {
			sum += axis[d].lambda[mode[d]];
			k2 += axis[d].k[mode[d]] * axis[d].k[mode[d]];
			window *= axis[d].window[mode[d]];
		}
		row[i] = sum < 0 ? cloud2(f, k2, screening2) / (sum * window) : 0;
	}
}
