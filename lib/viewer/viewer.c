/* The page: page.html with the style, the frames and the script in their places (@STYLE@, @DATA@, @SCRIPT@). Frames are kept packed in memory until the end
 * (200 MB at most: beyond that every second one goes). What comes from the stream stands in JSON without <, > and &, or in base64: it cannot become markup.
 * SPDX-License-Identifier: GPL-3.0-or-later */
#include <stdlib.h>
#include <string.h>
#include <unistd.h>

#include "picture/colour.h"
#include "stream/header.h"
#include "viewer/viewer-text.h"
#include "viewer/viewer.h"

int pm_viewer_reads(struct pm_viewer *v, struct pm_frame *f)
{
	int status = pm_viewer_frame_reads(&v->choice, f);
	return status ? status : pm_viewer_curves_reads(f);
}

/* ---- frames ---- */

/* Every second one that is left goes. */
static void halve(struct pm_viewer *v)
{
	size_t n = 0;
	for (size_t i = 0; i < v->nkept; i++)
		if (i % 2) {
			v->bytes -= v->kept[i]->bytes;
			pm_viewer_frame_free(v->kept[i]);
		} else
			v->kept[n++] = v->kept[i];
	v->nkept = n, v->stride *= 2;
}

static int keep(struct pm_viewer *v, struct pm_viewer_frame *p)
{
	if (v->nkept == v->room) {
		const size_t room = v->room ? 2 * v->room : 64;
		struct pm_viewer_frame **more = realloc(v->kept, room * sizeof *more);
		if (!more) {
			pm_viewer_frame_free(p);
			return pm_no_memory();
		}
		v->kept = more, v->room = room;
	}
	v->kept[v->nkept++] = p;
	v->bytes += p->bytes;
	while (v->bytes > v->most && v->nkept > 1)
		halve(v);
	return v->bytes <= v->most ? 0 : pm_fail(PM_DATA, "this frame alone would make a page of %zu MB, the limit is %d (--field NAME or --set "
		"NAME takes less onto it)", v->bytes / 1000000, (int)(v->most / 1000000));
}

int pm_viewer_add(struct pm_viewer *v, struct pm_frame *f)
{
	v->stride = v->stride ? v->stride : 1;
	v->choice.particles = v->choice.particles ? v->choice.particles : PM_VIEWER_PARTICLES;
	v->choice.points = v->choice.points ? v->choice.points : PM_VIEWER_POINTS;
	v->most = v->most ? v->most : PM_VIEWER_BYTES;
	struct pm_viewer_frame *p = pm_viewer_frame_of(&v->choice, f);
	if (!p)
		return pm_failed();
	v->last = pm_viewer_frame_free(v->last);
	json_decref(v->history);
	v->history = json_incref(f->history);
	snprintf(v->scene, PM_NAME, "%s", f->scene), snprintf(v->law, PM_NAME, "%s", f->law);
	int status = 0;
	if (v->seen++ % v->stride == 0)
		status = keep(v, p);
	else
		v->last = p;
	return status ? status : pm_viewer_curves_add(&v->curves, f);
}

void pm_viewer_left_out(const struct pm_viewer *v, char text[320])
{
	size_t thinned = 1, coarse = 1;
	int used = 0;
	for (size_t i = 0; i < v->nkept; i++) {
		thinned = v->kept[i]->thinned > thinned ? v->kept[i]->thinned : thinned;
		coarse = v->kept[i]->coarse > coarse ? v->kept[i]->coarse : coarse;
	}
	*text = 0;
	if (v->stride > 1)
		used += snprintf(text, 320, "one frame of %llu (the limit is %d MB)", (unsigned long long)v->stride, (int)(v->most / 1000000));
	if (thinned > 1)
		used += snprintf(text + used, 320 - (size_t)used, "%sone particle of %zu (the limit is %zu of a set)", used ? ", " : "", thinned,
			v->choice.particles);
	if (coarse > 1)
		snprintf(text + used, 320 - (size_t)used, "%sone mesh point of %zu along each axis (the limit is %zu points)", used ? ", " : "", coarse,
			v->choice.points);
}

/* ---- the file ---- */

/* JSON as the text of a script element; owns j. */
static int put_json(FILE *out, const char *attributes, json_t *j, int digits)
{
	char *text = j ? json_dumps(j, JSON_COMPACT | JSON_ENSURE_ASCII | JSON_REAL_PRECISION(digits)) : NULL;
	json_decref(j);
	if (!text)
		return pm_no_memory();
	fprintf(out, "<script type=\"application/json\" %s>", attributes);
	for (const char *p = text; *p; p++)
		if (strchr("<>&", *p))
			fprintf(out, "\\u%04x", *p);
		else
			putc(*p, out);
	fputs("</script>\n", out);
	free(text);
	return 0;
}

