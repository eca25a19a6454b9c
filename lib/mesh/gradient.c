/* Centred differences on a mesh. First derivative, antisymmetric, over h: order 2: 1/2; 4: 2/3 -1/12; 6: 3/4 -3/20 1/60. Second, over h^2: order 2:
 * -2, 1; 4: -5/2, 4/3, -1/12; 6: -49/18, 3/2, -3/20, 1/90 (Fornberg 1988, table 1).
 * Faces: periodic wraps; a wall is an odd image, a neumann face an even one (of a scalar; of a vector see gradient.h); near an open face
 * one-sided differences of the same order over the order+1 (second derivative: order+2) points at that end, by Fornberg's recursion.
 * Conserves: centred differences are antisymmetric, so that with equal kernels p2m, mgrad and m2p make no self force; one-sided ones are not.
 * Cost: one pass over memory, all components of a row at a time.
 * SPDX-License-Identifier: GPL-3.0-or-later */
#include <omp.h>
#include <string.h>

#include "fft/fft-block.h"
#include "mesh/difference-rows.h"
#include "mesh/gradient-parts.h"
#include "mesh/index-fold.h"
#include "world/world.h"

bool pm_operator_odd(const struct pm_operator *o, int component, int axis, int side)
{
	bool vector = o->in > 1 || o->kind == PM_OP_DIV, flip = vector && (component == axis) != o->flow;
	return (o->grid.face[axis][side] == PM_WALL) != flip;
}

static struct pm_taps centred(int derivative, int order)
{
	static const double first[3][3] = {{1.0 / 2}, {2.0 / 3, -1.0 / 12}, {3.0 / 4, -3.0 / 20, 1.0 / 60}};
	static const double second[3][4] = {{-2, 1}, {-5.0 / 2, 4.0 / 3, -1.0 / 12}, {-49.0 / 18, 3.0 / 2, -3.0 / 20, 1.0 / 90}};
	struct pm_taps t = {0};
	int m = order / 2;
	for (int i = 1; i <= m; i++) /* pairs side by side, so that a constant cancels exactly */
		for (int side = 1; side >= -1; side -= 2) {
			t.at[t.n] = side * i;
			t.w[t.n++] = derivative == 1 ? side * first[m - 1][i - 1] : second[m - 1][i];
		}
	if (derivative == 2)
		t.w[t.n++] = second[m - 1][0];
	return t;
}

/* Weights of the derivative at x from the values at 0, 1, ..., n-1 (Fornberg 1988). */
static void fornberg(int derivative, double x, int n, double *w)
{
	double c[PM_TAPS][3] = {{0}}, c1 = 1;
	c[0][0] = 1;
	for (int i = 1; i < n; i++) {
		double c2 = 1;
		for (int j = 0; j < i; j++) {
			c2 *= i - j;
			if (j == i - 1)
				for (int d = derivative; d >= 0; d--)
					c[i][d] = c1 * ((d ? d * c[i - 1][d - 1] : 0) + (x - (i - 1)) * c[i - 1][d]) / c2;
			for (int d = derivative; d >= 0; d--)
				c[j][d] = ((i - x) * c[j][d] - (d ? d * c[j][d - 1] : 0)) / (i - j);
		}
		c1 = c2;
	}
	for (int i = 0; i < n; i++)
		w[i] = c[i][derivative];
}

static struct pm_index_axis images(const struct pm_operator *o, int component, int d)
{
	struct pm_index_axis a = {.points = o->grid.points[d], .periodic = o->grid.face[d][0] == PM_PERIODIC};
	for (int side = 0; side < 2; side++)
		if (o->grid.face[d][side] == PM_WALL || o->grid.face[d][side] == PM_NEUMANN)
			a.image[side] = pm_operator_odd(o, component, d, side) ? -1 : 1;
	return a;
}

static struct pm_taps at_end(const struct pm_operator *o, int component, int d, ptrdiff_t i)
{
	struct pm_taps t = centred(o->derivative, o->order);
	const struct pm_index_axis axis = images(o, component, d);
	bool inside = true;
	for (int k = 0; k < PM_TAPS; k++) { /* the unused ones have weight 0 */
		int factor;
		t.at[k] = (ptrdiff_t)pm_index_image(i + t.at[k], &axis, &factor);
		t.w[k] *= factor;
		inside = inside && factor;
	}
	if (inside)
		return t;
	ptrdiff_t last = (ptrdiff_t)o->grid.cells[d];
	bool high = i > last - i;
	t.n = o->order + o->derivative;
	fornberg(o->derivative, (double)(high ? last - i : i), t.n, t.w);
	for (int k = 0; k < t.n; k++) {
		t.at[k] = high ? last - k : k;
		if (high && o->derivative == 1)
			t.w[k] = -t.w[k];
	}
	return t;
}

