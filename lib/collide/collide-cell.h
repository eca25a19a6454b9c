/* The collisions within the cells. SPDX-License-Identifier: GPL-3.0-or-later */
#ifndef PM_COLLIDE_CELL_H
#define PM_COLLIDE_CELL_H

#include "collide/collide-frame.h"

struct pm_colliding { /* a set */
	const char *name;
	size_t n;
	const int64_t *id; /* NULL: the index */
	const double *charge, *mass;
	double *v[3];
	uint64_t shuffle; /* key of the order within a cell */
};

struct pm_colliders {
	const struct pm_collision *method;
	double dt, cell, eps0, weight; /* cell [length^dim]: its volume */
	int64_t step;
	int nsets;
	struct pm_colliding set[PM_COLLIDE_SETS];
	double logarithm[PM_COLLIDE_SETS][PM_COLLIDE_SETS]; /* a <= b */
	uint64_t key[PM_COLLIDE_SETS][PM_COLLIDE_SETS];     /* of set a, whose particles are the more, with b */
	bool pairs[PM_COLLIDE_SETS][PM_COLLIDE_SETS];
	size_t from[PM_COLLIDE_SETS + 1]; /* particle i of set a is number from[a] + i of all */
	uint64_t *cell_of;                /* of all */
	size_t *order;                    /* all by cell, within a cell by set */
};

/* n particles in all. The number of pairs, and their mean of 1 - exp(-s), the mean of 1 - cos of the angle. 0 or failure. */
int pm_collide_cells(const struct pm_colliders *k, size_t n, uint64_t *pairs, double *turn);

#endif
