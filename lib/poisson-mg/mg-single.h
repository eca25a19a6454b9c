/* A hierarchy of single numbers, for corrections (mg-refine.c): what of it is used from outside. SPDX-License-Identifier: GPL-3.0-or-later */
#ifndef PM_POISSON_MG_MG_SINGLE_H
#define PM_POISSON_MG_MG_SINGLE_H

#include "poisson-mg/mg.h"

struct pm_mg_single;

/* For a grid whose spacings are in units of the smallest; from: the first plane of every rank, NULL: all are here. */
struct pm_mg_single *pm_mg_single_new(const struct pm_grid *g, uint64_t *from);
struct pm_mg_single *pm_mg_single_free(struct pm_mg_single *m);

/* The right-hand side, or the solution, in row j of plane k: its even nodes, its odd ones. */
void pm_mg_single_source(struct pm_mg_single *m, size_t j, size_t k, float *half[2]);
void pm_mg_single_solution(const struct pm_mg_single *m, size_t j, size_t k, const float *half[2]);

/* Behind a new right-hand side: clears the solution, or starts full multigrid, and takes over what has failed. */
void pm_mg_single_start(struct pm_mg_single *m, const struct pm_mg_choice *o, bool full, int status);
int pm_mg_single_status(const struct pm_mg_single *m);
double pm_mg_single_down(struct pm_mg_single *m, const struct pm_mg_choice *o, bool zero); /* half a cycle; the residual, root of the sum of squares */
void pm_mg_single_up(struct pm_mg_single *m, const struct pm_mg_choice *o);                /* the other half */
double pm_mg_single_noise(struct pm_mg_single *m); /* the residual that its rounding leaves, about */

#endif
