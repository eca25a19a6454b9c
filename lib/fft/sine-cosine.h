/* Sine and cosine transforms of blocks of lines (fft/axis-transform.h) by complex FFTs of length n; used by fft/axis-transform.c.
 * SPDX-License-Identifier: GPL-3.0-or-later */
#ifndef PM_FFT_SINE_COSINE_H
#define PM_FFT_SINE_COSINE_H

#include "fft/fft-block.h"

/* Walls, neumann faces, a wall below a neumann face, a wall above one. */
enum pm_waves { PM_WAVES_NONE, PM_WAVES_SINE, PM_WAVES_COSINE, PM_WAVES_QUARTER_SINE, PM_WAVES_QUARTER_COSINE };

/* As pm_fft, with the tables of these transforms of n cells. */
const struct pm_fft *pm_fft_sine_cosine(struct pm_fft_plans *p, size_t n);

/* f: of pm_fft_sine_cosine, n cells. Nodes 0 ... n in rows 0 ... n (what is on a wall is not read, and not set on the way back); modes as of
 * pm_transform_real, but quarter waves of a wall below have the sign (-1)^m. Both together multiply by 2n. */
void pm_sine_cosine(enum pm_waves fold, const struct pm_fft *f, double *block);
void pm_sine_cosine_back(enum pm_waves fold, const struct pm_fft *f, double *block);

#endif
