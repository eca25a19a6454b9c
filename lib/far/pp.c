/* Direct summation: grad phi_i = sum_j q_j f(|x_i - x_j|) (x_i - x_j) over all pairs, O(N^2), the reference for every other far field.
 * Source: Hockney and Eastwood 1988, section 1-4-1 (particle-particle method); mollifiers as in lib/mollifier.
 * Full loop: 32 targets of a set in registers, sources in blocks of 1024 that stay in the first cache; blocks end at multiples of 1024 of their
 * set, and block sums keep the round-off near (1024 + N/1024) units. Half loop: tiles of 2^k particles of a set meet in the rounds of a tournament,
 * in each of which a tile meets one other; a meeting sums apart, and is added in the order of rounds. So no sum depends on who computes it
 * (docs/distributed.md). 1/r^3 from the 14-bit 1/sqrt(r^2) with a correction of fourth order (6e-16).
 * Conserves momentum to round-off. Split up: far/pair-forces.h a vector of pairs, far/pp-plain.c the loop these are tested against.
 * Assumes open space. Pairs below r = 1e-100 without mollifier exert no force. Cost: 18 vector operations per 8 pairs in 3-D.
 * SPDX-License-Identifier: GPL-3.0-or-later */
#include <string.h>

#include "far/pp.h"
#include "far/pair-forces.h"

enum { GROUP = 4, SOURCES = 1024, ROWS = 2 }; /* vectors of targets per group; sources per block; particles at a time in the half loop */

enum { TILE = 512 }; /* particles of a tile at most; a power of two, so that tiles end with the blocks of the stream */

static const double far_away = 1e70; /* position of the particles that fill up a set, each a multiple; 1/r^3 is not denormal; their strength is 0 */

/* Copies in which every set begins with a group and is filled up to a whole one, and the sums. */
struct work {
	size_t targets, padded, sets, tiles; /* places of targets and of all */
	size_t *from, *count, *tile; /* of each set the first place and the particles; of each tile its places */
	const size_t *own;           /* of each set the targets that are wanted; NULL: all */
	double *x[3], *q, *g[3], *phi;
	struct pm_field_pairs how;
	uint64_t *coincident; /* pairs, per group or tile */
};

/* Constants for which the compiler makes a separate loop. */
struct how {
	int dim;
	enum pm_pairs_mode mode;
	bool potential;
};

/* Sources [j0, j1) on the group of targets at i. self: the group may be among the sources. */
PM_SIMD_INLINE void group_block(const struct work *w, const struct how how, bool self, size_t i, size_t j0, size_t j1, unsigned *coincident)
{
	const int dim = how.dim;
	const enum pm_pairs_mode mode = how.mode;
	const bool potential = how.potential;
	pm_simd x[3][GROUP], g[3][GROUP], phi[GROUP], zero = {0}, delta2 = pm_simd_all(w->how.delta2);
	PM_SIMD_UNROLL
	for (int k = 0; k < GROUP; k++) {
		PM_SIMD_UNROLL
		for (int d = 0; d < dim; d++)
			x[d][k] = pm_simd_load(w->x[d] + i + (size_t)k * PM_SIMD_WIDTH), g[d][k] = zero;
		phi[k] = zero;
	}
	for (size_t j = j0; j < j1; j++) {
		pm_simd q = pm_simd_all(w->q[j]), y[3];
		PM_SIMD_UNROLL
		for (int d = 0; d < dim; d++)
			y[d] = pm_simd_all(w->x[d][j]);
		PM_SIMD_UNROLL
		for (int k = 0; k < GROUP; k++) {
			pm_simd s[3], d2 = delta2, f, u = zero;
			PM_SIMD_UNROLL
			for (int d = 0; d < dim; d++) {
				s[d] = x[d][k] - y[d];
				d2 = pm_simd_fma(s[d], s[d], d2);
			}
			pm_pairs_meet(&w->how, dim, mode, potential, d2, &f, &u);
			if (mode != PM_SQUARE && __builtin_expect(pm_simd_any_below(d2, pm_simd_all(pm_pairs_least)), 0))
				*coincident += pm_pairs_count(i + (size_t)k * PM_SIMD_WIDTH, 0, j < w->targets ? j : w->targets, &d2); /* each pair once */
			if (self)
				f = pm_pairs_others(i + (size_t)k * PM_SIMD_WIDTH, j, f), u = pm_pairs_others(i + (size_t)k * PM_SIMD_WIDTH, j, u);
			f *= q;
			PM_SIMD_UNROLL
			for (int d = 0; d < dim; d++)
				g[d][k] = pm_simd_fma(f, s[d], g[d][k]);
			if (potential)
				phi[k] = pm_simd_fma(q, u, phi[k]);
		}
	}
	PM_SIMD_UNROLL
	for (int k = 0; k < GROUP; k++) {
		size_t at = i + (size_t)k * PM_SIMD_WIDTH;
		PM_SIMD_UNROLL
		for (int d = 0; d < dim; d++)
			pm_simd_store(w->g[d] + at, pm_simd_load(w->g[d] + at) + g[d][k]);
		if (potential)
			pm_simd_store(w->phi + at, pm_simd_load(w->phi + at) + phi[k]);
	}
}

