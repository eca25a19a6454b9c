/* Carrying changes over: d(strength)_p += volume_p sum over points of W((x_p - x_i)/h) d(density)_i; without the volume where the state is a value.
 * The sum over a lattice of particles is that over the mesh; over distorted particles it differs as their overlap differs from 1.
 * Source: Cottet and Koumoutsakos 2000, section 5.5. Cost: a gather per field. SPDX-License-Identifier: GPL-3.0-or-later */
#include <stdio.h>
#include <string.h>

#include "mesh/carry.h"
#include "stream/fastest.h"

enum { MOST = 16 };

/* The change fields of the mesh that concern the set. */
static int list(const struct pm_frame *f, const char *set, const struct pm_mesh *m, struct pm_field *fields[MOST])
{
	int n = 0;
	for (size_t i = 0; i < f->nfields && n < MOST; i++) {
		struct pm_field *c = f->fields[i];
		const struct pm_field *state = c->role == PM_CHANGE && !strcmp(c->on, m->name) && c->of[0] ? pm_frame_field(f, set, c->of) : NULL;
		if (state && state->role == PM_STATE)
			fields[n++] = c;
	}
	return n;
}

static void target_name(const struct pm_field *change, char name[PM_NAME]) { snprintf(name, PM_NAME, "d%.62s", change->of); }

static int plan_field(struct pm_frame *f, const char *set, struct pm_field *change, bool replace)
{
	char name[PM_NAME];
	struct pm_field *to = NULL;
	bool strength = pm_frame_field(f, set, change->of)->extensive;
	if (strength && !pm_frame_field(f, set, "volume"))
		return pm_fail(PM_DATA, "'%s' on '%s' is a strength: its change '%s' on the mesh must be multiplied by a 'volume', and there is none (scalc "
			"makes one, or a column volume in the table)", change->of, set, change->name);
	if (strength && !pm_reads(f, set, "volume"))
		return -PM_DATA;
	target_name(change, name);
	change->use |= PM_USE_READ;
	for (int t = 0; t < change->nterms; t++, replace = false)
		if (!(to = pm_contributes(f, set, name, change->of, change->components, change->terms[t], replace)))
			return -PM_DATA;
	if (to) {
		to->extensive = strength;
		pm_fastest_add(to, pm_fastest(change));
	}
	return 0;
}

int pm_carry_plan(struct pm_frame *f, const char *set, const struct pm_mesh *m, bool replace)
{
	struct pm_field *fields[MOST];
	int n = list(f, set, m, fields), status = 0;
	for (int i = 0; i < n && !status; i++)
		status = plan_field(f, set, fields[i], replace);
	return status;
}

static int carry_field(struct pm_frame *f, const char *set, const struct pm_field *change, const struct pm_transfer *t)
{
	char name[PM_NAME];
	const double *x[3], *mesh[PM_COMPONENTS];
	double *out[PM_COMPONENTS];
	struct pm_strays strays;
	target_name(change, name);
	struct pm_field *to = pm_frame_field(f, set, name);
	for (int d = 0; d < f->dim; d++)
		x[d] = pm_in(pm_frame_field(f, set, "x"), d);
	for (int c = 0; c < change->components; c++) {
		mesh[c] = pm_in(change, c);
		out[c] = pm_out(to, c);
	}
	return pm_gather(t, to->count, x, mesh, to->extensive ? pm_in(pm_frame_field(f, set, "volume"), 0) : NULL, out, &strays);
}

int pm_carry(struct pm_frame *f, const char *set, const struct pm_mesh *m, const struct pm_kernel *kernel, const struct pm_transfer *t)
{
	struct pm_field *fields[MOST];
	int n = list(f, set, m, fields), status = 0;
	for (int i = 0; i < n && !status; i++) {
		struct pm_transfer own = {.grid = t->grid, .kernel = kernel, .components = fields[i]->components};
		if (!own.kernel)
			own.kernel = fields[i]->kernel[0] ? pm_kernel_find(fields[i]->kernel) : t->kernel;
		memcpy(own.half, fields[i]->half, sizeof own.half);
		for (int c = 0; c < own.components && own.components > 1 && own.components == f->dim; c++)
			own.flip[c][c] = 1; /* a vector: its normal component has the image of the other sign */
		status = own.kernel ? carry_field(f, set, fields[i], &own) : -PM_DATA;
	}
	return status;
}
