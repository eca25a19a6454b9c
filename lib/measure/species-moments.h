/* Moments of the velocities of every set: diag --species. SPDX-License-Identifier: GPL-3.0-or-later */
#ifndef PM_MEASURE_SPECIES_MOMENTS_H
#define PM_MEASURE_SPECIES_MOMENTS_H

#include "measure/measure.h"

extern const char *const pm_moment_names[PM_MOMENTS]; /* "drift_x" ...: the column is that, _ and the set */
/* Does it exist for velocities of vdim components? */
bool pm_moment_exists(enum pm_moment k, int vdim);
/* Of one set; NAN where it has no velocities. */
void pm_moments_of(const struct pm_measured *b, double moment[PM_MOMENTS]);

#endif
