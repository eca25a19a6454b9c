/* Charge collected by the faces of the box. Sums are compensated and in the order of the stream, so they do not depend on threads. Cost: a pass over the
 * particles, in frames with electrodes alone. SPDX-License-Identifier: GPL-3.0-or-later */
#include <stdio.h>

#include "push/electrode-charge.h"
#include "stream/over-stretches.h"

struct leaving {
	int dim;
	double lo[3], hi[3];
	bool takes[3][2];   /* absorbing faces */
	const double *x[3], *q; /* q NULL: each has `each` */
	double each;
};

void pm_electrode_name(int axis, int side, char name[PM_ELECTRODE_NAME])
{
	snprintf(name, PM_ELECTRODE_NAME, "charge_%c_%s", 'x' + axis, side ? "high" : "low");
}

bool pm_electrode(const struct pm_frame *f, int axis, int side)
{
	char name[PM_ELECTRODE_NAME];
	pm_electrode_name(axis, side, name);
	return json_object_get(f->constants, name) != NULL;
}

void pm_electrode_add(struct pm_frame *f, int axis, int side, double charge)
{
	char name[PM_ELECTRODE_NAME];
	pm_electrode_name(axis, side, name);
	pm_frame_constant_set(f, name, pm_frame_constant(f, name, 0) + charge);
}

static void make(const void *data, size_t from, size_t to, void *part)
{
	const struct leaving *l = data;
	struct pm_sum *sum = part;
	for (size_t p = from; p < to; p++)
		for (int a = 0; a < l->dim; a++) {
			const bool low = l->takes[a][0] && l->x[a][p] < l->lo[a], high = l->takes[a][1] && l->x[a][p] > l->hi[a];
			if (low || high) {
				pm_sum_add(sum + 2 * a + high, l->q ? l->q[p] : l->each);
				break;
			}
		}
}

void pm_electrodes_collect(struct pm_frame *f, const char *set)
{
	const struct pm_parts parts = {.size = 6 * sizeof(struct pm_sum), .make = make, .join = pm_join_sums};
	const struct pm_field *x = pm_frame_field(f, set, "x"), *q = pm_frame_field(f, set, "charge");
	struct leaving l = {.dim = f->dim};
	struct pm_sum sum[6] = {{0, 0}};
	bool any = false;
	for (int a = 0; a < f->dim; a++)
		for (int side = 0; side < 2; side++) {
			l.takes[a][side] = f->pface[a][side] == PM_PABSORB;
			any = any || (l.takes[a][side] && pm_electrode(f, a, side));
		}
	if (!any || !q || !pm_frame_set(f, set)->n)
		return;
	l.q = q->uniform ? NULL : pm_in(q, 0);
	l.each = q->value[0];
	for (int a = 0; a < f->dim; a++) {
		l.lo[a] = f->lo[a];
		l.hi[a] = f->hi[a];
		l.x[a] = pm_in(x, a);
	}
	pm_over_stretches(x, &parts, &l, sum);
	for (int a = 0; a < f->dim; a++)
		for (int side = 0; side < 2; side++)
			if (l.takes[a][side] && pm_electrode(f, a, side))
				pm_electrode_add(f, a, side, pm_sum_total(sum[2 * a + side]));
}
