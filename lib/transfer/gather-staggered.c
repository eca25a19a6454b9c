/* Gather of components at several offsets, as those of E and B on Yee's mesh, from one order of the particles: that among the nodes. A point half a cell up is
 * looked for in the particle's own cell of halves and the next (transfer-axis.h), so a tile has one slot more of them; what is gathered for a particle does
 * not depend on the order, so ranks may sort for every offset and get the same bytes (transfer-ranks.c). Cost: one sort, width^dim products a component.
 * SPDX-License-Identifier: GPL-3.0-or-later */
#include <string.h>

#include "transfer/transfer-pass.h"

/* What all passes have in common. */
struct staggered {
	const struct pm_transfer *t;
	struct pm_order_cache *o;
	int threads;
	double *results; /* NULL where the stream is in order, else [n][components], a pass behind the other */
	/* Of the components in the order of the passes. */
	double *to[PM_COMPONENTS];
	const double *times[PM_COMPONENTS];
	bool set[PM_COMPONENTS], finite;
	int done;
};

/* The order among the nodes, as the density left it or made anew, with its records. */
static int find_order(struct staggered *s, size_t n, const double *const x[])
{
	const unsigned char nodes[3] = {0, 0, 0};
	s->o = pm_order_cache_find(s->t, nodes, n, x);
	if (!s->o)
		s->o = pm_order_cache_new(s->t, nodes, n, x, 0, NULL, 0);
	else if (pm_tile_order_spent(&s->o->order) && pm_tile_order_again(&s->o->order, 0))
		return -PM_DATA;
	if (!s->o)
		return -PM_DATA;
	if (s->o->order.records && !(s->results = pm_alloc(n * (size_t)s->t->components, sizeof *s->results)))
		return -PM_DATA;
	return 0;
}

/* The axes of an offset, with the cells of the nodes'. */
static int axes_of(const struct staggered *s, struct pm_pass *w, struct pm_axis axes[3])
{
	if (pm_axes_init(axes, s->t, s->t->staggered[w->which[0]]))
		return -PM_DATA;
	for (int d = 0; d < 3; d++) {
		w->lift[d] = axes[d].half;
		axes[d].count = s->o->axes[d].count;
	}
	return 0;
}

static int one_pass(struct staggered *s, struct pm_pass *w, const double *const mesh[])
{
	struct pm_axis axes[3] = {{0}};
	const struct pm_tile_results r = {s->times + s->done, s->set + s->done, s->to + s->done};
	w->o = s->o;
	int status = axes_of(s, w, axes);
	if (!status)
		status = pm_tile_pass_init(&w->p, &s->t->grid, &s->o->order, axes);
	const int threads = (size_t)s->threads < w->p.jobs ? s->threads : (int)w->p.jobs + !w->p.jobs;
	if (!status && !(w->blocks = pm_zalloc((size_t)threads * (size_t)w->components * PM_BLOCK_MOST, sizeof *w->blocks)))
		status = -PM_DATA;
	if (!status && PM_TILE_CIC_EIGHT)
		status = pm_pass_vectors(w, threads);
	if (s->results)
		w->results = s->results + s->done, w->to = s->t->components;
	if (!status)
		s->finite &= pm_pass_gather_all(w, threads, mesh, &r);
	w->results = NULL; /* they are of all passes */
	pm_pass_end(w);
	pm_axes_free(axes);
	return status;
}

int pm_gather_staggered(const struct pm_transfer *t, size_t n, const double *const x[], const double *const mesh[], const double *const factor[],
	double *const out[], struct pm_strays *strays)
{
	struct staggered s = {.t = t, .threads = pm_tile_threads(n), .finite = true};
	bool done[PM_COMPONENTS] = {false};
	struct pm_pass w;
	int status = find_order(&s, n, x);
	while (!status && pm_pass_next(t, done, &w)) {
		for (int i = 0; i < w.components; i++) {
			const int c = w.which[i];
			s.to[s.done + i] = out[c];
			s.times[s.done + i] = factor ? factor[c] : NULL;
			s.set[s.done + i] = t->set[c];
		}
		status = one_pass(&s, &w, mesh);
		s.done += w.components;
	}
	if (!status && s.results)
		status = pm_tile_order_return(&s.o->order, s.results, t->components, t->components, s.times, s.set, s.to, &s.finite);
	if (!status) {
		*strays = s.o->strays;
		strays->finite = s.finite;
	}
	pm_free(s.results);
	if (s.o && !(t->kept && *t->kept == &s.o->note))
		pm_order_cache_free(s.o);
	return status;
}
