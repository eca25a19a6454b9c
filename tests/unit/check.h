/* Checks of the unit tests: one line each, `ok - sentence` or `not ok - sentence` with got, want and tolerance; main returns check_done().
 * SPDX-License-Identifier: GPL-3.0-or-later */
#ifndef PM_CHECK_H
#define PM_CHECK_H

#include <math.h>
#include <stdarg.h>
#include <stdbool.h>
#include <stdio.h>

static int check_failed, check_count;

__attribute__((format(printf, 2, 3), unused)) static bool check(bool good, const char *format, ...)
{
	va_list ap;
	va_start(ap, format);
	printf("%sok - ", good ? "" : "not ");
	vprintf(format, ap);
	putchar('\n');
	va_end(ap);
	check_count++;
	check_failed += !good;
	return good;
}

/* |got - want| <= tolerance; not a number never passes. */
__attribute__((unused)) static bool check_near(double got, double want, double tolerance, const char *sentence)
{
	bool good = fabs(got - want) <= tolerance;
	if (good)
		return check(true, "%s", sentence);
	return check(false, "%s (got %.17g, want %.17g, tolerance %g)", sentence, got, want, tolerance);
}

/* The order of convergence by least squares of log(error) on log(h), from n >= 3 resolutions, is at least claim - 0.1. */
__attribute__((unused)) static bool check_order(int n, const double *h, const double *error, double claim, const char *sentence)
{
	double sx = 0, sy = 0, sxx = 0, sxy = 0;
	for (int i = 0; i < n; i++) {
		double x = log(h[i]), y = log(error[i]);
		sx += x, sy += y, sxx += x * x, sxy += x * y;
	}
	double order = (n * sxy - sx * sy) / (n * sxx - sx * sx);
	return check(n >= 3 && order >= claim - 0.1, "%s: order %.3f, claimed %g", sentence, order, claim);
}

__attribute__((unused)) static int check_done(void)
{
	printf("# %d passed, %d failed\n", check_count - check_failed, check_failed);
	return check_failed != 0;
}

#endif
