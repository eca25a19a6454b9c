/* Particles that all stand on nodes of a mesh, as remesh leaves them, inside its faces: a kernel that interpolates takes from each its node alone, so spread
 * and gather are copies. Private to lib/transfer. SPDX-License-Identifier: GPL-3.0-or-later */
#ifndef PM_TRANSFER_ON_NODES_H
#define PM_TRANSFER_ON_NODES_H

#include "transfer/transfer-columns.h"

/* x is that of the frame; what it has been asked once is the same for any number of threads and ranks, which all call. *on: every particle stands on a node,
 * each behind the one before in the order of the mesh, the kernel interpolates, and no component is staggered. 0 or failure. */
int pm_on_nodes(const struct pm_transfer *t, const struct pm_field *x, bool *on);
/* pm_spread_columns and pm_gather_columns of such particles. */
int pm_on_nodes_spread(const struct pm_transfer *t, const struct pm_field *x, const struct pm_column strength[], double *const mesh[]);
int pm_on_nodes_gather(const struct pm_transfer *t, const struct pm_field *x, const double *const mesh[], const struct pm_column factor[],
	const struct pm_target out[], struct pm_strays *strays);

#endif
