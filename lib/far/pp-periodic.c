/* Direct summation in the plane, periodic along one axis and open across it: the sum over all images in closed form. With k = 2 pi/L, x along the period
 * and y across it, both half angles a = k x/2, b = k y/2 of a displacement:
 *   grad phi1 = k/(4 pi) (sin a cos a, sinh b cosh b)/D,   phi1 = ln(4 D/k^2)/(4 pi),   D = sin^2 a + sinh^2 b + (k delta/2)^2,
 * which near the point is the bare field at (r^2 + delta^2)^(1/2), and far away +-1/(2 L) on both sides. D = (cosh ky - cos kx + d^2)/2 with Krasny's
 * d = k delta/2^(1/2). The functions of a difference come from those of the particles by addition, to 1e-16 of the period, as x.
 * Source: Krasny 1986, J. Comput. Phys. 65, 292, equation (5). Targets in the lanes, sources in blocks of 1024 in their order: the same bytes for any
 * number of threads and ranks. Assumes at most 95 periods across. Cost: N^2, 17 operations and a division per pair.
 * SPDX-License-Identifier: GPL-3.0-or-later */
#include <string.h>

#include "base/simd.h"
#include "far/pp-periodic.h"

enum { SOURCES = 1024 };

static const double most_across = 300;  /* of k (y - middle): exp of twice the half angle of a difference stays finite */
static const double least = 1e-28;      /* of D: two points 1e-14 of the period apart cannot be told from one by rounding */

struct work {
	size_t padded;                               /* particles and those of strength 0 that fill the last vector */
	double *sin, *cos, *up, *down, *q;           /* padded each: of the half angles, exp(b), exp(-b) */
	double core;                                 /* (k delta/2)^2 */
};

struct lanes {
	pm_simd along, across, phi;
	uint64_t coincident;
};

static __attribute__((noinline)) void logarithms(const pm_simd *D, pm_simd *u)
{
	for (int l = 0; l < PM_SIMD_WIDTH; l++)
		(*u)[l] = (*D)[l] < least ? 0 : log((*D)[l]);
}

static pm_simd_bits others(size_t first, size_t j)
{
	return (pm_simd_bits){0, 1, 2, 3, 4, 5, 6, 7} != (int64_t)j - (int64_t)first;
}

/* Sources [j0, j1) on the vector of targets at i. */
PM_SIMD_INLINE void block(const struct work *w, size_t i, size_t targets, size_t j0, size_t j1, bool potential, struct lanes *to)
{
	const pm_simd sin = pm_simd_load(w->sin + i), cos = pm_simd_load(w->cos + i), up = pm_simd_load(w->up + i), down = pm_simd_load(w->down + i);
	pm_simd along = {0}, across = {0}, phi = {0};
	for (size_t j = j0; j < j1; j++) {
		const pm_simd s = pm_simd_fnma(cos, pm_simd_all(w->sin[j]), sin * w->cos[j]), c = pm_simd_fma(sin, pm_simd_all(w->sin[j]), cos * w->cos[j]);
		const pm_simd e = up * w->down[j], f = down * w->up[j], sh = 0.5 * (e - f), ch = 0.5 * (e + f);
		const pm_simd D = pm_simd_fma(s, s, pm_simd_fma(sh, sh, pm_simd_all(w->core)));
		pm_simd_bits meets = others(i, j);
		if (__builtin_expect(pm_simd_any_below(D, pm_simd_all(least)), 0)) {
			for (size_t l = 0; l < PM_SIMD_WIDTH; l++) /* each pair once */
				to->coincident += D[l] < least && j > i + l && i + l < targets;
			meets &= D >= least;
		}
		const pm_simd g = (pm_simd)(meets & (pm_simd_bits)(w->q[j] / D));
		along = pm_simd_fma(g, s * c, along);
		across = pm_simd_fma(g, sh * ch, across);
		if (potential) {
			pm_simd u;
			logarithms(&D, &u);
			phi = pm_simd_fma(pm_simd_all(w->q[j]), (pm_simd)(meets & (pm_simd_bits)u), phi);
		}
	}
	to->along += along, to->across += across, to->phi += phi;
}

static void work_free(struct work *w) { pm_free(w->sin), pm_free(w->cos), pm_free(w->up), pm_free(w->down), pm_free(w->q); }

static int work_init(struct work *w, const struct pm_pp_periodic *p, size_t n, const double *const *x, const double *q)
{
	const double k = 2 * pm_pi / p->period;
	*w = (struct work){.padded = (n + PM_SIMD_WIDTH - 1) / PM_SIMD_WIDTH * PM_SIMD_WIDTH, .core = 0.25 * k * k * p->delta * p->delta};
	w->sin = pm_zalloc(w->padded, sizeof *w->sin), w->cos = pm_zalloc(w->padded, sizeof *w->cos), w->q = pm_zalloc(w->padded, sizeof *w->q);
	w->up = pm_zalloc(w->padded, sizeof *w->up), w->down = pm_zalloc(w->padded, sizeof *w->down);
	if (!w->sin || !w->cos || !w->up || !w->down || !w->q)
		return -PM_DATA;
	double low = HUGE_VAL, high = -HUGE_VAL;
	const double *y = x[!p->axis];
	for (size_t i = 0; i < n; i++)
		low = fmin(low, y[i]), high = fmax(high, y[i]);
	if (!(k * (high - low) <= 2 * most_across))
		return pm_fail(PM_DATA, "the particles extend over %g periods across the periodic axis, beyond the 95 of the sum in closed form "
			"(a larger period, or p2m | poisson-fft | mgrad | m2p)", (high - low) / p->period);
	for (size_t i = 0; i < n; i++) {
		const double a = 0.5 * k * x[p->axis][i], b = 0.5 * k * (y[i] - 0.5 * (low + high));
		w->sin[i] = sin(a), w->cos[i] = cos(a), w->up[i] = exp(b), w->down[i] = exp(-b), w->q[i] = q[i];
	}
	return 0;
}

int pm_pp_periodic_sum(const struct pm_pp_periodic *p, size_t targets, size_t n, const double *const *x, const double *q, double *const *gradient,
	double *potential, uint64_t *coincident)
{
	const double k = 2 * pm_pi / p->period, constant = 2 * log(2 / k); /* ln(4 D/k^2) = ln D + this */
	struct work w;
	uint64_t pairs = 0;
	double total = 0;
	*coincident = 0;
	if (!targets)
		return 0;
	int status = work_init(&w, p, n, x, q);
	for (size_t i = 0; i < n; i++)
		total += q[i];
#pragma omp parallel for schedule(static) reduction(+ : pairs) if (!status && targets > 128)
	for (size_t i = 0; i < (status ? 0 : targets); i += PM_SIMD_WIDTH) {
		struct lanes to = {.coincident = 0};
		for (size_t j = 0; j < n; j += SOURCES)
			if (potential)
				block(&w, i, targets, j, j + SOURCES < n ? j + SOURCES : n, true, &to);
			else
				block(&w, i, targets, j, j + SOURCES < n ? j + SOURCES : n, false, &to);
		for (size_t l = 0; l < PM_SIMD_WIDTH && i + l < targets; l++) {
			gradient[p->axis][i + l] = k / (4 * pm_pi) * to.along[l];
			gradient[!p->axis][i + l] = k / (4 * pm_pi) * to.across[l];
			if (potential)
				potential[i + l] = (to.phi[l] + constant * (total - q[i + l])) / (4 * pm_pi);
		}
		pairs += to.coincident;
	}
	*coincident = pairs;
	work_free(&w);
	return status;
}
