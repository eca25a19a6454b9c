/* Changes to the header of a frame that affect several fields. SPDX-License-Identifier: GPL-3.0-or-later */
#include <string.h>

#include "stream/edit.h"
#include "stream/run.h"

int pm_frame_rename(struct pm_frame *f, const char *old, const char *new)
{
	struct pm_set *set = pm_frame_set(f, old);
	struct pm_mesh *mesh = pm_frame_mesh(f, old);
	int found = set != NULL || mesh != NULL;
	if (!*new || strlen(new) >= PM_NAME || pm_frame_set(f, new) || pm_frame_mesh(f, new))
		return pm_fail(PM_DATA, "--rename: '%s' cannot be the new name of '%s' (it is in use, empty or longer than 63 bytes)", new, old);
	for (size_t i = 0; i < f->nfields; i++) {
		struct pm_field *p = f->fields[i];
		if (found && !strcmp(p->on, old))
			strcpy(p->on, new);
		else if (!found && !strcmp(p->name, old) && pm_frame_field(f, p->on, new))
			return pm_fail(PM_DATA, "--rename: '%s' has a field '%s' already", p->on, new);
	}
	for (size_t i = 0; i < f->nfields && !set && !mesh; i++)
		if (!strcmp(f->fields[i]->name, old))
			strcpy(f->fields[i]->name, new), found = 1;
	if (set)
		strcpy(set->name, new);
	if (mesh)
		strcpy(mesh->name, new);
	return found ? 0 : pm_fail(PM_DATA, "--rename: there is no '%s' (sls lists what there is)", old);
}

int pm_frame_meshes_free(const struct pm_frame *f)
{
	for (size_t i = 0; i < f->nfields; i++)
		if (pm_frame_mesh(f, f->fields[i]->on) && f->fields[i]->role == PM_STATE)
			return pm_fail(PM_DATA, "the mesh field '%s' is state and cannot be kept in a new box or with new faces (sel --drop leaves it out)",
				f->fields[i]->name);
	return 0;
}

int pm_frame_outdate(struct pm_frame *f)
{
	const unsigned roles = 1u << PM_CHANGE | 1u << PM_DERIVED;
	if (f->substep)
		return pm_fail(PM_DATA, "particles, box and law can change only between steps (substep %d here)", f->substep);
	for (size_t i = 0; i < f->nsets; i++)
		pm_drops_roles(f, f->sets[i]->name, roles);
	pm_drops_roles(f, NULL, roles);
	return 0;
}

int pm_frame_store(struct pm_frame *f, const char *choice)
{
	const char *sign = strchr(choice, '='), *type = sign ? sign + 1 : choice;
	enum pm_type to = !strcmp(type, "f32") ? PM_F32 : PM_F64;
	bool found = !sign;
	for (size_t k = 0, n = f->nfields; k < n;) {
		struct pm_field *p = f->fields[k];
		bool mine = !sign || (strlen(p->name) == (size_t)(sign - choice) && !strncmp(p->name, choice, strlen(p->name)));
		bool real = p->type == PM_F64 || p->type == PM_F32;
		found |= mine;
		if (mine && !real && sign)
			return pm_fail(PM_DATA, "'%s' holds integers, which --store cannot change", p->name);
		if (mine && real && p->type != to && !p->uniform && !(p->use & PM_USE_CHANGE))
			pm_changes(f, p->on, p->name), n--;
		else
			k++;
		if (mine && real)
			p->type = to;
		for (int j = 0; mine && real && to == PM_F32 && p->uniform && j < p->components; j++) {
			p->value[j] = (float)p->value[j];
			pm_field_forget(p);
		}
	}
	if (!found)
		return pm_fail(PM_DATA, "no field '%.*s' to store (sls lists what there is)", (int)(sign - choice), choice);
	return 0;
}

void pm_uniform_scale(struct pm_field *field, double by)
{
	for (int i = 0; i < field->components; i++) {
		field->value[i] *= by;
		field->value[i] = field->type == PM_F32 ? (float)field->value[i] : field->value[i];
	}
	pm_field_forget(field);
}

void pm_frame_stretch(struct pm_frame *f, double by)
{
	for (int a = 0; a < f->dim; a++) {
		f->lo[a] *= by, f->hi[a] *= by;
		for (size_t i = 0; i < f->nmeshes; i++)
			f->meshes[i]->lo[a] *= by, f->meshes[i]->h[a] *= by;
	}
}
