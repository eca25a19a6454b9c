/* Transforms of a real field along x (two rows as one complex line, fft/fft-block.h), then along y and z, eight frequencies of x side by side.
 * Ranks transform their planes, in 2-D rows, along the axes in them; one exchange brings whole lines of the last axis together, one takes them back.
 * Cost: N log N, one field of n/2 + 1 complex frequencies. SPDX-License-Identifier: GPL-3.0-or-later */
#include <omp.h>
#include <string.h>

#include "maxwell-parts/yee-waves.h"
#include "world/world.h"

enum { L = PM_FFT_LINES, TABLES = 6 };

static void fill_axis(struct pm_wave_axis *a, double h, bool varies, bool nodal)
{
	for (size_t m = 0; m < a->modes && varies; m++) {
		const double turn = 2 * m > a->n ? -(double)(a->n - m) : (double)m, k = 2 * pm_pi * turn / ((double)a->n * h);
		double c, s;
		pm_fft_circle(2 * m > a->n ? a->n - m : m, 2 * a->n, &c, &s); /* of |k| h/2 */
		a->k[m] = 2 * m == a->n ? 0 : k;
		a->re[m] = nodal ? 0 : -fabs(k) * s;
		a->im[m] = nodal ? a->k[m] : k * c;
		a->turn[0][m] = c;
		a->turn[1][m] = k > 0 ? -s : s;
		a->ratio[m] = m ? s / (fabs(k) * h / 2) : 1;
	}
	for (size_t m = 0; m < a->modes && !varies; m++)
		a->ratio[m] = a->turn[0][m] = 1;
}

/* What is here, of all ranks the columns that pm_planes_turn gives this one. */
static void divide(struct pm_yee_waves *w, const struct pm_planes *planes, int dim)
{
	const size_t ranks = (size_t)pm_world_size(), me = (size_t)pm_world_rank();
	w->y[1] = w->axis[1].n, w->chunk[1] = w->chunks;
	if (planes) {
		size_t *range = dim == 3 ? w->y : w->chunk, all = range[1];
		w->planes = *planes;
		w->planes.points[0] = w->chunks * L;
		w->planes.size = w->chunks * L * (dim == 3 ? w->axis[1].n : 1);
		range[0] = all * me / ranks, range[1] = all * (me + 1) / ranks;
	}
	w->size = w->axis[2].n * (w->y[1] - w->y[0]) * (w->chunk[1] - w->chunk[0]) * L;
}

static int fill(struct pm_yee_waves *w, const struct pm_yee *y, int fields)
{
	const struct pm_grid *g = &y->grid;
	size_t all = 0;
	for (int d = 0; d < 3; d++) {
		struct pm_wave_axis *a = &w->axis[d];
		a->n = g->points[d];
		a->modes = d ? a->n : a->n / 2 + 1;
		a->fft = w->plans ? pm_fft(w->plans, a->n) : NULL;
		if (!a->fft)
			return -PM_DATA;
		all += a->modes;
		w->norm /= (double)a->n;
		w->lot = a->n * L > w->lot ? a->n * L : w->lot;
	}
	w->chunks = (w->axis[0].modes + PM_WAVES_CHUNK - 1) / PM_WAVES_CHUNK;
	divide(w, y->planes, g->dim);
	w->scratch = pm_alloc((size_t)pm_threads() * w->lot, sizeof *w->scratch);
	w->tables = pm_zalloc(TABLES * all, sizeof *w->tables);
	double *at = w->tables;
	for (int d = 0; d < 3 && at; at += TABLES * w->axis[d++].modes) {
		struct pm_wave_axis *a = &w->axis[d];
		a->re = at, a->im = at + a->modes, a->k = at + 2 * a->modes, a->ratio = at + 3 * a->modes;
		a->turn[0] = at + 4 * a->modes, a->turn[1] = at + 5 * a->modes;
		fill_axis(a, g->h[d], pm_yee_varies(g, d), y->nodal);
	}
	for (int i = 0; i < fields && at && !y->planes; i++) /* of several ranks they come with the exchange */
		if (!(w->field[i] = pm_alloc(w->size, sizeof **w->field)))
			return -PM_DATA;
	return at && w->scratch ? 0 : -PM_DATA;
}

int pm_yee_waves_init(struct pm_yee_waves *w, const struct pm_yee *y, int fields)
{
	*w = (struct pm_yee_waves){.plans = pm_fft_plans_new(), .nodal = y->nodal, .norm = 1};
	return pm_planes_agree(fill(w, y, fields), y->planes);
}

void pm_yee_waves_free(struct pm_yee_waves *w)
{
	for (int i = 0; i < PM_WAVES_MOST; i++)
		pm_free(w->field[i]);
	pm_free(w->tables);
	pm_free(w->scratch);
	pm_fft_plans_free(w->plans);
	*w = (struct pm_yee_waves){.norm = 1};
}

