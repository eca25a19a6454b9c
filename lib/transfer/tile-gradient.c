/* A gradient made for the tile of particles that needs it, from the potential: rows of nodes by whole vectors, where a row goes over the end of the
 * box node by node. The sums are those of difference-rows.c: the same bytes. Cost: six numbers read per node and order 2, from the nearest caches but for one.
 * SPDX-License-Identifier: GPL-3.0-or-later */
#include "transfer/tile-gradient.h"
#include "transfer/tile-vector.h"

enum { W = PM_SIMD_WIDTH, MOST = 3 };

/* A row of the potential, and those beside it. */
struct lines {
	const double *here, *up[3][MOST], *down[3][MOST]; /* [axis][pair]; of the row itself the distance is added */
	double w[3][MOST];
	size_t n; /* nodes of the axis */
};

PM_SIMD_INLINE pm_simd component(int pairs, const struct lines *l, int d, size_t i)
{
	pm_simd sum = l->w[d][0] * (pm_simd_load_any(l->up[d][0] + i) - pm_simd_load_any(l->down[d][0] + i));
	PM_SIMD_UNROLL
	for (int k = 1; k < pairs; k++)
		sum = sum + l->w[d][k] * (pm_simd_load_any(l->up[d][k] + i) - pm_simd_load_any(l->down[d][k] + i));
	return sum;
}

PM_SIMD_INLINE void some_nodes(int pairs, bool woven, const struct lines *l, size_t i, double *to)
{
	const pm_simd x = component(pairs, l, 0, i), y = component(pairs, l, 1, i), z = component(pairs, l, 2, i);
	if (woven)
		pm_simd_store_columns(to, (const pm_simd[]){x, y, z, x});
	else
		pm_simd_store_any(to, x), pm_simd_store_any(to + PM_BLOCK_MOST, y), pm_simd_store_any(to + 2 * PM_BLOCK_MOST, z);
}

/* So many nodes up and down a periodic axis of n nodes; a quotient would take longer than the differences of a row. */
static inline size_t above(size_t i, size_t far, size_t n) { return i + far < n ? i + far : i + far - n; }
static inline size_t below(size_t i, size_t far, size_t n) { return i >= far ? i - far : i + n - far; }

/* Node i, by itself. */
PM_SIMD_INLINE void one_node(int pairs, bool woven, const struct lines *l, size_t i, double *to)
{
	for (int d = 0; d < 3; d++) {
		double sum = 0;
		for (int k = 0; k < pairs; k++) {
			const size_t far = (size_t)k + 1;
			const double up = d ? l->up[d][k][i] : l->here[above(i, far, l->n)], down = d ? l->down[d][k][i] : l->here[below(i, far, l->n)];
			sum = k ? sum + l->w[d][k] * (up - down) : l->w[d][0] * (up - down);
		}
		to[woven ? (size_t)d : (size_t)d * PM_BLOCK_MOST] = sum;
	}
}

/* Nodes from..from+m-1. */
PM_SIMD_INLINE void run_of(int pairs, bool woven, const struct lines *l, size_t from, size_t m, double *to)
{
	const size_t step = woven ? 4 : 1, low = (size_t)pairs, high = l->n - (size_t)pairs;
	size_t i = 0, end = from + m < high ? m : high > from ? high - from : 0;
	for (; i < m && from + i < low; i++)
		one_node(pairs, woven, l, from + i, to + i * step);
	if (i + W <= end) {
		for (; i + W <= end; i += W)
			some_nodes(pairs, woven, l, from + i, to + i * step);
		some_nodes(pairs, woven, l, from + end - W, to + (end - W) * step);
		i = end;
	}
	for (; i < m; i++)
		one_node(pairs, woven, l, from + i, to + i * step);
}

PM_SIMD_INLINE void nodes_of(int pairs, bool woven, const struct pm_gradient_later *g, const struct pm_tile_nodes *b, double *to)
{
	const size_t *n = g->operator.grid.points, step = woven ? 4 : 1, *x = b->at[0];
	const size_t row = (size_t)pm_block_row[3] * step, plane = row * (size_t)pm_block_rows[3];
	const double *phi = pm_in(g->later.from, 0);
	struct lines l = {.n = n[0]};
	for (int d = 0; d < 3; d++)
		for (int k = 0; k < pairs; k++)
			l.w[d][k] = g->weight[d][k];
	for (size_t z = 0; z < b->slots[2]; z++)
		for (size_t y = 0; y < b->slots[1]; y++) {
			const size_t ay = b->at[1][y], az = b->at[2][z];
			const double *const in_plane = phi + az * n[1] * n[0];
			double *out = to + z * plane + y * row;
			l.here = in_plane + ay * n[0];
			PM_SIMD_UNROLL
			for (int k = 0; k < pairs; k++) {
				const size_t far = (size_t)k + 1;
				l.up[0][k] = l.here + far, l.down[0][k] = l.here - far;
				l.up[1][k] = in_plane + above(ay, far, n[1]) * n[0], l.down[1][k] = in_plane + below(ay, far, n[1]) * n[0];
				l.up[2][k] = phi + (above(az, far, n[2]) * n[1] + ay) * n[0], l.down[2][k] = phi + (below(az, far, n[2]) * n[1] + ay) * n[0];
			}
			for (size_t s = 0; s < b->from; s++)
				one_node(pairs, woven, &l, x[s], out + s * step);
			if (b->from < b->to)
				run_of(pairs, woven, &l, x[b->from], b->to - b->from, out + b->from * step);
			for (size_t s = b->to; s < b->slots[0]; s++)
				one_node(pairs, woven, &l, x[s], out + s * step);
		}
}

