/* J = sum over the sets of the current of their particles from x to x + v dt (current.c), on the mesh: the change of E that maxwell uses up. It must be taken
 * between the first half of the kick and the drift, from the velocities at the middle of the step. Cost: as a density, about three times.
 * SPDX-License-Identifier: GPL-3.0-or-later */
#include <stdio.h>
#include <string.h>

#include "mesh/planes.h"
#include "stream/declare.h"
#include "stream/later.h"
#include "current/current-frame.h"
#include "current/current-parts.h"
#include "current/current-pass.h"
#include "world/world.h"

static const char *const name = "J";

static void set_geometry(struct pm_current_job *j, const struct pm_frame *f)
{
	struct pm_current *c = &j->current;
	c->grid = pm_grid_of(f, j->mesh);
	c->dt = f->dt;
	for (int d = 0; d < 3; d++) {
		c->lo[d] = f->lo[d], c->hi[d] = f->hi[d];
		for (int s = 0; s < 2; s++)
			c->face[d][s] = d < f->dim ? f->pface[d][s] : PM_PFOLD;
	}
}

int pm_current_choose(const struct pm_spread_choice *choice, const char *deposit, const struct pm_frame *f, struct pm_current_job *j)
{
	const struct pm_law *law = pm_law_of(f);
	*j = (struct pm_current_job){.law = law};
	if (!law)
		return -PM_DATA;
	if (choice->strength || choice->field || choice->add || choice->interlace || choice->rim)
		return pm_fail(PM_USAGE, "--current makes J of the law's charges (leave out --strength, --field, --add, --interlace, --rim)");
	if (!law->evolves)
		return pm_fail(PM_DATA, "the law '%s' has no field that a current changes (smod --law electromagnetic)", f->law);
	j->current.kernel = pm_kernel_choose(choice->kernel, NULL, law, "cic");
	j->mesh = pm_frame_mesh(f, choice->mesh);
	if (j->current.kernel && j->current.kernel->star)
		return pm_fail(PM_DATA, "currents are of kernels that are a product of the axes, and %s is not (p2m --kernel tsc)", j->current.kernel->name);
	if (!j->current.kernel)
		return -PM_DATA;
	if (!j->mesh && !choice->cells)
		return pm_fail(PM_DATA, "no mesh%s%s (p2m -n CELLS makes one)", choice->mesh ? " " : "", choice->mesh ? choice->mesh : "");
	while (strcmp(pm_deposit_names[j->current.deposit], deposit))
		j->current.deposit++;
	return pm_sets_choose(f, choice->set, (const char *const[]){law->strength, "x", "v", NULL}, "add it with stab --strength", &j->sets);
}

static int check_set(const struct pm_frame *f, const char *name_of)
{
	const struct pm_set *s = pm_frame_set(f, name_of);
	const struct pm_field *v = pm_frame_field(f, name_of, "v");
	if (s->drift > 0)
		return pm_fail(PM_DATA, "'%s' has drifted in this step, and its current is that of the way to come (push boris/2 | p2m --current | maxwell | "
			"push drift | m2p | push boris/2)", name_of);
	if (v->components < f->dim)
		return pm_fail(PM_DATA, "'%s' has velocities of %d components in %d dimensions (stab --velocities)", name_of, v->components, f->dim);
	return f->dt != 0 && isfinite(f->dt) ? 0 : pm_fail(PM_DATA, "the frame has no time step (smod --dt, or the word dt)");
}

static void takes_columns(const struct pm_current_job *j, const struct pm_frame *f, const char *set)
{
	struct pm_field *x = pm_frame_field(f, set, "x"), *q = pm_frame_field(f, set, j->law->strength);
	x->use |= PM_USE_COLUMNS;
	pm_frame_field(f, set, "v")->use |= PM_USE_COLUMNS | PM_USE_LATER;
	if (q->extensive)
		q->use |= PM_USE_COLUMNS;
}

