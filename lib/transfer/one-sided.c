/* Weights beside bodies and faces: of the kernel's weights W_i those on usable nodes are kept, and the least change in the norm of a window D makes their
 * moments exact again,
 *   w_i = W_i + D_i sum_a lambda_a z_i^a,   sum_i w_i z_i^a = 1 for a = 0, else 0, |a| <= degree,   z_i = (x_i - x)/h,   D_i = exp(-(z_i/s)^2)
 * over the usable nodes of a box. Where all nodes are usable this is the kernel; beside a flat face it is a one-sided kernel, and beside any body as exact
 * (total degree, at most 4). Where the nodes do not determine it, or the sum of |w| exceeds 8, the degree falls, down to 0, which keeps the total.
 * Source: Cottet and Koumoutsakos 2000, section 7.2 (one-sided kernels); the least change: weighted least squares, as for corrected kernels (Liu, Jun and
 * Zhang 1995). Cost: nodes of the box times moments^2, of the particles beside bodies alone. SPDX-License-Identifier: GPL-3.0-or-later */
#include <string.h>

#include "transfer/one-sided.h"

enum { MOMENTS = 35, WIDE = 36, NODES_WIDE = 16 }; /* degree 4 in 3-D; a row of them, by fours; how far a particle inside a body looks for nodes [cells] */
static const double sum_most = 8, pivot_least = 1e-9;

/* The first cell of the kernel and where the particle is [cells]; false: beyond the mesh. */
static bool locate(const struct pm_one_sided *o, const double x[3], double u[3], ptrdiff_t first[3])
{
	const struct pm_grid *g = &o->grid;
	for (int d = 0; d < 3; d++) {
		u[d] = 0, first[d] = 0;
		if (d >= g->dim)
			continue;
		const double n = (double)g->cells[d];
		u[d] = (x[d] - g->lo[d]) / g->h[d];
		if (g->face[d][0] == PM_PERIODIC)
			u[d] -= n * floor(u[d] / n);
		else if (!(u[d] >= -1e-9 && u[d] <= n + 1e-9))
			return false;
		first[d] = (ptrdiff_t)floor(o->kernel->width % 2 ? u[d] + 0.5 : u[d]) - (o->kernel->width - 1) / 2;
	}
	return true;
}

/* The number of a node, folded along periodic axes; SIZE_MAX: not usable. */
static size_t node_of(const struct pm_one_sided *o, const ptrdiff_t at[3])
{
	const struct pm_grid *g = &o->grid;
	size_t index[3] = {0, 0, 0};
	for (int d = 0; d < g->dim; d++) {
		const ptrdiff_t n = (ptrdiff_t)g->points[d];
		ptrdiff_t i = at[d];
		if (g->face[d][0] == PM_PERIODIC)
			i = (i % n + n) % n;
		if (i < 0 || i >= n)
			return SIZE_MAX;
		index[d] = (size_t)i;
	}
	const size_t node = (index[2] * g->points[1] + index[1]) * g->points[0] + index[0];
	return o->mask && o->mask[node] ? SIZE_MAX : node;
}

/* The next place of a box of `width` from `first`; false behind the last. */
static bool next(int dim, ptrdiff_t width, const ptrdiff_t first[3], ptrdiff_t at[3])
{
	for (int d = 0; d < dim; d++) {
		if (++at[d] < first[d] + width)
			return true;
		at[d] = first[d];
	}
	return false;
}

static bool touches(const struct pm_one_sided *o, const double x[3])
{
	double u[3];
	ptrdiff_t first[3], at[3];
	if (!locate(o, x, u, first))
		return true;
	for (int d = 0; d < o->grid.dim; d++) /* the end node too: of a field that is odd at a wall a gather takes 0 there */
		if (o->grid.face[d][0] != PM_PERIODIC && (first[d] <= 0 || first[d] + o->kernel->width > (ptrdiff_t)o->grid.cells[d]))
			return true;
	memcpy(at, first, sizeof at);
	do
		if (node_of(o, at) == SIZE_MAX)
			return true;
	while (next(o->grid.dim, o->kernel->width, first, at));
	return false;
}

int pm_one_sided_find(const struct pm_one_sided *o, size_t n, const double *const x[], struct pm_one_sided_few *few)
{
	unsigned char *hit = pm_zalloc(n + 1, 1);
	*few = (struct pm_one_sided_few){.count = 0};
	for (int d = 0; d < o->grid.dim; d++)
		few->x[d] = x[d];
	if (!hit)
		return -PM_DATA;
#pragma omp parallel for schedule(static) if (n > 4096)
	for (size_t p = 0; p < n; p++)
		hit[p] = touches(o, (const double[]){x[0][p], o->grid.dim > 1 ? x[1][p] : 0, o->grid.dim > 2 ? x[2][p] : 0});
	for (size_t p = 0; p < n; p++)
		few->count += hit[p];
	few->which = pm_alloc(few->count + 1, sizeof *few->which);
	for (size_t p = 0, k = 0; p < n && few->which; p++)
		if (hit[p])
			few->which[k++] = p;
	pm_free(hit);
	return few->which ? 0 : -PM_DATA;
}

