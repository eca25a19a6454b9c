/* Real fields on a periodic mesh as sums of waves, and derivatives of waves between points half a cell apart. SPDX-License-Identifier: GPL-3.0-or-later */
#ifndef PM_MAXWELL_PARTS_YEE_WAVES_H
#define PM_MAXWELL_PARTS_YEE_WAVES_H

#include "fft/fft-block.h"
#include "maxwell-parts/yee.h"

enum { PM_WAVES_MOST = 9, PM_WAVES_CHUNK = PM_FFT_LINES / 2 };

/* Of an axis: the derivative of a wave, i k exp(i k h/2), from the nodes to half a cell up; minus the conjugate takes it back. Where E and B are on the nodes,
 * i k. Along x from frequency 0 to n/2, along y and z all n. */
struct pm_wave_axis {
	size_t n, modes;
	const struct pm_fft *fft;
	double *re, *im; /* [1/length] */
	double *k;       /* [1/length] signed; 0 at the Nyquist frequency, where a sign is not defined */
	double *turn[2]; /* cos and -sin of k h/2: from half a cell up to the nodes */
	double *ratio;   /* of two-point differences to derivatives: sin(k h/2)/(k h/2) */
};

struct pm_yee_waves {
	struct pm_wave_axis axis[3];
	size_t chunks;   /* of eight frequencies along x: eight real parts, then eight imaginary ones; those beyond n/2 are zeros */
	/* What is here of every z: rows y and chunks of them; alone all, of several ranks in 3-D some rows, in 2-D some chunks. A field is
	 * ((z n_y + y) chunks + chunk) 2 PM_WAVES_CHUNK with their numbers. */
	size_t y[2], chunk[2];
	size_t size;     /* numbers of one field */
	struct pm_planes planes; /* of several ranks: as those of the mesh, with rows of waves in place of points */
	bool nodal;      /* fields on the nodes: their shortest waves along an axis have no derivative, and are left out */
	double norm;     /* forward and backward together multiply by 1/norm */
	struct pm_fft_plans *plans;
	double *tables, *scratch; /* of each thread `lot` numbers */
	size_t lot;
	double *field[PM_WAVES_MOST];
};

/* The first of eight frequencies of a row y and chunk, in a field. */
static inline size_t pm_yee_waves_at(const struct pm_yee_waves *w, size_t chunk, size_t j, size_t k)
{
	return ((k * (w->y[1] - w->y[0]) + j - w->y[0]) * (w->chunk[1] - w->chunk[0]) + chunk - w->chunk[0]) * 2 * PM_WAVES_CHUNK;
}

/* Is the wave left out? */
static inline bool pm_yee_waves_shortest(const struct pm_yee_waves *w, size_t i, size_t j, size_t k)
{
	return w->nodal && (2 * i == w->axis[0].n || 2 * j == w->axis[1].n || 2 * k == w->axis[2].n);
}

/* Room for the waves of so many fields; 0 or failure, which the ranks agree on. Then free, also after a failure. */
int pm_yee_waves_init(struct pm_yee_waves *w, const struct pm_yee *y, int fields);
void pm_yee_waves_free(struct pm_yee_waves *w);
/* Points to waves, field[to] of from; and back, not normalised. They take the caller's status and return the agreed one; of several ranks the way back gives
 * up field[from]. */
int pm_yee_waves_forward(int status, struct pm_yee_waves *w, const double *from, int to);
int pm_yee_waves_backward(int status, struct pm_yee_waves *w, int from, double *to);

/* to = div E - rho/eps0 on the nodes by these derivatives; rho NULL: 0. Then E less the gradient whose divergence that is. Each 0 or failure; ranks that share
 * the mesh (y->planes) call them together. */
int pm_yee_waves_divergence(const struct pm_yee *y, const double *rho, double *to);
int pm_yee_waves_correct(const struct pm_yee *y, const double *residual);

#endif
