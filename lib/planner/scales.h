/* The numbers of a frame that several effects share (effect/effect.h): scales of length, time and speed. SPDX-License-Identifier: GPL-3.0-or-later */
#ifndef PM_PLANNER_SCALES_H
#define PM_PLANNER_SCALES_H

#include "effect/effect.h"
#include "law/law.h"

enum {
	PM_SCALES_PAIRS = 4096, /* up to so many particles the nearest pair is searched for; beyond, it is that expected of a random cloud */
	PM_SCALES_FEW = 64      /* up to so many bodies their orbits are computed pair by pair */
};

/* Of the particles and what is given on meshes; time and accuracy are left to the caller, as is what needs the force. All data are held. */
int pm_scales_of(const struct pm_frame *f, const struct pm_law *law, struct pm_scales *s);
/* Of the force: the same frame with the law's change field, and on a mesh density and field, if they were made. */
int pm_scales_of_force(const struct pm_frame *f, const struct pm_law *law, struct pm_scales *s);
/* orbits.c: of few bodies. */
void pm_scales_orbits(const struct pm_frame *f, const struct pm_law *law, struct pm_scales *s);

#endif
