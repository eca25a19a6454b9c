/* maxwell: E and B on the mesh through one step (lib/maxwell, lib/maxwell-parts). SPDX-License-Identifier: GPL-3.0-or-later */
#include <string.h>

#include "maxwell-step/maxwell-frame.h"
#include "stage/stage.h"

struct config {
	const char *mesh, *method;
	int64_t layers, marder;
	bool gauss, nodal;
	struct pm_vector drift;
};
struct state {
	struct pm_maxwell_job job; /* from declare to frame */
};

static int begin(struct pm_stage *s)
{
	const struct config *o = s->config;
	s->advances = true;
	if (o->drift.n && strcmp(o->method, "psatd"))
		return pm_fail(PM_USAGE, "--current-drift belongs to --method psatd");
	if (o->nodal && !(o->gauss && !strcmp(o->method, "psatd")))
		return pm_fail(PM_USAGE, "--nodal says where --gauss --method psatd makes E (a step takes E where it is)");
	if (o->drift.n > 3)
		return pm_fail(PM_USAGE, "--current-drift has more than 3 components");
	if (o->gauss && o->marder)
		return pm_fail(PM_USAGE, "--gauss or --marder, not both: the first leaves nothing for the second");
	if ((o->gauss || o->marder) && pm_given(s, "layers"))
		return pm_fail(PM_USAGE, "--%s advances nothing (leave out --layers)", o->gauss ? "gauss" : "marder");
	return 0;
}

static int declare(struct pm_stage *s, struct pm_frame *f)
{
	const struct config *o = s->config;
	const bool corrects = o->gauss || o->marder;
	struct pm_maxwell_choice choice = {.mesh = o->mesh, .method = corrects && !pm_given(s, "method") ? NULL : o->method, .gauss = corrects,
		.marder = (int)o->marder, .nodal = o->nodal, .layers = (int)o->layers};
	for (int d = 0; d < o->drift.n; d++)
		choice.drift[d] = o->drift.x[d];
	if (o->drift.n > f->dim)
		return pm_fail(PM_DATA, "--current-drift has %d components, and the mesh %d axes", o->drift.n, f->dim);
	return pm_maxwell_declare(&choice, f, &((struct state *)s->state)->job);
}

static int frame(struct pm_stage *s, struct pm_frame *f)
{
	struct pm_maxwell_job *j = &((struct state *)s->state)->job;
	struct pm_gauss_record r;
	if (!j->choice.gauss)
		return pm_maxwell_step(j, f->dt);
	int status = pm_maxwell_project(j, &r);
	if (status)
		return status;
	pm_report(s, f, "residual", r.before);
	if (r.mean != 0)
		pm_report(s, f, "mean", r.mean);
	return 0;
}

static bool divided(const struct pm_stage *s, const struct pm_frame *f) { return s && f && f->dim > 1; }

static const struct pm_option options[] = {
	{.name = "method", .kind = PM_WORD, .fallback = "yee", .choices = pm_maxwell_names, PM_AT(method),
		.text = "the differences; with --gauss those of Gauss's law (default: that of the method that made E)"},
	{.name = "mesh", .kind = PM_TEXT, .unit = "NAME", PM_AT(mesh), .text = "the mesh (default: the first)"},
	{.name = "layers", .kind = PM_INTEGER, .unit = "cells", .fallback = "10", .low = 1, .high = 1000, PM_AT(layers),
		.text = "thickness of the layers that absorb waves inside open faces"},
	{.name = "gauss", .kind = PM_FLAG, PM_AT(gauss),
		.text = "instead of a step: correct E so that div E = rho/eps0, or make it; rho is that of p2m"},
	{.name = "marder", .kind = PM_INTEGER, .unit = "PASSES", .fallback = "0", .high = 1000000, PM_AT(marder),
		.text = "instead of a step: diffuse what is wrong in div E = rho/eps0 away, the shortest waves at once, longer ones slowly"},
	{.name = "nodal", .kind = PM_FLAG, PM_AT(nodal),
		.text = "with --gauss --method psatd: all components of E, and B, on the nodes; against numerical Cherenkov radiation"},
	{.name = "current-drift", .kind = PM_VECTOR, .unit = "length/time", PM_AT(drift),
		.text = "of --method psatd: currents move on with this velocity during a step, that of a beam; against numerical Cherenkov radiation"},
	{0},
};
static const struct pm_example examples[] = {
	{"a wave in vacuum over four periods of its box, and its energy",
		"pinit em-wave --cells 32 | cycle -n 128 --every 32 'push boris/2 | p2m --current | maxwell | push drift | m2p | push boris/2' | diag"},
	{"the field of charges at rest", "pinit langmuir -n 64 --cells 16 | smod --law electromagnetic | p2m | maxwell --gauss | sls"},
	{0},
};
const struct pm_tool tool_maxwell = {
	.name = "maxwell",
	.summary = "advance electric and magnetic fields on the mesh by a step",
	.about = "B' = -curl E, E' = c^2 curl B - J/eps0 on Yee's mesh: B by half a step, E by one, B by half. E and B are at the end of the step then, "
		"before the particles are (push boris/2 | p2m --current | maxwell | push drift | m2p | push boris/2). J is used up. Faces: periodic; wall, a "
		"perfect conductor; neumann, a plane of symmetry in which E lies; open and absorbing, absorbing layers inside the mesh. A step above "
		"the limit of the method is refused. Constants c and eps0 of the frame, both 1 if absent.",
	.kind = PM_FILTER,
	.reads = "J (mesh); with --gauss, --marder rho",
	.changes = "E, B, and the memory of absorbing layers pml_x, pml_y, pml_z (mesh)",
	.adds = "B of zeros where there is none; with --gauss E",
	.config = sizeof(struct config),
	.state = sizeof(struct state),
	.options = options,
	.examples = examples,
	.begin = begin,
	.declare = declare,
	.frame = frame,
	.divided = divided,
};
