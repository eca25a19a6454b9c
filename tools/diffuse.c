/* diffuse: viscosity on the mesh; the Laplacian is lib/mesh/gradient.c, the rest lib/mesh/diffusion-frame.c. SPDX-License-Identifier: GPL-3.0-or-later */
#include <string.h>

#include "fft/axis-transform.h"
#include "law/law.h"
#include "mesh/diffusion-frame.h"
#include "stage/plan-option.h"
#include "stage/viscosity-options.h"

struct config {
	const char *field, *order, *mesh, *plan, *nu;
	bool replace;
};
struct state {
	struct pm_fft_plans planner;
	struct pm_diffusion diffusion;
	struct pm_viscosity nu;
};

static int begin(struct pm_stage *s) { return pm_viscosity_typed(((const struct config *)s->config)->nu); }

static int declare(struct pm_stage *s, struct pm_frame *f)
{
	const struct config *o = s->config;
	struct state *t = s->state;
	struct pm_diffusion_choice choice = {.field = o->field, .mesh = o->mesh, .order = o->order, .replace = o->replace};
	const struct pm_mesh *mesh = pm_frame_mesh(f, o->mesh);
	int status = !pm_law_of(f) ? -PM_DATA : mesh || !o->nu ? pm_viscosity_of(s, f, mesh ? mesh->name : "", o->nu, &t->nu) : 0;
	memcpy(choice.nu, t->nu.axis, sizeof choice.nu);
	return status ? status : pm_diffusion_declare(&choice, f, &t->diffusion);
}

static int frame(struct pm_stage *s, struct pm_frame *f)
{
	struct state *t = s->state;
	const size_t n = t->diffusion.density->count;
	struct pm_diffusion_nu varies = {.at = NULL};
	double decay = 0, *nu = t->nu.varies ? pm_alloc(n + 1, sizeof *nu) : NULL;
	int status = t->nu.varies ? pm_viscosity_values(nu ? 0 : pm_failed(), &t->nu, f, n, nu, &varies.least, &varies.most) : 0;
	varies.at = nu;
	status = status ? status : pm_diffusion_add(&t->diffusion, &varies, &t->planner, &decay);
	pm_report(s, f, "fastest_dt", decay * f->dt);
	pm_free(nu);
	return status;
}

static bool divided(const struct pm_stage *s, const struct pm_frame *f)
{
	(void)s;
	return f;
}

static void release(struct pm_stage *s) { pm_fft_plans_clear(&((struct state *)s->state)->planner); }

static const struct pm_option options[] = {
	{.name = "field", .kind = PM_TEXT, .unit = "NAME", PM_AT(field),
		.text = "a strength or value that p2m --strength NAME --field NAME has deposited (default: the law's density)"},
	{.name = "order", .kind = PM_WORD, .choices = pm_order_names, PM_AT(order),
		.text = "order of the differences, or spectral (default: that of the law's gradients)"},
	PM_VISCOSITY_FIELD_ROW,
	{.name = "mesh", .kind = PM_TEXT, .unit = "NAME", PM_AT(mesh), .text = "the mesh (default: the first)"},
	{.name = "replace", .kind = PM_FLAG, PM_AT(replace), .text = "replace the change instead of refusing to add it twice"},
	PM_PLAN_ROW,
	{0},
};
static const struct pm_example examples[] = {
	{"the heat equation: a value of particles at rest on the nodes, differences of second order and explicit Euler steps",
		"awk 'BEGIN { print \"x heat volume\"; for (i = 0; i < 32; i++) print i/32, sin(i/32*6.28318530718), 1/32 }' | "
		"stab - --box 0,1 -n 32 --faces periodic --particle-faces periodic --dt 0.004 | cycle -n 10 "
		"\"field 'vel = 0' | p2m --strength heat --field heat --kernel m4prime | diffuse --field heat --nu 0.1 --order 2 | m2p | push euler\" | sls"},
	{"a vortex spreads at rest: its circulation is conserved, its peak falls",
		"awk 'BEGIN { print \"x y circulation volume\"; for (i = -9; i < 10; i++) for (j = -9; j < 10; j++) print i/8, j/8, exp(-(i*i + j*j)/16)/64, "
		"1/64 }' | "
		"stab - --law vortex --constant nu=0.02 --box -2,2 --dt 0.05 | p2m | diffuse | m2p --field domega | sls"},
	{0},
};
const struct pm_tool tool_diffuse = {
	.name = "diffuse",
	.summary = "add viscosity: the Laplacian of the density to its rate of change",
	.about = "d(density) += nu lap density on the mesh, as the term diffusion; m2p carries it to the particles, push advances their strengths. "
		"Differences of "
		 "order 2, 4, 6 or spectral, faces as in mgrad. Explicit: a step is stable if nu dt times the largest eigenvalue of -lap (4, 16/3, "
		 "272/45, pi^2 "
		 "over h^2 per axis) is below the scheme's limit (2 for euler, 2.51 for lsrk3, 2.79 for rk4); push refuses longer ones. "
		 "Reports that product as fastest_dt. If nu is 0 the frame is passed on unchanged. See docs/methods/diffuse.md.",
	.kind = PM_FILTER,
	.makes = true,
	.reads = "the law's density (omega) on the mesh, or --field",
	.adds = "domega (mesh), a change of the strength or value (term diffusion)",
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
