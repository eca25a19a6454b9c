/* Reads the JSON header of a frame and checks everything: the range of every number, the length of every name, the target of every reference. Only the first
 * error is kept. SPDX-License-Identifier: GPL-3.0-or-later */
#include <stdlib.h>
#include <string.h>

#include "stream/declare.h"
#include "stream/frame-time.h"
#include "stream/header.h"

static const int64_t most_particles = (int64_t)1 << 48, most_cells = (int64_t)1 << 31;
enum { most_objects = 4096 };

struct look {
	json_t *j;        /* a shallow copy, from which known keys are removed */
	const char *what; /* for messages */
	bool bad;
};

static void complain(struct look *l, const char *key, const char *why)
{
	if (!l->bad)
		pm_fail(PM_DATA, "the header is wrong: %s '%s' %s", l->what, key, why);
	l->bad = true;
}

/* Removes a key; the value stays in the original object. */
static const json_t *take(struct look *l, const char *key, bool must)
{
	const json_t *v = json_object_get(l->j, key);
	if (!v && must)
		complain(l, key, "is missing");
	json_object_del(l->j, key); /* borrowed: the original holds it */
	return v;
}

static int64_t take_integer(struct look *l, const char *key, int64_t low, int64_t high, bool must, int64_t otherwise)
{
	const json_t *v = take(l, key, must);
	if (!v)
		return otherwise;
	if (!json_is_integer(v) || json_integer_value(v) < low || json_integer_value(v) > high) {
		complain(l, key, "is not an integer in its range");
		return otherwise;
	}
	return json_integer_value(v);
}

static double take_real(struct look *l, const char *key, bool must, double otherwise)
{
	const json_t *v = take(l, key, must);
	if (v && !json_is_number(v))
		complain(l, key, "is not a number");
	return json_is_number(v) ? json_number_value(v) : otherwise;
}

static void take_name(struct look *l, const char *key, bool must, bool empty, char out[PM_NAME])
{
	const json_t *v = take(l, key, must);
	const char *s = json_is_string(v) ? json_string_value(v) : "";
	if (v && (!json_is_string(v) || json_string_length(v) != strlen(s) || strlen(s) >= PM_NAME || (!empty && !*s)))
		complain(l, key, "is not a name of 1 to 63 bytes");
	else
		snprintf(out, PM_NAME, "%s", s);
}

static int which(const char *s, const char *const *names)
{
	for (int i = 0; s && names[i]; i++)
		if (!strcmp(s, names[i]))
			return i;
	return -1;
}

static int take_choice(struct look *l, const char *key, const char *const *names)
{
	const json_t *v = take(l, key, true);
	int i = which(json_string_value(v), names);
	if (v && i < 0)
		complain(l, key, "is not one of the words allowed");
	return i < 0 ? 0 : i;
}

static void take_reals(struct look *l, const char *key, int n, double *out)
{
	const json_t *v = take(l, key, true);
	if (!v)
		return;
	if (!json_is_array(v) || json_array_size(v) != (size_t)n) {
		complain(l, key, "is not an array of the right length");
		return;
	}
	for (int i = 0; i < n; i++) {
		const json_t *e = json_array_get(v, (size_t)i);
		if (!json_is_number(e))
			complain(l, key, "holds something that is not a number");
		out[i] = json_number_value(e);
	}
}

/* An object that is kept unchanged. */
static void take_object(struct look *l, const char *key, json_t **out)
{
	const json_t *v = take(l, key, false);
	if (v && !json_is_object(v))
		complain(l, key, "is not an object");
	else if (v) {
		json_decref(*out);
		*out = json_deep_copy(v);
	}
}

static struct look look_at(const json_t *j, const char *what)
{
	struct look l = {json_is_object(j) ? json_copy((json_t *)(uintptr_t)j) : NULL, what, false};
	if (!l.j && json_is_object(j))
		l.bad = pm_no_memory() != 0;
	else if (!l.j)
		complain(&l, "", "is not an object");
	return l;
}

