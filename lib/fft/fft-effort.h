/* How the plans of FFTW are chosen, and a collection of them: the part of FFTW that callers of the transform solvers need.
 * SPDX-License-Identifier: GPL-3.0-or-later */
#ifndef PM_FFT_EFFORT_H
#define PM_FFT_EFFORT_H

#include "base/base.h"

PM_C_BEGIN

enum pm_fft_effort { PM_ESTIMATE, PM_MEASURE, PM_PATIENT };
extern const char *const pm_fft_effort_names[]; /* NULL ends */
/* Effort by name; NULL: of the environment variable PM_PLAN, else measure. -1 and a message if the name is none. */
int pm_fft_effort_find(const char *name);

struct pm_fft_plans; /* fft/fftw-plan.h */
struct pm_fft_plans *pm_fft_plans_new(enum pm_fft_effort effort); /* empty; NULL with a message */
struct pm_fft_plans *pm_fft_plans_free(struct pm_fft_plans *p);

PM_C_END

#endif
