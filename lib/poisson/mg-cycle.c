/* The cycles of multigrid over a hierarchy of grids.
 *   V(nu1, nu2): relax nu1 times; solve for the restricted residual on the coarser grid by the same cycle from zero; add; relax nu2 times
 * W: the coarser grid is visited twice. Full multigrid: the right-hand side on every grid, solved from the coarsest up, cubic interpolation and one
 * cycle on each (Brandt 1977; Trottenberg, Oosterlee, Schueller 2001, sections 2.4 and 2.6).
 * SPDX-License-Identifier: GPL-3.0-or-later */
#include "poisson/mg-level.h"

size_t pm_mg_unknowns(const struct mg_level *l)
{
	size_t n = 1;
	for (int d = 0; d < 3; d++)
		n *= l->axis[d].end - l->axis[d].first;
	return n;
}

/* n sweeps behind the stage `first`; MG_RED stands for no such stage. */
static void smooth(struct pm_mg *mg, int at, double relaxation, enum mg_stage first, int n)
{
	enum mg_stage stages[mg_stages_most];
	int m = 0;
	if (first != MG_RED)
		stages[m++] = first;
	for (int i = 0; i < n; i++) {
		stages[m++] = MG_RED;
		stages[m++] = MG_BLACK;
	}
	if (m)
		pm_mg_sweep(mg, at, relaxation, m, stages);
}

/* One unknown, or none, or a constant that may be anything. */
void pm_mg_solve_coarsest(struct pm_mg *mg)
{
	int at = mg->levels - 1;
	bool any = mg->level[at].fixed && pm_mg_unknowns(&mg->level[at]);
	smooth(mg, at, 1, MG_ZERO, any);
}

/* The first half of a cycle: relax and restrict the residual; returns its sum of squares on the finest grid. */
double pm_mg_cycle_down(struct pm_mg *mg, int at, const struct pm_mg_choice *o, bool zero)
{
	smooth(mg, at, o->relaxation, zero ? MG_ZERO : MG_RED, o->pre);
	return pm_mg_restrict(mg, at);
}

/* The second: solve on the coarser grids, correct and relax. */
void pm_mg_cycle_up(struct pm_mg *mg, int at, const struct pm_mg_choice *o)
{
	if (at + 2 == mg->levels)
		pm_mg_solve_coarsest(mg);
	else
		for (int i = 0; i < (o->cycle == PM_MG_W ? 2 : 1); i++) {
			pm_mg_cycle_down(mg, at + 1, o, i == 0);
			pm_mg_cycle_up(mg, at + 1, o);
		}
	smooth(mg, at, o->relaxation, MG_CORRECT, o->post);
}

/* From the coarsest grid up, one cycle on each but the finest. */
void pm_mg_start_full(struct pm_mg *mg, const struct pm_mg_choice *o)
{
	for (int at = 0; at + 1 < mg->levels; at++)
		pm_mg_restrict_source(mg, at);
	pm_mg_solve_coarsest(mg);
	for (int at = mg->levels - 2; at >= 0; at--) {
		smooth(mg, at, o->relaxation, MG_INTERPOLATE, 0);
		if (at) {
			pm_mg_cycle_down(mg, at, o, false);
			pm_mg_cycle_up(mg, at, o);
		}
	}
}
