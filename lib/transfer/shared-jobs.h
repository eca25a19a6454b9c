/* The jobs of a transfer dealt among the ranks, and the records that each needs. Private to lib/transfer and its tests.
 * SPDX-License-Identifier: GPL-3.0-or-later */
#ifndef PM_TRANSFER_SHARED_JOBS_H
#define PM_TRANSFER_SHARED_JOBS_H

#include "transfer/transfer-pass.h"

/* A job of this rank, beside its records. */
struct pm_own_job {
	bool mixed;                      /* it has records of other ranks, and is made of copies; else of the records here, where they are */
	size_t local, copy, here;        /* mixed: the first of its records here, its place among the copies, and how many */
};

struct pm_shared_jobs {
	const struct pm_transfer *t;
	const struct pm_planes *planes;
	size_t ranks, me;
	struct pm_order_cache *local;    /* the particles here, by tile */
	struct pm_order_cache mixed;     /* copies of the records of mixed jobs, in the order of jobs */
	struct pm_pass w;                /* the jobs of this rank; their records are those of local, of mixed jobs those of mixed */
	struct pm_own_job *own;          /* of each of these */
	int64_t *total, *at;             /* [tiles] records of all ranks; where in the order of all records those here begin */
	size_t jobs;                     /* of all ranks */
	struct pm_tile_job *job;         /* from, to: in the order of all records */
	size_t *job_of, *record_of;      /* the first job and record of every rank, one more than ranks */
	size_t *out, *in;                /* [ranks] records to and from each; nothing to itself */
	size_t sent[2];                  /* of the records here those before the first are for lower ranks, those from the second on for higher ones */
	size_t *place;                   /* of each record that came, among the copies */
	int *holder;                     /* the rank of each plane of the mesh */
};

/* The jobs of a pass (w.which, w.components) over n particles here. room: doubles of results a record. Takes the caller's
 * status and returns the agreed one; free in any case. */
int pm_shared_jobs_init(int status, struct pm_shared_jobs *v, size_t n, const double *const x[], int nvalues, const double *const values[], int room);
/* The same of records of another kind, whose order here is v->local; nvalues: that each of them has, at least, on every rank. */
int pm_shared_jobs_of_order(int status, struct pm_shared_jobs *v, int nvalues, int room);
/* keep: the order of the particles here is left for the next transfer at their positions. */
void pm_shared_jobs_free(struct pm_shared_jobs *v, bool keep);

/* The pass with the records of job i of this rank. */
struct pm_pass pm_shared_jobs_pass(const struct pm_shared_jobs *v, size_t i);

#endif
