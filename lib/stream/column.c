/* Columns of fields (column.h). SPDX-License-Identifier: GPL-3.0-or-later */
#include "stream/column.h"
#include "stream/parts.h"

struct pm_column pm_column_of(const struct pm_field *field, int c)
{
	const float *floats = pm_field_floats(field);
	if (floats)
		return (struct pm_column){.floats = floats + (size_t)c * field->count};
	return field->uniform && !field->buffer ? (struct pm_column){.value = field->value[c]} : pm_column_doubles(pm_in(field, c));
}

float *pm_column_floats(struct pm_field *field, int c)
{
	float *floats = pm_field_floats(field);
	return floats ? floats + (size_t)c * field->count : NULL;
}
