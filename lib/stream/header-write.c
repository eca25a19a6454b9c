/* Writes the JSON header of a frame; values equal to their default are omitted. SPDX-License-Identifier: GPL-3.0-or-later */
#include <stdlib.h>
#include <string.h>

#include "stream/frame-time.h"
#include "stream/header.h"

char *pm_json_line(const json_t *j) { return json_dumps(j, JSON_SORT_KEYS | JSON_COMPACT | JSON_REAL_PRECISION(17) | JSON_ENCODE_ANY); }

size_t pm_field_wire(const struct pm_field *field)
{
	return field->uniform ? 0 : field->count * (size_t)field->components * pm_type_size(field->type);
}

static json_t *reals(const double *x, int n)
{
	json_t *a = json_array();
	for (int i = 0; i < n; i++)
		json_array_append_new(a, json_real(x[i])); /* NULL for NaN and infinities, so the array is too short, which is detected */
	return a;
}

static json_t *field_json(const struct pm_field *p)
{
	json_t *j = json_copy(p->more);
	json_object_set_new(j, "name", json_string(p->name));
	json_object_set_new(j, "on", json_string(p->on));
	json_object_set_new(j, "components", json_integer(p->components));
	json_object_set_new(j, "type", json_string(pm_type_names[p->type]));
	json_object_set_new(j, "role", json_string(pm_role_names[p->role]));
	json_object_set_new(j, "kind", json_string(pm_kind_names[p->extensive]));
	json_object_set_new(j, "unit", json_string(p->unit));
	if (*p->of)
		json_object_set_new(j, "of", json_string(p->of));
	if (*p->kernel)
		json_object_set_new(j, "kernel", json_string(p->kernel));
	if (p->interlaced)
		json_object_set_new(j, "interlaced", json_true());
	if (p->outside)
		json_object_set_new(j, "outside", json_string(pm_outside_names[p->outside]));
	if (p->rim)
		json_object_set_new(j, "rim", json_integer(p->rim));
	if (p->uniform)
		json_object_set_new(j, "uniform", reals(p->value, p->components));
	if (p->nterms) {
		json_t *terms = json_array();
		for (int i = 0; i < p->nterms; i++)
			json_array_append_new(terms, json_string(p->terms[i]));
		json_object_set_new(j, "terms", terms);
	}
	bool any = false;
	json_t *half = json_array();
	for (int c = 0; c < p->components; c++) {
		json_array_append_new(half, json_pack("[i,i,i]", p->staggered[c][0], p->staggered[c][1], p->staggered[c][2]));
		any |= p->staggered[c][0] | p->staggered[c][1] | p->staggered[c][2];
	}
	if (any)
		json_object_set(j, "half", half);
	json_decref(half);
	return j;
}

static json_t *set_json(const struct pm_set *s)
{
	json_t *j = json_copy(s->more);
	json_object_set_new(j, "name", json_string(s->name));
	json_object_set_new(j, "n", json_integer((json_int_t)s->n));
	json_object_set_new(j, "done", json_pack("{s:f,s:f}", "kick", s->kick, "drift", s->drift));
	if (s->pass)
		json_object_set_new(j, "stage", json_integer(s->pass));
	if (s->fixed)
		json_object_set_new(j, "fixed", json_true());
	return j;
}

static json_t *mesh_json(const struct pm_mesh *m, int dim)
{
	json_t *j = json_copy(m->more), *cells = json_array();
	for (int a = 0; a < dim; a++)
		json_array_append_new(cells, json_integer((json_int_t)m->cells[a]));
	json_object_set_new(j, "name", json_string(m->name));
	json_object_set_new(j, "cells", cells);
	json_object_set_new(j, "lo", reals(m->lo, dim));
	json_object_set_new(j, "h", reals(m->h, dim));
	return j;
}

static json_t *box_json(const struct pm_frame *f)
{
	json_t *faces = json_array(), *particles = json_array();
	for (int a = 0; a < f->dim; a++) {
		json_array_append_new(faces, json_pack("[s,s]", pm_face_names[f->face[a][0]], pm_face_names[f->face[a][1]]));
		json_array_append_new(particles,
			json_pack("[s,s]", pm_particle_face_names[f->pface[a][0]], pm_particle_face_names[f->pface[a][1]]));
	}
	return json_pack("{s:o,s:o,s:o,s:o}", "lo", reals(f->lo, f->dim), "hi", reals(f->hi, f->dim), "fields", faces, "particles", particles);
}

