/* Between the grids of a multigrid hierarchy: u += P e (linear), f_coarse = R (f - lap u).
 * P is the tensor product of linear interpolations; R = W_c^-1 P^T W with the quadrature weights W, which is full weighting
 * (1 2 1)/4 per axis where n is even and faces are folded, keeps the integral of the residual (so singular problems stay solvable) and serves any
 * ratio n/n_c. As 1/h^2 stays in the operator, no scaling is needed (texts that multiply by h^2 omit a factor of 4).
 * Sources: Trottenberg, Oosterlee, Schueller 2001, sections 2.3 and 2.6.
 * Every coarse value is summed in the order of the fine rows, whatever the threads. SPDX-License-Identifier: GPL-3.0-or-later */
#include "poisson-mg/mg-vector.h"
#include "poisson-mg/mg-ranks.h"

static struct mg_parents parents_linear(const struct mg_map *map, const struct mg_axis *coarse, size_t i)
{
	struct mg_parents p = {0};
	for (int m = 0; m < 2; m++)
		if (map->w[m][i] != 0)
			p.node[p.n] = mg_fold(map->parent[i] + m, coarse), p.w[p.n++] = map->w[m][i];
	return p;
}

void pm_mg_add_row(size_t n, double weight, const mg_number *restrict x, mg_number *restrict y)
{
	const mg_number w = (mg_number)weight;
	for (size_t i = 0, end = mg_whole(n); i < end; i += W)
		mg_store(y + i, mg_load(y + i) + w * mg_load(x + i));
}

void pm_mg_fold_row(const struct mg_level *l, const mg_number *restrict t, mg_number *restrict row)
{
	for (size_t i = 0, end = mg_whole(l->half); i < end; i += W) {
		mg_vector a = mg_load(t + 2 * i), b = mg_load(t + 2 * i + W);
		mg_store(row + i, mg_even(a, b));
		mg_store(row + l->half + i, mg_odd(a, b));
	}
}

/* n rows with weights w, from rows to node after node. */
PM_SIMD_INLINE void combine(const struct mg_level *c, const int n, const mg_number *const *row, const mg_number *w, mg_number *restrict t)
{
	for (size_t i = 0, end = mg_whole(c->half); i < end; i += W) {
		mg_vector even = w[0] * mg_load(row[0] + i), odd = w[0] * mg_load(row[0] + c->half + i);
		for (int m = 1; m < n; m++) {
			even += w[m] * mg_load(row[m] + i);
			odd += w[m] * mg_load(row[m] + c->half + i);
		}
		mg_store(t + 2 * i, mg_zip_low(even, odd));
		mg_store(t + 2 * i + W, mg_zip_high(even, odd));
	}
}

void pm_mg_gather(const struct mg_level *c, const struct mg_parents *y, const struct mg_parents *z, mg_number *t)
{
	const mg_number *row[mg_cubic * mg_cubic];
	mg_number w[mg_cubic * mg_cubic];
	size_t points = c->axis[0].points;
	int n = 0;
	for (int a = 0; a < z->n; a++)
		for (int b = 0; b < y->n; b++, n++) {
			w[n] = (mg_number)(z->w[a] * y->w[b]);
			row[n] = c->u + mg_plane(c, z->node[a]) + y->node[b] * c->stride;
		}
	if (n == 1)
		combine(c, 1, row, w, t);
	else if (n == 2)
		combine(c, 2, row, w, t);
	else if (n == 4)
		combine(c, 4, row, w, t);
	else
		combine(c, n, row, w, t);
	bool periodic = c->axis[0].periodic;
	t[-1] = periodic ? t[points - 1] : 0;
	t[points] = periodic ? t[0] : 0;
	t[points + 1] = periodic ? t[points > 1] : 0;
}

/* u_2i += t_i, u_2i+1 += (t_i + t_i+1)/2, also past the end of the row, where the values are not used. */
static void spread_half(const struct mg_level *fine, const mg_number *restrict t, mg_number *restrict u)
{
	mg_number *restrict odd = u + fine->half;
	for (size_t i = 0, end = mg_whole((fine->axis[0].points + 1) / 2); i < end; i += W) {
		mg_vector a = mg_load(t + i), b = mg_load(t + i + W);
		mg_store(u + i, mg_load(u + i) + a);
		mg_store(odd + i, mg_load(odd + i) + (mg_number)0.5 * (a + mg_shift_down(a, b)));
	}
}

static void spread_row(const struct mg_level *fine, const mg_number *t, mg_number *u)
{
	const struct mg_map *x = &fine->map[0];
	if (x->half)
		spread_half(fine, t, u);
	else
		for (size_t i = 0; i < fine->axis[0].points; i++)
			u[mg_slot(fine, i)] += x->w[0][i] * t[x->parent[i]] + x->w[1][i] * t[x->parent[i] + 1];
	mg_close_row(fine, u);
}

