/* m2p: mesh fields at the positions of particles, added to what changes them; the gathering is lib/transfer/transfer.c.
 * SPDX-License-Identifier: GPL-3.0-or-later */
#include <stdio.h>
#include <string.h>

#include "law/law.h"
#include "transfer/mesh-changes.h"
#include "transfer/magnetic-field.h"
#include "transfer/interlace.h"
#include "transfer/transfer-frame.h"
#include "stage/stage.h"

struct config {
	const char *kernel, *mesh, *set, *field, *outside;
	bool replace;
};

/* What the options and the frame's law ask for. */
struct job {
	const struct pm_law *law;
	const char *name; /* of the mesh field */
	struct pm_sets sets;
	struct pm_mesh *mesh;
	struct pm_field *field;
	struct pm_transfer transfer;
	bool interlaced;
	struct pm_interlaced both; /* of the field, on two meshes */
};
struct state {
	struct pm_fft_plans planner; /* of interlaced meshes */
};

/* The mesh that has the field, or the words that make it. */
static int choose_field(const struct config *o, const struct pm_frame *f, struct job *j)
{
	const struct pm_law *law = j->law;
	const char *words = "";
	for (size_t i = 0; i < f->nmeshes && !j->field; i++)
		if (!o->mesh || !strcmp(o->mesh, f->meshes[i]->name)) {
			j->mesh = f->meshes[i];
			j->field = pm_frame_field(f, j->mesh->name, j->name);
		}
	if (!j->mesh)
		return pm_fail(PM_DATA, "no mesh%s%s (p2m -n CELLS makes one)", o->mesh ? " " : "", o->mesh ? o->mesh : "");
	if (law->field && !strcmp(j->name, law->field))
		words = " (run p2m | poisson-fft | mgrad first)";
	else if (law->potential && !strcmp(j->name, law->potential))
		words = " (run p2m | poisson-fft first)";
	else if (law->density && !strcmp(j->name, law->density))
		words = " (run p2m first)";
	return j->field ? 0 : pm_fail(PM_DATA, "no field '%s' on mesh '%s'%s", j->name, o->mesh ? o->mesh : j->mesh->name, words);
}

/* The normal component of a gradient has the image of the other sign; so has the tangential one of a curl in the plane. What is given has
 * the same values on both sides of any face. */
static void set_images(const struct job *j, int dim, struct pm_transfer *t)
{
	if (j->field->role == PM_STATE) {
		pm_grid_even(&t->grid);
		return;
	}
	bool law = j->law->field && !strcmp(j->name, j->law->field), curl = law && j->law->of_potential == PM_CURL;
	for (int c = 0; c < t->components && t->components == dim; c++)
		if (curl && dim == 2)
			t->flip[c][1 - c] = 1;
		else if (!curl && (law || dim > 1))
			t->flip[c][c] = 1;
}

static int job_of(const struct config *o, const struct pm_frame *f, struct job *j)
{
	*j = (struct job){.law = pm_law_of(f)};
	if (!j->law)
		return -PM_DATA;
	j->name = o->field ? o->field : j->law->field;
	if (!j->name)
		return pm_fail(PM_DATA, "the law '%s' takes nothing from a mesh (choose a field with --field NAME)", f->law);
	int status = choose_field(o, f, j);
	/* A set takes the law's field if it has what that moves, any other field if it has positions. */
	const char *const law[] = {"x", j->law->of, j->law->per, j->law->per ? j->law->strength : NULL, NULL}, *const any[] = {"x", NULL};
	if (!status)
		status = pm_sets_choose(f, o->set, o->field ? any : law, "stab reads it from a table", &j->sets);
	if (status)
		return status;
	j->interlaced = j->field->interlaced && !o->kernel && j->field->role != PM_STATE;
	j->transfer = (struct pm_transfer){.grid = pm_grid_of(f, j->mesh), .kernel = pm_kernel_choose(o->kernel, j->field, j->law, "cic"),
		.components = j->field->components};
	if (!j->transfer.kernel)
		return -PM_DATA;
	memcpy(j->transfer.staggered, j->field->staggered, sizeof j->transfer.staggered);
	set_images(j, f->dim, &j->transfer);
	return j->interlaced ? pm_interlace_check(&j->transfer) : 0;
}

