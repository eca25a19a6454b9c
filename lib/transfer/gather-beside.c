/* m2p --mask: the particles whose kernel reaches a body or a face take the value of a one-sided kernel (one-sided.c) instead of what a gather with images gave.
 * Cost: that of their shares. SPDX-License-Identifier: GPL-3.0-or-later */
#include "transfer/gather-beside.h"
#include "world/world.h"

int pm_gather_beside_find(const struct pm_gather_job *j, const struct pm_gather_arrays *a, struct pm_gather_beside *b)
{
	b->o = (struct pm_one_sided){.grid = j->transfer.grid, .kernel = j->transfer.kernel, .mask = j->choice.mask, .planes = &j->planes};
	int status = pm_one_sided_find(&b->o, a->n, a->x, &b->few);
	b->values = status ? NULL : pm_alloc(2 * (b->few.count + 1) * (size_t)a->t.components, sizeof *b->values);
	for (int c = 0; c < a->t.components && b->values; c++)
		for (size_t k = 0; k < b->few.count; k++)
			b->values[(size_t)c * b->few.count + k] = a->t.set[c] ? 0 : a->out[c][b->few.which[k]];
	return status ? status : b->values ? 0 : -PM_DATA;
}

/* x: of the set, whose first particle here has this number. */
static int refuse(const struct pm_field *x, const struct pm_one_sided_few *few)
{
	pm_world_place(2, 0, 0, x->first + few->first);
	return pm_fail(PM_DATA, "particle %zu of '%s' is beyond the mesh, or deeper in a body than 16 cells (a larger box, or a smaller step)",
		(size_t)x->first + few->first, x->on);
}

int pm_gather_beside(const struct pm_gather_job *j, const struct pm_gather_arrays *a, const struct pm_field *x, struct pm_gather_beside *b)
{
	const int components = j->transfer.components;
	double *value[PM_COMPONENTS] = {NULL};
	for (int c = 0; c < components; c++)
		value[c] = b->values + (size_t)(components + c) * b->few.count;
	int status = pm_one_sided_gather(&b->o, &b->few, components, a->mesh, value);
	status = pm_planes_agree(!status && b->few.lost ? refuse(x, &b->few) : status, &j->planes);
	for (int c = 0; c < components && !status; c++)
		for (size_t k = 0; k < b->few.count; k++)
			a->out[c][b->few.which[k]] = b->values[(size_t)c * b->few.count + k] + (a->factor[c] ? a->factor[c][b->few.which[k]] : 1) * value[c][k];
	return status;
}

void pm_gather_beside_free(struct pm_gather_beside *b)
{
	pm_free(b->few.which), pm_free(b->values);
	b->few.count = 0;
}
