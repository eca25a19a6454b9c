/* Sweeps over a grid, several stages (correction from the coarse grid, red, black, red, ...) in one pass over memory.
 * Stage s of plane k needs stage s-1 done on planes k-1, k, k+1 and stage s+1 not yet, so stage s runs s planes behind stage 0 (a wavefront). Threads
 * take slabs that narrow by one plane per stage at each cut, and after a barrier the wedges left at the cuts (split tiling, as in
 * Wellein et al. 2009). Every plane goes through the same stages with the same neighbours whatever the cuts, so the bytes do not depend on threads.
 * The seam of a periodic axis is a cut at which plane 0 comes after plane n-1 in every stage. SPDX-License-Identifier: GPL-3.0-or-later */
#include "poisson-mg/mg-ranks.h"

#include <omp.h>
#include <string.h>

struct sweep {
	struct pm_mg *mg;
	struct mg_level *level;
	double relaxation;
	int n;
	const enum mg_stage *stages;
};

static void stage_plane(const struct sweep *s, int stage, size_t k, mg_number *w)
{
	struct mg_level *l = s->level;
	switch (s->stages[stage]) {
	case MG_ZERO:
		memset(l->u + mg_plane(l, k), 0, l->axis[1].points * l->stride * sizeof *l->u);
		break;
	case MG_CORRECT:
		pm_mg_correct_plane(l, l + 1, k, w);
		break;
	case MG_INTERPOLATE:
		pm_mg_interpolate_plane(l, l + 1, k, w);
		break;
	case MG_RED:
	case MG_BLACK:
		pm_mg_relax_plane(l, s->relaxation, s->stages[stage] == MG_BLACK, k);
		break;
	case MG_JACOBI:
		pm_mg_jacobi_plane(l, s->relaxation, k, w);
		break;
	case MG_KEEP:
		pm_mg_keep_plane(l, k);
		break;
	default:
		pm_mg_colour_plane(l, s->relaxation, (int)(s->stages[stage] - MG_COLOUR), k, w);
	}
}

/* Stage by stage: small grids. */
static void sweep_plain(const struct sweep *s, mg_number *w)
{
	const struct mg_axis *z = &s->level->axis[2];
	for (int stage = 0; stage < s->n; stage++) {
		for (size_t k = z->periodic ? 1 : z->first; k < z->end; k++)
			stage_plane(s, stage, k, w);
		if (z->periodic)
			stage_plane(s, stage, 0, w);
	}
}

/* Planes from <= k < to, stage s keeping s + seam planes away from a low cut and s from a high one. */
static void sweep_slab(const struct sweep *s, const ptrdiff_t range[2], const bool cut[2], bool seam, mg_number *w)
{
	for (ptrdiff_t front = range[0]; front < range[1] + s->n; front++)
		for (int stage = 0; stage < s->n; stage++) {
			ptrdiff_t k = front - stage;
			if (k >= range[0] + (cut[0] ? stage + seam : 0) && k < range[1] - (cut[1] ? stage : 0))
				stage_plane(s, stage, (size_t)k, w);
		}
}

/* The wedge left at a cut. */
static void sweep_wedge(const struct sweep *s, ptrdiff_t cut, bool seam, mg_number *w)
{
	ptrdiff_t n = (ptrdiff_t)s->level->axis[2].points;
	for (int stage = 0; stage < s->n; stage++)
		for (ptrdiff_t k = cut - stage; k < cut + stage + seam; k++)
			stage_plane(s, stage, (size_t)(k < n ? k : k - n), w);
}

static void sweep_tiled(const struct sweep *s, int parts)
{
	const struct mg_axis *z = &s->level->axis[2];
	ptrdiff_t first = (ptrdiff_t)z->first, n = (ptrdiff_t)(z->end - z->first);
	struct pm_mg *mg = s->mg;
	#pragma omp parallel num_threads(parts) if (parts > 1)
	{
		#pragma omp for schedule(static, 1)
		for (int p = 0; p < parts; p++) {
			ptrdiff_t range[2] = {first + n * p / parts, first + n * (p + 1) / parts};
			bool cut[2] = {p || z->periodic, p + 1 < parts || z->periodic};
			sweep_slab(s, range, cut, !p && z->periodic, mg->scratch + (size_t)p * mg->room);
		}
		#pragma omp for schedule(static, 1)
		for (int p = 1; p <= parts; p++)
			if (p < parts || z->periodic)
				sweep_wedge(s, first + n * p / parts, p == parts, mg->scratch + (size_t)(p - 1) * mg->room);
	}
}

/* Stage by stage on the planes of this rank. Neighbouring planes wait for each other, so that threads take every second one. */
static void sweep_here(const struct sweep *s)
{
	struct mg_level *l = s->level;
	struct pm_mg *mg = s->mg;
	const struct mg_axis *z = &l->axis[2];
	const bool chain = z->periodic && z->points % 2; /* plane 0 comes after plane n-1 */
	size_t range[2];
	mg_range(l, range);
	for (int stage = 0; stage < s->n; stage++) {
		const enum mg_stage what = s->stages[stage];
		const bool corrects = what == MG_CORRECT || what == MG_INTERPOLATE, sweeps = what == MG_RED || what == MG_BLACK || what >= MG_COLOUR;
		if (corrects)
			pm_mg_beside(mg, l + 1, l[1].u, what == MG_CORRECT ? 1 : mg_beyond);
		else if (sweeps || what == MG_JACOBI)
			pm_mg_beside(mg, l, l->u, 1);
		const size_t from = sweeps && chain && range[0] == 0 ? 1 : range[0];
		for (size_t odd = 0; odd < 2; odd++) {
			#pragma omp parallel for num_threads(mg->threads) schedule(static) if (l->here * l->plane > mg_parallel)
			for (size_t k = from + odd; k < range[1]; k += 2)
				stage_plane(s, stage, k, mg->scratch + (size_t)omp_get_thread_num() * mg->room);
		}
		if (sweeps && chain)
			pm_mg_beside(mg, l, l->u, 1);
		if (sweeps && chain && range[0] == 0 && range[1])
			stage_plane(s, stage, 0, mg->scratch);
	}
}

void pm_mg_sweep(struct pm_mg *mg, int level, double relaxation, int n, const enum mg_stage *stages)
{
	struct sweep s = {.mg = mg, .level = &mg->level[level], .relaxation = relaxation, .n = n, .stages = stages};
	const struct mg_axis *z = &s.level->axis[2];
	if (s.level->from) {
		sweep_here(&s);
		return;
	}
	int most = (int)((z->end - z->first) / (size_t)(2 * n + 2));
	int parts = mg_size(s.level) < mg_parallel ? 1 : mg->threads < most ? mg->threads : most;
	if (parts < 1 || (parts == 1 && mg_size(s.level) < mg_parallel))
		sweep_plain(&s, mg->scratch);
	else
		sweep_tiled(&s, parts);
}
