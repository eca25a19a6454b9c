/* Particle strength exchange (docs/methods/pse.md). SPDX-License-Identifier: GPL-3.0-or-later */
#ifndef PM_NEAR_PSE_H
#define PM_NEAR_PSE_H

#include "cell/cell-list.h"

enum { PM_PSE_TERMS = 4 };

/* eta(z) = (4 pi)^(-dim/2) sum_i coefficient_i z^2i exp(-z^2/4): even, its second moments are 2, those of order 4 .. order vanish. */
struct pm_pse {
	int dim, order;          /* 1, 2, 3; 2, 4, 6 or 8 */
	double eps, cutoff;      /* [length]; in eps, at most 40 */
	double reach;            /* [length] */
	double coefficient[PM_PSE_TERMS];
	double total;            /* zeroth moment of eta: order/2 */
	double beyond;           /* integral of |eta| beyond the cut-off, over total */
	double negative;         /* integral of |eta| where eta < 0, over total */
	const double *share;     /* NULL, or of every particle from 0 to 1: a pair exchanges the mean of its two times as much */
};

/* The cut-off as a length, plus 1e-9 of it, so that lattice neighbours exactly at the cut-off are included despite round-off. */
static inline double pm_pse_reach(double eps, double cutoff) { return eps * cutoff * (1 + 1e-9); }
struct pm_pse pm_pse_of(int dim, int order, double eps, double cutoff);
double pm_pse_cutoff(int order); /* the default, in eps */
double pm_pse_value(const struct pm_pse *p, double z2); /* eta, without the cut-off */

struct pm_pse_found {
	double fastest; /* no mode decays faster than nu times this [1/length^2]; of pse-frame.h nu is in it [1/time] */
	double overlap; /* largest sum over q of V_q eta_eps(x_p - x_q) over the integral of eta: 1 on a lattice; of the corrected form 0 */
	double beyond;  /* of |eta| beyond the cut-off, over the integral; of the corrected form 0 */
	double spacing; /* [length] of pse-frame.h: (mean volume)^(1/dim) */
	uint64_t alone; /* particles without any neighbour or image */
	uint64_t widened; /* of the corrected form: particles that needed partners from beyond the cut-off */
};

/* rate[p] += (nu/eps^2) sum over q of (V_p G_q - V_q G_p) eta((x_p - x_q)/eps)/eps^dim, partners and images within the cut-off, which is the list's
 * reach; times (share_p + share_q)/2. Each pair is antisymmetric to the last bit, so that the sum over p is zero to round-off. The same bytes
 * for any number of threads. */
int pm_pse_add(const struct pm_pse *p, const struct pm_cell_list *l, double nu, const double *volume, const double *strength, double *rate,
	struct pm_pse_found *found);

/* All particles of a set, on every rank: what pm_pse_add takes; and the first of every rank, one more than ranks. */
struct pm_pse_all {
	const double *volume, *strength;
	const uint64_t *from;
};
/* The same, the work shared by the ranks; rate is that of the particles here. Takes the caller's status and returns the agreed one. */
int pm_pse_add_here(int status, const struct pm_pse *p, const struct pm_cell_list *l, double nu, const struct pm_pse_all *all, double *rate,
	struct pm_pse_found *found);

/* The same by the plain double loop with the library's exp: the reference in tests. */
int pm_pse_plain(const struct pm_pse *p, const struct pm_domain *domain, double nu, size_t n, const double *const x[], const double *volume,
	const double *strength, double *rate);

#endif
