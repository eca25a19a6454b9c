/* Boundary elements for the potential flow past closed surfaces. Triangle of corners a, b, c with the unit normal n and sources of strength sigma, at P:
 *     u = sigma/(4 pi) (Omega n + sum over edges of m L),   L = ln((r1 + r2 + l)/(r1 + r2 - l)),
 * Omega the solid angle (positive outside), m the unit vector in the plane out of an edge of length l, r1 and r2 the distances of its ends. From five sizes
 * away three points with a third of the strength each take its place, whose error is of order (size/distance)^3 of its share.
 * The mean flow through triangle i of triangle j is taken as that of all its sources at its centroid: the solid angle of i seen from there, so that the angles
 * of a closed surface add up to 4 pi and the totals are exact. That is an equation of the second kind; its totals are given, one row more a surface, and the
 * unknown of that row is a constant added to the surface's equations. Of order 2 in the edges away from the wall, 1 for the slip at the centroids.
 * Source: Hess and Smith 1967, Prog. Aeronaut. Sci. 8, 1; the angle: Van Oosterom and Strackee 1983, IEEE Trans. Biomed. Eng. 30, 125.
 * SPDX-License-Identifier: GPL-3.0-or-later */
#include <gsl/gsl_errno.h>
#include <gsl/gsl_linalg.h>
#include <stdlib.h>
#include <string.h>

#include "panels/triangles.h"

static const double far = 5; /* sizes */

static double dot(const double a[3], const double b[3]) { return a[0] * b[0] + a[1] * b[1] + a[2] * b[2]; }

static void cross(const double a[3], const double b[3], double to[3])
{
	to[0] = a[1] * b[2] - a[2] * b[1];
	to[1] = a[2] * b[0] - a[0] * b[2];
	to[2] = a[0] * b[1] - a[1] * b[0];
}

/* ---- geometry ---- */

/* A directed edge, by its ends; of the triangle's three. */
struct edge {
	double from[3], to[3];
	size_t triangle;
};

static int by_ends(const double a[3], const double b[3])
{
	for (int d = 0; d < 3; d++)
		if (a[d] != b[d])
			return a[d] < b[d] ? -1 : 1;
	return 0;
}

static int by_edge(const void *p, const void *q)
{
	const struct edge *a = p, *b = q;
	const int c = by_ends(a->from, b->from);
	return c ? c : by_ends(a->to, b->to);
}

static size_t root(size_t *parent, size_t i)
{
	while (parent[i] != i)
		i = parent[i] = parent[parent[i]];
	return i;
}

static struct edge edge_of(const struct pm_triangles *t, size_t i, int k)
{
	struct edge e = {.triangle = i};
	for (int d = 0; d < 3; d++) {
		e.from[d] = t->corner[3 * k + d][i] + 0.0; /* -0 is 0 */
		e.to[d] = t->corner[3 * ((k + 1) % 3) + d][i] + 0.0;
	}
	return e;
}

/* Every edge must be there once in each direction; triangles that share one are of the same surface. */
static int join(const struct pm_triangles *t, struct edge *all, size_t *parent)
{
	const size_t n = 3 * t->n;
	for (size_t i = 0; i < n; i++)
		all[i] = edge_of(t, i / 3, (int)(i % 3));
	qsort(all, n, sizeof *all, by_edge);
	for (size_t i = 0; i < n; i++) {
		struct edge back = {.triangle = 0};
		memcpy(back.from, all[i].to, sizeof back.from), memcpy(back.to, all[i].from, sizeof back.to);
		const struct edge *other = bsearch(&back, all, n, sizeof *all, by_edge);
		if (!other || (i && !by_edge(&all[i - 1], &all[i])))
			return pm_fail(PM_DATA, "triangle %zu has the edge from (%g, %g, %g) to (%g, %g, %g), %s (a closed surface has each edge once in each "
				"direction)", all[i].triangle, all[i].from[0], all[i].from[1], all[i].from[2], all[i].to[0], all[i].to[1], all[i].to[2],
				other ? "which another has too" : "which no other triangle has");
		parent[root(parent, all[i].triangle)] = root(parent, other->triangle);
	}
	return 0;
}

