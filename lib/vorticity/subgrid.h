/* Scales of a flow below its mesh, as a viscosity: what subgrid does. SPDX-License-Identifier: GPL-3.0-or-later */
#ifndef PM_VORTICITY_SUBGRID_H
#define PM_VORTICITY_SUBGRID_H

#include "mesh/gradient.h"
#include "vorticity/eddy-viscosity.h"

enum pm_subgrid_form { PM_SUBGRID_STRESS, PM_SUBGRID_CURL };
extern const char *const pm_subgrid_forms[]; /* NULL ends */

struct pm_subgrid_choice {
	const char *mesh, *order; /* NULL: the first; the law's */
	enum pm_eddy_model model;
	enum pm_subgrid_form form;
	double coefficient;       /* NAN: the published one */
	bool replace;             /* the term anew, instead of refused a second time */
};

/* From the header to the data. */
struct pm_subgrid {
	struct pm_subgrid_choice choice;
	struct pm_grid grid;
	struct pm_operator gradient, divergence, curl, curl_omega, lap;
	const struct pm_field *omega, *u;
	struct pm_field *change;
};

struct pm_subgrid_numbers {
	double mean, largest;  /* nu_t [length^2/time]; hyper: of the wave pi/D */
	double factor;         /* of D^2, as computed (dynamic: may be negative, and then nu_t is 0) */
	double dissipation;    /* -d(energy)/dt that it causes, density 1 */
};

/* Each 0 or failure. Header: the change d<density> of the law's strength. */
int pm_subgrid_declare(const struct pm_subgrid_choice *c, struct pm_frame *f, struct pm_subgrid *t);
/* Data, with the limit of the change. plans: of spectral operators, started anew where full. */
int pm_subgrid_add(struct pm_subgrid *t, struct pm_fft_plans *plans, struct pm_subgrid_numbers *numbers);

#endif
