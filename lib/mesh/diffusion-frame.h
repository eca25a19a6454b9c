/* Viscosity on the mesh of a frame, d(density)/dt += div(nu grad density): what diffuse does. SPDX-License-Identifier: GPL-3.0-or-later */
#ifndef PM_MESH_DIFFUSION_FRAME_H
#define PM_MESH_DIFFUSION_FRAME_H

#include "mesh/gradient.h"

struct pm_diffusion_choice {
	const char *mesh, *order; /* NULL: the first; the law's */
	const char *field;        /* NULL: the law's density; a strength or value of particles, deposited under this name */
	double nu[3];             /* along each axis [length^2/time]; where it varies 1 */
	bool replace;             /* the term anew, instead of refused a second time */
};

/* From the header to the data. */
struct pm_diffusion {
	struct pm_operator operator, even; /* even: of nu itself, whose images are even */
	const struct pm_field *density;
	struct pm_field *change;
	double nu[3];
};

/* Each 0 or failure. Header: the change field d<density> of the law's strength, or of the field. */
int pm_diffusion_declare(const struct pm_diffusion_choice *c, struct pm_frame *f, struct pm_diffusion *t);
/* Data, with the limit of the change, which *decay is [1/time]. varies: NULL, or nu at the points here; least and most of all.
 * plans: of spectral operators, started anew where full. */
struct pm_diffusion_nu {
	const double *at;
	double least, most;
};
int pm_diffusion_add(struct pm_diffusion *t, const struct pm_diffusion_nu *varies, struct pm_fft_plans *plans, double *decay);

#endif
