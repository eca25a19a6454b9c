/* diffuse: viscosity on the mesh; the Laplacian is lib/mesh/gradient.c. SPDX-License-Identifier: GPL-3.0-or-later */
#include <stdio.h>
#include <string.h>

#include "law/law.h"
#include "fft/axis-transform.h"
#include "mesh/gradient.h"
#include "stage/stage.h"
#include "stream/fastest.h"

struct config {
	const char *order, *mesh, *plan;
	double nu;
	bool replace;
};
struct state {
	struct pm_fft_plans planner;
	struct pm_operator operator;
	const struct pm_field *density;
	struct pm_field *change;
	double nu;
};

static int begin(struct pm_stage *s)
{
	int effort = pm_fft_effort_find(((const struct config *)s->config)->plan);
	((struct state *)s->state)->planner.effort = (enum pm_fft_effort)effort;
	return effort < 0 ? -PM_USAGE : 0;
}

/* The mesh change field d<density> of the law's strength, with what push must know of it. */
static int contribute(const struct config *o, struct pm_frame *f, const struct pm_law *law, struct state *t)
{
	char name[PM_NAME];
	snprintf(name, sizeof name, "d%.62s", law->density);
	t->change = pm_contributes(f, t->density->on, name, law->strength, t->density->components, "diffusion", o->replace);
	if (!t->change)
		return -PM_DATA;
	pm_field_inherit(t->change, t->density);
	pm_fastest_add(t->change, t->nu * pm_operator_fastest(&t->operator));
	return 0;
}

static int declare(struct pm_stage *s, struct pm_frame *f)
{
	const struct config *o = s->config;
	struct state *t = s->state;
	const struct pm_law *law = pm_law_of(f);
	const struct pm_mesh *mesh = pm_frame_mesh(f, o->mesh);
	if (!law)
		return -PM_DATA;
	t->nu = isnan(o->nu) ? pm_frame_constant(f, "nu", 0) : o->nu;
	if (!(t->nu >= 0))
		return pm_fail(PM_DATA, "the viscosity nu is %g: negative diffusion has no solution (--nu, or the scene's)", t->nu);
	if (t->nu == 0)
		return pm_idle(s, "the viscosity nu is 0");
	if (!law->density)
		return pm_fail(PM_DATA, "the law '%s' has no density on a mesh to diffuse", law->name);
	if (!mesh)
		return pm_fail(PM_DATA, "no mesh%s%s (p2m -n CELLS makes one)", o->mesh ? " " : "", o->mesh ? o->mesh : "");
	if (!pm_frame_field(f, mesh->name, law->density))
		return pm_fail(PM_DATA, "no field '%s' on mesh '%s' (run p2m first)", law->density, mesh->name);
	if (!(t->density = pm_reads(f, mesh->name, law->density)))
		return -PM_DATA;
	struct pm_grid g = pm_grid_of(f, mesh);
	int order = pm_order_find(o->order ? o->order : law->order ? law->order : "2");
	int status = order < 0 ? -PM_USAGE : pm_operator_init(&t->operator, &g, PM_OP_LAP, order, t->density->components, false);
	return status ? status : contribute(o, f, law, t);
}

/* change += nu lap density; scratch where there is something already. */
static int add(struct state *t, double *scratch)
{
	const double *in[PM_COMPONENTS];
	double *out[PM_COMPONENTS];
	size_t n = t->change->count;
	for (int c = 0; c < t->operator.in; c++) {
		in[c] = pm_in(t->density, c);
		out[c] = scratch ? scratch + (size_t)c * n : pm_out(t->change, c);
	}
	int status = pm_operator_apply(&t->operator, t->nu, in, out, NULL);
	for (int c = 0; c < t->operator.out && scratch; c++)
		for (size_t i = 0; i < n; i++)
			pm_out(t->change, c)[i] += out[c][i];
	return status;
}

static int frame(struct pm_stage *s, struct pm_frame *f)
{
	struct state *t = s->state;
	double *scratch = t->change->nterms > 1 ? pm_alloc(t->change->count * (size_t)t->operator.out, sizeof *scratch) : NULL;
	if (t->change->nterms > 1 && !scratch)
		return -PM_DATA;
	if (t->planner.n > PM_FFT_PLANS - 3) /* frames of many sizes: start the collection anew */
		pm_fft_plans_clear(&t->planner);
	int status = pm_operator_plan(&t->operator, &t->planner);
	if (!status)
		status = add(t, scratch);
	pm_free(scratch);
	pm_report(s, f, "fastest_dt", t->nu * pm_operator_fastest(&t->operator) * f->dt);
	return status;
}

static void release(struct pm_stage *s) { pm_fft_plans_clear(&((struct state *)s->state)->planner); }

static const struct pm_option options[] = {
	{.name = "order", .kind = PM_WORD, .choices = pm_order_names, PM_AT(order),
		.text = "order of the differences, or spectral (default: that of the law's gradients)"},
	{.name = "nu", .kind = PM_REAL, .unit = "length^2/time", .high = 1e300, PM_AT(nu), .text = "the viscosity (default: the frame's constant nu)"},
	{.name = "mesh", .kind = PM_TEXT, .unit = "NAME", PM_AT(mesh), .text = "the mesh (default: the first)"},
	{.name = "replace", .kind = PM_FLAG, PM_AT(replace), .text = "compute the change anew instead of refusing to add twice"},
	{.name = "plan", .kind = PM_WORD, .choices = pm_fft_effort_names, PM_AT(plan),
		.text = "how transforms are chosen, with --order spectral: by estimate, or measured once and kept in the user's cache (default: PM_PLAN or "
			"measure)"},
	{0},
};
static const struct pm_example examples[] = {
	{"a vortex spreads at rest: its circulation stays, its peak falls",
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
		 "order 2, 4, 6 or spectral, faces as in mgrad. Explicit: a step is stable while nu dt times the largest eigenvalue of -lap (4, 16/3, "
		 "272/45, pi^2 "
		 "over h^2 per axis) is within the scheme's limit (2 for euler, 2.51 for lsrk3, 2.79 for rk4); push refuses longer ones. "
		 "Reports that product as fastest_dt. Where nu is 0 the frame passes. See docs/methods/diffuse.md.",
	.kind = PM_FILTER,
	.makes = true,
	.reads = "the law's density (omega) on the mesh",
	.adds = "domega (mesh), a change of the strength (term diffusion)",
	.config = sizeof(struct config),
	.state = sizeof(struct state),
	.options = options,
	.examples = examples,
	.begin = begin,
	.declare = declare,
	.frame = frame,
	.free = release,
};
