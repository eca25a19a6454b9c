/* The amplitude of a wave on a mesh, and its values in time. Cost: points of the mesh; two numbers kept per frame.
 * SPDX-License-Identifier: GPL-3.0-or-later */
#include <stdlib.h>

#include "measure/growth.h"

void pm_mode(const struct pm_grid *g, const double *values, int m, double amplitude[2])
{
	const size_t n = g->points[0], rows = g->points[1] * g->points[2];
	struct pm_sum re = {0}, im = {0};
	for (size_t j = 0; j < n; j++) {
		const double angle = 2 * pm_pi * (double)(((uint64_t)j * (uint64_t)m) % n) / (double)n;
		struct pm_sum row = {0};
		for (size_t r = 0; r < rows; r++)
			pm_sum_add(&row, pm_grid_weight(g, j, r % g->points[1], r / g->points[1]) * values[r * n + j]);
		pm_sum_add(&re, pm_sum_total(row) * cos(angle));
		pm_sum_add(&im, -pm_sum_total(row) * sin(angle));
	}
	double weight = 0;
	for (size_t r = 0; r < rows; r++)
		weight += pm_grid_weight(g, 0, r % g->points[1], r / g->points[1]);
	amplitude[0] = 2 * pm_sum_total(re) / ((double)n * weight);
	amplitude[1] = 2 * pm_sum_total(im) / ((double)n * weight);
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
