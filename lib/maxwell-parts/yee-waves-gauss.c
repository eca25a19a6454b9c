/* Gauss's law with the derivatives of waves (yee-waves.h) in place of two-point differences. Cost: five transforms, and seven to correct.
 * SPDX-License-Identifier: GPL-3.0-or-later */
#include <string.h>

#include "maxwell-parts/yee-waves.h"
#include "stream/declare.h"

enum { C = PM_WAVES_CHUNK };

/* Frequencies of eight waves: eight of x, one of y and z. */
struct waves {
	const struct pm_yee_waves *w;
	const double *re[3], *im[3];
	size_t at;
	bool shortest; /* left out: fields on the nodes do not have it */
};

static void each(const struct pm_yee_waves *w, void (*act)(const struct waves *e, size_t q))
{
	const struct pm_wave_axis *a = w->axis;
	for (size_t k = 0; k < a[2].n; k++)
		for (size_t j = w->y[0]; j < w->y[1]; j++)
			for (size_t i = w->chunk[0] * C; i < w->chunk[1] * C && i < a[0].modes; i++) {
				const struct waves e = {.w = w, .re = {a[0].re + i, a[1].re + j, a[2].re + k}, .im = {a[0].im + i, a[1].im + j, a[2].im + k},
					.at = pm_yee_waves_at(w, i / C, j, k), .shortest = pm_yee_waves_shortest(w, i, j, k)};
				act(&e, i % C);
			}
}

/* field 0 = -conj D . (fields 0 to 2), less field 3. */
static void divergence(const struct waves *e, size_t q)
{
	double re = 0, im = 0;
	for (int d = 0; d < 3; d++) {
		const double *f = e->w->field[d] + e->at + q, dr = *e->re[d], di = *e->im[d];
		re += -dr * f[0] - di * f[C];
		im += di * f[0] - dr * f[C];
	}
	double *to = e->w->field[0] + e->at + q;
	if (e->shortest) {
		to[0] = to[C] = 0;
		return;
	}
	to[0] = (re - (e->w->field[3] ? e->w->field[3][e->at + q] : 0)) * e->w->norm;
	to[C] = (im - (e->w->field[3] ? e->w->field[3][e->at + C + q] : 0)) * e->w->norm;
}

/* fields 0 to 2 = D field 0/(D.-conj D). */
static void gradient(const struct waves *e, size_t q)
{
	double k2 = 0;
	double *const f = e->w->field[0] + e->at + q, re = f[0], im = f[C];
	for (int d = 0; d < 3; d++)
		k2 += *e->re[d] * *e->re[d] + *e->im[d] * *e->im[d];
	for (int d = 0; d < 3; d++) {
		double *to = e->w->field[d] + e->at + q;
		const double s = k2 > 0 ? -e->w->norm / k2 : 0;
		to[0] = s * (*e->re[d] * re - *e->im[d] * im);
		to[C] = s * (*e->re[d] * im + *e->im[d] * re);
	}
}

bool pm_yee_spectral(const struct pm_field *e)
{
	const char *differences = json_string_value(json_object_get(e->more, PM_DIFFERENCES));
	return differences && !strcmp(differences, "spectral");
}

static size_t points_of(const struct pm_yee *y) { return y->planes ? y->planes->here * y->planes->size : pm_grid_size(&y->grid); }

int pm_yee_waves_divergence(const struct pm_yee *y, const double *rho, double *to)
{
	struct pm_yee_waves w;
	int status = pm_yee_waves_init(&w, y, rho ? 4 : 3);
	for (int c = 0; c < 3; c++)
		status = pm_yee_waves_forward(status, &w, y->e[c], c);
	if (rho) {
		for (size_t i = 0; i < points_of(y); i++)
			to[i] = rho[i] / y->eps0;
		status = pm_yee_waves_forward(status, &w, to, 3);
	}
	if (!status)
		each(&w, divergence);
	status = pm_yee_waves_backward(status, &w, 0, to);
	pm_yee_waves_free(&w);
	return status;
}

int pm_yee_waves_correct(const struct pm_yee *y, const double *residual)
{
	struct pm_yee_waves w;
	const size_t n = points_of(y);
	double *room = pm_alloc(n + 1, sizeof *room);
	int status = pm_yee_waves_init(&w, y, 3);
	status = pm_planes_agree(status ? status : room ? 0 : pm_failed(), y->planes);
	status = pm_yee_waves_forward(status, &w, residual, 0);
	for (int d = 1; d < 3 && y->planes && !status; d++)
		status = (w.field[d] = pm_alloc(w.size + 1, sizeof *room)) ? 0 : pm_failed();
	status = pm_planes_agree(status, y->planes);
	if (!status)
		each(&w, gradient);
	for (int c = 0; c < 3; c++) {
		status = pm_yee_waves_backward(status, &w, c, room);
		for (size_t i = 0; i < n && !status; i++)
			y->e[c][i] -= room[i];
	}
	pm_yee_waves_free(&w);
	pm_free(room);
	return status;
}
