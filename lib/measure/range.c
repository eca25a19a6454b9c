/* Smallest, largest and mean value of a field, in blocks of fixed size, so that the mean does not depend on the number of threads.
 * SPDX-License-Identifier: GPL-3.0-or-later */
#include "measure/range.h"

enum { block = 4096, group = 64 };

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

static struct part part_of(const struct pm_field *field, int c, size_t first, size_t last)
{
	struct part p = {.min = HUGE_VAL, .max = -HUGE_VAL, .least = HUGE_VAL};
	for (size_t i = first; i < last; i++) {
		double y = pm_field_value(field, c, i);
		p.min = fmin(p.min, y);
		p.max = fmax(p.max, y);
		p.least = y > 0 ? fmin(p.least, y) : p.least;
		pm_sum_add(&p.sum, y);
	}
	return p;
}

struct pm_range pm_range_of(const struct pm_field *field, int c)
{
	struct part all = {.min = HUGE_VAL, .max = -HUGE_VAL, .least = HUGE_VAL}, parts[group];
	size_t n = field->count;
	for (size_t first = 0; first < n; first += (size_t)block * group) {
		size_t left = (n - first + block - 1) / block, here = left < group ? left : group;
#pragma omp parallel for
		for (size_t k = 0; k < here; k++) {
			size_t from = first + k * block, to = from + block < n ? from + block : n;
			parts[k] = part_of(field, c, from, to);
		}
		for (size_t k = 0; k < here; k++) {
			all.min = fmin(all.min, parts[k].min), all.max = fmax(all.max, parts[k].max), all.least = fmin(all.least, parts[k].least);
			pm_sum_add(&all.sum, parts[k].sum.sum), pm_sum_add(&all.sum, parts[k].sum.carry);
		}
	}
	if (!n)
		return (struct pm_range){NAN, NAN, NAN, HUGE_VAL};
	return (struct pm_range){all.min, all.max, pm_sum_total(all.sum) / (double)n, all.least};
}
