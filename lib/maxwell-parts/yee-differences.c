/* Curls by two-point differences. Beyond a face a component along it is odd at a conductor (wall) and even at a neumann face; there the two neighbours of a
 * node are images of each other, so that a difference is twice one of them.
 * At open faces the mesh ends in layers that absorb: convolutional perfectly matched layers, in which every difference D along the normal becomes D + psi,
 * psi <- b psi + (b - 1) D with b = exp(-sigma dt); sigma grows as the fourth power of the depth to the value 4 c/h. The paper's alpha, a shift of the
 * frequency, is 0: even alpha = 1e-2 c/(layers h) sends 7e-4 of a pulse with a mean back, 0 sends 1e-7 (tests/unit/maxwell.c).
 * Source: Yee 1966; Roden and Gedney 2000, Microwave and Optical Technology Letters 27, 334.
 * Cost: a pass over six components, memory-bound; layers as much again for the cells in them. SPDX-License-Identifier: GPL-3.0-or-later */
#include "maxwell-parts/yee.h"

/* One derivative along an axis that adds to one component. */
struct term {
	const struct pm_yee *y;
	int axis;
	bool up;                 /* from nodes to halves: f(i + 1) - f(i); else f(i) - f(i - 1) */
	double factor, dt;       /* out += factor * difference/h; dt of the memory */
	const double *from;
	double *to, *memory;     /* memory NULL: no layers */
};

static size_t stride_of(const struct pm_grid *g, int d) { return d == 0 ? 1 : d == 1 ? g->points[0] : g->points[0] * g->points[1]; }

/* The two values whose difference it is: offsets from the point, and weights. */
struct pair {
	ptrdiff_t high, low;
	double w_high, w_low;
};

static struct pair pair_at(const struct pm_yee *y, int d, bool up, size_t i)
{
	const struct pm_grid *g = &y->grid;
	const ptrdiff_t s = (ptrdiff_t)stride_of(g, d), last = (ptrdiff_t)g->points[d] - 1;
	const bool periodic = g->face[d][0] == PM_PERIODIC;
	struct pair p = {.high = up ? s : 0, .low = up ? 0 : -s, .w_high = 1, .w_low = 1};
	const bool ahead = y->planes && d > 0 && d == y->planes->axis; /* what is beyond a periodic end lies beside it */
	if (up && (ptrdiff_t)i == last && !ahead)
		p.high = -last * s;
	if (!up && i == 0 && periodic && !ahead)
		p.low = last * s;
	if (!up && !periodic && i == 0)
		p.low = 0, p.w_low = 0, p.w_high = 2;
	if (!up && !periodic && (ptrdiff_t)i == last)
		p.high = 0, p.w_high = 0, p.w_low = 2;
	return p;
}

/* Depth in the layer of the low or high face, from 0 at its inner side to 1 at the face; negative outside. */
static double depth(const struct term *t, size_t i)
{
	const struct pm_grid *g = &t->y->grid;
	const double at = (double)i + (t->up ? 0.5 : 0), n = (double)g->cells[t->axis], layers = t->y->layers;
	const double low = pm_yee_open(g->face[t->axis][0]) ? 1 - at / layers : -1, high = pm_yee_open(g->face[t->axis][1]) ? 1 - (n - at) / layers : -1;
	return fmax(low, high);
}

/* b and a of the memory at a depth. */
static void memory_at(const struct term *t, double deep, double *b, double *a)
{
	*b = exp(-4 * t->y->c / t->y->grid.h[t->axis] * pow(deep, 4) * fabs(t->dt));
	*a = *b - 1;
}

/* Points from..to-1 of the row that begins at `row`, with one pair of neighbours. */
static void run(const struct term *t, size_t row, size_t from, size_t to, struct pair p)
{
	const double f = t->factor / t->y->grid.h[t->axis];
	const double *restrict high = t->from + (ptrdiff_t)row + p.high, *restrict low = t->from + (ptrdiff_t)row + p.low;
	double *restrict out = t->to + row;
	if (p.w_high == 1 && p.w_low == 1)
		for (size_t i = from; i < to; i++)
			out[i] += f * (high[i] - low[i]);
	else
		for (size_t i = from; i < to; i++)
			out[i] += f * (p.w_high * high[i] - p.w_low * low[i]);
}

