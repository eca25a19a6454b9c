/* Changes on a mesh (domega) carried over to the particles (dcirculation), the second half of m2p.
 * SPDX-License-Identifier: GPL-3.0-or-later */
#ifndef PM_CARRY_H
#define PM_CARRY_H

#include "mesh/transfer.h"

/* For plan: every change field of the mesh that names a state of the set in `of` adds its terms to the set's change field d<state>; onto a
 * strength it counts times volume, which is then read. */
int pm_carry_plan(struct pm_frame *f, const char *set, const struct pm_mesh *m, bool replace);
/* The data; kernel NULL: the one the field was made with, else t's. Strays take no part (they are those of the gather before). */
int pm_carry(struct pm_frame *f, const char *set, const struct pm_mesh *m, const struct pm_kernel *kernel, const struct pm_transfer *t);

#endif
