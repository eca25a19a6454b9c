/* Kernels beside bodies and faces: the weights of a particle on the nodes that may be used alone (docs/methods/remesh.md, Bodies).
 * SPDX-License-Identifier: GPL-3.0-or-later */
#ifndef PM_TRANSFER_ONE_SIDED_H
#define PM_TRANSFER_ONE_SIDED_H

#include "kernel/kernel.h"
#include "mesh/planes.h"

enum { PM_ONE_SIDED_DEGREE = 4 }; /* the most of its moments that are kept */

struct pm_one_sided {
	struct pm_grid grid;
	const struct pm_kernel *kernel;
	const unsigned char *mask; /* [points of the whole mesh] 1: inside a body, not used; NULL: none */
	const struct pm_planes *planes; /* NULL, or those of this rank: fields of the mesh, and particles, are those here, and all ranks call */
};

/* The weights of one particle. */
struct pm_one_sided_share {
	size_t n, room;
	size_t *node; /* [n] of the mesh */
	double *w;    /* [n] add to 1 */
	int degree;   /* of the polynomials for which they are exact; 0: the nearest nodes by a window */
	ptrdiff_t low, high; /* their planes lie between these of the divided axis, unfolded */
};

/* Particles whose kernel has a node that is masked, or at or beyond a face that is not periodic. */
struct pm_one_sided_few {
	const double *x[3];   /* of all particles */
	size_t *which, count; /* their numbers, in order */
	size_t lost, first;   /* of a spread or gather: how many had no node, and the first of them */
};

/* Those of n particles; which is to be freed. 0 or failure. */
int pm_one_sided_find(const struct pm_one_sided *o, size_t n, const double *const x[], struct pm_one_sided_few *few);
/* The share of a particle; reuses the memory of s. 1: no node within reach, or the particle is beyond the mesh. 0 or failure. */
int pm_one_sided_share(const struct pm_one_sided *o, const double x[3], struct pm_one_sided_share *s);
void pm_one_sided_share_free(struct pm_one_sided_share *s);
/* Of these: strengths q[c][particle] added to node[c], which holds strengths, no densities; or values gathered, value[c][k] of which[k]. The same bytes for any
 * number of threads and ranks, which agree on the status. 0 or failure. */
int pm_one_sided_spread(const struct pm_one_sided *o, struct pm_one_sided_few *few, int components, const double *const q[], double *const node[]);
int pm_one_sided_gather(const struct pm_one_sided *o, struct pm_one_sided_few *few, int components, const double *const mesh[], double *const value[]);

/* For one-sided-ranks.c. The planes (of the last axis, unfolded) between which the nodes of each particle lie, and the lost ones, whose high is below low. */
struct pm_one_sided_reach {
	ptrdiff_t low, high;
};
int pm_one_sided_reaches(const struct pm_one_sided *o, struct pm_one_sided_few *few, struct pm_one_sided_reach *reach);
/* Of these particles alone, to nodes that are here; and from planes wherever they are, [components][planes], which have all that is needed. */
int pm_one_sided_spread_here(const struct pm_one_sided *o, struct pm_one_sided_few *few, int components, const double *const q[], double *const node[]);
int pm_one_sided_gather_here(const struct pm_one_sided *o, struct pm_one_sided_few *few, int components, const double *const plane[], double *const value[]);
/* pm_one_sided_spread and gather of several ranks. */
int pm_one_sided_spread_ranks(const struct pm_one_sided *o, struct pm_one_sided_few *few, int components, const double *const q[], double *const node[]);
int pm_one_sided_gather_ranks(const struct pm_one_sided *o, struct pm_one_sided_few *few, int components, const double *const mesh[], double *const value[]);

#endif