/* All sources on one group of targets; blocks also end where the group's own particles begin and end. */
PM_SIMD_INLINE void group(const struct work *w, const struct how how, size_t i)
{
	size_t width = GROUP * PM_SIMD_WIDTH;
	unsigned coincident = 0;
	for (size_t s = 0; s < w->sets; s++)
		for (size_t first = w->from[s], last = first + w->count[s], j = first, end; j < last; j = end) {
			end = first + ((j - first) / SOURCES + 1) * SOURCES;
			end = end < last ? end : last;
			bool self = j >= i && j < i + width;
			end = self && end > i + width ? i + width : !self && j < i && end > i ? i : end;
			if (self)
				group_block(w, how, true, i, j, end, &coincident);
			else
				group_block(w, how, false, i, j, end, &coincident);
		}
	w->coincident[i / width] = coincident;
}

/* What one tile receives in one meeting, by place from its first. */
struct received {
	double g[3][TILE + PM_SIMD_WIDTH], phi[TILE + PM_SIMD_WIDTH]; /* whole vectors, not a page apart */
	size_t from, to;
} __attribute__((aligned(64)));

/* ROWS particles of the half loop, each in all lanes: they share what is loaded of the others. */
struct rows {
	pm_simd x[3][ROWS], g[3][ROWS], q[ROWS], phi[ROWS];
};

PM_SIMD_INLINE struct rows rows_load(const struct work *w, int dim, size_t i)
{
	struct rows r;
	PM_SIMD_UNROLL
	for (size_t k = 0; k < ROWS; k++) {
		r.q[k] = pm_simd_all(w->q[i + k]), r.phi[k] = pm_simd_all(0);
		PM_SIMD_UNROLL
		for (int d = 0; d < dim; d++)
			r.x[d][k] = pm_simd_all(w->x[d][i + k]), r.g[d][k] = pm_simd_all(0);
	}
	return r;
}

PM_SIMD_INLINE void rows_add(struct received *to, int dim, bool potential, size_t i, const struct rows *r)
{
	PM_SIMD_UNROLL
	for (size_t k = 0; k < ROWS; k++) {
		PM_SIMD_UNROLL
		for (int d = 0; d < dim; d++)
			to->g[d][i - to->from + k] += pm_simd_sum(r->g[d][k]);
		if (potential)
			to->phi[i - to->from + k] += pm_simd_sum(r->phi[k]);
	}
}

