/* What travels: the parts of blocks (world/over-ranks.h), or a number. SPDX-License-Identifier: GPL-3.0-or-later */
#include "stream/over-stretches.h"
#include "world/over-ranks.h"

void pm_over_stretches(const struct pm_field *field, const struct pm_parts *p, const void *data, void *all)
{
	if (!field->here)
		pm_over_set(p, data, field->count, all);
	else if (pm_world_over_set(0, p, data, field->count, all))
		pm_cannot_go_on();
}

void pm_sum_of_stretches(const struct pm_field *field, const double *x, const double *y, struct pm_sum *all)
{
	if (!field->here)
		pm_sum_of_set(field->count, x, y, all);
	else if (pm_world_sum_of_set(0, field->count, x, y, all))
		pm_cannot_go_on();
}

double pm_most_of_stretches(const struct pm_field *field, double here)
{
	if (field->here && pm_world_largest(0, 1, &here))
		pm_cannot_go_on();
	return here;
}
