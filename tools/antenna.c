/* antenna: a sheet of current that sends light into the box (lib/maxwell-step/antenna.c). SPDX-License-Identifier: GPL-3.0-or-later */
#include <string.h>

#include "maxwell-step/antenna.h"
#include "stage/stage.h"

struct config {
	const char *mesh, *axis, *term;
	double place;
};
struct state {
	struct pm_antenna antenna;
};

static int begin(struct pm_stage *s)
{
	s->advances = true; /* as p2m --current: no current is there before the first step */
	return 0;
}

static int declare(struct pm_stage *s, struct pm_frame *f)
{
	const struct config *o = s->config;
	const struct pm_antenna_choice c = {.mesh = o->mesh, .term = o->term, .wave = s->args, .waves = s->nargs, .axis = *o->axis - 'x', .place = o->place};
	return pm_antenna_declare(&c, f, &((struct state *)s->state)->antenna);
}

static int frame(struct pm_stage *s, struct pm_frame *f) { return pm_antenna_add(&((struct state *)s->state)->antenna, f); }

static const char *const axes[] = {"x", "y", "z", NULL};
static const struct pm_option options[] = {
	{.name = "axis", .kind = PM_WORD, .fallback = "x", .choices = axes, PM_AT(axis), .text = "along which the light goes, both ways"},
	{.name = "place", .kind = PM_REAL, .unit = "length", .low = -1e300, .high = 1e300, PM_AT(place),
		.text = "place of the sheet on this axis, to the nearest node (default: two cells inside the absorbing layer at the lower face)"},
	{.name = "term", .kind = PM_TEXT, .unit = "NAME", .fallback = "antenna", PM_AT(term), .text = "name of its part of J: one for each sheet of several"},
	{.name = "mesh", .kind = PM_TEXT, .unit = "NAME", PM_AT(mesh), .text = "the mesh (default: the first)"},
	{0},
};
static const struct pm_example examples[] = {
	{"a pulse of light goes through a box with open faces",
		"pinit em-wave --cells 128 | sel --drop E,B | smod --faces open --constant background=0 | p2m | maxwell --gauss | cycle -n 160 --every 40 "
		"\"push boris/2 | p2m --current | antenna 'Ey = sin(8*time)*exp(-(time-1.5)^2)' | maxwell | push drift | m2p | push boris/2\" | diag"},
	{0},
};
const struct pm_tool tool_antenna = {
	.name = "antenna",
	.summary = "send light into the box from a sheet of current",
	.about = "J += -2 eps0 c E0/h on the plane of nodes nearest to --place, where Ey = E0(time, y, z) and so on are the arguments: the wave "
		"E0(t - |x - a|/c) goes to both sides. Names: time (the middle of the step), x y z, the constants of the frame. Put it between p2m --current "
		"and maxwell; it is left out of priming. Light and matter pass through the sheet. See docs/methods/antenna.md.",
	.kind = PM_FILTER,
	.makes = true,
	.adds = "J (mesh, term antenna)",
	.config = sizeof(struct config),
	.state = sizeof(struct state),
	.options = options,
	.arguments = "COMPONENT=EXPRESSION...",
	.arguments_text = "'Ey = EXPRESSION', E of the light at the sheet; components across --axis",
	.least = 1,
	.most = 2,
	.examples = examples,
	.begin = begin,
	.declare = declare,
	.frame = frame,
};
