/* The order of particles in one transfer, kept for the next one at the same positions. An order is a function of positions, mesh and width, so the result
 * does not depend on whether it was found or computed. SPDX-License-Identifier: GPL-3.0-or-later */
#include <stdlib.h>
#include <string.h>

#include "mesh/planes.h"
#include "transfer/order-cache.h"

struct pm_order_cache *pm_order_cache_free(struct pm_order_cache *o)
{
	if (!o || o->holders-- > 0)
		return NULL;
	pm_tile_order_free(&o->order);
	pm_axes_free(o->axes);
	free(o);
	return NULL;
}

struct pm_order_cache *pm_order_cache_hold(struct pm_order_cache *o)
{
	o->holders++;
	return o;
}

static void free_note(struct pm_note *note) { pm_order_cache_free((struct pm_order_cache *)note); }

struct pm_order_cache *pm_order_cache_new(const struct pm_transfer *t, const unsigned char staggered[3], size_t n, const struct pm_column x[], int nvalues,
	const struct pm_column values[], int room, bool assume)
{
	struct pm_order_cache *o = calloc(1, sizeof *o);
	if (!o) {
		pm_no_memory();
		return NULL;
	}
	o->note.free = free_note;
	o->grid = t->grid;
	o->width = t->kernel->width;
	o->rim = t->rim;
	o->cut = t->cut;
	memcpy(o->given, t->given, sizeof o->given);
	o->n = n;
	memcpy(o->staggered, staggered, sizeof o->staggered);
	for (int d = 0; d < t->grid.dim; d++)
		o->x[d] = x[d];
	const struct pm_tile_particles particles = {.dim = t->grid.dim, .nvalues = nvalues, .n = n, .x = x, .values = values,
		.stays = t->planes && t->planes->divided ? 0 : t->cut ? PM_STAY_WIDE : PM_STAY_FEW, /* ranks send records */
		.finite = t->kept, .assume = assume}; /* positions of a frame */
	if (pm_axes_init(o->axes, t, staggered) || pm_tile_order_init(&o->order, o->axes, &particles, room, &o->strays))
		return pm_order_cache_free(o);
	return o;
}

static bool same_grid(const struct pm_grid *a, const struct pm_grid *b)
{
	bool same = a->dim == b->dim;
	for (int d = 0; d < a->dim && same; d++)
		same = a->cells[d] == b->cells[d] && a->lo[d] == b->lo[d] && a->h[d] == b->h[d] && a->face[d][0] == b->face[d][0] &&
			a->face[d][1] == b->face[d][1];
	return same;
}

struct pm_order_cache *pm_order_cache_find(const struct pm_transfer *t, const unsigned char staggered[3], size_t n, const struct pm_column x[])
{
	if (!t->kept || !*t->kept || (*t->kept)->free != free_note)
		return NULL;
	struct pm_order_cache *o = (struct pm_order_cache *)*t->kept;
	bool same = o->n == n && o->width == t->kernel->width && o->rim == t->rim && o->cut == t->cut && !memcmp(o->given, t->given, sizeof o->given) &&
		!memcmp(o->staggered, staggered, sizeof o->staggered) &&
		same_grid(&o->grid, &t->grid);
	for (int d = 0; d < t->grid.dim && same; d++)
		same = o->x[d].doubles == x[d].doubles && o->x[d].floats == x[d].floats && (x[d].doubles || x[d].floats);
	return same ? o : NULL;
}

void pm_order_cache_leave(const struct pm_transfer *t, struct pm_order_cache *o)
{
	if (!t->kept || !o) {
		pm_order_cache_free(o);
		return;
	}
	if (*t->kept && *t->kept != &o->note)
		(*t->kept)->free(*t->kept);
	*t->kept = &o->note;
}
