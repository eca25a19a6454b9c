/* Poisson's equation lap phi = c*s by fast transforms: phi^ = c s^ / lambda, lambda the sum over axes of the symbol of d2/dx2.
 * Faces by axis: periodic (Fourier), wall (sine, phi = 0), neumann (cosine), in any mixture; or open on all axes: the convolution with the
 * free-space Green's function on a domain of doubled length 2n (exactly, for the function is even), padding kept out of memory where it is zero.
 * Source: Hockney and Eastwood 1988, chapters 6-5 and 6-6; Swarztrauber 1977. Symbols: -k^2, or those of the centred differences of order 2, 4.
 * Three passes over memory: planes (rows, then columns while the plane is in cache); blocks of pencils along the last axis forward, times
 * the symbol, and back; planes back. Periodic and open: complex spectra of real rows; otherwise real transforms (mesh/lines.h).
 * Determinism: serial plans, a partition that does not depend on threads, no reductions. Cost: N log N; memory one copy of the mesh,
 * open 4 in 3-D and half a copy for the Green's function.
 * SPDX-License-Identifier: GPL-3.0-or-later */
#include <omp.h>
#include <stdlib.h>
#include <string.h>

#include "mesh/lines.h"
#include "poisson/fft.h"

enum { L = PM_LANES, X = 0, Y = 1, Z = 2 };

const char *const pm_symbol_names[] = {"spectral", "fd2", "fd4", NULL};

struct pm_poisson_fft {
	struct pm_grid grid;
	struct pm_planner planner;
	bool complex, singular, empty; /* complex: periodic or open; empty: a wall axis without inner nodes */
	struct pm_line line[3];        /* x along rows, y across a plane, z across planes; in 2-D y is trivial, z the mesh's second axis */
	size_t nodes[3], modes[3];     /* that take part; modes complex numbers or reals */
	size_t chunks;                 /* of L doubles per row of modes */
	size_t row, plane;             /* [doubles] strides of w */
	double *w;                     /* nodes[Z] * plane */
	fftw_plan row_forward, row_backward, backward[3];
	double *lambda[3];             /* [1/length^2]: X per double of a row, Y and Z per mode */
	double *green;                 /* open: transform of the Green's function, in the layout of a real solver (next) */
	size_t green_row, green_plane; /* [doubles] */
	double h2;                     /* volume of a cell, open; else 1 */
	int threads;
	size_t lot;                    /* [doubles] of scratch per thread */
	double *scratch;
	double zero;                   /* the mode of constants, after the forward transform */
};

/* Where rows come from and go to: j, k count the nodes that take part; row holds nodes[X] values. */
struct rows {
	const struct pm_poisson_fft *p;
	const double *s;
	double *phi;
	void (*get)(const struct rows *r, size_t j, size_t k, double *row);
};

int pm_symbol_find(const char *name)
{
	for (int i = 0; pm_symbol_names[i]; i++)
		if (!strcmp(pm_symbol_names[i], name))
			return i;
	return pm_fail(PM_USAGE, "no symbol '%s' (choose spectral, fd2 or fd4)", name), -1;
}

double pm_symbol_value(enum pm_symbol symbol, double theta, double h)
{
	double s = sin(0.5 * theta), k = 2 * s / h;
	if (symbol == PM_SPECTRAL)
		k = theta / h;
	return symbol == PM_FD4 ? -k * k * (1 + s * s / 3) : -k * k;
}

bool pm_poisson_fft_singular(const struct pm_grid *g)
{
	for (int d = 0; d < g->dim; d++)
		if (g->face[d][0] != PM_PERIODIC && g->face[d][0] != PM_NEUMANN)
			return false;
	return true;
}