static void remember(const struct term *t, size_t at, struct pair p, double b, double a)
{
	const double *f = t->from + at, d = (p.w_high * f[p.high] - p.w_low * f[p.low]) / t->y->grid.h[t->axis];
	t->memory[at] = b * t->memory[at] + a * d;
	t->to[at] += t->factor * t->memory[at];
}

/* The points of a row that are in the layers. */
static void absorb(const struct term *t, size_t row, size_t other, size_t from, size_t to)
{
	double b, a;
	if (t->axis > 0) {
		const double deep = depth(t, other);
		if (deep < 0)
			return;
		memory_at(t, deep, &b, &a);
		const struct pair p = pair_at(t->y, t->axis, t->up, other);
		for (size_t i = from; i < to; i++)
			remember(t, row + i, p, b, a);
		return;
	}
	for (size_t i = from; i < to; i++) {
		const double deep = depth(t, i);
		if (deep < 0)
			continue;
		memory_at(t, deep, &b, &a);
		remember(t, row + i, pair_at(t->y, 0, t->up, i), b, a);
	}
}

/* Where the row (j, k) is here. */
static size_t row_at(const struct pm_yee *y, size_t j, size_t k)
{
	const size_t first = y->planes ? pm_planes_row(y->planes, 0) : 0;
	return (k * y->grid.points[1] + j - first) * y->grid.points[0];
}

static void row_of(const struct term *t, const size_t first[3], const size_t end[3], size_t j, size_t k)
{
	const struct pm_grid *g = &t->y->grid;
	const size_t row = row_at(t->y, j, k), other = t->axis == 1 ? j : k;
	if (t->axis > 0)
		run(t, row, first[0], end[0], pair_at(t->y, t->axis, t->up, other));
	else {
		const bool at_low = !t->up && first[0] == 0, at_high = end[0] == g->points[0] && (t->up || g->face[0][0] != PM_PERIODIC);
		const size_t from = first[0] + at_low, to = end[0] - (at_high && end[0] > from);
		if (at_low)
			run(t, row, first[0], from, pair_at(t->y, 0, t->up, 0));
		run(t, row, from, to, pair_at(t->y, 0, t->up, !t->up));
		if (to < end[0])
			run(t, row, to, end[0], pair_at(t->y, 0, t->up, to));
	}
	if (t->memory)
		absorb(t, row, other, first[0], end[0]);
}

/* The points of component c that are advanced: halves along `half` axes, and of E no point of a face along which it is zero. */
static void range(const struct pm_grid *g, bool electric, int c, size_t first[3], size_t end[3])
{
	for (int d = 0; d < 3; d++) {
		const bool half = d < g->dim && (electric ? d == c : d != c);
		first[d] = !half && electric && d < g->dim && pm_yee_conducts(g->face[d][0]);
		end[d] = half ? g->cells[d] : g->points[d] - (electric && d < g->dim && pm_yee_conducts(g->face[d][1]));
	}
}

/* Of these, those of this rank. */
static void range_here(const struct pm_planes *p, size_t first[3], size_t end[3])
{
	const size_t last = p->first + p->here;
	first[p->axis] = first[p->axis] > p->first ? first[p->axis] : p->first;
	end[p->axis] = end[p->axis] < last ? end[p->axis] : last;
}

