/* Numbers on a plane. Of ranks each makes the rows of its planes; a projection along the divided axis goes from rank to rank.
 * SPDX-License-Identifier: GPL-3.0-or-later */
#include <string.h>

#include "measure/range.h"
#include "picture/raster.h"
#include "mesh/grid.h"
#include "mesh/index-fold.h"
#include "mesh/planes.h"
#include "world/world.h"

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

/* ---- a field that ranks share: a rank has consecutive planes of the last axis ---- */

/* Rows of the raster here, those of all ranks joined on rank 0. */
static int gather_rows(int status, struct pm_raster *r, size_t rows)
{
	void *all = NULL;
	size_t bytes = 0;
	status = pm_world_gather(status, r->value, rows * r->n[0] * sizeof *r->value, &all, &bytes);
	if (!status && all)
		memcpy(r->value, all, bytes);
	pm_free(all);
	return status;
}

struct slice {
	size_t stride[3], low, high;
	const struct pm_field *field;
	int component;
	double t;
};

/* Rows from..to-1 of those here. */
static void slice_rows(const struct pm_raster *r, const struct slice *s, size_t from, size_t to, double *value)
{
	for (size_t j = from; j < to; j++)
		for (size_t i = 0; i < r->n[0]; i++) {
			size_t p = i * s->stride[0] + j * s->stride[1];
			double a = pm_field_value(s->field, s->component, p + s->low * s->stride[2]),
				b = s->t > 0 ? pm_field_value(s->field, s->component, p + s->high * s->stride[2]) : a;
			value[i + j * r->n[0]] = (1 - s->t) * a + s->t * b;
		}
}

/* A plane of the divided axis, from the rank that has it, to all. */
static int share_plane(int status, const struct pm_raster *r, const struct pm_planes *p, const struct slice *s, size_t k, double *value)
{
	int root = 0;
	while (!status && p->from[root + 1] <= k)
		root++;
	if (!status && root == pm_world_rank())
		slice_rows(r, &(struct slice){.stride = {s->stride[0], s->stride[1], s->stride[2]}, .field = s->field, .component = s->component,
			.low = k - p->first}, 0, r->n[1], value);
	return pm_world_share(status, root, value, r->n[0] * r->n[1] * sizeof *value);
}

static int slice_ranks(struct pm_raster *r, const struct pm_grid *g, int axis, const struct slice *s)
{
	struct pm_planes p;
	const size_t n = r->n[0] * r->n[1];
	double *second = NULL;
	int status = pm_planes_init(&p, g, s->field);
	if (g->dim < 3 || axis < 2) {
		if (!status)
			slice_rows(r, s, 0, p.here, r->value);
		status = gather_rows(status, r, p.here);
	} else {
		second = pm_alloc(n + 1, sizeof *second);
		status = pm_world_agree(status ? status : second ? 0 : -PM_DATA);
		status = share_plane(status, r, &p, s, s->low, r->value);
		status = share_plane(status, r, &p, s, s->t > 0 ? s->high : s->low, second);
		for (size_t i = 0; i < n && !status; i++)
			r->value[i] = (1 - s->t) * r->value[i] + s->t * second[i];
	}
	pm_planes_free(&p), pm_free(second);
	return status;
}

struct ray {
	size_t stride[3], n;
	const struct pm_field *field;
	int component;
	double h;
	bool half; /* weights at the ends */
};

/* Adds points from..to-1 of a ray, of which the first here has number `first`. */
static void add_ray(const struct ray *a, size_t at, size_t first, size_t from, size_t to, struct pm_sum *sum)
{
	for (size_t k = from; k < to; k++) {
		bool end = a->half && (k == 0 || k == a->n - 1);
		pm_sum_add(sum, (end ? 0.5 : 1) * pm_field_value(a->field, a->component, at + (k - first) * a->stride[2]));
	}
}

static int project_rows(struct pm_raster *r, const struct ray *a, size_t rows)
{
	for (size_t j = 0; j < rows; j++)
		for (size_t i = 0; i < r->n[0]; i++) {
			struct pm_sum sum = {0, 0};
			add_ray(a, i * a->stride[0] + j * a->stride[1], 0, 0, a->n, &sum);
			r->value[i + j * r->n[0]] = pm_sum_total(sum) * a->h;
		}
	return 0;
}

