/* The square of a strength's density: sum of q^2/volume over particles, of vorticity twice the enstrophy, which moving particles does not change in the plane
 * and remeshing does. By the law of sums (base/in-order.h). SPDX-License-Identifier: GPL-3.0-or-later */
#include <string.h>

#include "remesh/remesh-frame.h"
#include "stream/kept.h"
#include "stream/over-stretches.h"

struct values {
	const double *q, *each; /* volumes, or NULL: all */
	double all;
};

static void block(const void *data, size_t from, size_t to, void *part)
{
	const struct values *v = data;
	double square[pm_sum_block];
	for (size_t p = from; p < to; p++) {
		const double volume = v->each ? v->each[p] : v->all;
		square[p - from] = volume > 0 ? v->q[p] * v->q[p] / volume : 0;
	}
	pm_sum_of_set(to - from, square, NULL, part);
}

static bool dropped(const struct pm_field *q, const struct pm_remesh_choice *c)
{
	bool is = false;
	for (int i = 0; i < c->ndrop; i++)
		is = is || !strcmp(c->drop[i], q->name);
	return is;
}

/* Kept while both stay: after a remesh, and before the next one. */
static double sum_of(const struct pm_field *q, const struct pm_field *volume)
{
	static const char name[] = "sum of q^2/volume";
	const struct pm_parts parts = {.size = sizeof(struct pm_sum), .make = block, .join = pm_join_sums};
	const double *kept = pm_kept(q, volume, name);
	if (kept)
		return *kept;
	struct values v = {.each = volume->buffer ? pm_in(volume, 0) : NULL, .all = volume->value[0]};
	struct pm_sum all = {0, 0};
	for (int k = 0; k < q->components; k++) {
		v.q = pm_in(q, k);
		pm_over_stretches(q, &parts, &v, &all);
	}
	double *keep = pm_alloc(1, sizeof *keep);
	if (keep)
		*keep = pm_sum_total(all);
	if (keep && !pm_keep(q, volume, name, keep))
		pm_free(keep);
	return pm_sum_total(all);
}

const struct pm_field *pm_remesh_squared(const struct pm_frame *f, const char *set, const struct pm_remesh_choice *c, double *square)
{
	const struct pm_field *volume = pm_frame_field(f, set, "volume");
	*square = 0;
	if (!volume || !(volume->buffer || volume->uniform) || volume->components != 1)
		return NULL;
	for (size_t i = 0; i < f->nfields; i++) {
		const struct pm_field *q = f->fields[i];
		if (strcmp(q->on, set) || !pm_is_strength(q) || !q->buffer || dropped(q, c))
			continue;
		*square = sum_of(q, volume);
		return q;
	}
	return NULL;
}
