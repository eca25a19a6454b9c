/* Yee's mesh: E half a cell up its own axis, B half a cell up the two others; curls on it at every face, with layers that absorb at open ones.
 * SPDX-License-Identifier: GPL-3.0-or-later */
#ifndef PM_MAXWELL_PARTS_YEE_H
#define PM_MAXWELL_PARTS_YEE_H

#include "mesh/planes.h"

enum { PM_PML_FIELDS = 4 }; /* of an axis a: memory of the derivatives along it that advance E and B of components a + 1 and a + 2, in this order */

struct pm_yee {
	struct pm_grid grid;
	double c, eps0;          /* [length/time], [charge^2 time^2/(mass length^dim)] */
	double *e[3], *b[3];     /* [points] */
	const struct pm_planes *planes; /* differences: NULL, or the planes of this rank, which alone are the points then */
	const double *beside[3]; /* with them the field whose curl or divergence is taken, with planes of the neighbours on either side */
	const double *j[3];      /* [charge/(time length^(dim - 1))]; NULL none */
	double drift[3];         /* [length/time] with which the current moves on in a step (psatd) */
	bool nodal;              /* E and B are on the nodes, all components (psatd); J sits where Yee has E */
	int layers;              /* [cells] of the absorbing layers inside open faces */
	double *pml[3][PM_PML_FIELDS]; /* [points]; NULL: the axis has no open face */
};

/* Does Gauss's law of this E hold with the derivatives of waves (PM_DIFFERENCES in its header), not with two-point differences? */
bool pm_yee_spectral(const struct pm_field *e);
/* Does anything vary along the axis? */
static inline bool pm_yee_varies(const struct pm_grid *g, int d) { return d < g->dim && !(g->face[d][0] == PM_PERIODIC && g->cells[d] == 1); }
static inline bool pm_yee_open(enum pm_face face) { return face == PM_OPEN || face == PM_ABSORBING; }
/* Is E along the face zero there: at a conductor, and behind an absorbing layer? */
static inline bool pm_yee_conducts(enum pm_face face) { return face == PM_WALL || pm_yee_open(face); }

/* Two-point differences, all faces. */
void pm_yee_magnetic(const struct pm_yee *y, double dt);
void pm_yee_electric(const struct pm_yee *y, double dt);

/* A derivative along each axis: weights of the two differences along it, and across it of the point itself, of its neighbours along the two other axes
 * (axis + 1, axis + 2) and of those along both. */
struct pm_yee_stencil {
	double near, far;
	double middle[3], side[3][2], corner[3];
};
/* Curls with it in a periodic box; with electric also -dt J/eps0. */
void pm_yee_wide(const struct pm_yee *y, const struct pm_yee_stencil *s, bool electric, double dt);

/* Waves with the differences d(theta)/h along each axis are bounded for c dt up to 1/sqrt(sum (factor/h)^2), factor 1 for two points. */
double pm_yee_limit(const struct pm_grid *g, double factor);

/* to = div E - rho/eps0 on the nodes (0 where E along a face is zero); rho NULL: 0. On planes of a rank E is beside[]. */
void pm_yee_divergence(const struct pm_yee *y, const double *rho, double *to);
/* E -= grad psi, psi on the nodes, with a plane of the neighbours on either side where ranks share the mesh. */
void pm_yee_subtract_gradient(const struct pm_yee *y, const double *psi);

#endif
