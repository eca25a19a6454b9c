/* The wall's vorticity and the fluid beside it, on particles that sit on nodes of a mesh (docs/methods/noslip.md). SPDX-License-Identifier: GPL-3.0-or-later */
#ifndef PM_WALL_FLUX_H
#define PM_WALL_FLUX_H

#include "mesh/grid.h"
#include "panels/panels.h"

/* The particles as a lattice. */
struct pm_wall_fluid {
	struct pm_grid grid;
	size_t n;
	const double *x[2];   /* [length] of the particles */
	double *circulation;  /* [length^2/time] */
	size_t *at;           /* [points] 1 + number of the particle at a node, 0: none */
};

/* at[] from the positions, and the nodes within the walls are looked at. 0, or failure: a particle off the nodes, two at one, or one within a wall. */
int pm_wall_fluid_find(struct pm_wall_fluid *w, const struct pm_panels *p);
/* d Gamma/dt = nu lap Gamma over a time, without flux to nodes that have no particle: the sum of Gamma stays. Second differences, explicit steps.
 * work: n. Returns the number of steps. */
size_t pm_wall_diffuse(const struct pm_wall_fluid *w, double nu, double time, double *work);
/* u[2][panels] += the mean velocity along each panel that the particles induce, as a vector along the panel. Cost: panels times particles. */
void pm_wall_slip(const struct pm_wall_fluid *w, const struct pm_panels *p, double *const u[2]);
/* The circulation sheet*length of each panel goes into the fluid as a flux that is even over a time, or suddenly at its beginning, with viscosity nu.
 * *plain: panels for which only the circulation is exact, not its moments. 0, or failure: a panel without particles beside it. */
int pm_wall_flux(const struct pm_wall_fluid *w, const struct pm_panels *p, const double *sheet, double nu, double time, bool sudden, size_t *plain);

#endif
