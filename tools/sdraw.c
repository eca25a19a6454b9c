/* sdraw: pictures of a mesh field or of particles: a PNG per frame, a movie, or a page for a browser (docs/methods/pictures.md).
 * SPDX-License-Identifier: GPL-3.0-or-later */
#include <errno.h>
#include <stdlib.h>
#include <string.h>

#include "picture/colour.h"
#include "picture/picture-file.h"
#include "picture/view.h"
#include "stage/stage.h"
#include "viewer/viewer.h"
#include "world/launch.h"

static const char *const axes[] = {"x", "y", "z", NULL}, *const styles[] = {"auto", "points", "density", NULL};
static const char *const maps[] = {"auto", "viridis", "magma", "inferno", "grey", "coolwarm", NULL};

struct config {
	const char *field, *mesh, *set, *x, *y, *colour, *weight, *title, *component, *axis, *map, *format, *style, *output;
	double slice, fps;
	struct pm_vector range, window;
	int64_t size;
	bool project, log, linear;
};

struct state {
	uint64_t frame;
	struct pm_view view;
	struct pm_picture_files files;
	struct pm_viewer page;
};

static const struct pm_option options[] = {
	{.name = "output", .letter = 'o', .kind = PM_TEXT, .unit = "FILE", .fallback = "frame-%04d.png", .cosmetic = true, PM_AT(output),
		.text = "the file to write, whose ending says its kind; %d or %04d stands for the number of the frame"},
	{.name = "format", .kind = PM_WORD, .choices = pm_picture_kinds, .cosmetic = true, PM_AT(format),
		.text = "the kind where --output has no ending; png: a file a frame; ppm: all frames in sequence, to standard output unless --output is given"},
	{.name = "fps", .kind = PM_REAL, .unit = "1/s", .fallback = "25", .low = 0.1, .high = 240, PM_AT(fps),
		.text = "pictures per second of a movie (.mp4)"},
	{.name = "field", .letter = 'f', .kind = PM_TEXT, .unit = "NAME", PM_AT(field), .text = "draw this mesh field; if only particles have it, as colour"},
	{.name = "mesh", .kind = PM_TEXT, .unit = "NAME", PM_AT(mesh), .text = "draw a field of this mesh (the last field if --field is missing)"},
	{.name = "component", .kind = PM_TEXT, .unit = "x|y|z|NUMBER", PM_AT(component), .text = "component of a vector field (default: its length)"},
	{.name = "axis", .kind = PM_WORD, .fallback = "z", .choices = axes, PM_AT(axis), .text = "the axis normal to the slice or along the projection (3-D)"},
	{.name = "slice", .kind = PM_REAL, .unit = "length", PM_AT(slice), .text = "position of the slice (default: the middle of the box)"},
	{.name = "project", .kind = PM_FLAG, PM_AT(project), .text = "the integral along the axis instead of a slice"},
	{.name = "set", .kind = PM_TEXT, .unit = "NAME", PM_AT(set), .text = "draw the particles of this set"},
	{.name = "x", .kind = PM_TEXT, .unit = "EXPRESSION", PM_AT(x), .text = "horizontal coordinate for particles (default: x)"},
	{.name = "y", .kind = PM_TEXT, .unit = "EXPRESSION", PM_AT(y), .text = "vertical coordinate for particles (default: y; vx in 1-D)"},
	{.name = "colour", .kind = PM_TEXT, .unit = "EXPRESSION", PM_AT(colour), .text = "expression that colours the points"},
	{.name = "weight", .kind = PM_TEXT, .unit = "EXPRESSION", PM_AT(weight), .text = "weight of a particle in the density (default: 1)"},
	{.name = "style", .kind = PM_WORD, .fallback = "auto", .choices = styles, PM_AT(style),
		.text = "points, or density; auto: density from 4000 particles on unless they are coloured"},
	{.name = "log", .kind = PM_FLAG, PM_AT(log), .text = "logarithmic colour scale"},
	{.name = "linear", .kind = PM_FLAG, PM_AT(linear), .text = "linear colour scale for a density, not logarithmic"},
	{.name = "range", .kind = PM_VECTOR, .unit = "LO,HI", PM_AT(range), .text = "values at the ends of the colour scale (default: the frame's range)"},
	{.name = "area", .kind = PM_VECTOR, .unit = "XLO,XHI,YLO,YHI", PM_AT(window), .text = "the area to show (default: the box)"},
	{.name = "map", .kind = PM_WORD, .fallback = "auto", .choices = maps, PM_AT(map), .text = "colours; auto: viridis for fields, inferno for densities, "
		"coolwarm for numbers of both signs"},
	{.name = "size", .kind = PM_INTEGER, .unit = "pixels", .fallback = "640", .low = 64, .high = 8192, PM_AT(size),
		.text = "the longer side of the data area"},
	{.name = "title", .kind = PM_TEXT, .unit = "TEXT", PM_AT(title), .text = "title (default: scene, field, time and step)"},
	{0},
};

static bool is_page(const struct pm_stage *s) { return ((struct state *)s->state)->files.kind == PM_PICTURE_HTML; }

static int begin_page(struct pm_stage *s)
{
	const struct config *c = s->config;
	struct state *st = s->state;
	static const char *const others[] = {"project", "weight", "area", "style", "linear", "size"};
	for (size_t i = 0; i < sizeof others / sizeof *others; i++)
		if (pm_given(s, others[i]))
			return pm_fail(PM_USAGE, "--%s is for pictures; a page shows this by itself (leave it out)", others[i]);
	st->page = (struct pm_viewer){.name = st->files.name, .title = c->title, .map = pm_given(s, "map") ? c->map : NULL, .component = c->component,
		.fps = c->fps, .range = {c->range.x[0], c->range.x[1]}, .nrange = c->range.n, .slice = c->slice, .axis = *c->axis - 'x', .log = c->log,
		.choice = {.set = c->set, .mesh = c->mesh, .field = c->field, .x = c->x, .y = c->y, .colour = c->colour}};
	return 0;
}