/* Keeps the unknown keys of an object in the frame; true if there was no error. */
static bool look_done_inside(struct look *l, struct pm_frame *f, const char *key)
{
	if (json_object_size(l->j))
		json_object_set(f->inside, key, l->j);
	json_decref(l->j);
	return !l->bad;
}

/* Stores the unknown keys with their owner; true if there was no error. */
static bool look_done(struct look *l, json_t **more)
{
	json_decref(*more);
	*more = l->j;
	return !l->bad;
}

static void read_faces(struct look *l, const char *key, int dim, const char *const *names, int out[3][2])
{
	const json_t *v = take(l, key, true);
	for (int a = 0; a < dim && !l->bad; a++)
		for (int s = 0; s < 2; s++) {
			int i = which(json_string_value(json_array_get(json_array_get(v, (size_t)a), (size_t)s)), names);
			if (i < 0)
				complain(l, key, "is not a pair of face words per axis");
			out[a][s] = i < 0 ? 0 : i;
		}
}

static bool read_box(const json_t *j, struct pm_frame *f)
{
	struct look l = look_at(j, "box");
	int faces[3][2], particles[3][2];
	if (!l.j)
		return false;
	take_reals(&l, "lo", f->dim, f->lo);
	take_reals(&l, "hi", f->dim, f->hi);
	read_faces(&l, "fields", f->dim, pm_face_names, faces);
	read_faces(&l, "particles", f->dim, pm_particle_face_names, particles);
	for (int a = 0; a < f->dim && !l.bad; a++) {
		if (!(f->hi[a] > f->lo[a]))
			complain(&l, "hi", "is not above lo");
		if ((faces[a][0] == PM_PERIODIC) != (faces[a][1] == PM_PERIODIC) || (particles[a][0] == PM_PFOLD) != (particles[a][1] == PM_PFOLD))
			complain(&l, "fields", "has an axis with one periodic face");
		for (int s = 0; s < 2; s++)
			f->face[a][s] = (enum pm_face)faces[a][s], f->pface[a][s] = (enum pm_particle_face)particles[a][s];
	}
	return look_done_inside(&l, f, "box");
}

/* For what cannot be made; the message is there (pm_no_memory for one). */
static bool give_up(struct look *l)
{
	json_decref(l->j);
	return false;
}

static bool read_set(const json_t *j, struct pm_frame *f)
{
	struct look l = look_at(j, "set");
	char name[PM_NAME] = "";
	if (!l.j)
		return false;
	take_name(&l, "name", true, false, name);
	if (pm_frame_set(f, name) || pm_frame_mesh(f, name))
		complain(&l, name, "occurs twice");
	struct pm_set *s = pm_frame_set_new(f, name, (uint64_t)take_integer(&l, "n", 0, most_particles, true, 0));
	if (!s)
		return give_up(&l);
	const json_t *done = take(&l, "done", false);
	const json_t *kick = json_object_get(done, "kick"), *drift = json_object_get(done, "drift");
	s->kick = json_number_value(kick);
	s->drift = json_number_value(drift);
	s->pass = (int)take_integer(&l, "stage", 0, 64, false, 0);
	/* inside a step a composition of kicks and drifts goes back before its start and beyond its end */
	const double before = s->pass ? 4 : 0, beyond = s->pass ? 4 : 1;
	if ((done && !(json_is_number(kick) && json_is_number(drift))) ||
		!(s->kick >= 0 && s->kick <= 1 && s->drift >= -before && s->drift <= beyond))
		complain(&l, "done", "is not a fraction");
	const json_t *fixed = take(&l, "fixed", false); /* json_is_true would evaluate the call twice */
	s->fixed = json_is_true(fixed);
	return look_done(&l, &s->more);
}

