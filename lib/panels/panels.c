/* Boundary elements for the potential flow past closed curves. A flat panel from z1 to z2 = z1 + l exp(i theta) of constant strength has, in complex form,
 *     u - i v = sigma/(2 pi) exp(-i theta) ln((z - z1)/(z - z2))           sources sigma
 *     u - i v = gamma/(2 pi i) exp(-i theta) ln((z - z1)/(z - z2))         vortex sheet gamma
 * The equations of the second kind: nothing flows along the inside of a sheet (so nothing flows within, and gamma is the slip of the fluid outside); nothing
 * flows through the outside of sources. The first have a circulation that is free, and of the second the total flux is only nearly 0: both totals are
 * given, one row more for each curve, and the unknown of that row is a constant added to the curve's equations.
 * They hold for the mean over a panel, in closed form, so that the flow round and out of a closed curve is exact; at midpoints the order is 1.
 * Source: Martensen 1959, Arch. Ration. Mech. Anal. 3, 235 (sheet); Hess and Smith 1967, Prog. Aeronaut. Sci. 8, 1 (sources); Koumoutsakos and Leonard 1995,
 * J. Fluid Mech. 296, 1. Of order 2 in the length of the panels. SPDX-License-Identifier: GPL-3.0-or-later */
#include <complex.h>
#include <gsl/gsl_errno.h>
#include <gsl/gsl_linalg.h>
#include <string.h>

#include "panels/panels.h"

int pm_panels_measure(struct pm_panels *p)
{
	size_t first = 0;
	double area = 0, far = 0;
	p->curves = 0;
	for (size_t i = 0; i < p->n; i++) {
		const double x0 = p->corner[0][i], y0 = p->corner[1][i], dx = p->corner[2][i] - x0, dy = p->corner[3][i] - y0, l = hypot(dx, dy);
		if (!(l > 0))
			return pm_fail(PM_DATA, "panel %zu has the length %g (its two corners must differ)", i, l);
		p->length[i] = l;
		p->x[0][i] = x0 + 0.5 * dx, p->x[1][i] = y0 + 0.5 * dy;
		p->normal[0][i] = dy / l, p->normal[1][i] = -dx / l;
		p->curve[i] = p->curves;
		area += 0.5 * ((x0 - p->corner[0][first]) * dy - (y0 - p->corner[1][first]) * dx);
		far = fmax(far, fmax(l, hypot(x0 - p->corner[0][first], y0 - p->corner[1][first])));
		const size_t next = i + 1 < p->n ? i + 1 : first;
		if (hypot(p->corner[2][i] - p->corner[0][first], p->corner[3][i] - p->corner[1][first]) <= 1e-9 * far) { /* closed */
			if (i - first < 2)
				return pm_fail(PM_DATA, "a curve of %zu panels ends at panel %zu (a body needs 3)", i - first + 1, i);
			if (!(area > 0))
				return pm_fail(PM_DATA, "the curve that ends at panel %zu has the area %g (corners go round counter-clockwise)",
					i, area);
			p->curves++, first = i + 1, area = far = 0;
		} else if (next == first || hypot(p->corner[2][i] - p->corner[0][next], p->corner[3][i] - p->corner[1][next]) > 1e-9 * far) {
			return pm_fail(PM_DATA, "panel %zu ends where no panel begins (each at the next, the last of a curve at its first)", i);
		}
	}
	return p->n ? 0 : pm_fail(PM_DATA, "no panels (--curve, -n)");
}

/* The direction of a panel, exp(i theta). */
static double complex tangent(const struct pm_panels *p, size_t i) { return -p->normal[1][i] + I * p->normal[0][i]; }

