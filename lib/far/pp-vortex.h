/* Biot-Savart sums over all pairs of vortices in space (docs/methods/pp.md). SPDX-License-Identifier: GPL-3.0-or-later */
#ifndef PM_FAR_PP_VORTEX_H
#define PM_FAR_PP_VORTEX_H

#include "mollifier/mollifier.h"

PM_C_BEGIN

enum pm_pp_form { PM_PP_TRANSPOSE, PM_PP_CLASSICAL, PM_PP_MIXED, PM_PP_NONE };
extern const char *const pm_pp_form_names[]; /* in this order; NULL ends */

struct pm_pp_vortex {
	double delta;  /* [length] of the mollifier, >= 0 */
	const struct pm_mollifier *mollifier; /* one that has a slope */
	enum pm_pp_form form;
};

/* Room for a number a target each. velocity[c][i] = sum over j != i of (f alpha_j x s)_c with s = x_i - x_j; stretching[c][i] = the rate of alpha_i by the
 * gradient of that velocity in one of its forms (not written if the form is none); psi[c][i] = -sum alpha_j,c phi (psi[0] NULL: not wanted). */
struct pm_pp_vortex_sums {
	double *velocity[3], *stretching[3], *psi[3];
	uint64_t coincident; /* pairs closer than 1e-60 and not mollified, which exert nothing, once for each target */
};

/* For the first `targets` of n vortices. The same bytes for any number of threads. 0 or failure. */
int pm_pp_vortex_sum(const struct pm_pp_vortex *p, size_t targets, size_t n, const double *const x[3], const double *const alpha[3],
	struct pm_pp_vortex_sums *to);

/* The same by the plain double loop, each pair through the mollifier's functions: what the other is tested against. */
int pm_pp_vortex_plain(const struct pm_pp_vortex *p, size_t targets, size_t n, const double *const x[3], const double *const alpha[3],
	struct pm_pp_vortex_sums *to);

PM_C_END

#endif
