/* Eddy viscosities nu_t of scales below the mesh, of the filter width D, from a_ij = du_i/dx_j, S = (a + a^T)/2:
 *   smagorinsky  nu_t = (C D)^2 sqrt(2 S:S), C = 0.17 (Smagorinsky 1963; Lilly 1967)
 *   dynamic      the same, C^2 = <L:M>/<M:M> over the box, at least 0, L_ij = [u_i u_j] - [u_i][u_j], M_ij = 2 D^2 ([|S| S_ij] - 6 |[S]| [S_ij]),
 *                [] the filter (1, 2, 1)/4 along every axis, whose second moment is that of a box sqrt(6) times as wide as a cell's
 *                (Germano et al. 1991, Phys. Fluids A 3, 1760; Lilly 1992, Phys. Fluids A 4, 633)
 *   wale         nu_t = (C D)^2 (Z:Z)^(3/2)/((S:S)^(5/2) + (Z:Z)^(5/4)), C = 0.5, Z the symmetric part of a a without trace (Nicoud, Ducros 1999,
 *                Flow Turb. Combust. 62, 183): 0 in pure shear
 *   vreman       nu_t = c D^2 sqrt(B/(a:a)), c = 0.07, B the sum of the principal 2 by 2 minors of a a^T (Vreman 2004, Phys. Fluids 16, 3670): 0 in shear
 * In the plane the third row and column are 0. Cost: pointwise; dynamic 21 filterings in space. SPDX-License-Identifier: GPL-3.0-or-later */
#include <math.h>
#include <string.h>

#include "mesh/mesh-sum.h"
#include "mesh/smooth.h"
#include "vorticity/eddy-viscosity.h"

const char *const pm_eddy_names[] = {"smagorinsky", "dynamic", "wale", "vreman", "hyper", NULL};

double pm_eddy_factor(enum pm_eddy_model m, double coefficient)
{
	const double published[] = {0.17, 0.17, 0.5, 0.07, 0.17}, c = isnan(coefficient) ? published[m] : coefficient;
	return m == PM_EDDY_VREMAN ? c : c * c;
}

static double strain(const double a[3][3])
{
	double sum = 0;
	for (int i = 0; i < 3; i++)
		for (int j = 0; j < 3; j++)
			sum += 0.25 * (a[i][j] + a[j][i]) * (a[i][j] + a[j][i]);
	return sum;
}

static double smagorinsky(const double a[3][3]) { return sqrt(2 * strain(a)); }

static double wale(const double a[3][3])
{
	double square[3][3], z = 0;
	for (int i = 0; i < 3; i++)
		for (int j = 0; j < 3; j++)
			square[i][j] = a[i][0] * a[0][j] + a[i][1] * a[1][j] + a[i][2] * a[2][j];
	const double third = (square[0][0] + square[1][1] + square[2][2]) / 3;
	for (int i = 0; i < 3; i++)
		for (int j = 0; j < 3; j++) {
			const double part = 0.5 * (square[i][j] + square[j][i]) - (i == j ? third : 0);
			z += part * part;
		}
	const double below = pow(strain(a), 2.5) + pow(z, 1.25);
	return below > 0 ? pow(z, 1.5) / below : 0;
}

static double vreman(const double a[3][3])
{
	double b[3][3], all = 0, minors = 0;
	for (int i = 0; i < 3; i++)
		for (int j = 0; j < 3; j++) {
			/* du_i/dx_m du_j/dx_m: Vreman's beta, his alpha_mi being our a_im */
			b[i][j] = a[i][0] * a[j][0] + a[i][1] * a[j][1] + a[i][2] * a[j][2];
			all += a[i][j] * a[i][j];
		}
	for (int i = 0; i < 3; i++) {
		const int j = (i + 1) % 3;
		minors += b[i][i] * b[j][j] - b[i][j] * b[i][j];
	}
	return all > 0 && minors > 0 ? sqrt(minors / all) : 0;
}

