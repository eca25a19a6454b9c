/* Joint frames share the buffers of those that they are made of. SPDX-License-Identifier: GPL-3.0-or-later */
#include <stdio.h>
#include <string.h>

#include "stream/joint-frame.h"
#include "stream/list.h"
#include "stream/run.h"

static struct pm_field *add(struct pm_frame *joint, const struct pm_field *field, const char *what, int number)
{
	struct pm_field *p = field ? pm_field_copy(field, true) : NULL;
	if (!p || !pm_list_add((void ***)&joint->fields, &joint->nfields, p))
		return pm_field_free(p);
	snprintf(p->name, PM_NAME, "%s%d", what, number);
	return p;
}

struct pm_frame *pm_joint_frame(const struct pm_frame *f, const struct pm_frame *g, struct pm_field *const a[], struct pm_field *const b[], int n, bool ids)
{
	const char *on = a[0]->on;
	const struct pm_mesh *m = pm_frame_mesh(f, on);
	const struct pm_set *set = pm_frame_set(f, on);
	struct pm_frame *joint = pm_frame_new(f->dim);
	bool good = joint != NULL;
	if (good) {
		memcpy(joint->lo, f->lo, sizeof f->lo), memcpy(joint->hi, f->hi, sizeof f->hi);
		memcpy(joint->face, f->face, sizeof f->face), memcpy(joint->pface, f->pface, sizeof f->pface);
		pm_frame_parameter_set(joint, PM_JOINT_PAIRS, n), pm_frame_parameter_set(joint, PM_JOINT_IDS, ids);
		struct pm_mesh *mesh = set ? NULL : pm_frame_mesh_new(joint, on, m->cells);
		good = set ? pm_frame_set_new(joint, on, set->n) != NULL : mesh != NULL;
		if (mesh)
			memcpy(mesh->lo, m->lo, sizeof m->lo), memcpy(mesh->h, m->h, sizeof m->h);
	}
	for (int i = 0; i < n && good; i++)
		good = add(joint, a[i], "a", i) && add(joint, b[i], "b", i);
	if (good && ids)
		good = add(joint, pm_frame_field(f, on, "id"), "id", 1) && add(joint, pm_frame_field(g, on, "id"), "id", 2);
	if (!good)
		pm_no_memory();
	return good ? joint : pm_frame_free(joint);
}

struct pm_frame *pm_joint_check(const struct pm_frame *f)
{
	struct pm_frame *c = pm_frame_copy(f);
	for (size_t i = f->nfields; c && i-- > 0;)
		if (!f->fields[i]->use) {
			struct pm_field *gone = c->fields[i];
			pm_list_remove((void **)c->fields, &c->nfields, gone);
			pm_field_free(gone);
		}
	if (c)
		pm_frame_parameter_set(c, PM_JOINT_PAIRS, 0);
	return c;
}

struct pm_field *pm_field_copy_here(const struct pm_field *field)
{
	struct pm_field *c = pm_field_copy(field, false);
	if (!c)
		return NULL;
	c->uniform = false;
	c->use = PM_USE_NEW | PM_USE_FILL;
	if (pm_field_ready(c))
		return pm_field_free(c);
	const size_t size = pm_field_memory(field);
	for (int k = 0; k < field->components; k++)
		memcpy(size == 1 ? (void *)pm_out_u8(c, k) : (void *)pm_out(c, k), size == 1 ? (const void *)pm_in_u8(field, k) : (const void *)pm_in(field, k),
			field->count * size);
	return c;
}

struct pm_field *pm_field_copy_free(struct pm_field *field) { return pm_field_free(field); }
