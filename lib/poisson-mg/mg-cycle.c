/* The cycles of multigrid over a hierarchy of grids.
 *   V(nu1, nu2): relax nu1 times; solve for the restricted residual on the coarser grid by the same cycle from zero; add; relax nu2 times
 * W: the coarser grid is visited twice. Full multigrid: the right-hand side on every grid, solved from the coarsest up, cubic interpolation and one
 * cycle on each (Brandt 1977; Trottenberg, Oosterlee, Schueller 2001, sections 2.4 and 2.6).
 * SPDX-License-Identifier: GPL-3.0-or-later */
#include "poisson-mg/mg-ranks.h"

size_t pm_mg_unknowns(const struct mg_level *l)
{
	size_t n = 1;
	for (int d = 0; d < 3; d++)
		n *= l->axis[d].end - l->axis[d].first;
	return n;
}

double pm_mg_squares(struct pm_mg *mg, const mg_number *values)
{
	const struct mg_level *l = &mg->level[0];
	const struct mg_axis *y = &l->axis[1], *z = &l->axis[2];
	size_t range[2];
	mg_range(l, range);
	#pragma omp parallel for num_threads(mg->threads) if (mg_held(l) > mg_parallel)
	for (size_t k = range[0]; k < range[1]; k++) {
		struct pm_sum plane = {0, 0};
		for (size_t j = y->first; j < y->end; j++)
			for (int odd = 0; odd < 2; odd++) {
				const mg_number *v = values + mg_plane(l, k) + j * l->stride + (size_t)odd * l->half;
				const mg_mask *mask = l->mask[odd];
				double lane[8] = {0};
				for (size_t i = 0; i + 8 <= l->half; i += 8)
					for (size_t q = 0; q < 8; q++)
						lane[q] += mask[i + q] ? (double)v[i + q] * (double)v[i + q] : 0;
				pm_sum_add(&plane, ((lane[0] + lane[4]) + (lane[1] + lane[5])) + ((lane[2] + lane[6]) + (lane[3] + lane[7])));
			}
		mg->sums[k] = pm_sum_total(plane);
	}
	return pm_mg_total(mg, z->first, z->end);
}

/* n sweeps behind the stage `first`; MG_RED stands for no such stage. */
static void smooth(struct pm_mg *mg, int at, const struct pm_mg_choice *o, enum mg_stage first, int n)
{
	static const struct {
		int n;
		enum mg_stage stage[4];
	} sweep[] = {[PM_MG_RED_BLACK] = {2, {MG_RED, MG_BLACK}}, [PM_MG_SOR] = {2, {MG_RED, MG_BLACK}}, [PM_MG_JACOBI] = {2, {MG_JACOBI, MG_KEEP}},
		[PM_MG_FOUR_COLOUR] = {4, {MG_COLOUR, MG_COLOUR + 3, MG_COLOUR + 1, MG_COLOUR + 2}}};
	enum mg_stage stages[mg_stages_most];
	int m = 0;
	if (first != MG_RED)
		stages[m++] = first;
	for (int i = 0; i < n; i++)
		for (int c = 0; c < sweep[o->smoother].n; c++)
			stages[m++] = sweep[o->smoother].stage[c];
	if (m)
		pm_mg_sweep(mg, at, o->relaxation, m, stages);
}

/* One unknown, or none, or a constant that may be anything. */
void pm_mg_solve_coarsest(struct pm_mg *mg)
{
	int at = mg->levels - 1;
	bool any = mg->level[at].fixed && pm_mg_unknowns(&mg->level[at]);
	smooth(mg, at, &(struct pm_mg_choice){.relaxation = 1, .smoother = mg->order == 4 ? PM_MG_FOUR_COLOUR : PM_MG_RED_BLACK}, MG_ZERO, any);
}

/* The first half of a cycle: relax and restrict the residual; returns its sum of squares on the finest grid. */
double pm_mg_cycle_down(struct pm_mg *mg, int at, const struct pm_mg_choice *o, bool zero)
{
	smooth(mg, at, o, zero ? MG_ZERO : MG_RED, o->pre);
	return pm_mg_restrict(mg, at, o->half_weighting);
}

/* The second: solve on the coarser grids, correct and relax. */
void pm_mg_cycle_up(struct pm_mg *mg, int at, const struct pm_mg_choice *o)
{
	if (at + 1 == mg->shared)
		pm_mg_whole_cycles(mg, o);
	else if (at + 2 == mg->levels)
		pm_mg_solve_coarsest(mg);
	else
		for (int i = 0; i < (o->cycle == PM_MG_W ? 2 : 1); i++) {
			pm_mg_cycle_down(mg, at + 1, o, i == 0);
			pm_mg_cycle_up(mg, at + 1, o);
		}
	smooth(mg, at, o, MG_CORRECT, o->post);
}

void pm_mg_start_sources(struct pm_mg *mg)
{
	for (int at = 0; at + 1 < mg->levels; at++)
		pm_mg_restrict_source(mg, at);
	if (mg->shared)
		pm_mg_hand_over(mg);
	if (mg->whole)
		pm_mg_start_sources(mg->whole);
}

/* From the coarsest grid up, one cycle on each but the finest. */
void pm_mg_start_full(struct pm_mg *mg, const struct pm_mg_choice *o)
{
	if (!mg->shared)
		pm_mg_solve_coarsest(mg);
	if (mg->whole)
		pm_mg_start_full(mg->whole, o);
	if (mg->whole && mg->whole->levels > 1) { /* its finest grid is none of ours */
		pm_mg_cycle_down(mg->whole, 0, o, false);
		pm_mg_cycle_up(mg->whole, 0, o);
	}
	if (mg->shared)
		pm_mg_take_back(mg);
	for (int at = mg->levels - 2; at >= 0; at--) {
		smooth(mg, at, o, MG_INTERPOLATE, 0);
		if (at) {
			pm_mg_cycle_down(mg, at, o, false);
			pm_mg_cycle_up(mg, at, o);
		}
	}
}
