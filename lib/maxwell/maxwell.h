/* Methods that advance E and B on Yee's mesh: one file per method, chosen by name (docs/methods/maxwell.md).
 * SPDX-License-Identifier: GPL-3.0-or-later */
#ifndef PM_MAXWELL_H
#define PM_MAXWELL_H

#include "maxwell-parts/yee.h"

struct pm_maxwell {
	const char *name, *sentence, *source;
	int order;        /* of its differences in space */
	bool any_face;    /* false: periodic boxes alone */
	double (*limit)(const struct pm_grid *g); /* [length] the largest c dt at which every wave of the mesh stays bounded */
	void (*magnetic)(const struct pm_yee *y, double dt); /* B -= dt curl E */
	void (*electric)(const struct pm_yee *y, double dt); /* E += dt (c^2 curl B - J/eps0) */
};

extern const struct pm_maxwell *const pm_maxwells[]; /* generated from lib/maxwell/, NULL ends */
extern const char *const pm_maxwell_names[];
const struct pm_maxwell *pm_maxwell_find(const char *name); /* NULL with a message */

#endif
