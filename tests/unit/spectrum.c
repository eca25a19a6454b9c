/* Spectra of mesh fields against the sums of the definition, O(N^2), and a field with a given spectrum. SPDX-License-Identifier: GPL-3.0-or-later */
#include <complex.h>
#include <string.h>

#include "check.h"
#include "fft/fftw-plan.h"
#include "measure/mesh-spectrum.h"
#include "stream/declare.h"

enum { MOST = 20000 };

static double u[3][MOST];

/* A field of c components on a mesh of the unit box with these cells. */
static struct pm_frame *frame(int dim, const size_t cells[3], const bool periodic[3], int components, struct pm_grid *g)
{
	struct pm_frame *f = pm_frame_new(dim);
	struct pm_mesh *m = calloc(1, sizeof *m);
	strcpy(m->name, "mesh");
	for (int d = 0; d < 3; d++) {
		m->cells[d] = d < dim ? cells[d] : 1, m->h[d] = d < dim ? (1 + 0.3 * d) / (double)cells[d] : 1;
		for (int side = 0; side < 2 && d < dim; side++)
			f->face[d][side] = periodic[d] ? PM_PERIODIC : PM_WALL;
	}
	f->meshes = calloc(1, sizeof *f->meshes);
	f->meshes[0] = m, f->nmeshes = 1;
	*g = pm_grid_of(f, m);
	struct pm_field *field = pm_makes(f, "mesh", "u", components, PM_DERIVED);
	pm_field_ready(field);
	for (int c = 0; c < components; c++)
		for (size_t i = 0; i < pm_grid_size(g); i++)
			pm_out(field, c)[i] = u[c][i];
	return f;
}

/* sum over shells of the absolute difference from the squares of the definition, over their sum. Axes that are not periodic are continued evenly. */
static double naive(const struct pm_grid *g, int components, const struct pm_spectrum *s)
{
	double sum[200] = {0}, off = 0, all = 0, unit[3];
	size_t n[3];
	for (int d = 0; d < 3; d++) {
		const bool folds = d < g->dim && g->face[d][0] != PM_PERIODIC;
		n[d] = folds ? 2 * g->cells[d] : g->points[d];
		unit[d] = d < g->dim ? 2 * pm_pi / ((double)n[d] * g->h[d]) : 0;
	}
	for (size_t m = 1; m < n[0] * n[1] * n[2]; m++) {
		const size_t k[3] = {m % n[0], m / n[0] % n[1], m / n[0] / n[1]};
		double k2 = 0, square = 0;
		for (int d = 0; d < 3; d++)
			k2 += pow((double)(2 * k[d] > n[d] ? n[d] - k[d] : k[d]) * unit[d], 2);
		for (int c = 0; c < components; c++) {
			double complex a = 0;
			for (size_t z = 0; z < n[2]; z++)
				for (size_t y = 0; y < n[1]; y++)
					for (size_t x = 0; x < n[0]; x++) {
						const size_t at[3] = {x < g->points[0] ? x : n[0] - x, y < g->points[1] ? y : n[1] - y,
							z < g->points[2] ? z : n[2] - z};
						const double turn = (double)(k[0] * x % n[0]) / (double)n[0] + (double)(k[1] * y % n[1]) / (double)n[1] +
							(double)(k[2] * z % n[2]) / (double)n[2];
						a += u[c][at[0] + g->points[0] * (at[1] + g->points[1] * at[2])] * cexp(-2 * pm_pi * I * turn);
					}
			square += pow(cabs(a) / (double)(n[0] * n[1] * n[2]), 2);
		}
		sum[(size_t)(sqrt(k2) / s->width + 0.5)] += square;
	}
	for (size_t j = 0; j < s->n; j++)
		off += fabs(sum[j] - s->shell[j].square), all += sum[j];
	return off / all;
}

