/* The functions with which a stage declares what it does with the fields; the order of the fields in the stream follows from them.
 * SPDX-License-Identifier: GPL-3.0-or-later */
#include <stdlib.h>
#include <string.h>

#include "stream/declare.h"
#include "stream/list.h"

struct pm_field *pm_reads(struct pm_frame *f, const char *on, const char *name)
{
	struct pm_field *field = pm_frame_field(f, on, name);
	if (!field) {
		pm_fail(PM_DATA, "no field '%s' on '%s'", name, on);
		return NULL;
	}
	field->use |= PM_USE_READ;
	return field;
}

struct pm_field *pm_changes(struct pm_frame *f, const char *on, const char *name)
{
	struct pm_field *field = pm_reads(f, on, name);
	if (!field)
		return NULL;
	if (!(field->use & (PM_USE_CHANGE | PM_USE_NEW))) { /* to the end of the list: fields that a stage changes are written last */
		pm_list_remove((void **)f->fields, &f->nfields, field);
		f->fields[f->nfields++] = field;
	}
	json_object_del(field->more, PM_DIFFERENCES);
	field->use |= PM_USE_CHANGE;
	field->use |= field->uniform ? PM_USE_FROM_VALUE : 0;
	field->uniform = false;
	return field;
}

static size_t count_on(const struct pm_frame *f, const char *on, bool *found)
{
	const struct pm_set *s = pm_frame_set(f, on);
	const struct pm_mesh *m = pm_frame_mesh(f, on);
	size_t points[3];
	*found = s || m;
	return s ? s->n : m ? pm_mesh_points(f, m, points) : 0;
}

struct pm_field *pm_makes(struct pm_frame *f, const char *on, const char *name, int components, enum pm_role role)
{
	bool found;
	size_t count = count_on(f, on, &found);
	if (!found) {
		pm_fail(PM_DATA, "no set or mesh '%s' to put '%s' on", on, name);
		return NULL;
	}
	struct pm_field *old = pm_frame_field(f, on, name), *field = calloc(1, sizeof *field);
	if (!field || !pm_list_add((void ***)&f->fields, &f->nfields, field)) {
		free(field);
		pm_no_memory();
		return NULL;
	}
	if (old)
		pm_drops(f, old);
	pm_name_copy(field->name, name);
	pm_name_copy(field->on, on);
	field->components = components;
	field->role = role;
	field->count = count;
	field->use = PM_USE_NEW;
	field->more = json_object();
	return field;
}

static bool has_term(const struct pm_field *field, const char *term)
{
	for (int i = 0; i < field->nterms; i++)
		if (!strcmp(field->terms[i], term))
			return true;
	return false;
}

struct pm_field *pm_contributes(struct pm_frame *f, const char *on, const char *name, const char *of, int components, const char *term, bool replace)
{
	struct pm_field *field = pm_frame_field(f, on, name);
	const struct pm_set *set = pm_frame_set(f, on);
	if (field && has_term(field, term) && !replace && set && set->kick > 0 && set->drift == 0) {
		pm_fail(PM_DATA, "'%s' on '%s' already holds the term '%s', and nothing has moved since the kick that used it (push drift is missing before "
			"this word; --replace computes it again)", name, on, term);
		return NULL;
	}
	if (field && has_term(field, term) && !replace) {
		pm_fail(PM_DATA, "'%s' on '%s' already holds the term '%s' (--replace computes it again, push clear drops it)", name, on, term);
		return NULL;
	}
	if (field && replace && field->nterms > has_term(field, term)) {
		pm_fail(PM_DATA, "--replace would lose the other terms of '%s' on '%s' (drop them with push clear, then compute all of them)", name, on);
		return NULL;
	}
	if (field && !replace && field->role != PM_CHANGE) {
		pm_fail(PM_DATA, "'%s' on '%s' has the role %s, not change (rename it)", name, on, pm_role_names[field->role]);
		return NULL;
	}
	if (field && !replace && field->components != components) {
		pm_fail(PM_DATA, "'%s' on '%s' has %d components, %d would be added", name, on, field->components, components);
		return NULL;
	}
	field = field && !replace ? pm_changes(f, on, name) : pm_makes(f, on, name, components, PM_CHANGE);
	if (!field)
		return NULL;
	if (field->nterms == PM_TERMS) {
		pm_fail(PM_DATA, "'%s' on '%s' already holds %d terms, the most there can be", name, on, PM_TERMS);
		return NULL;
	}
	pm_name_copy(field->of, of);
	pm_name_copy(field->terms[field->nterms++], term);
	return field;
}

void pm_drops(struct pm_frame *f, struct pm_field *field)
{
	if (!field)
		return;
	if (pm_list_add((void ***)&f->dropped, &f->ndropped, field)) /* else there is a message, and the field stays */
		pm_list_remove((void **)f->fields, &f->nfields, field);
}

void pm_drops_roles(struct pm_frame *f, const char *on, unsigned roles)
{
	for (size_t i = f->nfields; i-- > 0;) {
		struct pm_field *field = f->fields[i];
		bool here = on ? !strcmp(field->on, on) : pm_frame_mesh(f, field->on) != NULL;
		if (here && roles >> field->role & 1)
			pm_drops(f, field);
	}
}
