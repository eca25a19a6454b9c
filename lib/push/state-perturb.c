/* The numbers of the state moved at random (state-perturb.h). Cost: one pass over the state and a random number for each.
 * SPDX-License-Identifier: GPL-3.0-or-later */
#include <string.h>

#include "push/random-walk.h"
#include "push/state-perturb.h"
#include "stream/declare.h"
#include "stream/edit.h"

static bool listed(const char *const *names, const char *name)
{
	bool found = !names || !*names;
	for (; names && *names && !found; names++)
		found = !strcmp(*names, name);
	return found;
}

/* Real state that has data: what all particles share stays as it is, and so do the places of what does not move. */
static bool takes(const struct pm_perturb *p, const struct pm_frame *f, const struct pm_field *field)
{
	const struct pm_set *set = pm_frame_set(f, field->on);
	return field->role == PM_STATE && (field->type == PM_F64 || field->type == PM_F32) && !field->uniform && !(set && set->fixed) &&
		listed(p->on, field->on) && listed(p->fields, field->name);
}

int pm_perturb_declare(const struct pm_perturb *p, struct pm_frame *f)
{
	int n = 0;
	if (f->substep)
		return pm_fail(PM_DATA, "in the middle of a step (substep %d): registers and rates would belong to another state", f->substep);
	for (size_t i = 0; i < f->nfields; i++)
		if (takes(p, f, f->fields[i]))
			n++;
	for (size_t i = 0, left = f->nfields; i < left;) /* a changed field goes to the end of the list */
		if (takes(p, f, f->fields[i]) && !(f->fields[i]->use & PM_USE_CHANGE)) {
			if (!pm_changes(f, f->fields[i]->on, f->fields[i]->name))
				return -PM_DATA;
			left--;
		} else {
			i++;
		}
	for (size_t i = 0; i < f->nsets && n; i++)
		if (pm_frame_field(f, f->sets[i]->name, "id") && !pm_reads(f, f->sets[i]->name, "id"))
			return -PM_DATA;
	const int status = n ? pm_frame_outdate(f) : 0;
	return status ? status : n;
}

static double moved(const struct pm_perturb *p, const struct pm_field *field, double x, bool up)
{
	if (x == 0)
		return x;
	if (p->relative != 0)
		return x * (1 + (up ? p->relative : -p->relative));
	return field->type == PM_F32 ? (double)nextafterf((float)x, up ? HUGE_VALF : -HUGE_VALF) : nextafter(x, up ? HUGE_VAL : -HUGE_VAL);
}

static void perturb(const struct pm_perturb *p, const struct pm_frame *f, struct pm_field *field)
{
	const struct pm_field *number = pm_frame_field(f, field->on, "id");
	const int64_t *id = number && pm_frame_set(f, field->on) ? pm_in_i64(number, 0) : NULL;
	const uint64_t key = pm_walk_key(pm_walk_key(p->seed, field->on), field->name);
	for (int c = 0; c < field->components; c++) {
		double *x = pm_out(field, c);
#pragma omp parallel for schedule(static) if (field->count > 4096)
		for (size_t i = 0; i < field->count; i++) {
			double u[2];
			pm_random(key, id ? (uint64_t)id[i] : i, (uint64_t)c, u);
			x[i] = moved(p, field, x[i], u[0] < 0.5);
		}
	}
}

void pm_perturb_apply(const struct pm_perturb *p, struct pm_frame *f)
{
	for (size_t i = 0; i < f->nfields; i++) {
		struct pm_field *field = f->fields[i];
		if (!(field->use & PM_USE_CHANGE))
			continue;
		perturb(p, f, field);
		if (pm_frame_set(f, field->on) && !strcmp(field->name, "x")) {
			double *x[3] = {NULL, NULL, NULL};
			for (int c = 0; c < f->dim && c < field->components; c++)
				x[c] = pm_out(field, c);
			pm_walk_faces(f, field->count, x);
		}
	}
}