static void compare(void)
{
	double worst = 0, parseval = 0;
	const struct { int dim, components; size_t cells[3]; bool periodic[3]; } t[] = {{1, 1, {13}, {true}}, {1, 2, {64}, {true}}, {1, 1, {9}, {false}},
		{2, 3, {6, 9}, {true, false}}, {3, 3, {4, 5, 6}, {true, true, true}}, {3, 1, {3, 4, 5}, {false, true, false}},
		{3, 2, {17, 2, 3}, {true, true, true}}};
	for (size_t i = 0; i < sizeof t / sizeof *t; i++) {
		struct pm_grid g;
		struct pm_spectrum s;
		struct pm_fft_plans plans = {0};
		double r[2];
		for (int c = 0; c < 3; c++)
			for (size_t k = 0; k < 1000; k++)
				pm_random(7, k, (uint64_t)c, r), u[c][k] = r[0] + 0.3;
		struct pm_frame *f = frame(t[i].dim, t[i].cells, t[i].periodic, t[i].components, &g);
		check(!pm_spectrum_of(&g, f->fields[0], 0, &plans, &s), "a spectrum in %d-D", t[i].dim);
		check_worst(&worst, naive(&g, t[i].components, &s));
		check_worst(&parseval, fabs(s.waves_square / s.mean_square - 1));
		pm_spectrum_free(&s);
		pm_fft_plans_clear(&plans);
		pm_frame_free(f);
	}
	check_below(worst, 1e-14, "002:N28: shells are those of the sums of the definition, all faces, 1-D to 3-D"); /* a few roundings of sums of 100 terms */
	check_below(parseval, 1e-15, "002:N27: the waves have the mean square of the nodes"); /* 4 roundings */
}

/* Waves of random phase with |u^|^2 ~ |k|^-11/3 on 24^3, so that E ~ k^-5/3: sums of cosines along diagonals of the box. */
static void slope(void)
{
	const size_t n = 24;
	struct pm_grid g;
	struct pm_spectrum s;
	struct pm_fft_plans plans = {0};
	memset(u, 0, sizeof u);
	uint64_t wave = 0;
	for (int kz = 0; kz <= 6; kz++)
		for (int ky = kz ? -6 : 0; ky <= 6; ky++)
			for (int kx = kz || ky > 0 ? -6 : 1; kx <= 6; kx++) {
				double r[2];
				const double amplitude = pow(kx * kx + ky * ky + kz * kz, -11.0 / 12);
				pm_random(3, wave++, 0, r);
				for (size_t i = 0; i < n * n * n; i++)
					u[0][i] += amplitude * cos(2 * pm_pi * ((double)kx * (double)(i % n) + (double)ky * (double)(i / n % n) +
						(double)kz * (double)(i / n / n)) / (double)n + 2 * pm_pi * r[0]);
			}
	struct pm_frame *f = frame(3, (const size_t[3]){n, n, n}, (const bool[3]){true, true, true}, 1, &g);
	for (int d = 0; d < 3; d++) /* a cube */
		g.h[d] = 2 * pm_pi / (double)n;
	check(!pm_spectrum_of(&g, f->fields[0], 0, &plans, &s), "a spectrum of 24^3");
	const struct pm_slope e = pm_spectrum_slope(&s, 1.5, 5.4); /* shells 2 to 5, which the cube of waves holds wholly */
	/* the fourth cumulant of ln |k| in a shell, which the fit leaves out: (11/3)^4/24 of it is 1e-3 at k = 2, which has 62 of 730 waves */
	check_near(e.power + 2, -5.0 / 3, 1e-3, "002:N57: the slope of E(k) is -5/3 for waves of |u^|^2 ~ k^-11/3");
	check_below(e.error, 1e-3, "and its error");
	check(e.shells == 4, "of four shells (%zu)", e.shells);
	pm_spectrum_free(&s);
	f->fields[0]->staggered[0][2] = 1;
	g.face[2][0] = g.face[2][1] = PM_WALL;
	check(pm_spectrum_of(&g, f->fields[0], 0, &plans, &s) == -PM_DATA && strstr(pm_message(), "half a cell up axis 2"),
		"staggered components need periodic faces");
	pm_spectrum_free(&s);
	pm_fft_plans_clear(&plans);
	pm_frame_free(f);
}

int main(void)
{
	compare();
	slope();
	return check_done();
}
