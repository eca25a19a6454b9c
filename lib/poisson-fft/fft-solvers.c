/* A few solvers by transforms kept ready for the grids of a stream. SPDX-License-Identifier: GPL-3.0-or-later */
#include <string.h>

#include "poisson-fft/fft-passes.h"
#include "poisson-fft/fft-solvers.h"
#include "world/world.h"

static bool same_grid(const struct pm_grid *a, const struct pm_grid *b)
{
	return a->dim == b->dim && !memcmp(a->points, b->points, sizeof a->points) && !memcmp(a->cells, b->cells, sizeof a->cells) &&
		!memcmp(a->h, b->h, sizeof a->h) && !memcmp(a->face, b->face, sizeof a->face);
}

struct pm_poisson_fft *pm_fft_solvers_find(const struct pm_fft_solvers *s, const struct pm_grid *g, const struct pm_poisson_fft_choice *o)
{
	const struct pm_fft_made *m = s->made;
	for (; m < s->made + s->n; m++)
		if (o->symbol == m->symbol && o->fitted == m->fitted && o->softening == m->softening && pm_influence_same(&o->influence, &m->influence) &&
			same_grid(g, &m->grid) && pm_poisson_fft_same_ranks(m->solver, o->planes))
			break;
	double lacks = m == s->made + s->n;
	if (o->planes && o->planes->divided && pm_world_largest(0, 1, &lacks))
		return NULL;
	return lacks > 0 ? NULL : m->solver;
}

struct pm_poisson_fft *pm_fft_solvers_add(struct pm_fft_solvers *s, const struct pm_grid *g, const struct pm_poisson_fft_choice *o, bool alone)
{
	if (s->n == PM_FFT_SOLVERS || alone)
		pm_fft_solvers_clear(s);
	struct pm_poisson_fft *solver = pm_poisson_fft_new(g, o);
	if (solver)
		s->made[s->n++] = (struct pm_fft_made){.solver = solver, .grid = *g, .symbol = o->symbol, .fitted = o->fitted, .softening = o->softening,
			.influence = o->influence};
	return solver;
}

void pm_fft_solvers_clear(struct pm_fft_solvers *s)
{
	while (s->n)
		pm_poisson_fft_free(s->made[--s->n].solver);
}
