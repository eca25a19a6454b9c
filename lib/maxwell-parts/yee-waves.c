/* Transforms of a real field along x (two rows as one complex line, fft/fft-block.h), then along y and z, eight frequencies of x side by side.
 * Cost: N log N, one field of n/2 + 1 complex frequencies. SPDX-License-Identifier: GPL-3.0-or-later */
#include <omp.h>
#include <string.h>

#include "maxwell-parts/yee-waves.h"

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

int pm_yee_waves_init(struct pm_yee_waves *w, const struct pm_yee *y, int fields)
{
	const struct pm_grid *g = &y->grid;
	size_t all = 0;
	*w = (struct pm_yee_waves){.plans = pm_fft_plans_new(), .nodal = y->nodal, .norm = 1};
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
	w->size = w->axis[2].n * w->axis[1].n * w->chunks * L;
	w->scratch = pm_alloc((size_t)pm_threads() * w->lot, sizeof *w->scratch);
	w->tables = pm_zalloc(TABLES * all, sizeof *w->tables);
	double *at = w->tables;
	for (int d = 0; d < 3 && at; at += TABLES * w->axis[d++].modes) {
		struct pm_wave_axis *a = &w->axis[d];
		a->re = at, a->im = at + a->modes, a->k = at + 2 * a->modes, a->ratio = at + 3 * a->modes;
		a->turn[0] = at + 4 * a->modes, a->turn[1] = at + 5 * a->modes;
		fill_axis(a, g->h[d], pm_yee_varies(g, d), y->nodal);
	}
	for (int i = 0; i < fields && at; i++)
		if (!(w->field[i] = pm_alloc(w->size, sizeof **w->field)))
			return -PM_DATA;
	return at && w->scratch ? 0 : -PM_DATA;
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
		pm_spectra_in(a->fft, count, (const double *const *)wave, block);
		pm_fft_backward(a->fft, block);
		pm_fft_rows_out(block, NULL, a->n, count, point);
		return;
	}
	pm_fft_rows_in((const double *const *)point, count, a->n, NULL, block);
	pm_fft_forward(a->fft, block);
	pm_spectra_out(a->fft, block, count, wave);
}

static void along_x(const struct pm_yee_waves *w, bool back, double *points, double *waves)
{
	const size_t all = w->axis[1].n * w->axis[2].n, groups = (all + L - 1) / L;
#pragma omp parallel for schedule(static) num_threads(pm_threads()) if (w->size > 8192)
	for (size_t i = 0; i < groups; i++) {
		double *block = w->scratch + (size_t)omp_get_thread_num() * w->lot;
		rows(w, i * L, all - i * L < L ? all - i * L : L, back, points, waves, block);
	}
}

/* Lines along y or z in place: of each, eight frequencies of x at a time. */
static void along(const struct pm_yee_waves *w, int d, bool back, double *waves)
{
	const struct pm_wave_axis *a = &w->axis[d];
	const size_t row = w->chunks * L, step = d == 1 ? row : row * w->axis[1].n, lines = w->chunks * w->axis[3 - d].n;
	if (a->n == 1)
		return;
#pragma omp parallel for schedule(static) num_threads(pm_threads()) if (w->size > 8192)
	for (size_t i = 0; i < lines; i++) {
		double *block = w->scratch + (size_t)omp_get_thread_num() * w->lot;
		double *first = waves + i / w->chunks * (d == 1 ? row * a->n : row) + i % w->chunks * L;
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

void pm_yee_waves_forward(const struct pm_yee_waves *w, const double *from, int to)
{
	along_x(w, false, (double *)from, w->field[to]);
	along(w, 1, false, w->field[to]);
	along(w, 2, false, w->field[to]);
}

void pm_yee_waves_backward(const struct pm_yee_waves *w, int from, double *to)
{
	along(w, 2, true, w->field[from]);
	along(w, 1, true, w->field[from]);
	along_x(w, true, to, w->field[from]);
}
