/* Operators on mesh fields: grad, curl, div and lap by centred differences of order 2, 4, 6 or spectrally (docs/methods/mgrad.md).
 * SPDX-License-Identifier: GPL-3.0-or-later */
#ifndef PM_MESH_GRADIENT_H
#define PM_MESH_GRADIENT_H

#include "fft/fft-plans.h"
#include "mesh/grid.h"

PM_C_BEGIN

enum pm_operator_kind { PM_OP_GRAD, PM_OP_CURL, PM_OP_DIV, PM_OP_LAP };
extern const char *const pm_operator_names[], *const pm_order_names[]; /* NULL ends; orders 2, 4, 6, spectral */
int pm_order_find(const char *name);                                   /* 2, 4, 6; 0 spectral; -1 and a message */

enum { PM_TAPS = 8, PM_ENDS = 12, PM_TERMS_MOST = 18, PM_OUTS_MOST = 9 /* the gradient of a vector */ };

struct pm_planes;

/* One term: out component += sign * derivative of in component along an axis, times a field. */
struct pm_operator_term {
	int out, in, axis;
	int as;      /* the vector component whose images it has beyond a face; mostly in */
	int by;      /* times weight[by - 1]; 0: times 1 */
	double sign;
};

struct pm_operator {
	struct pm_grid grid;
	enum pm_operator_kind kind;
	int order;      /* 0: spectral */
	int in, out;    /* components */
	bool flow;      /* a vector field is a flow (walls: normal component odd, others even), else a gradient (the other way round) */
	int derivative; /* 1; lap: 2 */
	int nterms;     /* in order of out */
	struct pm_operator_term term[PM_TERMS_MOST];
	bool add;       /* to out, instead of replacing it */
	const struct pm_planes *planes; /* NULL, or those of this rank (mesh/gradient-parts.h) */
	const double *weight[3]; /* fields of the grid's points that terms are multiplied by */
	struct pm_fft_plans *plans; /* spectral: of pm_operator_plan, to be there as long as the operator */
};

/* The terms of an operator on a field of `in` components: 0, or failure with the reason. Makes no FFT plans. */
int pm_operator_init(struct pm_operator *o, const struct pm_grid *g, enum pm_operator_kind kind, int order, int in, bool flow);
/* The stretching of vorticity by a flow u in 3-D, in = u, weight = omega (Cottet and Koumoutsakos 2000, section 3.1):
 * classical (omega . grad) u_c = sum_d omega_d du_c/dx_d; transpose sum_d omega_d du_d/dx_c; mixed half of each. The conservative form
 * sum_d d(omega_d u_c)/dx_d is one operator for each component c, of in[d] = omega_d u_c and without weights. 0 or failure. */
enum pm_stretch_form { PM_STRETCH_CONSERVATIVE, PM_STRETCH_CLASSICAL, PM_STRETCH_TRANSPOSE, PM_STRETCH_MIXED };
extern const char *const pm_stretch_names[]; /* NULL ends */
int pm_operator_stretch(struct pm_operator *o, const struct pm_grid *g, enum pm_stretch_form form, int component, int order);
/* The transforms of a spectral operator; nothing to do for differences. */
int pm_operator_plan(struct pm_operator *o, struct pm_fft_plans *p);
/* out[c] = factor * operator(in); arrays of the grid's points; out and in must not overlap. seen, if not NULL: every value was checked in the same loop and
 * is finite. */
int pm_operator_apply(const struct pm_operator *o, double factor, const double *const in[], double *const out[], bool *seen);

/* The largest absolute eigenvalue of lap, 1/length^2, where nothing is open: 4, 16/3, 272/45, pi^2 over h^2 times the sign of the term, summed over the
 * axes. */
double pm_operator_fastest(const struct pm_operator *o);

PM_C_END

#endif
