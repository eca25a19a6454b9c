/* pm_spread and pm_gather of columns (stream/column.h): positions, strengths and targets may be floats, strengths and factors one number. What is gathered
 * into floats is computed in doubles and rounded once. Where the mesh is divided all are doubles.
 * SPDX-License-Identifier: GPL-3.0-or-later */
#ifndef PM_TRANSFER_COLUMNS_H
#define PM_TRANSFER_COLUMNS_H

#include "stream/column.h"
#include "transfer/transfer.h"

struct pm_target {
	double *doubles;
	float *floats; /* where doubles is NULL */
	bool zero;     /* holds zeros, so that what is added to it is what it becomes */
};

/* Of a field that is changed or new. */
static inline struct pm_target pm_target_of(struct pm_field *field, int c)
{
	float *floats = pm_column_floats(field, c);
	return (struct pm_target){.doubles = floats ? NULL : pm_out(field, c), .floats = floats,
		.zero = field->use & PM_USE_NEW && !(field->use & PM_USE_FILL)};
}

int pm_spread_columns(const struct pm_transfer *t, size_t n, const struct pm_column x[], const struct pm_column strength[], double *const mesh[],
	struct pm_strays *strays);
/* A factor that is one number 1: none. */
int pm_gather_columns(const struct pm_transfer *t, size_t n, const struct pm_column x[], const double *const mesh[], const struct pm_column factor[],
	const struct pm_target out[], struct pm_strays *strays);

void pm_columns_of(int n, const double *const x[], struct pm_column to[]); /* NULL: one number 0 */

#endif
