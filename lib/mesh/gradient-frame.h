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
 * one-sided difference. 0 where there is none, or no density in the frame. 0 or failure, agreed by all ranks. */
int pm_gradient_rim(const struct pm_gradient *t, double *part);

/* A law's field that mgrad made of the law's potential has the order of its differences in its header (PM_DIFFERENCES). So it can be made again from the
 * potential, to the last bit, and need not be stored. */
/* The order, as typed; NULL: unknown. Of a potential: that of the field that was left out beside it. */
const char *pm_gradient_order_of(const struct pm_field *p);
bool pm_gradient_repeats(const struct pm_frame *f, const struct pm_field *p); /* is it such a field, with its potential beside it? */
void pm_gradient_leave_out(struct pm_frame *f, struct pm_field *p);           /* drops such a field; its order goes to the potential */

#endif
