/* The multiplier of the spectrum for open faces: the transform of the Green's function over the open axes, for every wave along the others.
 * Private to lib/poisson-fft. SPDX-License-Identifier: GPL-3.0-or-later */
#ifndef PM_POISSON_FFT_FFT_OCTANT_H
#define PM_POISSON_FFT_FFT_OCTANT_H

#include "green/green.h"
#include "fft/axis-transform.h"
#include "poisson-fft/poisson-fft.h"

struct pm_octant {
	const struct pm_green *green;
	enum pm_symbol symbol;   /* of differences, which the lattice's function inverts */
	double screen2, width;   /* [1/length^2] of the screened equation; [length] of pm_green_case */
	struct {
		bool open;
		size_t n;             /* open: cells, doubled by the transform; else modes */
		double h;             /* [length] of an open axis */
		const double *lambda; /* [1/length^2] eigenvalue by mode, not above 0, of another axis */
		size_t size;          /* filled in: n+1 frequencies 0 ... n of the doubled length, or n */
	} axis[3];               /* x, y, z as they lie in memory */
	size_t rows, *map;       /* numbers in a row, and of each which frequency or mode along x it is; 0 where that is none */
	size_t row;              /* [doubles] stride of rows */
	size_t *held, *held_of;  /* NULL, or of several ranks those along axis 2 that each wants, one rank behind the other, and where each rank begins */
};

/* *all: spectrum[z][y][x] with the strides row and axis[0..1], of sum over nodes of h^d G s for unit s, pm_alloc'ed; of several ranks z counts those that this
 * one wants. Takes the caller's status, and returns it or a failure; of several ranks the one that they agree on. */
int pm_octant_spectrum(int status, struct pm_octant *o, struct pm_fft_plans *planner, double **all);

#endif