/* Velocity of panel j of strength 1 at a point. */
static inline void induced(const struct pm_panels *p, size_t j, double x, double y, double u[2])
{
	const double ax = x - p->corner[0][j], ay = y - p->corner[1][j], bx = x - p->corner[2][j], by = y - p->corner[3][j];
	const double a2 = ax * ax + ay * ay, b2 = bx * bx + by * by;
	const double re = 0.5 * log(fmax(a2, 1e-300) / fmax(b2, 1e-300)), im = atan2(bx * ay - by * ax, bx * ax + by * ay);
	const double c = -p->normal[1][j], s = p->normal[0][j], w = 1 / (2 * pm_pi); /* of the tangent */
	const double along = w * (re * c + im * s), other = w * (im * c - re * s); /* exp(-i theta) (re + i im) */
	u[0] = p->source ? along : other; /* u - i v, over i for a sheet */
	u[1] = p->source ? -other : along;
}

/* z ln(q), 0 at z = 0. */
static double complex times_log(double complex z, double complex q) { return z == 0 ? 0 : z * clog(q); }

/* Mean velocity along panel i and out through it, of panel j of strength 1: the integral of (u - i v) dz over panel i from a to b,
 *     (b - z1) ln q(b) - (a - z1) ln q(a) + (z2 - z1) ln((b - z2)/(a - z2)),   q(z) = (z - z1)/(z - z2),
 * whose logarithms do not jump, because no panel crosses another. side: of the panel itself, +1 outside, -1 inside. */
static void mean(const struct pm_panels *p, size_t i, size_t j, int side, double *along, double *out)
{
	const double complex z1 = p->corner[0][j] + I * p->corner[1][j], z2 = p->corner[2][j] + I * p->corner[3][j];
	const double complex a = p->corner[0][i] + I * p->corner[1][i], b = p->corner[2][i] + I * p->corner[3][i];
	double complex sum;
	if (i == j)
		sum = I * side * pm_pi * tangent(p, i) * p->length[i];
	else if (cabs(a - z2) <= 1e-9 * p->length[i]) /* i follows j */
		sum = times_log(cabs(b - z1) <= 1e-9 * p->length[i] ? 0 : b - z1, (b - z1) / (b - z2)) + (z2 - z1) * clog((b - z2) / (z2 - z1));
	else
		sum = times_log(cabs(b - z1) <= 1e-9 * p->length[i] ? 0 : b - z1, (b - z1) / (b - z2)) - times_log(a - z1, (a - z1) / (a - z2)) +
			(z2 - z1) * clog((b - z2) / (a - z2));
	sum *= conj(tangent(p, j)) / (2 * pm_pi * p->length[i]) * (p->source ? 1 : -I);
	*along = creal(sum), *out = cimag(sum);
}

void pm_panels_along(const struct pm_panels *p, const double *strength, double *along)
{
#pragma omp parallel for schedule(static) if (p->n > 64)
	for (size_t i = 0; i < p->n; i++) {
		double sum = 0, one, out;
		for (size_t j = 0; j < p->n; j++) {
			mean(p, i, j, -1, &one, &out);
			sum += strength[j] * one;
		}
		along[i] += sum;
	}
}

void pm_panels_solver_free(struct pm_panels_solver *s)
{
	pm_free(s->key), pm_free(s->through);
	if (s->matrix)
		gsl_matrix_free(s->matrix);
	if (s->permutation)
		gsl_permutation_free(s->permutation);
	*s = (struct pm_panels_solver){0};
}

/* The component that vanishes: along the outer normal for sources, along the panel for a sheet. */
static void direction(const struct pm_panels *p, size_t i, double e[2])
{
	e[0] = p->source ? p->normal[0][i] : -p->normal[1][i];
	e[1] = p->source ? p->normal[1][i] : p->normal[0][i];
}

static void fill(const struct pm_panels *p, gsl_matrix *a, double *through)
{
	const size_t n = p->n;
	gsl_matrix_set_zero(a);
#pragma omp parallel for schedule(static) if (n > 64)
	for (size_t i = 0; i < n; i++) {
		double along, out;
		for (size_t j = 0; j < n; j++) {
			mean(p, i, j, p->source ? 1 : -1, &along, &out);
			gsl_matrix_set(a, i, j, p->source ? out : along);
			through[i * n + j] = out;
		}
		gsl_matrix_set(a, i, n + p->curve[i], 1);
		gsl_matrix_set(a, n + p->curve[i], i, p->length[i]);
	}
}

