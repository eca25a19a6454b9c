/* The energy-conserving semi-implicit step of the field of charges on a periodic line. SPDX-License-Identifier: GPL-3.0-or-later */
#ifndef PM_ECSIM_H
#define PM_ECSIM_H

#include "stream/frame.h"

struct pm_ecsim {
	const char *mesh; /* NULL: the first */
	bool gauss;       /* E is made of the charge; nothing advances */
};

/* The report of a step: max |div E - rho/eps0| over max |rho/eps0| before E is made of the charge; the energy eps0/2 E^2 at the end of a step. */
struct pm_ecsim_record {
	double residual, energy;
};

/* Header. 1: it acts in this frame, 0: with gauss inside a step, or this half of the step is not its place; or failure. */
int pm_ecsim_declare(const struct pm_ecsim *c, struct pm_frame *f);
/* Data. 0 or failure. */
int pm_ecsim_step(const struct pm_ecsim *c, struct pm_frame *f, struct pm_ecsim_record *r);

#endif
