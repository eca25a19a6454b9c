/* What the vortices of the plane and of space share: box, mesh and set under the law vortex. SPDX-License-Identifier: GPL-3.0-or-later */
#ifndef PM_SCENE_VORTEX_SET_H
#define PM_SCENE_VORTEX_SET_H

#include "scene/scene.h"

/* The box lo..hi of dim axes with the same face condition on every side, and the default mesh: the cells given by the user, else these. */
int pm_scene_vortex_box(const struct pm_scene_choice *c, struct pm_frame *f, int dim, const double lo[3], const double hi[3], enum pm_face face,
	const size_t cells[3]);
/* Side of a cell along x of a box that is `length` long where none is typed, with so many cells there. */
double pm_scene_vortex_cell(const struct pm_scene_choice *c, double length, size_t cells);
/* The set vortices: x, strength (circulation in the plane, alpha in space), volume (of each) and id; x and strength are their arrays, n values each. With ranks
 * that make the scene together n is the number that this rank has found; takes its status and returns the agreed one. */
int pm_scene_vortex_set(struct pm_frame *f, int dim, uint64_t n, double volume, double *x[], double *strength[]);
/* Behind it, when the arrays are full: these are cut anew, to the stretches of the ranks. 0 or failure, agreed. */
int pm_scene_vortex_cut(struct pm_frame *f);
/* Refuses a box given by the user that cuts or misses the scene: largest |omega| of all nodes with vortices, and of those next to the margin. Agreed. */
int pm_scene_vortex_inside(const struct pm_scene_choice *c, double largest, double at_the_margin);
/* A vorticity, of the plane or of space; the other is NULL. */
struct pm_scene_omega {
	double (*plane)(const struct pm_scene_choice *c, double x, double y);
	void (*space)(const struct pm_scene_choice *c, const double x[3], double w[3]);
};
/* c->cut, where it is asked for: of |omega| > least on nodes, `kept` (the sum of this rank) beside what is within margin[d] nodes of the faces of axis d. */
int pm_scene_vortex_lost(const struct pm_scene_choice *c, const struct pm_frame *f, const struct pm_scene_omega *omega, double least, double kept,
	const size_t margin[3]);
/* The rows of nodes, 0 <= row < rows, that this rank looks at: from *first to before *end. */
void pm_scene_rows_here(size_t rows, size_t *first, size_t *end);
/* Shortens dt to 0.986 of what lsrk3 allows diffusion with differences of order 6: they decay at up to 272/45 nu (1/hx^2 + 1/hy^2 + 1/hz^2), and lsrk3 is
 * stable to 2.5127 of that. */
void pm_scene_vortex_dt(struct pm_frame *f, const struct pm_mesh *m);

#endif
