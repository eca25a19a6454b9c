/* What the current of a run alone and of several ranks share: the blocks of a job, where they go, the ways as records. Private to lib/current.
 * SPDX-License-Identifier: GPL-3.0-or-later */
#ifndef PM_CURRENT_PARTS_H
#define PM_CURRENT_PARTS_H

#include "current/current-cells.h"
#include "current/current.h"
#include "transfer/transfer-pass.h"

/* Velocities of a few particles of a job, m <= PM_TILE_ORDER_PACK from p on in order, made before they are used; u[dim] and way[dim] are their ways as
 * pm_tile_order_columns has them. */
struct pm_current_few {
	void (*make)(void *data, const struct pm_tile_order *o, const struct pm_tile_job *j, size_t p, size_t m, double *const u[3], double *const way[3]);
	void *data;
};

/* The three blocks of a job, added to. */
struct pm_current_fill {
	const struct pm_current *c;
	double shift; /* of the axes */
	const bool *rests; /* [3] of an order of particles, whose values are charge and velocity: no velocity along this axis above dim; of ways NULL */
};
void pm_current_fill(const struct pm_current_fill *s, const struct pm_tile_pass *p, const struct pm_tile_job *j, double *block,
	struct pm_current_cells *cells); /* of this thread, or NULL where there are none */
/* Where the blocks of a component go; flip is its room. */
struct pm_tile_target pm_current_target(const struct pm_current *c, const struct pm_axis nodes[3], const struct pm_axis halves[3], int component,
	unsigned char flip[3]);
/* The ways as particles to be sorted; columns is room for what that points to. */
struct pm_ways_columns {
	struct pm_column at[3], values[PM_COMPONENTS];
};
struct pm_tile_particles pm_ways_particles(const struct pm_current *c, const struct pm_ways *ways, struct pm_ways_columns *columns);
bool pm_ways_straight(const struct pm_current *c, size_t n, const struct pm_column x[3], const struct pm_column v[3]); /* every way is one piece */
/* pm_current_add of columns, alone; *far: nothing was done, because ways are cut, or doubles are far from the order of tiles (pm_current_add does it).
 * With few, pm_current_order_left has the order, and no way is cut. */
int pm_current_columns(const struct pm_current *c, size_t n, const struct pm_column x[3], const struct pm_column v[3], const struct pm_column *q,
	double *const j[3], size_t *stray, bool *far);
/* The order that the gather before left; NULL: it is not there, or particles do not stay in the stream of a periodic box. */
const struct pm_tile_order *pm_current_order_left(const struct pm_current *c, size_t n, const struct pm_column x[3]);
/* pm_current_add of ways where they and the mesh are divided: `firsts` of them are first pieces, the further ones follow. ways may be cut anew. Takes the
 * caller's status and returns the agreed one. */
int pm_current_ranks(int status, const struct pm_current *c, struct pm_ways *ways, size_t firsts, double *const mesh[3], size_t *stray);

#endif
