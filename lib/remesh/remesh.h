/* Particles back onto the nodes of a mesh (docs/methods/remesh.md): the strength of each node, and the nodes that become particles.
 * SPDX-License-Identifier: GPL-3.0-or-later */
#ifndef PM_REMESH_H
#define PM_REMESH_H

#include "mesh/planes.h"
#include "transfer/transfer.h"

enum { PM_REMESH_VALUES = 32 };

struct pm_remesh {
	struct pm_grid grid;            /* walls count as neumann faces: strength beyond a face is folded back */
	const struct pm_kernel *kernel;
	const struct pm_planes *planes; /* NULL, or those of this rank, with a part of the particles: points, node and keep are these alone, all ranks call */
	size_t points;
	int n;                          /* values per node, every component of every strength added so far */
	double *node[PM_REMESH_VALUES]; /* [points] the strength of each node, not its density */
	double least[PM_REMESH_VALUES], most[PM_REMESH_VALUES]; /* absolute values of each on the nodes here */
	int field[PM_REMESH_VALUES];    /* the first value of the strength this one is a component of; -1: does not decide which nodes are kept */
	const unsigned char *mask;      /* NULL, or [points of the whole mesh] 1: in a body, where no particle is made and beside which kernels are one-sided */
	unsigned char *keep;            /* [points] does the node become a particle? */
	size_t *before;                 /* kept nodes before each row of nodes */
	size_t kept;                    /* nodes here that become particles */
	uint64_t cut;                   /* nodes of the mesh that are not 0 and do not */
	double lost[PM_REMESH_VALUES];  /* sum of each value over the nodes cut */
};

/* Cells that particles keep from an open face so that they can move before the kernel reaches it. */
size_t pm_remesh_room(const struct pm_kernel *k);
struct pm_remesh pm_remesh_on(const struct pm_grid *g, const struct pm_kernel *k);
void pm_remesh_share(struct pm_remesh *r, const struct pm_planes *planes); /* before anything is added: with other ranks */
/* Shares a strength q[components][n] of particles at x[d][n] among the nodes; decides: a node where it is not 0 becomes a particle. strays as
 * in pm_spread. 0 or failure. */
int pm_remesh_add(struct pm_remesh *r, size_t n, const double *const x[], int components, const double *const q[], bool decides,
	struct pm_strays *strays);
/* Keeps the nodes where a deciding strength exceeds cut_off times its largest absolute value over the nodes (cut_off 0: is not 0), and
 * those within `rim` cells of them, empty ones too, except near open faces. 0 or failure (memory). */
int pm_remesh_keep(struct pm_remesh *r, double cut_off, int rim);
/* Of the nodes kept here, in the order of the mesh: value i, positions along axis d, volume (of the cell, half at the end of an axis). */
void pm_remesh_value(const struct pm_remesh *r, int i, double *out);
void pm_remesh_position(const struct pm_remesh *r, int d, double *x);
void pm_remesh_volume(const struct pm_remesh *r, double *volume);
bool pm_remesh_is_finite(const struct pm_remesh *r); /* are all positions and volumes? */
double pm_remesh_total(const struct pm_remesh *r, int i); /* the sum of value i over all nodes */
void pm_remesh_free(struct pm_remesh *r);

#endif