/* z^a for every |a| <= degree, in order of |a|; how many. Each is one of the degree before times a component: the first row, then all of them times z_3. */
static inline int powers(int dim, int degree, const double z[3], double v[WIDE])
{
	const double z0 = z[0], z1 = z[1], z2 = z[2];
	int n = 1;
	v[0] = 1;
	for (int all = 1, before = 0; all <= degree; all++) {
		const int from = n;
		v[n++] = v[before] * z0;
		for (int b = 0; dim > 1 && b < all; b++)
			v[n++] = v[before + b] * z1;
		for (int k = before; dim > 2 && k < from; k++)
			v[n++] = v[k] * z2;
		before = from;
	}
	return n;
}

/* M lambda = right by Cholesky; false where a pivot is too small. */
static bool solve(int n, double M[MOMENTS][WIDE], double right[MOMENTS])
{
	for (int i = 0; i < n; i++) {
		const double before = M[i][i];
		for (int j = 0; j <= i; j++) {
			for (int k = 0; k < j; k++)
				M[i][j] -= M[i][k] * M[j][k];
			if (j < i)
				M[i][j] /= M[j][j];
		}
		if (!(M[i][i] > pivot_least * before))
			return false;
		M[i][i] = sqrt(M[i][i]);
	}
	for (int i = 0; i < n; i++) {
		for (int k = 0; k < i; k++)
			right[i] -= M[i][k] * right[k];
		right[i] /= M[i][i];
	}
	for (int i = n - 1; i >= 0; i--) {
		for (int k = i + 1; k < n; k++)
			right[i] -= M[k][i] * right[k];
		right[i] /= M[i][i];
	}
	return true;
}

/* One box of usable nodes around a particle. */
struct box {
	double scale, spread; /* of z, and the window's width [cells] */
	double *z, *W, *D;    /* [n][3], [n], [n] */
};

/* w for the degree: the kernel's weights, changed least; false if the nodes do not determine them or they are too large. Two rounds: the second removes the
 * rounding errors of the first. */
static bool correct(const struct box *b, int dim, int degree, struct pm_one_sided_share *s)
{
	double M[MOMENTS][WIDE] = {{0}}, factor[MOMENTS][WIDE], v[WIDE] = {0}, sum = 0;
	int count = 0;
	for (size_t i = 0; i < s->n; i++) {
		count = powers(dim, degree, b->z + 3 * i, v);
		for (int a = 0; a < count; a++) {
			const double share = b->D[i] * v[a];
			for (int c = 0; c <= a; c += 4) /* some beyond the diagonal, which nobody reads */
				for (int k = c; k < c + 4; k++)
					M[a][k] += share * v[k];
		}
		s->w[i] = b->W[i];
	}
	if (s->n < (size_t)count)
		return false;
	for (int round = 0; round < 2; round++) {
		double right[MOMENTS] = {1};
		for (size_t i = 0; i < s->n; i++) {
			powers(dim, degree, b->z + 3 * i, v);
			for (int a = 0; a < count; a++)
				right[a] -= s->w[i] * v[a];
		}
		memcpy(factor, M, sizeof factor);
		if (!solve(count, factor, right))
			return false;
		for (size_t i = 0; i < s->n; i++) {
			powers(dim, degree, b->z + 3 * i, v);
			double w = s->w[i];
			for (int a = 0; a < count; a++)
				w += b->D[i] * right[a] * v[a];
			s->w[i] = w;
		}
	}
	for (size_t i = 0; i < s->n; i++)
		sum += fabs(s->w[i]);
	s->degree = degree;
	return sum <= sum_most;
}

static int room_for(struct pm_one_sided_share *s, struct box *b, size_t n)
{
	if (n > s->room) {
		pm_one_sided_share_free(s);
		s->node = pm_alloc(n, sizeof *s->node);
		s->w = pm_alloc(6 * n, sizeof *s->w); /* and the box */
		s->room = s->node && s->w ? n : 0;
	}
	b->W = s->w + s->room, b->D = b->W + s->room, b->z = b->D + s->room;
	return s->room ? 0 : -PM_DATA;
}