static int measure_one(struct pm_triangles *t, size_t i)
{
	double a[3], b[3], c[3], ab[3], ac[3], normal[3];
	for (int d = 0; d < 3; d++) {
		a[d] = t->corner[d][i], b[d] = t->corner[3 + d][i], c[d] = t->corner[6 + d][i];
		ab[d] = b[d] - a[d], ac[d] = c[d] - a[d];
		t->x[d][i] = (a[d] + b[d] + c[d]) / 3;
	}
	cross(ab, ac, normal);
	const double twice = sqrt(dot(normal, normal)), size2 = dot(ab, ab) + dot(ac, ac);
	if (!(twice > 1e-12 * size2))
		return pm_fail(PM_DATA, "triangle %zu has no area (its three corners lie on a line)", i);
	t->area[i] = 0.5 * twice;
	for (int d = 0; d < 3; d++)
		t->normal[d][i] = normal[d] / twice;
	return 0;
}

/* Numbers of the surfaces in the order of their first triangles, and their volumes. */
static int number(struct pm_triangles *t, size_t *parent, double *volume)
{
	size_t *name = pm_alloc(t->n + 1, sizeof *name);
	if (!name)
		return -PM_DATA;
	t->surfaces = 0;
	for (size_t i = 0; i < t->n; i++)
		if (root(parent, i) == i)
			name[i] = SIZE_MAX;
	for (size_t i = 0; i < t->n; i++) {
		const size_t r = root(parent, i);
		if (name[r] == SIZE_MAX)
			name[r] = t->surfaces++;
		t->surface[i] = name[r];
		const double x[3] = {t->x[0][i] - t->x[0][r], t->x[1][i] - t->x[1][r], t->x[2][i] - t->x[2][r]};
		const double normal[3] = {t->normal[0][i], t->normal[1][i], t->normal[2][i]};
		volume[t->surface[i]] += dot(x, normal) * t->area[i] / 3;
	}
	pm_free(name);
	for (size_t k = 0; k < t->surfaces; k++)
		if (!(volume[k] > 0))
			return pm_fail(PM_DATA, "surface %zu has the volume %g (corners go round counter-clockwise seen from outside)", k, volume[k]);
	return 0;
}

int pm_triangles_measure(struct pm_triangles *t)
{
	const size_t n = t->n;
	int status = n ? 0 : pm_fail(PM_DATA, "no panels (--surface, -n)");
	for (size_t i = 0; i < n && !status; i++)
		status = measure_one(t, i);
	if (status)
		return status;
	struct edge *all = pm_alloc(3 * n, sizeof *all);
	size_t *parent = pm_alloc(n, sizeof *parent);
	double *volume = pm_zalloc(n, sizeof *volume);
	status = all && parent && volume ? 0 : -PM_DATA;
	for (size_t i = 0; i < n && !status; i++)
		parent[i] = i;
	if (!status)
		status = join(t, all, parent);
	if (!status)
		status = number(t, parent, volume);
	pm_free(all), pm_free(parent), pm_free(volume);
	return status;
}

/* ---- the unit sphere ---- */

static const double golden = 1.6180339887498949;

/* A point of a face: weights i, j, k of its corners, whose sum is m, in an order that does not depend on the face, so that neighbours agree to the last bit. */
static void place(const double corner[3][3], const size_t weight[3], double to[3])
{
	int order[3] = {0, 1, 2};
	for (int a = 0; a < 2; a++)
		for (int b = 0; b < 2 - a; b++)
			if (by_ends(corner[order[b]], corner[order[b + 1]]) > 0) {
				const int keep = order[b];
				order[b] = order[b + 1], order[b + 1] = keep;
			}
	for (int d = 0; d < 3; d++) {
		to[d] = 0;
		for (int a = 0; a < 3; a++)
			to[d] += (double)weight[order[a]] * corner[order[a]][d];
	}
	const double r = sqrt(dot(to, to));
	for (int d = 0; d < 3; d++)
		to[d] /= r;
}

/* Corners with the weights k, i, j; the numbers of the triangles of the face go on from next. */
static void put_triangle(const double face[3][3], const size_t weights[3][3], size_t next, double *const to[9])
{
	for (int k = 0; k < 3; k++) {
		double p[3];
		place(face, weights[k], p);
		for (int d = 0; d < 3; d++)
			to[3 * k + d][next] = p[d];
	}
}

