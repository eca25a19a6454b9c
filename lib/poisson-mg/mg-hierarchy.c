/* Puts a multigrid hierarchy together: its grids (mg-level.c), the weights of the differences on each (mg-compact.c), the tables that start full multigrid
 * (mg-full.c), and the workspace. SPDX-License-Identifier: GPL-3.0-or-later */
#include "poisson-mg/mg-hierarchy.h"
#include "world/world.h"

static bool coarser(struct mg_level *fine, struct mg_level *coarse, bool *more)
{
	if (!pm_mg_level_coarser(fine, coarse, more))
		return false;
	for (int d = 0; d < 3 && *more; d++)
		if (!pm_mg_full_tables(&fine->axis[d], &coarse->axis[d], &fine->map[d]))
			return false;
	if (*more)
		pm_mg_compact_init(coarse);
	return true;
}

/* Fewer planes than two a rank are not worth sending those beside them. */
static bool worth(const struct mg_level *l) { return !l->from || l->axis[2].points >= 2 * (size_t)pm_world_size(); }

/* From the finest grid, which is there, to the coarsest or the last in planes; and the workspace. */
static bool build_down(struct pm_mg *mg)
{
	struct mg_level *l = &mg->level[0];
	pm_mg_compact_init(l);
	bool more = true;
	for (mg->levels = 1; mg->levels < mg_levels_most && (mg->levels == 1 || worth(l)); mg->levels++, l++) {
		if (!coarser(l, l + 1, &more))
			return false;
		if (!more)
			break;
	}
	mg->threads = pm_threads();
	mg->room = 4 * (mg->level[0].stride + 4 * mg_lanes);
	mg->scratch = pm_zalloc(mg->room * (size_t)mg->threads, sizeof *mg->scratch);
	mg->sums = pm_zalloc(mg->level[0].axis[2].points, sizeof(double));
	return mg->scratch && mg->sums;
}

bool pm_mg_build(struct pm_mg *mg, const struct pm_grid *g, int order, const struct pm_planes *planes)
{
	mg->grid = *g;
	mg->order = order;
	if (!pm_mg_level_finest(&mg->level[0], g, order, planes) || !build_down(mg))
		return false;
	if (!mg->level[0].from)
		return true;
	mg->shared = mg->levels > 1 ? mg->levels - 1 : 1;
	if (mg->levels == 1 || pm_world_rank())
		return true;
	mg->whole = pm_zalloc(1, sizeof *mg->whole);
	if (!mg->whole)
		return false;
	mg->whole->order = order;
	return pm_mg_level_whole(&mg->level[mg->shared], &mg->whole->level[0]) && build_down(mg->whole);
}

bool pm_mg_room(struct pm_mg *mg, const struct pm_mg_choice *o)
{
	for (int i = 0; i < mg->levels && o->smoother == PM_MG_JACOBI; i++)
		if (!mg->level[i].v && !(mg->level[i].v = pm_zalloc(mg_held(&mg->level[i]), sizeof(mg_number))))
			return false;
	return !mg->whole || pm_mg_room(mg->whole, o);
}

void pm_mg_demolish(struct pm_mg *mg)
{
	for (int i = 0; i < mg_levels_most; i++)
		pm_mg_level_free(&mg->level[i]);
	pm_free(mg->scratch), pm_free(mg->sums);
	if (mg->whole)
		pm_mg_demolish(mg->whole);
	pm_free(mg->whole);
}
