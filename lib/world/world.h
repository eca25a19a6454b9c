/* The ranks of a run, and the eight operations by which they work together (docs/distributed.md). Methods use these, never MPI.
 *
 * Every operation is called by all ranks in the same order. Each takes the caller's status and returns the agreed one: 0 if no rank has failed, else the
 * failure with the least place (pm_world_place), with its code and its message on every rank. So a rank that has failed still calls it:
 *     status = pm_world_exchange(status, ...);     never: if (!status) status = pm_world_exchange(...)
 * Where the agreed status is not 0, nothing has been sent, and results are as they were before. In a world of one, nothing happens.
 * SPDX-License-Identifier: GPL-3.0-or-later */
#ifndef PM_WORLD_H
#define PM_WORLD_H

#include "base/base.h"
#include "world/transport.h"

PM_C_BEGIN

int pm_world_rank(void); /* 0 .. size - 1; rank 0 reads, writes and speaks */
int pm_world_size(void); /* 1: alone */

/* Where a failure would have been found by a run alone: the order of checks, then of sets (or meshes), components, and indices in the whole stream. Valid
 * until the next operation. A failure without a place counts as the first check of its rank. */
void pm_world_place(int check, int set, int component, uint64_t index);

/* 1. The bytes of one rank to all. */
int pm_world_share(int status, int root, void *data, size_t bytes);
/* The same from rank 0 where no rank can have failed since the last operation: nothing is agreed, so that ranks wait once. */
int pm_world_tell(void *data, size_t bytes);
/* 2. The pieces of all ranks, joined in the order of ranks, on rank 0: *all of *total bytes, to be freed with pm_free; NULL and 0 elsewhere. */
int pm_world_gather(int status, const void *mine, size_t bytes, void **all, size_t *total);
/* 3. To every rank its own piece: out holds the pieces for rank 0, 1, ... one after the other, out_bytes their lengths. *in holds what arrived, in the order
 * of ranks, to be freed with pm_free; in_bytes (size numbers) the lengths. */
int pm_world_exchange(int status, const void *out, const size_t *out_bytes, void **in, size_t *in_bytes);
/* 4. The planes beyond the ends of this rank's stretch. from: the beginnings of all ranks' planes, size + 1 of them. data points to the first own plane;
 * there is room for `wide` planes below it and above the last one. On an axis that is not periodic the planes beyond its ends stay as they are. */
struct pm_halo {
	const uint64_t *from;
	size_t bytes; /* of a plane */
	int wide;     /* planes */
	bool periodic;
	bool empty;   /* ranks without planes get those on either side of where theirs would be, too */
};
int pm_world_halo(int status, const struct pm_halo *halo, void *data);
/* 5. The largest of each of n numbers over all ranks; one that is not a number is larger than all others. */
int pm_world_largest(int status, size_t n, double *x);
/* 6. Nothing but the status. */
int pm_world_agree(int status);
/* 7. Exact sums, sums over the ranks before this one, least and largest of n integers. */
int pm_world_count(int status, enum pm_reduction how, size_t n, int64_t *x);
/* 8. Items held as the stretches between the beginnings `from` (size + 1 of them) to the stretches between `to`. in and out: the own stretch, in memory of the
 * caller. With {0, n, n, ...} all is on rank 0. */
int pm_world_recut(int status, const uint64_t *from, const uint64_t *to, size_t bytes, const void *in, void *out);

/* What this rank has sent since the beginning (or since the caller noted them). */
struct pm_world_traffic {
	uint64_t bytes, messages, calls;
};
struct pm_world_traffic pm_world_traffic(void);

/* For the layer that runs stages, and tests. */
/* apart: what follows is done by this rank alone (a word that is not divided), so that it sees a world of one. Returns what was before. */
bool pm_world_apart(bool apart);
bool pm_world_alone(void); /* there are no other ranks, of which this one may be apart */
void pm_world_set(const struct pm_transport *t); /* from now on this is the world; copied */
int pm_world_end(void);                          /* all ranks have ended: 0 or failure; afterwards the world is of one */
void pm_world_abort(int code);                   /* ends the other ranks, and where they are MPI's this one too; alone it does nothing */
void pm_world_cut(size_t bytes);                 /* messages are cut at this length; 1 GiB at the beginning */
bool pm_world_broken(void);                      /* a rank has died: no operation can succeed */
extern const struct pm_transport pm_transport_alone;
/* n ranks of this machine: forks n - 1 processes, which are ranks 1 .. n - 1, so it must be called before any thread starts. Faults are read from the
 * environment (docs/distributed.md, Rehearsal). */
int pm_transport_rehearse(struct pm_transport *t, int n);

PM_C_END

#endif
