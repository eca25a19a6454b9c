/* Complex transforms of eight lines side by side, one per SIMD lane: block is double [length][PM_FFT_LINES], 64-byte aligned; row i holds the real parts of
 * element i of the eight lines, then the imaginary parts. SPDX-License-Identifier: GPL-3.0-or-later */
#ifndef PM_FFT_BLOCK_H
#define PM_FFT_BLOCK_H

#include "fft/fftw-plan.h"

enum { PM_FFT_PASSES = 40, PM_PRIME = 13 };

struct pm_fft {
	size_t n;
	size_t *at;                /* frequency k comes out in row at[k], and goes in there on the way back; n as 0 */
	int stages;                /* 0: by FFTW */
	int radix[PM_FFT_PASSES];
	double *twiddle[PM_FFT_PASSES];/* of stage s: cos, sin of 2 pi j p/N for j < N/radix, p = 1 .. radix-1 */
	double *circle[PM_FFT_PASSES]; /* of stages of primes above 13: cos, sin of 2 pi i/p */
	double cosine[PM_PRIME + 1][PM_PRIME], sine[PM_PRIME + 1][PM_PRIME]; /* of 2 pi i/p */
	fftw_plan forward, backward;
	/* cos, sin of pi i/n for i < n (of pm_fft_shifted and pm_fft_sine_cosine only), of pi i/2n for i <= n (of pm_fft_sine_cosine) */
	double *half, *quarter;
	size_t *fold[5];           /* of pm_fft_sine_cosine: by enum pm_waves the rows of the modes (fft/sine-cosine.h) */
};

/* A transform of length n, made once per planner and owned by it. NULL with a message. Never inside a parallel region. */
struct pm_fft *pm_fft(struct pm_fft_plans *p, size_t n);
/* The same with the table that shifts frequencies by a half. */
struct pm_fft *pm_fft_shifted(struct pm_fft_plans *p, size_t n);
/* cos and sin of 2 pi i/n from an eighth of the circle, so that they are exact to the last bit. */
void pm_fft_circle(size_t i, size_t n, double *c, double *s);

/* In place, not normalised: rows in natural order to rows at[k], with exp(-2 pi i jk/n); and back, with the opposite sign. */
void pm_fft_forward(const struct pm_fft *f, double *block);
void pm_fft_backward(const struct pm_fft *f, double *block);

/* The same from rows of memory, row i of 16 numbers at at + i*step, to such rows, by way of a block (which they may be, with the step PM_FFT_LINES; at 128-byte
 * steps and aligned as it is). */
struct pm_fft_place {
	double *at;
	size_t step; /* [doubles] */
	size_t some; /* 0, or how many rows there are: others are zero when read, and not wanted when written */
	const double *next; /* NULL, or the rows that are read after these: fetched into the caches meanwhile */
};
void pm_fft_forward_moving(const struct pm_fft *f, struct pm_fft_place from, double *block, struct pm_fft_place to);
void pm_fft_backward_moving(const struct pm_fft *f, struct pm_fft_place from, double *block, struct pm_fft_place to);
/* Forward, times u, and back; u: double [length][PM_FFT_LINES/2], the factors of the frequency that row i of the block would hold, one for each line. */
void pm_fft_times_moving(const struct pm_fft *f, struct pm_fft_place from, const double *u, double *block, struct pm_fft_place to);

/* PM_FFT_LINES rows of memory, anywhere, to and from a block: rows 0-7 become the real, 8-15 the imaginary lanes; rows from `rows` on are missing and
 * count as zero. Element i goes to block row at[i] on the way in, and comes from there on the way out (at NULL: row i). */
void pm_fft_rows_in(const double *const row[PM_FFT_LINES], size_t rows, size_t n, const size_t *at, double *block);
void pm_fft_rows_out(const double *block, const size_t *at, size_t n, size_t rows, double *const row[PM_FFT_LINES]);

/* The same for rows of reals and their spectra. out: the pair transforms in a block (rows q and q+8 as real and imaginary part) to frequencies
 * 0 .. n/2 of each row, in chunks of eight: real parts, then imaginary parts, the last chunk filled up with zeros, 64-byte aligned. in: the way back;
 * imaginary parts of frequencies 0 and n/2 are ignored. shared (even n): frequency n/2 is the imaginary part of frequency 0, and none is beyond n/2 - 1. */
void pm_spectra_out(const struct pm_fft *f, const double *block, size_t rows, bool shared, double *const row[PM_FFT_LINES]);
void pm_spectra_in(const struct pm_fft *f, size_t rows, const double *const row[PM_FFT_LINES], bool shared, double *block);

/* Copies n doubles past the caches where the processor can. end: before others read them. */
void pm_stream(double *to, const double *from, size_t n);
void pm_stream_end(void);

#endif
