/* What a frame holds, for people and for programs: attributes, sets, meshes and their fields, with the range of the values where the data are there.
 * SPDX-License-Identifier: GPL-3.0-or-later */
#include <stdlib.h>
#include <string.h>

#include "measure/frame-listing.h"
#include "measure/range.h"
#include "stream/header.h"
#include "stream/limits.h"

static json_t *data_json(const struct pm_frame *f)
{
	json_t *all = json_array();
	for (size_t i = 0; i < f->nfields; i++) {
		json_t *min = json_array(), *max = json_array(), *mean = json_array();
		for (int c = 0; c < f->fields[i]->components; c++) {
			struct pm_range r = pm_range_of(f, f->fields[i], c);
			json_array_append_new(min, pm_json_number(r.min)), json_array_append_new(max, pm_json_number(r.max)),
				json_array_append_new(mean, pm_json_number(r.mean));
		}
		json_array_append_new(all, json_pack("{s:s,s:s,s:o,s:o,s:o}", "name", f->fields[i]->name, "on", f->fields[i]->on, "min", min, "max", max,
			"mean", mean));
	}
	return all;
}

int pm_list_json(FILE *out, const struct pm_listing *c, const struct pm_frame *f)
{
	json_t *j = pm_header_json(f);
	if (!j)
		return -PM_NUMERICS;
	if (!c->history)
		json_object_del(j, "history");
	if (c->report)
		json_object_set(j, "report", f->report);
	json_t *limits = c->report ? pm_limits_json(f) : NULL;
	if (limits)
		json_object_set_new(j, "limits", limits);
	if (c->data)
		json_object_set_new(j, "data", data_json(f));
	char *line = pm_json_line(j);
	fprintf(out, "%s\n", line ? line : "");
	free(line);
	json_decref(j);
	return 0;
}

static void pairs(FILE *out, const json_t *object)
{
	const char *key, *between = " (";
	json_t *v;
	json_object_foreach((json_t *)(uintptr_t)object, key, v) {
		char *text = json_is_real(v) ? NULL : pm_json_line(v);
		text ? fprintf(out, "%s%s %s", between, key, text) : fprintf(out, "%s%s %.10g", between, key, json_real_value(v));
		free(text);
		between = ", ";
	}
	if (json_object_size(object))
		putc(')', out);
}

static void attributes(FILE *out, const struct pm_frame *f)
{
	fprintf(out, "  law %s", f->law);
	pairs(out, f->constants);
	if (*f->scene)
		fprintf(out, "\n  scene %s", f->scene), pairs(out, f->parameters);
	fprintf(out, "\n  box");
	for (int a = 0; a < f->dim; a++)
		fprintf(out, "%s [%.10g, %.10g] %s", a ? " x" : "", f->lo[a], f->hi[a], pm_face_names[f->face[a][0]]),
			f->face[a][0] == f->face[a][1] ? 0 : fprintf(out, "|%s", pm_face_names[f->face[a][1]]);
	fprintf(out, "; particles");
	for (int a = 0; a < f->dim; a++)
		fprintf(out, " %s", pm_particle_face_names[f->pface[a][0]]),
			f->pface[a][0] == f->pface[a][1] ? 0 : fprintf(out, "|%s", pm_particle_face_names[f->pface[a][1]]);
	putc('\n', out);
}

/* The blanks that pad a name to ten characters of UTF-8. */
static int missing(const char *name)
{
	int n = 10;
	for (; *name; name++)
		n -= ((unsigned char)*name & 0xC0) != 0x80;
	return n > 0 ? n : 0;
}

static void field_text(FILE *out, const struct pm_listing *c, const struct pm_frame *f, const struct pm_field *p)
{
	fprintf(out, "    %s%*s %2d %s %s %s", p->name, missing(p->name), "", p->components, pm_type_names[p->type], pm_role_names[p->role],
		p->extensive ? "strength" : "value");
	if (*p->unit)
		fprintf(out, " [%s]", p->unit);
	if (*p->of)
		fprintf(out, " of %s", p->of);
	for (int i = 0; i < p->nterms; i++)
		fprintf(out, "%s%s", i ? "," : " terms ", p->terms[i]);
	if (*p->kernel)
		fprintf(out, " kernel %s%s", p->kernel, p->interlaced ? " interlaced" : "");
	for (int i = 0; p->uniform && i < p->components; i++)
		fprintf(out, "%s%.10g", i ? "," : " uniform ", p->value[i]);
	for (int i = 0; i < p->components; i++)
		if (p->staggered[i][0] | p->staggered[i][1] | p->staggered[i][2])
			fprintf(out, " half_%d %d%d%d", i, p->staggered[i][0], p->staggered[i][1], p->staggered[i][2]);
	putc('\n', out);
	for (int i = 0; c->data && i < p->components; i++) {
		struct pm_range r = pm_range_of(f, p, i);
		fprintf(out, "      %d: min %.10g max %.10g mean %.10g\n", i, r.min, r.max, r.mean);
	}
}

static void fields_text(FILE *out, const struct pm_listing *c, const struct pm_frame *f, const char *on)
{
	for (size_t i = 0; i < f->nfields; i++)
		if (!strcmp(f->fields[i]->on, on))
			field_text(out, c, f, f->fields[i]);
}

static void owners_text(FILE *out, const struct pm_listing *c, const struct pm_frame *f)
{
	for (size_t i = 0; i < f->nsets; i++) {
		const struct pm_set *s = f->sets[i];
		fprintf(out, "  set %s: %llu particles%s", s->name, (unsigned long long)s->n, s->fixed ? ", fixed" : "");
		s->kick != 0 || s->drift != 0 || s->pass ? fprintf(out, ", done kick %g drift %g pass %d\n", s->kick, s->drift, s->pass) : putc('\n', out);
		fields_text(out, c, f, s->name);
	}
	for (size_t i = 0; i < f->nmeshes; i++) {
		const struct pm_mesh *m = f->meshes[i];
		fprintf(out, "  mesh %s: ", m->name);
		for (int a = 0; a < f->dim; a++)
			fprintf(out, "%s%zu", a ? " x " : "", m->cells[a]);
		fprintf(out, " cells, h");
		for (int a = 0; a < f->dim; a++)
			fprintf(out, " %.10g", m->h[a]);
		putc('\n', out);
		fields_text(out, c, f, m->name);
	}
}

static void lines(FILE *out, const char *title, const json_t *j)
{
	const char *key;
	json_t *v;
	size_t i;
	fprintf(out, "  %s\n", title);
	if (json_is_object(j))
		json_object_foreach((json_t *)(uintptr_t)j, key, v) {
			char *text = pm_json_line(v);
			fprintf(out, "    %s: %s\n", key, text ? text : "");
			free(text);
		}
	else
		json_array_foreach(j, i, v) {
			char *text = pm_json_line(v);
			fprintf(out, "    %s\n", text ? text : "");
			free(text);
		}
}

void pm_list_text(FILE *out, const struct pm_listing *c, const struct pm_frame *f, uint64_t number)
{
	fprintf(out, "frame %llu: time %.10g step %lld substep %d dt %.10g dim %d seed %llu\n", (unsigned long long)number, f->time, (long long)f->step,
		f->substep, f->dt, f->dim, (unsigned long long)f->seed);
	attributes(out, f);
	owners_text(out, c, f);
	if (c->history)
		lines(out, "history", f->history);
	if (c->report)
		lines(out, "report", f->report);
	json_t *limits = c->report ? pm_limits_json(f) : NULL;
	if (limits)
		lines(out, "limits", limits);
	json_decref(limits);
}
