/* mgrad: derivatives of mesh fields (lib/mesh/gradient-frame.c). SPDX-License-Identifier: GPL-3.0-or-later */
#include "fft/axis-transform.h"
#include "mesh/gradient-later.h"
#include "world/world.h"
#include "stage/plan-option.h"
#include "stage/stage.h"

struct config {
	struct pm_gradient_choice choice;
	const char *plan;
};
struct state {
	struct pm_fft_plans planner;
	struct pm_gradient gradient;
};

static const struct pm_option options[] = {
	{.name = "operator", .kind = PM_WORD, .choices = pm_operator_names, PM_AT(choice.kind),
		.text = "operator applied to --source (default: the one that gives the law's field, with the law's sign)"},
	{.name = "order", .kind = PM_WORD, .choices = pm_order_names, PM_AT(choice.order),
		.text = "order of the differences, or spectral (default: the law's)"},
	{.name = "source", .kind = PM_TEXT, .unit = "FIELD", PM_AT(choice.source),
		.text = "the mesh field to take derivatives of (default: the law's potential)"},
	{.name = "target", .kind = PM_TEXT, .unit = "FIELD", PM_AT(choice.target), .text = "the mesh field to make (default: the law's field)"},
	{.name = "mesh", .kind = PM_TEXT, .unit = "NAME", PM_AT(choice.mesh), .text = "the mesh (default: the first)"},
	PM_PLAN_ROW,
	{0},
};

static const struct pm_example examples[] = {
	{"the acceleration on the mesh of a cluster in free space", "pinit plummer -n 2000 | p2m -n 32 | poisson-fft | mgrad | sls"},
	{"back from the potential to the density (times 4 pi G)",
		"pinit uniform -n 2000 | p2m -n 32 | poisson-fft --symbol fd2 | mgrad --operator lap --order 2 --target lap | sls"},
	{0},
};

static int begin(struct pm_stage *s)
{
	const struct config *o = s->config;
	if (o->choice.kind && !o->choice.target)
		return pm_fail(PM_USAGE, "--operator %s needs a --target (the name of the field to make)", o->choice.kind);
	return 0;
}

static int declare(struct pm_stage *s, struct pm_frame *f)
{
	return pm_gradient_declare(&((const struct config *)s->config)->choice, f, &((struct state *)s->state)->gradient);
}

/* Below it the force is less than 1e-10 of that of all: a body with 1e-3 of the mass, in the last cells of 32, exerts on itself about a tenth of the force
 * that all others do (docs/methods/mgrad.md). */
static const double rim_told = 1e-12;

static int frame(struct pm_stage *s, struct pm_frame *f)
{
	struct state *t = s->state;
	(void)f;
	struct pm_clock began = pm_clock();
	int status = pm_world_agree(pm_gradient_plan(&t->gradient, &t->planner));
	pm_setup_since(s, began);
	double rim = 0;
	status = status ? status : pm_gradient_rim(&t->gradient, &rim);
	if (rim > rim_told)
		pm_tell_once(s, "%.2g of the density is within %d nodes of an open face, where differences of order %d are one-sided and exert a force on "
			"what makes the field (p2m --rim %d leaves these nodes free; --order 2 has no such force)", rim, t->gradient.operator.order / 2,
			t->gradient.operator.order, t->gradient.operator.order / 2 - 1);
	bool left = false;
	if (!status && s->fused)
		status = pm_gradient_leave(&t->gradient, &left);
	return status || left ? status : pm_gradient_apply(&t->gradient);
}

static bool divided(const struct pm_stage *s, const struct pm_frame *f)
{
	(void)s;
	return f;
}

static void release(struct pm_stage *s)
{
	pm_fft_plans_clear(&((struct state *)s->state)->planner);
}

const struct pm_tool tool_mgrad = {
	.name = "mgrad",
	.summary = "take gradients and other derivatives of mesh fields",
	.about = "Without options, computes the field of the law from its potential: g = -grad phi for gravity, u = curl psi for vortices. "
		"With "
		"--operator it applies grad, curl, div or lap to any field. Differences are centred; a wall is an odd image and a neumann face an even one; "
		"near "
		"an open face they are one-sided, of the same order. Spectral derivatives need periodic, wall or neumann faces. Of a vector the tangential "
		"components are odd at a wall and the normal one even; of a flow (u of vortices) the other way round.",
	.kind = PM_FILTER,
	.makes = true,
	.reads = "phi (mesh)",
	.changes = "",
	.adds = "g (mesh)",
	.config = sizeof(struct config),
	.state = sizeof(struct state),
	.options = options,
	.examples = examples,
	.begin = begin,
	.declare = declare,
	.frame = frame,
	.divided = divided,
	.free = release,
};
