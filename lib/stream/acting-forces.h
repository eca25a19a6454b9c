/* What moved a set: the terms of its acceleration, and how its sum over pairs was smoothed. Energies need both. While the change field exists they are in
 * its header (terms; the keys softening and mollifier where they are not the frame's and the law's). push, which uses the change up, writes them to the
 * tail's report as forces: {"SET/CHANGE": {terms, softening, mollifier}}, except where it is the term self alone with the frame's smoothing.
 * SPDX-License-Identifier: GPL-3.0-or-later */
#ifndef PM_STREAM_ACTING_FORCES_H
#define PM_STREAM_ACTING_FORCES_H

#include "stream/frame.h"

struct pm_acting {
	double softening;      /* [length]; NAN: the frame's */
	const char *mollifier; /* NULL: the law's */
	const char *other;     /* a term that is not the law's own field; NULL none */
};

/* The smoothing of the sum over pairs behind a change field; NAN and NULL as above. */
void pm_acting_smooth(struct pm_field *change, double softening, const char *mollifier);
/* push: this change of the set was used. */
void pm_acting_note(struct pm_frame *f, const struct pm_field *change);
void pm_acting_forget(struct pm_frame *f); /* a new run */
/* The texts belong to the frame. */
struct pm_acting pm_acting_on(const struct pm_frame *f, const char *set, const char *change);

#endif
