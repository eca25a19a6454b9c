/* Derivatives of a field of particles at the particles: what pgrad does. SPDX-License-Identifier: GPL-3.0-or-later */
#ifndef PM_NEAR_DERIVATIVE_FRAME_H
#define PM_NEAR_DERIVATIVE_FRAME_H

#include "near/dcpse.h"
#include "near/derivative.h"

struct pm_derivative_choice {
	const char *set, *field, *target; /* set NULL: the first with the field */
	const char *derivative;           /* "grad", "lap", or the power of each axis, "2,1" */
	bool corrected, plus, images;     /* dcpse.h, else derivative.h; mirror images at walls */
	int order, side;                  /* side: -1 below, +1 above, 0 both */
	double eps, overlap, cutoff;      /* [length]; over the spacing (mean volume)^(1/dim); in eps. NAN: overlap; that of the order */
};

struct pm_derivative_took {
	double eps, cutoff; /* [length]; in eps */
	uint64_t widened;   /* corrected: particles that needed partners from beyond the cut-off */
};

/* Header: the derived field target, of as many components as the field, or dim of a gradient. Each 0 or failure. */
int pm_derivative_declare(const struct pm_derivative_choice *o, struct pm_frame *f);
int pm_derivative_apply(const struct pm_derivative_choice *o, struct pm_frame *f, struct pm_derivative_took *took);

#endif
