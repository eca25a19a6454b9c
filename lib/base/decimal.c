/* Decimal text to double and back. Reading: up to 19 digits and a power of ten up to 27 are both exact in the 64-bit mantissa of an x87 long double,
 * so one multiplication gives the product to half a unit of 2^-64; rounding that to 53 bits is right unless it falls on a tie, and then, as for every
 * other number, strtod decides (Clinger 1990, How to read floating point numbers accurately, the fast path). Where long double is no wider than
 * double, strtod always decides. Cost: about 20 ns a number, strtod 100 to 200 ns.
 * SPDX-License-Identifier: GPL-3.0-or-later */
#include <float.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "base/decimal.h"

enum { most_power = 27 };
static const long double powers[most_power + 1] = {1e0L, 1e1L, 1e2L, 1e3L, 1e4L, 1e5L, 1e6L, 1e7L, 1e8L, 1e9L, 1e10L, 1e11L, 1e12L, 1e13L, 1e14L, 1e15L,
	1e16L, 1e17L, 1e18L, 1e19L, 1e20L, 1e21L, 1e22L, 1e23L, 1e24L, 1e25L, 1e26L, 1e27L};

static bool digit(char c) { return c >= '0' && c <= '9'; }

/* Digits into *m while they fit (19); the count of all is returned, *lost says that one other than zero did not fit. */
static const char *digits(const char *s, uint64_t *m, int *kept, int *skipped, bool *lost)
{
	for (; digit(*s); s++)
		if (*kept < 19)
			*m = *m * 10 + (uint64_t)(*s - '0'), *kept += *m > 0;
		else
			++*skipped, *lost |= *s != '0';
	return s;
}

/* m * 10^power, correctly rounded, or false if this method cannot decide. */
static bool quick(uint64_t m, int power, double *x)
{
	if (LDBL_MANT_DIG != 64 || power > most_power || power < -most_power)
		return false;
	long double y = power < 0 ? (long double)m / powers[-power] : (long double)m * powers[power];
	uint64_t bits;
	memcpy(&bits, &y, sizeof bits);
	*x = (double)y;
	return (bits & 0x7ff) != 0x400;
}

static size_t word(const char *s, double *x)
{
	static const char *const words[] = {"nan", "NaN", "NAN", "inf", "Inf", "INF", "-nan", "-NaN", "-inf", "-Inf", "-INF", "+inf", "infinity", "Infinity",
		"-infinity", NULL};
	for (int i = 0; words[i]; i++) {
		size_t n = strlen(words[i]);
		if (!strncmp(s, words[i], n) && (unsigned char)s[n] <= ' ')
			return *x = strchr(words[i], 'f') ? HUGE_VAL : NAN, n;
	}
	return 0;
}

size_t pm_decimal_read(const char *text, double *x)
{
	const char *s = text;
	bool minus = *s == '-', lost = false;
	uint64_t m = 0;
	int kept = 0, skipped = 0, power = 0;
	s += *s == '-' || *s == '+';
	const char *first = s;
	s = digits(s, &m, &kept, &skipped, &lost);
	ptrdiff_t count = s - first;
	power += skipped;
	if (*s == '.') {
		const char *point = ++s;
		int before = skipped;
		s = digits(s, &m, &kept, &skipped, &lost);
		count += s - point;
		power -= (int)(s - point) - (skipped - before);
	}
	if (!count)
		return word(text, x);
	if (*s == 'e' || *s == 'E') {
		const char *e = s + 1;
		bool down = *e == '-';
		int exponent = 0;
		e += *e == '-' || *e == '+';
		if (!digit(*e))
			return 0;
		for (; digit(*e); e++)
			exponent = exponent < 100000 ? exponent * 10 + (*e - '0') : exponent;
		power += down ? -exponent : exponent;
		s = e;
	}
	if (m == 0)
		*x = minus ? -0.0 : 0.0;
	else if (!lost && quick(m, power, x))
		*x = minus ? -*x : *x;
	else
		*x = strtod(text, NULL);
	return (size_t)(s - text);
}

