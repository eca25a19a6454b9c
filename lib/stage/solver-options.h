/* Shared by the tools that solve lap phi = c*s: the options that define the problem, and the report of the mean removed from a singular one.
 * SPDX-License-Identifier: GPL-3.0-or-later */
#ifndef PM_STAGE_SOLVER_OPTIONS_H
#define PM_STAGE_SOLVER_OPTIONS_H

#include "poisson/problem.h"
#include "stage/stage.h"

#define PM_SOLVER_FACE(place, d, side) {.name = place, .kind = PM_TEXT, .unit = "EXPRESSION", PM_AT(names.given.face[d][side]), \
	.text = "on this face alone: phi, or if it is neumann d phi/dn outward"}

/* Rows of options, for a struct config with the member `names` of type struct pm_problem_names. */
#define PM_SOLVER_ROWS \
	{.name = "coefficient", .kind = PM_REAL, PM_AT(names.coefficient), .text = "c in lap phi = c*s (default: the law's)"}, \
	{.name = "source", .kind = PM_TEXT, .unit = "FIELD", PM_AT(names.source), .text = "s, a mesh field (default: the law's density)"}, \
	{.name = "target", .kind = PM_TEXT, .unit = "FIELD", PM_AT(names.target), .text = "phi, the mesh field to make (default: the law's potential)"}, \
	{.name = "dirichlet", .kind = PM_TEXT, .unit = "EXPRESSION", PM_AT(names.given.dirichlet), \
		.text = "phi on every wall, and on open faces, which then are walls (default: 0)"}, \
	{.name = "flux", .kind = PM_TEXT, .unit = "EXPRESSION", PM_AT(names.given.flux), \
		.text = "d phi/dn, n outward, on every neumann face (default: 0)"}, \
	PM_SOLVER_FACE("x-low", 0, 0), PM_SOLVER_FACE("x-high", 0, 1), PM_SOLVER_FACE("y-low", 1, 0), PM_SOLVER_FACE("y-high", 1, 1), \
	PM_SOLVER_FACE("z-low", 2, 0), PM_SOLVER_FACE("z-high", 2, 1), \
	{.name = "open-faces", .kind = PM_WORD, .fallback = "free", .choices = pm_given_open_names, PM_AT(names.given.open), \
		.text = "an open box: free space in the solver's own way, or walls on which phi is the sum over all particles"}, \
	{.name = "mesh", .kind = PM_TEXT, .unit = "NAME", PM_AT(names.mesh), .text = "the mesh (default: the first)"}, \
	{.name = "wall", .kind = PM_WORD, .fallback = "tangential", .choices = pm_wall_rule_names, PM_AT(names.wall), \
		.text = "which components of a vector are zero at a wall; the others have zero normal gradient. At a neumann face it is the other way round"}

/* key, or of component c of a vector key_c, with room for 32 letters. */
const char *pm_solver_key(const struct pm_problem *p, const char *key, int c, char text[32]);
/* mean: removed from component c of what m says was solved; incompatible: its ratio to the largest value. Given fluxes that do not fit are told once. */
void pm_solver_report_removed(struct pm_stage *s, struct pm_frame *f, const struct pm_problem *p, int c, double mean,
	const struct pm_homogeneous *m, double incompatible);

#endif
