/* How a scene draws its particles from a distribution. SPDX-License-Identifier: GPL-3.0-or-later */
#ifndef PM_SCENE_LOADING_H
#define PM_SCENE_LOADING_H

#include "scene/scene.h"

extern const char *const pm_loading_names[]; /* in the order of enum pm_loading; NULL ends */

enum { PM_LOAD_AXES = 8 };
/* n points of the unit cube, 0 < u < 1: u[axis][i]. bit-reversed is Hammersley's set: the last axis (i + 1/2)/n, the others the digits of i reversed in
 * the bases 2, 3, 5, 7, 11, 13, 17; sobol is Sobol's sequence, random is Philox. Not for PM_LATTICE. 0 or failure. */
int pm_scene_points(enum pm_loading how, uint64_t seed, uint64_t n, int axes, double *const u[PM_LOAD_AXES]);
/* Digits of i in a prime base behind the point in reverse order (van der Corput 1935; Hammersley 1960). */
double pm_scene_digits_reversed(uint64_t i, uint64_t base);
/* z with u = (1 + erf(z/sqrt 2))/2, 0 < u < 1: bisection-free, Newton's method from the tail estimate of Abramowitz and Stegun 26.2.23. */
double pm_scene_normal_of(double u);

/* A lattice in phase space: evenly spaced velocities (beams) from -6 to 6 standard deviations, evenly spaced particles in each, and weights in proportion
 * to the Maxwellian, the sum of which is 1. */
struct pm_scene_beams { uint64_t n, beams; double total; };
/* beams 0: as many velocities as particles in each of them and a quarter less. */
int pm_scene_beams_init(uint64_t n, double beams, struct pm_scene_beams *b);
struct pm_scene_beam_point { double place, velocity, weight; }; /* in 0..1; in standard deviations; of one particle */
struct pm_scene_beam_point pm_scene_beam_at(const struct pm_scene_beams *b, uint64_t i);

#endif
