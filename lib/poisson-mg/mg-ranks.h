/* Multigrid on several ranks (mg-ranks.c). SPDX-License-Identifier: GPL-3.0-or-later */
#ifndef PM_POISSON_MG_MG_RANKS_H
#define PM_POISSON_MG_MG_RANKS_H

#include "poisson-mg/mg-hierarchy.h"
#include "poisson-mg/multigrid.h"

/* pm_mg_new for the planes of a rank; s and phi of pm_mg_solve are then those, and all ranks solve together. */
struct pm_mg *pm_mg_new_planes(const struct pm_grid *g, int order, const struct pm_planes *planes);
bool pm_mg_same_planes(const struct pm_mg *mg, const struct pm_planes *planes);
/* pm_mg_variable_new for the planes of a rank, NULL: all. s and phi are then those, and eps has a plane of the neighbours on either side; all ranks make it
 * and solve together. Each says for itself whether it fits. */
struct pm_mg_variable *pm_mg_variable_new_planes(const struct pm_grid *g, const double *eps, enum pm_mg_mean mean, const struct pm_planes *planes);
bool pm_mg_variable_same_planes(const struct pm_mg_variable *v, const struct pm_planes *planes);

/* Brings the planes of other ranks, if there are any; of values laid out as u and f, and of planes of so many bytes from the first own one on. */
void pm_mg_beside(struct pm_mg *mg, const struct mg_level *l, mg_number *values, int wide);
void pm_mg_beside_own(struct pm_mg *mg, const struct mg_level *l, void *own, size_t bytes, int wide); /* of a plane */
double pm_mg_total(struct pm_mg *mg, size_t from, size_t to); /* of mg->sums, planes from <= k < to */
double pm_mg_most(struct pm_mg *mg, double here);
void pm_mg_hand_over(struct pm_mg *mg); /* f of grid `shared` to the whole one */
void pm_mg_take_back(struct pm_mg *mg); /* u from there */
void pm_mg_whole_cycles(struct pm_mg *mg, const struct pm_mg_choice *o);
void pm_mg_whole_pyramid(struct pm_mg *mg, double factor, const double *s); /* s: the own planes of the source on grid `shared` */

#endif
