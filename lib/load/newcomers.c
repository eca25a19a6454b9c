/* New particles have x, v, mass, charge and id, as those of species; a set with other fields is refused. Cost: the new ones, and a pass over ids.
 * SPDX-License-Identifier: GPL-3.0-or-later */
#include <stdio.h>
#include <string.h>

#include "load/newcomers.h"
#include "push/push-set.h"
#include "stream/declare.h"

static bool alike(double a, double b) { return fabs(a - b) <= 1e-12 * fabs(b); }

static int make_set(struct pm_frame *f, const struct pm_newcomers *a)
{
	static const struct { const char *name, *unit; } row[] = {{"x", "length"}, {"v", "length/time"}, {"mass", "mass"}, {"charge", "charge"}, {"id", ""}};
	const int components[] = {f->dim, a->velocities, 1, 1, 1};
	if (!pm_frame_set(f, a->set) && !pm_frame_set_new(f, a->set, 0))
		return -PM_DATA;
	for (int i = 0; i < 5; i++) {
		const struct pm_field *old = pm_frame_field(f, a->set, row[i].name);
		struct pm_field *field = pm_makes(f, a->set, row[i].name, i == 1 && old ? old->components : components[i], PM_STATE);
		if (!field)
			return -PM_DATA;
		snprintf(field->unit, sizeof field->unit, "%s", row[i].unit);
		field->type = i == 4 ? PM_I64 : PM_F64;
		field->extensive = i == 2 || i == 3;
		field->uniform = field->extensive && a->equal;
		field->value[0] = i == 2 ? a->mass : a->charge;
	}
	return 0;
}

/* The fields of a set that has particles: all are held, and those of new values made one a particle. */
static int grow(struct pm_frame *f, const struct pm_newcomers *a, struct pm_set *set)
{
	static const char *const own[] = {"x", "v", "mass", "charge", "id", NULL};
	const struct pm_moving m = {.set = set};
	for (size_t i = 0; i < f->nfields; i++) {
		const struct pm_field *field = f->fields[i];
		bool known = strcmp(field->on, a->set) != 0 || field->uniform;
		for (int k = 0; own[k]; k++)
			known = known || !strcmp(field->name, own[k]);
		if (!known)
			return pm_fail(PM_DATA, "new particles have no '%s', which '%s' has (sel --drop %s)", field->name, a->set, field->name);
	}
	for (int k = 0; own[k]; k++) {
		const struct pm_field *field = pm_frame_field(f, a->set, own[k]);
		if (!field)
			return pm_fail(PM_DATA, "'%s' has no '%s' (species makes sets with x, v, mass, charge and id)", a->set, own[k]);
		const bool strength = k == 2 || k == 3;
		if (field->uniform && (!strength || !a->equal || !alike(field->value[0], k == 2 ? a->mass : a->charge)) && !pm_changes(f, a->set, own[k]))
			return -PM_DATA;
	}
	return pm_moving_shrinks(f, &m);
}

int pm_newcomers_declare(struct pm_frame *f, const struct pm_newcomers *a)
{
	struct pm_set *set = pm_frame_set(f, a->set);
	if (pm_frame_mesh(f, a->set))
		return pm_fail(PM_DATA, "'%s' is a mesh of this frame (another name)", a->set);
	for (size_t i = 0; i < f->nsets; i++)
		if (pm_frame_field(f, f->sets[i]->name, "id") && !pm_reads(f, f->sets[i]->name, "id"))
			return -PM_DATA;
	return set && set->n ? grow(f, a, set) : make_set(f, a);
}

int pm_newcomers_room(const struct pm_frame *f, struct pm_newcomers *a, uint64_t room)
{
	int status = 0;
	a->room = room;
	for (int d = 0; d < 3 && !status; d++) {
		a->x[d] = d < f->dim ? pm_alloc(room + 1, sizeof(double)) : NULL;
		a->v[d] = d < a->velocities ? pm_alloc(room + 1, sizeof(double)) : NULL;
		status = (d < f->dim && !a->x[d]) || (d < a->velocities && !a->v[d]) ? -PM_DATA : 0;
	}
	if (!status && !a->equal)
		status = (a->m = pm_alloc(room + 1, sizeof(double))) && (a->q = pm_alloc(room + 1, sizeof(double))) ? 0 : -PM_DATA;
	return status;
}

void pm_newcomers_free(struct pm_newcomers *a)
{
	for (int d = 0; d < 3; d++) {
		pm_free(a->x[d]);
		pm_free(a->v[d]);
	}
	pm_free(a->m);
	pm_free(a->q);
}

static int64_t next_id(const struct pm_frame *f)
{
	int64_t most = -1;
	for (size_t k = 0; k < f->nsets; k++) {
		const struct pm_field *id = pm_frame_field(f, f->sets[k]->name, "id");
		if (!id || id->type != PM_I64 || !id->count)
			continue;
		const int64_t *number = pm_in_i64(id, 0);
#pragma omp parallel for schedule(static) reduction(max:most) if (id->count > 16384)
		for (size_t i = 0; i < id->count; i++)
			most = number[i] > most ? number[i] : most;
	}
	return most + 1;
}

int pm_newcomers_append(const struct pm_newcomers *a, struct pm_frame *f)
{
	struct pm_set *set = pm_frame_set(f, a->set);
	const uint64_t old = set->n;
	const int64_t first = next_id(f);
	if (pm_frame_set_resize(f, set, old + a->n))
		return -PM_DATA;
	struct pm_field *x = pm_frame_field(f, a->set, "x"), *v = pm_frame_field(f, a->set, "v"), *id = pm_frame_field(f, a->set, "id");
	for (int d = 0; d < f->dim; d++)
		memcpy(pm_out(x, d) + old, a->x[d], a->n * sizeof(double));
	for (int d = 0; d < a->velocities; d++)
		memcpy(pm_out(v, d) + old, a->v[d], a->n * sizeof(double));
	for (uint64_t i = 0; i < a->n; i++)
		pm_out_i64(id, 0)[old + i] = first + (int64_t)i;
	for (int k = 0; k < 2; k++) {
		struct pm_field *strength = pm_frame_field(f, a->set, k ? "charge" : "mass");
		const double *each = k ? a->q : a->m;
		double *value = strength->uniform ? NULL : pm_out(strength, 0);
		for (uint64_t i = 0; value && i < a->n; i++)
			value[old + i] = each ? each[i] : k ? a->charge : a->mass;
	}
	return 0;
}
