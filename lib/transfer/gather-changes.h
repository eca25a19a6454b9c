/* m2p of the changes on a mesh alone (dheat of diffuse), without a field of the law: for laws that have none, and m2p --changes.
 * SPDX-License-Identifier: GPL-3.0-or-later */
#ifndef PM_TRANSFER_GATHER_CHANGES_H
#define PM_TRANSFER_GATHER_CHANGES_H

#include "transfer/gather-frame.h"

/* Each 0 or failure. Header: the mesh, the sets with a state that one of its changes names, their change fields. */
int pm_gather_changes_declare(const struct pm_gather_choice *choice, struct pm_frame *f);
/* Data: carried, particles beyond an open mesh left out and counted if the choice says drop, else refused. Free *carry in any case. */
int pm_gather_changes(const struct pm_gather_choice *choice, struct pm_frame *f, struct pm_mesh_changes *carry, uint64_t *dropped);

#endif
