/* A sheet of current that radiates; used by antenna. SPDX-License-Identifier: GPL-3.0-or-later */
#ifndef PM_MAXWELL_STEP_ANTENNA_H
#define PM_MAXWELL_STEP_ANTENNA_H

#include "expression/expression.h"
#include "maxwell-parts/yee.h"

enum { PM_ANTENNA_NAMES = 48, PM_ANTENNA_LAYERS = 10 /* those of maxwell by default */ };

struct pm_antenna_choice {
	const char *mesh, *term; /* mesh NULL: the first; the name under which its current is added to J */
	const char **wave;       /* "Ey = EXPRESSION": E of the light at the sheet, of components along it */
	int waves;
	int axis;                /* across the sheet */
	double place;             /* [length] NAN: two cells inside the absorbing layer at the low face */
};

struct pm_antenna {
	struct pm_yee yee;       /* without data */
	const struct pm_frame *f;
	struct pm_expression wave[3];
	bool sends[3];           /* is there an expression for the component? */
	char name[PM_ANTENNA_NAMES][PM_NAME]; /* of the numbers in it: x y z time, then constants of the frame */
	double number[PM_ANTENNA_NAMES];
	int n, axis;
	size_t plane;            /* nodes below it along the axis */
	struct pm_field *current;
	bool made;               /* J was not there before */
};

/* Each 0 or failure. */
int pm_antenna_declare(const struct pm_antenna_choice *c, struct pm_frame *f, struct pm_antenna *a);
int pm_antenna_add(struct pm_antenna *a, const struct pm_frame *f);

#endif
