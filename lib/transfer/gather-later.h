/* The gather of E and B that is left to be made (stream/later.h), where a pass over the particles can make it a few at a time: they stay in the stream of a
 * periodic box, and have one charge and mass. SPDX-License-Identifier: GPL-3.0-or-later */
#ifndef PM_TRANSFER_GATHER_LATER_H
#define PM_TRANSFER_GATHER_LATER_H

#include "transfer/gather-frame.h"
#include "transfer/gather-beside.h"

/* What acc and bfield of a set have in common. */
struct pm_gather_left {
	int users;
	struct pm_transfer t;       /* of six components, E and B */
	size_t n;
	struct pm_column x[3];
	const double *mesh[6];
	double factor;              /* of E */
	double rate;                /* |charge/mass| */
	double most[2];             /* the largest |E|, |B| on the mesh */
	struct pm_field *held[3];   /* x, E, B, as they are */
	double *waits;              /* the values of one, since the other was made; NULL */
};

/* In frame(): leaves acc and bfield of a set, which a[] gathers of E and B, to be made; *left false: it does not. 0 or failure. */
int pm_gather_leave(const struct pm_gather_job *j, struct pm_frame *f, const char *set, const struct pm_gather_arrays *a, bool *left);
/* NULL: they are not left so, or not both of the same. */
const struct pm_gather_left *pm_gather_left_of(const struct pm_field *acc, const struct pm_field *bfield);

#endif