/* The usable nodes from first on, their kernel weights and window; how many of them are in the kernel. */
static size_t fill(const struct pm_one_sided *o, const double u[3], const ptrdiff_t kernel_first[3], ptrdiff_t reach, struct pm_one_sided_share *s,
	struct box *b)
{
	const int dim = o->grid.dim, width = o->kernel->width;
	const ptrdiff_t wide = width + 2 * reach;
	double w[3][PM_KERNEL_WIDTH];
	ptrdiff_t first[3] = {0}, at[3];
	size_t own = 0;
	s->n = 0;
	for (int d = 0; d < dim; d++) {
		const double base = (double)(kernel_first[d] + (width - 1) / 2);
		pm_kernel_weights(o->kernel, u[d] - base, w[d]);
		first[d] = kernel_first[d] - reach;
	}
	memcpy(at, first, sizeof at);
	do {
		const size_t node = node_of(o, at);
		double W = 1, r2 = 0;
		if (node == SIZE_MAX)
			continue;
		for (int d = 0; d < dim; d++) {
			const ptrdiff_t k = at[d] - kernel_first[d];
			const double z = (double)at[d] - u[d];
			W *= k >= 0 && k < width ? w[d][k] : 0;
			own += d == 0 && k >= 0 && k < width && (dim < 2 || (at[1] >= kernel_first[1] && at[1] < kernel_first[1] + width)) &&
				(dim < 3 || (at[2] >= kernel_first[2] && at[2] < kernel_first[2] + width));
			b->z[3 * s->n + (size_t)d] = z / b->scale;
			r2 += z * z;
		}
		b->W[s->n] = W;
		b->D[s->n] = exp(-r2 / (b->spread * b->spread));
		s->node[s->n++] = node;
	} while (next(dim, wide, first, at));
	return own;
}

/* Degree 0: by the window alone. */
static void by_window(const struct box *b, struct pm_one_sided_share *s)
{
	double sum = 0;
	for (size_t i = 0; i < s->n; i++)
		sum += b->D[i];
	for (size_t i = 0; i < s->n; i++)
		s->w[i] = b->D[i] / sum;
	s->degree = 0;
}

int pm_one_sided_share(const struct pm_one_sided *o, const double x[3], struct pm_one_sided_share *s)
{
	const int dim = o->grid.dim, most = o->kernel->moments < PM_ONE_SIDED_DEGREE ? o->kernel->moments : PM_ONE_SIDED_DEGREE;
	double u[3];
	ptrdiff_t first[3];
	s->n = 0;
	if (!locate(o, x, u, first))
		return 1;
	/* Larger boxes for the full degree, then lower degrees, then any node. */
	for (ptrdiff_t reach = 1; reach <= NODES_WIDE; reach++) {
		struct box b = {.scale = 0.5 * o->kernel->width, .spread = 0.5 * (most + 1)};
		const size_t wide = (size_t)(o->kernel->width + 2 * reach);
		if (room_for(s, &b, wide * (dim > 1 ? wide : 1) * (dim > 2 ? wide : 1)))
			return -PM_DATA;
		const size_t own = fill(o, u, first, reach, s, &b);
		s->low = first[dim - 1] - reach, s->high = first[dim - 1] + o->kernel->width - 1 + reach;
		const bool last = reach >= 1 + most / 2;
		for (int degree = most; degree > 0 && own && (degree == most || last); degree--)
			if (correct(&b, dim, degree, s))
				return 0;
		if (s->n && last) {
			by_window(&b, s);
			return 0;
		}
	}
	return 1;
}

/* Shares of up to `batch` particles at once; which of them have none. */
enum { batch = 256 };
struct shares {
	struct pm_one_sided_share s[batch];
	int none[batch];
};

static int make_shares(const struct pm_one_sided *o, const struct pm_one_sided_few *few, size_t from, size_t count, struct shares *a)
{
	const double *const *x = few->x;
	int bad = 0;
#pragma omp parallel for schedule(dynamic, 8) reduction(| : bad)
	for (size_t k = 0; k < count; k++) {
		const size_t p = few->which[from + k];
		a->none[k] = pm_one_sided_share(o, (const double[]){x[0][p], o->grid.dim > 1 ? x[1][p] : 0, o->grid.dim > 2 ? x[2][p] : 0}, &a->s[k]);
		bad |= a->none[k] < 0;
	}
	return bad ? -PM_DATA : 0;
}

static void free_shares(struct shares *a)
{
	for (int k = 0; a && k < batch; k++)
		pm_one_sided_share_free(&a->s[k]);
	pm_free(a);
}

