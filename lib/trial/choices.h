/* The functions of pm_choices (trial.h). SPDX-License-Identifier: GPL-3.0-or-later */
#ifndef PM_TRIAL_CHOICES_H
#define PM_TRIAL_CHOICES_H

#include "trial/trial.h"

int pm_choice_finer(const struct pm_plan *p, struct pm_edit *e, struct pm_frame **f, char from[48], char to[48]);
int pm_choice_coarser(const struct pm_plan *p, struct pm_edit *e, struct pm_frame **f, char from[48], char to[48]);
int pm_choice_kernel(const struct pm_plan *p, struct pm_edit *e, struct pm_frame **f, char from[48], char to[48]);
int pm_choice_gradient(const struct pm_plan *p, struct pm_edit *e, struct pm_frame **f, char from[48], char to[48]);
int pm_choice_solver(const struct pm_plan *p, struct pm_edit *e, struct pm_frame **f, char from[48], char to[48]);
int pm_choice_pairs(const struct pm_plan *p, struct pm_edit *e, struct pm_frame **f, char from[48], char to[48]);
int pm_choice_particles(const struct pm_plan *p, struct pm_edit *e, struct pm_frame **f, char from[48], char to[48]);
int pm_choice_last_bit(const struct pm_plan *p, struct pm_edit *e, struct pm_frame **f, char from[48], char to[48]);

#endif
