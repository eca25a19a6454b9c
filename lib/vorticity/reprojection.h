/* The divergence of a vorticity removed from the strengths of its particles. SPDX-License-Identifier: GPL-3.0-or-later */
#ifndef PM_VORTICITY_REPROJECTION_H
#define PM_VORTICITY_REPROJECTION_H

#include "mesh/gradient.h"
#include "poisson-fft/fft-solvers.h"
#include "transfer/transfer-frame.h"

struct pm_reprojection_choice {
	const char *kernel, *mesh, *order; /* NULL: the law's, the first, spectral or with an open face 6 */
	int64_t passes;                    /* 1 or more: each takes the divergence that the one before left */
	double above;                      /* act only beyond this divergence, max |div omega| h/max |omega| */
};

/* From the header to the data. */
struct pm_reprojection {
	const struct pm_law *law;
	const struct pm_kernel *kernel;
	const struct pm_mesh *mesh;
	struct pm_sets sets;
	struct pm_operator div, grad;
	struct pm_poisson_fft_choice solver;
	int64_t passes;
	double above;
};

/* Each 0 or failure. Header: alpha is changed; what was derived is dropped. */
int pm_reprojection_declare(const struct pm_reprojection_choice *c, struct pm_frame *f, struct pm_reprojection *r);
/* Data: *divergence was there before; 1 if the strengths were changed. */
int pm_reprojection_apply(const struct pm_reprojection *r, struct pm_frame *f, struct pm_fft_plans *plans, struct pm_fft_solvers *solvers, double *divergence);

#endif
