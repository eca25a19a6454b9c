/* pse on many ranks (docs/distributed.md): each knows all particles and the same cell list, sums the pieces of a stretch of its places, and adds up there
 * what all pieces give, in the order of pieces. SPDX-License-Identifier: GPL-3.0-or-later */
#ifndef PM_NEAR_PSE_RANKS_H
#define PM_NEAR_PSE_RANKS_H

#include "near/pse.h"
#include "world/world.h"

enum { PM_PSE_CHUNK = 64 }; /* places; divides a piece */

struct pm_pse_chunk {
	uint64_t at; /* the first place */
	double exchange[PM_PSE_CHUNK], weight[PM_PSE_CHUNK];
};
struct pm_pse_kept {
	size_t n, room;
	struct pm_pse_chunk *of;
	bool bad; /* there was no memory */
};

/* The places of a rank. */
void pm_pse_places(size_t n, size_t piece, int rank, size_t *begin, size_t *end);
/* What a piece gives to the places low..high-1, where it is not zero; then it is zero. */
void pm_pse_keep(struct pm_pse_kept *kept, size_t low, size_t high, double *exchange, double *weight);
/* All of it to the ranks of the places, which add it to exchange and weight. */
int pm_pse_bring(int status, struct pm_pse_kept *kept, size_t n, size_t piece, double *exchange, double *weight);
int pm_pse_found_all(int status, struct pm_pse_found *found);
/* The sums at the places of a rank to the ranks of their particles, which are divided as `from`: at their places, in exchange. */
int pm_pse_return(int status, const struct pm_cell_list *l, size_t piece, const uint64_t *from, double *exchange);

#endif
