/* Bulk quantities of particles: mass, kinetic energy, momentum and its scale sum m|v|, angular momentum, first moment, largest distance.
 * Each is a sum over particles, compensated (Neumaier 1974) in blocks of pm_sum_block particles; the blocks are joined in their order, whatever
 * thread made them. Cost N. SPDX-License-Identifier: GPL-3.0-or-later */
#include "measure/measure.h"

enum { MASS, KINETIC, MOMENTUM, SCALE = MOMENTUM + 3, ANGULAR, MOMENT = ANGULAR + 3, SQUARE = MOMENT + 3, SUMS };
enum { BATCH = 64 }; /* blocks between two joins; bounds the memory, not the result */

struct block {
	struct pm_sum sum[SUMS];
	double farthest2;
};

static void add_particle(const struct pm_bodies *b, size_t i, struct block *block)
{
	double x[3] = {0}, v[3] = {0}, x2 = 0, v2 = 0;
	const double m = b->mass ? b->mass[i] : NAN;
	for (int d = 0; d < b->dim; d++)
		x[d] = b->x[d][i], x2 += x[d] * x[d];
	for (int d = 0; d < b->vdim; d++)
		v[d] = b->v[d][i], v2 += v[d] * v[d];
	block->farthest2 = fmax(block->farthest2, x2);
	pm_sum_add(&block->sum[MASS], m);
	for (int d = 0; d < 3; d++)
		pm_sum_add(&block->sum[MOMENT + d], m * x[d]);
	if (!b->vdim)
		return;
	pm_sum_add(&block->sum[KINETIC], 0.5 * m * v2);
	pm_sum_add(&block->sum[SCALE], m * sqrt(v2));
	pm_sum_add(&block->sum[SQUARE], v2);
	for (int d = 0; d < 3; d++) {
		const int e = (d + 1) % 3, g = (d + 2) % 3;
		pm_sum_add(&block->sum[MOMENTUM + d], m * v[d]);
		pm_sum_add(&block->sum[ANGULAR + d], m * (x[e] * v[g] - x[g] * v[e]));
	}
}

static struct block block_of(const struct pm_bodies *b, size_t from)
{
	struct block block = {0};
	const size_t to = from + pm_sum_block < b->n ? from + pm_sum_block : b->n;
	for (size_t i = from; i < to; i++)
		add_particle(b, i, &block);
	return block;
}

static void join(struct block *all, const struct block *block)
{
	for (int s = 0; s < SUMS; s++) {
		pm_sum_add(&all->sum[s], block->sum[s].sum);
		pm_sum_add(&all->sum[s], block->sum[s].carry);
	}
	all->farthest2 = fmax(all->farthest2, block->farthest2);
}

void pm_bulk_add(const struct pm_bodies *b, struct pm_bulk *bulk)
{
	struct block all = {0}, batch[BATCH];
	const size_t blocks = (b->n + pm_sum_block - 1) / pm_sum_block;
	for (size_t first = 0; first < blocks; first += BATCH) {
		const size_t n = blocks - first < BATCH ? blocks - first : BATCH;
#pragma omp parallel for schedule(static) if (n > 1)
		for (size_t k = 0; k < n; k++)
			batch[k] = block_of(b, (first + k) * pm_sum_block);
		for (size_t k = 0; k < n; k++)
			join(&all, &batch[k]);
	}
	bulk->n += (double)b->n;
	bulk->movers += b->vdim ? (double)b->n : 0;
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