void pm_eddy_rate(enum pm_eddy_model m, int dim, size_t n, const double *a, double *out)
{
	double (*const rate)(const double[3][3]) = m == PM_EDDY_WALE ? wale : m == PM_EDDY_VREMAN ? vreman : smagorinsky;
#pragma omp parallel for schedule(static) num_threads(pm_threads()) if (n > 16384)
	for (size_t p = 0; p < n; p++) {
		double here[3][3] = {{0}};
		for (int i = 0; i < dim; i++)
			for (int j = 0; j < dim; j++)
				here[i][j] = a[(size_t)(i * dim + j) * n + p];
		out[p] = rate(here);
	}
}

/* to = the filter of x y, or of x where y is NULL */
static int filtered(const struct pm_grid *g, const struct pm_planes *p, size_t n, const double *x, const double *y, double *to, double *work)
{
	for (size_t i = 0; i < n; i++)
		to[i] = y ? x[i] * y[i] : x[i];
	return pm_smooth(0, g, p, 1, false, to, work);
}

/* The arrays of the dynamic model, n each: filtered strains, their |S|, filtered velocities, one strain, L, M and room. */
struct filter {
	double *strain[6], *size, *u[3], *one, *l, *m, *work;
};
enum { FILTERED = 14 };

static void strain_of(const double *a, int dim, size_t n, int i, int j, double *to)
{
	const double *up = a + (size_t)(i * dim + j) * n, *down = a + (size_t)(j * dim + i) * n;
	for (size_t p = 0; p < n; p++)
		to[p] = 0.5 * (up[p] + down[p]);
}

static int filters(const struct pm_grid *g, const struct pm_planes *planes, const double *const u[3], const double *a, const struct filter *w)
{
	const size_t n = pm_grid_size(g);
	int status = 0, pair = 0;
	memset(w->size, 0, n * sizeof *w->size);
	for (int i = 0; i < g->dim && !status; i++)
		status = filtered(g, planes, n, u[i], NULL, w->u[i], w->work);
	for (int i = 0; i < g->dim; i++)
		for (int j = i; j < g->dim && !status; j++, pair++) {
			strain_of(a, g->dim, n, i, j, w->strain[pair]);
			status = pm_smooth(0, g, planes, 1, false, w->strain[pair], w->work);
			for (size_t p = 0; p < n; p++)
				w->size[p] += (i == j ? 2 : 4) * w->strain[pair][p] * w->strain[pair][p];
		}
	for (size_t p = 0; p < n; p++)
		w->size[p] = sqrt(w->size[p]);
	return status;
}

int pm_eddy_dynamic(const struct pm_grid *g, const struct pm_field *here, const double *const u[3], const double *a, const double *rate, double *factor)
{
	const size_t n = pm_grid_size(g);
	double *room = pm_alloc(FILTERED * n, sizeof *room), lm = 0, mm = 0, width = 1;
	struct pm_planes planes = {0};
	struct filter w = {.size = room + 6 * n, .u = {room + 7 * n, room + 8 * n, room + 9 * n}, .one = room + 10 * n, .l = room + 11 * n,
		.m = room + 12 * n, .work = room + 13 * n};
	for (int k = 0; k < 6; k++)
		w.strain[k] = room + (size_t)k * n;
	int status = room ? pm_planes_init(&planes, g, here) : -PM_DATA, pair = 0;
	status = status ? status : filters(g, &planes, u, a, &w);
	for (int d = 0; d < g->dim; d++)
		width *= g->h[d];
	width = pow(width, 2.0 / g->dim);
	for (int i = 0; i < g->dim; i++)
		for (int j = i; j < g->dim && !status; j++, pair++) {
			strain_of(a, g->dim, n, i, j, w.one);
			status = filtered(g, &planes, n, u[i], u[j], w.l, w.work);
			status = status ? status : filtered(g, &planes, n, rate, w.one, w.m, w.work);
			for (size_t p = 0; p < n; p++) {
				w.l[p] -= w.u[i][p] * w.u[j][p];
				w.m[p] = 2 * width * (w.m[p] - 6 * w.size[p] * w.strain[pair][p]);
			}
			lm += (i == j ? 1 : 2) * pm_grid_sum(g, w.l, w.m);
			mm += (i == j ? 1 : 2) * pm_grid_sum(g, w.m, w.m);
		}
	*factor = mm > 0 ? lm / mm : 0;
	pm_planes_free(&planes);
	pm_free(room);
	return status;
}
