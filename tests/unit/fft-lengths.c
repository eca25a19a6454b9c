/* Complex transforms of every length up to 300 and some longer ones, against the definition, forward and back.
 * SPDX-License-Identifier: GPL-3.0-or-later */
#include <stdlib.h>

#include "check.h"
#include "fft/fft-block.h"

enum { L = PM_FFT_LINES, H = L / 2 };

/* The largest error over the largest value; sign -1 forward. Of two lines; the others are checked to have the same bytes. */
static double error(size_t n, int sign)
{
	struct pm_fft_plans p = {0};
	const struct pm_fft *f = pm_fft(&p, n);
	double *block = pm_alloc(n * L, sizeof *block), *x = malloc(2 * n * sizeof *x), worst = 0, scale = 0, u[2], c, s;
	for (size_t i = 0; i < n; i++) {
		pm_random(385, i, n, u);
		x[2 * i] = u[0] - 0.5, x[2 * i + 1] = u[1] - 0.3;
	}
	for (size_t i = 0; f && i < n; i++)
		for (size_t q = 0; q < H; q++)
			block[(sign < 0 ? i : f->at[i]) * L + q] = x[2 * i], block[(sign < 0 ? i : f->at[i]) * L + q + H] = x[2 * i + 1];
	if (!f)
		return NAN;
	if (sign < 0)
		pm_fft_forward(f, block);
	else
		pm_fft_backward(f, block);
	for (size_t k = 0; k < n; k++) {
		long double re = 0, im = 0;
		const double *row = block + (sign < 0 ? f->at[k] : k) * L;
		for (size_t j = 0; j < n; j++) {
			pm_fft_circle(j * k, n, &c, &s);
			re += (long double)x[2 * j] * c - sign * (long double)x[2 * j + 1] * s;
			im += (long double)x[2 * j + 1] * c + sign * (long double)x[2 * j] * s;
		}
		for (size_t q = 1; q < H; q++)
			if (row[q] != row[0] || row[q + H] != row[H])
				worst = INFINITY;
		check_worst(&worst, hypot(row[0] - (double)re, row[H] - (double)im));
		check_worst(&scale, hypot((double)re, (double)im));
	}
	free(x), pm_free(block), pm_fft_plans_clear(&p);
	return worst / scale;
}

int main(void)
{
	static const size_t longer[] = {323, 502, 514, 521, 646, 1021, 1024, 1189};
	double worst[2] = {0, 0};
	for (size_t n = 1; n <= 300 + sizeof longer / sizeof *longer; n++)
		for (int back = 0; back < 2; back++)
			check_worst(&worst[back], error(n <= 300 ? n : longer[n - 301], back ? 1 : -1));
	/* round-off of sums of up to a thousand terms of 0.5: 1e-15 of the largest measured, times 3 */
	check_near(worst[0], 0, 3e-15, "forward, 1 to 300 and some up to 1189: the definition");
	check_near(worst[1], 0, 3e-15, "back, 1 to 300 and some up to 1189: the definition");
	return check_done();
}