static int declare(struct pm_stage *s, struct pm_frame *f)
{
	const struct config *o = s->config;
	struct job j = {0};
	int status = job_of(o, f, &j);
	if (!status && !pm_reads(f, j.mesh->name, j.name))
		status = -PM_DATA;
	const char *term = !status && j.field->role == PM_STATE ? "external" : "self";
	for (size_t i = 0; i < j.sets.n && !status; i++) {
		const char *set = j.sets.name[i];
		status = pm_reads_positions(f, set);
		if (!status && !o->field && j.law->per && (!pm_reads(f, set, j.law->strength) || !pm_reads(f, set, j.law->per)))
			status = -PM_DATA;
		struct pm_field *target = status ? NULL : o->field ? pm_makes_gathered(f, set, j.field)
			: pm_contributes(f, set, j.law->change, j.law->of, j.field->components, term, o->replace);
		if (target && target->use & PM_USE_NEW)
			target->use |= PM_USE_FILL;
		if (!target)
			status = status ? status : -PM_DATA;
		if (!status && !o->field)
			status = pm_mesh_changes_declare(f, set, j.mesh, o->replace);
		if (!status && !o->field && j.law->magnetic)
			status = pm_bfield_plan(f, set, j.mesh, j.law->magnetic, o->replace);
	}
	return status;
}

/* out[c] += factor[c] * value, with factor 1, strength/per of the law, or the volume; changes of the mesh are carried along. */
static int gather_set(struct pm_stage *s, struct pm_frame *f, const struct job *j, const struct pm_mesh_changes *carry, const char *set)
{
	const struct config *o = s->config;
	struct pm_field *target = pm_frame_field(f, set, o->field ? o->field : j->law->change);
	struct pm_transfer t = j->transfer;
	const double *x[3], *mesh[PM_COMPONENTS], *factor[PM_COMPONENTS];
	for (int c = 0; c < t.components; c++)
		t.set[c] = target->use & PM_USE_FILL;
	double *out[PM_COMPONENTS], *ratio = NULL;
	struct pm_strays strays = {.count = 0};
	pm_positions(f, set, x);
	t.kept = &pm_frame_field(f, set, "x")->note;
	int status = !o->field && j->law->per ? pm_ratio(f, set, j->law->strength, j->law->per, &ratio) : 0;
	for (int c = 0; c < t.components; c++) {
		mesh[c] = pm_in(j->field, c);
		out[c] = pm_out(target, c);
		factor[c] = o->field && target->extensive ? pm_in(pm_frame_field(f, set, "volume"), 0) : ratio;
	}
	if (!status && j->field->role == PM_STATE) { /* its images are not those of the changes */
		status = pm_gather(&t, target->count, x, mesh, factor, out, &strays);
		t.components = 0;
		t.grid = pm_grid_of(f, j->mesh);
	}
	if (!status)
		status = pm_mesh_changes_append(carry, f, set, &t, mesh, factor, out);
	if (!status && j->interlaced && t.components > j->transfer.components)
		status = pm_fail(PM_DATA, "changes on the mesh are carried over with one mesh (p2m without --interlace)");
	if (!status && j->interlaced)
		status = pm_interlace_gather(&j->both, &t, target->count, x, factor, out, &strays);
	else if (!status && t.components)
		status = pm_gather(&t, target->count, x, mesh, factor, out, &strays);
	pm_free(ratio);
	target->use |= !status && strays.finite && t.components == target->components ? PM_USE_SEEN : 0;
	if (!status && !o->field && j->law->magnetic)
		status = pm_bfield(f, set, j->mesh, j->law->magnetic, &j->transfer);
	if (!status && strays.count && strcmp(o->outside, "drop"))
		return pm_strays_refuse(&strays, set, j->mesh, &t, "--outside drop leaves it without; p2m --outside grow enlarges the mesh");
	if (!status && strays.count)
		pm_report_count(s, f, "dropped", strays.count);
	return status;
}

/* What of the changes no particle took, per time: the drift of the total. */
static void report(const struct pm_stage *s, struct pm_frame *f, const struct pm_mesh_changes *carry)
{
	char key[PM_NAME + 16];
	for (int i = 0; i < carry->n; i++)
		for (int c = 0; c < carry->change[i]->components && c < 3 && carry->share[i]; c++) {
			snprintf(key, sizeof key, carry->change[i]->components > 1 ? "lost_d%s_%d" : "lost_d%s", carry->change[i]->of, c);
			pm_report(s, f, key, carry->lost[i][c]);
		}
}

