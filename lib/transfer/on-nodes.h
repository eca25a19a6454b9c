/* Particles that all stand on nodes of a mesh, as remesh leaves them, inside its faces: a kernel that interpolates takes from each its node alone, so spread
 * and gather are copies. For lib/transfer and lib/remesh. SPDX-License-Identifier: GPL-3.0-or-later */
#ifndef PM_TRANSFER_ON_NODES_H
#define PM_TRANSFER_ON_NODES_H

#include "transfer/transfer-columns.h"

/* x is that of the frame; what it has been asked once is the same for any number of threads and ranks, which all call. *on: every particle stands on a node,
 * each behind the one before in the order of the mesh, the kernel interpolates, and no component is staggered. 0 or failure. */
int pm_on_nodes(const struct pm_transfer *t, const struct pm_field *x, bool *on);
/* x was made as nodes of a periodic mesh, in its order, by lo + i h: this is remembered, where it would be found. */
void pm_on_nodes_keep(const struct pm_grid *g, const struct pm_field *x);
/* pm_spread_columns and pm_gather_columns of such particles. replaces: there are as many as nodes, and the values of the mesh are not added to. */
int pm_on_nodes_spread(const struct pm_transfer *t, const struct pm_field *x, const struct pm_column strength[], bool replaces, double *const mesh[]);
int pm_on_nodes_gather(const struct pm_transfer *t, const struct pm_field *x, const double *const mesh[], const struct pm_column factor[],
	const struct pm_target out[], struct pm_strays *strays);
/* The same of particles in a periodic box, times one factor, to who takes m <= PM_ON_NODES_FEW of the stream from p on at a time, value[components][m], and may
 * change them and their positions. By threads. */
enum { PM_ON_NODES_FEW = 488 }; /* less than a page: rows a page apart are in each other's way in the cache */
typedef void pm_on_nodes_few(void *data, size_t p, size_t m, double *const value[]);
int pm_on_nodes_pass(const struct pm_transfer *t, const struct pm_field *x, const double *const mesh[], double factor, pm_on_nodes_few *few, void *data);

#endif
