/* Cell lists (Hockney and Eastwood 1988, section 8-4): particles sorted by cell, x fastest, so that the cells in reach along x are one contiguous range of
 * the order. Rows of cells are limited to the sphere around the particles in a cell. Images are not stored: a range contains the shift of its particles,
 * chosen so that the difference of two positions is the same from both sides to the last bit. If there are many more cells than particles, cells are
 * searched in the sorted keys. Cost: N log N to sort (radix), then one search per cell and row.
 * SPDX-License-Identifier: GPL-3.0-or-later */
#include "cell/cell-list.h"
#include "cell/radix-sort.h"

enum { cells_most = 1 << 20 }; /* along an axis: 63 bits of key, and a resolution of 1e-9 of a cell */
static const double slack = 1e-9; /* of a cell: bound on the rounding of a position */
static const double before = 0.13; /* of a cell: where the first begins before the particles */

static inline double larger(double a, double b) { return a > b ? a : b; }
static inline double smaller(double a, double b) { return a < b ? a : b; }

/* The extent of the cells along an axis: the box where it is periodic, else that of the particles. */
static void extent(const struct pm_domain *d, int axis, size_t n, const double *x, double *lo, double *hi)
{
	*lo = d->lo[axis], *hi = d->hi[axis];
	if (d->face[axis][0] == PM_PERIODIC || !n)
		return;
	double least = x[0], most = x[0];
	for (size_t i = 0; i < n; i++) {
		least = x[i] < least ? x[i] : least;
		most = x[i] > most ? x[i] : most;
	}
	*lo = least, *hi = most;
}

static void shape(struct pm_cell_list *l, size_t n, const double *const x[], double edge)
{
	edge = fmin(fmax(edge, l->reach / 8), l->reach);
	l->most = 1;
	for (int d = 0; d < 3; d++) {
		double lo = 0, hi = 0, rows = 0;
		if (d < l->domain.dim)
			extent(&l->domain, d, n, x[d], &lo, &hi);
		bool periodic = d < l->domain.dim && l->domain.face[d][0] == PM_PERIODIC;
		double fit = floor((hi - lo) / edge + (periodic ? slack : before)) + !periodic;
		l->cells[d] = (size_t)fmin(fmax(fit, 1), cells_most);
		l->edge[d] = periodic ? (hi - lo) / (double)l->cells[d] : l->cells[d] == cells_most ? (hi - lo) / (cells_most - 1) : edge;
		l->lo[d] = lo - before * l->edge[d];
		rows = fmin((double)l->cells[d], 2 * ceil(l->reach / l->edge[d]) + 4);
		l->most *= (size_t)l->images[d].n * (d ? (size_t)rows : 1);
	}
}

static size_t cell_at(const struct pm_cell_list *l, int d, double x)
{
	double s = floor((x - l->lo[d]) / l->edge[d]), last = (double)(l->cells[d] - 1);
	return (size_t)(s > 0 ? s < last ? s : last : 0);
}

static double folded(const struct pm_cell_list *l, int d, double x)
{
	double length = l->domain.hi[d] - l->domain.lo[d], lo = l->lo[d], hi = lo + length;
	if (l->domain.face[d][0] != PM_PERIODIC || (x >= lo && x < hi))
		return x;
	double y = x - length * floor((x - lo) / length);
	return y < lo || y >= hi ? lo : y;
}

static void keys(const struct pm_cell_list *l, const double *const x[], uint64_t *key)
{
#pragma omp parallel for schedule(static) if (l->n > 16384)
	for (size_t i = 0; i < l->n; i++) {
		key[i] = 0;
		for (int d = l->domain.dim - 1; d >= 0; d--)
			key[i] = key[i] * l->cells[d] + cell_at(l, d, folded(l, d, x[d][i]));
	}
}

