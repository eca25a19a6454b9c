/* Frames in memory: making, copying, looking up, changing their size.
 * SPDX-License-Identifier: GPL-3.0-or-later */
#include <stdlib.h>
#include <string.h>

#include "stream/header.h"
#include "stream/later.h"
#include "stream/list.h"
#include "stream/run.h"

const char *const pm_kind_names[] = {"value", "strength", NULL};
const char *const pm_outside_names[] = {"monopole", "drop", "error", NULL};
const char *const pm_type_names[] = {"f64", "f32", "i64", "u8", NULL};
const char *const pm_role_names[] = {"state", "change", "derived", "register", NULL};
const char *const pm_face_names[] = {"periodic", "open", "wall", "neumann", "absorbing", NULL};
const char *const pm_particle_face_names[] = {"periodic", "reflect", "absorb", "open", NULL};

size_t pm_type_size(enum pm_type type) { return type == PM_U8 ? 1 : type == PM_F32 ? 4 : 8; }

struct pm_frame *pm_frame_new(int dim)
{
	struct pm_frame *f = calloc(1, sizeof *f);
	if (!f) {
		pm_no_memory();
		return NULL;
	}
	f->dim = dim;
	pm_name_copy(f->law, "free");
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
		pm_no_memory();
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
	bool good = true;
	for (size_t i = 0; i < f->nsets && good; i++) {
		struct pm_set *s = pm_frame_set_new(c, "", 0);
		if (!(good = s != NULL))
			break;
		json_decref(s->more);
		*s = *f->sets[i];
		s->more = json_deep_copy(s->more);
	}
	for (size_t i = 0; i < f->nmeshes && good; i++) {
		struct pm_mesh *m = pm_frame_mesh_new(c, "", f->meshes[i]->cells);
		if (!(good = m != NULL))
			break;
		json_decref(m->more);
		*m = *f->meshes[i];
		m->more = json_deep_copy(m->more);
	}
	for (size_t i = 0; i < f->nfields && good; i++) {
		struct pm_field *p = pm_field_copy(f->fields[i], with_data);
		if (!(good = p && pm_list_add((void ***)&c->fields, &c->nfields, p)))
			pm_field_free(p);
	}
	if (!good)
		pm_frame_free(c);
	return good ? c : NULL;
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

bool pm_set_moves(const struct pm_frame *f, const struct pm_set *set)
{
	const struct pm_field *x = pm_frame_field(f, set->name, "x");
	return !set->fixed && x && x->role == PM_STATE;
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
	if (!s || !pm_list_add((void ***)&f->sets, &f->nsets, s)) {
		free(s);
		pm_no_memory();
		return NULL;
	}
	pm_name_copy(s->name, name);
	s->n = n;
	s->more = json_object();
	return s;
}

struct pm_mesh *pm_frame_mesh_new(struct pm_frame *f, const char *name, const size_t cells[3])
{
	struct pm_mesh *m = calloc(1, sizeof *m);
	if (!m || !pm_list_add((void ***)&f->meshes, &f->nmeshes, m)) {
		free(m);
		pm_no_memory();
		return NULL;
	}
	pm_name_copy(m->name, name);
	for (int a = 0; a < 3; a++) {
		m->cells[a] = a < f->dim ? cells[a] : 1;
		m->lo[a] = a < f->dim ? f->lo[a] : 0;
		m->h[a] = a < f->dim ? (f->hi[a] - f->lo[a]) / (double)cells[a] : 1;
	}
	m->more = json_object();
	return m;
}

/* Of two sources the stricter; with other sets in one than in the other it is not known what makes the field. */
static void inherit_sources(struct pm_field *field, const struct pm_field *from)
{
	const bool first = !*field->kernel, same = field->nterms == from->nterms && !memcmp(field->terms, from->terms, sizeof field->terms);
	field->outside = from->outside > field->outside ? from->outside : field->outside;
	field->rim = first || from->rim > field->rim ? from->rim : field->rim;
	if (from->role == PM_DERIVED && first) {
		memcpy(field->terms, from->terms, sizeof field->terms);
		field->nterms = from->nterms;
	} else if (!same || (!first && field->rim != from->rim)) {
		field->outside = PM_OUTSIDE_ERROR;
	}
}

void pm_field_inherit(struct pm_field *field, const struct pm_field *from)
{
	const bool differs = strcmp(field->kernel, from->kernel) || field->interlaced != from->interlaced;
	if (field->role == PM_DERIVED && *from->kernel)
		inherit_sources(field, from);
	if (*field->kernel && *from->kernel && differs) {
		pm_name_copy(field->kernel, "several");
		field->interlaced = false;
	} else if (*from->kernel) {
		memcpy(field->kernel, from->kernel, sizeof field->kernel);
		field->interlaced = from->interlaced;
	}
}

struct pm_field *pm_frame_field(const struct pm_frame *f, const char *on, const char *name)
{
	for (size_t i = 0; i < f->nfields; i++)
		if (f->fields[i]->name[0] == name[0] && !strcmp(f->fields[i]->name, name) && !strcmp(f->fields[i]->on, on)) /* a letter is enough for most */
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

/* What a header of a few hundred bytes may become: particles or points of which nothing but uniform values came along. */
static double most_from_nothing(void)
{
	const char *given = getenv("PM_EXPAND_GB");
	double gigabytes = given ? strtod(given, NULL) : 0;
	return gigabytes > 0 ? gigabytes * 1e9 : 4e9;
}

static int affordable_on(const struct pm_frame *f, const char *on)
{
	double bytes = 0;
	bool any = false;
	for (size_t i = 0; i < f->nfields + f->ndropped; i++) {
		const struct pm_field *p = i < f->nfields ? f->fields[i] : f->dropped[i - f->nfields];
		if (strcmp(p->on, on))
			continue;
		bool from_value = p->use & PM_USE_FROM_VALUE || (p->uniform && !(p->use & PM_USE_NEW));
		any |= from_value;
		if (!from_value && !(p->use & PM_USE_NEW))
			return 0; /* its data came along */
		if (!p->buffer && p->use & (PM_USE_READ | PM_USE_CHANGE | PM_USE_NEW) && !(p->use & PM_USE_NEW && p->uniform))
			bytes += (double)p->count * p->components * (double)pm_field_memory(p);
	}
	return !any || bytes <= most_from_nothing() ? 0
		: pm_fail(PM_DATA, "'%s' has uniform values only, and %.1f GB would be made of them (PM_EXPAND_GB=%.0f in the environment allows it)", on,
			bytes / 1e9, ceil(bytes / 1e9));
}

int pm_frame_affordable(const struct pm_frame *f)
{
	int status = 0;
	for (size_t i = 0; i < f->nsets && !status; i++)
		status = affordable_on(f, f->sets[i]->name);
	for (size_t i = 0; i < f->nmeshes && !status; i++)
		status = affordable_on(f, f->meshes[i]->name);
	return status;
}

int pm_frame_ready(struct pm_frame *f)
{
	for (size_t i = 0; i < f->ndropped; i++)
		if (!f->dropped[i]->use && pm_field_later_of(f->dropped[i]))
			pm_field_forget(f->dropped[i]); /* it holds others, which may be changed */
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

int pm_frame_mesh_resize(struct pm_frame *f, const struct pm_mesh *m)
{
	size_t points[3], n = pm_mesh_points(f, m, points);
	for (size_t i = 0; i < f->nfields; i++) {
		struct pm_field *field = f->fields[i];
		if (strcmp(field->on, m->name))
			continue;
		if (!field->uniform)
			return pm_fail(PM_DATA, "mesh '%s' has the %s field '%s', which cannot be moved to other points (only uniform fields can; drop it "
				"with sel)", m->name, pm_role_names[field->role], field->name);
		int status = pm_field_resize(field, n);
		if (status)
			return status;
	}
	return 0;
}
