/* The viscosity of the words that diffuse (diffuse, pse, walk): the option --nu, else the frame's constant.
 * SPDX-License-Identifier: GPL-3.0-or-later */
#ifndef PM_STAGE_VISCOSITY_OPTIONS_H
#define PM_STAGE_VISCOSITY_OPTIONS_H

#include "expression/expression.h"
#include "stage/stage.h"

/* A row of options, for a struct config with the member `double nu`. */
#define PM_VISCOSITY_ROW \
	{.name = "nu", .kind = PM_REAL, .unit = "length^2/time", .high = 1e300, PM_AT(nu), .text = "the viscosity (default: the frame's constant nu)"}

/* The same as a tensor or a field, with the member `const char *nu`. */
#define PM_VISCOSITY_FIELD_ROW \
	{.name = "nu", .kind = PM_TEXT, .unit = "EXPRESSION", PM_AT(nu), \
		.text = "the viscosity, length^2/time (default: the frame's constant nu): a number; one for each axis with commas between, a diagonal " \
			"tensor; or a field by name, or an expression of position and fields"}

struct pm_viscosity {
	double axis[3];          /* [length^2/time]; where it varies 1 */
	double least, ratio[3];  /* of the axes; axis over least */
	bool varies;
	struct pm_expression e;  /* then */
};
/* begin(): refuses what is a number below 0 whatever the frame. */
int pm_viscosity_typed(const char *typed);
/* declare(): the viscosity for the fields of a set or mesh; marks those that it reads. As pm_viscosity_check. */
int pm_viscosity_of(struct pm_stage *s, struct pm_frame *f, const char *on, const char *typed, struct pm_viscosity *v);
/* frame(): nu at the n values here, and the least and largest of all ranks; fails where one is below 0. */
int pm_viscosity_values(int status, const struct pm_viscosity *v, const struct pm_frame *f, size_t n, double *at, double *least, double *most);

/* nu [length^2/time] as typed, NAN where it was not. */
double pm_viscosity(const struct pm_frame *f, double typed);
/* declare(): 0; PM_PASS, and says so once, where nu is 0; or failure where it is negative. */
int pm_viscosity_check(struct pm_stage *s, double nu);

#endif
