/* The gather of a law's field that is left to be made (stream/later.h), and the pass over the particles that makes it a few at a time, in a periodic box: in
 * the order of tiles where they stay in the stream, else from the results of all, in the order of the stream; of particles on nodes row by row.
 * SPDX-License-Identifier: GPL-3.0-or-later */
#ifndef PM_TRANSFER_RATE_LATER_H
#define PM_TRANSFER_RATE_LATER_H

#include "transfer/gather-beside.h"
#include "transfer/gather-frame.h"
#include "transfer/tile-runs.h"

struct pm_rate_left;
enum { PM_RATE_FEW = 512 }; /* the most particles that are handed over at once */

/* In frame(): leaves the rate of a set, which a[] gathers, to be made; *left false: it does not. 0 or failure. */
int pm_rate_leave(const struct pm_gather_job *j, struct pm_frame *f, const char *set, const struct pm_gather_arrays *a, bool *left);
const struct pm_rate_left *pm_rate_left_of(const struct pm_field *rate); /* NULL: it is not left so */
double pm_rate_left_most(const struct pm_rate_left *l);                  /* no component of the rate is larger */

/* Arrays of the stream that change with the positions, which are dim of PM_TILE_RUNS_MOST; only the first `back` are needed afterwards. */
struct pm_rate_beside {
	int n, back;
	double *of[PM_TILE_RUNS_MOST];
};
/* m <= PM_RATE_FEW particles of several: their positions, what is beside them and rates; changes the first two. By threads. */
typedef void pm_rate_few(void *data, size_t m, double *const x[3], double *const beside[], const double *const rate[3]);
/* In frame(), of an x with PM_USE_WAITS: may the pass change it in its place? */
bool pm_rate_can_pass(const struct pm_rate_left *l, const struct pm_frame *f, struct pm_field *x);
/* 0 or failure; x, and what is beside it, then are as few() leaves them. */
int pm_rate_pass(const struct pm_rate_left *l, const struct pm_frame *f, struct pm_field *x, const struct pm_rate_beside *beside, pm_rate_few *few, void *data);

#endif
