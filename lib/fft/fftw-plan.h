/* Plans of the transforms: serial FFTW plans, measured once under a lock and kept in the user's cache, so that every process computes with
 * the same plan and so gets the same bytes. SPDX-License-Identifier: GPL-3.0-or-later */
#ifndef PM_FFT_FFTW_PLAN_H
#define PM_FFT_FFTW_PLAN_H

#include <fftw3.h>

#include "fft/fft-effort.h"

enum { PM_FFT_LINES = 16, PM_FFT_PLANS = 16 };

/* Of blocks: double [n][PM_FFT_LINES], PM_FFT_LINES/2 complex lines side by side, real parts first (fft/fft-block.h), in place, not normalised. */
enum pm_fft_direction { PM_BLOCK_FORWARD, PM_BLOCK_BACKWARD };

struct pm_fft_plans {
	enum pm_fft_effort effort;
	int n;
	struct {
		enum pm_fft_direction transform;
		size_t n;
		fftw_plan plan;
	} entry[PM_FFT_PLANS];
	int stored, measured, estimated; /* where the plans came from: the cache, measured now, no cache to keep them in */
	uint32_t sum;                    /* CRC-32C of the wisdom in use; 0 if all is estimated */
	char note[320];                  /* what was wrong with the cache, "" nothing */
	int nmade;                       /* transforms made with it (fft/fft-block.c) */
	void *made[PM_FFT_PLANS], *(*unmake)(void *);
};

/* A plan, owned by the planner. The planner of FFTW is not thread-safe: never inside a parallel region. NULL with a message. */
fftw_plan pm_plan(struct pm_fft_plans *p, enum pm_fft_direction transform, size_t n);
void pm_fft_plans_clear(struct pm_fft_plans *p);

#endif
