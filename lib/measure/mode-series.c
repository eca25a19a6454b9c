/* The amplitude of a wave on a mesh, and its values in time. Cost: points of the mesh; two numbers kept per frame.
 * SPDX-License-Identifier: GPL-3.0-or-later */
#include <stdlib.h>

#include "measure/growth.h"
#include "mesh/mesh-sum.h"
#include "world/world.h"

/* A row of a mesh times the wave along it, cos and -sin of n points. */
struct wave {
	const struct pm_grid *g;
	const double *values, *wave[2];
	size_t before; /* rows of the mesh before those here */
};

static void make(const void *data, size_t from, size_t to, void *part)
{
	const struct wave *w = data;
	const size_t n = to - from, row = w->before + from / n;
	const double weight = pm_grid_weight(w->g, 0, row % w->g->points[1], row / w->g->points[1]), *values = w->values + from;
	struct pm_sum *sum = part;
	for (size_t j = 0; j < n; j++)
		for (int k = 0; k < 2; k++)
			pm_sum_add(&sum[k], weight * values[j] * w->wave[k][j]);
}

int pm_mode(const struct pm_grid *g, const struct pm_field *field, const double *values, int m, double amplitude[2])
{
	const size_t n = g->points[0], rows = g->points[1] * g->points[2];
	struct pm_sum sum[2] = {{0, 0}};
	double *wave = pm_alloc(2 * n, sizeof *wave), weight = 0;
	if (field->here ? pm_world_agree(wave ? 0 : -PM_DATA) : !wave)
		return pm_free(wave), -PM_DATA;
	for (size_t j = 0; j < n; j++) {
		const double angle = 2 * pm_pi * (double)(((uint64_t)j * (uint64_t)m) % n) / (double)n;
		wave[j] = cos(angle), wave[n + j] = -sin(angle);
	}
	const struct pm_parts parts = {.size = sizeof sum, .make = make, .join = pm_join_sums};
	pm_grid_over(g, field, &parts, &(struct wave){g, values, {wave, wave + n}, pm_grid_rows_before(g, field)}, sum);
	for (size_t r = 0; r < rows; r++)
		weight += pm_grid_weight(g, 0, r % g->points[1], r / g->points[1]);
	for (int k = 0; k < 2; k++)
		amplitude[k] = 2 * pm_sum_total(sum[k]) / ((double)n * weight);
	pm_free(wave);
	return 0;
}

int pm_series_add(struct pm_series *s, double t, const double amplitude[2], double scale)
{
	if (!isfinite(amplitude[0]) || !isfinite(amplitude[1]) || (s->n && !(t > s->t[s->n - 1])))
		return 0;
	if (s->n == s->room) {
		const size_t room = s->room ? 2 * s->room : 256;
		double **const array[] = {&s->t, &s->re, &s->im};
		for (int i = 0; i < 3; i++) {
			double *more = realloc(*array[i], room * sizeof *more);
			if (!more)
				return pm_no_memory();
			*array[i] = more;
		}
		s->room = room;
	}
	s->t[s->n] = t, s->re[s->n] = amplitude[0], s->im[s->n] = amplitude[1];
	s->scale = fmax(s->scale, scale);
	s->n++;
	return 0;
}

void pm_series_release(struct pm_series *s)
{
	free(s->t), free(s->re), free(s->im);
	*s = (struct pm_series){0};
}
