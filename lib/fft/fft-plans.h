/* A collection of transforms, each made once: the part of lib/fft that callers of the solvers need. SPDX-License-Identifier: GPL-3.0-or-later */
#ifndef PM_FFT_PLANS_H
#define PM_FFT_PLANS_H

#include "base/base.h"

PM_C_BEGIN

struct pm_fft_plans; /* fft/fftw-plan.h */
struct pm_fft_plans *pm_fft_plans_new(void); /* empty; NULL with a message */
struct pm_fft_plans *pm_fft_plans_free(struct pm_fft_plans *p);

PM_C_END

#endif
