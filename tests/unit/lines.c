/* Real transforms along a line: those by FFTs of n against those by images, and there and back. SPDX-License-Identifier: GPL-3.0-or-later */
#include <stdlib.h>
#include <string.h>

#include "check.h"
#include "fft/axis-transform.h"

enum { L = PM_FFT_LINES };

static const struct { enum pm_face face[2]; const char *name; } kind[] = {{{PM_PERIODIC, PM_PERIODIC}, "periodic"}, {{PM_WALL, PM_WALL}, "walls"},
	{{PM_NEUMANN, PM_NEUMANN}, "neumann"}, {{PM_WALL, PM_NEUMANN}, "wall below neumann"}, {{PM_NEUMANN, PM_WALL}, "neumann below wall"},
	{{PM_OPEN, PM_OPEN}, "open"}, {{PM_OPEN, PM_WALL}, "open below wall"}, {{PM_NEUMANN, PM_OPEN}, "neumann below open"}};

/* A block whose rows that are not nodes hold values that must not be read. */
static double *block_of(const struct pm_transform *l)
{
	double *b = pm_alloc((l->length + 1) * L, sizeof *b);
	for (size_t i = 0; i < (l->length + 1) * L; i++)
		b[i] = NAN;
	for (size_t i = 0; i < l->count; i++)
		for (size_t q = 0; q < L; q++) {
			double u[2];
			pm_random(77, i, q, u);
			b[(l->row + i) * L + q] = u[0] - 0.3;
		}
	return b;
}

/* The largest difference over the largest value: of modes between the two, or of nodes there and back. */
static double same_modes(const struct pm_transform *a, const struct pm_transform *b)
{
	double *x = block_of(a), *y = block_of(b), worst = 0, most = 0;
	pm_transform_real(a, x), pm_transform_real(b, y);
	for (size_t m = 0; m < a->modes; m++)
		for (size_t q = 0; q < L; q++) {
			double sign = b->fold == PM_WAVES_QUARTER_SINE && m % 2 ? -1 : 1, v = x[a->map[m] * L + q], e = fabs(v - sign * y[b->map[m] * L + q]);
			check_worst(&worst, e);
			check_worst(&most, fabs(v));
		}
	pm_free(x), pm_free(y);
	return a->modes != b->modes ? NAN : most > 0 ? worst / most : worst;
}

static double there_and_back(const struct pm_transform *l)
{
	double *x = block_of(l), *y = block_of(l), worst = 0;
	pm_transform_real(l, x);
	pm_transform_real_back(l, x);
	for (size_t i = l->row * L; i < (l->row + l->count) * L; i++)
		check_worst(&worst, fabs(x[i] / (double)l->length - y[i]));
	pm_free(x), pm_free(y);
	return worst;
}

int main(void)
{
	static const size_t size[] = {1, 2, 3, 4, 5, 7, 8, 12, 33, 34, 97, 256, 257, 512};
	struct pm_fft_plans planner = {0};
	for (size_t k = 0; k < sizeof kind / sizeof *kind; k++) {
		double worst = 0, back = 0;
		for (size_t i = 0; i < sizeof size / sizeof *size; i++) {
			struct pm_transform a, b;
			if (pm_transform_init(&planner, kind[k].face, size[i], &a) || pm_transform_init_real(&planner, kind[k].face, size[i], &b))
				return check(false, "transforms of lines are set up: %s", pm_message()), check_done();
			check_worst(&worst, same_modes(&a, &b));
			check_worst(&back, there_and_back(&a)), check_worst(&back, there_and_back(&b));
			pm_fft_plans_clear(&planner);
		}
		/* round-off of a sum of 1024 terms; back, of running sums: 4e-17 n measured for n = 64 to 4096, times 2 */
		check(worst < 2e-14, "%s: the transform of n cells is that of the images, n = 1 to 512 (difference %.1e)", kind[k].name, worst);
		check(back < 4e-14, "%s: forward and back gives the nodes times the length of the transform (error %.1e)", kind[k].name, back);
	}
	return check_done();
}