static void note_lost(struct pm_one_sided_few *few, size_t from, size_t n, const struct shares *a)
{
	for (size_t k = 0; k < n; k++)
		if (a->none[k]) {
			few->first = few->lost ? few->first : few->which[from + k];
			few->lost++;
		}
}

/* What is done with a particle's share; k: of few->which; NULL: it has none. */
typedef void use_of(const struct pm_one_sided *o, const struct pm_one_sided_few *few, size_t k, const struct pm_one_sided_share *s, const void *data);

/* In the order of the stream, whatever the threads. */
static int each(const struct pm_one_sided *o, struct pm_one_sided_few *few, use_of *use, const void *data)
{
	struct shares *a = pm_zalloc(1, sizeof *a);
	int status = a ? 0 : -PM_DATA;
	few->lost = few->first = 0;
	for (size_t from = 0; from < few->count && !status; from += batch) {
		const size_t n = few->count - from < batch ? few->count - from : batch;
		status = make_shares(o, few, from, n, a);
		note_lost(few, from, n, a);
		for (size_t k = 0; k < n && !status; k++)
			use(o, few, from + k, a->none[k] ? NULL : &a->s[k], data);
	}
	free_shares(a);
	return status;
}

/* Where a node is in the planes here; SIZE_MAX: not here. */
static size_t here(const struct pm_planes *p, size_t node)
{
	const size_t at = p ? node - p->first * p->size : node; /* wraps where it is below */
	return p && at >= p->here * p->size ? SIZE_MAX : at;
}

struct numbers {
	int components;
	const double *const *in;
	double *const *out;
};

static void spread(const struct pm_one_sided *o, const struct pm_one_sided_few *few, size_t k, const struct pm_one_sided_share *s, const void *data)
{
	const struct numbers *a = data;
	for (int c = 0; c < a->components && s; c++)
		for (size_t i = 0; i < s->n; i++) {
			const size_t at = here(o->planes, s->node[i]);
			if (at != SIZE_MAX)
				a->out[c][at] += s->w[i] * a->in[c][few->which[k]];
		}
}

int pm_one_sided_spread_here(const struct pm_one_sided *o, struct pm_one_sided_few *few, int components, const double *const q[], double *const node[])
{
	return each(o, few, spread, &(struct numbers){components, q, node});
}

static void gather(const struct pm_one_sided *o, const struct pm_one_sided_few *few, size_t k, const struct pm_one_sided_share *s, const void *data)
{
	const struct numbers *a = data;
	const size_t all = o->planes ? o->planes->all : 1, size = pm_grid_size(&o->grid) / all;
	(void)few;
	for (int c = 0; c < a->components; c++) {
		double sum = 0;
		for (size_t i = 0; s && i < s->n; i++)
			sum += s->w[i] * a->in[(size_t)c * all + s->node[i] / size][s->node[i] % size];
		a->out[c][k] = sum;
	}
}

int pm_one_sided_gather_here(const struct pm_one_sided *o, struct pm_one_sided_few *few, int components, const double *const plane[], double *const value[])
{
	return each(o, few, gather, &(struct numbers){components, plane, value});
}

static void reached(const struct pm_one_sided *o, const struct pm_one_sided_few *few, size_t k, const struct pm_one_sided_share *s, const void *data)
{
	struct pm_one_sided_reach *const *reach = data;
	(void)o, (void)few;
	(*reach)[k] = s ? (struct pm_one_sided_reach){s->low, s->high} : (struct pm_one_sided_reach){0, -1};
}

int pm_one_sided_reaches(const struct pm_one_sided *o, struct pm_one_sided_few *few, struct pm_one_sided_reach *reach)
{
	return each(o, few, reached, &reach);
}

static bool shared(const struct pm_one_sided *o) { return o->planes && o->planes->divided; }

int pm_one_sided_spread(const struct pm_one_sided *o, struct pm_one_sided_few *few, int components, const double *const q[], double *const node[])
{
	return shared(o) ? pm_one_sided_spread_ranks(o, few, components, q, node) : pm_one_sided_spread_here(o, few, components, q, node);
}

int pm_one_sided_gather(const struct pm_one_sided *o, struct pm_one_sided_few *few, int components, const double *const mesh[], double *const value[])
{
	const struct pm_one_sided whole = {.grid = o->grid, .kernel = o->kernel, .mask = o->mask};
	return shared(o) ? pm_one_sided_gather_ranks(o, few, components, mesh, value) : pm_one_sided_gather_here(&whole, few, components, mesh, value);
}

void pm_one_sided_share_free(struct pm_one_sided_share *s)
{
	pm_free(s->node), pm_free(s->w);
	*s = (struct pm_one_sided_share){.n = 0};
}
