/* Transforms of lengths with prime factors above 13, eight complex lines side by side: ours (direct stages for primes up to 251), FFTW's estimated plan, which
 * stands in for greater primes, and our next length without such a factor, all in times of FFTW's measured plan. The best of nine rounds, one thread.
 * bench/fft-lengths [length ...] prints a table in Markdown. SPDX-License-Identifier: GPL-3.0-or-later */
#include "bench.h"
#include "fft/fft-block.h"

enum { L = PM_FFT_LINES };

static fftw_plan fftw(size_t n, unsigned flags)
{
	fftw_iodim length = {(int)n, L, L}, lines = {L / 2, 1, 1};
	double *b = pm_zalloc(n * L, sizeof *b);
	fftw_forget_wisdom();
	fftw_plan p = fftw_plan_guru_split_dft(1, &length, 1, &lines, b, b + L / 2, b, b + L / 2, flags);
	pm_free(b);
	return p;
}

/* Seconds of a transform: ours, or FFTW's where plan is not NULL. */
static double seconds(size_t n, const struct pm_fft *f, fftw_plan plan)
{
	double *b = pm_alloc(n * L, sizeof *b), *keep = pm_alloc(n * L, sizeof *b), best = INFINITY;
	for (size_t i = 0; i < n * L; i++)
		keep[i] = sin((double)i);
	for (int round = 0; round < 9; round++) {
		double began = bench_clock(), took = 0;
		int done = 0;
		for (; took < 3e-3; done += 8, took = bench_clock() - began) {
			memcpy(b, keep, n * L * sizeof *b); /* values would grow without bound */
			for (int i = 0; i < 8; i++)
				if (plan)
					fftw_execute_split_dft(plan, b, b + L / 2, b, b + L / 2);
				else
					pm_fft_forward(f, b);
		}
		best = fmin(best, took / done);
	}
	pm_free(b), pm_free(keep);
	return best;
}

static size_t smooth(size_t n)
{
	for (;; n++) {
		size_t m = n;
		for (size_t p = 2; p <= 13; p++)
			while (m % p == 0)
				m /= p;
		if (m == 1)
			return n;
	}
}

int main(int argc, char **argv)
{
	pm_threads_use(1); /* processor time */
	static const size_t usual[] = {
		17, 19, 23, 31, 34, 38, 47, 51, 61, 68, 97, 101, 127, 136, 151, 194, 199, 251, 257, 323, 502, 509, 514, 521, 646, 1018, 1021,
	};
	size_t count = argc > 1 ? (size_t)argc - 1 : sizeof usual / sizeof *usual;
	printf("| n | FFTW measured, us | FFTW estimated | ours | next smooth length |\n|---|---|---|---|---|\n");
	for (size_t i = 0; i < count; i++) {
		size_t n = argc > 1 ? strtoul(argv[i + 1], NULL, 10) : usual[i], next = smooth(n);
		struct pm_fft_plans p = {0};
		const struct pm_fft *f = pm_fft(&p, n), *g = pm_fft(&p, next);
		if (!f || !g)
			return 1;
		fftw_plan e = fftw(n, FFTW_ESTIMATE), m = fftw(n, FFTW_MEASURE);
		double measured = seconds(n, NULL, m), ours = seconds(n, f, NULL);
		printf("| %zu | %.2f | %.2f | %.2f%s | %.2f (%zu) |\n", n, 1e6 * measured, seconds(n, NULL, e) / measured, ours / measured,
			p.sum ? " (FFTW)" : "", seconds(next, g, NULL) / measured, next);
		fftw_destroy_plan(e), fftw_destroy_plan(m);
		pm_fft_plans_clear(&p);
	}
	return 0;
}
