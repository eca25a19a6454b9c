/* The columns of diag in time, for a page. SPDX-License-Identifier: GPL-3.0-or-later */
#ifndef PM_VIEWER_CURVES_H
#define PM_VIEWER_CURVES_H

#include <jansson.h>

#include "stream/frame.h"

struct pm_viewer_curves { /* zero at first */
	bool pairs;   /* the energy is summed over pairs: as in diag the first frame decides */
	json_t *rows; /* an array of numbers for each frame, by column; time and step first */
};

int pm_viewer_curves_reads(struct pm_frame *f);
int pm_viewer_curves_add(struct pm_viewer_curves *c, const struct pm_frame *f);
json_t *pm_viewer_curves_json(const struct pm_viewer_curves *c); /* {"columns": names, "rows": numbers}: the columns that have a number somewhere */
void pm_viewer_curves_free(struct pm_viewer_curves *c);

#endif
