/* Puts a multigrid hierarchy together: its grids (mg-level.c), the weights of the differences on each (mg-compact.c), the tables that start full multigrid
 * (mg-full.c), and the workspace. SPDX-License-Identifier: GPL-3.0-or-later */
#include "poisson-mg/mg-hierarchy.h"

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

bool pm_mg_build(struct pm_mg *mg, const struct pm_grid *g, int order)
{
	struct mg_level *l = &mg->level[0];
	mg->grid = *g;
	mg->order = order;
	if (!pm_mg_level_finest(l, g, order))
		return false;
	pm_mg_compact_init(l);
	bool more = true;
	for (mg->levels = 1; mg->levels < mg_levels_most; mg->levels++, l++) {
		if (!coarser(l, l + 1, &more))
			return false;
		if (!more)
			break;
	}
	mg->threads = pm_threads();
	mg->room = 4 * (mg->level[0].stride + 4 * mg_lanes);
	mg->scratch = pm_zalloc(mg->room * (size_t)mg->threads, sizeof(double));
	mg->sums = pm_zalloc(mg->level[0].axis[2].points, sizeof(double));
	return mg->scratch && mg->sums;
}

bool pm_mg_room(struct pm_mg *mg, const struct pm_mg_choice *o)
{
	for (int i = 0; i < mg->levels && o->smoother == PM_MG_JACOBI; i++)
		if (!mg->level[i].v && !(mg->level[i].v = pm_zalloc(mg_size(&mg->level[i]), sizeof(double))))
			return false;
	return true;
}

void pm_mg_demolish(struct pm_mg *mg)
{
	for (int i = 0; i < mg_levels_most; i++)
		pm_mg_level_free(&mg->level[i]);
	pm_free(mg->scratch), pm_free(mg->sums);
}
