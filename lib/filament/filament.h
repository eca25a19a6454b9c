/* Vortex filaments: closed curves of nodes, or curves that go on for ever through a periodic face, and the velocity they induce (docs/methods/filament.md).
 * SPDX-License-Identifier: GPL-3.0-or-later */
#ifndef PM_FILAMENT_H
#define PM_FILAMENT_H

#include "cell/cell-list.h"

/* The smoothing length over the core radius. */
struct pm_filament_core {
	const char *name;
	double smoothing;
};
extern const struct pm_filament_core pm_filament_cores[]; /* NULL name ends */
extern const char *const pm_filament_core_names[];        /* the same order, NULL ends */

struct pm_filament {
	struct pm_domain domain;  /* periodic along one axis at most, open otherwise */
	size_t n;
	const double *x[3];       /* [length] of the nodes */
	const double *circulation, *core; /* [length^2/time], [length] at the nodes */
	const int64_t *curve, *node; /* each curve's nodes follow each other as their numbers ascend; the last is joined to the first */
	double smoothing;         /* of the core: sigma = smoothing * core */
	double local;             /* [length] local induction alone, over this length to both sides; 0: all elements */
	int images;               /* periods to both sides that are summed; the rest of a curve through the box is straight */
};

struct pm_filament_made {
	double length, impulse[3]; /* [length], sum of 1/2 Gamma x cross dx over curves that close [length^4/time] */
	double oscillation;        /* [1/time] of the shortest wave, by its own elements */
	size_t curves;
};

/* Adds to u[3][n]; the nodes' own velocities. 0 or failure: a curve of fewer than 3 nodes, coincident or repeated nodes, cores that are not positive. */
int pm_filament_velocity(const struct pm_filament *f, double *const u[3], struct pm_filament_made *made);
/* Adds the velocity at other points: x[3][n], u[3][n]. */
int pm_filament_at(const struct pm_filament *f, size_t n, const double *const x[3], double *const u[3]);

#endif
