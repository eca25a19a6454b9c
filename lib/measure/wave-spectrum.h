/* Waves of a run by wave number and frequency, and the waves that its species should have: what the word dispersion measures.
 * SPDX-License-Identifier: GPL-3.0-or-later */
#ifndef PM_MEASURE_WAVE_SPECTRUM_H
#define PM_MEASURE_WAVE_SPECTRUM_H

#include <stdio.h>

#include "measure/wave-theory.h"

struct pm_wave_spectrum {
	int modes;                 /* 1..modes along x */
	size_t n, room;            /* frames */
	double *t;                 /* [time] of each */
	double complex *a;         /* [frame][mode - 1] amplitude of exp(i k x) */
	double k1;                 /* [1/length] of mode 1 */
	struct pm_wave_theory theory; /* of the first frame */
	double *power;             /* [mode - 1][0..half]: see pm_wave_spectrum_done */
	size_t half;
	double step;               /* [1/time] of the frequencies */
};

/* Header: the reads. 0 or failure: the box is not periodic along x, or nothing has a field. */
int pm_wave_reads(const struct pm_measure *how, struct pm_frame *f);
/* Data: the modes of the law's field (component how->wave), and of the first frame the species. 0 or failure. */
int pm_wave_add(struct pm_wave_spectrum *s, const struct pm_measure *how, const struct pm_frame *f);
/* Transforms in time of all frames: power[j] = |A(j step)|^2 + |A(-j step)|^2 with A the mean of a exp(i omega t) under Hann's window, over the mean of the
 * window, so that a steady wave of amplitude 1 has 1 at its frequency. 0 or failure: too few frames, or not equally spaced. */
int pm_wave_done(struct pm_wave_spectrum *s);
/* Frequency of the largest power of a mode in the range [1/time], between the frequencies by a parabola through the logarithms; NAN: no power. */
double pm_wave_peak(const struct pm_wave_spectrum *s, int mode, const double range[2], double *power);
/* A line per mode: k, the peak, its power, the resolution, and the root of the dispersion relation nearest to it. */
void pm_wave_print(const struct pm_wave_spectrum *s, const double range[2], FILE *out);
/* A frame of the mesh `waves` with axes k and omega and the fields power and log_power (to base 10). NULL: failure. */
struct pm_frame *pm_wave_frame(const struct pm_wave_spectrum *s, double highest);
void pm_wave_free(struct pm_wave_spectrum *s);

#endif
