/* Inversion of tabulated densities. Between nodes the density is linear, its integral quadratic, the inverse a square root: the result has exactly the
 * distribution of that polygon, which differs from a smooth density by f'' h^2/12, 1e-10 of it with 65536 intervals to a wave.
 * Source: Devroye 1986, Non-Uniform Random Variate Generation, section II.2. Cost log n a value. SPDX-License-Identifier: GPL-3.0-or-later */
#include "load/inverse.h"

static double mix(const struct pm_density_columns *d, const double *const a[4], size_t i)
{
	double s = 0;
	for (int k = 0; k < d->columns; k++)
		s += d->weight[k] * a[k][i];
	return s;
}

double pm_density_invert(const struct pm_density_columns *d, size_t n, double u)
{
	const double target = u * mix(d, d->sum, n);
	size_t low = 0, high = n;
	while (high - low > 1) {
		const size_t middle = low + (high - low) / 2;
		if (mix(d, d->sum, middle) <= target)
			low = middle;
		else
			high = middle;
	}
	const double a = mix(d, d->value, low), b = mix(d, d->value, low + 1), y = fmax(0, target - mix(d, d->sum, low));
	const double root = a + sqrt(fmax(0, a * a + 2 * (b - a) * y));
	return (double)low + (root > 0 ? fmin(1, 2 * y / root) : 0);
}

void pm_density_integrate(const double *value, size_t n, double *sum)
{
	sum[0] = 0;
	for (size_t i = 0; i < n; i++)
		sum[i + 1] = sum[i] + 0.5 * (value[i] + value[i + 1]);
}

int pm_inverse_init(struct pm_inverse *t, size_t n, double from, double to, double (*f)(const void *context, double x), const void *context,
	const char *what)
{
	*t = (struct pm_inverse){.from = from, .to = to, .n = n, .value = pm_alloc(n + 1, sizeof(double)), .sum = pm_alloc(n + 1, sizeof(double))};
	if (!t->value || !t->sum)
		return -PM_DATA;
	for (size_t i = 0; i <= n; i++) {
		const double x = from + (to - from) * (double)i / (double)n;
		t->value[i] = f(context, x);
		if (!(t->value[i] >= 0 && t->value[i] < HUGE_VAL))
			return pm_fail(PM_USAGE, "%s is %g at %g, and a density is not negative (max(0, ...), or a narrower --range)", what, t->value[i], x);
	}
	pm_density_integrate(t->value, n, t->sum);
	return t->sum[n] > 0 ? 0 : pm_fail(PM_USAGE, "%s is 0 everywhere from %g to %g", what, from, to);
}

double pm_inverse_at(const struct pm_inverse *t, double u)
{
	const struct pm_density_columns d = {.columns = 1, .value = {t->value}, .sum = {t->sum}, .weight = {1}};
	return t->to > t->from ? t->from + (t->to - t->from) * pm_density_invert(&d, t->n, u) / (double)t->n : t->from;
}

void pm_inverse_free(struct pm_inverse *t)
{
	pm_free(t->value);
	pm_free(t->sum);
	*t = (struct pm_inverse){0};
}
