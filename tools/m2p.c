/* m2p: mesh fields at the positions of particles, added to their rates of change (lib/transfer/gather-frame.c).
 * SPDX-License-Identifier: GPL-3.0-or-later */
#include <stdio.h>
#include <string.h>

#include "stage/stage.h"
#include "expression/mesh-mask.h"
#include "law/law.h"
#include "transfer/gather-changes.h"
#include "transfer/gather-energy.h"

struct config {
	const char *kernel, *mesh, *set, *field, *outside, *mask;
	bool replace, changes, energy;
};
struct state {
	struct pm_fft_plans plans; /* of interlaced meshes */
};

static int begin(struct pm_stage *s)
{
	const struct config *o = s->config;
	if (o->mask && (o->changes || o->outside))
		return pm_fail(PM_USAGE, "--mask excludes --changes and --outside (beside faces and bodies kernels are one-sided; beyond is refused)");
	if (o->energy && (o->mask || o->changes || o->field || o->outside))
		return pm_fail(PM_USAGE, "--energy-conserving excludes --mask, --changes, --field and --outside (it is the law's force alone)");
	return o->changes && o->field ? pm_fail(PM_USAGE, "--changes or --field, not both: the changes are what is carried") : 0;
}

static struct pm_gather_choice choice_of(const struct config *o)
{
	return (struct pm_gather_choice){.kernel = o->kernel, .mesh = o->mesh, .set = o->set, .field = o->field, .replace = o->replace, .outside = o->outside,
		.beside = o->mask, .conserving = o->energy};
}

/* Changes alone: asked for, or the law has no field and the mesh has changes. */
static bool only_changes(const struct config *o, const struct pm_frame *f)
{
	const struct pm_law *law = pm_law_of(f);
	bool any = o->changes;
	for (size_t i = 0; i < f->nfields && law && !law->field && !o->field; i++)
		any = any || (f->fields[i]->role == PM_CHANGE && f->fields[i]->of[0] && pm_frame_mesh(f, f->fields[i]->on));
	return any;
}

static int declare(struct pm_stage *s, struct pm_frame *f)
{
	const struct pm_gather_choice choice = choice_of(s->config);
	struct pm_gather_job j;
	int status;
	if (pm_gather_by_potential(&choice, f))
		return (status = pm_gather_energy_choose(&choice, f, &j)) ? status : pm_gather_energy_declare(&j, f);
	if (only_changes(s->config, f))
		return pm_gather_changes_declare(&choice, f);
	status = pm_gather_choose(&choice, f, &j);
	if (!status && choice.beside)
		status = pm_mesh_mask_declare(f, j.mesh, ((const struct config *)s->config)->mask);
	return status ? status : pm_gather_declare(&j, f);
}

/* The part of the changes that no particle received, per time: the drift of the total. */
static void report(const struct pm_stage *s, struct pm_frame *f, const struct pm_mesh_changes *carry)
{
	char key[PM_NAME + 16];
	for (int i = 0; i < carry->n; i++)
		for (int c = 0; c < carry->change[i]->components && c < 3 && carry->share[i]; c++) {
			snprintf(key, sizeof key, carry->change[i]->components > 1 ? "lost_d%s_%d" : "lost_d%s", carry->change[i]->of, c);
			pm_report(s, f, key, carry->lost[i][c]);
		}
}

static int frame_of_changes(struct pm_stage *s, struct pm_frame *f)
{
	const struct pm_gather_choice choice = choice_of(s->config);
	struct pm_mesh_changes carry;
	uint64_t dropped;
	int status = pm_gather_changes(&choice, f, &carry, &dropped);
	if (!status && dropped)
		pm_report_count(s, f, "dropped", dropped);
	if (!status)
		report(s, f, &carry);
	pm_mesh_changes_free(&carry);
	return status;
}

static int frame(struct pm_stage *s, struct pm_frame *f)
{
	struct pm_gather_choice choice = choice_of(s->config);
	choice.later = s->fused;
	struct pm_gather_job j;
	unsigned char *mask = NULL;
	int status;
	if (pm_gather_by_potential(&choice, f))
		return (status = pm_gather_energy_choose(&choice, f, &j)) ? status : pm_gather_energy(&j, f);
	if (only_changes(s->config, f))
		return frame_of_changes(s, f);
	status = pm_gather_choose(&choice, f, &j);
	if (!status && choice.beside)
		status = pm_mesh_mask(f, j.mesh, ((const struct config *)s->config)->mask, pm_frame_field(f, j.sets.name[0], "x")->here, &mask);
	j.choice.mask = mask;
	if (!status)
		status = pm_gather_prepare(&j, f, &((struct state *)s->state)->plans);
	for (size_t i = 0; i < j.sets.n && !status; i++) {
		uint64_t dropped = 0;
		status = pm_gather_set(&j, f, j.sets.name[i], &dropped);
		if (!status && dropped)
			pm_report_count(s, f, "dropped", dropped);
	}
	if (!status)
		status = pm_gather_outside(&j, f);
	if (!status && 9 * j.far.count > j.far.within)
		pm_tell_once(s, "%g of %g particles are beyond the mesh, where they feel those inside and not each other (a larger box)",
			(double)j.far.count, (double)(j.far.count + j.far.within));
	if (!status)
		report(s, f, &j.changes);
	pm_gather_free(&j);
	pm_free(mask);
	return status;
}

