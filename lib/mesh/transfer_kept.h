/* The order of particles in one transfer, kept for the next one at the same positions: m2p finds that of p2m. Inside lib/mesh only.
 * SPDX-License-Identifier: GPL-3.0-or-later */
#ifndef PM_TRANSFER_KEPT_H
#define PM_TRANSFER_KEPT_H

#include "mesh/transfer_order.h"
#include "stream/frame.h"

struct pm_ordering {
	struct pm_note note;     /* first: it may hang on the field of the positions */
	struct pm_grid grid;     /* what the order depends on, with n and the positions */
	int width;
	unsigned char half[3];
	size_t n;
	const double *x[3];
	struct pm_axis axes[3];
	struct pm_order order;
	struct pm_strays strays;
};

/* NULL with a message. The records carry nvalues values, and have room for at least `room` doubles. */
struct pm_ordering *pm_ordering_new(const struct pm_transfer *t, const unsigned char half[3], size_t n, const double *const x[], int nvalues,
	const double *const values[], int room);
struct pm_ordering *pm_ordering_free(struct pm_ordering *o);
/* The one that hangs there, if it is that of these positions; NULL if none. */
struct pm_ordering *pm_ordering_kept(const struct pm_transfer *t, const unsigned char half[3], size_t n, const double *const x[]);
/* Leaves it there, or frees it where there is no place. */
void pm_ordering_keep(const struct pm_transfer *t, struct pm_ordering *o);

#endif
