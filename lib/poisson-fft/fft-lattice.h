/* The Green's function of centred differences on an infinite lattice, by heat kernels; private to lib/poisson-fft.
 * SPDX-License-Identifier: GPL-3.0-or-later */
#ifndef PM_POISSON_FFT_FFT_LATTICE_H
#define PM_POISSON_FFT_FFT_LATTICE_H

#include "green/green.h"
#include "poisson-fft/poisson-fft.h"

enum { PM_LATTICE_NODES = 960 }; /* the most */

struct pm_lattice {
	int dim;         /* open axes */
	size_t nodes;    /* of the integral over t */
	double *t, *w;   /* [length^2], weights */
	double last;     /* [length^2] the end of the nodes; from there on heat spreads as in the continuum */
	double *heat[3]; /* of each open axis [node][n+1], 1/length */
	double *weight;  /* [case][node]: w exp(-kappa^2 t) */
};

/* Open axes of n cells of h, and the cases that occur. NULL with a message. */
struct pm_lattice *pm_lattice_new(int dim, const size_t n[3], enum pm_symbol symbol, size_t ncases, const struct pm_green_case *cases);
struct pm_lattice *pm_lattice_free(struct pm_lattice *l);

/* row[i] -= weighted sum over the nodes of other[node] heat_0[node][i] for i = 0 ... n, the tail not yet added. */
void pm_lattice_row(const struct pm_lattice *l, size_t n, const double *other, double *row);
/* The remainder of the integral after the last node, at distance sqrt(r2), for kappa = 0. */
double pm_lattice_tail(const struct pm_lattice *l, double r2);

#endif
