/* Which energies of a frame are known: those of the law's own field, smoothed as the words smoothed it. SPDX-License-Identifier: GPL-3.0-or-later */
#ifndef PM_MEASURE_KNOWN_ENERGY_H
#define PM_MEASURE_KNOWN_ENERGY_H

#include "law/law.h"
#include "measure/measure.h"

/* Sets softening, pair (if pairs are to be summed) and unknown of *how, whose set and strength are known. */
void pm_known_energy(const struct pm_frame *f, const struct pm_law *law, bool pairs, struct pm_measure *how);

#endif
