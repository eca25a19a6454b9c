/* Biot-Savart sums of vortices in space with their stretching, over all pairs. With s = x_i - x_j, t = alpha_j x s and the mollified f,
 *     u_i = sum_j f t,   (alpha_i . grad) u = sum_j [(f'/r) (alpha_i . s) t + f alpha_j x alpha_i]            classical
 *     sum_d alpha_i,d grad u_d = sum_j [(f'/r) (alpha_i . t) s + f alpha_i x alpha_j]                transpose: keeps the total
 * and mixed is half of both. Source: Winckelmans and Leonard 1993, J. Comput. Phys. 109, 247; Cottet and Koumoutsakos 2000, section 3.3.
 * Eight targets in registers, sources in blocks of 512 that stay in the first cache; block sums keep the round-off near (512 + N/512) units.
 * Assumes open space. Cost: N^2; some 40 vector operations per 8 pairs with stretching, 70 more within 6.5 delta of a Gaussian.
 * SPDX-License-Identifier: GPL-3.0-or-later */
#include <string.h>

#include "far/pp-vortex.h"
#include "far/pair-forces.h"
#include "far/vortex-pairs.h"

const char *const pm_pp_form_names[] = {"transpose", "classical", "mixed", "none", NULL};

enum { SOURCES = 512, CHUNK = 16 }; /* sources per block; vectors of targets that share a block */

/* Copies of targets and sources, each padded to whole vectors, and the sums: velocity, sum f alpha, sum of the slope's terms, sum alpha phi. */
struct work {
	size_t targets, n, padded;
	double *x[3], *alpha[3], *sum[4][3];
	struct pm_vortex_pairs how;
	uint64_t *coincident; /* per vector of targets */
};

/* Constants for which the compiler makes a separate loop. */
struct how {
	enum pm_vortex_mode mode;
	enum pm_pp_form form;
	bool psi;
};

/* Sources [j0, j1) on the eight targets at i. */
PM_SIMD_INLINE void vector_block(const struct work *w, const struct how how, bool self, size_t i, size_t j0, size_t j1)
{
	const bool stretch = how.form != PM_PP_NONE;
	pm_simd x[3], a[3], sum[4][3], zero = {0};
	PM_SIMD_UNROLL
	for (int d = 0; d < 3; d++) {
		x[d] = pm_simd_load(w->x[d] + i), a[d] = pm_simd_load(w->alpha[d] + i);
		PM_SIMD_UNROLL
		for (int k = 0; k < 4; k++)
			sum[k][d] = zero;
	}
	for (size_t j = j0; j < j1; j++) {
		pm_simd s[3], b[3], t[3], r2 = zero, f, slope, u = zero, g;
		PM_SIMD_UNROLL
		for (int d = 0; d < 3; d++) {
			s[d] = x[d] - pm_simd_all(w->x[d][j]), b[d] = pm_simd_all(w->alpha[d][j]);
			r2 = pm_simd_fma(s[d], s[d], r2);
		}
		pm_vortex_meet(&w->how, how.mode, r2, &f, &slope, &u);
		if (how.mode == PM_VORTEX_OTHER && w->how.near2 <= 0 && __builtin_expect(pm_simd_any_below(r2, pm_simd_all(pm_vortex_least)), 0))
			for (size_t l = 0; l < PM_SIMD_WIDTH; l++)
				w->coincident[i / PM_SIMD_WIDTH] += i + l < w->targets && i + l != j && r2[l] < pm_vortex_least;
		if (self)
			f = pm_pairs_others(i, j, f), slope = pm_pairs_others(i, j, slope), u = pm_pairs_others(i, j, u);
		PM_SIMD_UNROLL
		for (int d = 0; d < 3; d++) {
			const int e = (d + 1) % 3, h = (d + 2) % 3;
			t[d] = pm_simd_fnma(b[h], s[e], b[e] * s[h]);
			sum[0][d] = pm_simd_fma(f, t[d], sum[0][d]);
			if (stretch && how.form != PM_PP_MIXED)
				sum[1][d] = pm_simd_fma(f, b[d], sum[1][d]);
			if (how.psi)
				sum[3][d] = pm_simd_fnma(u, b[d], sum[3][d]);
		}
		if (stretch) {
			pm_simd along = slope * pm_simd_fma(a[2], s[2], pm_simd_fma(a[1], s[1], a[0] * s[0]));
			g = slope * pm_simd_fma(a[2], t[2], pm_simd_fma(a[1], t[1], a[0] * t[0]));
			PM_SIMD_UNROLL
			for (int d = 0; d < 3; d++) {
				if (how.form != PM_PP_TRANSPOSE)
					sum[2][d] = pm_simd_fma(along, t[d], sum[2][d]);
				if (how.form != PM_PP_CLASSICAL)
					sum[2][d] = pm_simd_fma(g, s[d], sum[2][d]);
			}
		}
	}
	PM_SIMD_UNROLL
	for (int k = 0; k < 4; k++)
		if (k == 0 || (k == 3 && how.psi) || (k < 3 && stretch)) {
			PM_SIMD_UNROLL
			for (int d = 0; d < 3; d++)
				pm_simd_store(w->sum[k][d] + i, pm_simd_load(w->sum[k][d] + i) + sum[k][d]);
		}
}

/* All sources on the targets from..to-1; blocks also end where the vector's own particles begin and end. */
PM_SIMD_INLINE void chunk(const struct work *w, const struct how how, size_t from, size_t to)
{
	for (size_t first = 0; first < w->n; first += SOURCES) {
		const size_t last = first + SOURCES < w->n ? first + SOURCES : w->n;
		for (size_t i = from; i < to; i += PM_SIMD_WIDTH) {
			const size_t past = i + PM_SIMD_WIDTH < last ? i + PM_SIMD_WIDTH : last;
			if (i < first || i >= last) {
				vector_block(w, how, false, i, first, last);
			} else { /* vectors begin at multiples of 8, so none reaches into the next block */
				vector_block(w, how, false, i, first, i);
				vector_block(w, how, true, i, i, past);
				vector_block(w, how, false, i, past, last);
			}
		}
	}
}

