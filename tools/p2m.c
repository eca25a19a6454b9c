/* p2m: strengths of particles to a density on a mesh (lib/transfer/spread-frame.c). SPDX-License-Identifier: GPL-3.0-or-later */
#include <string.h>

#include "stage/mesh-options.h"
#include "transfer/spread-frame.h"

struct config {
	const char *kernel, *mesh, *set, *strength, *field, *outside;
	struct pm_cells cells;
	int64_t rim;
	bool add, interlace;
};
struct state {
	struct pm_fft_plans plans; /* of interlaced meshes */
};

static void release(struct pm_stage *s) { pm_fft_plans_clear(&((struct state *)s->state)->plans); }

static int choose(const struct config *o, const struct pm_frame *f, struct pm_spread_job *j)
{
	const struct pm_spread_choice choice = {.kernel = o->kernel, .mesh = o->mesh, .set = o->set, .strength = o->strength, .field = o->field,
		.cells = o->cells.n, .add = o->add, .interlace = o->interlace, .outside = o->outside, .rim = (int)o->rim};
	return pm_spread_choose(&choice, f, j);
}

static int declare(struct pm_stage *s, struct pm_frame *f)
{
	const struct config *o = s->config;
	struct pm_spread_job j;
	int status = choose(o, f, &j);
	if (!status)
		status = pm_mesh_take_or_make(f, &j.mesh, &o->cells, o->mesh);
	if (!status)
		status = pm_spread_declare(&j, f);
	return status ? status : j.grow ? PM_HOLD : 0;
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
	struct pm_spread_job j;
	uint64_t outside = 0;
	int status = choose(s->config, f, &j);
	if (!status && j.grow)
		status = pm_spread_grow(&j, f);
	for (size_t i = 0; !status && i < j.sets.n; i++) {
		uint64_t left_out = 0;
		status = pm_spread_set(&j, f, j.sets.name[i], &((struct state *)s->state)->plans, &left_out);
		outside += left_out;
	}
	if (status)
		return status;
	pm_spread_background(&j, f);
	report(s, f, j.outside == PM_OUTSIDE_DROP, outside);
	return 0;
}

static const char *const outside[] = {"monopole", "drop", "grow", "error", NULL};
static const struct pm_option options[] = {
	{.name = "kernel", .letter = 'k', .kind = PM_WORD, .choices = pm_kernel_names, PM_AT(kernel),
		.text = "the interpolation kernel (default: the law's)"},
	PM_MESH_ROWS,
	{.name = "set", .kind = PM_TEXT, .unit = "NAME", PM_AT(set), .text = "only this set (default: every set that has the strength)"},
	{.name = "strength", .kind = PM_TEXT, .unit = "FIELD", PM_AT(strength),
		.text = "the particle field (default: the law's); a value is multiplied by volume"},
	{.name = "field", .kind = PM_TEXT, .unit = "NAME", PM_AT(field), .text = "the mesh field made (default: the law's density)"},
	{.name = "outside", .kind = PM_WORD, .fallback = "monopole", .choices = outside, PM_AT(outside),
		.text = "particles beyond an open mesh: left off and counted, and m2p gives them the force of the monopole of those inside; left out without "
			"force and counted; the mesh grows; or failure"},
	{.name = "rim", .kind = PM_INTEGER, .unit = "cells", .fallback = "0", .high = PM_RIM_MOST, PM_AT(rim),
		.text = "particles within N cells of the kernel's reach of an open face are outside too: 1 for mgrad of order 4, 2 of order 6"},
	{.name = "add", .kind = PM_FLAG, PM_AT(add), .text = "add to the existing density instead of replacing it"},
	{.name = "interlace", .kind = PM_FLAG, PM_AT(interlace),
		.text = "use two meshes half a cell apart, combined so that half of the aliases vanish (periodic boxes; m2p does the same)"},
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
	.adds = "the law's density (rho, omega) on the mesh, derived",
	.config = sizeof(struct config),
	.state = sizeof(struct state),
	.options = options,
	.examples = examples,
	.declare = declare,
	.frame = frame,
	.free = release,
};
