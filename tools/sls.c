/* sls: what a stream holds: attributes, sets, meshes, fields; reads no data unless asked. SPDX-License-Identifier: GPL-3.0-or-later */
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "measure/range.h"
#include "stage/stage.h"
#include "stream/header.h"

static const char *const formats[] = {"text", "json", NULL};

struct config {
	const char *format;
	bool data, history, report;
};

struct state {
	uint64_t frames;
};

static const struct pm_option options[] = {
	{.name = "data", .letter = 'd', .kind = PM_FLAG, PM_AT(data), .text = "read the data too: smallest, largest and mean value of every component"},
	{.name = "history", .kind = PM_FLAG, PM_AT(history), .text = "which programs with which options made the frame"},
	{.name = "report", .kind = PM_FLAG, PM_AT(report), .text = "what the stages have reported: iterations, means removed, counts"},
	{.name = "format", .kind = PM_WORD, .fallback = "text", .choices = formats, PM_AT(format),
		.text = "text for people, json (one line a frame) for programs"},
	{0},
};

static int begin(struct pm_stage *s)
{
	json_decref(s->entry); /* looking leaves no trace */
	s->entry = NULL;
	return 0;
}

static int declare(struct pm_stage *s, struct pm_frame *f)
{
	for (size_t i = 0; ((const struct config *)s->config)->data && i < f->nfields; i++)
		f->fields[i]->use |= PM_USE_READ;
	return 0;
}

/* ---- json ---- */

static json_t *number(double x) { return isfinite(x) ? json_real(x) : json_null(); }

static json_t *data_json(const struct pm_frame *f)
{
	json_t *all = json_array();
	for (size_t i = 0; i < f->nfields; i++) {
		json_t *min = json_array(), *max = json_array(), *mean = json_array();
		for (int c = 0; c < f->fields[i]->components; c++) {
			struct pm_range r = pm_range_of(f->fields[i], c);
			json_array_append_new(min, number(r.min)), json_array_append_new(max, number(r.max)), json_array_append_new(mean, number(r.mean));
		}
		json_array_append_new(all, json_pack("{s:s,s:s,s:o,s:o,s:o}", "name", f->fields[i]->name, "on", f->fields[i]->on, "min", min, "max", max, "mean", mean));
	}
	return all;
}

static int frame_json(const struct config *c, const struct pm_frame *f)
{
	json_t *j = pm_header_json(f);
	if (!j)
		return -PM_NUMERICS;
	if (!c->history)
		json_object_del(j, "history");
	if (c->report)
		json_object_set(j, "report", f->report);
	if (c->data)
		json_object_set_new(j, "data", data_json(f));
	char *line = pm_json_line(j);
	puts(line ? line : "");
	free(line);
	json_decref(j);
	return 0;
}

/* ---- text ---- */

static void pairs(const json_t *object)
{
	const char *key, *between = " (";
	json_t *v;
	json_object_foreach((json_t *)(uintptr_t)object, key, v) {
		char *text = json_is_real(v) ? NULL : pm_json_line(v);
		text ? printf("%s%s %s", between, key, text) : printf("%s%s %.10g", between, key, json_real_value(v));
		free(text);
		between = ", ";
	}
	if (json_object_size(object))
		putchar(')');
}

static void attributes(const struct pm_frame *f)
{
	printf("  law %s", f->law);
	pairs(f->constants);
	if (*f->scene)
		printf("\n  scene %s", f->scene), pairs(f->parameters);
	printf("\n  box");
	for (int a = 0; a < f->dim; a++)
		printf("%s [%.10g, %.10g] %s", a ? " x" : "", f->lo[a], f->hi[a], pm_face_names[f->face[a][0]]),
			f->face[a][0] == f->face[a][1] ? 0 : printf("|%s", pm_face_names[f->face[a][1]]);
	printf("; particles");
	for (int a = 0; a < f->dim; a++)
		printf(" %s", pm_particle_face_names[f->pface[a][0]]),
			f->pface[a][0] == f->pface[a][1] ? 0 : printf("|%s", pm_particle_face_names[f->pface[a][1]]);
	putchar('\n');
}

/* What fills a name up to ten letters, of whatever alphabet. */
static int missing(const char *name)
{
	int n = 10;
	for (; *name; name++)
		n -= ((unsigned char)*name & 0xC0) != 0x80;
	return n > 0 ? n : 0;
}

