/* Changes on a mesh (domega) carried over to the particles (dcirculation), the second half of m2p.
 * SPDX-License-Identifier: GPL-3.0-or-later */
#ifndef PM_TRANSFER_MESH_CHANGES_H
#define PM_TRANSFER_MESH_CHANGES_H

#include "transfer/transfer-frame.h"

enum { PM_MESH_CHANGES = 8 };

/* What is to be carried, its values ready to be gathered. */
struct pm_mesh_changes {
	int n;
	struct pm_field *change[PM_MESH_CHANGES];
	double lost[PM_MESH_CHANGES][3]; /* per time: the part of the change of a strength that no particle receives, by component (at most 3) */
	double *share[PM_MESH_CHANGES]; /* [components][points] change divided by the particle volume at the point; NULL: the change itself */
};

/* c is a change field of the mesh that names a state of the set. */
bool pm_mesh_change_concerns(const struct pm_frame *f, const char *set, const struct pm_mesh *m, const struct pm_field *c);
/* For declare(): every change field of the mesh that names a state of the set in `of` adds its terms to the set's change field d<state>; onto a
 * strength it counts times volume, which is then read. */
int pm_mesh_changes_declare(struct pm_frame *f, const char *set, const struct pm_mesh *m, bool replace);
/* The data: the changes of the mesh that concern one of the sets, shared among the particles of all of them with t's kernel. Free in any case. */
int pm_mesh_changes_init(struct pm_mesh_changes *c, const struct pm_frame *f, const struct pm_sets *sets, const struct pm_mesh *m, const struct pm_transfer *t);
void pm_mesh_changes_free(struct pm_mesh_changes *c);
/* Puts the components to be carried to a set behind those of a gather; t takes their number, offsets and images. */
int pm_mesh_changes_append(const struct pm_mesh_changes *c, const struct pm_frame *f, const char *set, struct pm_transfer *t, const double *mesh[PM_COMPONENTS],
	const double *factor[PM_COMPONENTS], double *out[PM_COMPONENTS]);

#endif
