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

enum { GROUP = 4, SOURCES = 1024, ROWS = 2 }; /* vectors of targets per group; sources per block; particles at a time in the half loop */
enum mode { SQUARE, GUARDED, OTHER }; /* bare at r2 + delta2; the same where that may vanish; any mollifier */

static const double least = 1e-200; /* of r2: see lib/mollifier/bare.h */
static const double far_away = 1e100; /* where the particles sit that fill up a vector; their strength is 0 */

/* Copies that fill whole vectors, and the sums. */
struct work {
	int dim;
	size_t targets, n, padded, tile;
	double delta2, near2; /* the first is 0 unless the mollifier is bare(r^2 + delta^2); within sqrt(near2) a mollifier with a reach is evaluated one by one */
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
static __attribute__((noinline)) void one_by_one(const struct work *w, bool potential, const pm_lanes *r2, pm_lanes *f, pm_lanes *u)
{
	const struct pm_mollifier *m = w->p->mollifier;
	double c = unit(w->dim);
	for (int l = 0; l < PM_LANES; l++)
		if ((*r2)[l] < w->near2) {
			(*f)[l] = c * m->force((*r2)[l], w->p->delta, w->dim);
			if (potential)
				(*u)[l] = c * m->potential((*r2)[l], w->p->delta, w->dim);
		}
}

/* ln r, 0 for coincident particles. */
static __attribute__((noinline)) void logarithm(const pm_lanes *d2, pm_lanes *u)
{
	for (int l = 0; l < PM_LANES; l++)
		(*u)[l] = (*d2)[l] < least ? 0 : 0.5 * log((*d2)[l]);
}

/* Force factor and potential of a unit strength at r^2 + delta2 = d2, in units of unit(dim). */
PM_LANES_INLINE void pair(const struct work *w, int dim, enum mode mode, bool potential, pm_lanes d2, pm_lanes *f, pm_lanes *u)
{
	*f = bare(dim, d2);
	if (mode != SQUARE)
		*f = pm_lanes_where_not_below(d2, pm_lanes_all(least), *f);
	if (potential && dim != 2)
		*u = dim == 3 ? -*f * d2 : *f * d2;
	else if (potential)
		logarithm(&d2, u);
	if (mode == OTHER && pm_lanes_any_below(d2, pm_lanes_all(w->near2)))
		one_by_one(w, potential, &d2, f, u);
}

/* Lanes whose particle is not i, or comes after i; lane l is particle first + l. */
PM_LANES_INLINE pm_lanes others(size_t first, size_t i, pm_lanes v)
{
	int64_t at = (int64_t)i - (int64_t)first;
	return (pm_lanes)((pm_lanes_bits)v & ((pm_lanes_bits){0, 1, 2, 3, 4, 5, 6, 7} != at));
}
PM_LANES_INLINE pm_lanes after(size_t first, size_t i, pm_lanes v)
{
	int64_t at = (int64_t)i - (int64_t)first;
	return (pm_lanes)((pm_lanes_bits)v & ((pm_lanes_bits){0, 1, 2, 3, 4, 5, 6, 7} > at));
}

/* How many of the lanes, of which lane l is particle first + l, are in [from, to) and coincide. */
static __attribute__((noinline)) unsigned count(size_t first, size_t from, size_t to, const pm_lanes *d2)
{
	unsigned c = 0;
	for (size_t l = 0; l < PM_LANES; l++)
		c += first + l >= from && first + l < to && (*d2)[l] < least;
	return c;
}

/* Sources [j0, j1) on the group of targets at i. self: the group may be among the sources. */
PM_LANES_INLINE void group_block(const struct work *w, int dim, enum mode mode, bool potential, bool self, size_t i, size_t j0, size_t j1,
	unsigned *coincident)
{
	pm_lanes x[3][GROUP], g[3][GROUP], phi[GROUP], zero = {0}, delta2 = pm_lanes_all(w->delta2);
	PM_LANES_UNROLL
	for (int k = 0; k < GROUP; k++) {
		PM_LANES_UNROLL
		for (int d = 0; d < dim; d++)
			x[d][k] = pm_lanes_load(w->x[d] + i + (size_t)k * PM_LANES), g[d][k] = zero;
		phi[k] = zero;
	}
	for (size_t j = j0; j < j1; j++) {
		pm_lanes q = pm_lanes_all(w->q[j]), y[3];
		PM_LANES_UNROLL
		for (int d = 0; d < dim; d++)
			y[d] = pm_lanes_all(w->x[d][j]);
		PM_LANES_UNROLL
		for (int k = 0; k < GROUP; k++) {
			pm_lanes s[3], d2 = delta2, f, u = zero;
			PM_LANES_UNROLL
			for (int d = 0; d < dim; d++) {
				s[d] = x[d][k] - y[d];
				d2 = pm_lanes_fma(s[d], s[d], d2);
			}
			pair(w, dim, mode, potential, d2, &f, &u);
			if (mode != SQUARE && __builtin_expect(pm_lanes_any_below(d2, pm_lanes_all(least)), 0))
				*coincident += count(i + (size_t)k * PM_LANES, 0, j < w->targets ? j : w->targets, &d2); /* each pair once */
			if (self)
				f = others(i + (size_t)k * PM_LANES, j, f), u = others(i + (size_t)k * PM_LANES, j, u);
			f *= q;
			PM_LANES_UNROLL
			for (int d = 0; d < dim; d++)
				g[d][k] = pm_lanes_fma(f, s[d], g[d][k]);
			if (potential)
				phi[k] = pm_lanes_fma(q, u, phi[k]);
		}
	}
	PM_LANES_UNROLL
	for (int k = 0; k < GROUP; k++) {
		size_t at = i + (size_t)k * PM_LANES;
		PM_LANES_UNROLL
		for (int d = 0; d < dim; d++)
			pm_lanes_store(w->g[d] + at, pm_lanes_load(w->g[d] + at) + g[d][k]);
		if (potential)
			pm_lanes_store(w->phi + at, pm_lanes_load(w->phi + at) + phi[k]);
	}
}

/* All sources on one group of targets; blocks end where the group's own particles begin and end. */
PM_LANES_INLINE void group(const struct work *w, int dim, enum mode mode, bool potential, size_t i)
{
	size_t width = GROUP * PM_LANES;
	unsigned coincident = 0;
	for (size_t j = 0, end; j < w->n; j = end) {
		end = j + SOURCES < w->n ? j + SOURCES : w->n;
		bool self = j >= i && j < i + width;
		end = self && end > i + width ? i + width : !self && j < i && end > i ? i : end;
		if (self)
			group_block(w, dim, mode, potential, true, i, j, end, &coincident);
		else
			group_block(w, dim, mode, potential, false, i, j, end, &coincident);
	}
	w->coincident[i / width] = coincident;
}

/* All pairs i in [i0, i1), j in [j0, j1) once; on the diagonal those with j > i. ROWS particles i at a time share what is loaded of j; tiles are
 * multiples of a vector, so none is left over. */
PM_LANES_INLINE void tiles(const struct work *w, int dim, enum mode mode, bool potential, bool diagonal, size_t i0, size_t i1, size_t j0, size_t j1,
	uint64_t *coincident)
{
	for (size_t i = i0; i < i1; i += ROWS) {
		pm_lanes x[3][ROWS], g[3][ROWS], qi[ROWS], phi[ROWS], zero = {0}, delta2 = pm_lanes_all(w->delta2);
		PM_LANES_UNROLL
		for (int k = 0; k < ROWS; k++) {
			qi[k] = pm_lanes_all(w->q[i + (size_t)k]), phi[k] = zero;
			PM_LANES_UNROLL
			for (int d = 0; d < dim; d++)
				x[d][k] = pm_lanes_all(w->x[d][i + (size_t)k]), g[d][k] = zero;
		}
		for (size_t j = diagonal ? i / PM_LANES * PM_LANES : j0; j < j1; j += PM_LANES) {
			pm_lanes y[3], h[3], qj = pm_lanes_load(w->q + j), phj = potential ? pm_lanes_load(w->phi + j) : zero;
			PM_LANES_UNROLL
			for (int d = 0; d < dim; d++)
				y[d] = pm_lanes_load(w->x[d] + j), h[d] = pm_lanes_load(w->g[d] + j);
			PM_LANES_UNROLL
			for (int k = 0; k < ROWS; k++) {
				pm_lanes s[3], d2 = delta2, f, u = zero;
				PM_LANES_UNROLL
				for (int d = 0; d < dim; d++) {
					s[d] = x[d][k] - y[d];
					d2 = pm_lanes_fma(s[d], s[d], d2);
				}
				pair(w, dim, mode, potential, d2, &f, &u);
				if (mode != SQUARE && __builtin_expect(pm_lanes_any_below(d2, pm_lanes_all(least)), 0))
					*coincident += count(j, i + (size_t)k + 1, i + (size_t)k < w->targets ? w->n : 0, &d2);
				if (diagonal && j <= i + (size_t)k)
					f = after(j, i + (size_t)k, f), u = after(j, i + (size_t)k, u);
				pm_lanes fi = f * qj, fj = f * qi[k];
				PM_LANES_UNROLL
				for (int d = 0; d < dim; d++) {
					g[d][k] = pm_lanes_fma(fi, s[d], g[d][k]);
					h[d] = pm_lanes_fnma(fj, s[d], h[d]);
				}
				if (potential)
					phi[k] = pm_lanes_fma(qj, u, phi[k]), phj = pm_lanes_fma(qi[k], u, phj);
			}
			PM_LANES_UNROLL
			for (int d = 0; d < dim; d++)
				pm_lanes_store(w->g[d] + j, h[d]);
			if (potential)
				pm_lanes_store(w->phi + j, phj);
		}
		PM_LANES_UNROLL
		for (int k = 0; k < ROWS; k++) {
			PM_LANES_UNROLL
			for (int d = 0; d < dim; d++)
				w->g[d][i + (size_t)k] += pm_lanes_sum(g[d][k]);
			if (potential)
				w->phi[i + (size_t)k] += pm_lanes_sum(phi[k]);
		}
	}
}

/* Each pair of two tiles once. */
PM_LANES_INLINE void meeting(const struct work *w, int dim, enum mode mode, bool potential, size_t a, size_t b)
{
	size_t a0 = a * w->tile, a1 = a0 + w->tile < w->padded ? a0 + w->tile : w->padded;
	size_t b0 = b * w->tile, b1 = b0 + w->tile < w->padded ? b0 + w->tile : w->padded;
	if (a == b)
		tiles(w, dim, mode, potential, true, a0, a1, b0, b1, w->coincident + a);
	else
		tiles(w, dim, mode, potential, false, a0, a1, b0, b1, w->coincident + a);
}

/* One loop compiled for each dimension, mode and kind of result. */
struct loops {
	void (*group)(const struct work *w, size_t i);
	void (*meeting)(const struct work *w, size_t a, size_t b);
};
#define LOOPS(dim, mode) \
	static void group_##dim##_##mode(const struct work *w, size_t i) { group(w, dim, mode, false, i); } \
	static void group_phi_##dim##_##mode(const struct work *w, size_t i) { group(w, dim, mode, true, i); } \
	static void meeting_##dim##_##mode(const struct work *w, size_t a, size_t b) { meeting(w, dim, mode, false, a, b); } \
	static void meeting_phi_##dim##_##mode(const struct work *w, size_t a, size_t b) { meeting(w, dim, mode, true, a, b); }
#define ROW(mode) { \
	{{group_1_##mode, meeting_1_##mode}, {group_phi_1_##mode, meeting_phi_1_##mode}}, \
	{{group_2_##mode, meeting_2_##mode}, {group_phi_2_##mode, meeting_phi_2_##mode}}, \
	{{group_3_##mode, meeting_3_##mode}, {group_phi_3_##mode, meeting_phi_3_##mode}}}
LOOPS(1, SQUARE) LOOPS(2, SQUARE) LOOPS(3, SQUARE)
LOOPS(1, GUARDED) LOOPS(2, GUARDED) LOOPS(3, GUARDED)
LOOPS(1, OTHER) LOOPS(2, OTHER) LOOPS(3, OTHER)
static const struct loops table[3][3][2] = {ROW(SQUARE), ROW(GUARDED), ROW(OTHER)};

static void full(const struct work *w, const struct loops *l)
{
	size_t width = GROUP * PM_LANES, groups = (w->targets + width - 1) / width;
#pragma omp parallel for schedule(static) if (groups > 8)
	for (size_t i = 0; i < groups; i++)
		l->group(w, i * width);
}

/* A tournament of m tiles: in round r meet those with a + b = r modulo m, a <= b. */
static void half(const struct work *w, const struct loops *l)
{
	size_t m = (w->padded + w->tile - 1) / w->tile;
#pragma omp parallel if (w->n > 1000)
	for (size_t r = 0; r < m; r++) {
		size_t below = r / 2 + 1, meetings = below + (r + m) / 2 - r;
#pragma omp for schedule(static)
		for (size_t k = 0; k < meetings; k++) {
			size_t a = k < below ? k : r + 1 + (k - below);
			l->meeting(w, a, (r + m - a) % m);
		}
	}
}

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
		const struct loops *l = &table[mode][p->dim - 1][potential != NULL];
		p->half ? half(&w, l) : full(&w, l);
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
