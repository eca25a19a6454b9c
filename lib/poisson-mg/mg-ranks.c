/* Multigrid on several ranks: grids of many planes are divided, each rank having a stretch of planes and mg_beyond of its neighbours'; from the first grid on
 * that has fewer than two planes a rank, all is on rank 0. A coarse plane belongs to who holds the fine plane at or below it. Bytes are those of a run
 * alone: every stage of a sweep has the planes beside it as they were before the stage, the seam of a periodic axis with an odd number of planes is a
 * chain as in mg-sweep.c, and sums go by planes. What travels: docs/distributed.md.
 * SPDX-License-Identifier: GPL-3.0-or-later */
#include "poisson-mg/mg-ranks.h"
#include "world/world.h"

void pm_mg_beside_own(struct pm_mg *mg, const struct mg_level *l, void *own, size_t bytes, int wide)
{
	const struct pm_halo halo = {.from = l->from, .bytes = bytes, .wide = wide, .periodic = l->axis[2].periodic, .empty = true};
	if (l->from)
		mg->status = pm_world_halo(mg->status, &halo, own);
}

void pm_mg_beside(struct pm_mg *mg, const struct mg_level *l, mg_number *values, int wide)
{
	pm_mg_beside_own(mg, l, values + mg_own(l), l->plane * sizeof *values, wide);
}

double pm_mg_total(struct pm_mg *mg, size_t from, size_t to)
{
	const struct mg_level *l = &mg->level[0];
	const size_t low = from > l->first ? from : l->first, high = to < l->first + l->here ? to : l->first + l->here;
	void *all = NULL;
	size_t bytes = 0;
	double total = 0;
	if (!l->from)
		return pm_mg_planes(to - from, mg->sums + from);
	mg->status = pm_world_gather(mg->status, mg->sums + (low < high ? low : 0), low < high ? (high - low) * sizeof *mg->sums : 0, &all, &bytes);
	if (all)
		total = pm_mg_planes(bytes / sizeof *mg->sums, all);
	pm_free(all);
	mg->status = pm_world_share(mg->status, 0, &total, sizeof total);
	return total;
}

double pm_mg_most(struct pm_mg *mg, double here)
{
	if (mg->level[0].from)
		mg->status = pm_world_largest(mg->status, 1, &here);
	return here;
}

/* Planes of the grid `shared` to the whole one on rank 0, or back. */
static void move(struct pm_mg *mg, bool back, mg_number *part, mg_number *whole)
{
	const struct mg_level *l = &mg->level[mg->shared];
	const size_t ranks = (size_t)pm_world_size(), bytes = l->plane * sizeof *part;
	uint64_t *first = pm_alloc(ranks + 1, sizeof *first);
	for (size_t r = 0; r <= ranks && first; r++)
		first[r] = r ? l->axis[2].points : 0;
	mg->status = pm_world_agree(mg->status ? mg->status : first ? 0 : pm_failed());
	mg_number *own = part + mg_own(l);
	if (!mg->status)
		mg->status = pm_world_recut(0, back ? first : l->from, back ? l->from : first, bytes, back ? whole : own, back ? own : whole);
	pm_free(first);
}

void pm_mg_hand_over(struct pm_mg *mg) { move(mg, false, mg->level[mg->shared].f, mg->whole ? mg->whole->level[0].f : NULL); }
void pm_mg_take_back(struct pm_mg *mg) { move(mg, true, mg->level[mg->shared].u, mg->whole ? mg->whole->level[0].u : NULL); }

void pm_mg_whole_cycles(struct pm_mg *mg, const struct pm_mg_choice *o)
{
	struct pm_mg *whole = mg->whole;
	pm_mg_hand_over(mg);
	if (whole && whole->levels == 1)
		pm_mg_solve_coarsest(whole);
	for (int i = 0; whole && whole->levels > 1 && i < (o->cycle == PM_MG_W ? 2 : 1); i++) {
		pm_mg_cycle_down(whole, 0, o, i == 0);
		pm_mg_cycle_up(whole, 0, o);
	}
	pm_mg_take_back(mg);
}

void pm_mg_whole_pyramid(struct pm_mg *mg, double factor, const double *s)
{
	const struct mg_level *l = &mg->level[mg->shared];
	const size_t ranks = (size_t)pm_world_size(), plane = l->axis[0].points * l->axis[1].points;
	uint64_t *first = pm_zalloc(ranks + 1, sizeof *first);
	double *all = mg->whole ? pm_alloc(plane * l->axis[2].points, sizeof *all) : NULL;
	for (size_t r = 1; r <= ranks && first; r++)
		first[r] = l->axis[2].points;
	mg->status = pm_world_agree(mg->status ? mg->status : first && (all || !mg->whole) ? 0 : pm_failed());
	if (!mg->status)
		mg->status = pm_world_recut(0, l->from, first, plane * sizeof *s, s, all);
	pm_mg_hand_over(mg);
	if (all && !mg->status && !pm_mg_pyramid(mg->whole, factor, all))
		mg->status = pm_failed();
	mg->status = pm_world_agree(mg->status);
	pm_free(first), pm_free(all);
}
