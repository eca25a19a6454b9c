/* Scales, rotates, shifts and boosts the particles of a frame's sets; used by smove. SPDX-License-Identifier: GPL-3.0-or-later */
#ifndef PM_MESH_SET_MOTION_H
#define PM_MESH_SET_MOTION_H

#include "mesh/rigid-motion.h"

enum { PM_MOTION_FACTORS = 32 };

struct pm_set_motion {
	const char *const *set; /* the sets that take part */
	int nsets;              /* 0: all */
	struct pm_factor {
		char field[PM_NAME]; /* "box": the box and its meshes, about the origin */
		double by;
	} factor[PM_MOTION_FACTORS];
	int nfactors;
	struct pm_turn turn;          /* of x and v */
	const double *shift, *boost;  /* [length], [length/time], one number a component */
	int nshift, nboost;           /* 0: none */
	struct pm_motion_job *job;    /* the fields to change, from declare to frame */
	size_t njobs, room;
};

/* Header: checks that the frame has the sets and fields named, with the right number of components. 0 or failure. */
int pm_set_motion_check(const struct pm_set_motion *m, const struct pm_frame *f);
/* Header: stretches the box, scales uniform fields, marks the others as changed. *touched is set if there is anything to do. 0 or failure. */
int pm_set_motion_declare(struct pm_set_motion *m, struct pm_frame *f, bool *touched);
/* Data: factors, then rotation, shift and boost; positions are wrapped on periodic axes. */
void pm_set_motion_apply(const struct pm_set_motion *m, const struct pm_frame *f);
void pm_set_motion_clear(struct pm_set_motion *m);

#endif
