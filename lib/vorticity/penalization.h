/* A solid body in a flow by penalization: what penalize does. SPDX-License-Identifier: GPL-3.0-or-later */
#ifndef PM_VORTICITY_PENALIZATION_H
#define PM_VORTICITY_PENALIZATION_H

#include "expression/expression.h"
#include "mesh/gradient.h"

struct pm_penalization_choice {
	const char *body;             /* expression on the mesh, a length: below 0 inside */
	const char *velocity, *stream; /* expressions with commas, dim of them; NULL: 0 */
	const char *mesh, *order;     /* NULL: the first; the law's */
	double rate;                  /* [1/time]; NAN: the flow inside is the body's after a step */
	double width;                 /* half of the layer over which the body ends, in cells */
	bool replace;                 /* the term anew, instead of refused a second time */
};

/* From the header to the data. */
struct pm_penalization {
	struct pm_grid grid;
	struct pm_operator curl;
	struct pm_expression body, velocity, stream;
	bool moves, streams;
	const struct pm_field *omega, *u;
	struct pm_field *change;
	double rate, width, dt;
};

/* Each 0 or failure. Header: the change d<density> of the law's strength. */
int pm_penalization_declare(const struct pm_penalization_choice *c, struct pm_frame *f, struct pm_penalization *p);
/* Data, with the limit of the change; force[dim]: of the fluid on the body, over the density. */
int pm_penalization_add(struct pm_penalization *p, struct pm_frame *f, struct pm_fft_plans *plans, double force[3]);

#endif
