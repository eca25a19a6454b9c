/* stretch: vorticity stretched and turned by its flow, on the mesh; the derivatives are lib/mesh/gradient.c, the rest lib/mesh/stretching-frame.c.
 * SPDX-License-Identifier: GPL-3.0-or-later */
#include <string.h>

#include "fft/axis-transform.h"
#include "mesh/stretching-frame.h"
#include "stage/plan-option.h"
#include "stage/stage.h"

struct config {
	const char *form, *order, *mesh, *plan;
	bool replace;
};
struct state {
	struct pm_fft_plans planner;
	struct pm_stretching stretching;
};

static int declare(struct pm_stage *s, struct pm_frame *f)
{
	const struct config *o = s->config;
	struct pm_stretching_choice choice = {.mesh = o->mesh, .order = o->order, .replace = o->replace};
	if (f->dim < 3)
		return pm_idle(s, "in the plane vorticity is normal to the flow, which does not stretch it");
	while (strcmp(pm_stretch_names[choice.form], o->form))
		choice.form++;
	return pm_stretching_declare(&choice, f, &((struct state *)s->state)->stretching);
}

static int frame(struct pm_stage *s, struct pm_frame *f)
{
	struct state *t = s->state;
	(void)f;
	return pm_stretching_add(&t->stretching, &t->planner);
}

static bool divided(const struct pm_stage *s, const struct pm_frame *f)
{
	(void)s;
	return f;
}

static void release(struct pm_stage *s) { pm_fft_plans_clear(&((struct state *)s->state)->planner); }

static const struct pm_option options[] = {
	{.name = "form", .kind = PM_WORD, .fallback = "conservative", .choices = pm_stretch_names, PM_AT(form),
		.text = "div(omega u), whose total is 0; (omega . grad) u; its transpose, sum_d omega_d grad u_d; or half of each of these two"},
	{.name = "order", .kind = PM_WORD, .choices = pm_order_names, PM_AT(order),
		.text = "order of the differences, or spectral (default: that of the law's gradients)"},
	{.name = "mesh", .kind = PM_TEXT, .unit = "NAME", PM_AT(mesh), .text = "the mesh (default: the first)"},
	{.name = "replace", .kind = PM_FLAG, PM_AT(replace), .text = "replace the change instead of refusing to add it twice"},
	PM_PLAN_ROW,
	{0},
};
static const struct pm_example examples[] = {
	{"vortices in space, a step",
		"pinit taylor-green-3d --cells 16 | cycle -n 1 'p2m | poisson-fft | mgrad | stretch | diffuse | m2p | push lsrk3 | remesh' | sls"},
	{0},
};
const struct pm_tool tool_stretch = {
	.name = "stretch",
	.summary = "add the stretching of vorticity by its flow to its rate of change",
	.about = "d(omega) += (omega . grad) u on the mesh, as the term stretching; m2p carries it to the particles, push advances their strengths alpha. The "
		"forms are equal where omega has no divergence and is the curl of u; on a mesh they differ by the error of the differences, which are of order "
		"2, 4, 6 or "
		"spectral, with faces as in mgrad (a wall lets nothing through and slips). In the plane there is no stretching: the frame is passed on "
		"unchanged. See docs/methods/stretch.md.",
	.kind = PM_FILTER,
	.makes = true,
	.reads = "omega and u on the mesh",
	.adds = "domega (mesh), a change of alpha (term stretching)",
	.config = sizeof(struct config),
	.state = sizeof(struct state),
	.options = options,
	.examples = examples,
	.declare = declare,
	.frame = frame,
	.divided = divided,
	.free = release,
};
