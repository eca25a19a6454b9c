/* One pass of a transfer over the jobs of its tiles: what transfer.c and transfer-ranks.c share. For lib/transfer and lib/current.
 * SPDX-License-Identifier: GPL-3.0-or-later */
#ifndef PM_TRANSFER_PASS_H
#define PM_TRANSFER_PASS_H

#include "mesh/planes.h"
#include "transfer/order-cache.h"
#include "transfer/tile-cic.h"
#include "transfer/tile-pass.h"

/* The components that sit at the same offset. */
struct pm_pass {
	const struct pm_transfer *t;
	int components, which[PM_COMPONENTS];
	struct pm_order_cache *o;
	struct pm_tile_pass p; /* its jobs, on the axes of o */
	double *blocks; /* [threads or jobs under way][components at once][PM_BLOCK_MOST] */
	float *few;      /* gather: [n][few_to] rounded, of an order of floats; NULL */
	int few_to;
	double *results; /* gather: [n][to] where the records are not to be overwritten, else NULL */
	bool blockwise;  /* gather: positions, factors or targets are not doubles */
	int to;          /* 0: components */
	double *nodes; /* gather: NULL or [threads][PM_VECTOR_NODES] */
	bool *outside;  /* spread: of an order that is assumed: set where it is not so */
	double *squares; /* NULL or [threads][each][PM_TILE_SQUARES], before a spread zero */
};

/* The next pass: the first component not yet done, and all with the same offset. False if there is none. */
bool pm_pass_next(const struct pm_transfer *t, bool done[], struct pm_pass *w);
int pm_pass_squares(struct pm_pass *w, int threads, int each); /* so many for a thread, if jobs need them; 0 or failure */
int pm_pass_vectors(struct pm_pass *w, int threads); /* gather: nodes of a vector for a thread, if jobs need them; else squares */
struct pm_tile pm_pass_tile(const struct pm_pass *w, const struct pm_tile_job *j, double *block);
/* The particles of a job to its block. */
void pm_pass_spread(const struct pm_pass *w, const struct pm_tile_job *j, int value, double *block);
/* The values of a job's particles from its block: of a stream in order to their places, else to the results of its records. True if the former are finite. */
bool pm_pass_gather(const struct pm_pass *w, const struct pm_tile_job *j, double *block, const struct pm_tile_results *r);
/* All jobs of a gather. True if the values are finite; those in records are checked later. */
bool pm_pass_gather_all(const struct pm_pass *w, int threads, const double *const mesh[], const struct pm_tile_results *r);
void pm_pass_end(struct pm_pass *w);

/* pm_gather_columns, times one factor, to who takes the results, of particles whose order is kept; three components at most,
 * all at one offset. 0 or failure. */
int pm_gather_taken(const struct pm_transfer *t, size_t n, const struct pm_column x[], const double *const mesh[], double factor,
	const struct pm_tile_taker *taker);

/* pm_gather where the components sit at several offsets (gather-staggered.c). */
int pm_gather_staggered(const struct pm_transfer *t, size_t n, const struct pm_column x[], const double *const mesh[], const struct pm_column factor[],
	const struct pm_target out[], struct pm_strays *strays);
/* m results of particles in order of floats, from p on: times factor, to the floats few[n][stride], rounded. */
void pm_tile_results_few(size_t p, size_t m, int stride, const double *results, int n, const struct pm_tile_results *r, float *few, int to);

/* pm_spread and pm_gather where particles and planes of the mesh are divided among the ranks (transfer-ranks.c). Strays are those here. */
int pm_spread_ranks(const struct pm_transfer *t, size_t n, const double *const x[], const double *const strength[], double *const mesh[],
	struct pm_strays *strays);
int pm_gather_ranks(const struct pm_transfer *t, size_t n, const double *const x[], const double *const mesh[], const double *const factor[],
	double *const out[], struct pm_strays *strays);

/* What a job adds to the mesh component by component: where this goes, and who adds it to the block, which is zero, of a job. */
struct pm_job_blocks {
	int n;
	const struct pm_tile_target *to; /* [n] */
	void (*fill)(const void *data, const struct pm_tile_pass *p, const struct pm_tile_job *j, int component, double *block);
	int (*begin)(const void *data, size_t jobs, int threads); /* before any; 0 or failure */
	const void *data;
};
/* The same of records of another kind, whose order here is `local` (NULL with a status; it is freed): in t grid, kernel and planes count. Takes the caller's
 * status and returns the agreed one. */
int pm_spread_jobs_ranks(int status, const struct pm_transfer *t, struct pm_order_cache *local, const struct pm_job_blocks *b, double *const mesh[]);

#endif