static bool divided(const struct pm_stage *s, const struct pm_frame *f)
{
	const struct pm_gather_choice choice = choice_of(s->config);
	struct pm_gather_job j;
	if (choice.conserving)
		return pm_gather_by_potential(&choice, f) && !pm_gather_energy_choose(&choice, f, &j);
	return only_changes(s->config, f) || !pm_gather_choose(&choice, f, &j);
}

static void release(struct pm_stage *s) { pm_fft_plans_clear(&((struct state *)s->state)->plans); }

static const struct pm_option options[] = {
	{.name = "kernel", .letter = 'k', .kind = PM_WORD, .choices = pm_kernel_names, PM_AT(kernel),
		.text = "the interpolation kernel (default: the kernel of the field, interlaced if the field is)"},
	{.name = "field", .kind = PM_TEXT, .unit = "NAME", PM_AT(field), .text = "gather this mesh field to a particle field of the same name instead"},
	{.name = "changes", .kind = PM_FLAG, PM_AT(changes),
		.text = "carry the changes on the mesh alone, without the law's field (as it is where the law has none)"},
	{.name = "mesh", .kind = PM_TEXT, .unit = "NAME", PM_AT(mesh), .text = "the mesh (default: the first that has the field)"},
	{.name = "set", .kind = PM_TEXT, .unit = "NAME", PM_AT(set), .text = "only this set (default: every set with the state that the law moves)"},
	{.name = "outside", .kind = PM_WORD, .choices = pm_outside_names, PM_AT(outside),
		.text = "particles beyond an open mesh: the force of the monopole of those inside, and the reaction on these; no force; or failure (default: "
			"as p2m made the density; failure where the field is not that of particles)"},
	{.name = "mask", .kind = PM_TEXT, .unit = "EXPRESSION", PM_AT(mask),
		.text = "bodies: nodes where this is not 0 are not used ('x^2 + y^2 < 1'; 0 for none), and kernels beside them and beside faces are one-sided, "
			"without images"},
	{.name = "energy-conserving", .kind = PM_FLAG, PM_AT(energy),
		.text = "the potential by the gradient of the kernel (no mgrad); E and B of maxwell by kernels one order lower along the axes on which "
			"they sit half a cell up: conserves energy, momentum only nearly"},
	{.name = "replace", .kind = PM_FLAG, PM_AT(replace), .text = "replace the change field instead of refusing to add to it twice"},
	{0},
};
static const struct pm_example examples[] = {
	{"the acceleration of each star from the mesh", "pinit uniform -n 1000 | p2m -n 16 | poisson-fft | mgrad | m2p | sls"},
	{"the density where the particles are", "pinit uniform -n 1000 | p2m -n 16 --kernel tsc | m2p --field rho | sls"},
	{0},
};
const struct pm_tool tool_m2p = {
	.name = "m2p",
	.summary = "interpolate mesh fields to the particles and add them to their rates of change",
	.about = "value(x) = sum over mesh points of W((x - x_i)/h) value(i), the transpose of p2m, with the kernel the field was made with, so that momentum "
		"is conserved and a particle exerts no force on itself. The law determines the field that is gathered (g, E, u) and the rate it is added to "
		"(acc, vel); a given field is the term external, a computed one the term self; a magnetic field B goes to bfield. Changes on the mesh (domega "
		"of diffuse) are interpolated to the rates of the strengths (dcirculation), times the volume of the particle; the part that no particle "
		"receives, in gaps or beyond the particles, is reported (lost_dcirculation, per time). See docs/methods/transfer.md.",
	.kind = PM_FILTER,
	.makes = true,
	.reads = "x of every set that has the state the law moves; the law's mesh field (g, E, u); strengths where the law divides by another",
	.adds = "the law's change field (acc, vel) and those of the mesh (dcirculation), or with --field a derived particle field",
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