static void divide_face(const double face[3][3], size_t m, size_t next, double *const to[9])
{
	for (size_t i = 0; i < m; i++)
		for (size_t j = 0; i + j < m; j++) {
			const size_t k = m - i - j;
			put_triangle(face, (const size_t[3][3]){{k, i, j}, {k - 1, i + 1, j}, {k - 1, i, j + 1}}, next++, to);
			if (k >= 2)
				put_triangle(face, (const size_t[3][3]){{k - 1, i + 1, j}, {k - 2, i + 1, j + 1}, {k - 1, i, j + 1}}, next++, to);
		}
}

/* Whether a, b, c are neighbours, at the distance 2; face: they in the order that is counter-clockwise from outside. */
static bool is_face(const double a[3], const double b[3], const double c[3], double face[3][3])
{
	double ab[3], ac[3], bc[3], normal[3];
	for (int d = 0; d < 3; d++)
		ab[d] = b[d] - a[d], ac[d] = c[d] - a[d], bc[d] = c[d] - b[d];
	cross(ab, ac, normal);
	const bool turn = dot(normal, a) < 0;
	for (int d = 0; d < 3; d++)
		face[0][d] = a[d], face[1][d] = turn ? c[d] : b[d], face[2][d] = turn ? b[d] : c[d];
	return fabs(dot(ab, ab) - 4) < 1e-9 && fabs(dot(ac, ac) - 4) < 1e-9 && fabs(dot(bc, bc) - 4) < 1e-9;
}

void pm_triangles_sphere(size_t m, double *const corner[9])
{
	double v[12][3], face[3][3];
	size_t n = 0, next = 0;
	for (int axis = 0; axis < 3; axis++)
		for (int s = 0; s < 4; s++, n++) {
			v[n][axis] = 0;
			v[n][(axis + 1) % 3] = s & 1 ? 1 : -1;
			v[n][(axis + 2) % 3] = s & 2 ? golden : -golden;
		}
	for (int a = 0; a < 12; a++)
		for (int b = a + 1; b < 12; b++)
			for (int c = b + 1; c < 12; c++)
				if (is_face(v[a], v[b], v[c], face)) {
					divide_face(face, m, next, corner);
					next += m * m;
				}
}

/* ---- the flow ---- */

/* A triangle as it acts on points. */
struct source {
	double corner[3][3], normal[3], side[3][3], length[3]; /* side: the unit vector in the plane out of each edge */
	double x[3], area, far2;
};

static struct source source_of(const struct pm_triangles *t, size_t j)
{
	struct source s = {.area = t->area[j]};
	double size2 = 0;
	for (int d = 0; d < 3; d++) {
		s.normal[d] = t->normal[d][j], s.x[d] = t->x[d][j];
		for (int k = 0; k < 3; k++)
			s.corner[k][d] = t->corner[3 * k + d][j];
	}
	for (int k = 0; k < 3; k++) {
		double edge[3];
		for (int d = 0; d < 3; d++)
			edge[d] = s.corner[(k + 1) % 3][d] - s.corner[k][d];
		s.length[k] = sqrt(dot(edge, edge));
		size2 = fmax(size2, s.length[k] * s.length[k]);
		cross(edge, s.normal, s.side[k]);
		for (int d = 0; d < 3; d++)
			s.side[k][d] /= s.length[k];
	}
	s.far2 = far * far * size2;
	return s;
}

/* From the point: vectors from each corner, their lengths. */
static void arms(const struct source *s, const double p[3], double arm[3][3], double r[3])
{
	for (int k = 0; k < 3; k++) {
		for (int d = 0; d < 3; d++)
			arm[k][d] = p[d] - s->corner[k][d];
		r[k] = sqrt(dot(arm[k], arm[k]));
	}
}

static double angle(double arm[3][3], const double r[3])
{
	double c[3];
	cross(arm[1], arm[2], c);
	return 2 * atan2(dot(arm[0], c), r[0] * r[1] * r[2] + dot(arm[0], arm[1]) * r[2] + dot(arm[0], arm[2]) * r[1] + dot(arm[1], arm[2]) * r[0]);
}

