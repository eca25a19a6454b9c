/* The far field of a frame's particles by direct summation, as its law and the options want it: what pp does.
 * SPDX-License-Identifier: GPL-3.0-or-later */
#ifndef PM_FAR_PP_FRAME_H
#define PM_FAR_PP_FRAME_H

#include "stream/frame.h"

struct pm_pp_choice {
	const char *mollifier;    /* NULL: the law's, else plummer */
	const char *set;          /* the only set acted on; NULL all */
	double softening;         /* [length]; NAN: the frame's constant */
	double spreading;         /* [time] when the softening of vortices was this one; its square grows by 4 nu a time. NAN: it stays */
	double overlap;           /* of vector strengths without either: the core over their spacing (mean volume)^(1/3) */
	int form;                 /* of vector strengths: enum pm_pp_form */
	bool half;                /* each pair once; of scalar strengths */
	bool potential, replace;  /* also the potential; the term self anew */
};

/* The periodic axis of a plane that is open along the other, whose images pp sums; -1: none. */
int pm_pp_periodic_axis(const struct pm_frame *f);
/* Each 0 or failure. Header: */
int pm_pp_declare(const struct pm_pp_choice *c, struct pm_frame *f);
struct pm_pp_done {
	uint64_t coincident; /* pairs that exerted nothing */
	double core;         /* [length] that followed from the overlap; 0: none did */
};
/* Data: the sums, added to the changes. */
int pm_pp_apply(const struct pm_pp_choice *c, struct pm_frame *f, struct pm_pp_done *done);

#endif
