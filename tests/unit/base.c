/* The ground floor against published values (reference/cases.md FP-01 to FP-05, HC-58). SPDX-License-Identifier: GPL-3.0-or-later */
#include <string.h>
#include <stdlib.h>

#include "base/base.h"
#include "base/simd.h"
#include "check.h"

static void sums(void)
{
	size_t n = 10000000;
	double *x = pm_alloc(n, sizeof *x);
	double naive = 0;
	float single = 0;
	for (size_t i = 0; i < n; i++) {
		x[i] = 0.1;
		naive += x[i];
		single += 0.1f;
	}
	check_near(single, 1087937, 0, "FP-01: ten million 0.1 in single precision, one after the other, give 1087937");
	check_near(naive, 999999.99983897537, 0, "FP-01: in double precision 999999.99983897537");
	check_near(pm_sum_array(n, x), 1000000, 0, "HC-58: compensated they give 1000000 to the last bit");
	double hard[] = {1, 1e100, 1, -1e100}, ones[] = {1, 1, 1, 1};
	check_near(pm_sum_array(4, hard), 2, 0, "FP-01: 1, 1e100, 1, -1e100 sum to 2");
	check_near(pm_sum_products(4, hard, ones), 2, 0, "and so do their products with ones");
	double *y = pm_alloc(n, sizeof *y);
	for (size_t i = 0; i < n; i++)
		x[i] = (double)(i % 1000), y[i] = (double)(i / 1000);
	check_near(pm_sum_products(n, x, y), 499500. * 49995000, 0, "the sum of ten million products of integers is exact"); /* below 2^53 */
	pm_free(y);
	for (size_t i = 0; i < n; i++)
		x[i] = sin((double)i) * exp(30 * cos(0.7 * (double)i));
	double s[3];
	for (int t = 1; t <= 3; t++) {
		pm_threads_use(t);
		s[t - 1] = pm_sum_array(n - 77, x);
	}
	check(!memcmp(s, s + 1, sizeof *s) && !memcmp(s, s + 2, sizeof *s), "a sum has the same bytes with 1, 2 and 3 threads");
	check(pm_finite(n, x), "a finite array is finite");
	x[n - 1] = NAN;
	check(!pm_finite(n, x) && pm_finite(n - 1, x), "a NaN in the last place is detected");
	x[n - 1] = -INFINITY;
	check(!pm_finite(n, x), "so is an infinity");
	pm_free(x);
}

/* Blocks of n MiB, one after the other, until `times` of them have come and gone. */
static void come_and_go(int times, size_t n, size_t step)
{
	for (int i = 0; i < times; i++, n -= step)
		pm_free(pm_alloc(n << 20, 1));
}

static void memory(void)
{
	const size_t head = 2 << 20; /* of a block and its rounding up to huge pages */
	come_and_go(600, 1, 0);
	check(pm_memory_idle() <= (1 << 20) + head, "freed blocks larger than what a program has lately used go back to the system");
	come_and_go(20, 64, 3);
	check(pm_memory_idle() <= (64 << 20) + head, "freed blocks of many sizes: no more bytes are kept than were in use at a time");
	pm_memory_release();
	check(pm_memory_idle() == 0, "freed blocks are given back to the system on request");
	pm_free(pm_alloc(300 << 10, 1)), pm_free(pm_alloc(1 << 20, 1));
	check(pm_memory_idle() > (2 << 20) + (200 << 10), "blocks of less than 4 MB together stay, also where they are never in use at the same time");
	pm_memory_release();
	void *a = pm_alloc(7 << 20, 1), *b = pm_alloc(9 << 20, 1), *was = a;
	pm_free(a), pm_free(b);
	a = pm_alloc(7 << 20, 1);
	check(a == was, "a freed block is given to the next who asks for its size");
	pm_free(a);
}

static void checksums(void)
{
	check(pm_crc32c(0, "123456789", 9) == 0xE3069283u, "CRC-32C of 123456789 is E3069283 (RFC 3720)");
	unsigned char zero[32] = {0};
	check(pm_crc32c(0, zero, 32) == 0x8A9136AAu, "of 32 zero bytes 8A9136AA");
	size_t n = 100003;
	unsigned char *b = malloc(n);
	for (size_t i = 0; i < n; i++)
		b[i] = (unsigned char)(i * 7 + i / 251);
	uint32_t bit = ~0u; /* the definition, bit by bit */
	for (size_t i = 0; i < n; i++) {
		bit ^= b[i];
		for (int k = 0; k < 8; k++)
			bit = bit >> 1 ^ (bit & 1 ? 0x82F63B78u : 0);
	}
	check(pm_crc32c(0, b, n) == ~bit, "a long block agrees with the definition");
	check(pm_crc32c(pm_crc32c(0, b, 777), b + 777, n - 777) == ~bit, "in two calls too");
	check(pm_crc32c_join(pm_crc32c(0, b, 12345), pm_crc32c(0, b + 12345, n - 12345), n - 12345) == ~bit, "and joined from two pieces");
	free(b);
}

