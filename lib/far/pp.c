/* Direct summation: grad phi_i = sum_j q_j f(|x_i - x_j|) (x_i - x_j) over all pairs, O(N^2), the reference for every other far field.
 * Source: Hockney and Eastwood 1988, section 1-4-1 (particle-particle method); mollifiers as in lib/mollifier.
 * Full loop: 32 targets in registers, sources in blocks of 1024 that stay in the first cache; block sums keep the round-off near
 * (1024 + N/1024) units. Half loop: tiles of particles meet in rounds of a tournament, in each of which a tile meets one other, so that no
 * sum depends on the number of threads. 1/r^3 from the 14-bit 1/sqrt(r^2) with a correction of fourth order (6e-16).
 * Conserves momentum: exactly pairwise in the half loop, to round-off in the full one.
 * Assumes open space. Pairs below r = 1e-100 without mollifier exert nothing. Cost: 18 vector operations per 8 pairs in 3-D.
 * SPDX-License-Identifier: GPL-3.0-or-later */
#include "far/pp.h"
#include "base/lanes.h"

enum { GROUP = 4, SOURCES = 1024 }; /* vectors of targets per group; sources per block */
enum mode { SQUARE, GUARDED, OTHER }; /* bare at r2 + delta2; the same where that may vanish; any mollifier */

static const double least = 1e-200; /* of r2: see lib/mollifier/bare.h */
static const double far_away = 1e100; /* where the particles sit that fill up a vector; their strength is 0 */

/* Copies that fill whole vectors, and the sums. */
struct work {
	int dim;
	size_t targets, n, padded, tile;
	double delta2, near2; /* within sqrt(near2) a mollifier with a reach is evaluated one by one */
	double *x[3], *q, *g[3], *phi;
	const struct pm_pp *p;
	uint64_t *coincident; /* pairs, per group or tile */
};

static double unit(int dim) { return dim == 1 ? 2 : dim == 2 ? 2 * pm_pi : 4 * pm_pi; }

/* r^-dim at squared distance d2, from below `least` on 0. */
PM_LANES_INLINE pm_lanes bare(int dim, pm_lanes d2)
{
	if (dim == 2) {
		pm_lanes y = pm_lanes_reciprocal_start(d2), e = pm_lanes_fnma(d2, y, pm_lanes_all(1)), z = pm_lanes_fma(y, e, y);
		return pm_lanes_fma(z, e * e, z);
	}
	pm_lanes y = pm_lanes_rsqrt_start(d2), y2 = y * y, e = pm_lanes_fnma(d2, y2, pm_lanes_all(1));
	pm_lanes a = dim == 3 ? y2 * y : y;
	double c1 = dim == 3 ? 1.5 : 0.5, c2 = dim == 3 ? 1.875 : 0.375, c3 = dim == 3 ? 2.1875 : 0.3125; /* (1-e)^(-3/2), (1-e)^(-1/2) */
	pm_lanes s = pm_lanes_fma(e, pm_lanes_fma(e, pm_lanes_all(c3), pm_lanes_all(c2)), pm_lanes_all(c1));
	return pm_lanes_fma(a * e, s, a);
}

/* Lanes that need the mollifier's own functions. */
static __attribute__((noinline)) void one_by_one(const struct work *w, double within, bool force, bool potential, const pm_lanes *r2, pm_lanes *f,
	pm_lanes *u)
{
	const struct pm_mollifier *m = w->p->mollifier;
	double c = unit(w->dim);
	for (int l = 0; l < PM_LANES; l++)
		if ((*r2)[l] < within) {
			if (force)
				(*f)[l] = c * m->force((*r2)[l], w->p->delta, w->dim);
			if (potential)
				(*u)[l] = c * m->potential((*r2)[l], w->p->delta, w->dim);
		}
}

/* Force factor and potential of a unit strength at squared distance r2, in units of unit(dim). */
PM_LANES_INLINE void pair(const struct work *w, int dim, enum mode mode, bool potential, pm_lanes r2, pm_lanes *f, pm_lanes *u)
{
	pm_lanes d2 = mode == OTHER ? r2 : r2 + pm_lanes_all(w->delta2);
	*f = bare(dim, d2);
	if (mode != SQUARE)
		*f = pm_lanes_where_not_below(d2, pm_lanes_all(least), *f);
	if (potential && dim != 2)
		*u = dim == 3 ? -*f * d2 : *f * d2;
	if (mode == OTHER && pm_lanes_any_below(r2, pm_lanes_all(w->near2)))
		one_by_one(w, w->near2, true, potential, &r2, f, u);
	if (potential && dim == 2)
		one_by_one(w, HUGE_VAL, false, true, &r2, f, u);
}

