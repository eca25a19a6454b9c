/* A gradient made for the tile of particles that needs it, from the potential: rows of nodes by whole vectors, where a row goes over the end of the
 * box node by node. The sums are those of difference-rows.c: the same bytes. Cost: six numbers read per node and order 2, from the nearest caches but for one.
 * SPDX-License-Identifier: GPL-3.0-or-later */
#include "transfer/tile-gradient.h"
#include "transfer/tile-vector.h"

enum { W = PM_SIMD_WIDTH, MOST = 3, PAGE = 512 /* doubles */ };

/* A row of the potential, and those beside it. */
struct lines {
	const double *here, *up[3][MOST], *down[3][MOST]; /* [component][pair]; of the row itself the distance is added */
	double w[3][MOST];
	int along; /* the component that is differenced along the row */
	size_t n; /* nodes of the row */
};

/* Where components go to: woven: those of a node side by side, nodes four numbers apart. */
struct shape {
	int dim, pairs;
	bool woven;
	size_t apart; /* components, where not woven */
	bool ahead;   /* rows go by one after the other: the farthest is fetched */
};

PM_SIMD_INLINE pm_simd component(int pairs, const struct lines *l, int c, size_t i)
{
	pm_simd sum = l->w[c][0] * (pm_simd_load_any(l->up[c][0] + i) - pm_simd_load_any(l->down[c][0] + i));
	PM_SIMD_UNROLL
	for (int k = 1; k < pairs; k++)
		sum = sum + l->w[c][k] * (pm_simd_load_any(l->up[c][k] + i) - pm_simd_load_any(l->down[c][k] + i));
	return sum;
}

PM_SIMD_INLINE void some_nodes(struct shape s, const struct lines *l, size_t i, double *to)
{
	if (s.ahead)
		__builtin_prefetch(l->up[s.dim > 2 ? 2 : !l->along][s.pairs - 1] + i + PAGE);
	const pm_simd x = component(s.pairs, l, 0, i), y = component(s.pairs, l, 1, i), z = s.dim > 2 ? component(s.pairs, l, 2, i) : x;
	if (s.woven) {
		pm_simd_store_columns(to, (const pm_simd[]){x, y, z, x});
		return;
	}
	pm_simd_store_any(to, x), pm_simd_store_any(to + s.apart, y);
	if (s.dim > 2)
		pm_simd_store_any(to + 2 * s.apart, z);
}

/* So many nodes up and down a periodic axis of n nodes; a quotient would take longer than the differences of a row. */
static inline size_t above(size_t i, size_t far, size_t n) { return i + far < n ? i + far : i + far - n; }
static inline size_t below(size_t i, size_t far, size_t n) { return i >= far ? i - far : i + n - far; }

/* Node i, by itself. */
PM_SIMD_INLINE void one_node(struct shape s, const struct lines *l, size_t i, double *to)
{
	for (int c = 0; c < s.dim; c++) {
		const bool along = c == l->along;
		double sum = 0;
		for (int k = 0; k < s.pairs; k++) {
			const size_t far = (size_t)k + 1;
			const double up = along ? l->here[above(i, far, l->n)] : l->up[c][k][i], down = along ? l->here[below(i, far, l->n)] : l->down[c][k][i];
			sum = k ? sum + l->w[c][k] * (up - down) : l->w[c][0] * (up - down);
		}
		to[(size_t)c * (s.woven ? 1 : s.apart)] = sum;
	}
}

/* Nodes from..from+m-1. */
PM_SIMD_INLINE void run_of(struct shape s, const struct lines *l, size_t from, size_t m, double *to)
{
	const size_t step = s.woven ? 4 : 1, low = (size_t)s.pairs, high = l->n - (size_t)s.pairs;
	size_t i = 0, end = from + m < high ? m : high > from ? high - from : 0;
	for (; i < m && from + i < low; i++)
		one_node(s, l, from + i, to + i * step);
	if (i + W <= end) {
		for (; i + W <= end; i += W)
			some_nodes(s, l, from + i, to + i * step);
		some_nodes(s, l, from + end - W, to + (end - W) * step);
		i = end;
	}
	for (; i < m; i++)
		one_node(s, l, from + i, to + i * step);
}

static inline const double *row_at(const double *phi, const size_t n[3], size_t y, size_t z) { return phi + (z * n[1] + y) * n[0]; }

