/* The hierarchy of single numbers as the one of double numbers uses it. SPDX-License-Identifier: GPL-3.0-or-later */
#define MG_SINGLE
#include "poisson-mg/mg-ranks.h"
#include "poisson-mg/mg-single.h"

#include <float.h>
#include <string.h>

struct pm_mg_single *pm_mg_single_new(const struct pm_grid *g, uint64_t *from)
{
	const struct pm_planes planes = {.divided = from, .from = from};
	struct pm_mg *m = pm_zalloc(1, sizeof *m);
	if (m && !pm_mg_build(m, g, 2, &planes))
		m = pm_mg_single_free(m);
	return m;
}

struct pm_mg_single *pm_mg_single_free(struct pm_mg_single *m)
{
	if (m)
		pm_mg_demolish(m);
	return pm_free(m);
}

void pm_mg_single_source(struct pm_mg_single *m, size_t j, size_t k, float *half[2])
{
	const struct mg_level *l = &m->level[0];
	half[0] = l->f + mg_plane(l, k) + j * l->stride;
	half[1] = half[0] + l->half;
}

void pm_mg_single_solution(const struct pm_mg_single *m, size_t j, size_t k, const float *half[2])
{
	const struct mg_level *l = &m->level[0];
	half[0] = l->u + mg_plane(l, k) + j * l->stride;
	half[1] = half[0] + l->half;
}

void pm_mg_single_start(struct pm_mg_single *m, const struct pm_mg_choice *o, bool full, int status)
{
	m->status = status;
	m->level[0].beside = false;
	if (full)
		pm_mg_start_sources(m), pm_mg_start_full(m, o);
}

int pm_mg_single_status(const struct pm_mg_single *m) { return m->status; }
double pm_mg_single_down(struct pm_mg_single *m, const struct pm_mg_choice *o, bool zero) { return sqrt(pm_mg_cycle_down(m, 0, o, zero)); }
void pm_mg_single_up(struct pm_mg_single *m, const struct pm_mg_choice *o) { pm_mg_cycle_up(m, 0, o); }

double pm_mg_single_noise(struct pm_mg_single *m)
{
	const struct mg_level *l = &m->level[0];
	return FLT_EPSILON * l->diagonal * sqrt(pm_mg_squares(m, l->u));
}
