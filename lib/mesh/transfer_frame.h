/* Transfers between the sets and the meshes of a frame: what p2m and m2p share.
 * SPDX-License-Identifier: GPL-3.0-or-later */
#ifndef PM_TRANSFER_FRAME_H
#define PM_TRANSFER_FRAME_H

#include "mesh/transfer.h"

/* Declares x of the set as read; fails with a sentence if it has not got dim real components. */
int pm_reads_positions(struct pm_frame *f, const char *set);
void pm_positions(const struct pm_frame *f, const char *set, const double *x[3]);

/* Declares the field `name` of the set, and its volume if the field is a value, as read. */
int pm_reads_strength(struct pm_frame *f, const char *set, const char *name);
/* q[c][n]: the field, times volume if it is a value; *made is to be freed. */
int pm_strengths(const struct pm_frame *f, const char *set, const char *name, const double *q[], double **made);

/* strength/per, particle by particle; to be freed. */
int pm_ratio(const struct pm_frame *f, const char *set, const char *strength, const char *per, double **ratio);

/* Refuses strays with a sentence that names the first, and the remedies of the tool. */
int pm_strays_refuse(const struct pm_strays *s, const char *set, const struct pm_mesh *m, const struct pm_transfer *t, const char *remedy);

/* The geometry on which every particle of the sets fits, in whole blocks of 8 cells so that a slow expansion does not change the mesh at every
 * step: 1 if it is another than m has, 0 if not, or failure. */
int pm_mesh_fit(const struct pm_frame *f, const struct pm_mesh *m, const struct pm_transfer *t, size_t nsets, const char *const *sets, size_t cells[3],
	double lo[3]);

#endif
