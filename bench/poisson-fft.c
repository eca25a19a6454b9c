/* Time of poisson-fft against FFTW's own measured r2c and c2r pair, and of mgrad against a copy, in one run: medians of 7, alternating.
 * bench/poisson-fft [cells per axis ...]; threads as OMP_NUM_THREADS says, the pair on one thread where it is one.
 * SPDX-License-Identifier: GPL-3.0-or-later */
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "mesh/gradient.h"
#include "poisson/fft.h"

enum { ROUNDS = 7 };

static int rising(const void *a, const void *b)
{
	double x = *(const double *)a, y = *(const double *)b;
	return (x > y) - (x < y);
}

static double median(double *t)
{
	qsort(t, ROUNDS, sizeof *t, rising);
	return t[ROUNDS / 2];
}

static struct pm_grid cube(size_t n, enum pm_face face)
{
	struct pm_grid g = {.dim = 3};
	for (int d = 0; d < 3; d++) {
		g.cells[d] = n, g.points[d] = n + (face != PM_PERIODIC), g.h[d] = 1;
		g.face[d][0] = g.face[d][1] = face;
	}
	return g;
}

/* One round of a solver, of FFTW's pair, of a gradient, of a copy. */
static void round_of(size_t n, enum pm_face face, fftw_plan there, fftw_plan back, double *s, double *phi, double *const g[3], double *ms)
{
	static struct pm_poisson_fft *solver;
	static enum pm_face made;
	static size_t cells;
	struct pm_grid grid = cube(n, face);
	struct pm_operator o;
	double t[5];
	if (!solver || made != face || cells != n) {
		pm_poisson_fft_free(solver);
		solver = pm_poisson_fft_new(&grid, &(struct pm_poisson_fft_choice){.symbol = PM_SPECTRAL}, PM_MEASURE);
		made = face, cells = n;
		if (!solver || pm_poisson_fft_solve(solver, 1, s, phi, NULL))
			exit(1);
	}
	pm_operator_init(&o, &grid, PM_OP_GRAD, 4, 1, false);
	t[0] = pm_seconds();
	pm_poisson_fft_solve(solver, 1, s, phi, NULL);
	t[1] = pm_seconds();
	fftw_execute(there), fftw_execute(back);
	t[2] = pm_seconds();
	pm_operator_apply(&o, -1, (const double *[]){phi}, g, NULL);
	t[3] = pm_seconds();
	memcpy(g[0], phi, pm_grid_size(&grid) * sizeof(double));
	t[4] = pm_seconds();
	for (int i = 0; i < 4; i++)
		ms[i * ROUNDS] = 1e3 * (t[i + 1] - t[i]);
}

int main(int argc, char **argv)
{
	static const size_t usual[] = {64, 128, 256};
	printf("cells\tfaces\tsolve ms\tfftw pair ms\tratio\tmgrad order 4 ms\tmgrad over four copies\n");
	for (int a = 0; a < (argc > 1 ? argc - 1 : 3); a++) {
		size_t n = argc > 1 ? strtoul(argv[a + 1], NULL, 10) : usual[a], points = (n + 1) * (n + 1) * (n + 1);
		double *s = pm_zalloc(points, sizeof *s), *phi = pm_zalloc(points, sizeof *phi), *g[3], *w = pm_zalloc(n * n * (n + 2), sizeof *w);
		double *x = pm_zalloc(n * n * n, sizeof *x);
		for (int d = 0; d < 3; d++)
			g[d] = pm_zalloc(points, sizeof *s);
		fftw_plan there = fftw_plan_dft_r2c_3d((int)n, (int)n, (int)n, x, (fftw_complex *)w, FFTW_MEASURE);
		fftw_plan back = fftw_plan_dft_c2r_3d((int)n, (int)n, (int)n, (fftw_complex *)w, x, FFTW_MEASURE);
		for (size_t i = 0; i < points; i++)
			s[i] = (double)(i % 17) - 8;
		static const enum pm_face faces[] = {PM_PERIODIC, PM_WALL, PM_OPEN};
		for (int f = 0; f < (n > 200 ? 2 : 3); f++) { /* open at 256^3 wants gigabytes */
			double ms[4][ROUNDS];
			for (int r = 0; r < ROUNDS; r++)
				round_of(n, faces[f], there, back, s, phi, g, &ms[0][r]);
			double solve = median(ms[0]), pair = median(ms[1]), grad = median(ms[2]), copy = median(ms[3]);
			printf("%zu\t%s\t%.2f\t%.2f\t%.2f\t%.2f\t%.2f\n", n, pm_face_names[faces[f]], solve, pair, solve / pair, grad, grad / (4 * copy));
		}
		pm_free(s), pm_free(phi), pm_free(w), pm_free(x), pm_free(g[0]), pm_free(g[1]), pm_free(g[2]);
	}
	return 0;
}