/* The field on both of its meshes. */
static int interlace(struct pm_stage *s, struct job *j)
{
	struct pm_fft_plans *p = &((struct state *)s->state)->planner;
	const double *mesh[PM_COMPONENTS];
	int effort = pm_fft_effort_find(NULL);
	if (effort < 0)
		return -PM_USAGE;
	p->effort = (enum pm_fft_effort)effort;
	for (int c = 0; c < j->field->components; c++)
		mesh[c] = pm_in(j->field, c);
	return pm_interlace_init(&j->both, &j->transfer, p, mesh);
}

static void release(struct pm_stage *s) { pm_fft_plans_clear(&((struct state *)s->state)->planner); }

static int frame(struct pm_stage *s, struct pm_frame *f)
{
	const struct config *o = s->config;
	struct job j = {0};
	struct pm_mesh_changes carry = {.n = 0};
	int status = job_of(o, f, &j);
	if (!status && !o->field)
		status = pm_mesh_changes_init(&carry, f, &j.sets, j.mesh, &j.transfer);
	if (!status && j.interlaced)
		status = interlace(s, &j);
	for (size_t i = 0; i < j.sets.n && !status; i++)
		status = gather_set(s, f, &j, &carry, j.sets.name[i]);
	if (!status)
		report(s, f, &carry);
	pm_mesh_changes_free(&carry);
	pm_interlace_free(&j.both);
	return status;
}

static const char *const outside[] = {"error", "drop", NULL};
static const struct pm_option options[] = {
	{.name = "kernel", .letter = 'k', .kind = PM_WORD, .choices = pm_kernel_names, PM_AT(kernel),
		.text = "how mesh points are weighted (default: as the field was made, interlaced too)"},
	{.name = "field", .kind = PM_TEXT, .unit = "NAME", PM_AT(field), .text = "gather this mesh field to a particle field of the same name instead"},
	{.name = "mesh", .kind = PM_TEXT, .unit = "NAME", PM_AT(mesh), .text = "the mesh (default: the first that has the field)"},
	{.name = "set", .kind = PM_TEXT, .unit = "NAME", PM_AT(set), .text = "only this set (default: every set with the state that the law moves)"},
	{.name = "outside", .kind = PM_WORD, .fallback = "error", .choices = outside, PM_AT(outside),
		.text = "particles that an open mesh does not hold: refuse, or leave out and count"},
	{.name = "replace", .kind = PM_FLAG, PM_AT(replace), .text = "compute the change field anew instead of refusing to add twice"},
	{0},
};
static const struct pm_example examples[] = {
	{"the acceleration of each star from the mesh", "pinit uniform -n 1000 | p2m -n 16 | poisson-fft | mgrad | m2p | sls"},
	{"the density where the particles are", "pinit uniform -n 1000 | p2m -n 16 --kernel tsc | m2p --field rho | sls"},
	{0},
};
const struct pm_tool tool_m2p = {
	.name = "m2p",
	.summary = "bring mesh fields to the particles and add them to what changes the particles",
	.about = "value(x) = sum over mesh points of W((x - x_i)/h) value(i), the transpose of p2m, with the kernel the field was made with: that is what "
		 "keeps momentum and makes a particle exert no force on itself. The law says which field is gathered (g, E, u) and what it adds to (acc, vel); "
		 "a field that was given counts as the term external, one that was solved for as self; a magnetic field B goes to bfield. Changes on the mesh (domega of diffuse) are carried over "
		 "to the strengths they belong to (dcirculation), times the volume of the particle; what goes to none, where particles leave gaps or end, is reported (lost_dcirculation, per time). See docs/methods/transfer.md.",
	.kind = PM_FILTER,
	.makes = true,
	.reads = "x of every set that has the state the law moves; the law's mesh field (g, E, u); strengths where the law divides by another",
	.adds = "the law's change field (acc, vel) and those of the mesh (dcirculation), or with --field a derived particle field",
	.config = sizeof(struct config),
	.state = sizeof(struct state),
	.options = options,
	.examples = examples,
	.declare = declare,
	.frame = frame,
	.free = release,
};
