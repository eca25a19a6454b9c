/* phase: particles counted on a mesh whose axes are expressions: phase space, distributions (lib/measure/phase-space.c).
 * SPDX-License-Identifier: GPL-3.0-or-later */
#include <string.h>

#include "measure/phase-space.h"
#include "stage/stage.h"

struct config {
	const char *set, *weight, *kernel;
	struct pm_cells cells;
	struct pm_vector box;
};
struct state {
	struct pm_phase_choice choice;
	struct pm_phase_sets sets;
};

static int begin(struct pm_stage *s)
{
	const struct config *o = s->config;
	struct pm_phase_choice *c = &((struct state *)s->state)->choice;
	*c = (struct pm_phase_choice){.axes = s->nargs, .weight = o->weight, .set = o->set, .kernel = pm_kernel_find(o->kernel),
		.box = o->box.n ? o->box.x : NULL};
	for (int d = 0; d < c->axes; d++)
		c->axis[d] = s->args[d];
	if (!c->kernel)
		return -PM_USAGE;
	if (o->box.n && o->box.n != 2 * c->axes)
		return pm_fail(PM_USAGE, "--box has %d numbers, and %d axes need %d: all low ends, then all high ones", o->box.n, c->axes, 2 * c->axes);
	return pm_cells_for(&o->cells, c->axes, c->cells) ? -PM_USAGE : 0;
}

static int declare(struct pm_stage *s, struct pm_frame *f)
{
	struct state *state = s->state;
	int status = pm_phase_declare(&state->choice, f, &state->sets);
	return status ? status : PM_HOLD;
}

static int frame(struct pm_stage *s, struct pm_frame *f)
{
	const struct state *state = s->state;
	uint64_t outside = 0;
	int status = pm_phase_frame(&state->choice, &state->sets, f, &outside);
	if (!status && outside)
		pm_report_count(s, f, "outside", outside);
	return status;
}

static const struct pm_option options[] = {
	{.name = "cells", .letter = 'n', .kind = PM_CELLS, .unit = "cells", .fallback = "128", PM_AT(cells), .text = "cells of the mesh, as 128 or 64x256"},
	{.name = "box", .kind = PM_VECTOR, .unit = "LOW,HIGH", PM_AT(box),
		.text = "all low ends, then all high ones (default: the box for x, y, z, else where particles are in this frame, rounded outwards)"},
	{.name = "set", .kind = PM_TEXT, .unit = "NAME", PM_AT(set), .text = "only this set (default: all that have particles, together)"},
	{.name = "weight", .kind = PM_TEXT, .unit = "EXPRESSION", PM_AT(weight), .text = "what each particle counts (default: its mass, 1 without)"},
	{.name = "kernel", .letter = 'k', .kind = PM_WORD, .fallback = "cic", .choices = pm_kernel_names, PM_AT(kernel),
		.text = "how a particle is spread over the cells"},
	{0},
};

static const struct pm_example examples[] = {
	{"a picture of the phase space of two streams", "pinit two-stream -n 4000 --vth 0.2 | phase x vx -n 64 | sdraw -o phase.png"},
	{"the distribution of a velocity, as a table", "pinit landau -n 4000 | phase vx --box=-5,5 -n 20 | stab --plain --mesh phase"},
	{0},
};

const struct pm_tool tool_phase = {
	.name = "phase",
	.summary = "count particles on a mesh whose axes are expressions: phase space and distributions",
	.about = "Makes of every frame one of one, two or three dimensions, whose axes are the expressions given, with the mesh `phase` and on it f, "
		"the sum of the weights of the particles per volume of these axes, so that f integrates to the sum of the weights. sdraw draws it, "
		"stab prints it, spectrum and mgrad take it. An axis that is a coordinate of a periodic box is periodic. "
		"Particles beyond the box are reported as outside. See docs/methods/phase.md.",
	.kind = PM_FILTER,
	.reads = "the fields in the expressions, mass",
	.adds = "the mesh phase with f; everything else is left out",
	.config = sizeof(struct config),
	.state = sizeof(struct state),
	.options = options,
	.arguments = "EXPRESSION...",
	.arguments_text = "The axes: x vx, or vx vy.",
	.least = 1,
	.most = 3,
	.examples = examples,
	.begin = begin,
	.declare = declare,
	.frame = frame,
};