int pm_poisson_fft_check(const struct pm_grid *g, enum pm_symbol symbol)
{
	int open = 0;
	for (int d = 0; d < g->dim; d++) {
		if (g->face[d][0] == PM_ABSORBING || g->face[d][1] == PM_ABSORBING)
			return pm_fail(PM_DATA, "absorbing faces belong to Maxwell's equations (Poisson's take periodic, wall, neumann or open faces)");
		if (g->face[d][0] != g->face[d][1])
			return pm_fail(PM_DATA, "axis %c is %s below and %s above: a transform needs the same on both (poisson-mg takes wall and neumann on one axis)",
				"xyz"[d], pm_face_names[g->face[d][0]], pm_face_names[g->face[d][1]]);
		open += g->face[d][0] == PM_OPEN;
	}
	if (open && open < g->dim)
		return pm_fail(PM_DATA, "open faces on %d of %d axes (poisson-fft takes open faces on all axes, or any mixture of periodic, wall and neumann)",
			open, g->dim);
	if (open && symbol != PM_SPECTRAL && !(g->dim == 1 && symbol == PM_FD2))
		return pm_fail(PM_DATA, "--symbol %s has no free-space Green's function here (choose --symbol spectral for open faces)", pm_symbol_names[symbol]);
	return 0;
}

/* Rows of the mesh. At open faces the end nodes weigh half, as in every sum over a mesh. */
static void get_source(const struct rows *r, size_t j, size_t k, double *row)
{
	const struct pm_poisson_fft *p = r->p;
	const struct pm_grid *g = &p->grid;
	size_t at[3] = {p->line[X].first, p->line[Y].first + j, p->line[Z].first + k};
	const double *s = r->s + at[X] + g->points[0] * (g->dim == 2 ? at[Z] : at[Y] + g->points[1] * at[Z]);
	memcpy(row, s, p->nodes[X] * sizeof *row);
	if (p->line[X].face != PM_OPEN)
		return;
	double weight = 1;
	for (int a = Y; a <= Z; a++)
		if (p->line[a].face == PM_OPEN && (at[a] == 0 || at[a] == p->line[a].n))
			weight *= 0.5;
	if (weight < 1)
		for (size_t i = 0; i < p->nodes[X]; i++)
			row[i] *= weight;
	row[0] *= 0.5;
	row[p->line[X].n] *= 0.5;
}

static void get_green(const struct rows *r, size_t j, size_t k, double *row)
{
	const struct pm_grid *g = &r->p->grid;
	double y = g->dim == 3 ? (double)j * g->h[1] : 0, z = (double)k * g->h[g->dim == 2 ? 1 : 2];
	if (g->dim == 1)
		z = 0;
	for (size_t i = 0; i < r->p->nodes[X]; i++) {
		double x = (double)i * g->h[0], r2 = x * x + y * y + z * z;
		row[i] = r2 > 0 ? pm_green(g->dim, r2) : r->s[0];
	}
}

static void put_row(const struct rows *r, size_t j, size_t k, const double *row)
{
	const struct pm_poisson_fft *p = r->p;
	const struct pm_grid *g = &p->grid;
	size_t at[3] = {p->line[X].first, p->line[Y].first + j, p->line[Z].first + k};
	double *phi = r->phi + g->points[0] * (g->dim == 2 ? at[Z] : at[Y] + g->points[1] * at[Z]);
	if (at[X])
		phi[0] = phi[g->points[0] - 1] = 0;
	memcpy(phi + at[X], row, p->nodes[X] * sizeof *row);
}

static double *thread_scratch(const struct pm_poisson_fft *p, int thread)
{
	return p->scratch + (size_t)thread * p->lot;
}

/* n rows of L doubles, stride doubles apart, to and from a block. */
static void gather(const double *restrict from, size_t stride, size_t n, double *restrict block)
{
	for (size_t i = 0; i < n; i++)
		for (int q = 0; q < L; q++)
			block[i * L + q] = from[i * stride + q];
}

static void scatter(const double *restrict block, size_t n, size_t stride, double *restrict to)
{
	for (size_t i = 0; i < n; i++)
		for (int q = 0; q < L; q++)
			to[i * stride + q] = block[i * L + q];
}

static void block_forward(const struct pm_poisson_fft *p, int axis, double *block)
{
	const struct pm_line *l = &p->line[axis];
	if (!p->complex) {
		pm_line_real(l, block);
	} else if (l->forward) {
		pm_line_extend(l, false, block);
		fftw_execute_dft(l->forward, (fftw_complex *)block, (fftw_complex *)block);
	}
}