/* Lanes whose particle is not i; lane l is particle first + l. */
PM_LANES_INLINE pm_lanes others(size_t first, size_t i, pm_lanes v)
{
	pm_lanes_bits lane = {0, 1, 2, 3, 4, 5, 6, 7};
	int64_t at = (int64_t)i - (int64_t)first;
	pm_lanes_bits here = {at, at, at, at, at, at, at, at};
	return (pm_lanes)((pm_lanes_bits)v & (lane != here));
}

/* How many of the lanes, of which lane l is particle first + l, are in [from, to) and coincide. */
static __attribute__((noinline)) unsigned count(const struct work *w, size_t first, size_t from, size_t to, const pm_lanes *r2)
{
	unsigned c = 0;
	for (size_t l = 0; l < PM_LANES; l++)
		c += first + l >= from && first + l < to && (*r2)[l] + w->delta2 < least;
	return c;
}

/* Sources [j0, j1) on the group of targets at i. self: the group may be among the sources. */
PM_LANES_INLINE void group_block(const struct work *w, int dim, enum mode mode, bool potential, bool self, size_t i, size_t j0, size_t j1,
	unsigned *coincident)
{
	pm_lanes x[3][GROUP], g[3][GROUP], phi[GROUP], zero = {0};
	for (int k = 0; k < GROUP; k++) {
		for (int d = 0; d < dim; d++)
			x[d][k] = pm_lanes_load(w->x[d] + i + (size_t)k * PM_LANES), g[d][k] = zero;
		phi[k] = zero;
	}
	for (size_t j = j0; j < j1; j++) {
		pm_lanes q = pm_lanes_all(w->q[j]), y[3];
		for (int d = 0; d < dim; d++)
			y[d] = pm_lanes_all(w->x[d][j]);
		for (int k = 0; k < GROUP; k++) {
			pm_lanes s[3], r2 = zero, f, u = zero;
			for (int d = 0; d < dim; d++) {
				s[d] = x[d][k] - y[d];
				r2 = d ? pm_lanes_fma(s[d], s[d], r2) : s[d] * s[d];
			}
			pair(w, dim, mode, potential, r2, &f, &u);
			if (mode != SQUARE && __builtin_expect(pm_lanes_any_below(r2 + pm_lanes_all(w->delta2), pm_lanes_all(least)), 0))
				*coincident += count(w, i + (size_t)k * PM_LANES, 0, j < w->targets ? j : w->targets, &r2); /* each pair once */
			if (self)
				f = others(i + (size_t)k * PM_LANES, j, f), u = others(i + (size_t)k * PM_LANES, j, u);
			f *= q;
			for (int d = 0; d < dim; d++)
				g[d][k] = pm_lanes_fma(f, s[d], g[d][k]);
			if (potential)
				phi[k] = pm_lanes_fma(q, u, phi[k]);
		}
	}
	for (int k = 0; k < GROUP; k++) {
		size_t at = i + (size_t)k * PM_LANES;
		for (int d = 0; d < dim; d++)
			pm_lanes_store(w->g[d] + at, pm_lanes_load(w->g[d] + at) + g[d][k]);
		if (potential)
			pm_lanes_store(w->phi + at, pm_lanes_load(w->phi + at) + phi[k]);
	}
}

PM_LANES_INLINE void full(const struct work *w, int dim, enum mode mode, bool potential)
{
	size_t width = GROUP * PM_LANES, groups = (w->targets + width - 1) / width;
#pragma omp parallel for schedule(static)
	for (size_t group = 0; group < groups; group++) {
		unsigned coincident = 0;
		size_t i = group * width;
		for (size_t j = 0, end; j < w->n; j = end) { /* blocks end where the group's own particles begin and end */
			end = j + SOURCES < w->n ? j + SOURCES : w->n;
			bool self = j >= i && j < i + width;
			end = self && end > i + width ? i + width : !self && j < i && end > i ? i : end;
			if (self)
				group_block(w, dim, mode, potential, true, i, j, end, &coincident);
			else
				group_block(w, dim, mode, potential, false, i, j, end, &coincident);
		}
		w->coincident[group] = coincident;
	}
}

