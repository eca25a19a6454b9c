/* FFTW's plans for lengths with a prime factor above 251, and the transforms made with them (fft/fft-block.h).
 * SPDX-License-Identifier: GPL-3.0-or-later */
#ifndef PM_FFT_FFTW_PLAN_H
#define PM_FFT_FFTW_PLAN_H

#include <fftw3.h>

#include "fft/fft-plans.h"

enum { PM_FFT_LINES = 16, PM_FFT_PLANS = 16 };

/* Of blocks: double [n][PM_FFT_LINES], PM_FFT_LINES/2 complex lines side by side, real parts first (fft/fft-block.h), in place, not normalised. */
enum pm_fft_direction { PM_BLOCK_FORWARD, PM_BLOCK_BACKWARD };

struct pm_fft_plans {
	int n;
	struct {
		enum pm_fft_direction transform;
		size_t n;
		fftw_plan plan;
	} entry[PM_FFT_PLANS];
	uint32_t sum;                    /* CRC-32C of the plans as FFTW prints them; 0 if there are none */
	int nmade;                       /* transforms made with it (fft/fft-block.c) */
	void *made[PM_FFT_PLANS], *(*unmake)(void *);
};

/* A plan, owned by the collection. The planner of FFTW is not thread-safe: never inside a parallel region. NULL with a message. */
fftw_plan pm_plan(struct pm_fft_plans *p, enum pm_fft_direction transform, size_t n);
void pm_fft_plans_clear(struct pm_fft_plans *p);

#endif
