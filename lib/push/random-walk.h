/* Random walk: x += N(0, 2 nu dt) per component, the diffusion of the density of particles (Chorin 1973; Cottet and Koumoutsakos 2000, section 5.3).
 * A step depends on (seed, set, particle, step) alone, not on order or threads. Strong error O(1/sqrt N).
 * SPDX-License-Identifier: GPL-3.0-or-later */
#ifndef PM_PUSH_RANDOM_WALK_H
#define PM_PUSH_RANDOM_WALK_H

#include "stream/frame.h"

/* The key of a set: its name (FNV-1a, Fowler, Noll, Vo 1991) mixed into the seed. */
uint64_t pm_walk_key(uint64_t seed, const char *set);
/* One walk of n particles; x: the dim components of the positions; id: NULL to use the index instead. */
void pm_walk_step(uint64_t key, int64_t step, double deviation, uint64_t first, size_t n, int dim, const int64_t *id, double *const x[]);
/* Folded and mirrored as in push; velocities are not changed. */
void pm_walk_faces(const struct pm_frame *f, size_t n, double *const x[]);

#endif
