/* Shared by the decisions of effects: comparing a share with the accuracy, and whether there is any force between particles.
 * SPDX-License-Identifier: GPL-3.0-or-later */
#ifndef PM_EFFECT_DECISION_H
#define PM_EFFECT_DECISION_H

#include "effect/effect.h"

/* Forces that cancel to round-off and continue to do so: a lattice that moves as a whole and reaches no wall. */
bool pm_effect_round_off(const struct pm_scales *s); /* the forces measured are zero but for round-off */
bool pm_effect_cancels(const struct pm_scales *s);
/* Is there no force between particles? */
bool pm_effect_alone(const struct pm_scales *s);
/* A decision that needs no number, and one by a share; shares are estimates, so to be left out it must be below half the accuracy. */
void pm_effect_off(struct pm_decision *d, const char *text);
/* A quiet start whose random velocities move no particle past its neighbour in 1/omega: it stays in order, as a cold one does. */
bool pm_effect_ordered(const struct pm_scales *s);

/* Charges that sample a smooth density by a quiet start, noise far below that of a random sample, and pass their neighbours in 1/omega: not a cold wave,
 * whose flow differs within a box. */
bool pm_effect_quiet(const struct pm_scales *s);
void pm_effect_by(struct pm_decision *d, const struct pm_scales *s, double number, double share);

#endif
