/* The function that a set of particles represents, at the nodes of a mesh or the particles of another set. SPDX-License-Identifier: GPL-3.0-or-later */
#ifndef PM_NEAR_SAMPLE_FRAME_H
#define PM_NEAR_SAMPLE_FRAME_H

#include "near/sample-correction.h"
#include "near/sample.h"
#include "stream/frame.h"

struct pm_sample_choice {
	const char *set, *field;      /* sources; NULL: the first set with the field; the law's strength. A value is taken times volume */
	const char *at, *mesh, *target; /* points: a set, or the nodes of a mesh (NULL: the first); the field to make */
	const char *mollifier, *operator, *correct;
	double eps, overlap, cutoff;  /* [length]; over the spacing (mean volume)^(1/dim); in eps. NAN: overlap; the mollifier's */
	int order;
};

/* Header: 0 or failure. */
int pm_sample_declare(const struct pm_sample_choice *o, struct pm_frame *f);
struct pm_sample_found {
	double eps;  /* the width that was taken */
	size_t bare; /* points that --correct leaves */
};
/* Data. */
int pm_sample_apply(const struct pm_sample_choice *o, struct pm_frame *f, struct pm_sample_found *found);

#endif