int pm_current_declare(struct pm_current_job *j, struct pm_frame *f)
{
	struct pm_current *c = &j->current;
	set_geometry(j, f);
	int status = pm_current_check(c);
	for (size_t i = 0; i < j->sets.n && !status; i++) {
		const char *set = j->sets.name[i];
		status = check_set(f, set);
		status = status ? status : pm_reads_positions(f, set);
		status = status ? status : pm_reads_strength(f, set, j->law->strength);
		if (!status && !pm_reads(f, set, "v"))
			status = -PM_DATA;
		if (!status)
			takes_columns(j, f, set);
	}
	struct pm_field *field = status ? NULL : pm_makes(f, j->mesh->name, name, 3, PM_CHANGE);
	if (!field)
		return status ? status : -PM_DATA;
	snprintf(field->of, sizeof field->of, "%s", j->law->field);
	snprintf(field->kernel, sizeof field->kernel, "%s", c->kernel->name);
	snprintf(field->unit, sizeof field->unit, "charge/(time length^%d)", f->dim - 1);
	snprintf(field->terms[field->nterms++], PM_NAME, "current");
	for (int d = 0; d < f->dim; d++)
		field->staggered[d][d] = 1;
	return 0;
}

/* As columns, where positions are floats, or the charge is one number, and the ways allow it: 1 done, 0 not, or failure. */
static int add_columns(const struct pm_current_job *j, const struct pm_frame *f, const char *set, double *const mesh[3], size_t *stray)
{
	const struct pm_field *x = pm_frame_field(f, set, "x"), *v = pm_frame_field(f, set, "v"), *q = pm_frame_field(f, set, j->law->strength);
	struct pm_column at[3], along[3] = {{.value = 0}}, charge;
	bool far = false;
	if (!q->extensive || (j->current.planes && j->current.planes->divided))
		return 0;
	for (int d = 0; d < f->dim; d++)
		at[d] = pm_column_of(x, d);
	for (int d = 0; d < 3 && d < v->components; d++)
		along[d] = pm_column_of(v, d);
	charge = pm_column_of(q, 0);
	struct pm_current c = j->current;
	c.kept = &pm_frame_field(f, set, "x")->note;
	if (!at[0].floats && charge.doubles)
		return 0;
	const int status = pm_current_columns(&c, x->count, at, along, &charge, mesh, stray, &far);
	return status ? status : !far;
}

static int add_set(struct pm_current_job *j, struct pm_frame *f, const char *set)
{
	struct pm_field *field = pm_frame_field(f, j->mesh->name, name);
	const struct pm_field *vel = pm_frame_field(f, set, "v");
	const size_t n = pm_frame_field(f, set, "x")->count;
	struct pm_planes planes;
	const double *x[3] = {NULL}, *v[3], *q[PM_COMPONENTS];
	double *mesh[3], *made = NULL;
	size_t stray = SIZE_MAX;
	for (int d = 0; d < 3; d++)
		mesh[d] = pm_out(field, d);
	int status = pm_planes_init(&planes, &j->current.grid, field);
	j->current.planes = &planes;
	int done = status ? status : pm_current_pass(j, f, set, mesh);
	if (!done && pm_field_now(pm_frame_field(f, set, "v")))
		done = -PM_DATA;
	if (!done)
		done = add_columns(j, f, set, mesh, &stray);
	if (!done) {
		pm_positions(f, set, x);
		for (int d = 0; d < 3; d++)
			v[d] = d < vel->components ? pm_in(vel, d) : NULL;
		status = pm_strengths(f, set, j->law->strength, q, &made);
	}
	status = pm_world_agree(done < 0 ? done : status);
	if (!status && !done)
		status = pm_current_add(&j->current, n, x, v, q[0], mesh, &stray);
	if (status && stray < pm_frame_set(f, set)->n)
		status = pm_fail(PM_DATA, "particle %zu of '%s' is outside the box (push folds, reflects or absorbs them at its faces)", stray, set);
	pm_free(made);
	pm_planes_free(&planes);
	j->current.planes = NULL;
	return status;
}

int pm_current_frame(struct pm_current_job *j, struct pm_frame *f)
{
	int status = 0;
	set_geometry(j, f);
	for (size_t i = 0; i < j->sets.n && !status; i++)
		status = pm_frame_set(f, j->sets.name[i])->fixed ? 0 : add_set(j, f, j->sets.name[i]);
	return status;
}