/* The rows at i with the vector at j, both ways; on the diagonal those of j that come after. */
PM_SIMD_INLINE void rows_meet(const struct work *w, const struct how how, bool diagonal, size_t i, size_t j, struct rows *r, struct received *to,
	uint64_t *coincident)
{
	const int dim = how.dim;
	const enum pm_pairs_mode mode = how.mode;
	const bool potential = how.potential;
	pm_simd y[3], h[3], zero = {0}, delta2 = pm_simd_all(w->how.delta2), q = pm_simd_load(w->q + j);
	pm_simd phi = potential ? pm_simd_load(to->phi + (j - to->from)) : zero;
	PM_SIMD_UNROLL
	for (int d = 0; d < dim; d++)
		y[d] = pm_simd_load(w->x[d] + j), h[d] = pm_simd_load(to->g[d] + (j - to->from));
	PM_SIMD_UNROLL
	for (size_t k = 0; k < ROWS; k++) {
		pm_simd s[3], d2 = delta2, f, u = zero;
		PM_SIMD_UNROLL
		for (int d = 0; d < dim; d++) {
			s[d] = r->x[d][k] - y[d];
			d2 = pm_simd_fma(s[d], s[d], d2);
		}
		pm_pairs_meet(&w->how, dim, mode, potential, d2, &f, &u);
		if (mode != PM_SQUARE && __builtin_expect(pm_simd_any_below(d2, pm_simd_all(pm_pairs_least)), 0))
			*coincident += pm_pairs_count(j, i + k + 1, i + k < w->targets ? w->padded : 0, &d2);
		if (diagonal && j <= i + k)
			f = pm_pairs_after(j, i + k, f), u = pm_pairs_after(j, i + k, u);
		pm_simd fi = f * q, fj = f * r->q[k];
		PM_SIMD_UNROLL
		for (int d = 0; d < dim; d++) {
			r->g[d][k] = pm_simd_fma(fi, s[d], r->g[d][k]);
			h[d] = pm_simd_fnma(fj, s[d], h[d]);
		}
		if (potential)
			r->phi[k] = pm_simd_fma(q, u, r->phi[k]), phi = pm_simd_fma(r->q[k], u, phi);
	}
	PM_SIMD_UNROLL
	for (int d = 0; d < dim; d++)
		pm_simd_store(to->g[d] + (j - to->from), h[d]);
	if (potential)
		pm_simd_store(to->phi + (j - to->from), phi);
}

/* All pairs of one of a tile and one of another once; on the diagonal of each two of a tile. Tiles are multiples of a vector, so no row is left
 * over. */
PM_SIMD_INLINE void tiles(const struct work *w, const struct how how, bool diagonal, struct received *i, struct received *j, uint64_t *coincident)
{
	for (size_t p = i->from; p < i->to; p += ROWS) {
		struct rows r = rows_load(w, how.dim, p);
		for (size_t q = diagonal ? p / PM_SIMD_WIDTH * PM_SIMD_WIDTH : j->from; q < j->to; q += PM_SIMD_WIDTH)
			rows_meet(w, how, diagonal, p, q, &r, j, coincident);
		rows_add(i, how.dim, how.potential, p, &r);
	}
}

PM_SIMD_INLINE void begin(const struct work *w, const struct how how, size_t tile, struct received *r)
{
	r->from = w->tile[2 * tile], r->to = w->tile[2 * tile + 1];
	for (int d = 0; d < how.dim; d++)
		memset(r->g[d], 0, (r->to - r->from) * sizeof(double));
	if (how.potential)
		memset(r->phi, 0, (r->to - r->from) * sizeof(double));
}

PM_SIMD_INLINE void finish(const struct work *w, const struct how how, const struct received *r)
{
	for (size_t i = r->from; i < r->to; i++) {
		for (int d = 0; d < how.dim; d++)
			w->g[d][i] += r->g[d][i - r->from];
		if (how.potential)
			w->phi[i] += r->phi[i - r->from];
	}
}

