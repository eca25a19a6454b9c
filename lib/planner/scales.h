/* The numbers of a frame that several effects share (effect/effect.h): scales of length, time and speed. SPDX-License-Identifier: GPL-3.0-or-later */
#ifndef PM_PLANNER_SCALES_H
#define PM_PLANNER_SCALES_H

#include "effect/effect.h"
#include "law/law.h"

enum {
	PM_SCALES_PAIRS = 4096, /* up to this many particles the nearest pair is searched; above, its expected distance in a random cloud is used */
	PM_SCALES_FEW = 64      /* up to this many bodies their orbits are computed pair by pair */
};

/* Scales of the particles and of fields given on meshes; the caller sets time, accuracy and those that need the force. All data must be in memory. */
int pm_scales_of(const struct pm_frame *f, const struct pm_law *law, struct pm_scales *s);
/* scales-light.c: of fields that evolve by Maxwell's equations: courant, magnetic, wiggle. 0 or failure. */
int pm_scales_light(const struct pm_frame *f, const struct pm_law *law, struct pm_scales *s);
/* Scales of the force: the same frame with the law's change field and, if they were made, density and field on a mesh. */
int pm_scales_of_force(const struct pm_frame *f, const struct pm_law *law, struct pm_scales *s);
/* sampling.c: the particles as a sample of a smooth density. 0 or failure. */
int pm_scales_sampling(const struct pm_frame *f, const struct pm_law *law, struct pm_scales *s);
/* orbits.c: for few bodies, at most PM_SCALES_FEW; their number. */
struct pm_orbit_body {
	double x[3], v[3], mass;
	bool fixed;
};
size_t pm_orbit_bodies(const struct pm_frame *f, const struct pm_law *law, struct pm_orbit_body b[PM_SCALES_FEW]);
void pm_scales_orbits(const struct pm_frame *f, const struct pm_law *law, struct pm_scales *s);

#endif
