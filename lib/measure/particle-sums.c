/* Bulk quantities of particles: mass, kinetic energy, momentum and its scale sum m|v|, angular momentum, first moment, largest distance.
 * Each is a sum over particles, with eight partial sums per block of pm_sum_block particles, lane by lane: a lane adds the values of eight particles by pairs,
 * pairs of pairs and so on, which is exact for equal ones, then the result to its compensated sum (Neumaier 1974). So each value is rounded three times more
 * than as a product, and the long sum is not. Partial sums and blocks are added in the order of the stream (base/in-order.h). Cost N.
 * SPDX-License-Identifier: GPL-3.0-or-later */
#include "measure/measure.h"
#include "base/simd-sum.h"
#include "stream/over-stretches.h"

enum { MASS, KINETIC, MOMENTUM, SCALE = MOMENTUM + 3, ANGULAR, MOMENT = ANGULAR + 3, SQUARE = MOMENT + 3, SUMS };
enum { lanes_all = 8, group = 8, lot = lanes_all * group, parts_of = lanes_all / PM_SIMD_PART };
enum { AHEAD = 256 }; /* particles, fetched before they are read */

struct block {
	struct pm_sum sum[SUMS];
	double farthest2;
};

/* The running sums of a block, of eight lanes as registers have them. */
struct lanes {
	pm_simd_part sum[parts_of][SUMS], carry[parts_of][SUMS], farthest2[parts_of];
};

/* Arrays of particles, and what all of them share. */
struct particles {
	const double *x[3], *v[3], *mass;
	double c;
};

PM_SIMD_INLINE pm_simd_part load(const double *p)
{
	pm_simd_part v;
	memcpy(&v, p, sizeof v);
	return v;
}

PM_SIMD_INLINE pm_simd_part root(pm_simd_part v)
{
	for (int l = 0; l < PM_SIMD_PART; l++)
		v[l] = sqrt(v[l]);
	return v;
}

PM_SIMD_INLINE pm_simd_part larger(pm_simd_part a, pm_simd_part b)
{
	const __typeof__(a < b) below = a < b;
	return (pm_simd_part)(((__typeof__(below))b & below) | ((__typeof__(below))a & ~below));
}

/* The terms of the particles i .. of one register; those that there are not stay as they are. */
PM_SIMD_INLINE void terms_of(const int dim, const int vdim, const struct particles *b, size_t i, pm_simd_part *t, pm_simd_part *farthest2)
{
	pm_simd_part x[3] = {{0}}, v[3] = {{0}}, x2 = {0}, v2 = {0}, m = {0};
	m = b->mass ? load(b->mass + i) : m + (double)NAN;
	PM_SIMD_UNROLL
	for (int d = 0; d < dim; d++)
		x[d] = load(b->x[d] + i), x2 += x[d] * x[d], t[MOMENT + d] = m * x[d];
	PM_SIMD_UNROLL
	for (int d = 0; d < vdim; d++)
		v[d] = load(b->v[d] + i), v2 += v[d] * v[d];
	*farthest2 = larger(*farthest2, x2);
	t[MASS] = m;
	if (!vdim)
		return;
	pm_simd_part p = m; /* momentum over velocity */
	if (b->c > 0) {
		const pm_simd_part gamma = 1 / root(1 - v2 / (b->c * b->c));
		p = m * gamma;
		t[KINETIC] = p * v2 * (gamma / (1 + gamma));
	} else
		t[KINETIC] = 0.5 * m * v2;
	t[SCALE] = p * root(v2);
	t[SQUARE] = v2;
	PM_SIMD_UNROLL
	for (int d = 0; d < 3; d++) {
		const int e = (d + 1) % 3, f = (d + 2) % 3;
		t[MOMENTUM + d] = p * v[d];
		t[ANGULAR + d] = p * (x[e] * v[f] - x[f] * v[e]);
	}
}

/* Asks for eight particles further on, into the second-level cache: in the first, arrays of whole pages would put each other out. */
PM_SIMD_INLINE void fetch(const int dim, const int vdim, const struct particles *b, size_t i)
{
	for (int d = 0; d < dim; d++)
		__builtin_prefetch(b->x[d] + i + AHEAD, 0, 2);
	for (int d = 0; d < vdim; d++)
		__builtin_prefetch(b->v[d] + i + AHEAD, 0, 2);
	if (b->mass)
		__builtin_prefetch(b->mass + i + AHEAD, 0, 2);
}

