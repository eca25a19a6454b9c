/* ecsim: the field of charges on a line, advanced together with their velocities so that energy stays (lib/ecsim). SPDX-License-Identifier: GPL-3.0-or-later */
#include "ecsim/ecsim.h"
#include "stage/stage.h"

struct config {
	const char *mesh;
	bool gauss;
};

static struct pm_ecsim ecsim_of(const struct config *o) { return (struct pm_ecsim){.mesh = o->mesh, .gauss = o->gauss}; }

static int begin(struct pm_stage *s)
{
	s->advances = true; /* the field by a step */
	return 0;
}

static int declare(struct pm_stage *s, struct pm_frame *f)
{
	const struct pm_ecsim c = ecsim_of(s->config);
	const int status = pm_ecsim_declare(&c, f);
	return status < 0 ? status : status ? 0 : PM_PASS;
}

static int frame(struct pm_stage *s, struct pm_frame *f)
{
	const struct pm_ecsim c = ecsim_of(s->config);
	struct pm_ecsim_record r;
	const int status = pm_ecsim_step(&c, f, &r);
	if (status)
		return status;
	pm_report(s, f, "energy", r.energy);
	if (c.gauss)
		pm_report(s, f, "residual", r.residual);
	return 0;
}

static const struct pm_option options[] = {
	{.name = "gauss", .kind = PM_FLAG, PM_AT(gauss), .text = "make E of the charge, by Gauss's law, between steps; nothing advances"},
	{.name = "mesh", .kind = PM_TEXT, .unit = "NAME", PM_AT(mesh), .text = "the mesh (default: the first)"},
	{0},
};
static const struct pm_example examples[] = {
	{"two streams with steps of 1/omega_p: energy stays", "pinit two-stream -n 2000 --cells 32 --dt 1 | ecsim --gauss | "
		"cycle -n 40 'push drift/2 | ecsim | push kick drift/2' | sls --report"},
	{"how far E is from the charge after them", "pinit two-stream -n 2000 --cells 32 | ecsim --gauss | "
		"cycle -n 40 'push drift/2 | ecsim | push kick drift/2' | ecsim --gauss | sls --report"},
	{0},
};
const struct pm_tool tool_ecsim = {
	.name = "ecsim",
	.summary = "advance the field of charges on a line with their velocities, so that energy is conserved",
	.about = "The energy-conserving semi-implicit method in 1-D: v' = v + dt (q/m) Eh(x), E' = E - dt/eps0 J, Eh = (E + E')/2, J of (v + v')/2, solved "
		"directly, at the places in the middle of the step: push drift/2 | ecsim | push kick drift/2. Kinetic and field energy add up to a constant to "
		"round-off for any step and any cell, also where cells are many Debye lengths and omega_p dt is above 2. E is a state of the mesh, half a "
		"cell off the nodes; ecsim --gauss makes it at the start. Periodic faces, law electrostatic, no magnetic field. Reports the energy of the "
		"field. See docs/methods/ecsim.md.",
	.kind = PM_FILTER,
	.makes = true,
	.reads = "x, v, charge, mass",
	.changes = "E (mesh)",
	.adds = "acc (term self); with --gauss E",
	.config = sizeof(struct config),
	.options = options,
	.examples = examples,
	.begin = begin,
	.declare = declare,
	.frame = frame,
};