/* Stores an object under its key, together with its unknown keys. */
static void put_named(json_t *j, const struct pm_frame *f, const char *key, json_t *object)
{
	json_object_update(object, json_object_get(f->inside, key));
	json_object_set_new(j, key, object);
}

/* Left out where it is the frame's own time and step, or where one of these was set by a word that did not renew it. */
static void put_since(json_t *j, const struct pm_frame *f)
{
	if (f->since_step != f->step && pm_frame_since_holds(f))
		put_named(j, f, "since", json_pack("{s:f,s:I}", "time", f->since_time, "step", (json_int_t)f->since_step));
}

static bool header_finite(const struct pm_frame *f)
{
	bool good = isfinite(f->time) && isfinite(f->dt) && isfinite(f->start);
	for (int a = 0; a < f->dim; a++)
		good = good && isfinite(f->lo[a]) && isfinite(f->hi[a]);
	for (size_t i = 0; i < f->nmeshes; i++)
		for (int a = 0; a < f->dim; a++)
			good = good && isfinite(f->meshes[i]->lo[a]) && isfinite(f->meshes[i]->h[a]);
	for (size_t i = 0; i < f->nfields; i++)
		for (int c = 0; f->fields[i]->uniform && c < f->fields[i]->components; c++)
			good = good && isfinite(f->fields[i]->value[c]);
	return good;
}

static bool is_utf8(const char *name)
{
	json_t *j = json_string(name);
	json_decref(j);
	return j != NULL;
}

static bool names_utf8(const struct pm_frame *f)
{
	bool good = is_utf8(f->law) && is_utf8(f->scene);
	for (size_t i = 0; i < f->nsets; i++)
		good = good && is_utf8(f->sets[i]->name);
	for (size_t i = 0; i < f->nmeshes; i++)
		good = good && is_utf8(f->meshes[i]->name);
	for (size_t i = 0; i < f->nfields; i++)
		good = good && is_utf8(f->fields[i]->name) && is_utf8(f->fields[i]->on) && is_utf8(f->fields[i]->unit);
	return good;
}

json_t *pm_header_json(const struct pm_frame *f)
{
	if (!header_finite(f)) {
		pm_fail(PM_NUMERICS, "a number of the header is not finite (time, dt, box, mesh or a uniform field)");
		return NULL;
	}
	if (!names_utf8(f)) {
		pm_fail(PM_DATA, "a name or unit is not UTF-8");
		return NULL;
	}
	json_t *j = json_copy(f->more), *sets = json_array(), *meshes = json_array(), *fields = json_array();
	for (size_t i = 0; i < f->nsets; i++)
		json_array_append_new(sets, set_json(f->sets[i]));
	for (size_t i = 0; i < f->nmeshes; i++)
		json_array_append_new(meshes, mesh_json(f->meshes[i], f->dim));
	for (size_t i = 0; i < f->nfields; i++)
		json_array_append_new(fields, field_json(f->fields[i]));
	json_object_set_new(j, "byte_order", json_string("little"));
	json_object_set_new(j, "dim", json_integer(f->dim));
	put_named(j, f, "law", json_pack("{s:s,s:O}", "name", f->law, "constants", f->constants));
	put_named(j, f, "scene", json_pack("{s:s,s:O}", "name", f->scene, "parameters", f->parameters));
	json_object_set_new(j, "time", json_real(f->time));
	json_object_set_new(j, "dt", json_real(f->dt));
	if (f->substep)
		json_object_set_new(j, "start", json_real(f->start));
	put_since(j, f);
	json_object_set_new(j, "step", json_integer(f->step));
	json_object_set_new(j, "substep", json_integer(f->substep));
	json_object_set_new(j, "seed", json_integer((json_int_t)f->seed));
	put_named(j, f, "box", box_json(f));
	json_object_set(j, "history", f->history);
	json_object_set_new(j, "sets", sets);
	json_object_set_new(j, "meshes", meshes);
	json_object_set_new(j, "fields", fields);
	return j;
}
