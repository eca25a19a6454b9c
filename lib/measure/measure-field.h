/* How well a potential and its field obey their equations. SPDX-License-Identifier: GPL-3.0-or-later */
#ifndef PM_MEASURE_FIELD_H
#define PM_MEASURE_FIELD_H

#include "measure/measure.h"

/* In declare(). 0, or failure where the box of the flux is not inside the mesh. */
int pm_field_reads(const struct pm_measure *how, struct pm_frame *f);
/* Is there a mesh with density and potential? */
bool pm_field_known(const struct pm_measure *how, const struct pm_frame *f);
/* In the order of enum pm_field_column; NAN without potential and density on a mesh. 0, or failure without memory. */
int pm_field_of(const struct pm_measure *how, const struct pm_frame *f, double value[PM_FIELD_COLUMNS]);

#endif
