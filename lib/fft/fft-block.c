/* Complex FFT of eight lines side by side, mixed radix 2, 3, 4, 5, 7, 8, 11, 13: decimation in frequency forward, which leaves the
 * frequencies in digit-reversed rows, and its exact reverse back, which takes them from there. A convolution never needs them sorted.
 *   forward stage of length N = r M:  b_p = w_N^{j p} sum_q a_q w_r^{p q},  a_q in row j + q M, b_p in row j + p M,  w_N = exp(-2 pi i/N)
 * The stages are in fft-stages.c; greater primes up to 251 are stages too, slower ones (prime-dft.c). Lengths with a prime factor above that go to FFTW, as
 * split arrays in the same layout.
 * Source: Gentleman and Sande 1966; Cooley and Tukey 1965; the lane layout as in FFTW's and ducc's vector passes.
 * SPDX-License-Identifier: GPL-3.0-or-later */
#include <stdlib.h>
#include <string.h>

#include "fft/fft-block.h"
#include "fft/prime-dft.h"

void pm_fft_circle(size_t i, size_t n, double *c, double *s)
{
	size_t quarter = 4 * (i % n) / n, r = 4 * (i % n) - quarter * n;
	bool far = 2 * r > n;
	double x = (double)(far ? n - r : r) / (double)n * (pm_pi / 2), co = far ? sin(x) : cos(x), si = far ? cos(x) : sin(x);
	*c = quarter == 0 ? co : quarter == 1 ? -si : quarter == 2 ? -co : si;
	*s = quarter == 0 ? si : quarter == 1 ? co : quarter == 2 ? -si : -co;
}

/* Stages of radix 8 and 4 for the twos, then the odd primes; 0 if a greater one is left. */
static int factors(struct pm_fft *f)
{
	size_t n = f->n;
	int twos = 0;
	for (; n % 2 == 0; n /= 2)
		twos++;
	while (twos) {
		int take = twos == 2 || twos == 4 ? 2 : twos < 3 ? twos : 3;
		f->radix[f->stages++] = 1 << take;
		twos -= take;
	}
	for (int r = 3; r <= PM_PRIME_MOST; r += 2)
		for (; n % (size_t)r == 0; n /= (size_t)r)
			f->radix[f->stages++] = r;
	if (n > 1)
		f->stages = 0;
	return f->stages;
}

static int tables(struct pm_fft *f)
{
	size_t length = f->n;
	for (int s = 0; s < f->stages; s++) {
		size_t r = (size_t)f->radix[s], m = length / r;
		double *w = f->twiddle[s] = pm_alloc(2 * m * (r - 1), sizeof *w);
		if (!w)
			return -PM_DATA;
		for (size_t j = 0; j < m; j++)
			for (size_t p = 1; p < r; p++, w += 2)
				pm_fft_circle(j * p, length, &w[0], &w[1]);
		for (size_t i = 0; i < r && r <= PM_PRIME && r != 8; i++)
			pm_fft_circle(i, r, &f->cosine[r][i], &f->sine[r][i]);
		if (r > PM_PRIME && !(f->circle[s] = pm_alloc(2 * r, sizeof *w)))
			return -PM_DATA;
		for (size_t i = 0; i < r && r > PM_PRIME; i++)
			pm_fft_circle(i, r, &f->circle[s][2 * i], &f->circle[s][2 * i + 1]);
		length = m;
	}
	for (size_t k = 0; k < f->n; k++) {
		size_t rest = k, m = f->n;
		f->at[k] = f->stages ? 0 : k;
		for (int s = 0; s < f->stages; s++) {
			m /= (size_t)f->radix[s];
			f->at[k] += rest % (size_t)f->radix[s] * m;
			rest /= (size_t)f->radix[s];
		}
	}
	f->at[f->n] = f->at[0];
	return 0;
}

static void *fft_free(void *fft)
{
	struct pm_fft *f = fft;
	for (int s = 0; f && s < f->stages; s++)
		pm_free(f->twiddle[s]), pm_free(f->circle[s]);
	if (f)
		pm_free(f->at), pm_free(f->half), pm_free(f->quarter);
	for (int i = 0; f && i < 5; i++)
		pm_free(f->fold[i]);
	free(f);
	return NULL;
}

struct pm_fft *pm_fft(struct pm_fft_plans *p, size_t n)
{
	for (int i = 0; i < p->nmade; i++)
		if (((struct pm_fft *)p->made[i])->n == n)
			return p->made[i];
	struct pm_fft *f = calloc(1, sizeof *f);
	if (!f || p->nmade == PM_FFT_PLANS) {
		f ? pm_fail(PM_DATA, "no transform of length %zu", n) : pm_no_memory();
		free(f);
		return NULL;
	}
	f->n = n;
	f->at = pm_alloc(n + 1, sizeof *f->at);
	bool good = f->at != NULL;
	if (good && n > 1 && !factors(f))
		good = (f->forward = pm_plan(p, PM_BLOCK_FORWARD, n)) && (f->backward = pm_plan(p, PM_BLOCK_BACKWARD, n));
	if (!good || tables(f))
		return fft_free(f);
	p->unmake = fft_free;
	return p->made[p->nmade++] = f;
}

struct pm_fft *pm_fft_shifted(struct pm_fft_plans *p, size_t n)
{
	struct pm_fft *f = pm_fft(p, n);
	if (!f || f->half)
		return f;
	f->half = pm_alloc(2 * n, sizeof *f->half);
	for (size_t i = 0; f->half && i < n; i++)
		pm_fft_circle(i, 2 * n, &f->half[2 * i], &f->half[2 * i + 1]);
	return f->half ? f : NULL;
}