/* Each pair of two tiles once. */
PM_SIMD_INLINE void meeting(const struct work *w, const struct how how, size_t a, size_t b)
{
	struct received i, j;
	begin(w, how, a, &i);
	if (a == b) {
		tiles(w, how, true, &i, &i, w->coincident + a);
	} else {
		begin(w, how, b, &j);
		tiles(w, how, false, &i, &j, w->coincident + a);
		finish(w, how, &j);
	}
	finish(w, how, &i);
}

/* One loop compiled for each dimension, mode and kind of result. */
struct loops {
	void (*group)(const struct work *w, size_t i);
	void (*meeting)(const struct work *w, size_t a, size_t b);
};
#define LOOPS(dim, mode) \
	static void group_##dim##_##mode(const struct work *w, size_t i) { group(w, (struct how){dim, mode, false}, i); } \
	static void group_phi_##dim##_##mode(const struct work *w, size_t i) { group(w, (struct how){dim, mode, true}, i); } \
	static void meeting_##dim##_##mode(const struct work *w, size_t a, size_t b) { meeting(w, (struct how){dim, mode, false}, a, b); } \
	static void meeting_phi_##dim##_##mode(const struct work *w, size_t a, size_t b) { meeting(w, (struct how){dim, mode, true}, a, b); }
