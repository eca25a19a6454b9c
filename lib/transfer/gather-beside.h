/* Values gathered beside bodies and faces by one-sided kernels, for gather-frame.c. Private to lib/transfer. SPDX-License-Identifier: GPL-3.0-or-later */
#ifndef PM_TRANSFER_GATHER_BESIDE_H
#define PM_TRANSFER_GATHER_BESIDE_H

#include "transfer/gather-frame.h"
#include "transfer/one-sided.h"
#include "transfer/transfer-columns.h"

/* The fields gathered to one set. */
struct pm_gather_arrays {
	struct pm_transfer t;
	const double *x[3], *mesh[PM_COMPONENTS], *factor[PM_COMPONENTS];
	double *out[PM_COMPONENTS];
	bool columns; /* these are in place of x, factor and out */
	struct pm_column at[3], times[PM_COMPONENTS];
	struct pm_target to[PM_COMPONENTS];
	size_t n;
	const struct pm_field *on_nodes; /* NULL, or the positions, which are all on nodes */
	bool magnetic; /* the components of an evolving B are among them, behind those of E */
	bool finite;   /* of a field that is a state: all that was gathered */
};

/* Particles beside bodies and faces: who they are, and what their targets held. */
struct pm_gather_beside {
	struct pm_one_sided o;
	struct pm_one_sided_few few;
	double *values; /* [2][components][few.count]: before; gathered */
};

/* Each 0 or failure: before the gather of all, and after it, where their values are computed anew (x: positions of the set; all ranks). Free in any
 * case. */
int pm_gather_beside_find(const struct pm_gather_job *j, const struct pm_gather_arrays *a, struct pm_gather_beside *b);
int pm_gather_beside(const struct pm_gather_job *j, const struct pm_gather_arrays *a, const struct pm_field *x, struct pm_gather_beside *b);
void pm_gather_beside_free(struct pm_gather_beside *b);

#endif
