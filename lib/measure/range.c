/* Smallest, largest and mean value of a field, the mean by the law of sums (base/in-order.h).
 * SPDX-License-Identifier: GPL-3.0-or-later */
#include "measure/range.h"
#include "mesh/mesh-sum.h"
#include "stream/over-stretches.h"
#include "world/world.h"

struct component {
	const struct pm_field *field;
	int c;
};

struct part {
	double min, max, least;
	struct pm_sum sum;
};

double pm_field_value(const struct pm_field *field, int c, size_t i)
{
	double length = 0;
	if (c >= 0)
		return field->type == PM_I64 ? (double)pm_in_i64(field, c)[i] : field->type == PM_U8 ? (double)pm_in_u8(field, c)[i] : pm_in(field, c)[i];
	for (int k = 0; k < field->components; k++)
		length = hypot(length, pm_field_value(field, k, i));
	return length;
}

static void make(const void *data, size_t from, size_t to, void *part)
{
	const struct component *of = data;
	struct part p = *(struct part *)part;
	for (size_t i = from; i < to; i++) {
		double y = pm_field_value(of->field, of->c, i);
		p.min = fmin(p.min, y);
		p.max = fmax(p.max, y);
		p.least = y > 0 ? fmin(p.least, y) : p.least;
		pm_sum_add(&p.sum, y);
	}
	*(struct part *)part = p;
}

static void join(size_t size, const void *part, void *all)
{
	(void)size;
	const struct part *from = part;
	struct part *to = all;
	to->min = fmin(to->min, from->min), to->max = fmax(to->max, from->max), to->least = fmin(to->least, from->least);
	pm_join_sums(sizeof from->sum, &from->sum, &to->sum);
}

struct pm_range pm_range_of(const struct pm_frame *f, const struct pm_field *field, int c)
{
	const struct part none = {.min = HUGE_VAL, .max = -HUGE_VAL, .least = HUGE_VAL};
	const struct pm_parts parts = {.size = sizeof none, .none = &none, .make = make, .join = join};
	struct part all = none;
	const size_t count = field->here ? (size_t)field->from[pm_world_size()] : field->count;
	const struct pm_mesh *m = pm_frame_mesh(f, field->on);
	if (!count)
		return (struct pm_range){NAN, NAN, NAN, HUGE_VAL};
	pm_field_bring(field);
	if (m) {
		const struct pm_grid g = pm_grid_of(f, m);
		pm_grid_over(&g, field, &parts, &(struct component){field, c}, &all);
	} else {
		pm_over_stretches(field, &parts, &(struct component){field, c}, &all);
	}
	return (struct pm_range){all.min, all.max, pm_sum_total(all.sum) / (double)count, all.least};
}
