/* A box that moves along an axis by whole cells: fields and particles fall out behind, plasma at rest comes in in front.
 * SPDX-License-Identifier: GPL-3.0-or-later */
#ifndef PM_LOAD_MOVING_WINDOW_H
#define PM_LOAD_MOVING_WINDOW_H

#include "expression/expression.h"
#include "load/density-profile.h"
#include "stream/strengths.h"

enum { PM_WINDOW_SETS = 3 };

struct pm_window {
	int axis;
	double speed, from;     /* [length/time] NAN: c of the law; [time] when it sets out */
	const char *mesh;       /* NULL: the first */
	int sets;               /* that come in */
	const char *const *set;
	double charge[PM_WINDOW_SETS], mass[PM_WINDOW_SETS], vth[PM_WINDOW_SETS]; /* of a real particle; [length/time] */
	int each;               /* particles of a set in a cell, along every axis */
	const char *density;    /* real particles per volume in x y z; NULL: 1 */
	uint64_t seed;
};

struct pm_window_report {
	double shifted;         /* cells */
	uint64_t came, left;
	struct pm_strengths behind; /* of those that left */
	double given[2];        /* mass and charge of those that came */
};

enum pm_window_act { PM_WINDOW_WAITS, PM_WINDOW_ACTS };
/* Header: one of these, or failure. It acts once a step, behind the drift, where the window has reached a new cell. */
int pm_window_declare(struct pm_window *w, struct pm_frame *f);
/* Data, under PM_HOLD. 0 or failure. */
int pm_window_step(const struct pm_window *w, struct pm_frame *f, struct pm_window_report *report);

#endif
