/* A frame packed for a page. Of each field of particles and meshes: names, units, ranges, and its numbers as blocks. Up to 4096 numbers keep the digits of
 * f32; of more, positions are rounded to 1/65535 of their range and values to 3 digits (f16). Integers are f32 always.
 * SPDX-License-Identifier: GPL-3.0-or-later */
#include <string.h>

#include "measure/range.h"
#include "stream/declare.h"
#include "stream/header.h"
#include "viewer/viewer-frame.h"

enum { precise = 4096 }; /* numbers of f32 up to here */

static bool same(const char *wanted, const char *name) { return !wanted || !strcmp(wanted, name); }

/* Positions always; another field if it is the one asked for, or if none is. */
static bool chosen(const struct pm_viewer_choice *c, const struct pm_frame *f, const struct pm_field *p)
{
	const bool particles = pm_frame_set(f, p->on);
	return same(particles ? c->set : c->mesh, p->on) && ((particles && !strcmp(p->name, "x")) || same(c->field, p->name));
}

/* The expressions over the particles of the set: x, y, colour; their number. */
static int expressions(const struct pm_viewer_choice *c, const char *text[3])
{
	int n = 0;
	for (int k = 0; k < 3; k++)
		if ((k == 0 && c->x) || (k == 1 && c->y) || (k == 2 && c->colour))
			text[n++] = k == 0 ? c->x : k == 1 ? c->y : c->colour;
	return n;
}

int pm_viewer_frame_reads(const struct pm_viewer_choice *c, struct pm_frame *f)
{
	const char *text[3];
	struct pm_expression e;
	size_t n = 0;
	if (c->set && !pm_frame_set(f, c->set))
		return pm_fail(PM_DATA, "no set '%s' (sls lists what there is)", c->set);
	if (c->mesh && !pm_frame_mesh(f, c->mesh))
		return pm_fail(PM_DATA, "no mesh '%s' (sls lists what there is)", c->mesh);
	for (size_t i = 0; i < f->nfields; i++)
		if (chosen(c, f, f->fields[i])) {
			n += same(c->field, f->fields[i]->name);
			if (!f->fields[i]->uniform && !pm_reads(f, f->fields[i]->on, f->fields[i]->name))
				return -PM_DATA;
		}
	if (!n && c->field)
		return pm_fail(PM_DATA, "no field '%s' to draw (sls lists what there is)", c->field);
	for (size_t s = 0; s < f->nsets; s++)
		for (int k = 0, most = expressions(c, text); k < most && same(c->set, f->sets[s]->name); k++)
			if (pm_expression_compile(&e, f, f->sets[s]->name, text[k]))
				return -PM_DATA;
	return 0;
}

struct picked { /* which values of a set or mesh go onto the page */
	size_t n;
	size_t *index; /* NULL: all n */
};

/* One of every k particles, at a place that is fixed within its k: an even stride would see the pattern of a regular start. */
static int pick_particles(size_t n, size_t k, struct picked *p)
{
	*p = (struct picked){.n = n};
	if (k == 1)
		return 0;
	p->n = n / k;
	if (!(p->index = pm_alloc(p->n + 1, sizeof *p->index)))
		return -PM_DATA;
	for (size_t i = 0; i < p->n; i++)
		p->index[i] = i * k + (i * 2654435761u >> 7) % k; /* Knuth's multiplicative hash */
	return 0;
}

/* Every k-th point along each axis. */
static int pick_points(const size_t points[3], size_t k, struct picked *p)
{
	size_t m[3], at = 0;
	for (int d = 0; d < 3; d++)
		m[d] = (points[d] + k - 1) / k;
	*p = (struct picked){.n = m[0] * m[1] * m[2]};
	if (k == 1)
		return 0;
	if (!(p->index = pm_alloc(p->n, sizeof *p->index)))
		return -PM_DATA;
	for (size_t z = 0; z < m[2]; z++)
		for (size_t y = 0; y < m[1]; y++)
			for (size_t x = 0; x < m[0]; x++)
				p->index[at++] = (z * k * points[1] + y * k) * points[0] + x * k;
	return 0;
}

static json_t *triple(double lo, double hi, double least)
{
	return json_pack("[o,o,o]", pm_json_number(lo), pm_json_number(hi), pm_json_number(least));
}

