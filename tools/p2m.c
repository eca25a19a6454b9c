/* p2m: strengths of particles to a density on a mesh, or their current (lib/transfer). SPDX-License-Identifier: GPL-3.0-or-later */
#include "stage/mesh-options.h"
#include "current/current-frame.h"

struct config {
	struct pm_spread_choice spread;
	const char *deposit, *mesh;
	struct pm_cells cells;
	int64_t rim;
	bool current;
};
struct state {
	struct pm_fft_plans plans; /* of interlaced meshes */
	struct pm_spread_job spread; /* from declare to frame; or the other one */
	struct pm_current_job current;
};

static void release(struct pm_stage *s) { pm_fft_plans_clear(&((struct state *)s->state)->plans); }

static int begin(struct pm_stage *s)
{
	struct config *o = s->config;
	s->advances = o->current;
	o->spread.cells = o->cells.n;
	o->spread.rim = (int)o->rim;
	o->spread.mesh = o->mesh;
	return pm_given(s, "deposit") && !o->current ? pm_fail(PM_USAGE, "--deposit belongs to --current") : 0;
}

static int declare(struct pm_stage *s, struct pm_frame *f)
{
	const struct config *o = s->config;
	struct state *t = s->state;
	int status = o->current ? pm_current_choose(&o->spread, o->deposit, f, &t->current) : pm_spread_choose(&o->spread, f, &t->spread);
	status = status ? status : pm_mesh_take_or_make(f, o->current ? &t->current.mesh : &t->spread.mesh, &o->cells, o->mesh);
	status = status ? status : o->current ? pm_current_declare(&t->current, f) : pm_spread_declare(&t->spread, f);
	return status ? status : !o->current && t->spread.grow ? PM_HOLD : 0;
}

/* Those left out without a force are counted over the steps; those outside are as many as there are now, and may come back. */
static void report(const struct pm_stage *s, struct pm_frame *f, bool drop, uint64_t outside)
{
	if (drop && outside)
		pm_report_count(s, f, "dropped", outside);
	if (!drop && (outside || json_object_get(json_object_get(f->report, s->word), "outside")))
		pm_report(s, f, "outside", (double)outside);
}

static int frame(struct pm_stage *s, struct pm_frame *f)
{
	struct state *t = s->state;
	uint64_t outside = 0;
	if (((const struct config *)s->config)->current)
		return pm_current_frame(&t->current, f);
	int status = pm_spread_all(&t->spread, f, &t->plans, &outside);
	if (!status)
		report(s, f, t->spread.outside == PM_OUTSIDE_DROP, outside);
	return status;
}

static bool divided(const struct pm_stage *s, const struct pm_frame *f) { return s && f; }

static const char *const outside[] = {"monopole", "drop", "grow", "error", NULL};
static const struct pm_option options[] = {
	{.name = "kernel", .letter = 'k', .kind = PM_WORD, .choices = pm_kernel_names, PM_AT(spread.kernel),
		.text = "the interpolation kernel (default: the law's)"},
	PM_MESH_ROWS,
	{.name = "set", .kind = PM_TEXT, .unit = "NAME", PM_AT(spread.set), .text = "only this set (default: every set that has the strength)"},
	{.name = "strength", .kind = PM_TEXT, .unit = "FIELD", PM_AT(spread.strength),
		.text = "the particle field (default: the law's); a value is multiplied by volume"},
	{.name = "field", .kind = PM_TEXT, .unit = "NAME", PM_AT(spread.field), .text = "the mesh field made (default: the law's density)"},
	{.name = "outside", .kind = PM_WORD, .fallback = "monopole", .choices = outside, PM_AT(spread.outside),
		.text = "particles beyond an open mesh: left off, counted, and given the monopole's force by m2p; left out; it grows; or failure"},
	{.name = "rim", .kind = PM_INTEGER, .unit = "cells", .fallback = "0", .high = PM_RIM_MOST, PM_AT(rim),
		.text = "particles within N cells of the kernel's reach of an open face are outside too: 1 for mgrad of order 4, 2 of order 6"},
	{.name = "add", .kind = PM_FLAG, PM_AT(spread.add), .text = "add to the existing density instead of replacing it"},
	{.name = "interlace", .kind = PM_FLAG, PM_AT(spread.interlace),
		.text = "use two meshes half a cell apart, combined so that half of the aliases vanish (periodic boxes; m2p does the same)"},
	{.name = "current", .kind = PM_FLAG, PM_AT(current),
		.text = "make J, the mean current of the charges on their way through the step, before push drift and maxwell (law electromagnetic)"},
	{.name = "deposit", .kind = PM_WORD, .fallback = "esirkepov", .choices = pm_deposit_names, PM_AT(deposit),
		.text = "J by Esirkepov for every kernel, or for cic with ways cut at cells (both keep charge to rounding), or q v W at the middle of the way"},
	{0},
};
static const struct pm_example examples[] = {
	{"the density of a star cluster on its default mesh", "pinit plummer -n 1000 | p2m | sls"},
	{"on a finer mesh with a smoother kernel", "pinit uniform -n 1000 | p2m -n 24x32x20 --kernel tsc | sls"},
	{0},
};
const struct pm_tool tool_p2m = {
	.name = "p2m",
	.summary = "deposit the strengths of particles on a mesh as a density",
	.about = "density(i) = sum over particles of strength * W((x - x_i)/h) / (volume of a cell), W a product of one-dimensional kernels (Hockney and "
		"Eastwood 1988, chapter 5). Beyond a wall the mesh is continued as its odd image, beyond a neumann face as its even image; at open faces the "
		"support of every kernel must stay inside the mesh; the particles beyond are left off and counted (outside), and m2p gives them the force of "
		"the monopole of those inside. End nodes of faces that are not periodic have half weight in mesh sums. See docs/methods/transfer.md.",
	.kind = PM_FILTER,
	.makes = true,
	.reads = "x and the law's strength (mass, charge, circulation) of every set that has it",
	.changes = "the geometry of the mesh (-n, --outside grow)",
	.adds = "the law's density (rho, omega) on the mesh, derived; J, a change of E",
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
