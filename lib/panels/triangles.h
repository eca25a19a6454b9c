/* Closed surfaces of flat triangles in space, with sources of constant strength a triangle (docs/methods/panels.md).
 * SPDX-License-Identifier: GPL-3.0-or-later */
#ifndef PM_PANELS_TRIANGLES_H
#define PM_PANELS_TRIANGLES_H

#include "panels/panels.h"

PM_C_BEGIN

struct pm_triangles {
	size_t n, surfaces;
	double *corner[9];           /* [length] x, y, z of three corners, n each, counter-clockwise seen from outside */
	double *x[3], *normal[3];    /* centroids [length]; unit vectors out of the body */
	double *area;
	size_t *surface;             /* of a triangle, from 0 */
};

/* x, normal, area, surface and surfaces from the corners. 0, or failure: an edge that is not shared by two triangles, one without area, inside out. */
int pm_triangles_measure(struct pm_triangles *t);

/* 20 m^2 triangles: the icosahedron with every edge in m parts, on the unit sphere. corner[9], n each. */
void pm_triangles_sphere(size_t m, double *const corner[9]);

/* strength[n], such that the mean velocity through every triangle vanishes. normal[n]: that of the fluid without them, less the wall's, at the centroids, out;
 * total of each surface: flux of the sources [length^3/time]. 0 or failure. Cost: n^3 for a new geometry, n^2 else. */
int pm_triangles_solve(const struct pm_triangles *t, const double *normal, const double *total, struct pm_panels_solver *s, double *strength,
	struct pm_panels_solved *done);

/* Adds the velocity of the triangles at other points, x[3][n], u[3][n]; and, of alpha[3][n], (alpha . grad) u to change[3][n] (both NULL: none).
 * 0 or failure (memory). The same bytes for any number
 * of threads. Cost: points times triangles. */
struct pm_triangles_at {
	size_t n;
	const double *x[3], *alpha[3];
	double *u[3], *change[3];
};
int pm_triangles_at(const struct pm_triangles *t, const double *strength, const struct pm_triangles_at *at);

PM_C_END

#endif
