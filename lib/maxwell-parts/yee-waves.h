/* Real fields on a periodic mesh as sums of waves, and derivatives of waves between points half a cell apart. SPDX-License-Identifier: GPL-3.0-or-later */
#ifndef PM_MAXWELL_PARTS_YEE_WAVES_H
#define PM_MAXWELL_PARTS_YEE_WAVES_H

#include "fft/fft-block.h"
#include "maxwell-parts/yee.h"

enum { PM_WAVES_MOST = 9, PM_WAVES_CHUNK = PM_FFT_LINES / 2 };

/* Of an axis: i k exp(i k h/2), which takes a wave's value on the nodes to its derivative half a cell up; minus the conjugate takes it back. Along x from
 * frequency 0 to n/2, along y and z all n. */
struct pm_wave_axis {
	size_t n, modes;
	const struct pm_fft *fft;
	double *re, *im; /* [1/length] */
	double *k;       /* [1/length] signed; 0 at the Nyquist frequency, where a sign is not defined */
	double *ratio;   /* of two-point differences to derivatives: sin(k h/2)/(k h/2) */
};

struct pm_yee_waves {
	struct pm_wave_axis axis[3];
	size_t chunks;   /* of eight frequencies along x: eight real parts, then eight imaginary ones; those beyond n/2 are zeros */
	size_t size;     /* numbers of one field: ((z n_y + y) chunks + chunk) 2 PM_WAVES_CHUNK */
	double norm;     /* forward and backward together multiply by 1/norm */
	struct pm_fft_plans *plans;
	double *tables, *scratch; /* of each thread `lot` numbers */
	size_t lot;
	double *field[PM_WAVES_MOST];
};

/* Room for the waves of so many fields; 0 or failure. Then free, also after a failure. */
int pm_yee_waves_init(struct pm_yee_waves *w, const struct pm_grid *g, int fields);
void pm_yee_waves_free(struct pm_yee_waves *w);
/* Points to waves, field[to] of from; and back, not normalised. */
void pm_yee_waves_forward(const struct pm_yee_waves *w, const double *from, int to);
void pm_yee_waves_backward(const struct pm_yee_waves *w, int from, double *to);

/* to = div E - rho/eps0 on the nodes by these derivatives; rho NULL: 0. Then E less the gradient whose divergence that is. Each 0 or failure. */
int pm_yee_waves_divergence(const struct pm_yee *y, const double *rho, double *to);
int pm_yee_waves_correct(const struct pm_yee *y, const double *residual);

#endif
