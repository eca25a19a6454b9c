/* Checks of the unit tests: one line each, `ok - sentence` or `not ok - sentence` with got, want and tolerance; main returns check_done().
 * SPDX-License-Identifier: GPL-3.0-or-later */
#ifndef PM_CHECK_H
#define PM_CHECK_H

#include <errno.h>
#include <math.h>
#include <stdarg.h>
#include <stdbool.h>
#include <stdio.h>
#include <stdlib.h>

static int check_failed, check_count;

/* Sanitizers look at each access, not at numbers: with them a case of each kind is enough. */
__attribute__((unused)) static bool check_sanitized(void) { return getenv("PM_SANITIZED") != NULL; }

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

/* Keeps the largest value so far in *worst; true if this one is. A NaN is kept to the end, unlike with fmax(), so that a later check of the form
 * worst <= tolerance fails. */
__attribute__((unused)) static bool check_worst(double *worst, double value)
{
	bool more = value > *worst || (isnan(value) && !isnan(*worst));
	*worst = more ? value : *worst;
	return more;
}

/* The same for the smallest value. */
__attribute__((unused)) static bool check_least(double *least, double value)
{
	bool less = value < *least || (isnan(value) && !isnan(*least));
	*least = less ? value : *least;
	return less;
}

/* With PM_MEASURED=FILE a line there for docs/hard-cases.sh, as by measured() of tests/helper.bash. b: NAN where the relation has one number only. */
static void check_measured(const char *sentence, const char *relation, double got, double a, double b)
{
	const char *name = getenv("PM_MEASURED");
	FILE *file = name ? fopen(name, "a") : NULL;
	if (!file)
		return;
	fprintf(file, "unit/%s\t%s\t%s\t%.17g\t%.17g\t", program_invocation_short_name, sentence, relation, got, a);
	if (isnan(b))
		fprintf(file, "\t\n");
	else
		fprintf(file, "%.17g\t\n", b);
	fclose(file);
}

/* |got - want| <= tolerance; not a number never passes. */
__attribute__((unused)) static bool check_near(double got, double want, double tolerance, const char *sentence)
{
	bool good = fabs(got - want) <= tolerance;
	check_measured(sentence, "within", got, want, tolerance);
	if (good)
		return check(true, "%s", sentence);
	return check(false, "%s (got %.17g, want %.17g, tolerance %g)", sentence, got, want, tolerance);
}

/* |got| <= bound; the sentence, formatted, is followed by both numbers. */
__attribute__((format(printf, 3, 4), unused)) static bool check_below(double got, double bound, const char *format, ...)
{
	char sentence[300];
	va_list ap;
	va_start(ap, format);
	vsnprintf(sentence, sizeof sentence, format, ap);
	va_end(ap);
	check_measured(sentence, "below", got, bound, NAN);
	return check(fabs(got) <= bound, "%s (%.3g, at most %.3g)", sentence, got, bound);
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
	check_measured(sentence, "above", order, claim - 0.1, NAN);
	return check(n >= 3 && order >= claim - 0.1, "%s: order %.3f, claimed %g", sentence, order, claim);
}

__attribute__((unused)) static int check_done(void)
{
	printf("# %d passed, %d failed\n", check_count - check_failed, check_failed);
	return check_failed != 0;
}

#endif