static void block_backward(const struct pm_poisson_fft *p, int axis, double *block)
{
	if (!p->complex)
		pm_line_real(&p->line[axis], block);
	else if (p->backward[axis])
		fftw_execute_dft(p->backward[axis], (fftw_complex *)block, (fftw_complex *)block);
}

/* A slab is what one thread transforms at a time: a plane, or L single rows where planes are that thin. */
static bool thick(const struct pm_poisson_fft *p)
{
	return p->line[Y].length > 1;
}

static size_t slabs(const struct pm_poisson_fft *p)
{
	return thick(p) ? p->nodes[Z] : (p->nodes[Z] + L - 1) / L;
}

struct slab {
	size_t j, k, rows, dj, dk; /* row r is row j+r*dj of plane k+r*dk */
};

/* The part of slab number i from row number start on, most rows at most. */
static struct slab slab_part(const struct pm_poisson_fft *p, size_t i, size_t start, size_t most)
{
	bool plane = thick(p);
	struct slab s = {.j = plane ? start : 0, .k = plane ? i : i * L + start, .dj = plane, .dk = !plane};
	size_t left = plane ? p->nodes[Y] - s.j : p->nodes[Z] - s.k;
	s.rows = left < most ? left : most;
	return s;
}

static size_t slab_rows(const struct pm_poisson_fft *p, size_t i)
{
	return slab_part(p, i, 0, thick(p) ? p->nodes[Y] : L).rows;
}

static double *row_at(const struct pm_poisson_fft *p, const struct slab *s, size_t r)
{
	return p->w + (s->k + r * s->dk) * p->plane + (s->j + r * s->dj) * p->row;
}

/* Rows of nodes to rows of modes. Complex: one row at a time; real: L rows as one block. */
static void rows_forward(const struct pm_poisson_fft *p, const struct rows *io, const struct slab *s, double *scratch)
{
	size_t n = p->line[X].length, used = p->nodes[X], first = p->line[X].first;
	if (p->complex) {
		for (size_t r = 0; r < s->rows; r++) {
			double *to = row_at(p, s, r);
			io->get(io, s->j + r * s->dj, s->k + r * s->dk, scratch);
			memset(scratch + used, 0, (n - used) * sizeof *scratch);
			if (n > 1)
				fftw_execute_dft_r2c(p->row_forward, scratch, (fftw_complex *)to);
			else
				to[0] = scratch[0], to[1] = 0;
			memset(to + 2 * p->modes[X], 0, (p->row - 2 * p->modes[X]) * sizeof *to);
		}
		return;
	}
	double *block = scratch, *row = scratch + n * L;
	for (size_t r = 0; r < L; r++) {
		if (r < s->rows)
			io->get(io, s->j + r * s->dj, s->k + r * s->dk, row);
		else
			memset(row, 0, used * sizeof *row);
		for (size_t i = 0; i < used; i++)
			block[(first + i) * L + r] = row[i];
	}
	pm_line_real(&p->line[X], block);
	for (size_t r = 0; r < s->rows; r++) {
		double *to = row_at(p, s, r);
		for (size_t i = 0; i < used; i++)
			to[i] = block[(first + i) * L + r];
		memset(to + used, 0, (p->row - used) * sizeof *to);
	}
}

