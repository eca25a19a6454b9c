/* What scenes of bodies share: box and faces, the default mesh, a set with x, v, mass and id, and a centre of mass at rest.
 * SPDX-License-Identifier: GPL-3.0-or-later */
#ifndef PM_SCENE_BODIES_H
#define PM_SCENE_BODIES_H

#include "scene/scene.h"

struct pm_scene_body { /* the arrays of a set, `here` values per component: n, or with ranks that make the scene together the own stretch */
	uint64_t here, first; /* first: the number of the first value in the whole set */
	double *x[3], *v[3]; /* [length], [length/time]; v all NULL for a set that never moves */
	double *mass;        /* [mass]; NULL where all are equal */
	int64_t *id;
};

/* Gravity with G = 1 in a cube lo..hi with the same face condition on every side; dt as given. */
void pm_scene_world(struct pm_frame *f, double lo, double hi, enum pm_face face, double softening, double dt);
/* The default mesh: the same number of cells on every axis of the box. */
int pm_scene_mesh(struct pm_frame *f, size_t cells);
/* A set of n with x, mass, id, and v if it moves; mass is that of each particle, NAN if they differ and the caller fills b->mass. */
int pm_scene_set(struct pm_frame *f, const char *name, uint64_t n, bool moves, double mass, struct pm_scene_body *b);
/* Subtracts the weighted mean (equal weights if NULL) of the n values that are here and those of the other ranks; twice, so that the remaining mean is only
 * round-off. */
void pm_scene_centre(uint64_t n, const double *weight, double *a);
/* Particles per axis of a regular arrangement of n in dim dimensions; 0 with a message if n is not such a power. */
size_t pm_scene_per_axis(uint64_t n, int dim);

#endif
