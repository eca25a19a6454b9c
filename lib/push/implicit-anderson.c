/* The equation of an implicit step without a Jacobian: the last changes of Y and of the residual R = base + part dt k(Y) - Y say what the inverse
 * Jacobian does on the space they span, and the least residual in it is the next Y.
 * Source: Anderson 1965, J. ACM 12, 547, with up to 6 columns; for a linear rate the iterates are those of GMRES (Walker and Ni 2011).
 * Cost per pass: the registers twice through memory; six columns, 27 sums.
 * SPDX-License-Identifier: GPL-3.0-or-later */
#include "push/implicit-step.h"
#include "stream/over-stretches.h"

enum { RESIDUAL = PM_IMPLICIT_RESIDUAL, DEPTH = PM_IMPLICIT_DEPTH, STEPS = PM_IMPLICIT_OWN, CHANGES = STEPS + DEPTH };

static const double dependent = 1e-14; /* square of the sine of the angle below which a column says nothing new: rounding of the products */

/* The slot of the j-th newest column. */
static int slot(const struct pm_iterate *it, int j) { return (it->number - 2 - j + 2 * DEPTH) % DEPTH; }

/* Changes that are known. */
static int columns(const struct pm_iterate *it) { return it->number - 1 < DEPTH ? it->number - 1 : DEPTH; }

/* gamma minimises |r - sum gamma_j c_j|^2, from the products g_ij = c_i c_j, b_j = c_j r: Cholesky, newest column first, without dependent ones. */
static void least(int m, double g[DEPTH][DEPTH], const double b[DEPTH], double gamma[DEPTH])
{
	double l[DEPTH][DEPTH] = {{0}}, z[DEPTH];
	for (int j = 0; j < m; j++) {
		double d = g[j][j];
		z[j] = b[j];
		for (int k = 0; k < j; k++) {
			double sum = g[j][k];
			for (int q = 0; q < k; q++)
				sum -= l[j][q] * l[k][q];
			l[j][k] = l[k][k] > 0 ? sum / l[k][k] : 0;
			d -= l[j][k] * l[j][k];
			z[j] -= l[j][k] * z[k];
		}
		l[j][j] = d > dependent * g[j][j] ? sqrt(d) : 0;
		z[j] = l[j][j] > 0 ? z[j] / l[j][j] : 0;
	}
	for (int j = m - 1; j >= 0; j--) {
		double sum = z[j];
		for (int k = j + 1; k < m; k++)
			sum -= l[k][j] * gamma[k];
		gamma[j] = l[j][j] > 0 ? sum / l[j][j] : 0;
	}
}

/* The next trial of one value: gamma[j] of each column. */
static inline void next(const struct pm_iterate *it, const struct pm_decided_line *l, double damp, const double gamma[DEPTH], size_t i)
{
	double step = damp * l->q[RESIDUAL][i];
	for (int j = 0; j < columns(it); j++)
		step -= gamma[j] * (l->q[STEPS + slot(it, j)][i] + damp * l->q[CHANGES + slot(it, j)][i]);
	l->q[STEPS + (it->number - 1) % DEPTH][i] = step;
	l->q[PM_IMPLICIT_TRIAL][i] += step;
}

/* Over all ranks. */
static double product(const struct pm_decided_line *l, int a, int b)
{
	struct pm_sum sum = {0, 0};
	pm_sum_of_stretches(l->rate->state, l->q[a], l->q[b], &sum);
	return pm_sum_total(sum);
}

/* All values of all lines, with one set of coefficients. */
static void together(struct pm_iterate *it)
{
	double g[DEPTH][DEPTH] = {{0}}, b[DEPTH] = {0}, gamma[DEPTH] = {0};
	for (int k = 0; k < it->lines; k++) {
		const struct pm_decided_line *l = it->line + k;
		for (int i = 0; i < columns(it); i++) {
			b[i] += it->weight[k] * product(l, CHANGES + slot(it, i), RESIDUAL);
			for (int j = 0; j <= i; j++)
				g[i][j] += it->weight[k] * product(l, CHANGES + slot(it, i), CHANGES + slot(it, j));
		}
	}
	least(columns(it), g, b, gamma);
	for (int k = 0; k < it->lines; k++) {
		const struct pm_decided_line *l = it->line + k;
#pragma omp parallel for schedule(static) if (l->n > 16384)
		for (size_t i = 0; i < l->n; i++)
			next(it, l, it->damp[k], gamma, i);
	}
}

/* Each particle with its own; lines from..to-1 belong to one set. */
static void apart(struct pm_iterate *it, int from, int to)
{
	const size_t n = it->line[from].n;
#pragma omp parallel for schedule(static) if (n > 4096)
	for (size_t p = 0; p < n; p++) {
		double g[DEPTH][DEPTH] = {{0}}, b[DEPTH] = {0}, gamma[DEPTH] = {0};
		for (int k = from; k < to; k++) {
			double *const *q = it->line[k].q;
			for (int i = 0; i < columns(it); i++) {
				const double c = it->weight[k] * q[CHANGES + slot(it, i)][p];
				b[i] += c * q[RESIDUAL][p];
				for (int j = 0; j <= i; j++)
					g[i][j] += c * q[CHANGES + slot(it, j)][p];
			}
		}
		least(columns(it), g, b, gamma);
		for (int k = from; k < to; k++)
			next(it, it->line + k, it->damp[k], gamma, p);
	}
}

void pm_anderson_residual(struct pm_iterate *it)
{
	for (int k = 0; k < it->lines && it->number > 1; k++) {
		const struct pm_decided_line *l = it->line + k;
		const double h = it->dt * it->scheme->part, *base = l->q[PM_IMPLICIT_BASE], *trial = l->q[PM_IMPLICIT_TRIAL];
		double *restrict change = l->q[CHANGES + slot(it, 0)];
#pragma omp parallel for schedule(static) if (l->n > 16384)
		for (size_t i = 0; i < l->n; i++)
			change[i] = base[i] + h * l->k[i] - trial[i] - l->q[RESIDUAL][i];
	}
}

void pm_anderson_correct(struct pm_iterate *it, bool own)
{
	if (!own)
		together(it);
	for (int from = 0; from < it->lines && own; from = pm_iterate_set(it, from))
		apart(it, from, pm_iterate_set(it, from));
}
