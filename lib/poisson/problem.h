/* The problem a solver is given in a frame: lap target = c * source on a mesh, named by the law or by the user. The same for every solver, which is
 * what makes them interchangeable. SPDX-License-Identifier: GPL-3.0-or-later */
#ifndef PM_PROBLEM_H
#define PM_PROBLEM_H

#include "law/law.h"

struct pm_problem_names { /* NULL and NAN: the law's */
	const char *source, *target, *mesh;
	double coefficient;
};

struct pm_problem {
	const struct pm_law *law;
	const struct pm_mesh *mesh;
	const char *source_name, *target_name;
	struct pm_grid grid;
	double c;
	const struct pm_field *source; /* after pm_problem_declare */
	struct pm_field *target;
};

int pm_problem_find(const struct pm_frame *f, const struct pm_problem_names *names, struct pm_problem *p);
int pm_problem_declare(struct pm_frame *f, struct pm_problem *p); /* reads the source, makes the target: derived, with the source's kernel */

#endif