static void rows_backward(const struct pm_poisson_fft *p, const struct rows *io, const struct slab *s, double *scratch)
{
	size_t n = p->line[X].length, used = p->nodes[X], first = p->line[X].first;
	if (p->complex) {
		for (size_t r = 0; r < s->rows; r++) {
			double *from = row_at(p, s, r);
			if (n > 1)
				fftw_execute_dft_c2r(p->row_backward, (fftw_complex *)from, scratch);
			else
				scratch[0] = from[0];
			put_row(io, s->j + r * s->dj, s->k + r * s->dk, scratch);
		}
		return;
	}
	double *block = scratch, *row = scratch + n * L;
	if (s->rows < L)
		memset(block, 0, n * L * sizeof *block);
	for (size_t r = 0; r < s->rows; r++) {
		const double *from = row_at(p, s, r);
		for (size_t i = 0; i < used; i++)
			block[(first + i) * L + r] = from[i];
	}
	pm_line_real(&p->line[X], block);
	for (size_t r = 0; r < s->rows; r++) {
		for (size_t i = 0; i < used; i++)
			row[i] = block[(first + i) * L + r];
		put_row(io, s->j + r * s->dj, s->k + r * s->dk, row);
	}
}

static void plane_columns(const struct pm_poisson_fft *p, double *plane, bool forward, double *block)
{
	const struct pm_line *l = &p->line[Y];
	size_t in = forward ? p->nodes[Y] : p->modes[Y], out = forward ? p->modes[Y] : p->nodes[Y];
	for (size_t c = 0; c < p->chunks; c++) {
		gather(plane + c * L, p->row, in, block + l->first * L);
		if (forward)
			block_forward(p, Y, block);
		else
			block_backward(p, Y, block);
		scatter(block + l->first * L, out, p->row, plane + c * L);
	}
}

static void pass_planes(const struct pm_poisson_fft *p, const struct rows *io, bool forward)
{
	size_t n = slabs(p);
#pragma omp parallel for schedule(dynamic) num_threads(p->threads)
	for (size_t i = 0; i < n; i++) {
		double *scratch = thread_scratch(p, omp_get_thread_num());
		bool columns = thick(p);
		size_t rows = slab_rows(p, i);
		if (columns && !forward)
			plane_columns(p, p->w + i * p->plane, false, scratch);
		for (size_t r = 0; r < rows; r += L) {
			struct slab s = slab_part(p, i, r, L);
			if (forward)
				rows_forward(p, io, &s, scratch);
			else
				rows_backward(p, io, &s, scratch);
		}
		if (columns && forward)
			plane_columns(p, p->w + i * p->plane, true, scratch);
	}
}

static void times_symbol(const struct pm_poisson_fft *p, size_t j, size_t c, double factor, double *block)
{
	const double *lx = p->lambda[X] + c * L, *lz = p->lambda[Z];
	double ly = p->lambda[Y][j];
	for (size_t k = 0; k < p->modes[Z]; k++)
		for (int q = 0; q < L; q++)
			block[k * L + q] *= factor / (lx[q] + (ly + lz[k]));
}

static void times_green(const struct pm_poisson_fft *p, size_t j, size_t c, double factor, double *block)
{
	size_t ny = p->modes[Y], nz = p->modes[Z];
	const double *g = p->green + (j <= ny - j ? j : ny - j) * p->green_row + c * (L / 2);
	for (size_t k = 0; k < nz; k++) {
		const double *gk = g + (k <= nz - k ? k : nz - k) * p->green_plane;
		for (int q = 0; q < L; q++)
			block[k * L + q] *= factor * gk[q / 2];
	}
}

/* Forward along z; unless only the spectrum is wanted, times factor/lambda (or the Green's function) and back. */
static void pass_pencils(struct pm_poisson_fft *p, double factor, bool spectrum)
{
	size_t first = p->line[Z].first, n = p->modes[Y] * p->chunks;
#pragma omp parallel for schedule(static) num_threads(p->threads)
	for (size_t i = 0; i < n; i++) {
		size_t j = i / p->chunks, c = i % p->chunks;
		double *block = thread_scratch(p, omp_get_thread_num()), *at = p->w + j * p->row + c * L, *b = block + first * L;
		gather(at, p->plane, p->nodes[Z], b);
		block_forward(p, Z, block);
		if (i == 0)
			p->zero = b[0];
		if (!spectrum) {
			if (p->green)
				times_green(p, j, c, factor, b);
			else
				times_symbol(p, j, c, factor, b);
			if (i == 0 && p->singular)
				b[0] = 0, b[1] = p->complex ? 0 : b[1];
			block_backward(p, Z, block);
		}
		scatter(b, p->nodes[Z], p->plane, at);
	}
}