/* (a . grad) of the solid angle and of the logarithm of an edge: the first is the flow of a vortex of strength -1 round the triangle. */
static double angle_change(const struct source *s, double arm[3][3], const double r[3], const double a[3])
{
	double sum = 0;
	for (int k = 0; k < 3; k++) {
		const int n = (k + 1) % 3;
		double edge[3], c[3];
		for (int d = 0; d < 3; d++)
			edge[d] = s->corner[n][d] - s->corner[k][d];
		cross(edge, arm[k], c);
		const double across2 = dot(c, c);
		if (across2 > 0)
			sum -= dot(c, a) / across2 * (dot(edge, arm[k]) / r[k] - dot(edge, arm[n]) / r[n]);
	}
	return sum;
}

static void near_by(const struct source *s, const double p[3], const double a[3], double u[3], double change[3])
{
	double arm[3][3], r[3];
	arms(s, p, arm, r);
	const double w = 1 / (4 * pm_pi), omega = angle(arm, r), turn = a ? angle_change(s, arm, r, a) : 0;
	for (int d = 0; d < 3; d++) {
		u[d] = w * omega * s->normal[d];
		change[d] = w * turn * s->normal[d];
	}
	for (int k = 0; k < 3; k++) {
		const int n = (k + 1) % 3;
		const double l = s->length[k], sum = r[k] + r[n], less = fmax(sum - l, 1e-15 * l), log_ = log((sum + l) / less);
		const double slope = a && r[k] > 0 && r[n] > 0 ? -2 * l / ((sum + l) * less) * (dot(arm[k], a) / r[k] + dot(arm[n], a) / r[n]) : 0;
		for (int d = 0; d < 3; d++) {
			u[d] += w * log_ * s->side[k][d];
			change[d] += w * slope * s->side[k][d];
		}
	}
}

/* Three points in the middle between centroid and corners: exact for sources up to the second moment. */
static void far_off(const struct source *s, const double p[3], const double a[3], double u[3], double change[3])
{
	for (int d = 0; d < 3; d++)
		u[d] = change[d] = 0;
	for (int k = 0; k < 3; k++) {
		double q[3];
		for (int d = 0; d < 3; d++)
			q[d] = p[d] - 0.5 * (s->x[d] + s->corner[k][d]);
		const double r2 = dot(q, q), w = s->area / (12 * pm_pi * r2 * sqrt(r2)), along = a ? 3 * dot(q, a) / r2 : 0;
		for (int d = 0; d < 3; d++) {
			u[d] += w * q[d];
			change[d] += a ? w * (a[d] - along * q[d]) : 0;
		}
	}
}

static void one_point(const struct source *all, size_t n, const double *strength, const struct pm_triangles_at *at, size_t i)
{
	const double p[3] = {at->x[0][i], at->x[1][i], at->x[2][i]};
	double a[3] = {0}, sum[3] = {0}, more[3] = {0};
	const bool change = at->change[0];
	for (int d = 0; d < 3 && change; d++)
		a[d] = at->alpha[d][i];
	for (size_t j = 0; j < n; j++) {
		const double away[3] = {p[0] - all[j].x[0], p[1] - all[j].x[1], p[2] - all[j].x[2]};
		double u[3], g[3];
		(dot(away, away) > all[j].far2 ? far_off : near_by)(&all[j], p, change ? a : NULL, u, g);
		for (int d = 0; d < 3; d++)
			sum[d] += strength[j] * u[d], more[d] += strength[j] * g[d];
	}
	for (int d = 0; d < 3; d++) {
		at->u[d][i] += sum[d];
		if (change)
			at->change[d][i] += more[d];
	}
}

int pm_triangles_at(const struct pm_triangles *t, const double *strength, const struct pm_triangles_at *at)
{
	struct source *all = pm_alloc(t->n + 1, sizeof *all);
	if (!all)
		return -PM_DATA;
	for (size_t j = 0; j < t->n; j++)
		all[j] = source_of(t, j);
#pragma omp parallel for schedule(static) if (at->n * t->n > 4096)
	for (size_t i = 0; i < at->n; i++)
		one_point(all, t->n, strength, at, i);
	pm_free(all);
	return 0;
}

