/* Frames in memory: making, copying, looking up, and the declarations by which a stage says what it does with the fields.
 * SPDX-License-Identifier: GPL-3.0-or-later */
#include <stdlib.h>
#include <string.h>

#include "stream/frame.h"

const char *const pm_type_names[] = {"f64", "f32", "i64", "u8", NULL};
const char *const pm_role_names[] = {"state", "change", "derived", "register", NULL};
const char *const pm_face_names[] = {"periodic", "open", "wall", "neumann", "absorbing", NULL};
const char *const pm_particle_face_names[] = {"periodic", "reflect", "absorb", "open", NULL};

size_t pm_type_size(enum pm_type type) { return type == PM_U8 ? 1 : type == PM_F32 ? 4 : 8; }

/* Names are cut, never overrun; the readers refuse longer ones before they get here. */
static void name_copy(char to[PM_NAME], const char *from)
{
	snprintf(to, PM_NAME, "%s", from);
}

static void *list_add(void ***list, size_t *n, void *item)
{
	if ((*n & (*n - 1)) == 0) { /* room for the next power of two */
		void **more = realloc(*list, (*n ? 2 * *n : 1) * sizeof *more);
		if (!more) {
			pm_fail(PM_DATA, "out of memory");
			return NULL;
		}
		*list = more;
	}
	(*list)[(*n)++] = item;
	return item;
}

static void list_remove(void **list, size_t *n, const void *item)
{
	size_t i = 0;
	while (i < *n && list[i] != item)
		i++;
	if (i == *n)
		return;
	memmove(list + i, list + i + 1, (*n - i - 1) * sizeof *list);
	--*n;
	/* list_add doubles at powers of two; shrinking below one and growing again only reallocates to a size at least as large as needed */
}

struct pm_frame *pm_frame_new(int dim)
{
	struct pm_frame *f = calloc(1, sizeof *f);
	if (!f) {
		pm_fail(PM_DATA, "out of memory");
		return NULL;
	}
	f->dim = dim;
	name_copy(f->law, "free");
	f->constants = json_object();
	f->parameters = json_object();
	f->history = json_array();
	f->report = json_object();
	f->more = json_object();
	f->inside = json_object();
	for (int a = 0; a < 3; a++) {
		f->hi[a] = a < dim;
		for (int s = 0; s < 2; s++)
			f->face[a][s] = PM_OPEN, f->pface[a][s] = PM_POPEN;
	}
	return f;
}

static void frame_lists_free(struct pm_frame *f)
{
	for (size_t i = 0; i < f->nsets; i++)
		json_decref(f->sets[i]->more), free(f->sets[i]);
	for (size_t i = 0; i < f->nmeshes; i++)
		json_decref(f->meshes[i]->more), free(f->meshes[i]);
	for (size_t i = 0; i < f->nfields; i++)
		pm_field_free(f->fields[i]);
	for (size_t i = 0; i < f->ndropped; i++)
		pm_field_free(f->dropped[i]);
	free(f->sets), free(f->meshes), free(f->fields), free(f->dropped);
}

struct pm_frame *pm_frame_free(struct pm_frame *f)
{
	if (!f)
		return NULL;
	frame_lists_free(f);
	json_decref(f->constants), json_decref(f->parameters), json_decref(f->history), json_decref(f->report), json_decref(f->more),
		json_decref(f->inside);
	free(f);
	return NULL;
}

static struct pm_frame *copy(const struct pm_frame *f, bool with_data)
{
	struct pm_frame *c = malloc(sizeof *c);
	if (!c) {
		pm_fail(PM_DATA, "out of memory");
		return NULL;
	}
	*c = *f;
	c->constants = json_deep_copy(f->constants);
	c->parameters = json_deep_copy(f->parameters);
	c->history = with_data ? json_deep_copy(f->history) : json_array();
	c->report = with_data ? json_deep_copy(f->report) : json_object();
	c->more = json_deep_copy(f->more);
	c->inside = json_deep_copy(f->inside);
	c->nsets = c->nmeshes = c->nfields = c->ndropped = 0;
	c->sets = NULL, c->meshes = NULL, c->fields = c->dropped = NULL;
	for (size_t i = 0; i < f->nsets; i++) {
		struct pm_set *s = pm_frame_set_new(c, "", 0);
		*s = *f->sets[i];
		s->more = json_deep_copy(s->more);
	}
	for (size_t i = 0; i < f->nmeshes; i++) {
		struct pm_mesh *m = malloc(sizeof *m);
		*m = *f->meshes[i];
		m->more = json_deep_copy(m->more);
		list_add((void ***)&c->meshes, &c->nmeshes, m);
	}
	for (size_t i = 0; i < f->nfields; i++)
		list_add((void ***)&c->fields, &c->nfields, pm_field_copy(f->fields[i], with_data));
	return c;
}

struct pm_frame *pm_frame_copy(const struct pm_frame *f) { return copy(f, true); }

struct pm_frame *pm_frame_header(const struct pm_frame *f) { return copy(f, false); }