static int scratch_ready(struct pm_poisson_fft *p)
{
	int n = pm_threads();
	if (n <= p->threads)
		return p->threads = n, 0;
	p->scratch = pm_free(p->scratch);
	p->threads = 0;
	if (!(p->scratch = pm_alloc((size_t)n * p->lot, sizeof *p->scratch)))
		return -PM_DATA;
	p->threads = n;
	return 0;
}

/* The nodes on the wall faces that no row covers. */
static void zero_walls(const struct pm_grid *g, double *phi)
{
	size_t nx = g->points[0], ny = g->points[1], nz = g->points[2];
	if (g->dim > 1 && g->face[1][0] == PM_WALL)
		for (size_t k = 0; k < nz; k++) {
			memset(phi + k * ny * nx, 0, nx * sizeof *phi);
			memset(phi + (k * ny + ny - 1) * nx, 0, nx * sizeof *phi);
		}
	if (g->dim > 2 && g->face[2][0] == PM_WALL) {
		memset(phi, 0, nx * ny * sizeof *phi);
		memset(phi + (nz - 1) * ny * nx, 0, nx * ny * sizeof *phi);
	}
}

int pm_poisson_fft_solve(struct pm_poisson_fft *p, double c, const double *s, double *phi, double *mean)
{
	*mean = 0;
	if (p->empty) {
		memset(phi, 0, pm_grid_size(&p->grid) * sizeof *phi);
		return 0;
	}
	if (scratch_ready(p))
		return -PM_DATA;
	struct rows io = {.p = p, .s = s, .phi = phi, .get = get_source};
	double norm = 1;
	for (int a = X; a <= Z; a++)
		norm /= (double)p->line[a].length;
	pass_planes(p, &io, true);
	pass_pencils(p, c * norm * p->h2, false);
	pass_planes(p, &io, false);
	zero_walls(&p->grid, phi);
	if (p->singular)
		*mean = p->zero * norm;
	return 0;
}

/* Eigenvalues of the modes of an axis; copies of each for the doubles of a mode, padding -1 so that nothing divides by zero. */
static double *eigenvalues(const struct pm_line *l, size_t modes, size_t copies, size_t size, enum pm_symbol symbol, double h)
{
	double *lambda = pm_alloc(size, sizeof *lambda);
	for (size_t i = 0; lambda && i < size; i++) {
		size_t k = l->first + i / copies;
		if (l->face == PM_PERIODIC && k > l->n - k)
			k = l->n - k;
		double theta = pm_pi * (double)k / (double)l->n * (l->face == PM_PERIODIC ? 2 : 1);
		lambda[i] = i / copies < modes ? pm_symbol_value(symbol, theta, h) : -1;
	}
	return lambda;
}

/* Strides that are an odd multiple of a cache line pair, so that pencils do not fall on the same sets of the cache. */
static size_t odd_stride(size_t doubles)
{
	size_t lines = (doubles + L - 1) / L;
	return (lines | 1) * L;
}

static int layout(struct pm_poisson_fft *p)
{
	const struct pm_grid *g = &p->grid;
	const int axis[3] = {0, g->dim == 3 ? 1 : -1, g->dim == 3 ? 2 : g->dim == 2 ? 1 : -1};
	size_t most = 0;
	for (int a = X; a <= Z; a++) {
		bool used = axis[a] >= 0;
		if (pm_line_init(&p->planner, used ? g->face[axis[a]][0] : PM_PERIODIC, used ? g->cells[axis[a]] : 1, &p->line[a]))
			return -PM_DATA;
		p->nodes[a] = p->line[a].count;
		p->modes[a] = !p->complex ? p->nodes[a] : a == X ? p->line[a].length / 2 + 1 : p->line[a].length;
		p->empty = p->empty || p->nodes[a] == 0;
		most = p->line[a].length > most ? p->line[a].length : most;
		if (p->complex && a != X && p->line[a].length > 1 &&
		    !(p->backward[a] = pm_plan(&p->planner, PM_BLOCK_BACKWARD, p->line[a].length)))
			return -PM_DATA;
	}
	size_t doubles = p->modes[X] * (p->complex ? 2 : 1);
	p->chunks = (doubles + L - 1) / L;
	p->row = odd_stride(doubles);
	p->plane = odd_stride(p->modes[Y] * p->row);
	p->lot = odd_stride((most + 1) * L + p->line[X].length + 2);
	if (p->complex && p->line[X].length > 1) {
		p->row_forward = pm_plan(&p->planner, PM_ROW_FORWARD, p->line[X].length);
		p->row_backward = p->row_forward ? pm_plan(&p->planner, PM_ROW_BACKWARD, p->line[X].length) : NULL;
		if (!p->row_backward)
			return -PM_DATA;
	}
	return p->empty || (p->w = pm_alloc(p->nodes[Z] * p->plane, sizeof *p->w)) ? 0 : -PM_DATA;
}

