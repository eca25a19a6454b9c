/* The lowest room: errors, memory, threads, random numbers, sums, checksums. All others use it; it includes nothing of pmpipe.
 * SPDX-License-Identifier: GPL-3.0-or-later */
#ifndef PM_BASE_H
#define PM_BASE_H

#include <math.h>
#include <stdbool.h>
#include <stddef.h>
#include <stdint.h>

/* Around the declarations of every header that is installed, so that a C++ program links with them. */
#ifdef __cplusplus
#define PM_C_BEGIN extern "C" {
#define PM_C_END }
#else
#define PM_C_BEGIN
#define PM_C_END
#endif

PM_C_BEGIN

#define PM_VERSION "0.1.0"

static const double pm_pi = 3.14159265358979323846;

/* Errors. A library function returns 0, or the negative of one of these after leaving one message; it never prints and never exits.
 * The codes are the exit codes of the tools; `missing` (a change field is not there yet, which cycle answers by priming) leaves as 1. */
enum { PM_DATA = 1, PM_USAGE = 2, PM_NUMERICS = 3, PM_MISSING = 4 };

/* Records the message of this thread and returns -code, so that `return pm_fail(PM_DATA, "...")` is the idiom. */
int pm_fail(int code, const char *format, ...) __attribute__((format(printf, 2, 3)));
/* As pm_fail, with ": " and the system's reason for errno behind the message. */
int pm_fail_errno(const char *format, ...) __attribute__((format(printf, 1, 2)));
/* The last message of this thread, "" if none. */
const char *pm_message(void);
/* The last failure of this thread as a return value, for callers that were handed NULL. */
int pm_failed(void);
/* The exit status of a return value: 0, 1, 2 or 3. */
int pm_exit_code(int status);

/* Memory: 64-byte aligned, huge pages advised from 1 MiB on; freed large blocks are kept for the next request of the same size.
 * NULL (with a message) when there is none or count*size overflows. */
void *pm_alloc(size_t count, size_t size);
void *pm_zalloc(size_t count, size_t size);  /* the same, zeroed */
void *pm_free(void *block);                  /* accepts NULL, returns NULL */
/* For every other failed allocation: records the message and returns -PM_DATA. Where a program asked for it (pm_main does, for itself and for
 * jansson), a failed allocation ends the program instead, here and in pm_alloc: end() says why and does not return. */
int pm_no_memory(void);
void pm_memory_end(void (*end)(void));
int pm_cannot_go_on(void);                   /* the same with the message that is there, for failures that a function cannot return */
void pm_memory_release(void);                /* gives the freed blocks back to the system, and forgets how many were in use */
/* The most that the process has held since _begin, in bytes; NAN, and false: the system does not say. */
bool pm_memory_peak_begin(void);
double pm_memory_peak(void);
size_t pm_memory_idle(void);                 /* bytes of freed blocks kept: never more than were in use at a time lately (in the last 256 to 512 requests) */

/* Threads: OMP_NUM_THREADS, PM_THREADS or --threads. Results never depend on the number. */
int pm_threads(void);
void pm_threads_use(int n);
/* Turns of a loop of a nanosecond each, at least, from which threads pay: waking one takes 10 us, where it sleeps on another core 50. Tests, whose frames are
 * small, have PM_MANY_TURNS=16384. */
size_t pm_many_turns(void);

/* Seconds of a monotonic clock; only the stage layer and bench/ may call it. */
double pm_seconds(void);
struct pm_clock {
	double wall, processor; /* [s] of a monotonic clock, and of the processors with all threads of the program */
};
struct pm_clock pm_clock(void);

/* Random numbers: Philox4x32-10 (Salmon et al. 2011), a function of (seed, id, counter) and nothing else. */
void pm_random(uint64_t seed, uint64_t id, uint64_t counter, double u[2]);        /* uniform in (0,1), 53 bits each */
void pm_random_normal(uint64_t seed, uint64_t id, uint64_t counter, double z[2]); /* independent N(0,1) */

/* Compensated sums (Neumaier 1974): sum + carry is the total. */
struct pm_sum {
	double sum, carry;
};
static inline void pm_sum_add(struct pm_sum *s, double x)
{
	double t = s->sum + x;
	s->carry += fabs(s->sum) >= fabs(x) ? (s->sum - t) + x : (x - t) + s->sum;
	s->sum = t;
}
static inline double pm_sum_total(struct pm_sum s) { return s.sum + s.carry; }
/* Sum of n values: compensated in blocks of pm_sum_block, the blocks added in order; the same bytes for any number of threads. */
enum { pm_sum_block = 4096 };
double pm_sum_array(size_t n, const double *x);
double pm_sum_products(size_t n, const double *x, const double *y);

/* CRC-32C (Castagnoli), started with 0. */
uint32_t pm_crc32c(uint32_t crc, const void *data, size_t bytes);
/* The checksum of two pieces from those of each; bytes is the length of the second. */
uint32_t pm_crc32c_join(uint32_t first, uint32_t second, size_t bytes);

/* True if all n values are finite. */
bool pm_finite(size_t n, const double *x);
/* The same by the calling thread alone, for values that are in the cache already. It compares exponents as integers, which vectorises. */
static inline bool pm_finite_few(size_t n, const double *x)
{
	typedef uint64_t __attribute__((may_alias)) word;
	const word *bits = (const word *)x, exponent = 0x7ff0000000000000u;
	word most = 0;
	for (size_t i = 0; i < n; i++) {
		word e = bits[i] & exponent;
		most = e > most ? e : most;
	}
	return most != exponent;
}

PM_C_END

#endif
