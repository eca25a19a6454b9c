/* Centred differences on a mesh. First derivative, antisymmetric, over h: order 2: 1/2; 4: 2/3 -1/12; 6: 3/4 -3/20 1/60. Second, over h^2: order 2:
 * -2, 1; 4: -5/2, 4/3, -1/12; 6: -49/18, 3/2, -3/20, 1/90 (Fornberg 1988, table 1).
 * Faces: periodic wraps; a wall is an odd image, a neumann face an even one (of a scalar; of a vector see gradient.h); near an open face
 * one-sided differences of the same order over the order+1 (second derivative: order+2) points at that end, by Fornberg's recursion.
 * Conserves: centred differences are antisymmetric, so that with equal kernels p2m, mgrad and m2p make no self force; one-sided ones are not.
 * Cost: one pass over memory, all components of a row at a time.
 * SPDX-License-Identifier: GPL-3.0-or-later */
#include <string.h>

#include "mesh/gradient.h"

struct taps {
	int n;
	ptrdiff_t at[PM_TAPS]; /* node; of the regular ones the distance from the node */
	double w[PM_TAPS];
};

/* The nodes low <= i < points-high have the regular taps, the others their own. */
struct axis {
	size_t points, low, high;
	ptrdiff_t stride;
	struct taps regular, end[PM_ENDS];
};

bool pm_operator_odd(const struct pm_operator *o, int component, int axis, int side)
{
	bool vector = o->in > 1 || o->kind == PM_OP_DIV, flip = vector && (component == axis) != o->flow;
	return (o->grid.face[axis][side] == PM_WALL) != flip;
}

static struct taps centred(int derivative, int order)
{
	static const double first[3][3] = {{1.0 / 2}, {2.0 / 3, -1.0 / 12}, {3.0 / 4, -3.0 / 20, 1.0 / 60}};
	static const double second[3][4] = {{-2, 1}, {-5.0 / 2, 4.0 / 3, -1.0 / 12}, {-49.0 / 18, 3.0 / 2, -3.0 / 20, 1.0 / 90}};
	struct taps t = {0};
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

/* The node at which the value at q is found, its sign; false: beyond an open face. */
static bool image(const struct pm_operator *o, int component, int d, ptrdiff_t *q, double *sign)
{
	ptrdiff_t n = (ptrdiff_t)o->grid.cells[d];
	if (o->grid.face[d][0] == PM_PERIODIC) {
		*q = (*q % n + n) % n;
		return true;
	}
	while (*q < 0 || *q > n) {
		int side = *q > n;
		if (o->grid.face[d][side] != PM_WALL && o->grid.face[d][side] != PM_NEUMANN)
			return false;
		*q = side ? 2 * n - *q : -*q;
		*sign *= pm_operator_odd(o, component, d, side) ? -1 : 1;
	}
	return true;
}

static struct taps at_end(const struct pm_operator *o, int component, int d, ptrdiff_t i)
{
	struct taps t = centred(o->derivative, o->order);
	bool inside = true;
	for (int k = 0; k < PM_TAPS; k++) { /* the unused ones have weight 0 */
		t.at[k] += i;
		inside = image(o, component, d, &t.at[k], &t.w[k]) && inside;
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

static struct axis axis_of(const struct pm_operator *o, int component, int d, double factor)
{
	struct axis a = {.points = o->grid.points[d], .stride = 1, .regular = centred(o->derivative, o->order)};
	size_t m = (size_t)o->order / 2;
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

/* out[i] (+)= sum_k w[k] from[k][i]; n is a constant where it is called. */
static inline void combine(int n, const double *const from[], const double *w, bool add, size_t count, double *restrict out)
{
	for (size_t i = 0; i < count; i++) {
		double sum = w[0] * from[0][i];
		for (int k = 1; k < n; k++)
			sum += w[k] * from[k][i];
		out[i] = add ? out[i] + sum : sum;
	}
}

static inline void combine_add(int n, const double *const from[], const double *w, bool add, size_t count, double *restrict out)
{
	if (add)
		combine(n, from, w, true, count, out);
	else
		combine(n, from, w, false, count, out);
}

static void combine_any(int n, const double *const from[], const double *w, bool add, size_t count, double *restrict out)
{
	switch (n) {
	case 2: combine_add(2, from, w, add, count, out); break;
	case 3: combine_add(3, from, w, add, count, out); break;
	case 4: combine_add(4, from, w, add, count, out); break;
	case 5: combine_add(5, from, w, add, count, out); break;
	case 6: combine_add(6, from, w, add, count, out); break;
	case 7: combine_add(7, from, w, add, count, out); break;
	default: combine_add(n, from, w, add, count, out);
	}
}

/* in: the whole component; the row at (0, j, k). */
static void row_along(const struct axis *a, int d, const double *in, size_t row, size_t at, size_t nx, bool add, double *out)
{
	const double *from[PM_TAPS];
	const struct taps *t = &a->regular;
	bool regular = d == 0 || (at >= a->low && at < a->points - a->high);
	if (!regular)
		t = &a->end[at < a->low ? at : at + a->low + a->high - a->points];
	if (d > 0) {
		for (int k = 0; k < t->n; k++)
			from[k] = in + row + (regular ? t->at[k] : t->at[k] - (ptrdiff_t)at) * a->stride;
		combine_any(t->n, from, t->w, add, nx, out);
		return;
	}
	for (size_t i = 0; i < a->low + a->high; i++) {
		size_t p = i < a->low ? i : nx - a->low - a->high + i;
		double sum = 0;
		for (int k = 0; k < a->end[i].n; k++)
			sum += a->end[i].w[k] * in[row + (size_t)a->end[i].at[k]];
		out[p] = add ? out[p] + sum : sum;
	}
	for (int k = 0; k < t->n; k++)
		from[k] = in + row + (ptrdiff_t)a->low + t->at[k];
	if (nx > a->low + a->high)
		combine_any(t->n, from, t->w, add, nx - a->low - a->high, out + a->low);
}

int pm_operator_differences(const struct pm_operator *o, double factor, const double *const in[], double *const out[])
{
	struct axis axis[PM_TERMS_MOST];
	const size_t *n = o->grid.points, rows = n[1] * n[2];
	for (int t = 0; t < o->nterms; t++)
		axis[t] = axis_of(o, o->term[t].in, o->term[t].axis, factor * o->term[t].sign);
#pragma omp parallel for schedule(static) num_threads(pm_threads())
	for (size_t r = 0; r < rows; r++) {
		const size_t at[3] = {0, r % n[1], r / n[1]};
		for (int t = 0; t < o->nterms; t++) {
			const struct pm_operator_term *q = &o->term[t];
			row_along(&axis[t], q->axis, in[q->in], r * n[0], at[q->axis], n[0], t && q->out == q[-1].out, out[q->out] + r * n[0]);
		}
	}
	return 0;
}
