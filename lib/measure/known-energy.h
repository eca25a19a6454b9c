/* Which energies of a frame are known: those of the law's own field, smoothed as the words smoothed it. SPDX-License-Identifier: GPL-3.0-or-later */
#ifndef PM_MEASURE_KNOWN_ENERGY_H
#define PM_MEASURE_KNOWN_ENERGY_H

#include "law/law.h"
#include "measure/measure.h"

/* Sets softening, pair (if pairs are to be summed) and unknown of *how, whose set and strength are known. */
void pm_known_energy(const struct pm_frame *f, const struct pm_law *law, bool pairs, struct pm_measure *how);
enum { PM_PAIRS_UNASKED = 4096 }; /* particles; 8.4e6 pairs, 43 ms on one core */
enum pm_pairs { PM_PAIRS_NO, PM_PAIRS_SUM, PM_PAIRS_MANY };
/* Are pairs summed though nobody asked, where neither mesh nor particles hold the potential: in open space, and of so many at most. If not, why is a
 * reason and a remedy; "" if the energy does not need them, or its reason is known already. */
enum pm_pairs pm_pairs_unasked(const struct pm_frame *f, const struct pm_law *law, const struct pm_measure *how, char why[200]);

#endif