/* All pairs i in [i0, i1), j in [j0, j1) once; on the diagonal those with j > i. */
PM_LANES_INLINE void tiles(const struct work *w, int dim, enum mode mode, bool potential, bool diagonal, size_t i0, size_t i1, size_t j0, size_t j1,
	uint64_t *coincident)
{
	for (size_t i = i0; i < i1; i++) {
		pm_lanes x[3], g[3], qi = pm_lanes_all(w->q[i]), phi = {0}, zero = {0};
		for (int d = 0; d < dim; d++)
			x[d] = pm_lanes_all(w->x[d][i]), g[d] = zero;
		for (size_t j = diagonal ? (i + 1) / PM_LANES * PM_LANES : j0; j < j1; j += PM_LANES) {
			pm_lanes s[3], r2 = zero, f, u = zero, qj = pm_lanes_load(w->q + j);
			for (int d = 0; d < dim; d++) {
				s[d] = x[d] - pm_lanes_load(w->x[d] + j);
				r2 = d ? pm_lanes_fma(s[d], s[d], r2) : s[d] * s[d];
			}
			pair(w, dim, mode, potential, r2, &f, &u);
			if (mode != SQUARE && __builtin_expect(pm_lanes_any_below(r2 + pm_lanes_all(w->delta2), pm_lanes_all(least)), 0))
				*coincident += count(w, j, i + 1, i < w->targets ? w->n : 0, &r2);
			if (diagonal && j <= i)
				for (size_t l = 0; l < PM_LANES; l++)
					if (j + l <= i)
						f[l] = 0, u[l] = 0;
			pm_lanes fi = f * qj, fj = f * qi;
			for (int d = 0; d < dim; d++) {
				g[d] = pm_lanes_fma(fi, s[d], g[d]);
				pm_lanes_store(w->g[d] + j, pm_lanes_fnma(fj, s[d], pm_lanes_load(w->g[d] + j)));
			}
			if (potential) {
				phi = pm_lanes_fma(qj, u, phi);
				pm_lanes_store(w->phi + j, pm_lanes_fma(qi, u, pm_lanes_load(w->phi + j)));
			}
		}
		for (int d = 0; d < dim; d++)
			w->g[d][i] += pm_lanes_sum(g[d]);
		if (potential)
			w->phi[i] += pm_lanes_sum(phi);
	}
}

/* A tournament of m tiles: in round r meet those with a + b = r modulo m, a <= b. */
PM_LANES_INLINE void half(const struct work *w, int dim, enum mode mode, bool potential)
{
	size_t m = (w->padded + w->tile - 1) / w->tile;
#pragma omp parallel
	for (size_t r = 0; r < m; r++) {
		size_t below = r / 2 + 1, meetings = below + (r + m) / 2 - r;
#pragma omp for schedule(static)
		for (size_t k = 0; k < meetings; k++) {
			size_t a = k < below ? k : r + 1 + (k - below), b = (r + m - a) % m;
			size_t a1 = (a + 1) * w->tile < w->padded ? (a + 1) * w->tile : w->padded;
			size_t b1 = (b + 1) * w->tile < w->padded ? (b + 1) * w->tile : w->padded;
			if (a == b)
				tiles(w, dim, mode, potential, true, a * w->tile, a1, b * w->tile, b1, w->coincident + a);
			else
				tiles(w, dim, mode, potential, false, a * w->tile, a1, b * w->tile, b1, w->coincident + a);
		}
	}
}

#define LOOPS(dim, mode) \
	static void full_##dim##_##mode(const struct work *w) { w->phi ? full(w, dim, mode, true) : full(w, dim, mode, false); } \
	static void half_##dim##_##mode(const struct work *w) { w->phi ? half(w, dim, mode, true) : half(w, dim, mode, false); }
LOOPS(1, SQUARE) LOOPS(2, SQUARE) LOOPS(3, SQUARE)
LOOPS(1, GUARDED) LOOPS(2, GUARDED) LOOPS(3, GUARDED)
LOOPS(1, OTHER) LOOPS(2, OTHER) LOOPS(3, OTHER)

typedef void loop(const struct work *w);
static loop *const loops[2][3][3] = {
	{{full_1_SQUARE, full_2_SQUARE, full_3_SQUARE}, {full_1_GUARDED, full_2_GUARDED, full_3_GUARDED}, {full_1_OTHER, full_2_OTHER, full_3_OTHER}},
	{{half_1_SQUARE, half_2_SQUARE, half_3_SQUARE}, {half_1_GUARDED, half_2_GUARDED, half_3_GUARDED}, {half_1_OTHER, half_2_OTHER, half_3_OTHER}},
};

