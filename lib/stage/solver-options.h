/* What the tools that solve lap phi = c*s have in common: the options that name the problem, and the report of what a singular one had removed.
 * SPDX-License-Identifier: GPL-3.0-or-later */
#ifndef PM_STAGE_SOLVER_OPTIONS_H
#define PM_STAGE_SOLVER_OPTIONS_H

#include "poisson/problem.h"
#include "stage/stage.h"

/* Rows of options, for a config struct with the member `names` of type struct pm_problem_names. */
#define PM_SOLVER_ROWS(config) \
	{"coefficient", 0, PM_REAL, "", NULL, 0, 0, NULL, "c in lap phi = c*s (default: the law's)", false, offsetof(config, names.coefficient)}, \
	{"source", 0, PM_TEXT, "FIELD", NULL, 0, 0, NULL, "s, a mesh field (default: the law's density)", false, offsetof(config, names.source)}, \
	{"target", 0, PM_TEXT, "FIELD", NULL, 0, 0, NULL, "phi, the mesh field to make (default: the law's potential)", false, offsetof(config, names.target)}, \
	{"mesh", 0, PM_TEXT, "NAME", NULL, 0, 0, NULL, "the mesh (default: the first)", false, offsetof(config, names.mesh)}, \
	{"wall", 0, PM_WORD, "", "tangential", 0, 0, pm_wall_rule_names, \
		"which components of a vector are zero at a wall, the others having no normal gradient; a neumann face is the other way round", false, \
		offsetof(config, names.wall)}

/* key, or of component c of a vector key_c, with room for 32 letters. */
const char *pm_solver_key(const struct pm_problem *p, const char *key, int c, char text[32]);
/* mean: taken out of component c of the source; incompatible: over its largest value. */
void pm_solver_report_removed(const struct pm_stage *s, struct pm_frame *f, const struct pm_problem *p, int c, double mean, double incompatible);

#endif
