/* Exact boundary values of free space: phi(x) = c sum_k q_k G(x - x_k) on the nodes of the faces, lap G = delta function (ln r/(2 pi) in 2-D, -1/(4 pi r) in
 * 3-D, |x|/2 in 1-D), over all particles that make the density, also those beyond the mesh. The values act on nothing inside but stand for the space outside: a
 * lone particle stays at rest, as between walls with phi = 0 it would not. Source: Hockney and Eastwood 1988, section 6-5-4. Cost: particles and face nodes
 * times face nodes. SPDX-License-Identifier: GPL-3.0-or-later */
#include <string.h>

#include "far/pp.h"
#include "poisson/boundary-sum.h"
#include "stream/all-values.h"
#include "stream/declare.h"
#include "world/world.h"

static bool source(const struct pm_frame *f, const struct pm_set *s, const struct pm_law *law, const struct pm_field *density)
{
	const struct pm_field *q = pm_frame_field(f, s->name, law->strength), *x = pm_frame_field(f, s->name, "x");
	bool named = density->nterms == 0;
	for (int t = 0; t < density->nterms; t++)
		named |= !strcmp(density->terms[t], s->name);
	return named && q && x && q->extensive && q->components == density->components;
}

int pm_boundary_sum_declare(struct pm_frame *f, const struct pm_law *law, const struct pm_field *density)
{
	bool any = false;
	for (size_t i = 0; i < f->nsets; i++)
		if (source(f, f->sets[i], law, density)) {
			any = true;
			if (!pm_reads(f, f->sets[i]->name, "x") || !pm_reads(f, f->sets[i]->name, law->strength))
				return -PM_DATA;
		}
	return any ? 0 : pm_fail(PM_DATA, "--open-faces sum is over particles, and no set that made '%s' has %s here (leave it out)", density->name,
		law->strength);
}

struct bodies {
	size_t targets, n;
	double *x[3], *q, *gradient[3], *phi;
};

static void bodies_free(struct bodies *b)
{
	for (int d = 0; d < 3; d++)
		pm_free(b->x[d]), pm_free(b->gradient[d]);
	pm_free(b->q), pm_free(b->phi);
}

static int room(const struct pm_frame *f, const struct pm_law *law, const struct pm_field *density, const struct pm_grid *g, struct bodies *b)
{
	*b = (struct bodies){0};
	for (int d = 0; d < g->dim; d++)
		b->targets += 2 * pm_boundary_points(g, d);
	b->n = b->targets;
	for (size_t i = 0; i < f->nsets; i++)
		b->n += source(f, f->sets[i], law, density) ? f->sets[i]->n : 0;
	bool good = (b->q = pm_zalloc(b->n, sizeof(double))) && (b->phi = pm_alloc(b->n, sizeof(double)));
	for (int d = 0; d < g->dim; d++)
		good = good && (b->x[d] = pm_alloc(b->n, sizeof(double))) && (b->gradient[d] = pm_alloc(b->n, sizeof(double)));
	return good ? 0 : -PM_DATA;
}

static int fill(int status, const struct pm_frame *f, const struct pm_law *law, const struct pm_field *density, int c, const struct pm_grid *g,
	struct bodies *b)
{
	size_t at = 0;
	for (int a = 0; a < 2 * g->dim && !status; a++) {
		const int d = a / 2, t[2] = {d == 0, d == 2 ? 1 : 2};
		for (size_t i = 0; i < pm_boundary_points(g, d); i++, at++) {
			size_t p[3] = {0, 0, 0};
			p[t[0]] = i % g->points[t[0]], p[t[1]] = i / g->points[t[0]], p[d] = a % 2 ? g->points[d] - 1 : 0;
			for (int e = 0; e < g->dim; e++)
				b->x[e][at] = g->lo[e] + (double)p[e] * g->h[e];
		}
	}
	for (size_t i = 0; i < f->nsets; i++) {
		const struct pm_set *s = f->sets[i];
		if (!source(f, s, law, density))
			continue;
		const struct pm_field *x = pm_frame_field(f, s->name, "x"), *q = pm_frame_field(f, s->name, law->strength);
		status = pm_all_values(status, q, pm_in(q, c), status ? NULL : b->q + at);
		for (int e = 0; e < g->dim; e++)
			status = pm_all_values(status, x, pm_in(x, e), status ? NULL : b->x[e] + at);
		at += s->n;
	}
	return status;
}

/* The nodes of faces are shared by the ranks in groups of 256; then all get all values. */
static int sum(int status, const struct pm_grid *g, bool divided, struct bodies *all)
{
	enum { group = 256 };
	const size_t groups = (all->targets + group - 1) / group, ranks = divided ? (size_t)pm_world_size() : 1;
	const size_t me = divided ? (size_t)pm_world_rank() : 0;
	size_t own[2] = {groups * me / ranks * group, groups * (me + 1) / ranks * group}, bytes = 0;
	own[1] = me + 1 == ranks ? all->targets : own[1];
	const struct pm_pp pp = {.dim = g->dim, .mollifier = pm_mollifier_find("none"), .sets = 1, .count = &all->n, .own = own};
	uint64_t coincident = 0;
	void *phi = NULL;
	if (!status)
		status = pm_pp_sum(&pp, all->targets, all->n, (const double *const *)all->x, all->q, all->gradient, all->phi, &coincident);
	if (!divided)
		return status;
	status = pm_world_gather(status, all->phi + own[0], (own[1] - own[0]) * sizeof(double), &phi, &bytes);
	if (phi)
		memcpy(all->phi, phi, bytes);
	pm_free(phi);
	return pm_world_share(status, 0, all->phi, all->targets * sizeof(double));
}

int pm_boundary_sum(const struct pm_frame *f, const struct pm_law *law, const struct pm_field *density, int c, double coefficient, struct pm_boundary *b)
{
	const struct pm_grid *g = &b->grid;
	struct bodies all;
	int status = room(f, law, density, g, &all);
	status = fill(status, f, law, density, c, g, &all);
	status = sum(status, g, density->here, &all);
	size_t at = 0;
	for (int a = 0; a < 2 * g->dim && !status; a++) {
		status = pm_boundary_room(b, a / 2, a % 2);
		for (size_t i = 0; i < pm_boundary_points(g, a / 2) && !status; i++, at++)
			b->value[a / 2][a % 2][i] = coefficient * all.phi[at];
	}
	bodies_free(&all);
	return pm_world_agree(status);
}