static void put_escaped(FILE *out, const char *text)
{
	for (const char *p = text; *p; p++)
		if (strchr("<>&\"'", *p))
			fprintf(out, "&#%d;", *p);
		else
			putc(*p, out);
}

static json_t *maps_json(void)
{
	json_t *maps = json_object();
	for (int m = 0; pm_colour_names[m]; m++) {
		char text[6 * 256 + 1] = "";
		for (int i = 0; i < 256; i++) {
			unsigned char rgb[3];
			pm_colour_of(m, i / 255.0, rgb);
			snprintf(text + 6 * i, 7, "%02x%02x%02x", rgb[0], rgb[1], rgb[2]);
		}
		json_object_set_new(maps, pm_colour_names[m], json_string(text));
	}
	return maps;
}

static json_t *text_or_null(const char *text) { return text ? json_string(text) : json_null(); }

static json_t *run_json(const struct pm_viewer *v)
{
	char left_out[320];
	const struct pm_viewer_choice *c = &v->choice;
	pm_viewer_left_out(v, left_out);
	json_t *asked = json_pack("{s:o, s:o, s:o, s:o, s:o, s:o, s:o, s:o, s:b, s:i, s:o, s:f}", "set", text_or_null(c->set), "mesh", text_or_null(c->mesh),
		"field", text_or_null(c->field), "x", text_or_null(c->x), "y", text_or_null(c->y), "colour", text_or_null(c->colour),
		"component", text_or_null(v->component), "map", text_or_null(v->map), "log", v->log, "axis", v->axis, "slice", pm_json_number(v->slice),
		"fps", v->fps);
	if (asked && v->nrange)
		json_object_set_new(asked, "range", json_pack("[f,f]", v->range[0], v->range[1]));
	return json_pack("{s:s, s:o, s:s, s:s, s:O, s:o, s:o, s:s, s:I}", "version", PM_VERSION, "title", text_or_null(v->title), "scene", v->scene,
		"law", v->law, "history", v->history ? v->history : json_null(), "asked", asked, "maps", maps_json(), "leftOut", left_out,
		"frames", (json_int_t)v->seen);
}

static int put_data(struct pm_viewer *v, FILE *out)
{
	int status = put_json(out, "id=\"run\"", run_json(v), 17);
	size_t at = 0;
	for (size_t i = 0; i < v->nkept + (v->last != NULL) && !status; i++) {
		const struct pm_viewer_frame *p = i < v->nkept ? v->kept[i] : v->last;
		json_object_set_new(p->head, "at", json_integer((json_int_t)at)); /* the number of its first block */
		status = put_json(out, "class=\"frame\"", json_incref(p->head), 9);
		for (size_t b = 0; b < p->blocks.n; b++)
			fprintf(out, "<script type=\"text/plain\" id=\"block-%zu\">%s</script>\n", at++, p->blocks.text[b]);
	}
	return status ? status : put_json(out, "id=\"curves\"", pm_viewer_curves_json(&v->curves), 17);
}

static int put_page(struct pm_viewer *v, FILE *out)
{
	static const char *const places[] = {"@TITLE@", "@STYLE@", "@DATA@", "@SCRIPT@"};
	int status = 0;
	const char *p = pm_viewer_html;
	for (int k = 0; k < 4 && !status; k++) {
		const char *place = strstr(p, places[k]);
		fwrite(p, 1, (size_t)(place - p), out);
		p = place + strlen(places[k]);
		if (k == 0)
			put_escaped(out, v->title ? v->title : *v->scene ? v->scene : v->law);
		else if (k == 2)
			status = put_data(v, out);
		else
			fputs(k == 1 ? pm_viewer_css : pm_viewer_js, out);
	}
	fputs(p, out);
	return status;
}

int pm_viewer_end(struct pm_viewer *v)
{
	const bool standard = !strcmp(v->name, "-");
	if (!v->seen)
		return 0;
	if (!standard && pm_replace_open(&v->file, v->name, true))
		return pm_failed();
	FILE *out = standard ? stdout : fdopen(v->file.fd, "w");
	if (!out)
		return pm_fail_errno("cannot write '%s'", v->name);
	int status = put_page(v, out);
	if ((fflush(out) || ferror(out)) && !status)
		status = pm_fail_errno("cannot write '%s'", v->name);
	if (!status && !standard)
		status = pm_replace_commit(&v->file, false);
	if (!standard)
		fclose(out);
	if (!status && !standard)
		puts(v->name);
	return status;
}

void pm_viewer_drop(struct pm_viewer *v)
{
	for (size_t i = 0; i < v->nkept; i++)
		pm_viewer_frame_free(v->kept[i]);
	free(v->kept);
	v->kept = NULL, v->nkept = 0;
	v->last = pm_viewer_frame_free(v->last);
	pm_viewer_curves_free(&v->curves);
	json_decref(v->history);
	v->history = NULL;
	if (v->seen)
		pm_replace_drop(&v->file);
}