/* [smallest, largest, smallest above 0] of every component, and of the length of a vector. */
static json_t *ranges(const struct pm_frame *f, const struct pm_field *p)
{
	json_t *list = json_array();
	double square = 0;
	for (int c = 0; c < p->components + (p->components > 1); c++) {
		const bool length = c == p->components;
		if (p->uniform) {
			const double x = length ? sqrt(square) : p->value[c];
			square += x * x;
			json_array_append_new(list, triple(x, x, x > 0 ? x : HUGE_VAL));
			continue;
		}
		const struct pm_range r = pm_range_of(f, p, length ? -1 : c);
		json_array_append_new(list, triple(r.min, r.max, r.least));
	}
	return list;
}

static json_t *pack(struct pm_viewer_frame *to, const struct picked *from, const struct pm_field *p, int c, bool position, double *w)
{
	double lo = HUGE_VAL, hi = -HUGE_VAL;
	if (p->uniform)
		return pm_json_number(p->value[c]);
	for (size_t i = 0; i < from->n; i++) {
		w[i] = pm_field_value(p, c, from->index ? from->index[i] : i);
		lo = fmin(lo, w[i]), hi = fmax(hi, w[i]);
	}
	const bool integer = p->type == PM_I64 || p->type == PM_U8;
	return pm_viewer_pack(&to->blocks, from->n, w, from->n <= precise || integer ? PM_AS_F32 : position ? PM_AS_U16 : PM_AS_F16, from->n ? lo : 0, hi);
}

static json_t *field_json(struct pm_viewer_frame *to, const struct pm_frame *f, const struct picked *from, const struct pm_field *p, bool position, double *w)
{
	json_t *data = json_array(), *offset = json_array();
	for (int c = 0; c < p->components; c++) {
		json_t *one = pack(to, from, p, c, position, w);
		if (!one || json_array_append_new(data, one)) {
			json_decref(data), json_decref(offset);
			return NULL;
		}
		for (int d = 0; d < 3; d++)
			json_array_append_new(offset, json_real(0.5 * p->staggered[c][d]));
	}
	return json_pack("{s:s, s:s, s:o, s:o, s:o}", "name", p->name, "unit", p->unit, "data", data, "range", ranges(f, p), "offset", offset);
}

static json_t *expression_json(struct pm_viewer_frame *to, const struct picked *from, const struct pm_expression *e, const struct pm_frame *f, size_t n,
	const char *text)
{
	double *w = pm_alloc(2 * n + 1, sizeof *w), *some = w ? w + n : NULL, lo = HUGE_VAL, hi = -HUGE_VAL, least = HUGE_VAL;
	json_t *data = NULL;
	if (!w)
		return NULL;
	pm_expression_eval(e, f, 0, n, w);
	for (size_t i = 0; i < n; i++)
		lo = fmin(lo, w[i]), hi = fmax(hi, w[i]), least = w[i] > 0 ? fmin(least, w[i]) : least;
	for (size_t i = 0; i < from->n; i++)
		some[i] = w[from->index ? from->index[i] : i];
	if (pm_finite(n, w))
		data = pm_viewer_pack(&to->blocks, from->n, some, from->n <= precise ? PM_AS_F32 : PM_AS_F16, 0, 0);
	else
		pm_fail(PM_NUMERICS, "'%s' is not finite everywhere (choose particles with sel --where)", text);
	pm_free(w);
	return data ? json_pack("{s:s, s:s, s:[o], s:[o]}", "name", text, "unit", "", "data", data, "range", triple(lo, hi, least)) : NULL;
}

/* Its fields, and for particles the expressions. NULL: failure. */
static json_t *fields_json(struct pm_viewer_frame *to, const struct pm_viewer_choice *c, struct pm_frame *f, const char *on, const struct picked *from)
{
	json_t *list = json_array(), *one;
	const struct pm_set *set = pm_frame_set(f, on);
	const char *text[3];
	struct pm_expression e;
	double *w = pm_alloc(from->n + 1, sizeof *w);
	bool good = w;
	for (size_t i = 0; i < f->nfields && good; i++)
		if (!strcmp(f->fields[i]->on, on) && chosen(c, f, f->fields[i])) {
			one = field_json(to, f, from, f->fields[i], set && !strcmp(f->fields[i]->name, "x"), w);
			good = one && !json_array_append_new(list, one);
		}
	for (int k = 0, most = expressions(c, text); k < most && good && set; k++) {
		good = !pm_expression_compile(&e, f, on, text[k]) && (one = expression_json(to, from, &e, f, set->n, text[k])) &&
			!json_array_append_new(list, one);
	}
	pm_free(w);
	if (!good)
		json_decref(list);
	return good ? list : NULL;
}