static int symbols(struct pm_poisson_fft *p, enum pm_symbol symbol)
{
	const struct pm_grid *g = &p->grid;
	const double h[3] = {g->h[0], g->h[1], g->dim == 2 ? g->h[1] : g->h[2]};
	for (int a = X; a <= Z && !p->empty; a++) {
		size_t copies = a == X && p->complex ? 2 : 1;
		p->lambda[a] = eigenvalues(&p->line[a], p->modes[a], copies, a == X ? p->chunks * L : p->modes[a], symbol, h[a]);
		if (!p->lambda[a])
			return -PM_DATA;
	}
	return 0;
}

/* The transform of the even, doubled Green's function is the cosine transform of one octant: the spectrum of a neumann solver. */
static int green(struct pm_poisson_fft *p, enum pm_symbol symbol)
{
	struct pm_grid g = p->grid;
	for (int d = 0; d < g.dim; d++)
		g.face[d][0] = g.face[d][1] = PM_NEUMANN;
	struct pm_poisson_fft *q = pm_poisson_fft_new(&g, symbol, p->planner.effort);
	int code = q ? scratch_ready(q) : -PM_DATA;
	if (!code) {
		double centre = pm_green_centre(symbol, g.dim, g.h);
		struct rows io = {.p = q, .s = &centre, .get = get_green};
		pass_planes(q, &io, true);
		pass_pencils(q, 1, true);
		p->green = q->w;
		q->w = NULL;
		p->green_row = q->row;
		p->green_plane = q->plane;
		p->h2 = pm_grid_cell(&g);
	}
	pm_poisson_fft_free(q);
	return code;
}

struct pm_poisson_fft *pm_poisson_fft_new(const struct pm_grid *g, enum pm_symbol symbol, enum pm_effort effort)
{
	if (pm_poisson_fft_check(g, symbol))
		return NULL;
	struct pm_poisson_fft *p = calloc(1, sizeof *p);
	if (!p) {
		pm_fail(PM_DATA, "out of memory");
		return NULL;
	}
	p->grid = *g;
	p->planner.effort = effort;
	p->h2 = 1;
	p->singular = pm_poisson_fft_singular(g);
	p->complex = true;
	for (int d = 0; d < g->dim; d++)
		p->complex = p->complex && (g->face[d][0] == PM_PERIODIC || g->face[d][0] == PM_OPEN);
	bool open = g->face[0][0] == PM_OPEN;
	if (layout(p) || (open ? green(p, symbol) : symbols(p, symbol)))
		p = pm_poisson_fft_free(p);
	return p;
}

struct pm_poisson_fft *pm_poisson_fft_free(struct pm_poisson_fft *p)
{
	if (!p)
		return NULL;
	pm_planner_clear(&p->planner);
	pm_free(p->w);
	pm_free(p->green);
	pm_free(p->scratch);
	for (int a = X; a <= Z; a++)
		pm_free(p->lambda[a]);
	free(p);
	return NULL;
}

const struct pm_planner *pm_poisson_fft_planner(const struct pm_poisson_fft *p)
{
	return &p->planner;
}
