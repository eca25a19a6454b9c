/* Particle strength exchange of a set of a frame, or its corrected form: its width, the fields it needs, its change field.
 * SPDX-License-Identifier: GPL-3.0-or-later */
#ifndef PM_NEAR_PSE_FRAME_H
#define PM_NEAR_PSE_FRAME_H

#include "near/dcpse.h"
#include "near/pse.h"

struct pm_pse_set {
	const char *set, *field; /* what is diffused: a strength, or a value of particles with volumes */
	double nu;               /* [length^2/time]; along the axis of the least, of the particles the largest */
	double axis[3];          /* nu along each axis over that, at least 1 */
	const double *share;     /* NULL, or nu of each particle here over nu, from 0 to 1 */
	bool corrected;          /* dcpse.h; else pse.h */
	int order;
	double eps;              /* [length], along the axis of the least nu; NAN: overlap times the spacing of the particles */
	double overlap;          /* eps over that spacing, (mean volume)^(1/dim) */
	double cutoff;           /* in eps; NAN: that of the order */
	bool images;             /* mirror images at walls */
};

/* Declares what is read and the change field d<field>, which takes the term diffusion. */
int pm_pse_plan(struct pm_frame *f, const struct pm_pse_set *s, bool replace);
/* Adds the exchange to the change field and its fastest decay; s->eps and s->cutoff hold what was taken. Does nothing if there are no particles. */
int pm_pse_apply(struct pm_frame *f, struct pm_pse_set *s, struct pm_pse_found *found);
/* Of what pm_pse_apply has found: does the overlap say that the points are no lattice? */
bool pm_pse_distorted(const struct pm_pse_set *p, int dim, const struct pm_pse_found *found);

#endif
