/* A mesh in one dimension: its line has no neighbours to fill the lanes of a block, so it is taken apart itself (fft/long-line.c), as a periodic one of
 * length N with the images of its nodes: odd ones at walls and even ones at neumann faces (N = 2n), where one is opposite the other with the sign that both
 * give after 2n (4n), zeros behind open faces (2n, with images at the other end 4n). Images stay images, since the multipliers are even.
 * Cost: N log N of full lanes, a twentieth of the time of the passes. For N a multiple of 16, from 64 on. SPDX-License-Identifier: GPL-3.0-or-later */
#include <string.h>

#include "poisson-fft/fft-passes.h"

static bool walled(const struct pm_transform *l) { return l->face[0] == PM_WALL || l->face[1] == PM_WALL; }
static bool opens(const struct pm_transform *l) { return l->face[0] == PM_OPEN || l->face[1] == PM_OPEN; }

size_t pm_fft_single_length(const struct pm_poisson_fft *p)
{
	const struct pm_transform *l = &p->line[X];
	const size_t n = l->shifted ? 2 * l->length : l->length;
	return p->grid.dim == 1 && !p->empty && pm_long_line_suits(n) ? n : 0;
}

int pm_fft_single_init(struct pm_poisson_fft *p)
{
	const struct pm_transform *l = &p->line[X];
	const size_t n = pm_fft_single_length(p), step = l->shifted ? 2 : 1, first = l->shifted ? 1 : p->complex ? 0 : l->least;
	double *mode = pm_alloc(pm_poisson_fft_multipliers(p), sizeof *mode), *u = pm_zalloc(n / 2 + 1, sizeof *u);
	p->nodes_of_line = pm_alloc(n, sizeof *p->nodes_of_line);
	int status = mode && u && p->nodes_of_line ? 0 : -PM_DATA;
	if (!status) {
		pm_poisson_fft_multipliers_of_row(p, mode);
		for (size_t i = 0; i < p->modes[X]; i++)
			u[first + i * step] = mode[i];
		status = pm_long_line_init(&p->planner, n, u, &p->across);
	}
	pm_free(mode), pm_free(u);
	return status;
}

/* Nodes to a line with its images. */
static void fill(const struct pm_transform *l, const double *s, double *x)
{
	const size_t end = l->row + l->count, both = l->face[0] == PM_OPEN && l->face[1] == PM_OPEN, half = both ? l->length : l->length / 2;
	memcpy(x + l->row, s + l->first, l->count * sizeof *x);
	if (l->face[0] == PM_PERIODIC)
		return;
	memset(x, 0, l->row * sizeof *x);
	if (end < half)
		memset(x + end, 0, (half - end) * sizeof *x);
	if (l->face[0] == PM_OPEN) /* half weight, as in every sum over a mesh */
		x[l->row] *= 0.5;
	if (l->face[1] == PM_OPEN)
		x[end - 1] *= 0.5;
	if (both)
		return;
	const bool odd = opens(l) ? walled(l) : l->face[1] == PM_WALL;
	if (odd || end <= half)
		x[half] = 0;
	for (size_t i = 1; i < half; i++)
		x[l->length - i] = odd ? -x[i] : x[i];
	for (size_t i = 0; i < l->length && l->shifted; i++)
		x[l->length + i] = -x[i];
}

double pm_fft_single_solve(struct pm_poisson_fft *p, double factor, const double *s, double *phi)
{
	const struct pm_transform *l = &p->line[X];
	double *x = p->nodes_of_line;
	fill(l, s, x);
	const double largest = p->singular ? pm_poisson_fft_largest(x, p->across.n / L) : 0;
	p->zero = pm_long_line_times(&p->across, factor, x);
	memcpy(phi + l->first, x + l->row, l->count * sizeof *phi);
	if (l->face[0] == PM_WALL)
		phi[0] = 0;
	if (l->face[1] == PM_WALL)
		phi[l->n] = 0;
	return largest;
}
