/* The region where a level is below 0. Cells that the interface crosses are divided into smaller ones, in each of which the level is linear; there the
 * step of width w = |d phi/dx| + |d phi/dy| + ... of a small cell gives the volume, and a hat of half width w the interface: of planes along small cells, too,
 * wherever between their centres they lie, to the last bit; the derivative of the step would count those on faces of small cells twice or not at all.
 * Source: Engquist, Tornberg and Tsai 2005, J. Comput. Phys. 207, 28 (that width makes the sums consistent). Cost: points of the mesh, and 64 times the
 * cells crossed. SPDX-License-Identifier: GPL-3.0-or-later */
#include "level/level.h"
#include "transfer/transfer.h"
#include "world/world.h"

enum { CORNERS = 8 };

int pm_level_on_mesh(const struct pm_grid *g, const struct pm_planes *planes, size_t n, const double *const x[], const double *volume, const double *level,
	double *node)
{
	const size_t points = planes->here * planes->size;
	const struct pm_transfer t = {.grid = *g, .kernel = pm_kernel_find("m4prime"), .components = 2, .cut = true, .planes = planes};
	struct pm_strays strays;
	double *q = pm_alloc(n + 1, sizeof *q), *cover = pm_alloc(points + 1, sizeof *cover);
	int status = pm_planes_agree(q && cover ? 0 : -PM_DATA, planes);
	for (size_t p = 0; p < n && !status; p++)
		q[p] = volume[p] * level[p];
	for (size_t i = 0; i < points && !status; i++)
		node[i] = cover[i] = 0;
	if (!status)
		status = pm_spread(&t, n, x, (const double *const[]){q, volume}, (double *const[]){node, cover}, &strays);
	for (size_t i = 0; i < points && !status; i++)
		node[i] = cover[i] < 0.1 ? NAN : node[i] / cover[i]; /* the density of a full lattice is 1 */
	pm_free(q), pm_free(cover);
	return status;
}

/* Of a cell the corners, x fastest; false: one of them has no level. c counts from the planes here, behind which those of the next rank follow. */
static bool corners(const struct pm_grid *g, const struct pm_planes *planes, const double *phi, const size_t c[3], double v[CORNERS])
{
	bool all = true;
	for (int k = 0; k < 1 << g->dim; k++) {
		size_t at = 0, stride = 1;
		for (int d = 0; d < g->dim; d++) {
			const size_t i = c[d] + (k >> d & 1);
			at += stride * (planes->divided && d > 0 && d == planes->axis ? i : i % g->points[d]);
			stride *= g->points[d];
		}
		v[k] = phi[at];
		all = all && !isnan(v[k]);
	}
	return all;
}

/* Linear along each axis, at s in the unit cell, with its derivatives by s. */
static double between(int dim, const double v[CORNERS], const double s[3], double slope[3])
{
	double value = 0;
	slope[0] = slope[1] = slope[2] = 0;
	for (int k = 0; k < 1 << dim; k++) {
		double w = v[k], by[3] = {v[k], v[k], v[k]};
		for (int d = 0; d < dim; d++) {
			const double one = k >> d & 1 ? s[d] : 1 - s[d];
			w *= one;
			for (int e = 0; e < dim; e++)
				by[e] *= e == d ? (k >> d & 1 ? 1 : -1) : one;
		}
		value += w;
		for (int d = 0; d < dim; d++)
			slope[d] += by[d];
	}
	return value;
}

