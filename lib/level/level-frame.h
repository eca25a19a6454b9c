/* The level of a set of a frame. SPDX-License-Identifier: GPL-3.0-or-later */
#ifndef PM_LEVEL_FRAME_H
#define PM_LEVEL_FRAME_H

#include "level/level.h"
#include "level/redistance.h"

/* For declare(): *set, or if NULL the first that has the field; it needs positions and volumes, and there must be a mesh. 0 or failure. */
int pm_level_declare(struct pm_frame *f, const char **set, const char *field, const char *mesh);
int pm_level_redistance(struct pm_frame *f, const char *set, const char *field, const char *mesh, struct pm_redistance *made);
/* Sums over the sets (or one) with `level` on the first mesh, beside its field `exact_level`, else beside exact(f, x, f->time), NULL or NAN where nobody
 * knows it. NAN without. Reads are declared. */
typedef double pm_level_function(const struct pm_frame *f, const double x[], double t);
void pm_level_reads(struct pm_frame *f, const char *only);
int pm_level_of(const struct pm_frame *f, const char *only, pm_level_function *exact, struct pm_level_measures *m);
/* Is there a set with a level, volumes and a mesh to measure it on? */
bool pm_level_there(const struct pm_frame *f, const char *only);

#endif