/* The occupied cells from the sorted keys, and the table of all cells where it is not too long. */
static int occupied(struct pm_cell_list *l, const uint64_t *sorted)
{
	double all = (double)l->cells[0] * (double)l->cells[1] * (double)l->cells[2];
	for (size_t i = 0; i < l->n; i++)
		if (!i || sorted[i] != sorted[i - 1])
			l->key[l->occupied] = sorted[i], l->start[l->occupied++] = i;
	l->start[l->occupied] = l->n;
	if (all > 4 * (double)l->n + 4096)
		return 0;
	size_t cells = (size_t)all, c = 0;
	if (!(l->first = pm_alloc(cells + 1, sizeof *l->first)))
		return -PM_DATA;
	for (size_t k = 0; k <= cells; k++) {
		while (c < l->occupied && l->key[c] < k)
			c++;
		l->first[k] = l->start[c];
	}
	return 0;
}

static int sort(struct pm_cell_list *l, const double *const x[])
{
	size_t room = l->n ? l->n : 1;
	uint64_t *key = pm_alloc(room, sizeof *key), *work = pm_alloc(room, sizeof *work);
	size_t *order_work = pm_alloc(room, sizeof *order_work);
	int status = key && work && order_work ? 0 : -PM_DATA;
	if (!status) {
		keys(l, x, key);
		pm_keys_order(l->n, key, work, l->order, order_work);
		keys(l, x, work);
		for (size_t i = 0; i < l->n; i++)
			key[i] = work[l->order[i]];
		status = occupied(l, key);
	}
	pm_free(key), pm_free(work), pm_free(order_work);
	return status;
}

static void gather(struct pm_cell_list *l, const double *const x[])
{
	for (int d = 0; d < l->domain.dim; d++) {
#pragma omp parallel for schedule(static) if (l->n > 16384)
		for (size_t i = 0; i < l->n; i++)
			l->x[d][i] = folded(l, d, x[d][l->order[i]]);
		for (size_t i = l->n; i < l->n + PM_CELLS_PAD; i++)
			l->x[d][i] = 0;
	}
}

int pm_cell_list_init(struct pm_cell_list *l, const struct pm_domain *domain, size_t n, const double *const x[], double reach, double edge)
{
	int status = 0;
	*l = (struct pm_cell_list){.domain = *domain, .n = n, .reach = reach};
	for (int d = 0; d < 3; d++) {
		l->images[d] = (struct pm_images){.n = 1, .image = {{1, 0, 1}}};
		if (d < domain->dim && !status)
			status = pm_images_of(domain->lo[d], domain->hi[d], domain->face[d], reach, &l->images[d]);
		l->x[d] = d < domain->dim ? pm_alloc(n + PM_CELLS_PAD, sizeof **l->x) : NULL;
		if (d < domain->dim && !l->x[d])
			status = -PM_DATA;
	}
	l->order = pm_alloc(n + 1, sizeof *l->order);
	l->key = pm_alloc(n + 1, sizeof *l->key);
	l->start = pm_alloc(n + 1, sizeof *l->start);
	if (status || !l->order || !l->key || !l->start)
		return status ? status : -PM_DATA;
	shape(l, n, x, edge);
	status = sort(l, x);
	if (!status)
		gather(l, x);
	return status;
}

void pm_cell_list_free(struct pm_cell_list *l)
{
	for (int d = 0; d < 3; d++)
		pm_free(l->x[d]);
	pm_free(l->order), pm_free(l->key), pm_free(l->start), pm_free(l->first);
	*l = (struct pm_cell_list){.n = 0};
}

/* First place at or behind a cell. */
static size_t place(const struct pm_cell_list *l, uint64_t key)
{
	if (l->first)
		return l->first[key];
	size_t from = 0, to = l->occupied;
	while (from < to) {
		size_t middle = from + (to - from) / 2;
		if (l->key[middle] < key)
			from = middle + 1;
		else
			to = middle;
	}
	return l->start[from];
}

/* The extent of a cell's particles along an axis, relative to one image, and the cells within its reach. */
struct span {
	double lo, hi;    /* [length] */
	size_t from, to;  /* cells from..to-1 */
};

