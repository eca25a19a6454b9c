/* Pictures written to files. SPDX-License-Identifier: GPL-3.0-or-later */
#include <ctype.h>
#include <string.h>
#include <strings.h>

#include "picture/picture-file.h"
#include "world/world.h"

/* Where the number of the frame goes: %d or %0Nd once. *width is N. 0 none, 1 there, -1 wrong. */
static int number_place(const char *name, const char **place, const char **behind, int *width)
{
	const char *p = strchr(name, '%');
	if (!p)
		return 0;
	*place = p++;
	*width = *p == '0' && isdigit((unsigned char)p[1]) ? p[1] - '0' : 0;
	p += *width ? 2 : 0;
	*behind = p + 1;
	return *p == 'd' && !strchr(p, '%') ? 1 : -1;
}

const char *const pm_picture_kinds[] = {"png", "ppm", "mp4", "html", NULL};

static int kind_named(const char *name)
{
	for (int k = 0; pm_picture_kinds[k]; k++)
		if (!strcasecmp(name, pm_picture_kinds[k]))
			return k;
	return -1;
}

/* ".png, .ppm or .mp4" */
static void list_kinds(char out[80])
{
	for (int k = 0, used = 0; pm_picture_kinds[k]; k++)
		used += snprintf(out + used, 80 - (size_t)used, "%s.%s", !k ? "" : pm_picture_kinds[k + 1] ? ", " : " or ", pm_picture_kinds[k]);
}

int pm_picture_files_check(struct pm_picture_files *c, const char *format)
{
	const char *slash = strrchr(c->name, '/'), *dot = strrchr(slash ? slash : c->name, '.'), *place, *behind;
	int width, asked = format ? kind_named(format) : -1, kind = dot ? kind_named(dot + 1) : asked;
	char known[80];
	list_kinds(known);
	if (number_place(c->name, &place, &behind, &width) < 0)
		return pm_fail(PM_USAGE, "--output '%s': only %%d or %%04d can stand for the number of the frame, once", c->name);
	if (!strcmp(c->name, "-"))
		kind = asked < 0 ? PM_PICTURE_PNG : asked;
	else if (dot && kind < 0)
		return pm_fail(PM_USAGE, "--output '%s': no kind of picture ends in '%s' (%s)", c->name, dot, known);
	else if (kind < 0)
		return pm_fail(PM_USAGE, "--output '%s' has no ending, which says the kind of picture (%s, or give --format)", c->name, known);
	else if (asked >= 0 && asked != kind)
		return pm_fail(PM_USAGE, "--output '%s' ends in '%s', but --format is %s (leave --format out, or change the ending)", c->name, dot, format);
	c->kind = (enum pm_picture_kind)kind;
	if (kind != PM_PICTURE_MP4 && kind != PM_PICTURE_HTML)
		return 0;
	if (strchr(c->name, '%') || (kind == PM_PICTURE_MP4 && !strcmp(c->name, "-")))
		return pm_fail(PM_USAGE, "--output '%s': a %s is one file%s", c->name, kind == PM_PICTURE_MP4 ? "movie" : "page", strchr(c->name, '%') ?
			"" : " with a name");
	return kind == PM_PICTURE_MP4 ? pm_movie_possible() : 0;
}

/* The name of the picture of this frame. */
static int name_of(const struct pm_picture_files *c, uint64_t frame, bool series, char out[4096])
{
	const char *place, *behind;
	int width, there = number_place(c->name, &place, &behind, &width);
	if (!there && frame > 1 && !series)
		return pm_fail(PM_USAGE, "'%s' would be overwritten (give --output a name with %%04d, or choose a frame with sel)", c->name);
	if (there)
		snprintf(out, 4096, "%.*s%0*llu%s", (int)(place - c->name), c->name, width, (unsigned long long)frame, behind);
	else
		snprintf(out, 4096, "%s", c->name);
	return 0;
}

/* All pictures into one file. */
static int add_movie(struct pm_picture_files *c, const struct pm_picture *p)
{
	c->movie.name = c->name, c->movie.fps = c->fps;
	return pm_movie_add(&c->movie, p);
}

int pm_picture_files_write(struct pm_picture_files *c, const struct pm_picture *p, uint64_t frame)
{
	const bool ppm = c->kind == PM_PICTURE_PPM, series = ppm && !strchr(c->name, '%');
	char name[4096];
	if (pm_world_rank()) /* rank 0 has the picture */
		return 0;
	if (c->kind == PM_PICTURE_MP4)
		return add_movie(c, p);
	int status = name_of(c, frame, series, name);
	if (status)
		return status;
	if (!strcmp(c->name, "-"))
		return ppm ? pm_picture_ppm(p, stdout) : pm_picture_png(p, stdout);
	FILE *out = series && c->series ? c->series : fopen(name, "wb");
	if (!out)
		return pm_fail_errno("cannot write '%s'", name);
	status = ppm ? pm_picture_ppm(p, out) : pm_picture_png(p, out);
	if (series)
		c->series = out;
	else if (fclose(out) && !status)
		status = pm_fail_errno("cannot write '%s'", name);
	if (!status && !(series && frame > 1))
		puts(name);
	return status;
}

int pm_picture_files_close(struct pm_picture_files *c)
{
	FILE *series = c->series;
	c->series = NULL;
	if (series && fclose(series))
		return pm_fail_errno("cannot write '%s'", c->name);
	int status = pm_movie_end(&c->movie);
	if (c->movie.width && !status)
		puts(c->name);
	return status;
}

void pm_picture_files_drop(struct pm_picture_files *c)
{
	if (c->series)
		fclose(c->series);
	c->series = NULL;
	pm_movie_drop(&c->movie);
}