size_t pm_integer_read(const char *text, int64_t *x)
{
	const char *s = text;
	bool minus = *s == '-';
	uint64_t m = 0, most = minus ? (uint64_t)INT64_MAX + 1 : (uint64_t)INT64_MAX;
	s += *s == '-' || *s == '+';
	const char *first = s;
	for (; digit(*s); s++) {
		uint64_t d = (uint64_t)(*s - '0');
		if (m > (most - d) / 10)
			return 0;
		m = m * 10 + d;
	}
	*x = minus ? (int64_t)(0 - m) : (int64_t)m;
	return s == first ? 0 : (size_t)(s - text);
}

/* Rounds the n digits d to m of them, half away from zero; returns 1 if that made it one digit longer (the exponent grows). */
static int shorten(const char *d, int m, char *out)
{
	memcpy(out, d, (size_t)m);
	if (d[m] < '5')
		return 0;
	for (int i = m - 1; i >= 0; i--) {
		if (out[i] != '9')
			return out[i]++, 0;
		out[i] = '0';
	}
	return out[0] = '1', 1;
}

/* d.ddd * 10^exponent as %g would print it, trailing zeros left out. */
static size_t lay_out(char *out, bool minus, const char *d, int n, int exponent)
{
	char *o = out;
	while (n > 1 && d[n - 1] == '0')
		n--;
	if (minus)
		*o++ = '-';
	if (exponent < -4 || exponent > 16) {
		*o++ = d[0];
		if (n > 1)
			*o++ = '.', memcpy(o, d + 1, (size_t)n - 1), o += n - 1;
		return (size_t)(o - out) + (size_t)sprintf(o, "e%c%02d", exponent < 0 ? '-' : '+', abs(exponent));
	}
	if (exponent < 0) {
		memcpy(o, "0.0000", (size_t)(1 - exponent)), o += 1 - exponent;
		memcpy(o, d, (size_t)n), o += n;
	} else
		for (int i = 0; i < n || i <= exponent; i++) {
			if (i == exponent + 1)
				*o++ = '.';
			*o++ = i < n ? d[i] : '0';
		}
	return *o = 0, (size_t)(o - out);
}

/* The n digits d times 10^power, as pm_decimal_read reads them. */
static double value(const char *d, int n, int power)
{
	uint64_t m = 0;
	double x;
	char text[40];
	for (int i = 0; i < n; i++)
		m = 10 * m + (uint64_t)(d[i] - '0');
	if (quick(m, power, &x))
		return x;
	snprintf(text, sizeof text, "%.*se%d", n, d, power);
	return strtod(text, NULL);
}

/* Whole numbers of at most 15 digits, many of which are in tables, need no trial. */
static size_t whole(char *out, double x)
{
	char d[16];
	int n = 0;
	for (uint64_t m = (uint64_t)fabs(x), power = 1000000000000000; power /= 10;)
		if (n || m / power % 10)
			d[n++] = (char)('0' + m / power % 10);
	return lay_out(out, x < 0, d, n, n - 1);
}

size_t pm_decimal_write(char *out, double x, bool float_digits)
{
	if (!isfinite(x))
		return (size_t)sprintf(out, "%g", x);
	if (x == 0)
		return (size_t)sprintf(out, signbit(x) ? "-0" : "0");
	if (!float_digits && fabs(x) < 1e15 && x == trunc(x))
		return whole(out, x);
	int most = float_digits ? 9 : 17, exponent;
	char text[40], all[20], d[20];
	snprintf(text, sizeof text, "%.*e", most - 1, fabs(x)); /* d.ddde-xx */
	all[0] = text[0], memcpy(all + 1, text + 2, (size_t)most - 1), all[most] = 0;
	exponent = atoi(text + most + 2);
	for (int m = float_digits ? 6 : 15; m < most; m++) {
		const int longer = shorten(all, m, d);
		const double back = value(d, m, exponent + longer - (m - 1));
		if (float_digits ? (float)back == (float)fabs(x) : back == fabs(x))
			return lay_out(out, x < 0, d, m, exponent + longer);
	}
	return lay_out(out, x < 0, all, most, exponent);
}
