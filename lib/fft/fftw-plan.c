/* FFTW's plans, by FFTW_ESTIMATE and from nothing else: measured plans depend on what else the machine was doing, and different plans round differently.
 * So plans are the same wherever FFTW and the instruction set are. They cost up to 60 % more (docs/speed.md). A host program's wisdom is set
 * aside while a plan is made, since FFTW would follow it, and put back.
 * Source: Frigo and Johnson 2005 (FFTW 3). SPDX-License-Identifier: GPL-3.0-or-later */
#include <limits.h>
#include <stdlib.h>
#include <string.h>

#include "fft/fftw-plan.h"

static fftw_plan make(enum pm_fft_direction transform, size_t n, double *block)
{
	fftw_iodim length = {(int)n, PM_FFT_LINES, PM_FFT_LINES}, lines = {PM_FFT_LINES / 2, 1, 1};
	bool back = transform == PM_BLOCK_BACKWARD; /* the transform of the other sign exchanges real and imaginary parts */
	double *re = block + (back ? PM_FFT_LINES / 2 : 0), *im = block + (back ? 0 : PM_FFT_LINES / 2);
	char *host = fftw_export_wisdom_to_string();
	if (!host) {
		pm_no_memory();
		return NULL;
	}
	fftw_forget_wisdom();
	fftw_plan plan = fftw_plan_guru_split_dft(1, &length, 1, &lines, re, im, re, im, FFTW_ESTIMATE);
	fftw_forget_wisdom();
	if (!fftw_import_wisdom_from_string(host)) {
		fftw_destroy_plan(plan);
		plan = NULL;
	}
	free(host);
	return plan;
}

/* Adds what the plan consists of to the checksum. */
static bool sign(struct pm_fft_plans *p, fftw_plan plan)
{
	char *text = fftw_sprint_plan(plan);
	if (text)
		p->sum = pm_crc32c(p->sum, text, strlen(text));
	else
		pm_no_memory();
	free(text);
	return text != NULL;
}

fftw_plan pm_plan(struct pm_fft_plans *p, enum pm_fft_direction transform, size_t n)
{
	for (int i = 0; i < p->n; i++)
		if (p->entry[i].transform == transform && p->entry[i].n == n)
			return p->entry[i].plan;
	if (p->n == PM_FFT_PLANS || n > INT_MAX / PM_FFT_LINES) {
		pm_fail(PM_DATA, "no plan for transforms of length %zu", n);
		return NULL;
	}
	double *block = pm_zalloc(n * PM_FFT_LINES, sizeof *block);
	fftw_plan plan = block ? make(transform, n, block) : NULL;
	pm_free(block);
	if (block && (!plan || !sign(p, plan))) {
		fftw_destroy_plan(plan);
		pm_fail(PM_DATA, "FFTW makes no plan for transforms of length %zu", n);
		return NULL;
	}
	if (plan) {
		p->entry[p->n].transform = transform;
		p->entry[p->n].n = n;
		p->entry[p->n++].plan = plan;
	}
	return plan;
}

void pm_fft_plans_clear(struct pm_fft_plans *p)
{
	for (int i = 0; i < p->nmade; i++)
		p->unmake(p->made[i]);
	for (int i = 0; i < p->n; i++)
		fftw_destroy_plan(p->entry[i].plan);
	*p = (struct pm_fft_plans){0};
}

struct pm_fft_plans *pm_fft_plans_new(void) { return pm_zalloc(1, sizeof(struct pm_fft_plans)); }

struct pm_fft_plans *pm_fft_plans_free(struct pm_fft_plans *p)
{
	if (p)
		pm_fft_plans_clear(p);
	return pm_free(p);
}
