/* The nodes of a mesh for which an expression is not 0, as bytes: bodies (remesh --mask, m2p --mask). SPDX-License-Identifier: GPL-3.0-or-later */
#ifndef PM_EXPRESSION_MESH_MASK_H
#define PM_EXPRESSION_MESH_MASK_H

#include "expression/expression.h"

/* Header: the expression in x, y, z, time and states of the mesh is understood. Data: (*mask)[nodes], to be freed; shared: all ranks call, each evaluates its
 * nodes and has all of the mask. Each 0 or failure. */
int pm_mesh_mask_declare(struct pm_frame *f, const struct pm_mesh *m, const char *text);
int pm_mesh_mask(struct pm_frame *f, const struct pm_mesh *m, const char *text, bool shared, unsigned char **mask);

#endif