static int factor(const struct pm_panels *p, struct pm_panels_solver *s)
{
	const size_t n = p->n, m = n + p->curves;
	double *key = pm_alloc(4 * n + 1, sizeof *key), least = INFINITY, most = 0;
	int sign;
	if (!key)
		return -PM_DATA;
	for (int c = 0; c < 4; c++)
		memcpy(key + (size_t)c * n, p->corner[c], n * sizeof *key);
	key[4 * n] = p->source;
	if (s->n == n && s->key && !memcmp(s->key, key, (4 * n + 1) * sizeof *key)) {
		pm_free(key);
		return 0;
	}
	pm_panels_solver_free(s);
	*s = (struct pm_panels_solver){.n = n, .unknowns = m, .key = key, .matrix = gsl_matrix_alloc(m, m), .permutation = gsl_permutation_alloc(m),
		.through = pm_alloc(n * n, sizeof(double))};
	if (!s->matrix || !s->permutation || !s->through)
		return pm_fail(PM_DATA, "no memory for the dense equations of %zu panels (fewer panels)", n);
	fill(p, s->matrix, s->through);
	gsl_linalg_LU_decomp(s->matrix, s->permutation, &sign);
	for (size_t i = 0; i < m; i++)
		least = fmin(least, fabs(gsl_matrix_get(s->matrix, i, i))), most = fmax(most, fabs(gsl_matrix_get(s->matrix, i, i)));
	return least > 1e-13 * most ? 0 : pm_fail(PM_NUMERICS, "the equations of the panels are singular (a curve that touches itself or another)");
}

static double leak(const struct pm_panels *p, const struct pm_panels_flow *flow, const double *through, const double *strength)
{
	double most = 0;
#pragma omp parallel for schedule(static) reduction(max : most) if (p->n > 64)
	for (size_t i = 0; i < p->n; i++) {
		double sum = flow->u[0][i] * p->normal[0][i] + flow->u[1][i] * p->normal[1][i];
		for (size_t j = 0; j < p->n; j++)
			sum += strength[j] * through[i * p->n + j];
		most = fmax(most, fabs(sum));
	}
	return most;
}

int pm_panels_solve(const struct pm_panels *p, const struct pm_panels_flow *flow, struct pm_panels_solver *s, double *strength,
	struct pm_panels_solved *done)
{
	gsl_error_handler_t *handler = gsl_set_error_handler_off(); /* GSL's own aborts */
	const size_t n = p->n, m = n + p->curves;
	int status = factor(p, s);
	gsl_vector *v = status ? NULL : gsl_vector_alloc(m);
	if (!status && !v)
		status = pm_fail(PM_DATA, "no memory for %zu panels (fewer panels)", n);
	if (!status) {
		for (size_t i = 0; i < n; i++) {
			double e[2];
			direction(p, i, e);
			gsl_vector_set(v, i, -(flow->u[0][i] * e[0] + flow->u[1][i] * e[1]));
		}
		for (size_t k = n; k < m; k++)
			gsl_vector_set(v, k, flow->total[k - n]);
		gsl_linalg_LU_svx(s->matrix, s->permutation, v);
		for (size_t i = 0; i < n; i++)
			strength[i] = gsl_vector_get(v, i);
		done->slack = 0;
		for (size_t k = n; k < m; k++)
			done->slack = fmax(done->slack, fabs(gsl_vector_get(v, k)));
		done->leak = leak(p, flow, s->through, strength);
	} else {
		pm_panels_solver_free(s);
	}
	gsl_vector_free(v);
	gsl_set_error_handler(handler);
	return status;
}

void pm_panels_at(const struct pm_panels *p, const double *strength, size_t n, const double *const x[2], double *const u[2])
{
#pragma omp parallel for schedule(static) if (n * p->n > 4096)
	for (size_t i = 0; i < n; i++) {
		double sum[2] = {0}, v[2];
		for (size_t j = 0; j < p->n; j++) {
			induced(p, j, x[0][i], x[1][i], v);
			sum[0] += strength[j] * v[0], sum[1] += strength[j] * v[1];
		}
		u[0][i] += sum[0], u[1][i] += sum[1];
	}
}