static bool read_mesh(const json_t *j, struct pm_frame *f)
{
	struct look l = look_at(j, "mesh");
	char name[PM_NAME] = "";
	double cells[3] = {1, 1, 1}, lo[3] = {0}, h[3] = {1, 1, 1};
	size_t one[3] = {1, 1, 1};
	if (!l.j)
		return false;
	take_name(&l, "name", true, false, name);
	if (pm_frame_set(f, name) || pm_frame_mesh(f, name))
		complain(&l, name, "occurs twice");
	take_reals(&l, "cells", f->dim, cells);
	take_reals(&l, "lo", f->dim, lo);
	take_reals(&l, "h", f->dim, h);
	struct pm_mesh *m = pm_frame_mesh_new(f, name, one);
	if (!m)
		return give_up(&l);
	double points = 1;
	for (int a = 0; a < f->dim && !l.bad; a++) {
		if (!(cells[a] >= 1 && cells[a] <= (double)most_cells && cells[a] == floor(cells[a])) || !(h[a] > 0))
			complain(&l, name, "has an invalid number of cells or spacing");
		else
			m->cells[a] = (size_t)cells[a], m->lo[a] = lo[a], m->h[a] = h[a];
		points *= cells[a] + 1;
	}
	if (!l.bad && points > 0x1p48)
		complain(&l, name, "has too many points");
	return look_done(&l, &m->more);
}

static void read_field_lists(struct look *l, struct pm_field *p)
{
	const json_t *terms = take(l, "terms", false), *half = take(l, "half", false), *e;
	size_t i;
	if ((terms && !json_is_array(terms)) || json_array_size(terms) > PM_TERMS)
		complain(l, "terms", "are not an array, or too many");
	else
		json_array_foreach(terms, i, e) {
			if (!json_is_string(e) || json_string_length(e) >= PM_NAME)
				complain(l, "terms", "are not names");
			else
				snprintf(p->terms[p->nterms++], PM_NAME, "%s", json_string_value(e));
		}
	if (half && json_array_size(half) != (size_t)p->components)
		complain(l, "half", "does not have one entry per component");
	else
		json_array_foreach(half, i, e) for (size_t a = 0; a < 3; a++) {
			const json_t *one = json_array_get(e, a);
			if (!json_is_integer(one) || json_integer_value(one) < 0 || json_integer_value(one) > 1)
				complain(l, "half", "is not three times 0 or 1 per component");
			p->staggered[i][a] = json_integer_value(one) == 1;
		}
}

/* Streams written before `interlaced` was a key of its own have it in front of the kernel's name. */
static void read_kernel(struct look *l, struct pm_field *p)
{
	static const char old[] = "interlaced-";
	const size_t n = sizeof old - 1;
	take_name(l, "kernel", false, true, p->kernel);
	const json_t *interlaced = take(l, "interlaced", false);
	p->interlaced = json_is_true(interlaced);
	if (interlaced && !json_is_boolean(interlaced))
		complain(l, "interlaced", "is neither true nor false");
	if (!strncmp(p->kernel, old, n)) {
		memmove(p->kernel, p->kernel + n, strlen(p->kernel + n) + 1);
		p->interlaced = true;
	}
	if (p->interlaced && !*p->kernel)
		complain(l, "interlaced", "has no kernel");
}

static bool read_field(const json_t *j, struct pm_frame *f)
{
	struct look l = look_at(j, "field");
	char name[PM_NAME] = "", on[PM_NAME] = "";
	if (!l.j)
		return false;
	take_name(&l, "name", true, false, name);
	take_name(&l, "on", true, false, on);
	if (!l.bad && pm_frame_field(f, on, name))
		complain(&l, name, "occurs twice");
	int components = (int)take_integer(&l, "components", 1, PM_COMPONENTS, true, 1);
	if (!pm_frame_set(f, on) && !pm_frame_mesh(f, on))
		complain(&l, on, "owns a field, but is neither a set nor a mesh");
	struct pm_field *p = l.bad ? NULL : pm_makes(f, on, name, components, PM_STATE);
	if (!p)
		return give_up(&l);
	p->use = 0;
	p->type = (enum pm_type)take_choice(&l, "type", pm_type_names);
	p->role = (enum pm_role)take_choice(&l, "role", pm_role_names);
	p->extensive = take_choice(&l, "kind", pm_kind_names) == 1;
	take_name(&l, "unit", false, true, p->unit);
	take_name(&l, "of", false, true, p->of);
	read_kernel(&l, p);
	if (json_object_get(l.j, "outside"))
		p->outside = (enum pm_outside)take_choice(&l, "outside", pm_outside_names);
	if (json_object_get(l.j, "rim"))
		p->rim = (int)take_integer(&l, "rim", 0, PM_RIM_MOST, true, 0);
	p->uniform = json_object_get(l.j, "uniform") != NULL;
	if (p->uniform)
		take_reals(&l, "uniform", components, p->value);
	read_field_lists(&l, p);
	return look_done(&l, &p->more);
}