#define ROW(mode) { \
	{{group_1_##mode, meeting_1_##mode}, {group_phi_1_##mode, meeting_phi_1_##mode}}, \
	{{group_2_##mode, meeting_2_##mode}, {group_phi_2_##mode, meeting_phi_2_##mode}}, \
	{{group_3_##mode, meeting_3_##mode}, {group_phi_3_##mode, meeting_phi_3_##mode}}}
LOOPS(1, PM_SQUARE) LOOPS(2, PM_SQUARE) LOOPS(3, PM_SQUARE)
LOOPS(1, PM_GUARDED) LOOPS(2, PM_GUARDED) LOOPS(3, PM_GUARDED)
LOOPS(1, PM_OTHER) LOOPS(2, PM_OTHER) LOOPS(3, PM_OTHER)
static const struct loops table[3][3][2] = {ROW(PM_SQUARE), ROW(PM_GUARDED), ROW(PM_OTHER)};

/* Is the particle at this place wanted? Groups and tiles are wanted as a whole. */
static bool wanted(const struct work *w, size_t place)
{
	size_t s = 0;
	while (s + 1 < w->sets && w->from[s + 1] <= place)
		s++;
	return !w->own || (place - w->from[s] >= w->own[2 * s] && place - w->from[s] < w->own[2 * s + 1]);
}

static void full(const struct work *w, const struct loops *l)
{
	size_t width = GROUP * PM_SIMD_WIDTH, groups = (w->targets + width - 1) / width;
#pragma omp parallel for schedule(static, 8) if (groups > 8)
	for (size_t i = 0; i < groups; i++)
		if (wanted(w, i * width))
			l->group(w, i * width);
}

/* A tournament of m tiles: in round r meet those with a + b = r modulo m, a <= b. Where some are wanted, those of them that meet others do so in full: what the
 * others receive is not used. */
static void half(const struct work *w, const struct loops *l)
{
	const size_t m = w->tiles;
#pragma omp parallel if (w->padded > 1000)
	for (size_t r = 0; r < m; r++) {
		size_t below = r / 2 + 1, meetings = below + (r + m) / 2 - r;
#pragma omp for schedule(static, 1)
		for (size_t k = 0; k < meetings; k++) {
			const size_t a = k < below ? k : r + 1 + (k - below), b = (r + m - a) % m;
			if (wanted(w, w->tile[2 * a]) || wanted(w, w->tile[2 * b]))
				l->meeting(w, a, b);
		}
	}
}

/* Sets one behind the other, to where they are in the copies. */
static double *padded(const struct work *w, const double *from, double fill)
{
	double *p = pm_alloc(w->padded, sizeof *p);
	for (size_t s = 0, at = 0, fills = 0; p && s < w->sets; at += w->count[s++]) {
		const size_t end = s + 1 < w->sets ? w->from[s + 1] : w->padded;
		memcpy(p + w->from[s], from + at, w->count[s] * sizeof *p);
		for (size_t i = w->from[s] + w->count[s]; i < end; i++)
			p[i] = (double)++fills * fill;
	}
	return p;
}

static void unpadded(const struct work *w, size_t targets, double factor, const double *from, double *to)
{
	for (size_t s = 0, at = 0; at < targets; at += w->count[s++])
		for (size_t i = 0; i < w->count[s] && at + i < targets; i++)
			to[at + i] = factor * from[w->from[s] + i];
}

static void work_free(struct work *w)
{
	for (int d = 0; d < 3; d++)
		pm_free(w->x[d]), pm_free(w->g[d]);
	pm_free(w->q), pm_free(w->phi), pm_free(w->coincident), pm_free(w->from), pm_free(w->count), pm_free(w->tile);
}

/* 16 tiles and more for threads to share, up to 512 particles each. */
static size_t tile_of(size_t n)
{
	size_t tile = PM_SIMD_WIDTH;
	while (tile < TILE && 16 * tile < n)
		tile *= 2;
	return tile;
}

/* Where sets and tiles begin and end. */
static int layout(struct work *w, const struct pm_pp *p, size_t targets, size_t n)
{
	const size_t width = GROUP * PM_SIMD_WIDTH, tile = tile_of(n);
	w->sets = p->sets ? p->sets : 1;
	w->from = pm_alloc(w->sets, sizeof *w->from), w->count = pm_alloc(w->sets, sizeof *w->count);
	w->tile = pm_alloc(2 * (n / tile + w->sets), sizeof *w->tile);
	if (!w->from || !w->count || !w->tile)
		return -PM_DATA;
	for (size_t s = 0, at = 0; s < w->sets; at += w->count[s++]) {
		w->from[s] = w->padded;
		w->count[s] = p->sets ? p->count[s] : n;
		for (size_t i = 0; i < w->count[s]; i += tile, w->tiles++) {
			const size_t end = i + tile < w->count[s] ? i + tile : (w->count[s] + PM_SIMD_WIDTH - 1) / PM_SIMD_WIDTH * PM_SIMD_WIDTH;
			w->tile[2 * w->tiles] = w->padded + i, w->tile[2 * w->tiles + 1] = w->padded + end;
		}
		if (at < targets)
			w->targets = w->padded + (targets - at < w->count[s] ? targets - at : w->count[s]);
		w->padded += (w->count[s] + width - 1) / width * width;
	}
	return 0;
}

static int work_init(struct work *w, const struct pm_pp *p, size_t targets, size_t n, const double *const *x, const double *q, bool potential)
{
	*w = (struct work){.how = pm_field_pairs_of(p->mollifier, p->delta, p->dim), .own = p->own};
	if (layout(w, p, targets, n))
		return -PM_DATA;
	for (int d = 0; d < p->dim; d++) {
		w->x[d] = padded(w, x[d], far_away);
		w->g[d] = pm_zalloc(w->padded, sizeof **w->g);
	}
	w->q = padded(w, q, 0);
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
	int status = work_init(&w, p, targets, n, x, q, potential != NULL);
	if (!status) {
		const struct loops *l = &table[w.how.mode][p->dim - 1][potential != NULL];
		p->half ? half(&w, l) : full(&w, l);
		const double c = 1 / pm_pairs_unit(p->dim);
		for (int d = 0; d < p->dim; d++)
			unpadded(&w, targets, c, w.g[d], gradient[d]);
		if (potential)
			unpadded(&w, targets, c, w.phi, potential);
		for (size_t i = 0; i < (p->half ? w.tiles : w.padded / (GROUP * PM_SIMD_WIDTH)); i++)
			*coincident += wanted(&w, p->half ? w.tile[2 * i] : i * GROUP * PM_SIMD_WIDTH) ? w.coincident[i] : 0;
	}
	work_free(&w);
	return status;
}