/* F_c += dt factor (d_d G_e - d_e G_d) - dt J_c/eps0 for the three components. */
static void curl(const struct pm_yee *y, bool electric, double dt)
{
	const struct pm_grid *g = &y->grid;
	const double factor = electric ? dt * y->c * y->c : -dt;
	for (int c = 0; c < 3; c++) {
		double *to = electric ? y->e[c] : y->b[c];
		size_t first[3], end[3];
		struct term terms[2];
		int n = 0;
		range(g, electric, c, first, end);
		if (y->planes)
			range_here(y->planes, first, end);
		for (int k = 0; k < 2; k++) {
			const int axis = (c + 1 + k) % 3, other = (c + 2 - k) % 3;
			if (!pm_yee_varies(g, axis))
				continue;
			/* of axis a component a + 1 is number 0 (or 2, of B), a + 2 number 1 (3) */
			terms[n++] = (struct term){.y = y, .axis = axis, .up = !electric, .factor = k ? -factor : factor, .dt = dt, .to = to,
				.from = y->planes ? y->beside[other] : electric ? y->b[other] : y->e[other],
				.memory = y->pml[axis][(electric ? 0 : 2) + (c == (axis + 2) % 3)]};
		}
		const double *j = electric ? y->j[c] : NULL, push = dt / y->eps0;
#pragma omp parallel for collapse(2) schedule(static) if (pm_grid_size(g) > 8192)
		for (size_t k = first[2]; k < end[2]; k++)
			for (size_t l = first[1]; l < end[1]; l++) {
				const size_t row = row_at(y, l, k);
				for (int m = 0; m < n; m++)
					row_of(&terms[m], first, end, l, k);
				for (size_t i = first[0]; i < end[0] && j; i++)
					to[row + i] -= push * j[row + i];
			}
	}
}

void pm_yee_magnetic(const struct pm_yee *y, double dt) { curl(y, false, dt); }
void pm_yee_electric(const struct pm_yee *y, double dt) { curl(y, true, dt); }

double pm_yee_limit(const struct pm_grid *g, double factor)
{
	double sum = 0;
	for (int d = 0; d < g->dim; d++)
		sum += pm_yee_varies(g, d) ? factor * factor / (g->h[d] * g->h[d]) : 0;
	return sum > 0 ? 1 / sqrt(sum) : INFINITY;
}

/* Does a node lie on a face along which E is zero? */
static bool on_conductor(const struct pm_grid *g, const size_t at[3])
{
	bool on = false;
	for (int d = 0; d < g->dim; d++)
		if (g->face[d][0] != PM_PERIODIC)
			on |= (at[d] == 0 && pm_yee_conducts(g->face[d][0])) || (at[d] == g->cells[d] && pm_yee_conducts(g->face[d][1]));
	return on;
}

void pm_yee_divergence(const struct pm_yee *y, const double *rho, double *to)
{
	const struct pm_grid *g = &y->grid;
	const size_t rows = (y->planes ? y->planes->here * y->planes->size : pm_grid_size(g)) / g->points[0];
	const size_t before = y->planes ? pm_planes_row(y->planes, 0) : 0;
#pragma omp parallel for schedule(static) if (pm_grid_size(g) > 8192)
	for (size_t row = 0; row < rows; row++)
		for (size_t i = 0; i < g->points[0]; i++) {
			const size_t at[3] = {i, (before + row) % g->points[1], (before + row) / g->points[1]}, p = row * g->points[0] + i;
			double sum = 0;
			for (int d = 0; d < g->dim; d++) {
				const struct pair s = pair_at(y, d, false, at[d]);
				const double *e = (y->planes ? y->beside[d] : y->e[d]) + p;
				sum += (s.w_high * e[s.high] - s.w_low * e[s.low]) / g->h[d];
			}
			to[p] = on_conductor(g, at) ? 0 : sum - (rho ? rho[p] / y->eps0 : 0);
		}
}

void pm_yee_subtract_gradient(const struct pm_yee *y, const double *psi)
{
	for (int d = 0; d < y->grid.dim; d++) {
		size_t first[3], end[3];
		const struct term t = {.y = y, .axis = d, .up = true, .factor = -1, .from = psi, .to = y->e[d]};
		range(&y->grid, true, d, first, end);
		if (y->planes)
			range_here(y->planes, first, end);
		for (size_t k = first[2]; k < end[2]; k++)
			for (size_t j = first[1]; j < end[1]; j++)
				row_of(&t, first, end, j, k);
	}
}
