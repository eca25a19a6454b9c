/* Strengths for which particles, smoothed, are a given function (docs/methods/beale.md). SPDX-License-Identifier: GPL-3.0-or-later */
#ifndef PM_NEAR_BEALE_H
#define PM_NEAR_BEALE_H

#include "near/sample-frame.h"

struct pm_beale_gain {
	int iterations;       /* made and kept */
	double before, after; /* largest difference over the particles, over the largest value: of the strengths as they came, as they are now */
};

/* What was typed, with the law's strength and the first set that has it where nothing was; it must be a strength, with volumes. 0 or failure. */
int pm_beale_choose(const struct pm_sample_choice *typed, const struct pm_frame *f, struct pm_sample_choice *c);
/* choice: field, set and at alike, target; the strengths have the volumes `volume`. Stops behind `most` iterations, below the tolerance, or where an iteration
 * makes it worse, which is taken back. The target field holds the smoothed function of the strengths that are kept. 0 or failure. */
int pm_beale(const struct pm_sample_choice *choice, struct pm_frame *f, int most, double tolerance, struct pm_beale_gain *gain);

#endif