/* ---- the equations ---- */

/* Mean flow out through triangle i of triangle j of strength 1. */
static double through(const struct source *i, const struct source *j, bool same)
{
	double arm[3][3], r[3];
	if (same)
		return 0.5;
	arms(i, j->x, arm, r);
	return -j->area * angle(arm, r) / (4 * pm_pi * i->area);
}

static int factor(const struct pm_triangles *t, struct pm_panels_solver *s)
{
	const size_t n = t->n, m = n + t->surfaces;
	double *key = pm_alloc(9 * n + 1, sizeof *key), least = INFINITY, most = 0;
	int sign;
	if (!key)
		return -PM_DATA;
	for (int c = 0; c < 9; c++)
		memcpy(key + (size_t)c * n, t->corner[c], n * sizeof *key);
	if (s->n == n && s->key && !memcmp(s->key, key, 9 * n * sizeof *key)) {
		pm_free(key);
		return 0;
	}
	pm_panels_solver_free(s);
	*s = (struct pm_panels_solver){.n = n, .unknowns = m, .key = key, .matrix = gsl_matrix_calloc(m, m), .permutation = gsl_permutation_alloc(m),
		.through = pm_alloc(n * n, sizeof(double))};
	struct source *all = pm_alloc(n, sizeof *all);
	if (!s->matrix || !s->permutation || !s->through || !all) {
		pm_free(all);
		return pm_fail(PM_DATA, "no memory for the dense equations of %zu panels (fewer panels)", n);
	}
	for (size_t i = 0; i < n; i++)
		all[i] = source_of(t, i);
#pragma omp parallel for schedule(static) if (n > 64)
	for (size_t i = 0; i < n; i++) {
		for (size_t j = 0; j < n; j++) {
			s->through[i * n + j] = through(&all[i], &all[j], i == j);
			gsl_matrix_set(s->matrix, i, j, s->through[i * n + j]);
		}
		gsl_matrix_set(s->matrix, i, n + t->surface[i], 1);
		gsl_matrix_set(s->matrix, n + t->surface[i], i, t->area[i]);
	}
	pm_free(all);
	gsl_linalg_LU_decomp(s->matrix, s->permutation, &sign);
	for (size_t i = 0; i < m; i++)
		least = fmin(least, fabs(gsl_matrix_get(s->matrix, i, i))), most = fmax(most, fabs(gsl_matrix_get(s->matrix, i, i)));
	return least > 1e-13 * most ? 0 : pm_fail(PM_NUMERICS, "the equations of the panels are singular (a surface that touches itself or another)");
}

int pm_triangles_solve(const struct pm_triangles *t, const double *normal, const double *total, struct pm_panels_solver *s, double *strength,
	struct pm_panels_solved *done)
{
	gsl_error_handler_t *handler = gsl_set_error_handler_off(); /* GSL's own aborts */
	const size_t n = t->n, m = n + t->surfaces;
	int status = factor(t, s);
	gsl_vector *v = status ? NULL : gsl_vector_alloc(m);
	if (!status && !v)
		status = pm_fail(PM_DATA, "no memory for %zu panels (fewer panels)", n);
	for (size_t i = 0; i < m && !status; i++)
		gsl_vector_set(v, i, i < n ? -normal[i] : total[i - n]);
	if (!status) {
		gsl_linalg_LU_svx(s->matrix, s->permutation, v);
		done->slack = done->leak = 0;
		for (size_t i = 0; i < n; i++)
			strength[i] = gsl_vector_get(v, i);
		for (size_t k = n; k < m; k++)
			done->slack = fmax(done->slack, fabs(gsl_vector_get(v, k)));
		for (size_t i = 0; i < n; i++) {
			double sum = normal[i];
			for (size_t j = 0; j < n; j++)
				sum += strength[j] * s->through[i * n + j];
			done->leak = fmax(done->leak, fabs(sum));
		}
	} else {
		pm_panels_solver_free(s);
	}
	gsl_vector_free(v);
	gsl_set_error_handler(handler);
	return status;
}
