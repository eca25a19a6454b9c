/* Interpolation between particles and meshes (docs/methods/transfer.md). Spread: density(i) += sum over particles of strength * W(x - x_i) / volume of a
 * cell. Gather is its transpose: value(x) = sum over mesh points of W(x - x_i) value(i).
 * SPDX-License-Identifier: GPL-3.0-or-later */
#ifndef PM_TRANSFER_H
#define PM_TRANSFER_H

#include "kernel/kernel.h"
#include "mesh/grid.h"

PM_C_BEGIN

struct pm_planes;
struct pm_gradient_later;

struct pm_transfer {
	struct pm_grid grid;
	const struct pm_kernel *kernel;
	int components;
	int rim;   /* [cells] particles so much nearer to an open face than the kernel's reach are outside too */
	bool cut;  /* at open faces kernels are cut off instead: no particle is outside until its kernel is off the mesh */
	unsigned char staggered[PM_COMPONENTS][3]; /* 1 where the component sits half a cell up that axis */
	/* The image of a component in a wall has the opposite sign, in a neumann face the same; 1 exchanges the two along that axis
	 * (the normal component of a gradient). */
	unsigned char flip[PM_COMPONENTS][3];
	/* gather: NULL, or the kernel along axes on which a component sits half a cell up, one order lower than `kernel`: the shape of J, so energy is kept */
	const struct pm_kernel *lower;
	bool given[3][2];       /* a wall or neumann face without images: values were given on it; gathers of kernels of width 1 and 2 alone */
	struct pm_note **kept;   /* NULL, or where the order of these positions may be found and left (the note of their field) */
	const struct pm_planes *planes; /* NULL, or those of the mesh that this rank has, with a part of the particles: all ranks call, strays are those here */
	const struct pm_gradient_later *gradient; /* gather: NULL, or the field's components in place of mesh[] (mesh/gradient-later.h) */
	bool cleared;            /* spread: what the mesh has now may be cleared: it is zero, or not wanted */
	bool set[PM_COMPONENTS]; /* gather writes its values (0 for strays) instead of adding them */
};

/* Particles outside the mesh: beyond a wall, or so near an open face that the kernel would reach its end nodes. They are left out. */
struct pm_strays {
	uint64_t count;
	size_t first;  /* index of the first of them */
	double x[3];   /* [length] its position */
	int axis;      /* the axis along which it is outside */
	bool finite;   /* gather: every value it left is a finite number */
	double most;   /* gather: the largest sum of squares of the three components that it set at a particle; 0: not looked at */
};

/* x[d][n] positions; strength[c][n], mesh[c][points] += density. End nodes of neumann faces get twice the deposited value (half weight in mesh sums), those
 * of walls 0. 0 or failure (memory). strays is filled in. The same bytes for any number of threads. */
int pm_spread(const struct pm_transfer *t, size_t n, const double *const x[], const double *const strength[], double *const mesh[],
	struct pm_strays *strays);
/* out[c][p] += factor[c][p] * value; factor NULL or factor[c] NULL: 1. */
int pm_gather(const struct pm_transfer *t, size_t n, const double *const x[], const double *const mesh[], const double *const factor[],
	double *const out[], struct pm_strays *strays);
/* The same, particle by particle in the order of the stream: the reference in tests. */
int pm_spread_plain(const struct pm_transfer *t, size_t n, const double *const x[], const double *const strength[], double *const mesh[],
	struct pm_strays *strays);
int pm_gather_plain(const struct pm_transfer *t, size_t n, const double *const x[], const double *const mesh[], const double *const factor[],
	double *const out[], struct pm_strays *strays);

/* The images of E (else B) beyond faces under Maxwell's equations: E along a conductor is odd, through it even, B the other way round; at neumann faces the
 * opposite of both. Open faces cut the kernels. */
static inline void pm_transfer_maxwell(struct pm_transfer *t, bool electric)
{
	t->cut = true;
	for (int c = 0; c < 3; c++)
		for (int d = 0; d < 3; d++)
			t->flip[c][d] = (c == d) == electric;
}

/* How many cells to add below and above each axis so that the kernel of every particle stays inside; only open and absorbing faces move.
 * -PM_DATA with a message if a wall is in the way or the mesh would have more than PM_TRANSFER_POINTS points. */
#define PM_TRANSFER_POINTS 4294967296.0 /* 32 GiB a component */
int pm_transfer_grow(const struct pm_transfer *t, size_t n, const double *const x[], size_t below[3], size_t above[3]);

PM_C_END

#endif
