/* The limits (stream/limits.h) of what m2p adds to the sets. SPDX-License-Identifier: GPL-3.0-or-later */
#ifndef PM_TRANSFER_GATHER_LIMITS_H
#define PM_TRANSFER_GATHER_LIMITS_H

#include "transfer/gather-frame.h"

/* Header: reads the strengths of all sets that the limits of the law's change depend on. 0 or failure. */
int pm_gather_limits_declare(const struct pm_gather_job *j, struct pm_frame *f);
/* Data: what all sets have in common. */
void pm_gather_limits_prepare(struct pm_gather_job *j, const struct pm_frame *f);
/* Largest |change| of a set, before and after the gather. */
double pm_gather_limits_most(const struct pm_gather_job *j, const struct pm_frame *f, const char *set);
/* Adds the limits to the change of a set, whose largest value was `before`; most: the largest |change|^2 now, or 0: to be looked for. */
void pm_gather_limits_add(const struct pm_gather_job *j, struct pm_frame *f, const char *set, double before, double most);

#endif
