/* The spectrum of a field on a mesh: |u^_k|^2 summed over shells of wave numbers. SPDX-License-Identifier: GPL-3.0-or-later */
#ifndef PM_MEASURE_MESH_SPECTRUM_H
#define PM_MEASURE_MESH_SPECTRUM_H

#include "fft/fft-plans.h"
#include "mesh/grid.h"

struct pm_wave_shell {
	double k;      /* [1/length] mean |k| of its waves */
	double log_k[3];  /* mean, variance and third cumulant of ln |k| among them */
	double waves;  /* how many: of the box, or of the box and its images along axes that are not periodic */
	double square; /* [field^2] sum of |u^_k|^2 over waves and components, u = sum over k of u^_k exp(i k x) */
};

struct pm_spectrum {
	size_t n;
	struct pm_wave_shell *shell; /* number j has waves of (j - 1/2) width <= |k| < (j + 1/2) width, without the mean */
	double width;           /* [1/length] */
	double volume;          /* [length^dim] of the box */
	double mean[PM_COMPONENTS];
	double mean_square;     /* of the field, by a sum over the nodes (end nodes of axes that are not periodic count half) */
	double waves_square;    /* by the sum over all waves and the mean, which Parseval's identity says is the same */
};

/* Width 0: the largest of the wave numbers 2 pi/L (periodic) or pi/L (other faces) of the axes. 0 or failure with a message; the shells are the caller's. */
int pm_spectrum_of(const struct pm_grid *g, const struct pm_field *field, double width, struct pm_fft_plans *plans, struct pm_spectrum *s);
void pm_spectrum_free(struct pm_spectrum *s);

struct pm_slope {
	double power, error; /* of k in the mean square of a wave; NAN: fewer than three shells */
	size_t shells;
};
/* Fits ln(square/waves) = power ln k + c to the shells with from <= k <= to, weighted by their waves, where the mean of k^power over a shell is by
 * the cumulants of ln k in it (to the third); the error is from what the fit leaves. */
struct pm_slope pm_spectrum_slope(const struct pm_spectrum *s, double from, double to);

#endif
