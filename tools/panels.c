/* panels: solid walls in a plane flow by boundary elements (lib/panels/). SPDX-License-Identifier: GPL-3.0-or-later */
#include <string.h>

#include "panels/panels-frame.h"
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

static int begin(struct pm_stage *s)
{
	struct config *o = s->config;
	o->choice.source = !strcmp(o->kind, "source");
	o->choice.n = (size_t)o->n;
	if (o->choice.source && o->choice.circulation != 0)
		return pm_fail(PM_USAGE, "sources have no circulation (--kind vortex)");
	return 0;
}

static int declare(struct pm_stage *s, struct pm_frame *f)
{
	return pm_panels_declare(&((const struct config *)s->config)->choice, f, &((struct state *)s->state)->job);
}

static int frame(struct pm_stage *s, struct pm_frame *f)
{
	struct state *t = s->state;
	struct pm_panels_solved done;
	int status = pm_panels_apply(&((const struct config *)s->config)->choice, f, &t->job, &t->solver, &done);
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
	{.name = "pieces", .letter = 'n', .kind = PM_INTEGER, .unit = "panels", .fallback = "200", .low = 3, .high = 20000, PM_AT(n),
		.text = "panels of the curve, at equal steps of s"},
	{.name = "kind", .kind = PM_WORD, .fallback = "vortex", .choices = kinds, PM_AT(kind),
		.text = "a vortex sheet, which is the slip at the wall, or sources, for walls that turn or grow"},
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
	{0},
};
const struct pm_tool tool_panels = {
	.name = "panels",
	.summary = "solid walls in a plane flow: no flow through closed curves, by boundary elements",
	.about = "vel += the flow of a vortex sheet, or of sources, on flat panels of constant strength, such that with the vortices and the stream nothing "
		"flows through the wall. The strengths follow from dense equations, factored once for a shape. Makes the fixed set panels with corners, "
		"normal, length and the strength, sheet or source. Reports the largest flow through a midpoint (leak). See docs/methods/panels.md.",
	.kind = PM_FILTER,
	.makes = true,
	.reads = "x, circulation, volume",
	.adds = "vel (term panels), the set panels",
	.config = sizeof(struct config),
	.state = sizeof(struct state),
	.options = options,
	.examples = examples,
	.begin = begin,
	.declare = declare,
	.frame = frame,
	.free = release,
};