static int begin(struct pm_stage *s)
{
	const struct config *c = s->config;
	struct state *st = s->state;
	const bool piped = c->format && strcmp(c->format, "png") && !pm_given(s, "output");
	st->files.name = piped ? "-" : c->output;
	st->files.fps = c->fps;
	if (pm_picture_files_check(&st->files, c->format))
		return pm_failed();
	if (c->range.n && (c->range.n != 2 || !(c->range.x[1] > c->range.x[0])))
		return pm_fail(PM_USAGE, "--range takes LO,HI with LO below HI");
	if (c->window.n && (c->window.n != 4 || !(c->window.x[1] > c->window.x[0]) || !(c->window.x[3] > c->window.x[2])))
		return pm_fail(PM_USAGE, "--area takes XLO,XHI,YLO,YHI with each LO below its HI");
	if (c->component && pm_view_component(c->component) < 0)
		return pm_fail(PM_USAGE, "--component '%s' is none of x, y, z or a number from 0 to %d", c->component, PM_COMPONENTS - 1);
	if (c->project && !isnan(c->slice))
		return pm_fail(PM_USAGE, "--project and --slice exclude each other");
	if (c->log && c->linear)
		return pm_fail(PM_USAGE, "--log and --linear exclude each other");
	if (piped && pm_output_is_terminal())
		return pm_fail(PM_USAGE, "a picture cannot be written to a terminal (give --output FILE, or a pipe)");
	if (is_page(s))
		return begin_page(s);
	st->view = (struct pm_view){.field = c->field, .mesh = c->mesh, .set = c->set, .x = c->x, .y = c->y, .colour = c->colour, .weight = c->weight,
		.title = c->title,
		.component = c->component ? pm_view_component(c->component) : -1, .axis = *c->axis - 'x', .slice = c->slice, .project = c->project,
		.points = !strcmp(c->style, "points"), .density = !strcmp(c->style, "density"), .log = c->log, .linear = c->linear,
		.map = pm_colour_find(c->map), .nrange = c->range.n, .range = {c->range.x[0], c->range.x[1]}, .nwindow = c->window.n,
		.window = {c->window.x[0], c->window.x[1], c->window.x[2], c->window.x[3]}, .size = (int)c->size};
	return 0;
}

static int declare(struct pm_stage *s, struct pm_frame *f)
{
	struct state *st = s->state;
	return is_page(s) ? pm_viewer_reads(&st->page, f) : pm_view_plan(&st->view, f);
}

static int frame(struct pm_stage *s, struct pm_frame *f)
{
	struct state *st = s->state;
	struct pm_plot plot;
	st->frame++;
	if (is_page(s))
		return pm_viewer_add(&st->page, f);
	int status = pm_view_draw(&st->view, f, &plot);
	if (!status)
		status = pm_picture_files_write(&st->files, &plot.picture, st->frame);
	pm_plot_free(&plot);
	return status;
}

/* A curve is of a mesh in 1-D, which is on one rank, and a page holds whole frames. */
static bool divided(const struct pm_stage *s, const struct pm_frame *f) { return !is_page(s) && !(((struct state *)s->state)->view.on_mesh && f->dim == 1); }

static int end(struct pm_stage *s)
{
	struct state *st = s->state;
	char left_out[320];
	if (!is_page(s))
		return pm_picture_files_close(&st->files);
	pm_viewer_left_out(&st->page, left_out);
	if (*left_out)
		pm_note(s, "the page has %s", left_out);
	return pm_viewer_end(&st->page);
}

static void done(struct pm_stage *s)
{
	pm_picture_files_drop(&((struct state *)s->state)->files);
	pm_viewer_drop(&((struct state *)s->state)->page);
}

static const struct pm_example examples[] = {
	{"The particles of a scene seen along z.", "pinit plummer -n 20000 | sdraw -o plummer.png"},
	{"A slice of the density, coloured by its logarithm.", "pinit plummer -n 20000 | p2m -n 64 | sdraw --field rho --project --log -o rho.png"},
	{"Radius against radial velocity, coloured by the speed.", "pinit plummer -n 1000 | sdraw --x 'sqrt(x^2+y^2+z^2)' --y "
		"'(x*vx+y*vy+z*vz)/sqrt(x^2+y^2+z^2)' --colour 'hypot(vx,vy,vz)' -o phase.png"},
	{"A page that turns the cluster in a browser.", "pinit plummer -n 5000 | sdraw -o cluster.html"},
	{0}};

const struct pm_tool tool_sdraw = {
	.name = "sdraw",
	.summary = "pictures of a mesh field or of particles",
	.about = "Draws every frame as a PNG file and prints the names of the files. Without options the particles of the first set, as points or as "
		"density; with --field a mesh field: a slice or a projection in 3-D, the field in 2-D, a curve in 1-D. A triangle at an end of the colour bar "
		"means that some values lie beyond it. "
		 "A movie: sdraw -o run.mp4 --range LO,HI, which needs ffmpeg. A page with all frames for a browser: sdraw -o run.html.",
	.kind = PM_SINK,
	.config = sizeof(struct config),
	.state = sizeof(struct state),
	.options = options,
	.examples = examples,
	.begin = begin,
	.declare = declare,
	.frame = frame,
	.divided = divided,
	.end = end,
	.free = done,
};