static bool read_list(struct look *l, const char *key, struct pm_frame *f, bool (*one)(const json_t *, struct pm_frame *))
{
	const json_t *list = take(l, key, true), *e;
	size_t i;
	if (!json_is_array(list) || json_array_size(list) > most_objects) {
		complain(l, key, "is not an array, or too long");
		return false;
	}
	json_array_foreach(list, i, e) if (!one(e, f))
		return false;
	return true;
}

static void read_named(struct look *l, struct pm_frame *f, const char *key, const char *inside, char name[PM_NAME], json_t **object)
{
	const json_t *v = take(l, key, true);
	struct look in = look_at(v, key);
	if (in.j) {
		take_name(&in, "name", true, true, name);
		take_object(&in, inside, object);
	}
	if (!in.j || !look_done_inside(&in, f, key))
		l->bad = true;
}

/* One that does not give the frame's time was passed on by a program that set time, dt or step without knowing of it; then, and where there is none, it is
 * the frame's own time and step. */
static void read_since(struct look *l, struct pm_frame *f)
{
	const json_t *since = take(l, "since", false);
	if (since) {
		struct look in = look_at(since, "since");
		f->since_time = in.j ? take_real(&in, "time", true, 0) : 0;
		f->since_step = in.j ? take_integer(&in, "step", 0, INT64_MAX, true, 0) : 0;
		if (!in.j || !look_done_inside(&in, f, "since"))
			l->bad = true;
	}
	if (!since || !pm_frame_since_holds(f))
		pm_frame_since_renew(f);
}

static bool read_all(struct look *l, struct pm_frame *f)
{
	read_named(l, f, "law", "constants", f->law, &f->constants);
	read_named(l, f, "scene", "parameters", f->scene, &f->parameters);
	f->time = take_real(l, "time", true, 0);
	f->dt = take_real(l, "dt", true, 0);
	f->start = take_real(l, "start", false, f->time);
	f->step = take_integer(l, "step", 0, INT64_MAX, true, 0);
	f->substep = (int)take_integer(l, "substep", 0, 1 << 20, true, 0);
	read_since(l, f);
	f->seed = (uint64_t)take_integer(l, "seed", 0, INT64_MAX, false, 0);
	const json_t *history = take(l, "history", false);
	bool entries = json_is_array(history);
	for (size_t i = 0; i < json_array_size(history); i++)
		entries = entries && json_is_object(json_array_get(history, i));
	if (entries) {
		json_decref(f->history);
		f->history = json_deep_copy(history);
	} else if (history)
		complain(l, "history", "is not an array of objects");
	const json_t *box = take(l, "box", true);
	return !l->bad && read_box(box, f) && read_list(l, "sets", f, read_set) && read_list(l, "meshes", f, read_mesh) &&
		read_list(l, "fields", f, read_field) && !l->bad;
}

int pm_header_frame(const json_t *header, struct pm_frame **out)
{
	struct look l = look_at(header, "frame");
	if (!l.j)
		return -PM_DATA;
	const json_t *order = take(&l, "byte_order", false);
	if (order && (!json_is_string(order) || strcmp(json_string_value(order), "little")))
		complain(&l, "byte_order", "is not little (data must be little-endian; swap the bytes where they are written)");
	int dim = (int)take_integer(&l, "dim", 1, 3, true, 1);
	struct pm_frame *f = pm_frame_new(dim);
	if (!f) {
		give_up(&l);
		return -PM_DATA;
	}
	bool good = read_all(&l, f);
	if (!look_done(&l, &f->more) || !good) {
		pm_frame_free(f);
		return -PM_DATA;
	}
	*out = f;
	return 0;
}
