/* What the effects share to decide: shares against the accuracy, and whether there is any force between particles.
 * SPDX-License-Identifier: GPL-3.0-or-later */
#ifndef PM_EFFECT_DECISION_H
#define PM_EFFECT_DECISION_H

#include "effect/effect.h"

/* Forces that cancel to rounding and stay so: a lattice that moves as one and meets no wall. */
bool pm_effect_cancels(const struct pm_scales *s);
/* Is there no force between particles? */
bool pm_effect_alone(const struct pm_scales *s);
/* A decision that needs no number, and one that a share decides; shares are estimates, so it must be below half the accuracy. */
void pm_effect_off(struct pm_decision *d, const char *text);
void pm_effect_by(struct pm_decision *d, const struct pm_scales *s, double number, double share);

#endif
