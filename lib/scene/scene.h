/* Scenes: the particles, the law, the box, the default mesh and step of a physical situation. One file per scene.
 * SPDX-License-Identifier: GPL-3.0-or-later */
#ifndef PM_SCENE_H
#define PM_SCENE_H

#include "stream/frame.h"

enum { PM_SCENE_PARAMETERS = 16 };

struct pm_scene_parameter {
	const char *name, *unit; /* the same word means the same in every scene */
	double otherwise;        /* default */
	double low, high;        /* inclusive; both 0: any */
	const char *text;
};

struct pm_scene_choice { /* what pinit was asked for, defaults filled in */
	int dim;
	uint64_t n, seed;
	double value[PM_SCENE_PARAMETERS]; /* in the order of the rows */
	bool has_cells, has_box, has_dt;   /* typed by the user; pinit applies them after make, on top of the scene's own */
};

struct pm_scene {
	const char *name, *sentence, *source;
	unsigned dims;           /* bit 1u<<dim for each dimension it exists in */
	int dim;                 /* default */
	uint64_t n;              /* default; 0: the scene decides */
	const struct pm_scene_parameter *parameters; /* {0} ends */
	/* Makes the frame: attributes, sets, fields (with data: pm_makes, pm_frame_ready, pm_out), a default mesh, dt. 0 or failure. */
	int (*make)(const struct pm_scene_choice *c, struct pm_frame *f);
	/* Exact numbers a test or diag can ask for, by name (see the scene's head); NAN if it has none of that name. May be NULL. */
	double (*exact)(const struct pm_frame *f, const char *quantity, double t);
};

extern const struct pm_scene *const pm_scenes[]; /* generated from lib/scene/, NULL ends */
extern const char *const pm_scene_names[];
const struct pm_scene *pm_scene_find(const char *name); /* NULL with a message */

#endif
