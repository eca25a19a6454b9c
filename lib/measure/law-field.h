/* The law's field on a mesh (g, E, u) for what is measured of it: the field that is there, or the one that was left out, made again from its potential.
 * SPDX-License-Identifier: GPL-3.0-or-later */
#ifndef PM_MEASURE_LAW_FIELD_H
#define PM_MEASURE_LAW_FIELD_H

#include "measure/measure.h"

struct pm_law_field {
	const struct pm_field *field; /* with data; NULL: there is none, and it cannot be made */
	struct pm_frame *made;        /* holds it where it was made; else NULL */
	uint64_t *from;               /* the division of a field that ranks made, else NULL */
};

/* The first mesh that has the field, or a potential beside which it was left out; else the first that has a potential. NULL: none. */
const struct pm_mesh *pm_law_field_mesh(const struct pm_measure *how, const struct pm_frame *f);
/* In declare(): the reads. */
void pm_law_field_reads(const struct pm_measure *how, struct pm_frame *f);
/* 0, or failure without memory. Cost, where it is made: one gradient. */
int pm_law_field_of(const struct pm_measure *how, const struct pm_frame *f, struct pm_law_field *e);
void pm_law_field_free(struct pm_law_field *e);

#endif
