/* The force on particles beyond the open faces of a mesh, and their reaction on those inside (docs/methods/transfer.md).
 * SPDX-License-Identifier: GPL-3.0-or-later */
#ifndef PM_TRANSFER_OUTSIDE_H
#define PM_TRANSFER_OUTSIDE_H

#include "transfer/transfer-frame.h"

/* Strengths as they are seen from afar: a ball (in 2-D a disc) of constant density. */
struct pm_outside_ball {
	double strength, centre[3], radius; /* [strength], [length] */
};

struct pm_outside_force {
	const struct pm_law *law;
	struct pm_transfer transfer;   /* of the deposit: it decides what is outside */
	const char *strength;          /* of the sources */
	struct pm_sets sources;
	double coefficient;            /* of the law, over the lengths of the axes that are not open */
	double charge;                 /* [strength/length^dim] uniform density that fills the mesh, of the law's background */
	int open, axis[3];             /* open axes */
	double image[3], plane[3];     /* per axis: +1 or -1 where it is closed at one end, and that end; else 0 */
	uint64_t count;                /* particles outside, of all sources */
	uint64_t within;               /* and inside */
	struct pm_outside_ball inside, background;
	double potential, gradient[3]; /* of the law's potential, made by those outside, at the centre of those inside */
	double energy;                 /* sum of strength times potential of those outside: the energy between outside and inside */
};

/* Does any face of the mesh let particles out? */
bool pm_outside_open(const struct pm_grid *g);

/* Prepares for the density that `made` (a mesh field with a kernel) was computed from. 1 if it is the law's, so that the monopole is known; 0 if not; or
 * failure. Reads: declares those of the sources. */
int pm_outside_init(struct pm_outside_force *o, const struct pm_frame *f, const struct pm_mesh *m, const struct pm_field *made);
int pm_outside_reads(const struct pm_outside_force *o, struct pm_frame *f);

/* Is any particle of the set outside? */
int pm_outside_any(const struct pm_frame *f, const char *set, const struct pm_transfer *t, bool *any);
/* mask[p] = 1 if particle p of the set is outside, else 0; NULL: not wanted. Of those beyond a wall or neumann face *closed has the count and the first. */
int pm_outside_find(const struct pm_frame *f, const char *set, const struct pm_transfer *t, unsigned char *mask, struct pm_strays *closed);

/* With the data: counts, balls, reaction, energy. The same bytes for any number of threads. */
int pm_outside_measure(struct pm_outside_force *o, const struct pm_frame *f);
/* Potential and gradient at `at` of a ball of unit strength at `from`, times the coefficient, with its images. */
void pm_outside_pair(const struct pm_outside_force *o, const double at[3], const double from[3], double radius, double *potential, double gradient[3]);
/* The law's potential of those inside at a particle outside, and its gradient. */
void pm_outside_at(const struct pm_outside_force *o, const double x[3], double *potential, double gradient[3]);

#endif