static void of_cell(const struct pm_grid *g, const double a[CORNERS], const double *b, double sum[3])
{
	const int parts = g->dim == 3 ? 4 : g->dim == 2 ? 8 : 64;
	const double small = pow(parts, -g->dim);
	const int n[3] = {parts, g->dim > 1 ? parts : 1, g->dim > 2 ? parts : 1};
	double negative = 0, unlike = 0, da[3], db[3], nearest = HUGE_VAL, low = HUGE_VAL, high = -HUGE_VAL;
	for (int k = 0; k < 1 << g->dim; k++) {
		negative += a[k] < 0;
		nearest = fmin(nearest, fabs(a[k])), low = fmin(low, a[k]), high = fmax(high, a[k]);
		unlike += b && (b[k] < 0) != (a[0] < 0);
	}
	const bool beside = nearest * parts < high - low; /* of an interface in the next cell, whose hat reaches into this one */
	if ((negative == 0 || negative == 1 << g->dim) && unlike == 0 && !beside) {
		sum[0] += negative > 0;
		return;
	}
	for (int k = 0; k < n[2]; k++)
		for (int j = 0; j < n[1]; j++)
			for (int i = 0; i < n[0]; i++) {
				const double s[3] = {(i + 0.5) / parts, (j + 0.5) / parts, (k + 0.5) / parts};
				const double phi = between(g->dim, a, s, da);
				double width = 0, slope = 0;
				for (int d = 0; d < g->dim; d++) {
					width += fabs(da[d]) / parts;
					slope += da[d] * da[d] / (g->h[d] * g->h[d]);
				}
				const double step = width > 0 ? 0.5 - phi / width : phi < 0;
				sum[0] += small * fmin(fmax(step, 0), 1);
				if (fabs(phi) < width)
					sum[1] += small * sqrt(slope) / width * (1 - fabs(phi) / width);
				if (b && (between(g->dim, b, s, db) < 0) != (phi < 0))
					sum[2] += small;
			}
}

/* Rows of cells whose first plane is here. */
static size_t rows_here(const struct pm_grid *g, const struct pm_planes *p)
{
	const size_t cells = g->cells[p->axis], end = p->first + p->here;
	if (!p->axis || !p->divided)
		return p->here ? g->cells[1] * g->cells[2] : 0;
	return end > p->first && p->first < cells ? ((end < cells ? end : cells) - p->first) * (p->axis == 2 ? g->cells[1] : 1) : 0;
}

/* The sum over the rows of all ranks, in their order. */
static int sum_rows(int status, const struct pm_planes *p, size_t rows, const double *row, double *sum)
{
	void *all = NULL;
	size_t bytes = rows * sizeof *row;
	if (p->divided)
		status = pm_world_gather(status, row, bytes, &all, &bytes);
	*sum = status ? NAN : pm_sum_array(bytes / sizeof *row, p->divided ? all : row);
	pm_free(all);
	return p->divided ? pm_world_share(status, 0, sum, sizeof *sum) : status;
}

int pm_level_measure(const struct pm_grid *g, const struct pm_planes *planes, const double *a, const double *b, struct pm_level_measures *m)
{
	const size_t rows = rows_here(g, planes);
	const double cell = pm_grid_cell(g), *level[2] = {a, b};
	double *row = pm_alloc(3 * rows + 1, sizeof *row), *room = NULL, sums[3];
	int status = row ? 0 : -PM_DATA;
	if (planes->divided)
		status = pm_planes_halo(status, planes, 1, b ? 2 : 1, (const double *const[]){a, b}, level, &room);
#pragma omp parallel for schedule(static)
	for (size_t r = 0; r < (status ? 0 : rows); r++) {
		double sum[3] = {0}, va[CORNERS], vb[CORNERS];
		for (size_t i = 0; i < g->cells[0]; i++) {
			const size_t c[3] = {i, r % g->cells[1], r / g->cells[1]};
			if (corners(g, planes, level[0], c, va) && (!b || corners(g, planes, level[1], c, vb)))
				of_cell(g, va, b ? vb : NULL, sum);
		}
		for (int k = 0; k < 3; k++)
			row[(size_t)k * rows + r] = sum[k];
	}
	for (int k = 0; k < 3; k++)
		status = sum_rows(status, planes, rows, row ? row + (size_t)k * rows : NULL, &sums[k]);
	*m = (struct pm_level_measures){.inside = cell * sums[0], .interface = cell * sums[1], .difference = b ? cell * sums[2] : NAN};
	pm_free(row), pm_free(room);
	return status;
}
