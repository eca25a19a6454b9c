/* Bulk quantities of particles: mass, kinetic energy, momentum and its scale sum m|v|, angular momentum, first moment, largest distance.
 * Each is a sum over particles, compensated (Neumaier 1974), with eight partial sums per block of pm_sum_block particles; partial sums and blocks are added
 * in the order of the stream (base/in-order.h). Cost N. SPDX-License-Identifier: GPL-3.0-or-later */
#include "measure/measure.h"
#include "base/simd-sum.h"
#include "stream/over-stretches.h"

enum { MASS, KINETIC, MOMENTUM, SCALE = MOMENTUM + 3, ANGULAR, MOMENT = ANGULAR + 3, SQUARE = MOMENT + 3, SUMS };

struct block {
	struct pm_sum sum[SUMS];
	double farthest2;
};

/* The running sums of a block, for eight particles side by side. */
struct lanes {
	struct pm_simd_sum sum[SUMS];
	pm_simd farthest2;
};

PM_SIMD_INLINE pm_simd load(const double *p, size_t n) { return n == PM_SIMD_WIDTH ? pm_simd_load_any(p) : pm_simd_load_few(p, n); }

PM_SIMD_INLINE pm_simd root(pm_simd v)
{
	for (int l = 0; l < PM_SIMD_WIDTH; l++)
		v[l] = sqrt(v[l]);
	return v;
}

PM_SIMD_INLINE pm_simd larger(pm_simd a, pm_simd b)
{
	pm_simd_bits below = a < b;
	return (pm_simd)(((pm_simd_bits)b & below) | ((pm_simd_bits)a & ~below));
}

/* Loads n particles from i on; the rest of the eight are 0. */
PM_SIMD_INLINE void add_particles(int dim, int vdim, const struct pm_measured *b, size_t i, size_t n, struct lanes *s)
{
	pm_simd x[3] = {{0}}, v[3] = {{0}}, x2 = {0}, v2 = {0};
	const pm_simd m = b->mass ? load(b->mass + i, n) : pm_simd_all(NAN);
	for (int d = 0; d < dim; d++)
		x[d] = load(b->x[d] + i, n), x2 += x[d] * x[d];
	for (int d = 0; d < vdim; d++)
		v[d] = load(b->v[d] + i, n), v2 += v[d] * v[d];
	s->farthest2 = larger(s->farthest2, x2);
	pm_simd_sum_add(&s->sum[MASS], m);
	for (int d = 0; d < 3; d++)
		pm_simd_sum_add(&s->sum[MOMENT + d], m * x[d]);
	if (!vdim)
		return;
	pm_simd p = m; /* momentum over velocity */
	if (b->c > 0) {
		const pm_simd gamma = 1 / root(1 - v2 / (b->c * b->c));
		p = m * gamma;
		pm_simd_sum_add(&s->sum[KINETIC], p * v2 * (gamma / (1 + gamma)));
	} else
		pm_simd_sum_add(&s->sum[KINETIC], 0.5 * m * v2);
	pm_simd_sum_add(&s->sum[SCALE], p * root(v2));
	pm_simd_sum_add(&s->sum[SQUARE], v2);
	for (int d = 0; d < 3; d++) {
		const int e = (d + 1) % 3, g = (d + 2) % 3;
		pm_simd_sum_add(&s->sum[MOMENTUM + d], p * v[d]);
		pm_simd_sum_add(&s->sum[ANGULAR + d], p * (x[e] * v[g] - x[g] * v[e]));
	}
}

PM_SIMD_INLINE void add_block(int dim, int vdim, const struct pm_measured *b, size_t from, size_t to, struct lanes *s)
{
	size_t i = from;
	for (; i + PM_SIMD_WIDTH <= to; i += PM_SIMD_WIDTH)
		add_particles(dim, vdim, b, i, PM_SIMD_WIDTH, s);
	if (i < to)
		add_particles(dim, vdim, b, i, to - i, s);
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
	for (int s = 0; s < SUMS; s++)
		pm_simd_sum_join(&block->sum[s], &lanes.sum[s]);
	for (int l = 0; l < PM_SIMD_WIDTH; l++)
		block->farthest2 = fmax(block->farthest2, lanes.farthest2[l]);
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
