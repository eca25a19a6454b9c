/* Closed polygons of flat panels in a plane flow, with a vortex sheet or sources of constant strength a panel (docs/methods/panels.md).
 * SPDX-License-Identifier: GPL-3.0-or-later */
#ifndef PM_PANELS_H
#define PM_PANELS_H

#include "base/base.h"

PM_C_BEGIN

struct pm_panels {
	size_t n, curves;
	double *corner[4];           /* [length] x, y of the beginning and of the end, n each; corners go round the body counter-clockwise */
	double *x[2], *normal[2];    /* midpoints [length]; unit vectors out of the body */
	double *length;
	size_t *curve;               /* of a panel, from 0 */
	bool source;                 /* sources, else a vortex sheet */
};

/* x, normal, length, curve and curves from the corners. 0, or failure: panels that join to no closed curve, without length, or clockwise. */
int pm_panels_measure(struct pm_panels *p);

/* The dense equations of one geometry, factored: kept as long as the geometry stays. Zero: none yet. */
struct pm_panels_solver {
	size_t n, unknowns;
	double *key;                 /* the corners that it belongs to, and the kind */
	void *matrix, *permutation;  /* of GSL */
	double *through;             /* mean flow out of panel i by strength 1 of panel j, n*n, j fastest */
};
void pm_panels_solver_free(struct pm_panels_solver *s);

struct pm_panels_flow {
	const double *u[2];          /* [velocity] at the midpoints: that of the fluid without the panels, less that of the wall */
	const double *total;         /* of each curve: circulation of the sheet, or flux of the sources [length^2/time] */
};
struct pm_panels_solved {
	double leak;                 /* [velocity] largest mean flow through a panel */
	double slack;                /* [velocity] largest constant that was added to the equations of a curve so that the total is kept */
};
/* strength[n], mean velocity over each panel: 0 along the inside of a sheet, or through the
 * outside of sources. 0 or failure. Cost: n^3 for a new geometry, n^2 else. */
int pm_panels_solve(const struct pm_panels *p, const struct pm_panels_flow *flow, struct pm_panels_solver *s, double *strength,
	struct pm_panels_solved *done);

/* along[n] += the mean velocity along the inside of each panel, of all panels with these strengths. Cost: n^2. */
void pm_panels_along(const struct pm_panels *p, const double *strength, double *along);

/* Adds the panels' velocity at other points: x[2][n], u[2][n]. The same bytes for any number of threads. Cost: points times panels. */
void pm_panels_at(const struct pm_panels *p, const double *strength, size_t n, const double *const x[2], double *const u[2]);

PM_C_END

#endif
