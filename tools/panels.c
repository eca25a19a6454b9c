/* panels: solid walls in a flow by boundary elements (lib/panels/). SPDX-License-Identifier: GPL-3.0-or-later */
#include <string.h>

#include "panels/surface-frame.h"
#include "stage/stage.h"

struct config {
	struct pm_panels_choice choice;
	const char *kind;
	int64_t n;
};
struct state {
	struct pm_panels_job job;
	struct pm_panels_solver solver;
};

/* In space walls are of sources, and there are other panels without -n. */
static int declare(struct pm_stage *s, struct pm_frame *f)
{
	struct config *o = s->config;
	struct pm_panels_job *job = &((struct state *)s->state)->job;
	const bool space = f->dim == 3;
	o->choice.source = o->kind ? !strcmp(o->kind, "source") : space;
	o->choice.n = o->n > 0 ? (size_t)o->n : space ? PM_PANELS_SURFACE : PM_PANELS_CURVE;
	if (!space && o->choice.surface)
		return pm_fail(PM_USAGE, "--surface is a wall in space, and this frame is in %d-D (--curve)", f->dim);
	if (!space && o->choice.source && o->choice.circulation != 0)
		return pm_fail(PM_USAGE, "sources have no circulation (--kind vortex)");
	return space ? pm_surface_declare(&o->choice, f, job) : pm_panels_declare(&o->choice, f, job);
}

static int frame(struct pm_stage *s, struct pm_frame *f)
{
	struct state *t = s->state;
	struct pm_panels_solved done;
	int status = (f->dim == 3 ? pm_surface_apply : pm_panels_apply)(&((const struct config *)s->config)->choice, f, &t->job, &t->solver, &done);
	if (status)
		return status;
	pm_report(s, f, "leak", done.leak);
	pm_report(s, f, "slack", done.slack);
	return 0;
}

static void release(struct pm_stage *s) { pm_panels_solver_free(&((struct state *)s->state)->solver); }

static const char *const kinds[] = {"vortex", "source", NULL};
static const struct pm_option options[] = {
	{.name = "curve", .kind = PM_TEXT, .unit = "EXPRESSION", PM_AT(choice.curve),
		.text = "the wall, counter-clockwise: x and y of s = 0 to 1 with a comma between, closed, also of time (default: the corners are in the set)"},
	{.name = "surface", .kind = PM_TEXT, .unit = "EXPRESSION", PM_AT(choice.surface),
		.text = "in space, the wall: x, y and z of the points x y z of the unit sphere, also of time (default: the corners are in the set)"},
	{.name = "pieces", .letter = 'n', .kind = PM_INTEGER, .unit = "panels", .low = 3, .high = 20000, PM_AT(n),
		.text = "panels of the curve, at equal steps of s (default 200), or triangles of the surface, 20 m^2 of the icosahedron (default 1280)"},
	{.name = "kind", .kind = PM_WORD, .choices = kinds, PM_AT(kind),
		.text = "a vortex sheet, which is the slip at the wall (default in the plane), or sources, for walls that turn or grow (in space)"},
	{.name = "stream", .kind = PM_TEXT, .unit = "EXPRESSION", PM_AT(choice.stream),
		.text = "a flow besides that of the vorticity at x y, such as the one that field 'vel = 1, 0' gives the particles"},
	{.name = "velocity", .kind = PM_TEXT, .unit = "EXPRESSION", PM_AT(choice.velocity), .text = "of the wall at x y (default: at rest)"},
	{.name = "circulation", .kind = PM_REAL, .unit = "length^2/time", .fallback = "0", .low = -1e300, .high = 1e300, PM_AT(choice.circulation),
		.text = "of the sheet of each curve"},
	{.name = "softening", .kind = PM_REAL, .unit = "length", .low = 0, .high = 1e300, PM_AT(choice.softening),
		.text = "core of the vortices as the wall feels them (default: the frame's constant softening, else (volume)^(1/2), else none)"},
	{.name = "panels", .kind = PM_TEXT, .unit = "NAME", .fallback = "panels", PM_AT(choice.name), .text = "the set of panels"},
	{.name = "set", .kind = PM_TEXT, .unit = "NAME", PM_AT(choice.set), .text = "move this set only; vortices of all sets act on the wall"},
	{.name = "replace", .kind = PM_FLAG, PM_AT(choice.replace), .text = "replace the term panels if it is already there"},
	{0},
};
static const struct pm_example examples[] = {
	{"the slip at a cylinder in a stream, -2 sin(2 pi s)", "pinit vortex-pair | panels --curve '9+cos(2*pi*s), 9+sin(2*pi*s)' -n 40 --stream '1, 0' | "
		"sel --set panels | stab --plain --set panels"},
	{"the largest slip at a sphere in a stream, 1.5",
		"pinit vortex-ring --core 0.2 --cells 32x32x16 | panels --surface 'x, y, z+9' -n 320 --stream '0, 0, 1' | sls"},
	{0},
};
const struct pm_tool tool_panels = {
	.name = "panels",
	.summary = "solid walls in a flow: nothing flows through closed curves or surfaces, by boundary elements",
	.about = "vel += the flow of a vortex sheet, or of sources, on flat panels of constant strength (in space: sources on triangles), such "
		"that with the vortices and the stream nothing "
		"flows through the wall. The strengths follow from dense equations, factored once for a shape. Makes the fixed set panels with corners, "
		"normal, area (in the plane a length), and the strength, sheet or source. In space vortices are stretched too (dalpha). Reports the "
		"largest mean flow "
		"through a panel (leak). See docs/methods/panels.md.",
	.kind = PM_FILTER,
	.makes = true,
	.reads = "x, circulation or alpha, volume",
	.adds = "vel and dalpha (term panels), the set panels",
	.config = sizeof(struct config),
	.state = sizeof(struct state),
	.options = options,
	.examples = examples,
	.declare = declare,
	.frame = frame,
	.free = release,
};