/* A lot of particles from i on. */
PM_SIMD_INLINE void add_lot(const int dim, const int vdim, const struct particles *b, size_t i, struct lanes *to)
{
	for (size_t part = 0; part < parts_of; part++) {
		pm_simd_part pair[group / 2][SUMS], t[2][SUMS] = {{{0}}}, farthest2 = to->farthest2[part], *sum = to->sum[part], *carry = to->carry[part];
		for (size_t q = 0; q < group / 2; q++) {
			if (!part)
				fetch(dim, vdim, b, i + 2 * q * lanes_all), fetch(dim, vdim, b, i + (2 * q + 1) * lanes_all);
			PM_SIMD_UNROLL
			for (size_t m = 0; m < 2; m++)
				terms_of(dim, vdim, b, i + (2 * q + m) * lanes_all + part * PM_SIMD_PART, t[m], &farthest2);
			PM_SIMD_UNROLL_MORE
			for (int s = 0; s < SUMS; s++)
				pair[q][s] = t[0][s] + t[1][s];
		}
		to->farthest2[part] = farthest2;
		PM_SIMD_UNROLL_MORE
		for (int s = 0; s < SUMS; s++) {
			const pm_simd_part g = (pair[0][s] + pair[1][s]) + (pair[2][s] + pair[3][s]), all = sum[s] + g, z = all - sum[s];
			carry[s] += (sum[s] - (all - z)) + (g - z);
			sum[s] = all;
		}
	}
}

/* The last particles are followed by such of no mass at 0. */
PM_SIMD_INLINE void add_block(const int dim, const int vdim, const struct pm_measured *b, size_t from, size_t to, struct lanes *lanes)
{
	double last[7][lot] = {{0}};
	struct particles p = {.mass = b->mass, .c = b->c};
	for (int d = 0; d < 3; d++)
		p.x[d] = b->x[d], p.v[d] = b->v[d];
	for (; from + lot <= to; from += lot)
		add_lot(dim, vdim, &p, from, lanes);
	if (from == to)
		return;
	for (int d = 0; d < 3; d++) {
		if (d < dim)
			p.x[d] = memcpy(last[d], b->x[d] + from, (to - from) * sizeof(double));
		if (d < vdim)
			p.v[d] = memcpy(last[3 + d], b->v[d] + from, (to - from) * sizeof(double));
	}
	if (b->mass)
		p.mass = memcpy(last[6], b->mass + from, (to - from) * sizeof(double));
	add_lot(dim, vdim, &p, 0, lanes);
}

static void make_block(const void *data, size_t from, size_t to, void *part)
{
	const struct pm_measured *b = data;
	struct block *block = part;
	struct lanes lanes = {0};
	if (b->dim == 3 && b->vdim == 3)
		add_block(3, 3, b, from, to, &lanes);
	else
		add_block(b->dim, b->vdim, b, from, to, &lanes);
	for (int s = 0; s < SUMS; s++) {
		struct pm_simd_sum all;
		for (size_t r = 0; r < parts_of; r++) {
			memcpy((char *)&all.sum + r * sizeof(pm_simd_part), &lanes.sum[r][s], sizeof(pm_simd_part));
			memcpy((char *)&all.carry + r * sizeof(pm_simd_part), &lanes.carry[r][s], sizeof(pm_simd_part));
		}
		pm_simd_sum_join(&block->sum[s], &all);
	}
	for (int l = 0; l < lanes_all; l++)
		block->farthest2 = fmax(block->farthest2, lanes.farthest2[l / PM_SIMD_PART][l % PM_SIMD_PART]);
}

static void join(size_t size, const void *part, void *all)
{
	(void)size;
	const struct block *from = part;
	struct block *to = all;
	pm_join_sums(sizeof from->sum, from->sum, to->sum);
	to->farthest2 = fmax(to->farthest2, from->farthest2);
}

void pm_particle_sums_add(const struct pm_measured *b, struct pm_particle_sums *bulk)
{
	const struct pm_parts parts = {.size = sizeof(struct block), .make = make_block, .join = join};
	struct block all = {0};
	const double n = (double)(b->field ? b->all : b->n);
	if (b->field)
		pm_over_stretches(b->field, &parts, b, &all);
	else
		pm_over_set(&parts, b, b->n, &all);
	bulk->n += n;
	bulk->movers += b->vdim ? n : 0;
	bulk->mass += pm_sum_total(all.sum[MASS]);
	bulk->kinetic += pm_sum_total(all.sum[KINETIC]);
	bulk->scale += pm_sum_total(all.sum[SCALE]);
	bulk->square += pm_sum_total(all.sum[SQUARE]);
	for (int d = 0; d < 3; d++) {
		bulk->momentum[d] += pm_sum_total(all.sum[MOMENTUM + d]);
		bulk->angular[d] += pm_sum_total(all.sum[ANGULAR + d]);
		bulk->moment[d] += pm_sum_total(all.sum[MOMENT + d]);
	}
	bulk->farthest = fmax(bulk->farthest, sqrt(all.farthest2));
}