static struct pm_difference_axis axis_of(const struct pm_operator *o, int component, int d, double factor)
{
	struct pm_difference_axis a = {.points = o->grid.points[d], .stride = 1, .regular = centred(o->derivative, o->order)};
	size_t m = (size_t)o->order / 2;
	a.around = o->planes && o->planes->periodic && d == o->planes->axis;
	a.pairs = o->grid.face[d][0] == PM_PERIODIC;
	bool short_axis = a.points <= 2 * m;
	a.low = short_axis ? a.points : m;
	a.high = short_axis ? 0 : m;
	for (int e = 0; e < d; e++)
		a.stride *= (ptrdiff_t)o->grid.points[e];
	for (size_t i = 0; i < a.low + a.high; i++)
		a.end[i] = at_end(o, component, d, (ptrdiff_t)(i < a.low ? i : a.points - a.low - a.high + i));
	factor /= o->derivative == 1 ? o->grid.h[d] : o->grid.h[d] * o->grid.h[d];
	for (int k = 0; k < PM_TAPS; k++) {
		a.regular.w[k] *= factor;
		for (size_t i = 0; i < a.low + a.high; i++)
			a.end[i].w[k] *= factor;
	}
	return a;
}

void pm_operator_pairs(const struct pm_operator *o, int term, double factor, double w[3])
{
	const struct pm_difference_axis a = axis_of(o, 0, o->term[term].axis, factor * o->term[term].sign);
	for (int k = 0; k < o->order / 2; k++)
		w[k] = a.regular.w[2 * k];
}

/* Regular taps and images reach order/2 nodes; one-sided ones from a node beside the face order + derivative nodes into the mesh, which a rank with few planes
 * has not. */
int pm_operator_reach(const struct pm_operator *o, const struct pm_planes *p)
{
	const size_t m = (size_t)o->order / 2, need = (size_t)(o->order + o->derivative);
	size_t wide = m;
	for (int r = 0; r < pm_world_size() && p->axis; r++) {
		const size_t a = p->from[r], b = p->from[r + 1];
		if (o->grid.face[p->axis][0] == PM_OPEN && a < b && a < m && b + wide < need)
			wide = need - b;
		if (o->grid.face[p->axis][1] == PM_OPEN && a < b && p->all - b < m && p->all - a + wide < need)
			wide = need - (p->all - a);
	}
	return (int)wide;
}

/* out (+)= slope * weight */
static void multiply(size_t n, const double *slope, const double *weight, bool add, double *restrict out)
{
	for (size_t i = 0; i < n; i++)
		out[i] = (add ? out[i] : 0) + slope[i] * weight[i];
}

/* Rows of the plane farthest up the slowest axis, the third from here on: the hardware prefetcher does not recognise this access. Saves a fifth of the time on
 * meshes larger than the caches. NULL beyond the mesh. */
static const double *row_ahead(const struct pm_operator *o, const double *in, size_t row, size_t rows)
{
	const size_t *n = o->grid.points, far = o->grid.dim == 3 ? n[1] : 1, ahead = row + far * (size_t)(o->order / 2) + 3;
	return ahead + rows <= n[1] * n[2] ? in + ahead * n[0] : NULL;
}

/* What makes one component: the terms from `first` to last-1. */
struct part {
	int first, last, out;
	bool plain; /* no weights, few terms, not added: in registers where all rows have regular taps */
	struct pm_difference_row row[PM_TERMS_MOST];
};

struct differences {
	const struct pm_operator *o;
	struct pm_difference_axis axis[PM_TERMS_MOST]; /* of each term */
	struct part part[PM_OUTS_MOST];
	int parts;
	const double *const *in;
	double *const *out;
	bool streams; /* larger than the caches: written past them, which avoids reading the old values */
};

static void parts_of(struct differences *w, double factor)
{
	const struct pm_operator *o = w->o;
	struct part *p = w->part;
	for (int t = 0; t < o->nterms; t++) {
		const struct pm_operator_term *q = &o->term[t];
		w->axis[t] = axis_of(o, q->as, q->axis, factor * q->sign);
		if (!t || q->out != q[-1].out) {
			p += t > 0;
			*p = (struct part){.first = t, .out = q->out, .plain = !o->add && o->grid.points[0] >= PM_DIFFERENCE_LEAST};
		}
		p->row[t - p->first] = (struct pm_difference_row){.axis = &w->axis[t], .d = q->axis, .in = w->in[q->in]};
		p->last = t + 1;
		p->plain = p->plain && !q->by && p->last - p->first <= 3;
	}
	w->parts = o->nterms ? (int)(p + 1 - w->part) : 0;
}

