/* Derivatives of a mesh field of a frame, as the law or the options want them: what mgrad does. SPDX-License-Identifier: GPL-3.0-or-later */
#ifndef PM_MESH_GRADIENT_FRAME_H
#define PM_MESH_GRADIENT_FRAME_H

#include "mesh/gradient.h"

struct pm_gradient_choice {
	const char *kind, *order;    /* of the operator; NULL: the law's */
	const char *source, *target; /* fields; NULL: the law's potential and field */
	const char *mesh;            /* NULL: the first */
};

/* From the header to the data. */
struct pm_gradient {
	struct pm_operator operator;
	double factor;
	const struct pm_field *source;
	struct pm_field *target;
	const struct pm_field *density; /* of the law, where its potential is differenced beside an open face; else NULL */
};

/* Each 0 or failure. Header: */
int pm_gradient_declare(const struct pm_gradient_choice *o, struct pm_frame *f, struct pm_gradient *t);
/* Data: the transforms of a spectral operator, in plans, which is started anew where full; then the derivatives. */
int pm_gradient_plan(struct pm_gradient *t, struct pm_fft_plans *plans);
int pm_gradient_apply(struct pm_gradient *t);
/* The part of the sum of |density| on nodes less than order/2 from an open face: what is there exerts a force on itself, because a node beside it has a
 * one-sided difference. 0 where there is none, or no density in the frame. */
double pm_gradient_rim(const struct pm_gradient *t);

#endif
