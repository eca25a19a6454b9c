/* Scenes: the particles, the law, the box, the default mesh and step of a physical situation. One file per scene.
 * SPDX-License-Identifier: GPL-3.0-or-later */
#ifndef PM_SCENE_H
#define PM_SCENE_H

#include "stream/frame.h"

enum { PM_SCENE_PARAMETERS = 16 };

struct pm_scene_parameter {
	const char *name, *unit; /* a name has the same meaning in every scene */
	double otherwise;        /* default */
	double low, high;        /* inclusive; both 0: any */
	const char *text;
};

/* How particles are drawn from a distribution: evenly spaced, by sequences that fill space evenly, or at random. */
enum pm_loading { PM_LATTICE, PM_BIT_REVERSED, PM_SOBOL, PM_RANDOM };

struct pm_scene_choice { /* the options of pinit, defaults filled in and ranges checked */
	int dim;
	uint64_t n, seed;
	enum pm_loading loading;
	size_t cells[3];                   /* of the default mesh, from the options; 0: the scene's own */
	bool box;                          /* given: lo to hi */
	double lo[3], hi[3];
	double value[PM_SCENE_PARAMETERS]; /* in the order of the rows */
	double *cut;                       /* out: the part of the sum of |strength| that open faces leave out; NULL: nobody asks */
};

/* A solid body in the flow, as penalize takes it: its level and its velocity as expressions, the stream past it, and its largest speed along the wall. */
struct pm_scene_solid {
	char level[96], velocity[64]; /* velocity "": at rest */
	double stream[3], speed;      /* [length/time] */
};

struct pm_scene {
	const char *name, *sentence, *source;
	unsigned dims;           /* bit 1u<<dim for each dimension it exists in */
	int dim;                 /* default */
	uint64_t n;              /* default, in its default dimension */
	bool n_fixed;            /* n cannot be changed; with n 0 the particles are nodes of the mesh, whose cells give their number */
	bool random;             /* depends on the seed */
	bool any_box;            /* periodic, and any box may be typed: it fills it, or is placed by who types it */
	bool shared;             /* several ranks make it together, each its own stretch of the particles (docs/distributed.md) */
	bool loads;              /* has all loadings, and is quiet by default: PM_LATTICE */
	const struct pm_scene_parameter *parameters; /* {0} ends */
	/* Fills a new frame of c->dim: law, constants, box, faces, sets with their data, the mesh "mesh", dt. 0 or failure. */
	int (*make)(const struct pm_scene_choice *c, struct pm_frame *f);
	/* The exact value of one of diag's columns (or of a number in the scene's head) at time t; NAN if it has none of that name. May be NULL. */
	double (*exact)(const struct pm_frame *f, const char *quantity, double t);
	/* The exact level at the point x at time t, below 0 inside; NAN at a time when it is not known. NULL: no level. */
	double (*level)(const struct pm_frame *f, const double x[], double t);
	/* The body in the flow, from the scene's parameters. NULL: none. */
	void (*body)(const struct pm_frame *f, struct pm_scene_solid *b);
};

extern const struct pm_scene *const pm_scenes[]; /* generated from lib/scene/, NULL ends */
extern const char *const pm_scene_names[];
const struct pm_scene *pm_scene_find(const char *name); /* NULL with a message */

#endif
