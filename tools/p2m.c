/* p2m: strengths of particles to a density on a mesh; the spreading is lib/transfer/transfer.c.
 * SPDX-License-Identifier: GPL-3.0-or-later */
#include <string.h>

#include "law/law.h"
#include "transfer/interlace.h"
#include "mesh/regrid.h"
#include "transfer/transfer-frame.h"
#include "stage/stage.h"

struct config {
	const char *kernel, *mesh, *set, *strength, *field, *outside;
	struct pm_cells cells;
	bool add, interlace;
};
struct state {
	struct pm_fft_plans planner; /* of interlaced meshes */
};

/* What the options and the frame's law ask for. */
struct job {
	const struct pm_kernel *kernel;
	const char *strength, *density;
	struct pm_sets sets;
	struct pm_mesh *mesh;
};

static int begin(struct pm_stage *s)
{
	int effort = ((struct config *)s->config)->interlace ? pm_fft_effort_find(NULL) : 0;
	((struct state *)s->state)->planner.effort = (enum pm_fft_effort)effort;
	return effort < 0 ? -PM_USAGE : 0;
}

static void release(struct pm_stage *s) { pm_fft_plans_clear(&((struct state *)s->state)->planner); }

static int job_of(const struct config *o, const struct pm_frame *f, struct job *j)
{
	const struct pm_law *law = pm_law_of(f);
	if (!law)
		return -PM_DATA;
	j->strength = o->strength ? o->strength : law->strength;
	j->density = o->field ? o->field : law->density ? law->density : "rho";
	j->kernel = pm_kernel_choose(o->kernel, NULL, law, "cic");
	if (!j->kernel)
		return -PM_DATA;
	if (!j->strength)
		return pm_fail(PM_DATA, "the law '%s' puts nothing on a mesh (choose a field with --strength FIELD)", f->law);
	j->mesh = pm_frame_mesh(f, o->mesh);
	if (!j->mesh && !o->cells.n)
		return pm_fail(PM_DATA, "no mesh%s%s (p2m -n CELLS makes one)", o->mesh ? " " : "", o->mesh ? o->mesh : "");
	return pm_sets_choose(f, o->set, (const char *const[]){j->strength, NULL}, "add it with stab --strength, or choose another with --strength FIELD",
		&j->sets);
}

static int regrid(const struct config *o, struct pm_frame *f, struct job *j)
{
	size_t cells[3] = {1, 1, 1};
	int status = o->cells.n ? pm_cells_for(&o->cells, f->dim, cells) : 0;
	if (status || !o->cells.n)
		return status;
	if (!j->mesh)
		return (j->mesh = pm_frame_mesh_new(f, o->mesh ? o->mesh : "mesh", cells)) ? 0 : -PM_DATA;
	return memcmp(cells, j->mesh->cells, sizeof cells) ? pm_mesh_regrid_box(f, j->mesh, cells) : 0;
}

static struct pm_transfer transfer_of(const struct pm_frame *f, const struct job *j)
{
	int components = pm_frame_field(f, j->sets.name[0], j->strength)->components;
	struct pm_transfer t = {.grid = pm_grid_of(f, j->mesh), .kernel = j->kernel, .components = components};
	for (int c = 0; c < components && c < f->dim && components > 1; c++)
		t.flip[c][c] = 1; /* of a vector at a wall the tangential components change sign in the image (vortices, currents), the normal one does not */
	return t;
}

static int makes_density(const struct config *o, struct pm_frame *f, const struct job *j, bool add)
{
	struct pm_transfer t = transfer_of(f, j);
	int status = o->interlace ? pm_interlace_check(&t) : 0;
	return status ? status : pm_makes_density(f, j->mesh, &(struct pm_density){j->density, j->kernel, o->interlace, &j->sets, j->strength}, add);
}

static int declare(struct pm_stage *s, struct pm_frame *f)
{
	const struct config *o = s->config;
	struct job j = {0};
	int status = job_of(o, f, &j);
	if (!status)
		status = regrid(o, f, &j);
	for (size_t i = 0; i < j.sets.n && !status; i++)
		if (!(status = pm_reads_positions(f, j.sets.name[i])))
			status = pm_reads_strength(f, j.sets.name[i], j.strength);
	if (!status)
		status = makes_density(o, f, &j, o->add);
	return status ? status : strcmp(o->outside, "grow") ? 0 : PM_HOLD;
}

static int grow(const struct config *o, struct pm_frame *f, struct job *j)
{
	struct pm_transfer t = transfer_of(f, j);
	int status = pm_mesh_grow(f, j->mesh, &t, &j->sets);
	if (status == 1 && o->add)
		return pm_fail(PM_DATA, "mesh '%s' would have to grow under --add (let the first p2m grow it)", j->mesh->name);
	if (status == 1)
		status = makes_density(o, f, j, false);
	return status ? status : pm_field_ready(pm_frame_field(f, j->mesh->name, j->density));
}

