/* A magnetic field given on a mesh, interpolated to the particles; the third part of m2p. SPDX-License-Identifier: GPL-3.0-or-later */
#ifndef PM_TRANSFER_MAGNETIC_FIELD_H
#define PM_TRANSFER_MAGNETIC_FIELD_H

#include "transfer/gather-beside.h"

/* For declare(): the set's change field bfield gets the term external from the field `name` of the mesh, of 3 components; nothing if it is not there. */
int pm_bfield_plan(struct pm_frame *f, const char *set, const struct pm_mesh *m, const char *name, bool replace);
/* Of a magnetic field that evolves by Maxwell's equations and is not one everywhere: its components are added to those of a gather of E, which sits on the
 * same mesh at other offsets; false: pm_bfield does it. */
bool pm_bfield_append(struct pm_frame *f, const char *set, const struct pm_mesh *m, const char *name, struct pm_gather_arrays *a);
bool pm_bfield_sets(const struct pm_frame *f, const struct pm_mesh *m, const char *name); /* declare(): that gather writes every value of a new bfield */
/* The data; a uniform field is added without interpolation. Strays are left out (those of the gather before). */
int pm_bfield(struct pm_frame *f, const char *set, const struct pm_mesh *m, const char *name, const struct pm_transfer *t);

#endif
