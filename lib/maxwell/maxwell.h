/* Methods that advance E and B on Yee's mesh: one file per method, chosen by name (docs/methods/maxwell.md).
 * SPDX-License-Identifier: GPL-3.0-or-later */
#ifndef PM_MAXWELL_H
#define PM_MAXWELL_H

#include "maxwell-parts/yee.h"

struct pm_maxwell {
	const char *name, *sentence, *source;
	int order;        /* of its differences in space; 0: derivatives of waves */
	bool spectral;    /* Gauss's law holds with derivatives of waves, not with two-point differences */
	bool any_face;    /* false: periodic boxes alone */
	int beside;       /* planes of the neighbours that a curl reads where ranks share the mesh */
	double (*limit)(const struct pm_grid *g); /* [length] the largest c dt at which every wave of the mesh stays bounded */
	void (*magnetic)(const struct pm_yee *y, double dt); /* B -= dt curl E */
	void (*electric)(const struct pm_yee *y, double dt); /* E += dt (c^2 curl B - J/eps0) */
	int (*advance)(const struct pm_yee *y, double dt); /* both through a step, instead of the two; NULL none. 0 or failure, all ranks together */
};

extern const struct pm_maxwell *const pm_maxwells[]; /* generated from lib/maxwell/, NULL ends */
extern const char *const pm_maxwell_names[];
const struct pm_maxwell *pm_maxwell_find(const char *name); /* NULL with a message */

#endif
