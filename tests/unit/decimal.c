/* Decimal text: read as strtod reads, written so that the same bits come back. SPDX-License-Identifier: GPL-3.0-or-later */
#include <stdlib.h>
#include <string.h>

#include "base/decimal.h"
#include "check.h"

static double any_double(uint64_t i)
{
	double u[2], x;
	uint64_t bits;
	do {
		pm_random(7, i, 0, u);
		bits = (uint64_t)(u[0] * 0x1p32) << 32 | (uint64_t)(u[1] * 0x1p32);
		memcpy(&x, &bits, sizeof x);
		i += 1000003;
	} while (!isfinite(x));
	return x;
}

static bool reads_as_strtod(const char *text)
{
	double got = 0, want = strtod(text, NULL);
	size_t used = pm_decimal_read(text, &got);
	if (used == strlen(text) && !memcmp(&got, &want, sizeof got))
		return true;
	printf("# %s: got %.17g after %zu bytes, want %.17g\n", text, got, used, want);
	return false;
}

static bool returns(double x)
{
	char text[PM_DECIMAL_LENGTH];
	double back = 0;
	size_t n = pm_decimal_write(text, x, false);
	return n == strlen(text) && n < sizeof text && pm_decimal_read(text, &back) == n && !memcmp(&back, &x, sizeof x);
}

int main(void)
{
	static const char *const hard[] = {"0", "-0", "0.0", ".5", "5.", "1e-3", "1E+3", "9007199254740993", "9007199254740992.5",
		"1.00000000000000011102230246251565",
		"123456789012345678901234567890", "0.000000000000000000000000000000012345", "4.9e-324", "2.2250738585072014e-308", "1.7976931348623157e308",
		"-4.06428567034226e-3", "100000000000000000000000000000000000000000", "1e27", "1e-27", "1e28", "18446744073709551615", "18446744073709551616",
		NULL};
	int wrong = 0;
	for (int i = 0; hard[i]; i++)
		wrong += !reads_as_strtod(hard[i]);
	check(!wrong, "awkward numbers are read as strtod reads them (%d wrong)", wrong);
	wrong = 0;
	for (uint64_t i = 0; i < 200000; i++) {
		char text[64];
		double u[2];
		pm_random(3, i, 1, u);
		snprintf(text, sizeof text, "%.*g", 1 + (int)(i % 19), i & 1 ? any_double(i) : (u[0] - 0.5) * pow(10, floor(u[1] * 60) - 30));
		wrong += !reads_as_strtod(text);
	}
	check(!wrong, "200000 random numbers of 1 to 19 digits are read as strtod reads them (%d wrong)", wrong);
	wrong = 0;
	for (uint64_t i = 0; i < 200000; i++)
		wrong += !returns(any_double(i)) + !returns((double)(i % 1000) / 8) + !returns((double)i * 0.1);
	check(!wrong, "numbers written and read again have the same bits (%d wrong)", wrong);
	static const struct { double x; const char *want; } shown[] = {{0.1, "0.1"}, {-2.385, "-2.385"}, {1e21, "1e+21"}, {1.0 / 3, "0.3333333333333333"},
		{100, "100"}, {1e-5, "1e-05"}, {0.0001, "0.0001"}, {123456.75, "123456.75"}, {-0.0, "-0"}, {0.1 + 0.2, "0.30000000000000004"},
		{9.9999999999999995e22, "1e+23"}};
	for (size_t i = 0; i < sizeof shown / sizeof *shown; i++) {
		char text[PM_DECIMAL_LENGTH];
		pm_decimal_write(text, shown[i].x, false);
		check(!strcmp(text, shown[i].want), "%s is written as one would type it (got %s)", shown[i].want, text);
	}
	wrong = 0;
	for (uint64_t i = 0; i < 50000; i++) {
		char text[PM_DECIMAL_LENGTH];
		double u[2], back;
		pm_random(5, i, 0, u);
		float x = (float)((u[0] - 0.5) * pow(10, floor(u[1] * 60) - 30));
		size_t n = pm_decimal_write(text, x, true);
		wrong += n > 20 || !pm_decimal_read(text, &back) || (float)back != x;
	}
	check(!wrong, "single precision written with nine digits is read back exactly (%d wrong)", wrong);
	int64_t k;
	check(pm_integer_read("-9223372036854775808", &k) == 20 && k == INT64_MIN, "the smallest integer is read");
	check(pm_integer_read("9223372036854775807", &k) == 19 && k == INT64_MAX, "the largest integer is read");
	check(!pm_integer_read("9223372036854775808", &k) && !pm_integer_read("x", &k), "an integer that does not fit is refused");
	double x;
	check(pm_decimal_read("nan ", &x) == 3 && isnan(x) && pm_decimal_read("-inf\t", &x) == 4 && isinf(x), "nan and inf are recognised");
	check(pm_decimal_read("1e999", &x) == 5 && isinf(x), "a number that is too large is not finite");
	check(!pm_decimal_read("--1", &x) && !pm_decimal_read("e5", &x) && !pm_decimal_read("1e", &x) && !pm_decimal_read(".", &x), "a text that is not a "
		"number is an error");
	return check_done();
}