static void field_text(const struct config *c, const struct pm_field *p)
{
	printf("    %s%*s %2d %s %s %s", p->name, missing(p->name), "", p->components, pm_type_names[p->type], pm_role_names[p->role], p->extensive ? "strength" : "value");
	if (*p->unit)
		printf(" [%s]", p->unit);
	if (*p->of)
		printf(" of %s", p->of);
	for (int i = 0; i < p->nterms; i++)
		printf("%s%s", i ? "," : " terms ", p->terms[i]);
	if (*p->kernel)
		printf(" kernel %s%s", p->kernel, p->interlaced ? " interlaced" : "");
	for (int i = 0; p->uniform && i < p->components; i++)
		printf("%s%.10g", i ? "," : " uniform ", p->value[i]);
	for (int i = 0; i < p->components; i++)
		if (p->staggered[i][0] | p->staggered[i][1] | p->staggered[i][2])
			printf(" half_%d %d%d%d", i, p->staggered[i][0], p->staggered[i][1], p->staggered[i][2]);
	putchar('\n');
	for (int i = 0; c->data && i < p->components; i++) {
		struct pm_range r = pm_range_of(p, i);
		printf("      %d: min %.10g max %.10g mean %.10g\n", i, r.min, r.max, r.mean);
	}
}

static void fields_text(const struct config *c, const struct pm_frame *f, const char *on)
{
	for (size_t i = 0; i < f->nfields; i++)
		if (!strcmp(f->fields[i]->on, on))
			field_text(c, f->fields[i]);
}

static void owners_text(const struct config *c, const struct pm_frame *f)
{
	for (size_t i = 0; i < f->nsets; i++) {
		const struct pm_set *s = f->sets[i];
		printf("  set %s: %llu particles%s", s->name, (unsigned long long)s->n, s->fixed ? ", fixed" : "");
		s->kick != 0 || s->drift != 0 || s->pass ? printf(", done kick %g drift %g pass %d\n", s->kick, s->drift, s->pass) : putchar('\n');
		fields_text(c, f, s->name);
	}
	for (size_t i = 0; i < f->nmeshes; i++) {
		const struct pm_mesh *m = f->meshes[i];
		printf("  mesh %s: ", m->name);
		for (int a = 0; a < f->dim; a++)
			printf("%s%zu", a ? " x " : "", m->cells[a]);
		printf(" cells, h");
		for (int a = 0; a < f->dim; a++)
			printf(" %.10g", m->h[a]);
		putchar('\n');
		fields_text(c, f, m->name);
	}
}

static void lines(const char *title, const json_t *j)
{
	const char *key;
	json_t *v;
	size_t i;
	printf("  %s\n", title);
	if (json_is_object(j))
		json_object_foreach((json_t *)(uintptr_t)j, key, v) {
			char *text = pm_json_line(v);
			printf("    %s: %s\n", key, text ? text : "");
			free(text);
		}
	else
		json_array_foreach(j, i, v) {
			char *text = pm_json_line(v);
			printf("    %s\n", text ? text : "");
			free(text);
		}
}

static int frame(struct pm_stage *s, struct pm_frame *f)
{
	const struct config *c = s->config;
	struct state *st = s->state;
	st->frames++;
	if (!strcmp(c->format, "json"))
		return frame_json(c, f);
	printf("frame %llu: time %.10g step %lld substep %d dt %.10g dim %d seed %llu\n", (unsigned long long)st->frames, f->time, (long long)f->step, f->substep, f->dt, f->dim,
		(unsigned long long)f->seed);
	attributes(f);
	owners_text(c, f);
	if (c->history)
		lines("history", f->history);
	if (c->report)
		lines("report", f->report);
	return 0;
}

static int end(struct pm_stage *s)
{
	if (!strcmp(((const struct config *)s->config)->format, "text"))
		printf("%llu frames\n", (unsigned long long)((struct state *)s->state)->frames);
	return 0;
}

static const struct pm_example examples[] = {
	{"What a scene holds.", "pinit plummer -n 1000 | sls"},
	{"The extent of its particles.", "pinit plummer -n 1000 | sls --data"},
	{"How a stream was made, for a program.", "pinit plummer -n 1000 | sls --history --format json"},
	{0}};

const struct pm_tool tool_sls = {
	.name = "sls",
	.summary = "lists what a stream holds",
	.about = "Prints the attributes of every frame, its particle sets and meshes, and of every field the name, the number of components, the type, the role, whether it is a "
		 "strength or a value, unit, what it is the change of, the terms it holds, and its value where all are equal. No data are kept unless --data "
		 "asks for smallest, largest and mean values. With --format json every frame is one line: the header of the stream, with report and data added.",
	.kind = PM_SINK,
	.config = sizeof(struct config),
	.state = sizeof(struct state),
	.options = options,
	.examples = examples,
	.begin = begin,
	.declare = declare,
	.frame = frame,
	.end = end,
};