typedef void loop(const struct work *w, size_t from, size_t to);
#define LOOP(mode, form, psi) \
	static void loop_##mode##_##form##_##psi(const struct work *w, size_t from, size_t to) \
	{ \
		chunk(w, (struct how){PM_VORTEX_##mode, PM_PP_##form, psi}, from, to); \
	}
#define LOOPS(mode) \
	LOOP(mode, TRANSPOSE, 0) LOOP(mode, CLASSICAL, 0) LOOP(mode, MIXED, 0) LOOP(mode, NONE, 0) \
	LOOP(mode, TRANSPOSE, 1) LOOP(mode, CLASSICAL, 1) LOOP(mode, MIXED, 1) LOOP(mode, NONE, 1)
#define ROW(mode, psi) {loop_##mode##_TRANSPOSE_##psi, loop_##mode##_CLASSICAL_##psi, loop_##mode##_MIXED_##psi, loop_##mode##_NONE_##psi}
LOOPS(SQUARE) LOOPS(ALGEBRAIC) LOOPS(GAUSSIAN) LOOPS(GAUSSIAN_4) LOOPS(OTHER)
static loop *const table[PM_VORTEX_MODES][2][4] = {
	{ROW(SQUARE, 0), ROW(SQUARE, 1)}, {ROW(ALGEBRAIC, 0), ROW(ALGEBRAIC, 1)}, {ROW(GAUSSIAN, 0), ROW(GAUSSIAN, 1)},
	{ROW(GAUSSIAN_4, 0), ROW(GAUSSIAN_4, 1)}, {ROW(OTHER, 0), ROW(OTHER, 1)}};

/* Filled up with zeros, which exert nothing and are not read back. */
static double *padded(const struct work *w, const double *from)
{
	double *p = pm_zalloc(w->padded, sizeof *p);
	if (p)
		memcpy(p, from, w->n * sizeof *p);
	return p;
}

static void work_free(struct work *w)
{
	for (int d = 0; d < 3; d++) {
		pm_free(w->x[d]), pm_free(w->alpha[d]);
		for (int k = 0; k < 4; k++)
			pm_free(w->sum[k][d]);
	}
	pm_free(w->coincident);
}

static int work_init(struct work *w, const struct pm_pp_vortex *p, size_t targets, size_t n, const double *const x[3], const double *const alpha[3])
{
	bool good = true;
	*w = (struct work){.targets = targets, .n = n, .padded = (n + PM_SIMD_WIDTH - 1) / PM_SIMD_WIDTH * PM_SIMD_WIDTH,
		.how = pm_vortex_pairs_of(p->mollifier, p->delta)};
	for (int d = 0; d < 3; d++) {
		w->x[d] = padded(w, x[d]), w->alpha[d] = padded(w, alpha[d]);
		good = good && w->x[d] && w->alpha[d];
		for (int k = 0; k < 4; k++)
			good = (w->sum[k][d] = pm_zalloc(w->padded, sizeof(double))) && good;
	}
	w->coincident = pm_zalloc(w->padded / PM_SIMD_WIDTH, sizeof *w->coincident);
	return good && w->coincident ? 0 : -PM_DATA;
}

/* The rate of alpha_i from the sums f alpha_j (A) and of the slope's terms (B). */
static double rate(enum pm_pp_form form, const double a[3], const double A[3], const double B[3], int c)
{
	const int e = (c + 1) % 3, h = (c + 2) % 3;
	const double turn = a[e] * A[h] - a[h] * A[e]; /* alpha x A */
	return form == PM_PP_TRANSPOSE ? B[c] + turn : form == PM_PP_CLASSICAL ? B[c] - turn : 0.5 * B[c];
}

static void results(const struct work *w, enum pm_pp_form form, struct pm_pp_vortex_sums *to)
{
	const double unit = 1 / (4 * pm_pi);
	for (size_t i = 0; i < w->targets; i++) {
		double a[3], A[3], B[3];
		for (int d = 0; d < 3; d++)
			a[d] = w->alpha[d][i], A[d] = w->sum[1][d][i], B[d] = w->sum[2][d][i];
		for (int d = 0; d < 3; d++) {
			to->velocity[d][i] = unit * w->sum[0][d][i];
			if (form != PM_PP_NONE)
				to->stretching[d][i] = unit * rate(form, a, A, B, d);
			if (to->psi[0])
				to->psi[d][i] = unit * w->sum[3][d][i];
		}
	}
}

int pm_pp_vortex_sum(const struct pm_pp_vortex *p, size_t targets, size_t n, const double *const x[3], const double *const alpha[3],
	struct pm_pp_vortex_sums *to)
{
	const size_t width = CHUNK * PM_SIMD_WIDTH, chunks = (targets + width - 1) / width;
	struct work w;
	to->coincident = 0;
	if (!n || !targets)
		return 0;
	int status = work_init(&w, p, targets, n, x, alpha);
	if (!status) {
		loop *const run = table[w.how.mode][to->psi[0] != NULL][p->form];
#pragma omp parallel for schedule(static) if (chunks > 1)
		for (size_t c = 0; c < chunks; c++)
			run(&w, c * width, (c + 1) * width < targets ? (c + 1) * width : targets);
		results(&w, p->form, to);
		for (size_t i = 0; i < w.padded / PM_SIMD_WIDTH; i++)
			to->coincident += w.coincident[i];
	}
	work_free(&w);
	return status;
}
