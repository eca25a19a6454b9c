/* Numbers on a plane. SPDX-License-Identifier: GPL-3.0-or-later */
#include "measure/range.h"
#include "picture/raster.h"
#include "mesh/grid.h"
#include "mesh/index-fold.h"

void pm_raster_free(struct pm_raster *r) { r->value = pm_free(r->value); }

/* The plane across `axis` of a mesh (1-D: one row), and the strides of its two axes and of the third in the mesh. */
static int plane(struct pm_raster *r, const struct pm_grid *g, int axis, size_t stride[3])
{
	const size_t s[3] = {1, g->points[0], g->points[0] * g->points[1]};
	int across[2] = {axis == 0 ? 1 : 0, axis == 2 ? 1 : 2};
	if (g->dim < 3)
		across[0] = 0, across[1] = 1;
	for (int k = 0; k < 2; k++) {
		int a = across[k];
		r->n[k] = g->points[a], r->lo[k] = g->lo[a], r->h[k] = g->h[a];
		r->wrap[k] = a < g->dim && g->face[a][0] == PM_PERIODIC;
		stride[k] = s[a];
	}
	stride[2] = g->dim < 3 ? 0 : s[axis];
	r->value = pm_zalloc(r->n[0] * r->n[1], sizeof *r->value);
	return r->value ? 0 : -PM_DATA;
}

static void stagger(struct pm_raster *r, const struct pm_field *field, int component, int axis, int dim)
{
	int across[2] = {dim == 3 && axis == 0 ? 1 : 0, dim == 3 && axis == 2 ? 1 : dim == 3 ? 2 : 1};
	for (int k = 0; component >= 0 && k < 2; k++)
		r->lo[k] += 0.5 * field->staggered[component][across[k]] * r->h[k];
}

int pm_raster_slice(struct pm_raster *r, const struct pm_frame *f, const struct pm_mesh *m, const struct pm_field *field, int component, int axis, double at)
{
	struct pm_grid g = pm_grid_of(f, m);
	size_t stride[3], low = 0, high = 0;
	double t = 0;
	if (plane(r, &g, axis, stride))
		return -PM_DATA;
	stagger(r, field, component, axis, g.dim);
	if (g.dim == 3) {
		double s = (at - g.lo[axis]) / g.h[axis] - (component >= 0 ? 0.5 * field->staggered[component][axis] : 0), last = (double)g.points[axis] - 1;
		bool periodic = g.face[axis][0] == PM_PERIODIC;
		s = periodic ? s - (last + 1) * floor(s / (last + 1)) : fmin(fmax(s, 0), last);
		low = (size_t)s < g.points[axis] ? (size_t)s : 0; /* s >= 0 */
		t = s - floor(s);
		high = pm_index_fold((ptrdiff_t)low + 1, g.points[axis], periodic);
	}
	for (size_t j = 0; j < r->n[1]; j++)
		for (size_t i = 0; i < r->n[0]; i++) {
			size_t p = i * stride[0] + j * stride[1];
			double a = pm_field_value(field, component, p + low * stride[2]),
				b = t > 0 ? pm_field_value(field, component, p + high * stride[2]) : a;
			r->value[i + j * r->n[0]] = (1 - t) * a + t * b;
		}
	return 0;
}

int pm_raster_project(struct pm_raster *r, const struct pm_frame *f, const struct pm_mesh *m, const struct pm_field *field, int component, int axis)
{
	struct pm_grid g = pm_grid_of(f, m);
	size_t stride[3], n;
	if (plane(r, &g, axis, stride))
		return -PM_DATA;
	stagger(r, field, component, axis, g.dim);
	n = g.dim == 3 ? g.points[axis] : 1;
	for (size_t j = 0; j < r->n[1]; j++)
		for (size_t i = 0; i < r->n[0]; i++) {
			struct pm_sum sum = {0, 0};
			for (size_t k = 0; k < n; k++) {
				bool end = g.dim == 3 && g.face[axis][0] != PM_PERIODIC && (k == 0 || k == n - 1);
				pm_sum_add(&sum, (end ? 0.5 : 1) * pm_field_value(field, component, i * stride[0] + j * stride[1] + k * stride[2]));
			}
			r->value[i + j * r->n[0]] = pm_sum_total(sum) * (g.dim == 3 ? g.h[axis] : 1);
		}
	return 0;
}

