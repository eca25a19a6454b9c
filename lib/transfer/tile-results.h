/* The results of particles in the order of tiles, on their way back to the stream. For lib/transfer.
 * SPDX-License-Identifier: GPL-3.0-or-later */
#ifndef PM_TRANSFER_TILE_RESULTS_H
#define PM_TRANSFER_TILE_RESULTS_H

#include "transfer/tile-order.h"

/* Who takes the results of m particles in order from p on, or, where there are records, of the stream from p on, m <= PM_TILE_ORDER_PACK, in place of arrays
 * of them: value[nvalues][m], which he may change, as x[dim], which is NULL, or where their positions are: in the stream, if they stand together there, else
 * copies, [dim][PACK]. By threads, of particles that are not the same. */
struct pm_tile_taker {
	void (*take)(void *data, const struct pm_tile_order *o, size_t p, size_t m, double *const x[], double *const value[]);
	void *data;
};

/* The places of values: to[c][p] = (where set) or += factor[c][p] * value. */
struct pm_tile_results {
	const struct pm_column *factor;
	const bool *set;
	const struct pm_target *to;
	double *most; /* NULL, or raised to the largest sum of squares of what is set at a particle; INFINITY: not all were looked at */
	const struct pm_tile_taker *taker; /* NULL, or he has them; the others are not used */
};
/* All targets are floats that can be written over, and all factors one number: a result may be rounded before it is at its place. */
bool pm_tile_results_round(int n, const struct pm_tile_results *r);

/* to[c][p] = (where set) or += factor[c][p] * (double c of the result of p); factor[c] NULL: 1; 0 for strays. results: [n][stride] in the order of the
 * records. Whether every value is finite; 0 or failure. */
int pm_tile_results_return(const struct pm_tile_order *o, const double *results, int stride, int nvalues, const struct pm_tile_results *r, bool *finite);
/* The same of results that are floats, for targets that are, times factor already: they are set. 0 or failure. */
int pm_tile_results_return_floats(const struct pm_tile_order *o, const float *results, int stride, int nvalues, const struct pm_tile_results *r);
/* The same for m particles of the stream from p on, whose records are given. */
bool pm_tile_results_unpack(size_t p, size_t m, int stride, const double *records, int nvalues, const struct pm_tile_results *r);
/* The same for m <= PM_TILE_ORDER_PACK particles from p on in order, that stay or stand in order, from records or arrays values[nvalues][PM_TILE_ORDER_PACK].
 * Strays of particles that stay come last, and get 0. */
bool pm_tile_results_deliver_arrays(const struct pm_tile_order *o, size_t p, size_t m, const double *values, int nvalues, const struct pm_tile_results *r);
bool pm_tile_results_deliver(const struct pm_tile_order *o, size_t p, size_t m, int stride, const double *records, int nvalues,
	const struct pm_tile_results *r);
void pm_tile_results_leave_strays(const struct pm_tile_order *o, int nvalues, const struct pm_tile_results *r);
/* Results of m particles from p on to who takes them, times factor[c], one number each. */
void pm_tile_results_hand_over(const struct pm_tile_order *o, size_t p, size_t m, int stride, const double *records, int nvalues,
	const struct pm_tile_results *r);

#endif
