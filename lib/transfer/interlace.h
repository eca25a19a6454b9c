/* Interlacing: two meshes half a cell apart along every axis, combined in the space of waves (interlace.c; docs/methods/pm-force.md).
 * SPDX-License-Identifier: GPL-3.0-or-later */
#ifndef PM_TRANSFER_INTERLACE_H
#define PM_TRANSFER_INTERLACE_H

#include "fft/axis-transform.h"
#include "mesh/grid.h"
#include "transfer/transfer.h"

/* 0, or the sentence that says what can: every axis periodic, components on the nodes, at most half of PM_COMPONENTS. */
int pm_interlace_check(const struct pm_transfer *t);

/* As pm_spread, half of each strength on either mesh. */
int pm_interlace_spread(const struct pm_transfer *t, struct pm_fft_plans *p, size_t n, const double *const x[], const double *const strength[],
	double *const mesh[], struct pm_strays *strays);

/* The mesh field on both meshes, times a half; then as pm_gather, the transpose of the spread. */
struct pm_interlaced {
	double *store;
	const double *mesh[PM_COMPONENTS];
};
int pm_interlace_init(struct pm_interlaced *i, const struct pm_transfer *t, struct pm_fft_plans *p, const double *const mesh[]);
void pm_interlace_free(struct pm_interlaced *i);
int pm_interlace_gather(const struct pm_interlaced *i, const struct pm_transfer *t, size_t n, const double *const x[], const double *const factor[],
	double *const out[], struct pm_strays *strays);

#endif
