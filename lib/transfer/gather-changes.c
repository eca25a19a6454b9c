/* The changes on a mesh carried to the particles whose states they name, as m2p does beside the law's field (mesh-changes.c). Cost: a spread of the volumes and
 * a gather. SPDX-License-Identifier: GPL-3.0-or-later */
#include <string.h>

#include "mesh/planes.h"
#include "stream/declare.h"
#include "transfer/gather-changes.h"
#include "world/world.h"

struct job {
	struct pm_mesh *mesh;
	struct pm_sets sets;
	struct pm_transfer transfer;
	struct pm_planes planes;
};

/* Does some change of the mesh name a state of the set? If so the fields' common kernel is kept in `made`. */
static bool concerns(const struct pm_frame *f, const char *set, const struct pm_mesh *m, struct pm_field *made)
{
	bool any = false;
	for (size_t i = 0; i < f->nfields; i++)
		if (pm_mesh_change_concerns(f, set, m, f->fields[i])) {
			pm_field_inherit(made, f->fields[i]);
			any = true;
		}
	return any && pm_frame_field(f, set, "x");
}

static int choose(const struct pm_gather_choice *o, const struct pm_frame *f, struct job *j)
{
	struct pm_field made = {.kernel = ""};
	*j = (struct job){.mesh = NULL};
	for (size_t m = 0; m < f->nmeshes && !j->sets.n; m++)
		for (size_t i = 0; i < f->nsets && (!o->mesh || !strcmp(o->mesh, f->meshes[m]->name)); i++)
			if ((!o->set || !strcmp(o->set, f->sets[i]->name)) && concerns(f, f->sets[i]->name, f->meshes[m], &made) && j->sets.n < PM_SETS_MOST) {
				j->mesh = f->meshes[m];
				j->sets.name[j->sets.n++] = f->sets[i]->name;
			}
	if (!j->sets.n)
		return pm_fail(PM_DATA, "no change on a mesh names a state of particles%s%s (diffuse makes one; m2p --field NAME for another field)",
			o->set ? " of " : "", o->set ? o->set : "");
	if (!strcmp(made.kernel, "several") && !o->kernel)
		return pm_fail(PM_DATA, "the changes on '%s' were made with different kernels (choose one: m2p --kernel)", j->mesh->name);
	if (made.interlaced)
		return pm_fail(PM_DATA, "changes on the mesh are carried over with one mesh (p2m without --interlace)");
	j->transfer = (struct pm_transfer){.grid = pm_grid_of(f, j->mesh), .kernel = pm_kernel_choose(o->kernel, &made, pm_law_of(f), "m4prime")};
	return j->transfer.kernel ? 0 : -PM_DATA;
}

int pm_gather_changes_declare(const struct pm_gather_choice *choice, struct pm_frame *f)
{
	struct job j;
	int status = choose(choice, f, &j);
	for (size_t i = 0; i < j.sets.n && !status; i++)
		if (!(status = pm_reads_positions(f, j.sets.name[i])))
			status = pm_mesh_changes_declare(f, j.sets.name[i], j.mesh, choice->replace);
	return status;
}

/* The planes of this rank, those of any field of the mesh in use. */
static int planes_of(struct job *j, const struct pm_frame *f)
{
	const struct pm_field *change = NULL;
	for (size_t i = 0; i < f->nfields && !change; i++)
		if (pm_mesh_change_concerns(f, j->sets.name[0], j->mesh, f->fields[i]))
			change = f->fields[i];
	j->transfer.planes = &j->planes;
	return pm_world_agree(pm_planes_init(&j->planes, &j->transfer.grid, change));
}

static int carry_to(const struct job *j, const struct pm_frame *f, const char *set, const struct pm_mesh_changes *carry, struct pm_strays *strays)
{
	struct pm_transfer t = j->transfer;
	const struct pm_field *at = pm_frame_field(f, set, "x");
	const double *x[3], *mesh[PM_COMPONENTS], *factor[PM_COMPONENTS];
	double *out[PM_COMPONENTS];
	int status = pm_mesh_changes_append(carry, f, set, &t, mesh, factor, out);
	pm_positions(f, set, x);
	t.kept = &((struct pm_field *)(uintptr_t)at)->note;
	status = status ? status : pm_gather(&t, at->count, x, mesh, factor, out, strays);
	strays->first += at->first;
	return status;
}

/* Particles beyond the mesh of all ranks, which are refused or counted. */
static int judge(int status, const struct job *j, const char *set, bool drop, const struct pm_strays *strays, uint64_t *dropped)
{
	int64_t all = (int64_t)strays->count;
	if (!status && strays->count && !drop)
		status = pm_strays_refuse(strays, set, j->mesh, &j->transfer, "--outside drop leaves it without; p2m --outside grow enlarges the mesh");
	status = pm_world_count(status, PM_SUM_OF, 1, &all);
	*dropped += status ? 0 : (uint64_t)all;
	return status;
}

int pm_gather_changes(const struct pm_gather_choice *choice, struct pm_frame *f, struct pm_mesh_changes *carry, uint64_t *dropped)
{
	const bool drop = choice->outside && !strcmp(choice->outside, "drop");
	struct job j;
	*carry = (struct pm_mesh_changes){.n = 0};
	*dropped = 0;
	int status = choose(choice, f, &j);
	status = status ? status : planes_of(&j, f);
	if (!status)
		status = pm_mesh_changes_init(carry, f, &j.sets, j.mesh, &j.transfer);
	for (size_t i = 0; i < j.sets.n && !status; i++) {
		struct pm_strays strays = {.count = 0};
		status = carry_to(&j, f, j.sets.name[i], carry, &strays);
		status = judge(status, &j, j.sets.name[i], drop, &strays, dropped);
	}
	pm_planes_free(&j.planes);
	return status;
}