static double *padded(size_t n, size_t all, const double *from, double fill)
{
	double *p = pm_alloc(all, sizeof *p);
	for (size_t i = 0; p && i < all; i++)
		p[i] = i < n ? from[i] : fill;
	return p;
}

static void work_free(struct work *w)
{
	for (int d = 0; d < 3; d++)
		pm_free(w->x[d]), pm_free(w->g[d]);
	pm_free(w->q), pm_free(w->phi), pm_free(w->coincident);
}

static int work_init(struct work *w, const struct pm_pp *p, size_t n, const double *const *x, const double *q, bool potential)
{
	size_t width = GROUP * PM_LANES, tiles_wanted = 16;
	*w = (struct work){.p = p, .dim = p->dim, .n = n, .padded = (n + width - 1) / width * width};
	w->tile = (w->padded / tiles_wanted + PM_LANES - 1) / PM_LANES * PM_LANES;
	w->tile = w->tile < PM_LANES ? PM_LANES : w->tile > 512 ? 512 : w->tile;
	bool square = p->mollifier->square;
	w->delta2 = square && !p->mollifier->bare ? p->delta * p->delta : 0;
	w->near2 = square ? 0 : p->mollifier->reach > 0 ? p->mollifier->reach * p->mollifier->reach * p->delta * p->delta : HUGE_VAL;
	for (int d = 0; d < p->dim; d++) {
		w->x[d] = padded(n, w->padded, x[d], far_away);
		w->g[d] = pm_zalloc(w->padded, sizeof **w->g);
	}
	w->q = padded(n, w->padded, q, 0);
	w->phi = potential ? pm_zalloc(w->padded, sizeof *w->phi) : NULL;
	w->coincident = pm_zalloc(w->padded, sizeof *w->coincident);
	for (int d = 0; d < p->dim; d++)
		if (!w->x[d] || !w->g[d])
			return -PM_DATA;
	return w->q && w->coincident && (w->phi || !potential) ? 0 : -PM_DATA;
}

int pm_pp_sum(const struct pm_pp *p, size_t targets, size_t n, const double *const *x, const double *q, double *const *gradient, double *potential,
	uint64_t *coincident)
{
	struct work w;
	*coincident = 0;
	if (!n || !targets)
		return 0;
	int status = work_init(&w, p, n, x, q, potential != NULL);
	if (!status) {
		w.targets = targets;
		enum mode mode = !p->mollifier->square ? OTHER : w.delta2 < least ? GUARDED : SQUARE;
		loops[p->half][mode][p->dim - 1](&w);
		double c = 1 / unit(p->dim);
		for (size_t i = 0; i < targets; i++) {
			for (int d = 0; d < p->dim; d++)
				gradient[d][i] = c * w.g[d][i];
			if (potential)
				potential[i] = c * w.phi[i];
		}
		for (size_t i = 0; i < w.padded; i++)
			*coincident += w.coincident[i];
	}
	work_free(&w);
	return status;
}

int pm_pp_plain(const struct pm_pp *p, size_t targets, size_t n, const double *const *x, const double *q, double *const *gradient,
	double *potential, uint64_t *coincident)
{
	*coincident = 0;
	for (size_t i = 0; i < targets; i++) {
		struct pm_sum g[3] = {{0}}, phi = {0};
		for (size_t j = 0; j < n; j++) {
			double s[3], r2 = 0;
			for (int d = 0; d < p->dim; d++)
				s[d] = x[d][i] - x[d][j], r2 += s[d] * s[d];
			if (j == i)
				continue;
			double f = p->mollifier->force(r2, p->delta, p->dim);
			for (int d = 0; d < p->dim; d++)
				pm_sum_add(&g[d], q[j] * f * s[d]);
			pm_sum_add(&phi, q[j] * p->mollifier->potential(r2, p->delta, p->dim));
			*coincident += j > i && r2 + (p->mollifier->bare ? 0 : p->delta * p->delta) < least;
		}
		for (int d = 0; d < p->dim; d++)
			gradient[d][i] = pm_sum_total(g[d]);
		if (potential)
			potential[i] = pm_sum_total(phi);
	}
	return 0;
}