static struct span span_of(const struct pm_cell_list *l, int d, double lo, double hi, const struct pm_image *m, double reach)
{
	struct span s = {lo + m->shift, hi + m->shift, 0, 1};
	if (m->side < 0)
		s.lo = m->shift - hi, s.hi = m->shift - lo;
	if (d >= l->domain.dim)
		return s;
	reach += 4e-16 * (fabs(s.lo) + fabs(s.hi) + fabs(m->shift)); /* rounding of the shift */
	double from = floor((s.lo - reach - l->lo[d]) / l->edge[d] - slack), to = floor((s.hi + reach - l->lo[d]) / l->edge[d] + slack) + 1;
	double cells = (double)l->cells[d];
	s.from = (size_t)smaller(larger(from, 0), cells);
	s.to = (size_t)smaller(larger(to, 0), cells);
	return s;
}

/* Square of the distance of a cell from a span. */
static double gap2(const struct pm_cell_list *l, int d, const struct span *s, size_t cell)
{
	if (d >= l->domain.dim)
		return 0;
	double lo = l->lo[d] + l->edge[d] * ((double)cell - slack), hi = l->lo[d] + l->edge[d] * ((double)cell + 1 + slack);
	double gap = larger(0, larger(lo - s->hi, s->lo - hi));
	return gap * gap;
}

static enum pm_range_kind kind_of(int dim, const struct pm_image *const m[3])
{
	enum pm_range_kind kind = PM_HERE;
	for (int d = 0; d < dim; d++) {
		if (m[d]->side < 0)
			return PM_MIRRORED;
		if (m[d]->shift != 0)
			kind = m[d]->shift > 0 ? PM_AHEAD : PM_BEHIND;
	}
	return m[0]->sign * m[1]->sign * m[2]->sign > 0 ? kind : PM_MIRRORED;
}

/* The rows of one combination of images; none that end at or before the place `after`. */
static size_t rows(const struct pm_cell_list *l, const double lo[3], const double hi[3], const struct pm_image *const m[3], enum pm_range_kind kind,
	size_t after,
	struct pm_neighbour_range *s)
{
	struct pm_neighbour_range like = {.sign = m[0]->sign * m[1]->sign * m[2]->sign, .kind = kind};
	struct span span[3];
	size_t n = 0;
	for (int d = 0; d < 3; d++) {
		span[d] = span_of(l, d, lo[d], hi[d], m[d], l->reach);
		like.side[d] = m[d]->side, like.shift[d] = m[d]->shift;
		if (span[d].from >= span[d].to)
			return 0;
	}
	for (size_t z = span[2].from; z < span[2].to; z++) {
		double beside = gap2(l, 2, &span[2], z);
		for (size_t y = span[1].from; y < span[1].to; y++) {
			double left = l->reach * l->reach * (1 + slack) - beside - gap2(l, 1, &span[1], y);
			struct span row = left < 0 ? span[0] : span_of(l, 0, lo[0], hi[0], m[0], sqrt(left));
			uint64_t key = (z * l->cells[1] + y) * l->cells[0];
			if (left < 0 || row.from >= row.to)
				continue;
			s[n] = like;
			s[n].from = place(l, key + row.from);
			s[n].to = place(l, key + row.to);
			s[n].from = s[n].from < after ? after : s[n].from;
			n += s[n].from < s[n].to;
		}
	}
	return n;
}

size_t pm_cell_list_around(const struct pm_cell_list *l, size_t c, bool half, struct pm_neighbour_range *s)
{
	double lo[3] = {0}, hi[3] = {0};
	size_t n = 0;
	for (int d = 0; d < l->domain.dim; d++) {
		lo[d] = hi[d] = l->x[d][l->start[c]];
		for (size_t i = l->start[c] + 1; i < l->start[c + 1]; i++) {
			lo[d] = smaller(lo[d], l->x[d][i]);
			hi[d] = larger(hi[d], l->x[d][i]);
		}
	}
	for (int z = 0; z < l->images[2].n; z++)
		for (int y = 0; y < l->images[1].n; y++)
			for (int x = 0; x < l->images[0].n; x++) {
				const struct pm_image *const m[3] = {&l->images[0].image[x], &l->images[1].image[y], &l->images[2].image[z]};
				enum pm_range_kind kind = kind_of(l->domain.dim, m);
				if (!half || kind != PM_BEHIND)
					n += rows(l, lo, hi, m, kind, half && kind == PM_HERE ? l->start[c] : 0, s + n);
			}
	return n;
}
