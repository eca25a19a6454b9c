/* Changes on a mesh (domega) carried over to the particles (dcirculation), the second half of m2p.
 * SPDX-License-Identifier: GPL-3.0-or-later */
#ifndef PM_CARRY_H
#define PM_CARRY_H

#include "mesh/transfer_frame.h"

enum { PM_CARRIED = 8 };

/* What is to be carried, its values ready to be gathered. */
struct pm_carry {
	int n;
	struct pm_field *change[PM_CARRIED];
	double lost[PM_CARRIED][3]; /* per time: what of the change of a strength goes to no particle, by component (3 at most) */
	double *share[PM_CARRIED]; /* [components][points] change over the volume that the particles bring to the point; NULL: the change itself */
};

/* For plan: every change field of the mesh that names a state of the set in `of` adds its terms to the set's change field d<state>; onto a
 * strength it counts times volume, which is then read. */
int pm_carry_plan(struct pm_frame *f, const char *set, const struct pm_mesh *m, bool replace);
/* The data: the changes of the mesh that concern one of the sets, shared among the particles of all of them with t's kernel. Free in any case. */
int pm_carry_init(struct pm_carry *c, const struct pm_frame *f, const struct pm_sets *sets, const struct pm_mesh *m, const struct pm_transfer *t);
void pm_carry_free(struct pm_carry *c);
/* Puts the components to be carried to a set behind those of a gather; t takes their number, offsets and images. */
int pm_carry_append(const struct pm_carry *c, const struct pm_frame *f, const char *set, struct pm_transfer *t, const double *mesh[PM_COMPONENTS],
	const double *factor[PM_COMPONENTS], double *out[PM_COMPONENTS]);

#endif