/* l becomes that of a row: weights and size stay. */
PM_SIMD_INLINE void set_row(int dim, int pairs, const struct pm_gradient_later *g, const double *phi, size_t y, size_t z, struct lines *l)
{
	const size_t *n = g->operator.grid.points;
	l->here = row_at(phi, n, y, z);
	PM_SIMD_UNROLL
	for (int k = 0; k < pairs; k++) {
		const size_t far = (size_t)k + 1;
		PM_SIMD_UNROLL
		for (int c = 0; c < dim; c++) {
			const int axis = dim > 2 ? c : g->axis[c];
			const double *up = dim > 2 && axis == 2 ? row_at(phi, n, y, above(z, far, n[2])) : row_at(phi, n, above(y, far, n[1]), z);
			const double *down = dim > 2 && axis == 2 ? row_at(phi, n, y, below(z, far, n[2])) : row_at(phi, n, below(y, far, n[1]), z);
			l->up[c][k] = axis ? up : l->here + far, l->down[c][k] = axis ? down : l->here - far;
		}
	}
}

PM_SIMD_INLINE struct lines lines_of(int dim, int pairs, const struct pm_gradient_later *g)
{
	struct lines l;
	l.n = g->operator.grid.points[0], l.along = g->axis[0] ? 1 : 0;
	for (int c = 0; c < dim; c++)
		for (int k = 0; k < pairs; k++)
			l.w[c][k] = g->weight[c][k];
	return l;
}

PM_SIMD_INLINE void nodes_of(int dim, int pairs, bool woven, const struct pm_gradient_later *g, const struct pm_tile_nodes *b, double *to)
{
	const struct shape s = {dim, pairs, woven, PM_BLOCK_MOST, false};
	const size_t step = woven ? 4 : 1, *x = b->at[0];
	const size_t row = (size_t)pm_block_row[dim] * step, plane = row * (size_t)pm_block_rows[dim];
	const double *phi = pm_in(g->later.from, 0);
	struct lines l = lines_of(dim, pairs, g);
	for (size_t z = 0; z < b->slots[2]; z++)
		for (size_t y = 0; y < b->slots[1]; y++) {
			double *out = to + z * plane + y * row;
			set_row(dim, pairs, g, phi, b->at[1][y], b->at[2][z], &l);
			for (size_t i = 0; i < b->from; i++)
				one_node(s, &l, x[i], out + i * step);
			if (b->from < b->to)
				run_of(s, &l, x[b->from], b->to - b->from, out + b->from * step);
			for (size_t i = b->to; i < b->slots[0]; i++)
				one_node(s, &l, x[i], out + i * step);
		}
}

PM_SIMD_INLINE void nodes_in(int dim, bool woven, const struct pm_gradient_later *g, const struct pm_tile_nodes *b, double *to)
{
	switch (g->operator.order) {
	case 2: nodes_of(dim, 1, woven, g, b, to); break;
	case 4: nodes_of(dim, 2, woven, g, b, to); break;
	default: nodes_of(dim, 3, woven, g, b, to);
	}
}

void pm_tile_gradient_of(const struct pm_gradient_later *l, const struct pm_tile_nodes *b, double *block, double *nodes)
{
	if (l->operator.grid.dim == 2)
		nodes_in(2, false, l, b, block);
	else if (nodes)
		nodes_in(3, true, l, b, nodes);
	else
		nodes_in(3, false, l, b, block);
}

PM_SIMD_INLINE void row_of(int dim, int pairs, const struct pm_gradient_later *g, const size_t at[3], size_t m, double *to, size_t apart)
{
	struct lines l = lines_of(dim, pairs, g);
	set_row(dim, pairs, g, pm_in(g->later.from, 0), at[1], at[2], &l);
	run_of((struct shape){dim, pairs, false, apart, true}, &l, at[0], m, to);
}

PM_SIMD_INLINE void row_in(int dim, const struct pm_gradient_later *g, const size_t at[3], size_t m, double *to, size_t apart)
{
	switch (g->operator.order) {
	case 2: row_of(dim, 1, g, at, m, to, apart); break;
	case 4: row_of(dim, 2, g, at, m, to, apart); break;
	default: row_of(dim, 3, g, at, m, to, apart);
	}
}

void pm_tile_gradient_row(const struct pm_gradient_later *l, const size_t at[3], size_t m, double *to, size_t apart)
{
	if (l->operator.grid.dim == 2)
		row_in(2, l, at, m, to, apart);
	else
		row_in(3, l, at, m, to, apart);
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
	const size_t *n = l->operator.grid.points, reach = (size_t)l->operator.order / 2, along_z = l->operator.grid.dim > 2 ? reach : 0;
	const double *phi = pm_in(l->later.from, 0);
	const size_t y0 = below(b->at[1][0], reach, n[1]);
	size_t z = below(b->at[2][0], along_z, n[2]);
	for (size_t k = 0; k < b->slots[2] + 2 * along_z; k++, z = above(z, 1, n[2]))
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
