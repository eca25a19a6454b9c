/* Kernels beside bodies and faces: the weights of a particle on the nodes that may be used alone (docs/methods/remesh.md, Bodies).
 * SPDX-License-Identifier: GPL-3.0-or-later */
#ifndef PM_TRANSFER_ONE_SIDED_H
#define PM_TRANSFER_ONE_SIDED_H

#include "kernel/kernel.h"
#include "mesh/grid.h"

enum { PM_ONE_SIDED_DEGREE = 4 }; /* the most of its moments that are kept */

struct pm_one_sided {
	struct pm_grid grid;
	const struct pm_kernel *kernel;
	const unsigned char *mask; /* [points] 1: inside a body, not used; NULL: none */
};

/* The weights of one particle. */
struct pm_one_sided_share {
	size_t n, room;
	size_t *node; /* [n] of the mesh */
	double *w;    /* [n] add to 1 */
	int degree;   /* of the polynomials for which they are exact; 0: the nearest nodes by a window */
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
 * number of threads. 0 or failure. */
int pm_one_sided_spread(const struct pm_one_sided *o, struct pm_one_sided_few *few, int components, const double *const q[], double *const node[]);
int pm_one_sided_gather(const struct pm_one_sided *o, struct pm_one_sided_few *few, int components, const double *const mesh[], double *const value[]);

#endif