static int spread_set(struct pm_stage *s, struct pm_frame *f, const struct job *j, const char *set)
{
	const struct config *o = s->config;
	struct pm_transfer t = transfer_of(f, j);
	const double *x[3], *q[PM_COMPONENTS];
	double *mesh[PM_COMPONENTS], *made = NULL;
	struct pm_strays strays = {.count = 0};
	pm_positions(f, set, x);
	t.kept = &pm_frame_field(f, set, "x")->note;
	for (int c = 0; c < t.components; c++)
		mesh[c] = pm_out(pm_frame_field(f, j->mesh->name, j->density), c);
	int status = pm_strengths(f, set, j->strength, q, &made);
	if (!status)
		status = o->interlace ? pm_interlace_spread(&t, &((struct state *)s->state)->planner, pm_frame_set(f, set)->n, x, q, mesh, &strays)
				      : pm_spread(&t, pm_frame_set(f, set)->n, x, q, mesh, &strays);
	pm_free(made);
	if (!status && strays.count && strcmp(o->outside, "drop"))
		return pm_strays_refuse(&strays, set, j->mesh, &t, "a larger box, or --outside grow or drop");
	if (!status && strays.count)
		pm_report_count(s, f, "dropped", strays.count);
	return status;
}

/* The constant density of the law, once in every density that is made anew. */
static void add_background(struct pm_frame *f, const struct job *j)
{
	const struct pm_law *law = pm_law_of(f);
	struct pm_field *density = pm_frame_field(f, j->mesh->name, j->density);
	const double background = law->background ? pm_frame_constant(f, law->background, 0) : 0;
	for (size_t i = 0; i < density->count && background != 0; i++)
		pm_out(density, 0)[i] += background;
}

static int frame(struct pm_stage *s, struct pm_frame *f)
{
	const struct config *o = s->config;
	struct job j = {0};
	int status = job_of(o, f, &j);
	if (!status && !strcmp(o->outside, "grow"))
		status = grow(o, f, &j);
	for (size_t i = 0; i < j.sets.n && !status; i++)
		status = spread_set(s, f, &j, j.sets.name[i]);
	if (!status && !o->add && !o->strength && !o->field)
		add_background(f, &j);
	return status;
}

static const char *const outside[] = {"error", "drop", "grow", NULL};
static const struct pm_option options[] = {
	{.name = "kernel", .letter = 'k', .kind = PM_WORD, .choices = pm_kernel_names, PM_AT(kernel),
		.text = "how a strength is shared among mesh points (default: the law's)"},
	{.name = "cells", .letter = 'n', .kind = PM_CELLS, .unit = "cells", .low = 1, .high = 1 << 24, PM_AT(cells),
		.text = "give the mesh this many cells over the box, 64 or 64x32x32"},
	{.name = "mesh", .kind = PM_TEXT, .unit = "NAME", PM_AT(mesh), .text = "the mesh (default: the first)"},
	{.name = "set", .kind = PM_TEXT, .unit = "NAME", PM_AT(set), .text = "only this set (default: every set that has the strength)"},
	{.name = "strength", .kind = PM_TEXT, .unit = "FIELD", PM_AT(strength),
		.text = "the particle field (default: the law's); a value is multiplied by volume"},
	{.name = "field", .kind = PM_TEXT, .unit = "NAME", PM_AT(field), .text = "the mesh field made (default: the law's density)"},
	{.name = "outside", .kind = PM_WORD, .fallback = "error", .choices = outside, PM_AT(outside),
		.text = "particles that an open mesh does not hold: refuse, leave out and count, or enlarge the mesh"},
	{.name = "add", .kind = PM_FLAG, PM_AT(add), .text = "add to the density that is there instead of replacing it"},
	{.name = "interlace", .kind = PM_FLAG, PM_AT(interlace),
		.text = "on two meshes half a cell apart, combined so that half of the aliases vanish (periodic boxes; m2p does the same)"},
	{0},
};
static const struct pm_example examples[] = {
	{"the density of a star cluster on its default mesh", "pinit plummer -n 1000 | p2m --outside drop | sls"},
	{"on a finer mesh with a smoother kernel", "pinit uniform -n 1000 | p2m -n 24x32x20 --kernel tsc | sls"},
	{0},
};
const struct pm_tool tool_p2m = {
	.name = "p2m",
	.summary = "put the strengths of particles on a mesh as a density",
	.about = "density(i) = sum over particles of strength * W((x - x_i)/h) / (volume of a cell), W a product of one-dimensional kernels (Hockney and Eastwood "
		 "1988, chapter 5). The mesh goes on beyond a wall as its odd image, beyond a neumann face as its even image; at open faces the support of "
		 "every kernel must stay inside the mesh. End nodes of faces that are not periodic have half weight in mesh sums. See docs/methods/transfer.md.",
	.kind = PM_FILTER,
	.makes = true,
	.reads = "x and the law's strength (mass, charge, circulation) of every set that has it",
	.changes = "the geometry of the mesh (-n, --outside grow)",
	.adds = "the law's density (rho, omega) on the mesh, derived",
	.config = sizeof(struct config),
	.state = sizeof(struct state),
	.options = options,
	.examples = examples,
	.begin = begin,
	.declare = declare,
	.frame = frame,
	.free = release,
};
