/* Walls and neumann faces on which a mesh field was given other values than 0 (docs/methods/boundary-values.md): images beyond them would be wrong, so mgrad
 * takes one-sided differences there and m2p kernels that need no image. In the header of the field, key `given_faces`: ["x-low", ...].
 * SPDX-License-Identifier: GPL-3.0-or-later */
#ifndef PM_MESH_GIVEN_FACES_H
#define PM_MESH_GIVEN_FACES_H

#include "mesh/grid.h"

extern const char *const pm_face_places[3][2]; /* x-low, x-high, ... */
void pm_given_face_mark(struct pm_field *p, int d, int side);
bool pm_given_face(const struct pm_field *p, int d, int side);
void pm_given_faces_copy(struct pm_field *to, const struct pm_field *from);
/* Marked faces become open: nothing is known beyond them. */
void pm_given_faces_open(const struct pm_field *p, struct pm_grid *g);

#endif
