/* bfield_p += sum over points of W((x_p - x_i)/h) B_i, or B where it is uniform. B is given, so it has no image sign at walls: the same values are used on
 * both sides; where it evolves by Maxwell's equations it has theirs. SPDX-License-Identifier: GPL-3.0-or-later */
#include <string.h>

#include "transfer/magnetic-field.h"
#include "law/law.h"
#include "stream/declare.h"

static const char *const target = "bfield";

static bool evolves(const struct pm_frame *f)
{
	const struct pm_law *law = pm_law_of(f);
	return law && law->evolves;
}

int pm_bfield_plan(struct pm_frame *f, const char *set, const struct pm_mesh *m, const char *name, bool replace)
{
	const struct pm_field *given = pm_frame_field(f, m->name, name);
	if (!given)
		return 0;
	if (given->components != 3)
		return pm_fail(PM_DATA, "'%s' on mesh '%s' has %d components, and a magnetic field has 3", name, m->name, given->components);
	const char *term = given->role == PM_STATE && !evolves(f) ? "external" : "self";
	return pm_reads(f, m->name, name) && pm_contributes(f, set, target, "", 3, term, replace) ? 0 : -PM_DATA;
}

/* Is it gathered together with E, all values of the target? */
bool pm_bfield_sets(const struct pm_frame *f, const struct pm_mesh *m, const char *name)
{
	const struct pm_field *given = pm_frame_field(f, m->name, name);
	return given && !given->uniform && evolves(f);
}

bool pm_bfield_append(struct pm_frame *f, const char *set, const struct pm_mesh *m, const char *name, struct pm_gather_arrays *a)
{
	const struct pm_field *given = pm_frame_field(f, m->name, name);
	struct pm_field *to = pm_bfield_sets(f, m, name) ? pm_frame_field(f, set, target) : NULL;
	struct pm_transfer own = {.components = 0};
	pm_transfer_maxwell(&own, false);
	for (int c = 0; c < 3 && to; c++) {
		const int k = a->t.components++;
		memcpy(a->t.staggered[k], given->staggered[c], sizeof a->t.staggered[k]);
		memcpy(a->t.flip[k], own.flip[c], sizeof a->t.flip[k]);
		a->t.set[k] = to->use & PM_USE_FILL;
		a->mesh[k] = pm_in(given, c);
		a->factor[k] = NULL;
		if (a->columns) {
			a->to[k] = pm_target_of(to, c);
			a->times[k] = (struct pm_column){.value = 1};
		} else
			a->out[k] = pm_out(to, c);
	}
	return to;
}

int pm_bfield(struct pm_frame *f, const char *set, const struct pm_mesh *m, const char *name, const struct pm_transfer *t)
{
	const struct pm_field *given = pm_frame_field(f, m->name, name);
	struct pm_field *to = given ? pm_frame_field(f, set, target) : NULL;
	struct pm_transfer own = {.grid = t->grid, .kernel = t->kernel, .lower = t->lower, .components = 3, .planes = t->planes};
	const double *x[3] = {0}, *mesh[3];
	double *out[3];
	struct pm_strays strays;
	for (int c = 0; c < 3 && to; c++) {
		mesh[c] = pm_in(given, c);
		out[c] = pm_out(to, c);
		for (size_t i = 0; i < to->count && given->uniform; i++)
			out[c][i] += given->value[c];
	}
	if (!to || given->uniform)
		return 0;
	for (int d = 0; d < f->dim; d++)
		x[d] = pm_in(pm_frame_field(f, set, "x"), d);
	memcpy(own.staggered, given->staggered, sizeof own.staggered);
	if (evolves(f))
		pm_transfer_maxwell(&own, false);
	else
		pm_grid_even(&own.grid);
	return pm_gather(&own, to->count, x, mesh, NULL, out, &strays);
}