/* Along the divided axis the sums go from rank to rank: planes are added in their order. */
static int project_ranks(struct pm_raster *r, const struct pm_grid *g, int axis, const struct ray *a)
{
	struct pm_planes p;
	const size_t n = r->n[0] * r->n[1], ranks = (size_t)pm_world_size(), me = (size_t)pm_world_rank();
	int status = pm_planes_init(&p, g, a->field);
	if (g->dim < 3 || axis < 2) {
		status = status ? status : project_rows(r, a, p.here);
		status = gather_rows(status, r, p.here);
		pm_planes_free(&p);
		return status;
	}
	struct pm_sum *sum = pm_zalloc(n + 1, sizeof *sum);
	size_t *bytes = pm_alloc(2 * ranks, sizeof *bytes);
	status = pm_world_agree(status ? status : sum && bytes ? 0 : -PM_DATA);
	for (size_t turn = 0; turn < ranks && !status; turn++) {
		void *came = NULL;
		if (turn == me)
			for (size_t i = 0; i < n; i++)
				add_ray(a, i % r->n[0] * a->stride[0] + i / r->n[0] * a->stride[1], p.first, p.first, p.first + p.here, &sum[i]);
		for (size_t q = 0; q < ranks; q++)
			bytes[q] = turn == me && q == (me + 1) % ranks ? n * sizeof *sum : 0; /* from the last one to rank 0 */
		status = pm_world_exchange(status, sum, bytes, &came, bytes + ranks);
		if (!status && me == (turn + 1) % ranks)
			memcpy(sum, came, n * sizeof *sum);
		pm_free(came);
	}
	for (size_t i = 0; i < n && !status; i++)
		r->value[i] = pm_sum_total(sum[i]) * a->h;
	pm_free(sum), pm_free(bytes), pm_planes_free(&p);
	return status;
}

int pm_raster_slice(struct pm_raster *r, const struct pm_frame *f, const struct pm_mesh *m, const struct pm_field *field, int component, int axis, double at)
{
	struct pm_grid g = pm_grid_of(f, m);
	size_t stride[3], low = 0, high = 0;
	double t = 0;
	int status = plane(r, &g, axis, stride);
	if ((status = field->here ? pm_world_agree(status) : status))
		return status;
	stagger(r, field, component, axis, g.dim);
	if (g.dim == 3) {
		double s = (at - g.lo[axis]) / g.h[axis] - (component >= 0 ? 0.5 * field->staggered[component][axis] : 0), last = (double)g.points[axis] - 1;
		bool periodic = g.face[axis][0] == PM_PERIODIC;
		s = periodic ? s - (last + 1) * floor(s / (last + 1)) : fmin(fmax(s, 0), last);
		low = (size_t)s < g.points[axis] ? (size_t)s : 0; /* s >= 0 */
		t = s - floor(s);
		high = pm_index_fold((ptrdiff_t)low + 1, g.points[axis], periodic);
	}
	struct slice s = {.stride = {stride[0], stride[1], stride[2]}, .field = field, .component = component, .low = low, .high = high, .t = t};
	return field->here ? slice_ranks(r, &g, axis, &s) : (slice_rows(r, &s, 0, r->n[1], r->value), 0);
}

int pm_raster_project(struct pm_raster *r, const struct pm_frame *f, const struct pm_mesh *m, const struct pm_field *field, int component, int axis)
{
	struct pm_grid g = pm_grid_of(f, m);
	size_t stride[3], n;
	int status = plane(r, &g, axis, stride);
	if ((status = field->here ? pm_world_agree(status) : status))
		return status;
	stagger(r, field, component, axis, g.dim);
	n = g.dim == 3 ? g.points[axis] : 1;
	const struct ray ray = {.stride = {stride[0], stride[1], stride[2]}, .field = field, .component = component, .n = n, .h = g.dim == 3 ? g.h[axis] : 1,
		.half = g.dim == 3 && g.face[axis][0] != PM_PERIODIC};
	return field->here ? project_ranks(r, &g, axis, &ray) : project_rows(r, &ray, r->n[1]);
}

/* The unit in which n weights are counted: all together are below 2^62 of it. */
static int quantum(int status, const struct pm_raster_points *points, double *unit)
{
	const size_t n = points->shared ? points->all : points->n;
	double most = points->w || !n ? 0 : 1;
	for (size_t p = 0; points->w && p < points->n; p++)
		most = fmax(most, fabs(points->w[p]));
	status = points->shared ? pm_world_largest(status, 1, &most) : status;
	*unit = most > 0 ? fmax(0x1p-1022, ldexp(1, ilogb(most) + 1 + ilogb((double)n) + 1 - 62)) : 1;
	return status;
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
	double unit = 1;
	int64_t *count = pm_zalloc(bins[0] * bins[1] + 1, sizeof *count); /* behind the bins: outside */
	r->value = pm_zalloc(bins[0] * bins[1], sizeof *r->value);
	int status = quantum(r->value && count ? 0 : -PM_DATA, points, &unit);
	for (size_t p = 0; p < points->n && !status; p++) {
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
	if (!status)
		count[bins[0] * bins[1]] = (int64_t)*outside;
	status = points->shared ? pm_world_count(status, PM_SUM_OF, bins[0] * bins[1] + 1, count) : status;
	for (size_t b = 0; b < bins[0] * bins[1] && !status; b++)
		r->value[b] = (double)count[b] * (unit / (r->h[0] * r->h[1]));
	if (!status)
		*outside = (size_t)count[bins[0] * bins[1]];
	pm_free(count);
	return status;
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
