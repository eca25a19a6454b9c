/* Shared by the tools that solve lap phi = c*s: the options that define the problem, and the report of the mean removed from a singular one.
 * SPDX-License-Identifier: GPL-3.0-or-later */
#ifndef PM_STAGE_SOLVER_OPTIONS_H
#define PM_STAGE_SOLVER_OPTIONS_H

#include "poisson/problem.h"
#include "stage/stage.h"

/* Rows of options, for a struct config with the member `names` of type struct pm_problem_names. */
#define PM_SOLVER_ROWS \
	{.name = "coefficient", .kind = PM_REAL, PM_AT(names.coefficient), .text = "c in lap phi = c*s (default: the law's)"}, \
	{.name = "source", .kind = PM_TEXT, .unit = "FIELD", PM_AT(names.source), .text = "s, a mesh field (default: the law's density)"}, \
	{.name = "target", .kind = PM_TEXT, .unit = "FIELD", PM_AT(names.target), .text = "phi, the mesh field to make (default: the law's potential)"}, \
	{.name = "mesh", .kind = PM_TEXT, .unit = "NAME", PM_AT(names.mesh), .text = "the mesh (default: the first)"}, \
	{.name = "wall", .kind = PM_WORD, .fallback = "tangential", .choices = pm_wall_rule_names, PM_AT(names.wall), \
		.text = "which components of a vector are zero at a wall; the others have zero normal gradient. At a neumann face it is the other way round"}

/* key, or of component c of a vector key_c, with room for 32 letters. */
const char *pm_solver_key(const struct pm_problem *p, const char *key, int c, char text[32]);
/* mean: removed from component c of the source; incompatible: its ratio to the largest value. */
void pm_solver_report_removed(const struct pm_stage *s, struct pm_frame *f, const struct pm_problem *p, int c, double mean, double incompatible);

#endif
