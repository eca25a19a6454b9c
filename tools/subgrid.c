/* subgrid: the scales below the mesh as a viscosity; lib/vorticity/subgrid.c, its models eddy-viscosity.c. SPDX-License-Identifier: GPL-3.0-or-later */
#include <string.h>

#include "fft/axis-transform.h"
#include "stage/plan-option.h"
#include "stage/stage.h"
#include "vorticity/subgrid.h"

struct config {
	const char *model, *form, *order, *mesh, *plan;
	double coefficient;
	bool replace;
};
struct state {
	struct pm_fft_plans planner;
	struct pm_subgrid subgrid;
};

static int begin(struct pm_stage *s)
{
	const struct config *o = s->config;
	if (!strcmp(o->model, "dynamic") && !isnan(o->coefficient))
		return pm_fail(PM_USAGE, "--model dynamic computes its coefficient (leave out --coefficient, or choose another model)");
	return 0;
}

static int declare(struct pm_stage *s, struct pm_frame *f)
{
	const struct config *o = s->config;
	struct pm_subgrid_choice choice = {.mesh = o->mesh, .order = o->order, .coefficient = o->coefficient, .replace = o->replace};
	while (strcmp(pm_eddy_names[choice.model], o->model))
		choice.model++;
	while (strcmp(pm_subgrid_forms[choice.form], o->form))
		choice.form++;
	return pm_subgrid_declare(&choice, f, &((struct state *)s->state)->subgrid);
}

static int frame(struct pm_stage *s, struct pm_frame *f)
{
	struct state *t = s->state;
	struct pm_subgrid_numbers r = {0};
	int status = pm_subgrid_add(&t->subgrid, &t->planner, &r);
	if (status)
		return status;
	pm_report(s, f, "nu_mean", r.mean);
	pm_report(s, f, "nu_largest", r.largest);
	pm_report(s, f, "dissipation", r.dissipation);
	if (t->subgrid.choice.model == PM_EDDY_DYNAMIC)
		pm_report(s, f, "factor", r.factor);
	if (r.factor < 0)
		pm_tell_once(s, "the dynamic factor is %.2g, so no energy goes to smaller scales: the viscosity is 0", r.factor);
	return 0;
}

static void release(struct pm_stage *s) { pm_fft_plans_clear(&((struct state *)s->state)->planner); }

static const struct pm_option options[] = {
	{.name = "model", .kind = PM_WORD, .fallback = "smagorinsky", .choices = pm_eddy_names, PM_AT(model),
		.text = "the eddy viscosity: of the strain; with the coefficient that the flow has (Germano, Lilly); 0 in pure shear (two); or of "
			"the fourth power of the wave number"},
	{.name = "coefficient", .kind = PM_REAL, .unit = "1", .low = 0, .high = 10, PM_AT(coefficient),
		.text = "C of smagorinsky and hyper (default: 0.17), of wale (default: 0.5), c of vreman (default: 0.07)"},
	{.name = "form", .kind = PM_WORD, .fallback = "stress", .choices = pm_subgrid_forms, PM_AT(form),
		.text = "curl div(2 nu_t S), by which energy falls; or -curl(nu_t curl omega), by which enstrophy falls (hyper has one form)"},
	{.name = "order", .kind = PM_WORD, .choices = pm_order_names, PM_AT(order),
		.text = "order of the differences, or spectral (default: that of the law's gradients)"},
	{.name = "mesh", .kind = PM_TEXT, .unit = "NAME", PM_AT(mesh), .text = "the mesh (default: the first)"},
	{.name = "replace", .kind = PM_FLAG, PM_AT(replace), .text = "replace the change instead of refusing to add it twice"},
	PM_PLAN_ROW,
	{0},
};
static const struct pm_example examples[] = {
	{"a Taylor-Green vortex that its mesh does not resolve, a step",
		"pinit taylor-green-3d --cells 16 --nu 6.25e-4 | cycle -n 1 'p2m | poisson-fft | mgrad | stretch | diffuse | subgrid | m2p | push lsrk3 | "
		"remesh' | sls --report"},
	{0},
};
const struct pm_tool tool_subgrid = {
	.name = "subgrid",
	.summary = "add the viscosity of scales below the mesh to the rate of change of vorticity",
	.about = "d(omega) += curl div(2 nu_t S) on the mesh, as the term subgrid, in the plane and in space; m2p carries it to the particles. S is "
		"the strain of the flow, nu_t the eddy viscosity of a model, of the filter width (hx hy hz)^(1/3). Energy falls, the total of the "
		"strengths stays. Reports "
		"nu_mean and nu_largest, the energy taken per time as dissipation (density 1), and of the dynamic model its factor, C^2. Explicit: push "
		"refuses a step too long for nu_largest. See docs/methods/subgrid.md.",
	.kind = PM_FILTER,
	.makes = true,
	.reads = "omega and u on the mesh",
	.adds = "domega (mesh), a change of the strength (term subgrid)",
	.config = sizeof(struct config),
	.state = sizeof(struct state),
	.options = options,
	.examples = examples,
	.begin = begin,
	.declare = declare,
	.frame = frame,
	.free = release,
};