/* One block of rows along x, from points to frequencies or back. */
static void rows(const struct pm_yee_waves *w, size_t first, size_t count, bool back, double *points, double *waves, double *block)
{
	const struct pm_wave_axis *a = &w->axis[0];
	double *point[L], *wave[L];
	for (size_t r = 0; r < count; r++)
		point[r] = points + (first + r) * a->n, wave[r] = waves + (first + r) * w->chunks * L;
	if (back) {
		pm_spectra_in(a->fft, count, (const double *const *)wave, false, block);
		pm_fft_backward(a->fft, block);
		pm_fft_rows_out(block, NULL, a->n, count, point);
		return;
	}
	pm_fft_rows_in((const double *const *)point, count, a->n, NULL, block);
	pm_fft_forward(a->fft, block);
	pm_spectra_out(a->fft, block, count, false, wave);
}

/* So many planes of rows; no block has rows of two planes. */
static void along_x(const struct pm_yee_waves *w, bool back, size_t planes, size_t in_plane, double *points, double *waves)
{
	const size_t groups = (in_plane + L - 1) / L;
#pragma omp parallel for schedule(static) num_threads(pm_threads()) if (planes * in_plane * w->axis[0].n > 4096)
	for (size_t i = 0; i < planes * groups; i++) {
		double *block = w->scratch + (size_t)omp_get_thread_num() * w->lot;
		const size_t first = i % groups * L, left = in_plane - first;
		rows(w, i / groups * in_plane + first, left < L ? left : L, back, points, waves, block);
	}
}

/* Lines along y or z in place, of so many chunks of n_y rows and, along y, of so many planes: of each, eight frequencies of x at a time. */
static void along(const struct pm_yee_waves *w, int d, bool back, size_t chunks, size_t n_y, size_t planes, double *waves)
{
	const struct pm_wave_axis *a = &w->axis[d];
	const size_t row = chunks * L, step = d == 1 ? row : row * n_y, lines = chunks * (d == 1 ? planes : n_y);
	if (a->n == 1)
		return;
#pragma omp parallel for schedule(static) num_threads(pm_threads()) if (lines * a->n * L > 8192)
	for (size_t i = 0; i < lines; i++) {
		double *block = w->scratch + (size_t)omp_get_thread_num() * w->lot;
		double *first = waves + i / chunks * (d == 1 ? row * a->n : row) + i % chunks * L;
		for (size_t j = 0; j < a->n; j++)
			memcpy(block + (back ? a->fft->at[j] : j) * L, first + j * step, L * sizeof *block);
		if (back)
			pm_fft_backward(a->fft, block);
		else
			pm_fft_forward(a->fft, block);
		for (size_t j = 0; j < a->n; j++)
			memcpy(first + j * step, block + (back ? j : a->fft->at[j]) * L, L * sizeof *block);
	}
}

/* The axes in a plane, of what is here before it is exchanged. */
static void in_planes(const struct pm_yee_waves *w, bool back, double *points, double *waves)
{
	const struct pm_planes *p = &w->planes;
	const bool rows_alone = p->divided && p->axis == 1;
	const size_t planes = rows_alone ? 1 : p->divided ? p->here : w->axis[2].n, in_plane = rows_alone ? p->here : w->axis[1].n;
	if (!back)
		along_x(w, false, planes, in_plane, points, waves);
	if (!rows_alone)
		along(w, 1, back, w->chunks, w->axis[1].n, planes, waves);
	if (back)
		along_x(w, true, planes, in_plane, points, waves);
}

/* The last axis, of whole lines. */
static void across_planes(const struct pm_yee_waves *w, bool back, double *waves)
{
	const int d = w->planes.divided && w->planes.axis == 1 ? 1 : 2;
	along(w, d, back, w->chunk[1] - w->chunk[0], w->y[1] - w->y[0], w->axis[2].n, waves);
}

int pm_yee_waves_forward(int status, struct pm_yee_waves *w, const double *from, int to)
{
	const struct pm_planes *p = &w->planes;
	size_t columns;
	if (!p->divided) {
		if (!status)
			in_planes(w, false, (double *)from, w->field[to]), across_planes(w, false, w->field[to]);
		return status;
	}
	double *waves = status ? NULL : pm_alloc(p->here * p->size + 1, sizeof *waves);
	status = status ? status : waves ? 0 : pm_failed();
	if (!status)
		in_planes(w, false, (double *)from, waves);
	w->field[to] = pm_free(w->field[to]);
	status = pm_planes_turn(status, p, waves, &w->field[to], &columns);
	pm_free(waves);
	if (!status)
		across_planes(w, false, w->field[to]);
	return status;
}

int pm_yee_waves_backward(int status, struct pm_yee_waves *w, int from, double *to)
{
	const struct pm_planes *p = &w->planes;
	if (!status)
		across_planes(w, true, w->field[from]);
	if (!p->divided) {
		if (!status)
			in_planes(w, true, to, w->field[from]);
		return status;
	}
	double *waves = status ? NULL : pm_alloc(p->here * p->size + 1, sizeof *waves);
	status = pm_planes_turn_back(status ? status : waves ? 0 : pm_failed(), p, &w->field[from], waves);
	if (!status)
		in_planes(w, true, to, waves);
	pm_free(waves);
	return status;
}
