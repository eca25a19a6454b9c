/* A component of a real field as a column: doubles, floats (an f32 field between two stages, frame.h), or one number for all. A stage that takes columns
 * declares PM_USE_COLUMNS, computes in doubles, a block of rows at a time, and rounds what it stores.
 * SPDX-License-Identifier: GPL-3.0-or-later */
#ifndef PM_STREAM_COLUMN_H
#define PM_STREAM_COLUMN_H

#include "stream/frame.h"

struct pm_column {
	const double *doubles;
	const float *floats; /* where doubles is NULL; both NULL: all are `value` */
	double value;
};

struct pm_column pm_column_of(const struct pm_field *field, int c);
/* The floats of component c, to be written; NULL: the field is not held as floats. For one that is changed or new. */
float *pm_column_floats(struct pm_field *field, int c);

static inline struct pm_column pm_column_doubles(const double *x) { return (struct pm_column){.doubles = x}; }

/* m values from p on, as doubles: those of the column, or copied to few[m]. */
static inline const double *pm_column_take(const struct pm_column *c, size_t p, size_t m, double *few)
{
	if (c->doubles)
		return c->doubles + p;
	if (c->floats)
		for (size_t i = 0; i < m; i++)
			few[i] = c->floats[p + i];
	else
		for (size_t i = 0; i < m; i++)
			few[i] = c->value;
	return few;
}

static inline double pm_column_at(const struct pm_column *c, size_t p) { return c->doubles ? c->doubles[p] : c->floats ? c->floats[p] : c->value; }

#endif