struct pm_set *pm_frame_set(const struct pm_frame *f, const char *name)
{
	for (size_t i = 0; i < f->nsets; i++)
		if (!strcmp(f->sets[i]->name, name))
			return f->sets[i];
	return NULL;
}

struct pm_mesh *pm_frame_mesh(const struct pm_frame *f, const char *name)
{
	for (size_t i = 0; i < f->nmeshes; i++)
		if (!name || !strcmp(f->meshes[i]->name, name))
			return f->meshes[i];
	return NULL;
}

struct pm_set *pm_frame_set_new(struct pm_frame *f, const char *name, uint64_t n)
{
	struct pm_set *s = calloc(1, sizeof *s);
	if (!s || !list_add((void ***)&f->sets, &f->nsets, s)) {
		free(s);
		return NULL;
	}
	name_copy(s->name, name);
	s->n = n;
	s->more = json_object();
	return s;
}

struct pm_mesh *pm_frame_mesh_new(struct pm_frame *f, const char *name, const size_t cells[3])
{
	struct pm_mesh *m = calloc(1, sizeof *m);
	if (!m || !list_add((void ***)&f->meshes, &f->nmeshes, m)) {
		free(m);
		return NULL;
	}
	name_copy(m->name, name);
	for (int a = 0; a < 3; a++) {
		m->cells[a] = a < f->dim ? cells[a] : 1;
		m->lo[a] = a < f->dim ? f->lo[a] : 0;
		m->h[a] = a < f->dim ? (f->hi[a] - f->lo[a]) / (double)cells[a] : 1;
	}
	m->more = json_object();
	return m;
}

struct pm_field *pm_frame_field(const struct pm_frame *f, const char *on, const char *name)
{
	for (size_t i = 0; i < f->nfields; i++)
		if (!strcmp(f->fields[i]->name, name) && !strcmp(f->fields[i]->on, on))
			return f->fields[i];
	return NULL;
}

size_t pm_mesh_points(const struct pm_frame *f, const struct pm_mesh *m, size_t points[3])
{
	for (int a = 0; a < 3; a++)
		points[a] = a >= f->dim ? 1 : m->cells[a] + (f->face[a][0] != PM_PERIODIC);
	return points[0] * points[1] * points[2];
}

static double number(const json_t *object, const char *name, double otherwise)
{
	const json_t *v = json_object_get(object, name);
	return json_is_number(v) ? json_number_value(v) : otherwise;
}

double pm_frame_constant(const struct pm_frame *f, const char *name, double otherwise) { return number(f->constants, name, otherwise); }

double pm_frame_parameter(const struct pm_frame *f, const char *name, double otherwise) { return number(f->parameters, name, otherwise); }

void pm_frame_constant_set(struct pm_frame *f, const char *name, double value) { json_object_set_new(f->constants, name, json_real(value)); }

void pm_frame_parameter_set(struct pm_frame *f, const char *name, double value) { json_object_set_new(f->parameters, name, json_real(value)); }

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
	if (!(field->use & (PM_USE_CHANGE | PM_USE_NEW))) { /* to the end of the list: what a stage touches travels last */
		list_remove((void **)f->fields, &f->nfields, field);
		f->fields[f->nfields++] = field;
	}
	field->use |= PM_USE_CHANGE;
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
	if (!field || !list_add((void ***)&f->fields, &f->nfields, field)) {
		free(field);
		return NULL;
	}
	if (old)
		pm_drops(f, old);
	name_copy(field->name, name);
	name_copy(field->on, on);
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
	if (field && has_term(field, term) && !replace) {
		pm_fail(PM_DATA, "'%s' on '%s' already holds the term '%s' (--replace computes it anew, push clear drops it)", name, on, term);
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
	name_copy(field->of, of);
	name_copy(field->terms[field->nterms++], term);
	return field;
}

void pm_drops(struct pm_frame *f, struct pm_field *field)
{
	if (!field)
		return;
	list_remove((void **)f->fields, &f->nfields, field);
	list_add((void ***)&f->dropped, &f->ndropped, field);
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

int pm_frame_ready(struct pm_frame *f)
{
	for (size_t i = 0; i < f->nfields; i++)
		if (f->fields[i]->use && pm_field_ready(f->fields[i]))
			return -PM_DATA;
	for (size_t i = 0; i < f->ndropped; i++)
		if (f->dropped[i]->use && pm_field_ready(f->dropped[i]))
			return -PM_DATA;
	return 0;
}

int pm_frame_settle(struct pm_frame *f)
{
	int status = 0;
	for (size_t i = 0; i < f->nfields; i++) {
		int here = pm_field_settle(f->fields[i]);
		status = status ? status : here;
	}
	for (size_t i = 0; i < f->ndropped; i++)
		pm_field_free(f->dropped[i]);
	f->ndropped = 0;
	free(f->dropped);
	f->dropped = NULL;
	return status;
}

int pm_frame_set_resize(struct pm_frame *f, struct pm_set *set, uint64_t n)
{
	set->n = n;
	for (size_t i = 0; i < f->nfields; i++)
		if (!strcmp(f->fields[i]->on, set->name)) {
			int status = pm_field_resize(f->fields[i], n);
			if (status)
				return status;
		}
	return 0;
}
