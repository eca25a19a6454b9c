/* The Poisson solver by fast transforms: lap phi - K^2 phi = c*s with the faces of a grid (docs/methods/poisson-fft.md).
 * SPDX-License-Identifier: GPL-3.0-or-later */
#ifndef PM_POISSON_FFT_H
#define PM_POISSON_FFT_H

#include "green/green.h"
#include "mesh/grid.h"
#include "fft/fft-plans.h"
#include "poisson-fft/influence.h"

PM_C_BEGIN

enum pm_symbol { PM_SPECTRAL, PM_FD2, PM_FD4, PM_FD6 };
extern const char *const pm_symbol_names[]; /* NULL ends */
int pm_symbol_find(const char *name);       /* -1 and a message if it is none */

/* The eigenvalue [1/length^2] of -k^2, or of the centred second difference of order 2, 4 or 6, on exp(i*theta*x/h). */
double pm_symbol_value(enum pm_symbol symbol, double theta, double h);

struct pm_planes;

struct pm_poisson_fft_choice {
	enum pm_symbol symbol;
	double screening; /* K [1/length] in lap phi - K^2 phi = c*s; 0: Poisson's equation */
	const struct pm_green *green; /* of open faces; NULL: hockney, with differences lattice. Softened: of all faces */
	double softening;             /* [length] delta of its blobs, where the method has any; 0: 2 sqrt(2) times the largest spacing of an open axis.
	                               * Of plummer epsilon, 0: none */
	struct pm_influence influence; /* of periodic boxes */
	int fitted; /* 1 + 2 axis + (neumann): known values on faces of that axis, walls or neumann ones (fft-fitted.c); 0: a source */
	const struct pm_planes *planes; /* NULL, or those of s and phi that this rank has, to be there for pm_poisson_fft_new (mesh/planes.h) */
	double wave; /* a [1/length] in lap phi + a^2 phi = c*s (Helmholtz) instead of K; no open faces */
	bool james;  /* open space from two solutions between walls (fft-james.c); fd2, open faces on all axes, no planes */
};

struct pm_poisson_fft;

const struct pm_green *pm_poisson_fft_green_of(const struct pm_poisson_fft_choice *o); /* the one taken where faces are open */

/* 0, or the sentence that says what cannot be done and what can do it; needs no data and plans nothing. */
int pm_poisson_fft_check(const struct pm_grid *g, const struct pm_poisson_fft_choice *o);
/* Only periodic and neumann faces and no screening: phi is free by a constant. */
bool pm_poisson_fft_singular(const struct pm_grid *g, const struct pm_poisson_fft_choice *o);

/* NULL with a message. */
struct pm_poisson_fft *pm_poisson_fft_new(const struct pm_grid *g, const struct pm_poisson_fft_choice *o);
struct pm_poisson_fft *pm_poisson_fft_free(struct pm_poisson_fft *p);
/* With a wave: the distance |lambda + a^2|/a^2 to the nearest eigenvalue. */
double pm_poisson_fft_distance(const struct pm_poisson_fft *p);
const struct pm_fft_plans *pm_poisson_fft_planner(const struct pm_poisson_fft *p);

/* The mean removed from a singular problem; 0, 0 for others. And how large phi is. */
struct pm_poisson_fft_record {
	double mean;         /* of s, end nodes with half weight: taken out; phi has mean zero */
	double incompatible; /* |mean| over the largest |s|: round-off where the data fit the faces */
	double most;         /* of this rank's |phi|; NAN: not known; INFINITY: not all are finite */
};

/* s and phi: the points of the grid; they may be the same array. c [phi/(s length^2)]. r may be NULL. */
int pm_poisson_fft_solve(struct pm_poisson_fft *p, double c, const double *s, double *phi, struct pm_poisson_fft_record *r);

PM_C_END

#endif
