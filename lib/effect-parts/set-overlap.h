/* How completely the particles of a set cover the mesh around each of them (remesh/distortion.h). SPDX-License-Identifier: GPL-3.0-or-later */
#ifndef PM_SET_OVERLAP_H
#define PM_SET_OVERLAP_H

#include "stream/frame.h"

/* H has an entry per particle of the set; without volumes each particle has that of a cell. 0 or failure. */
int pm_set_overlap(const struct pm_frame *f, const char *set, const struct pm_mesh *m, double *H);

#endif
