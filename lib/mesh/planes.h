/* The planes of a mesh on this rank (docs/distributed.md): a mesh is divided along its last axis, into planes in 3-D and rows in 2-D; in 1-D it is one. Without
 * other ranks, and of a field that is not divided, all planes are here. SPDX-License-Identifier: GPL-3.0-or-later */
#ifndef PM_MESH_PLANES_H
#define PM_MESH_PLANES_H

#include "base/in-order.h"
#include "mesh/grid.h"

PM_C_BEGIN

struct pm_planes {
	size_t points[3];   /* of the whole mesh */
	int axis;           /* along which it is divided; 0 in 1-D */
	size_t all, size;   /* planes of the mesh; points of one */
	size_t first, here; /* planes of this rank */
	bool periodic, divided;
	uint64_t *from;     /* first plane of every rank, one more than ranks; divided only */
};

/* The planes of a field on a grid. 0 or failure (memory); free in any case. */
int pm_planes_init(struct pm_planes *p, const struct pm_grid *g, const struct pm_field *field);
/* A copy that outlives them; `from` NULL: all planes of the grid. */
int pm_planes_copy(struct pm_planes *p, const struct pm_grid *g, const struct pm_planes *from);
void pm_planes_free(struct pm_planes *p);

/* pm_world_agree where ranks share the planes; without (NULL, or not divided) the status: rank 0 alone may be at work. */
int pm_planes_agree(int status, const struct pm_planes *p);

/* Copies n components with `wide` planes of the neighbours below and above; beyond the ends of an axis that is not periodic there are zeros. with[c] points
 * to the first own plane, *room is to be freed with pm_free. Takes the caller's status and returns the agreed one (world/world.h). */
int pm_planes_halo(int status, const struct pm_planes *p, int wide, int n, const double *const in[], const double *with[], double **room);

/* Lines along the divided axis: each rank gets whole columns of the planes, beginning at multiples of a row in 3-D, of 16 values in 2-D (what is transformed
 * together stays together): *lines has all planes of the mesh, of the *columns values that are this rank's. back: these to the planes of the rank, in `out`;
 * *lines is freed either way. Both take the caller's status and return the agreed one. Divided only. */
int pm_planes_turn(int status, const struct pm_planes *p, const double *in, double **lines, size_t *columns);
int pm_planes_turn_back(int status, const struct pm_planes *p, double **lines, double *out);

/* As pm_over_mesh, called by all ranks in the same order, with the values here: make() counts from the first one here, so rows of the mesh begin at
 * first * points[1] (pm_planes_row). `all` is joined to on rank 0, and is then the same on all ranks. */
int pm_planes_over(int status, const struct pm_planes *p, const struct pm_parts *parts, const void *data, void *all);
/* pm_sum_of_mesh in the same way, of the values here. */
int pm_planes_sum(int status, const struct pm_planes *p, const double *x, const double *y, const double end[3][2], struct pm_sum *all);
/* The number in the mesh of the row that value `from` here begins; its j and k are row % points[1], row / points[1]. */
static inline size_t pm_planes_row(const struct pm_planes *p, size_t from)
{
	return (p->first * p->size + from) / p->points[0];
}

PM_C_END

#endif