/* One component of a row by the taps of each term; through a buffer where the mesh streams. */
static bool row_by_taps(const struct differences *w, const struct part *p, double *buffer, double *slope, double *out)
{
	const struct pm_operator *o = w->o;
	const size_t n = o->grid.points[0];
	double *sum = w->streams ? buffer : out;
	if (w->streams && o->add)
		memcpy(buffer, out, n * sizeof *out);
	for (int t = p->first; t < p->last; t++) {
		const struct pm_difference_row *r = &p->row[t - p->first];
		const bool add = t > p->first || o->add;
		const int by = o->term[t].by;
		pm_difference_any(r, n, !by && add, by ? slope : sum);
		if (by)
			multiply(n, slope, o->weight[by - 1] + r->row, add, sum);
	}
	const bool finite = pm_finite_few(n, sum);
	if (w->streams)
		pm_stream(out, buffer, n);
	return finite;
}

/* One component of so many rows with the same taps, of which the first has the number `row` here. */
static bool rows_of(const struct differences *w, struct part *p, size_t row, size_t rows, const size_t at[3], double *buffer, double *slope)
{
	const struct pm_operator *o = w->o;
	const size_t n = o->grid.points[0];
	const int terms = p->last - p->first;
	const double *ahead = w->streams && p->out < o->in ? row_ahead(o, w->in[p->out], row, rows) : NULL;
	double *out = w->out[p->out];
	bool plain = p->plain, finite = true;
	for (int k = 0; k < terms; k++) {
		struct pm_difference_row *r = &p->row[k];
		r->row = row * n, r->at = at[r->d];
		plain = plain && pm_difference_regular(r);
	}
	if (plain)
		return pm_difference_sum(terms, p->row, (struct pm_difference_block){.n = n, .rows = rows, .past = w->streams, .ahead = ahead}, out + row * n);
	for (size_t i = 0; i < rows * n && ahead; i += 8)
		__builtin_prefetch(ahead + i);
	for (size_t r = row; r < row + rows; r++) {
		for (int k = 0; k < terms; k++)
			p->row[k].row = r * n;
		finite = row_by_taps(w, p, buffer, slope, out + r * n) && finite;
	}
	return finite;
}

/* Rows from row j of a plane that have the same taps, and are not too many for the first-level cache. */
static size_t rows_alike(const struct pm_operator *o, size_t j)
{
	static const size_t most = 1536; /* numbers */
	const size_t n = o->grid.points[1], ends = (size_t)o->order / 2, few = most / o->grid.points[0] ? most / o->grid.points[0] : 1;
	return j < ends || j + ends >= n ? 1 : n - ends - j < few ? n - ends - j : few;
}

int pm_operator_differences(const struct pm_operator *o, double factor, const double *const in[], double *const out[], bool *seen)
{
	const size_t *n = o->grid.points, rows = o->planes ? o->planes->here * o->planes->size / n[0] : n[1] * n[2];
	const size_t below = o->planes ? pm_planes_row(o->planes, 0) : 0, lot = (n[0] + 23) / 8 * 8, threads = (size_t)pm_threads();
	struct differences w = {.o = o, .in = in, .out = out, .streams = rows * n[0] > (size_t)1 << 20}; /* 8 MiB */
	double *scratch = pm_alloc(2 * threads * lot, sizeof *scratch);
	int bad = 0;
	if (!scratch)
		return -PM_DATA;
	parts_of(&w, factor);
#pragma omp parallel for num_threads((int)threads) schedule(static) reduction(| : bad)
	for (size_t t = 0; t < threads; t++) {
		double *buffer = scratch + 2 * t * lot;
		struct part part[PM_OUTS_MOST];
		const size_t to = rows * (t + 1) / threads;
		memcpy(part, w.part, sizeof part);
		for (size_t r = rows * t / threads, next; r < to; r = next) {
			const size_t at[3] = {0, (below + r) % n[1], (below + r) / n[1]}, alike = rows_alike(o, at[1]);
			next = r + alike < to ? r + alike : to;
			for (int c = 0; c < w.parts; c++)
				bad |= !rows_of(&w, &part[c], r, next - r, at, buffer, buffer + lot);
		}
		pm_stream_end();
	}
	pm_free(scratch);
	*seen = !bad;
	return 0;
}
