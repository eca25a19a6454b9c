/* Sums over the particles of a set, in the order of the stream (docs/distributed.md), or of groups of it. Cost: N, with groups N log N on one thread.
 * SPDX-License-Identifier: GPL-3.0-or-later */
#include <stdlib.h>

#include "expression/field-total.h"
#include "stream/declare.h"
#include "world/over-ranks.h"

int pm_total_declare(struct pm_frame *f, const struct pm_field *field, const char *per)
{
	const struct pm_field *group = per ? pm_frame_field(f, field->on, per) : NULL;
	if (!pm_frame_set(f, field->on))
		return pm_fail(PM_DATA, "'%s' is on a mesh, but --total adds over the particles of a set (diag has sums over meshes)", field->on);
	if (field->type == PM_I64 || field->type == PM_U8)
		return pm_fail(PM_DATA, "'%s' holds whole numbers, but --total needs a real field (another name)", field->name);
	if (per && (!group || group->components != 1))
		return pm_fail(PM_DATA, group ? "'%s' on '%s' is a vector, but --per needs one number a particle"
			: "no field '%s' on '%s' for --per (sls lists the fields)", per, field->on);
	return per && !pm_reads(f, field->on, per) ? -PM_DATA : 0;
}

struct member {
	double group;
	size_t index;
};

static int by_group(const void *a, const void *b)
{
	const struct member *p = a, *q = b;
	return p->group != q->group ? (p->group > q->group) - (p->group < q->group) : (p->index > q->index) - (p->index < q->index);
}

static int of_groups(const struct pm_field *group, struct pm_field *field)
{
	const size_t n = field->count;
	struct member *m = pm_alloc(n ? n : 1, sizeof *m);
	if (!m)
		return -PM_DATA;
	for (size_t i = 0; i < n; i++)
		m[i] = (struct member){group->type == PM_I64 ? (double)pm_in_i64(group, 0)[i] : group->type == PM_U8 ? pm_in_u8(group, 0)[i]
			: pm_in(group, 0)[i], i};
	qsort(m, n, sizeof *m, by_group);
	for (int c = 0; c < field->components; c++) {
		double *x = pm_out(field, c);
		for (size_t from = 0, to; from < n; from = to) {
			struct pm_sum sum = {0};
			for (to = from; to < n && m[to].group == m[from].group; to++)
				pm_sum_add(&sum, x[m[to].index]);
			for (size_t i = from; i < to; i++)
				x[m[i].index] = pm_sum_total(sum);
		}
	}
	pm_free(m);
	return 0;
}

int pm_total(int status, const struct pm_frame *f, struct pm_field *field, const char *per)
{
	if (per)
		return status ? status : of_groups(pm_frame_field(f, field->on, per), field);
	for (int c = 0; c < field->components; c++) {
		struct pm_sum all = {0};
		double *x = status ? NULL : pm_out(field, c);
		status = pm_world_sum_of_set(status, field->count, x, NULL, &all);
		for (size_t i = 0; i < field->count && !status; i++)
			x[i] = pm_sum_total(all);
	}
	return status;
}