static json_t *set_json(struct pm_viewer_frame *to, const struct pm_viewer_choice *c, struct pm_frame *f, const struct pm_set *set)
{
	struct picked from;
	const size_t k = (set->n + c->particles - 1) / c->particles, every = k ? k : 1;
	json_t *fields = pick_particles(set->n, every, &from) ? NULL : fields_json(to, c, f, set->name, &from);
	to->thinned = every > to->thinned ? every : to->thinned;
	pm_free(from.index);
	return fields ? json_pack("{s:s, s:I, s:I, s:o}", "name", set->name, "n", (json_int_t)set->n, "kept", (json_int_t)from.n, "fields", fields) : NULL;
}

static json_t *mesh_json(struct pm_viewer_frame *to, const struct pm_viewer_choice *c, struct pm_frame *f, const struct pm_mesh *m)
{
	struct picked from;
	size_t points[3], k = 1;
	pm_mesh_points(f, m, points);
	while (((points[0] - 1) / k + 1) * ((points[1] - 1) / k + 1) * ((points[2] - 1) / k + 1) > c->points)
		k++;
	json_t *fields = pick_points(points, k, &from) ? NULL : fields_json(to, c, f, m->name, &from);
	to->coarse = k > to->coarse ? k : to->coarse;
	pm_free(from.index);
	return fields ? json_pack("{s:s, s:[I,I,I], s:[f,f,f], s:[f,f,f], s:I, s:o}", "name", m->name,
		"points", (json_int_t)((points[0] + k - 1) / k), (json_int_t)((points[1] + k - 1) / k), (json_int_t)((points[2] + k - 1) / k),
		"lo", m->lo[0], m->lo[1], m->lo[2], "h", m->h[0] * (double)k, m->h[1] * (double)k, m->h[2] * (double)k, "every", (json_int_t)k,
		"fields", fields) : NULL;
}

static json_t *head_of(const struct pm_frame *f)
{
	json_t *box = json_array();
	for (int d = 0; d < f->dim; d++)
		json_array_append_new(box, json_pack("{s:f, s:f, s:b}", "lo", f->lo[d], "hi", f->hi[d], "periodic", f->face[d][0] == PM_PERIODIC));
	return json_pack("{s:i, s:f, s:I, s:i, s:o, s:[], s:[]}", "dim", f->dim, "time", f->time, "step", (json_int_t)f->step, "substep", f->substep,
		"box", box, "sets", "meshes");
}

struct pm_viewer_frame *pm_viewer_frame_of(const struct pm_viewer_choice *c, struct pm_frame *f)
{
	struct pm_viewer_frame *to = pm_zalloc(1, sizeof *to);
	if (!to)
		return NULL;
	bool good = (to->head = head_of(f)) != NULL;
	to->thinned = to->coarse = 1;
	for (size_t i = 0; i < f->nsets && good; i++)
		if (same(c->set, f->sets[i]->name) && pm_frame_field(f, f->sets[i]->name, "x")) {
			json_t *one = set_json(to, c, f, f->sets[i]);
			good = one && !json_array_append_new(json_object_get(to->head, "sets"), one);
		}
	for (size_t i = 0; i < f->nmeshes && good; i++)
		if (same(c->mesh, f->meshes[i]->name)) {
			json_t *one = mesh_json(to, c, f, f->meshes[i]);
			good = one && !json_array_append_new(json_object_get(to->head, "meshes"), one);
		}
	to->bytes = to->blocks.bytes;
	return good ? to : pm_viewer_frame_free(to);
}

struct pm_viewer_frame *pm_viewer_frame_free(struct pm_viewer_frame *p)
{
	if (p) {
		json_decref(p->head);
		pm_viewer_blocks_free(&p->blocks);
		pm_free(p);
	}
	return NULL;
}
