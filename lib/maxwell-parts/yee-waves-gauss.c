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
	for (size_t row = 0; row < a[1].n * a[2].n; row++)
		for (size_t i = 0; i < a[0].modes; i++) {
			const size_t j = row % a[1].n, k = row / a[1].n;
			const struct waves e = {.w = w, .re = {a[0].re + i, a[1].re + j, a[2].re + k}, .im = {a[0].im + i, a[1].im + j, a[2].im + k},
				.at = (row * w->chunks + i / C) * 2 * C, .shortest = pm_yee_waves_shortest(w, i, j, k)};
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

int pm_yee_waves_divergence(const struct pm_yee *y, const double *rho, double *to)
{
	struct pm_yee_waves w;
	const size_t n = pm_grid_size(&y->grid);
	int status = pm_yee_waves_init(&w, y, rho ? 4 : 3);
	for (int c = 0; c < 3 && !status; c++)
		pm_yee_waves_forward(&w, y->e[c], c);
	if (!status && rho) {
		for (size_t i = 0; i < n; i++)
			to[i] = rho[i] / y->eps0;
		pm_yee_waves_forward(&w, to, 3);
	}
	if (!status) {
		each(&w, divergence);
		pm_yee_waves_backward(&w, 0, to);
	}
	pm_yee_waves_free(&w);
	return status;
}

int pm_yee_waves_correct(const struct pm_yee *y, const double *residual)
{
	struct pm_yee_waves w;
	const size_t n = pm_grid_size(&y->grid);
	double *room = pm_alloc(n, sizeof *room);
	int status = pm_yee_waves_init(&w, y, 3) || !room ? -PM_DATA : 0;
	if (!status) {
		pm_yee_waves_forward(&w, residual, 0);
		each(&w, gradient);
	}
	for (int c = 0; c < 3 && !status; c++) {
		pm_yee_waves_backward(&w, c, room);
		for (size_t i = 0; i < n; i++)
			y->e[c][i] -= room[i];
	}
	pm_yee_waves_free(&w);
	pm_free(room);
	return status;
}