void pm_mg_correct_plane(const struct mg_level *fine, const struct mg_level *coarse, size_t k, mg_number *w)
{
	const struct mg_axis *y = &fine->axis[1];
	struct mg_parents pz = parents_linear(&fine->map[2], &coarse->axis[2], k);
	for (size_t j = y->first; j < y->end; j++) {
		struct mg_parents py = parents_linear(&fine->map[1], &coarse->axis[1], j);
		pm_mg_gather(coarse, &py, &pz, w + mg_lanes);
		spread_row(fine, w + mg_lanes, fine->u + mg_plane(fine, k) + j * fine->stride);
	}
}

/* c_i = side (r_2i-1 + r_2i+1) + middle r_2i, node after node */
PM_SIMD_INLINE void collect_half(const struct mg_level *fine, const mg_number side, const mg_number middle, const mg_number *restrict r,
	mg_number *restrict c)
{
	mg_vector before = {0};
	before += r[mg_slot(fine, mg_below(&fine->axis[0], 0))];
	for (size_t i = 0, end = mg_whole((fine->axis[0].points + 1) / 2); i < end; i += W) {
		mg_vector odd = mg_load(r + fine->half + i);
		mg_store(c + i, side * (mg_shift_up(before, odd) + odd) + middle * mg_load(r + i));
		before = odd;
	}
}

/* A fine row r onto a coarse row c; w: room for one. */
static void collect_row(const struct mg_level *fine, const struct mg_level *coarse, const mg_number *r, mg_number *c, mg_number *w)
{
	const struct mg_map *map = &fine->map[0];
	if (map->same) {
		memcpy(c, r, fine->stride * sizeof *c);
	} else if (map->half) {
		collect_half(fine, 0.25, 0.5, r, w);
		pm_mg_fold_row(coarse, w, c);
	} else {
		memset(c, 0, coarse->stride * sizeof *c);
		for (size_t i = 0; i < fine->axis[0].points; i++)
			for (int m = 0; m < 2; m++)
				c[mg_slot(coarse, mg_fold(map->parent[i] + m, &coarse->axis[0]))] += map->a[m][i] * r[mg_slot(fine, i)];
	}
}

/* Half weighting: 1/2 of the node and 1/(4n) of each of its neighbours along the n axes that are coarsened, instead of the product of (1 2 1)/4. In row j, k:
 * what collect_row does, and the factor that makes the weights of mg_map those. 0: the row has no part in it. */
static double collect_half_weighting(const struct mg_level *fine, const struct mg_level *coarse, size_t j, size_t k, const mg_number *r, mg_number *c,
	mg_number *w)
{
	const struct mg_map *x = &fine->map[0], *y = x + 1, *z = x + 2;
	bool odd[2] = {!y->same && (j & 1), !z->same && (k & 1)};
	double side = 0.25 / (!x->same + !y->same + !z->same), scale = (y->same ? 1 : odd[0] ? 4 : 2) * (z->same ? 1 : odd[1] ? 4 : 2);
	if (odd[0] && odd[1])
		return 0;
	if (x->same) {
		memcpy(c, r, fine->stride * sizeof *c);
		return scale * (odd[0] || odd[1] ? side : 0.5);
	}
	if (odd[0] || odd[1])
		collect_half(fine, 0, (mg_number)side, r, w);
	else
		collect_half(fine, (mg_number)side, 0.5, r, w);
	pm_mg_fold_row(coarse, w, c);
	return scale;
}

static bool halves(const struct mg_level *fine)
{
	bool all = true;
	for (int d = 0; d < 3; d++)
		all &= fine->map[d].same || fine->map[d].half;
	return all;
}

/* The rows of fine plane k (unfolded: -n < k < n) are added to coarse planes from <= K < to. Returns the sum of squares. */
static double restrict_plane(const struct mg_level *fine, const struct mg_level *coarse, bool half, ptrdiff_t k, const size_t range[2], mg_number *w)
{
	const struct mg_axis *y = &fine->axis[1], *cy = &coarse->axis[1];
	const struct mg_map *my = &fine->map[1], *mz = &fine->map[2];
	size_t here = mg_fold(k, &fine->axis[2]);
	ptrdiff_t shift = k < 0 ? (ptrdiff_t)coarse->axis[2].points : 0;
	mg_number *r = w, *c = r + fine->stride, *t = c + coarse->stride;
	double scale = 1;
	struct pm_sum sum = {0, 0};
	for (size_t j = y->first; j < y->end; j++) {
		pm_sum_add(&sum, pm_mg_residual_row(fine, j, here, r));
		if (half)
			scale = collect_half_weighting(fine, coarse, j, here, r, c, t);
		else
			collect_row(fine, coarse, r, c, t);
		for (int a = 0; a < 2 && scale != 0; a++) {
			ptrdiff_t up = mz->parent[here] + a - shift;
			if (mz->a[a][here] == 0 || up < (ptrdiff_t)range[0] || up >= (ptrdiff_t)range[1])
				continue;
			for (int b = 0; b < 2; b++) {
				size_t over = mg_fold(my->parent[j] + b, cy);
				if (my->a[b][j] != 0)
					pm_mg_add_row(coarse->stride, scale * (mz->a[a][here] * my->a[b][j]), c,
						coarse->f + mg_plane(coarse, (size_t)up) + over * coarse->stride);
			}
		}
	}
	return pm_sum_total(sum);
}

