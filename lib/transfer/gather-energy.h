/* The force that conserves energy: the potential of the mesh gathered with the gradient of the kernel. For m2p --energy-conserving.
 * SPDX-License-Identifier: GPL-3.0-or-later */
#ifndef PM_TRANSFER_GATHER_ENERGY_H
#define PM_TRANSFER_GATHER_ENERGY_H

#include "transfer/gather-frame.h"

/* Is it the force of a potential? E and B of Maxwell's equations are gathered as fields, with lower kernels. */
bool pm_gather_by_potential(const struct pm_gather_choice *choice, const struct pm_frame *f);
/* Header: the law's change of every set that it moves, from its potential. 0 or failure. */
int pm_gather_energy_choose(const struct pm_gather_choice *choice, const struct pm_frame *f, struct pm_gather_job *j);
int pm_gather_energy_declare(const struct pm_gather_job *j, struct pm_frame *f);
/* Data. */
int pm_gather_energy(struct pm_gather_job *j, struct pm_frame *f);

#endif