/* The unit in which n weights are counted: all together are below 2^62 of it. */
static double quantum(const struct pm_raster_points *points)
{
	double most = points->w || !points->n ? 0 : 1;
	for (size_t p = 0; points->w && p < points->n; p++)
		most = fmax(most, fabs(points->w[p]));
	return most > 0 ? fmax(0x1p-1022, ldexp(1, ilogb(most) + 1 + ilogb((double)points->n) + 1 - 62)) : 1;
}

/* Weights are counted as integers, so the order of the points does not matter. */
int pm_raster_density(struct pm_raster *r, const size_t bins[2], const double lo[2], const double hi[2], const struct pm_raster_points *points, size_t *outside)
{
	const double *x = points->x, *y = points->y, *w = points->w;
	*outside = 0;
	for (int k = 0; k < 2; k++) {
		r->n[k] = bins[k], r->h[k] = (hi[k] - lo[k]) / (double)bins[k];
		r->lo[k] = lo[k] + r->h[k] / 2, r->wrap[k] = false;
	}
	const double unit = quantum(points);
	int64_t *count = pm_zalloc(bins[0] * bins[1], sizeof *count);
	r->value = pm_zalloc(bins[0] * bins[1], sizeof *r->value);
	if (!r->value || !count) {
		pm_free(count);
		return -PM_DATA;
	}
	for (size_t p = 0; p < points->n; p++) {
		double s[2] = {(x[p] - r->lo[0]) / r->h[0], (y[p] - r->lo[1]) / r->h[1]}, value = (w ? w[p] : 1) / unit;
		if (!(x[p] >= lo[0] && x[p] <= hi[0] && y[p] >= lo[1] && y[p] <= hi[1])) {
			++*outside;
			continue;
		}
		for (int b = 0; b < 2; b++)
			for (int a = 0; a < 2; a++) {
				double i = floor(s[0]) + a, j = floor(s[1]) + b, share = (1 - fabs(s[0] - i)) * (1 - fabs(s[1] - j));
				/* A point at the edge goes fully into the last bin. */
				i = fmin(fmax(i, 0), (double)bins[0] - 1), j = fmin(fmax(j, 0), (double)bins[1] - 1);
				count[(size_t)i + (size_t)j * bins[0]] += llrint(share * value);
			}
	}
	for (size_t b = 0; b < bins[0] * bins[1]; b++)
		r->value[b] = (double)count[b] * (unit / (r->h[0] * r->h[1]));
	pm_free(count);
	return 0;
}

/* 1-2-1 filter along a line of n values; at the ends the outer weight is added to the end value, so the sum is kept. */
static void smooth_line(size_t n, size_t stride, double *v, double *line)
{
	for (size_t i = 0; i < n; i++)
		line[i] = v[i * stride];
	for (size_t i = 0; i < n; i++)
		v[i * stride] = 0.5 * line[i] + 0.25 * (line[i ? i - 1 : 0] + line[i + 1 < n ? i + 1 : i]);
}

int pm_raster_smooth(struct pm_raster *r)
{
	double *line = pm_alloc(r->n[0] + r->n[1], sizeof *line);
	if (!line)
		return -PM_DATA;
	for (size_t j = 0; j < r->n[1]; j++)
		smooth_line(r->n[0], 1, r->value + j * r->n[0], line);
	for (size_t i = 0; i < r->n[0]; i++)
		smooth_line(r->n[1], r->n[0], r->value + i, line);
	pm_free(line);
	return 0;
}

/* The two nodes around x along axis k, and the weight of the second. */
static double nodes(const struct pm_raster *r, int k, double x, size_t at[2])
{
	double s = (x - r->lo[k]) / r->h[k], n = (double)r->n[k];
	if (r->wrap[k]) {
		s -= n * floor(s / n);
		at[0] = s < n ? (size_t)s : 0;
		at[1] = (at[0] + 1) % r->n[k];
		return s - floor(s);
	}
	s = fmin(fmax(s, 0), n - 1);
	at[0] = (size_t)s;
	at[1] = at[0] + 1 < r->n[k] ? at[0] + 1 : at[0];
	return s - floor(s);
}

double pm_raster_at(const struct pm_raster *r, double x, double y)
{
	size_t i[2], j[2];
	double s = nodes(r, 0, x, i), t = nodes(r, 1, y, j);
	const double *v = r->value;
	return (1 - t) * ((1 - s) * v[i[0] + j[0] * r->n[0]] + s * v[i[1] + j[0] * r->n[0]]) +
		t * ((1 - s) * v[i[0] + j[1] * r->n[0]] + s * v[i[1] + j[1] * r->n[0]]);
}