/* First fine plane below coarse plane K, unfolded. */
static ptrdiff_t first_child(const struct mg_level *fine, const struct mg_level *coarse, size_t K)
{
	const struct mg_axis *f = &fine->axis[2], *c = &coarse->axis[2];
	ptrdiff_t n = (ptrdiff_t)f->cells, m = (ptrdiff_t)c->cells, x = n * ((ptrdiff_t)K - 1);
	if (!f->periodic && K <= c->first)
		return (ptrdiff_t)f->first;
	return (x >= 0 ? x / m : -((-x + m - 1) / m)) + 1;
}

static ptrdiff_t last_child(const struct mg_level *fine, const struct mg_level *coarse, size_t K)
{
	const struct mg_axis *f = &fine->axis[2], *c = &coarse->axis[2];
	ptrdiff_t n = (ptrdiff_t)f->cells, m = (ptrdiff_t)c->cells;
	if (!f->periodic && K + 1 >= c->end)
		return (ptrdiff_t)f->end - 1;
	return (n * ((ptrdiff_t)K + 1) + m - 1) / m - 1;
}

/* The fine planes whose sums of squares are kept with coarse planes range[0] <= K < range[1] of `all` here: those that no other range starts with. */
static void counted(const struct mg_level *fine, const struct mg_level *coarse, const size_t range[2], const size_t all[2], ptrdiff_t mine[2])
{
	size_t own[2];
	mg_range(fine, own);
	const bool none = range[0] == range[1]; /* a rank may have fine planes and no coarse one */
	mine[0] = none ? (ptrdiff_t)own[0] : first_child(fine, coarse, range[0]);
	mine[1] = range[1] < all[1] ? first_child(fine, coarse, range[1]) : fine->axis[2].periodic && !none && !fine->from ?
		first_child(fine, coarse, 0) + (ptrdiff_t)fine->axis[2].points : (ptrdiff_t)own[1];
	if (fine->from && range[0] == all[0])
		mine[0] = (ptrdiff_t)own[0];
}

/* Coarse planes range[0] <= K < range[1]. */
static void restrict_range(const struct mg_level *fine, const struct mg_level *coarse, bool half, const size_t range[2], const ptrdiff_t mine[2], mg_number *w,
	double *sums)
{
	const bool none = range[0] == range[1];
	const ptrdiff_t from = none ? mine[0] : first_child(fine, coarse, range[0]), to = none ? mine[1] - 1 : last_child(fine, coarse, range[1] - 1);
	for (size_t K = range[0]; K < range[1]; K++)
		memset(coarse->f + mg_plane(coarse, K), 0, coarse->axis[1].points * coarse->stride * sizeof *coarse->f);
	for (ptrdiff_t k = from < mine[0] ? from : mine[0]; k <= to || k < mine[1]; k++) {
		double sum = restrict_plane(fine, coarse, half, k, range, w);
		if (k >= mine[0] && k < mine[1] && sums)
			sums[mg_fold(k, &fine->axis[2])] = sum;
	}
}

double pm_mg_restrict(struct pm_mg *mg, int at, bool half_weighting)
{
	struct mg_level *fine = &mg->level[at], *coarse = fine + 1;
	const struct mg_axis *z = &fine->axis[2];
	size_t all[2];
	mg_range(coarse, all);
	pm_mg_beside(mg, fine, fine->u, mg_beyond);
	if (!fine->beside)
		pm_mg_beside(mg, fine, fine->f, mg_beyond);
	fine->beside = true;
	coarse->beside = false;
	size_t n = all[1] - all[0], parts = (size_t)mg->threads < n / 4 && mg_size(fine) > mg_parallel ? (size_t)mg->threads : 1;
	#pragma omp parallel for num_threads((int)parts) schedule(static, 1) if (parts > 1)
	for (size_t p = 0; p < parts; p++) {
		size_t range[2] = {all[0] + n * p / parts, all[0] + n * (p + 1) / parts};
		ptrdiff_t mine[2];
		counted(fine, coarse, range, all, mine);
		restrict_range(fine, coarse, half_weighting && halves(fine), range, mine, mg->scratch + p * mg->room, at ? NULL : mg->sums);
	}
	return at ? 0 : pm_mg_total(mg, z->first, z->end);
}
