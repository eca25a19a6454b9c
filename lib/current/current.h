/* The current of particles on their way through one step (docs/methods/maxwell.md). SPDX-License-Identifier: GPL-3.0-or-later */
#ifndef PM_CURRENT_H
#define PM_CURRENT_H

#include "transfer/transfer.h"

PM_C_BEGIN

enum pm_deposit { PM_ESIRKEPOV, PM_VILLASENOR_BUNEMAN, PM_DIRECT };
extern const char *const pm_deposit_names[]; /* NULL ends */

struct pm_current {
	struct pm_grid grid;
	const struct pm_kernel *kernel;
	enum pm_deposit deposit;
	enum pm_particle_face face[3][2]; /* what push does with the particles there */
	double lo[3], hi[3];              /* [length] the box, where these faces are */
	double dt;                        /* [time] of the drift; negative: backwards */
	struct pm_note **kept;            /* NULL, or where the order of the particles may be left, which the gather before made */
	const struct pm_current_few *few; /* NULL: the velocities are there; or what makes them (current-parts.h) */
	const struct pm_planes *planes;   /* NULL, or those of the mesh that this rank has, with a part of the particles: all ranks call */
};

/* 0, or the sentence that says which faces or kernel cannot be had. */
int pm_current_check(const struct pm_current *c);

/* j[3][points] [charge/(time length^(dim - 1))] += the mean current during dt of n particles of charge q at x[dim][n] that move with v[3][n] (NULL: 0),
 * component k half a cell up axis k. Except with PM_DIRECT the density that p2m makes of the particles before and after changes by -dt div j, to round-off,
 * at all nodes but those of wall faces and of open ones. 0 or failure; *stray is the first particle outside the box (a failure), n if there is none; where
 * planes are divided its number in the whole stream, and SIZE_MAX.
 * The same bytes for any number of threads. */
int pm_current_add(const struct pm_current *c, size_t n, const double *const x[3], const double *const v[3], const double *q, double *const j[3],
	size_t *stray);

/* For pm_current_add, in parts (current-ways.c): the ways of the particles, cut where they are longer than a cell and where they meet a face. */
struct pm_ways {
	size_t n;
	double *at[3];   /* [n] [length] where it begins on each axis below dim */
	double *way[3];  /* [n] [cells] signed length on each axis below dim */
	double *q;       /* [n] [charge] */
	double *along[3];/* [n] axes above dim: charge times velocity times the part of dt */
	double *memory;
};
int pm_ways_init(struct pm_ways *w, const struct pm_current *c, size_t n, const double *const x[3], const double *const v[3], const double *q);
int pm_ways_new(struct pm_ways *w, int dim, size_t n); /* room for n; 0 or failure */
void pm_ways_free(struct pm_ways *w);

PM_C_END

#endif
