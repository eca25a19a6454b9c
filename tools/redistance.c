/* redistance: a level made the signed distance from its interface (lib/level/redistance.c). SPDX-License-Identifier: GPL-3.0-or-later */
#include "level/level-frame.h"
#include "stage/stage.h"

struct config {
	const char *field, *set, *mesh;
	int64_t every;
};

static int declare(struct pm_stage *s, struct pm_frame *f)
{
	const struct config *o = s->config;
	const char *set = o->set;
	return f->substep || f->step % o->every ? PM_PASS : pm_level_declare(f, &set, o->field, o->mesh);
}

static int frame(struct pm_stage *s, struct pm_frame *f)
{
	const struct config *o = s->config;
	struct pm_redistance made;
	const int status = pm_level_redistance(f, o->set, o->field, o->mesh, &made);
	if (!status) {
		pm_report(s, f, "crossed", (double)made.crossed);
		pm_report(s, f, "linear", (double)made.linear);
		pm_report(s, f, "unsettled", (double)made.unsettled);
		if (!made.crossed)
			pm_tell_once(s, "'%s' has one sign at all nodes, so there is no interface and it stays as it is", o->field);
	}
	return status;
}

static const struct pm_option options[] = {
	{.name = "field", .kind = PM_TEXT, .unit = "NAME", .fallback = "level", PM_AT(field), .text = "the level, a value of particles with volumes"},
	{.name = "set", .kind = PM_TEXT, .unit = "NAME", PM_AT(set), .text = "the particles (default: the first set that has the field)"},
	{.name = "mesh", .kind = PM_TEXT, .unit = "NAME", PM_AT(mesh), .text = "the mesh on which the interface is found (default: the first)"},
	{.name = "every", .kind = PM_INTEGER, .unit = "steps", .fallback = "1", .low = 1, .high = 1e15, PM_AT(every),
		.text = "act only if the step number is a multiple of this"},
	{0},
};
static const struct pm_example examples[] = {
	{"an ellipse given by a level that is no distance", "pinit lattice --dim 2 -n 1024 --cells 32 --spacing 1 | "
		"scalc --extensive 'volume = 1' | scalc --role state 'level = ((x - 16)/8)^2 + ((y - 16)/4)^2 - 1' | redistance | sls --data"},
	{0},
};
const struct pm_tool tool_redistance = {
	.name = "redistance",
	.summary = "make a level the signed distance from its interface (reinitialization of level sets)",
	.about = "level = +- distance from level = 0, with the old signs. The nearest points are found by Newton's method on an interpolant of order 3 and "
		"handed on in sweeps over the mesh. Without an interface the level stays as it is. Acts between steps only. See docs/methods/redistance.md.",
	.kind = PM_FILTER,
	.reads = "x, volume",
	.changes = "level",
	.config = sizeof(struct config),
	.options = options,
	.examples = examples,
	.declare = declare,
	.frame = frame,
};