static void numbers(void)
{
	double u[2], v[2], sum = 0, square = 0, cross = 0;
	pm_random(1, 2, 3, u), pm_random(1, 2, 3, v);
	check(!memcmp(u, v, sizeof u), "a random number depends on seed, id and counter only");
	/* kat_vectors of Random123 (Salmon et al. 2011), philox4x32 of 10 rounds: words 6627e8d5 e169c58d bc57ac4c 9b00dbd8, d16cfe09 94fdcceb 5001e420
	 * 24126ea1 */
	pm_random(0, 0, 0, u), pm_random(0x299f31d0a4093822u, 0x85a308d3243f6a88u, 0x0370734413198a2eu, v);
	check(u[0] == ((double)(0x6627e8d5e169c58du >> 12) + 0.5) * 0x1p-52 && u[1] == ((double)(0xbc57ac4c9b00dbd8u >> 12) + 0.5) * 0x1p-52 &&
		v[0] == ((double)(0xd16cfe0994fdccebu >> 12) + 0.5) * 0x1p-52 && v[1] == ((double)(0x5001e42024126ea1u >> 12) + 0.5) * 0x1p-52,
		"the words are those published for Philox4x32-10");
	int n = 100000;
	for (int i = 0; i < n; i++) {
		pm_random(1, (uint64_t)i, 0, u), pm_random(2, (uint64_t)i, 0, v);
		sum += u[0], square += u[0] * u[0], cross += (u[0] - .5) * (v[0] - .5) * 12;
	}
	/* four standard errors: 1/sqrt(12 n), sqrt(4/45/n), 1/sqrt(n) */
	check_near(sum / n, 0.5, 4 / sqrt(12. * n), "uniform numbers have mean 1/2");
	check_near(square / n, 1 / 3., 4 * sqrt(4 / 45. / n), "and second moment 1/3");
	check_near(cross / n, 0, 4 / sqrt(n), "HC-56, two seeds: 1 and 2 are not correlated");
	double m2 = 0, m4 = 0, m11 = 0;
	for (int i = 0; i < n; i++) {
		pm_random_normal(7, (uint64_t)i, 1, u);
		m2 += u[0] * u[0], m4 += pow(u[1], 4), m11 += u[0] * u[1];
	}
	check_near(m2 / n, 1, 4 * sqrt(2. / n), "normal numbers have variance 1");
	check_near(m4 / n, 3, 4 * sqrt(96. / n), "and fourth moment 3");
	check_near(m11 / n, 0, 4 / sqrt(n), "and the two of a pair are not correlated");
}

static void traps(void)
{
	float h = 0;
	int at = 0;
	for (int i = 1; !at; i++) {
		float next = h + 1.0f / (float)i;
		if (next == h)
			at = i;
		h = next;
	}
	check(at == 2097152 && fabs(h - 15.4036827) < 1e-6, "FP-02: the harmonic series in single precision stops at 15.4036827, n = 2097152");
	volatile double x = 1e8, root = (-x + sqrt(x * x - 4)) / 2;
	check_near(root, -7.4505805969238281e-09, 0, "FP-02: the small root by the schoolbook formula is 25 % off: the compiler does not reorder");
	double a = 4, b = 4.25;
	for (int i = 2; i <= 30; i++) {
		double c = 108 - (815 - 1500 / a) / b;
		a = b, b = c;
	}
	check_near(b, 100, 1e-6, "FP-03: Muller's recurrence shows 100 where the limit is 5");
	volatile double tiny = -1e-17;
	check(tiny - floor(tiny) == 1, "FP-04: -1e-17 wrapped naively is 1, out of range: folding must guard it");
	check((int)floor(-0.25) == -1 && (int)-0.25 == 0, "FP-04: floor gives -1 where a cast gives 0");
	volatile float stall = 1.0f;
	check(stall + 2.9e-8f == stall, "FP-04: a single-precision position stalls");
	volatile double r = 1e-200;
	check(r * r == 0 && hypot(r, 0) == r, "FP-05: r^2 underflows at 1e-200, hypot does not");
	check(1 - erf(6) == 0 && fabs(erfc(6) / 2.151973671249892e-17 - 1) < 1e-14, "FP-05: erfc(6), where 1 - erf(6) is 0");
	check_near(-expm1(-1e-12) / 1e-12, 0.9999999999995, 1e-15, "FP-05: (1 - exp(-x))/x by expm1");
	volatile double denormal = 1e-310, other = 2e-310;
	check(denormal != other && other - denormal != 0, "denormal numbers are not flushed to zero: x != y means x - y != 0");
}

/* Of 200000 numbers between 2^-60 and 2^60, the largest errors in units of the last digit. */
static void inverse_roots(void)
{
	double most[2] = {0};
	for (int i = 0; i < 200000; i++) {
		const double x = ldexp(1 + fmod(0.6180339887498949 * i, 1), i % 121 - 60);
		const long double exact = 1 / sqrtl(x);
		const double unit = ldexp(1, ilogbl(exact) - 52), got[2] = {pm_simd_rsqrt(pm_simd_all(x))[0], pm_simd_rsqrt_near(pm_simd_all(x))[0]};
		for (int k = 0; k < 2; k++)
			most[k] = fmax(most[k], fabs((double)((got[k] - exact) / unit)));
	}
#ifdef __AVX512F__
	const double near = 0.51;
#else
	const double near = 1.5; /* a root and a quotient round twice */
#endif
	check(most[0] < 1.5 && most[1] < near, "inverse roots: off by %.3f of the last digit, and the near one by %.3f", most[0], most[1]);
}

int main(void)
{
	sums();
	inverse_roots();
	memory();
	checksums();
	numbers();
	traps();
	check(!pm_alloc(SIZE_MAX / 2, 16) && strstr(pm_message(), "more than memory"), "a size that overflows is refused, not wrapped");
	check(pm_fail(PM_NUMERICS, "%d bad", 3) == -3 && !strcmp(pm_message(), "3 bad") && pm_exit_code(-PM_MISSING) == 1,
		"a failure carries code and message");
	pm_fail(PM_DATA, "no field '%s'", "a\nb\tc\033[2J\177\302\233d\303\251");
	check(!strcmp(pm_message(), "no field 'a b c?[2J???d\303\251'"), "a message is one line without control characters");
	return check_done();
}