void pm_tile_gradient_of(const struct pm_gradient_later *l, const struct pm_tile_nodes *b, double *block, double *nodes)
{
	switch (l->operator.order) {
	case 2: nodes ? nodes_of(1, true, l, b, nodes) : nodes_of(1, false, l, b, block); break;
	case 4: nodes ? nodes_of(2, true, l, b, nodes) : nodes_of(2, false, l, b, block); break;
	default: nodes ? nodes_of(3, true, l, b, nodes) : nodes_of(3, false, l, b, block);
	}
}

void pm_tile_gradient_beside(const struct pm_gradient_later *l, const size_t at[3][2], double node[8][3])
{
	const size_t *n = l->operator.grid.points;
	const double *phi = pm_in(l->later.from, 0);
	const int pairs = l->operator.order / 2;
	for (size_t k = 0; k < 8; k++) {
		const size_t i[3] = {at[0][k & 1], at[1][k >> 1 & 1], at[2][k >> 2]};
		for (int d = 0; d < 3; d++) {
			double sum = 0;
			for (int pair = 0; pair < pairs; pair++) {
				size_t up[3] = {i[0], i[1], i[2]}, down[3] = {i[0], i[1], i[2]};
				up[d] = above(i[d], (size_t)pair + 1, n[d]), down[d] = below(i[d], (size_t)pair + 1, n[d]);
				const double above_it = phi[(up[2] * n[1] + up[1]) * n[0] + up[0]], below_it = phi[(down[2] * n[1] + down[1]) * n[0] + down[0]];
				const double more = l->weight[d][pair] * (above_it - below_it);
				sum = pair ? sum + more : more;
			}
			node[k][d] = sum;
		}
	}
}

void pm_tile_gradient_of_fetch(const struct pm_gradient_later *l, const struct pm_tile_nodes *b)
{
	enum { line = 8 }; /* doubles per line of the cache */
	const size_t *n = l->operator.grid.points, reach = (size_t)l->operator.order / 2;
	const double *phi = pm_in(l->later.from, 0);
	const size_t y0 = below(b->at[1][0], reach, n[1]);
	size_t z = below(b->at[2][0], reach, n[2]);
	for (size_t k = 0; k < b->slots[2] + 2 * reach; k++, z = above(z, 1, n[2]))
		for (size_t q = 0, y = y0; q < b->slots[1] + 2 * reach; q++, y = above(y, 1, n[1])) {
			const double *row = phi + (z * n[1] + y) * n[0] + b->at[0][0];
			for (size_t i = 0; i < b->slots[0] + line - 1; i += line)
				__builtin_prefetch(row + i, 0, 2);
		}
}

static struct pm_tile_nodes of_job(const struct pm_tile_pass *p, const struct pm_tile_job *j)
{
	struct pm_tile_nodes b;
	size_t first = 0;
	for (int d = 2; d >= 0; d--) {
		b.slots[d] = pm_tile_slots(p, j->tile, d, &first);
		b.at[d] = p->axes[d].at + first;
	}
	const size_t end = first + b.slots[0], from = p->axes[0].from, to = p->axes[0].to; /* of x */
	b.from = from < first ? 0 : from < end ? from - first : b.slots[0];
	b.to = to < first + b.from ? b.from : to < end ? to - first : b.slots[0];
	return b;
}

void pm_tile_gradient(const struct pm_gradient_later *l, const struct pm_tile_pass *p, const struct pm_tile_job *j, double *block, double *nodes)
{
	const struct pm_tile_nodes b = of_job(p, j);
	pm_tile_gradient_of(l, &b, block, nodes);
}

void pm_tile_gradient_fetch(const struct pm_gradient_later *l, const struct pm_tile_pass *p, const struct pm_tile_job *j)
{
	if (!j)
		return;
	const struct pm_tile_nodes b = of_job(p, j);
	pm_tile_gradient_of_fetch(l, &b);
}
