/* The far field of a frame's particles by direct summation, as its law and the options want it: what pp does.
 * SPDX-License-Identifier: GPL-3.0-or-later */
#ifndef PM_FAR_PP_FRAME_H
#define PM_FAR_PP_FRAME_H

#include "stream/frame.h"

struct pm_pp_choice {
	const char *mollifier;    /* NULL: the law's, else plummer */
	const char *set;          /* the only set acted on; NULL all */
	double softening;         /* [length]; NAN: the frame's constant */
	bool half;                /* each pair once */
	bool potential, replace;  /* also the potential; the term self anew */
};

/* Each 0 or failure. Header: */
int pm_pp_declare(const struct pm_pp_choice *c, struct pm_frame *f);
/* Data: the sums, added to the changes; *coincident pairs exerted nothing. */
int pm_pp_apply(const struct pm_pp_choice *c, struct pm_frame *f, uint64_t *coincident);

#endif
