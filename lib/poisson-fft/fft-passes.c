/* The passes of the transform solver over its work array: planes forward (rows, then columns while the plane is in cache), pencils forward, times the
 * symbol, and back, planes back. A block of L lines at a time is transformed in cache (fft/fft-block.h); the modes of complex axes stay in the
 * order in which the transform leaves them. The partition does not depend on threads.
 * Memory is read fast in long pieces and written past the caches fast anywhere. So large complex meshes in space are turned as they are written: from
 * planes to pencils in w, where they are periodic from pencils to planes in phi, which becomes the solution plane by plane; and what is read next is
 * fetched during the transform before.
 * SPDX-License-Identifier: GPL-3.0-or-later */
#include <omp.h>
#include <string.h>

#include "fft/fft-vector.h"
#include "poisson-fft/fft-passes.h"
#include "world/world.h"

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

/* Stores to memory, which bypass the caches if the mesh is larger than they are. */
static void copy_out(const struct pm_poisson_fft *p, double *to, const double *from, size_t n)
{
	if (p->streams)
		pm_stream(to, from, n);
	else
		memcpy(to, from, n * sizeof *to);
}

/* n rows of L doubles are wanted in the caches soon, to be read and written. */
static inline void soon(const double *at, size_t step, size_t n)
{
	for (size_t i = 0; i < n; i++, at += step)
		__builtin_prefetch(at, 1), __builtin_prefetch(at + L / 2, 1);
}

/* Scratch of a thread. Memory is read and written in long pieces; the rest happens in cache. */
struct scratch {
	double *block, *rows, *factors, *modes;
};

static struct scratch thread_scratch(const struct pm_poisson_fft *p)
{
	double *s = p->scratch + (size_t)omp_get_thread_num() * p->lot;
	return (struct scratch){s, s + p->block, s + p->block + p->rows, s + p->block + p->rows + p->factors};
}

/* A slab is what one thread transforms at a time: a plane, in 2-D L rows. */
static bool thick(const struct pm_poisson_fft *p)
{
	return p->grid.dim == 3;
}

/* In 2-D groups of rows begin at multiples of L of the mesh, whose row 0 is not transformed behind a wall: the rows that a transform of any word joins are
 * the same. */
static size_t slabs_of(const struct pm_poisson_fft *p)
{
	return thick(p) ? p->zhere : (p->planes + L - 1) / L;
}

/* Up to L rows of a slab: row r is row j+r*dj of plane k+r*dk. Slabs count from the first one of this rank, j and k in the whole mesh. */
struct group {
	size_t j, k, rows, dj, dk;
};

static struct group group_of(const struct pm_poisson_fft *p, size_t slab, size_t start)
{
	if (thick(p)) {
		const size_t left = p->nodes[Y] - start;
		return (struct group){.j = start, .k = p->zfirst + slab, .dj = 1, .rows = left < L ? left : L};
	}
	slab += p->first / L;
	const size_t first = p->line[Z].first, from = slab ? slab * L - first : 0, end = (slab + 1) * L - first;
	return (struct group){.k = from, .dk = 1, .rows = (end < p->nodes[Z] ? end : p->nodes[Z]) - from};
}

static double end_weight(const struct pm_transform *l, size_t i)
{
	return (l->face[0] == PM_OPEN && i == 0) || (l->face[1] == PM_OPEN && i == l->n) ? 0.5 : 1;
}

/* At open faces the end nodes have half weight, as in every sum over a mesh. */
static void weigh(const struct pm_poisson_fft *p, const struct group *g, double *block)
{
	const struct pm_transform *l = &p->line[X];
	double weight[L], least = 1;
	for (size_t r = 0; r < L; r++) {
		size_t j = p->line[Y].first + g->j + r * g->dj, k = p->line[Z].first + g->k + r * g->dk;
		weight[r] = end_weight(&p->line[Y], j) * end_weight(&p->line[Z], k);
		least = weight[r] < least ? weight[r] : least;
	}
	for (size_t i = 0; i < l->count; i++)
		for (int q = 0; q < L && (least < 1 || i == 0 || i == l->count - 1); q++)
			block[(l->row + i) * L + (size_t)q] *= weight[q] * end_weight(l, l->first + i);
}

/* The largest absolute value of n rows of a block, of the first lines alone. finite: INFINITY where one is not; else what is NaN is passed over. */
PM_SIMD_INLINE double most_of(const double *block, size_t n, size_t lines, bool finite)
{
	enum { PARTS = L / PM_SIMD_PART };
	pm_simd_part most[PARTS] = {{0}}, none[PARTS] = {{0}};
	double all = 0;
	for (size_t i = 0; i < n; i++) /* side by side: each comparison waits for the one before it */
		PM_SIMD_UNROLL
		for (size_t part = 0; part < PARTS; part++) {
			const pm_simd_part v = *(const pm_simd_part_at *)(block + i * L + part * PM_SIMD_PART);
			most[part] = larger(most[part], v);
			if (finite)
				none[part] += v - v;
		}
	for (size_t q = 0; q < lines; q++)
		all = none[q / PM_SIMD_PART][q % PM_SIMD_PART] == 0 ? fmax(all, most[q / PM_SIMD_PART][q % PM_SIMD_PART]) : INFINITY;
	return all;
}

double pm_poisson_fft_largest(const double *block, size_t n) { return most_of(block, n, L, false); }

/* Of lines with zeros behind them, the nodes. */
static size_t some_of(const struct pm_poisson_fft *p, int axis) { return p->line[axis].face[0] == PM_PERIODIC ? 0 : p->nodes[axis]; }

/* Nodes to modes; to: L rows of modes. Returns the largest source of a singular problem. */
static double rows_forward(const struct pm_poisson_fft *p, const struct rows *io, const struct group *g, struct scratch s, double *to)
{
	const struct pm_transform *l = &p->line[X];
	const double *in[L];
	double *out[L];
	for (size_t r = 0; r < g->rows; r++) {
		double *row = s.rows + r * p->nodes[X];
		const double *from = io->from(io, g->j + r * g->dj, g->k + r * g->dk, row);
		if (from != row && p->streams)
			memcpy(row, from, p->nodes[X] * sizeof *row), from = row;
		in[r] = from, out[r] = to + r * p->row;
	}
	pm_fft_rows_in(in, g->rows, p->nodes[X], NULL, s.block + l->row * L);
	double largest = p->singular ? pm_poisson_fft_largest(s.block, p->nodes[X]) : 0; /* no walls: nodes begin in row 0 */
	if (p->open)
		weigh(p, g, s.block);
	if (p->complex) {
		if (p->turned) /* the rows of a plane, and planes, are one piece */
			pm_fft_forward_moving(l->fft, (struct pm_fft_place){s.block, L, some_of(p, X), in[0] + g->rows * p->nodes[X]}, s.block,
				(struct pm_fft_place){s.block, L, 0, NULL});
		else
			pm_transform_forward(l, false, s.block);
		pm_spectra_out(l->fft, s.block, g->rows, p->shared, out);
		return largest;
	}
	pm_transform_real(l, s.block);
	pm_fft_rows_out(s.block, l->map, p->modes[X], g->rows, out);
	for (size_t r = 0; r < g->rows; r++)
		memset(out[r] + p->modes[X], 0, (p->chunks * L - p->modes[X]) * sizeof *to);
	return largest;
}

/* Modes to nodes. Returns the largest absolute value; INFINITY where one is not finite. */
static double rows_backward(const struct pm_poisson_fft *p, const struct rows *io, const struct group *g, struct scratch s, const double *from)
{
	const struct pm_transform *l = &p->line[X];
	const double *in[L];
	double *out[L];
	for (size_t r = 0; r < g->rows; r++)
		in[r] = from + r * p->row, out[r] = p->streams ? s.rows + r * p->nodes[X] : io->to(io, g->j + r * g->dj, g->k + r * g->dk);
	if (p->complex) {
		pm_spectra_in(l->fft, g->rows, in, p->shared, s.block);
		pm_transform_backward(l, s.block);
	} else {
		pm_fft_rows_in(in, g->rows, p->modes[X], l->map, s.block);
		pm_transform_real_back(l, s.block);
	}
	pm_fft_rows_out(s.block + l->row * L, NULL, p->nodes[X], g->rows, out);
	for (size_t r = 0; r < g->rows && p->streams; r++)
		pm_stream(io->to(io, g->j + r * g->dj, g->k + r * g->dk), out[r], p->nodes[X]);
	return most_of(s.block + l->row * L, p->nodes[X], g->rows, true);
}

/* n rows of a block, as at[] has them, from and to memory. */
static void gather_real(const double *from, size_t stride, const size_t *at, size_t n, double *block)
{
	for (size_t i = 0; i < n; i++)
		memcpy(block + at[i] * L, from + i * stride, L * sizeof *block);
}

static void scatter_real(const double *block, const size_t *at, size_t n, size_t stride, double *to)
{
	for (size_t i = 0; i < n; i++)
		memcpy(to + i * stride, block + at[i] * L, L * sizeof *to);
}

/* A plane, from row to row. */
struct plane {
	double *at;
	size_t step;
};

/* Rows of the first and the last place of a pair of frequencies y hold F_0 + i F_{N/2} of x, F of real lines: to F_0 in row k and F_{N/2} in row N-k. */
static void part_shared(const struct pm_poisson_fft *p, bool back, struct plane w)
{
	const struct pm_transform *l = &p->line[Y];
	for (size_t k = 1; k < pm_transform_partner(l, k); k++) {
		double *a = w.at + l->fft->at[k] * w.step, *b = w.at + l->fft->at[l->length - k] * w.step, ar = a[0], ai = a[H], br = b[0], bi = b[H];
		if (back) /* F_0 + i F_{N/2}, conj F_0 + i conj F_{N/2} */
			a[0] = ar - bi, a[H] = ai + br, b[0] = ar + bi, b[H] = br - ai;
		else
			a[0] = 0.5 * (ar + br), a[H] = 0.5 * (ai - bi), b[0] = 0.5 * (ai + bi), b[H] = 0.5 * (br - ar);
	}
}

/* Columns of a plane of complex modes, which stay as they come, L lanes at a time: from the plane of the rows to w, or back. */
static void complex_columns(const struct pm_poisson_fft *p, struct plane x, struct plane w, bool forward, double *block)
{
	const struct pm_transform *l = &p->line[Y];
	const size_t some = some_of(p, Y);
	if (!forward && p->shared)
		part_shared(p, true, w);
	for (size_t c = 0; c < p->chunks; c++) {
		const struct pm_fft_place rows = {x.at + c * L, x.step, some, NULL}, modes = {w.at + c * L, w.step, 0, NULL};
		if (modes.step != rows.step && c + 1 < p->chunks)
			soon(modes.at + L, w.step, p->modes[Y]);
		if (forward)
			pm_fft_forward_moving(l->fft, rows, block, modes);
		else
			pm_fft_backward_moving(l->fft, modes, block, rows);
	}
	if (forward && p->shared)
		part_shared(p, false, w);
}

/* Columns of a plane of real modes, which are put in order. */
static void real_columns(const struct pm_poisson_fft *p, double *plane, bool forward, double *block)
{
	const struct pm_transform *l = &p->line[Y];
	for (size_t c = 0; c < p->chunks; c++, plane += L)
		if (forward) {
			gather(plane, p->row, p->nodes[Y], block + l->row * L);
			pm_transform_real(l, block);
			scatter_real(block, l->map, p->modes[Y], p->row, plane);
		} else {
			gather_real(plane, p->row, l->map, p->modes[Y], block);
			pm_transform_real_back(l, block);
			scatter(block + l->row * L, p->nodes[Y], p->row, plane);
		}
}

/* Blocks of L numbers, by row y of a plane of modes, chunk and plane z. */
struct blocks {
	double *at;
	size_t y, c, z;
};

/* In w, where the pencils of a row y follow each other; and where they go to, where the columns of a plane do. */
static struct blocks by_pencils(const struct pm_poisson_fft *p) { return (struct blocks){p->w, p->slab, p->nodes[Z] * L, L}; }

static struct blocks by_planes(const struct pm_poisson_fft *p)
{
	return p->back ? (struct blocks){p->back, L, p->nodes[Y] * L, p->nodes[Y] * p->nodes[X]} : by_pencils(p);
}

/* n rows of a block past the caches. */
static void blocks_out(const double *block, size_t n, size_t step, double *to)
{
	for (size_t i = 0; i < n; i++, block += L, to += step)
		PM_SIMD_UNROLL
		for (int q = 0; q < L; q += PM_SIMD_PART)
			pm_simd_part_past(to + q, *(const pm_simd_part_at *)(block + q));
}

/* Columns of plane k of a mesh beyond the caches, from the plane of the rows to w; and back from where the pencils went. */
static void turned_forward(const struct pm_poisson_fft *p, size_t k, struct scratch s)
{
	const struct pm_fft *f = p->line[Y].fft;
	const struct pm_fft_place own = {s.block, L, 0, NULL};
	const struct blocks to = by_pencils(p);
	for (size_t c = 0; c < p->chunks; c++) {
		pm_fft_forward_moving(f, (struct pm_fft_place){s.modes + c * L, p->row, some_of(p, Y), NULL}, s.block, own);
		if (c == 0)
			part_shared(p, false, (struct plane){s.block, L});
		blocks_out(s.block, p->modes[Y], to.y, to.at + c * to.c + k * to.z);
	}
}

static void turned_backward(const struct pm_poisson_fft *p, size_t k, struct scratch s)
{
	const struct pm_fft *f = p->line[Y].fft;
	const struct blocks from = by_planes(p);
	double *at = from.at + k * from.z;
	part_shared(p, true, (struct plane){at, from.y});
	for (size_t c = 0; c < p->chunks; c++, at += from.c)
		pm_fft_backward_moving(f, (struct pm_fft_place){at, from.y, 0, c + 1 < p->chunks ? at + from.c : NULL}, s.block,
			(struct pm_fft_place){s.modes + c * L, p->row, some_of(p, Y), NULL});
}

/* Complex modes of a mesh in the caches go to w as they come; else, and real ones, in long pieces. */
static double plane_forward(const struct pm_poisson_fft *p, const struct rows *io, size_t k, struct scratch s)
{
	const struct plane here = {s.modes, p->row}, w = {p->w + k * p->row, p->slab};
	const bool direct = p->complex && !p->streams;
	double largest = 0;
	for (size_t j = 0; j < p->nodes[Y]; j += L) {
		struct group g = group_of(p, k, j);
		largest = fmax(largest, rows_forward(p, io, &g, s, s.modes + j * p->row));
	}
	if (p->turned)
		turned_forward(p, k, s);
	else if (p->complex)
		complex_columns(p, here, direct ? w : here, true, s.block);
	else
		real_columns(p, s.modes, true, s.block);
	for (size_t j = 0; j < p->modes[Y] && !direct; j++)
		copy_out(p, w.at + j * w.step, s.modes + j * p->row, p->chunks * L);
	return largest;
}

static double plane_backward(const struct pm_poisson_fft *p, const struct rows *io, size_t k, struct scratch s)
{
	const struct plane here = {s.modes, p->row}, w = {p->w + k * p->row, p->slab};
	const bool direct = p->complex && !p->streams;
	for (size_t j = 0; j < p->modes[Y] && !direct; j++)
		memcpy(s.modes + j * p->row, w.at + j * w.step, p->chunks * L * sizeof *p->w);
	if (p->turned)
		turned_backward(p, k, s);
	else if (p->complex)
		complex_columns(p, here, direct ? w : here, false, s.block);
	else
		real_columns(p, s.modes, false, s.block);
	double largest = 0;
	for (size_t j = 0; j < p->nodes[Y]; j += L) {
		struct group g = group_of(p, k, j);
		largest = fmax(largest, rows_backward(p, io, &g, s, s.modes + j * p->row));
	}
	return largest;
}

double pm_poisson_fft_planes(const struct pm_poisson_fft *p, const struct rows *io, bool forward)
{
	double largest = 0;
	bool plane = thick(p);
	const size_t slabs = slabs_of(p);
#pragma omp parallel for schedule(dynamic) num_threads(p->threads) reduction(max : largest)
	for (size_t i = 0; i < slabs; i++) {
		struct scratch s = thread_scratch(p);
		struct group g = group_of(p, i, 0);
		if (!g.rows) /* only a wall */
			continue;
		if (plane && forward)
			largest = fmax(largest, plane_forward(p, io, i, s));
		else if (plane)
			largest = fmax(largest, plane_backward(p, io, i, s));
		else if (forward)
			largest = fmax(largest, rows_forward(p, io, &g, s, p->w + (g.k - p->zfirst) * p->row));
		else
			largest = fmax(largest, rows_backward(p, io, &g, s, p->w + (g.k - p->zfirst) * p->row));
		pm_stream_end();
	}
	return largest;
}

/* What multiplies frequency k of a pencil in row j of a plane: factor over the sum of eigenvalues, or times Green's function. lanes: complex modes
 * of a chunk have H frequencies along x, real ones L. */
static inline void multiplier(const struct pm_poisson_fft *p, size_t j, size_t k, size_t c, size_t lanes, double factor, double *u)
{
	if (p->green) {
		const double *green = p->green + p->fold[j] * p->green_slab + (k + p->green_least) * p->green_row + c * lanes;
		for (size_t q = 0; q < lanes; q++)
			u[q] = factor * green[q];
		return;
	}
	const double *lx = p->lambda[X] + c * lanes, rest = p->lambda[Y][j] + p->lambda[Z][k];
	for (size_t q = 0; q < lanes; q++)
		u[q] = factor / (lx[q] + rest);
	if (p->singular && j == 0 && k == 0 && c == 0)
		u[0] = 0;
}

void pm_poisson_fft_multipliers_of_row(const struct pm_poisson_fft *p, double *u)
{
	const size_t lanes = p->complex ? H : L;
	for (size_t c = 0; c < pm_poisson_fft_multipliers(p) / lanes; c++)
		multiplier(p, 0, 0, c, lanes, 1, u + c * lanes);
}

/* Frequencies k and k' of lines whose multipliers differ between a and b: with u on a and v on b F'_k = (u+v)/2 F_k + (u-v)/2 conj F_k'. */
static void pair_times(const double *u, double *a, double *b)
{
	for (int q = 0; q < H; q++) {
		double s = 0.5 * (u[q] + u[q + H]), d = 0.5 * (u[q] - u[q + H]);
		double ar = a[q], ai = a[q + H], br = b[q], bi = b[q + H];
		a[q] = s * ar + d * br, a[q + H] = s * ai - d * bi;
		b[q] = s * br + d * ar, b[q + H] = s * bi - d * ai;
	}
}

/* The multiplier of frequency N/2 along x. */
static double nyquist(const struct pm_poisson_fft *p, size_t j, size_t k, double factor)
{
	const size_t i = p->modes[X] - 1;
	if (p->green)
		return factor * p->green[p->fold[j] * p->green_slab + (k + p->green_least) * p->green_row + i];
	return factor / (p->lambda[X][i] + (p->lambda[Y][j] + p->lambda[Z][k]));
}

/* factor over the sums of eigenvalues of a chunk, or times Green's function, for two rows. */
static inline void two_rows(const double *lx, double rest, double factor, double *a, double *b)
{
	for (int q = 0; q < H; q += PM_SIMD_PART) {
		const pm_simd_part u = factor / (*(const pm_simd_part_at *)(lx + q) + rest);
		*(pm_simd_part_at *)(a + q) = *(pm_simd_part_at *)(b + q) = u;
	}
}

static inline void two_rows_green(const double *green, double factor, double *a, double *b)
{
	for (int q = 0; q < H; q += PM_SIMD_PART)
		*(pm_simd_part_at *)(a + q) = *(pm_simd_part_at *)(b + q) = factor * *(const pm_simd_part_at *)(green + q);
}

/* The multipliers of a chunk of pencils by rows of the block. */
static void factors_of(const struct pm_poisson_fft *p, size_t j, size_t c, double factor, double *u)
{
	const struct pm_transform *l = &p->line[Z];
	const double *lx = p->green ? NULL : p->lambda[X] + c * H;
	const double *green = p->green ? p->green + p->fold[j] * p->green_slab + p->green_least * p->green_row + c * H : NULL;
	for (size_t k = 0; k <= l->length - k; k++) {
		double *a = u + l->fft->at[k] * H, *b = u + l->fft->at[l->length - k] * H;
		if (p->green) {
			two_rows_green(green + k * p->green_row, factor, a, b);
		} else {
			two_rows(lx, p->lambda[Y][j] + p->lambda[Z][k], factor, a, b);
		}
		if (c == 0 && p->holds[j] == SHARED_NYQUIST)
			a[0] = b[0] = nyquist(p, j, k, factor);
	}
	if (p->singular && !p->green && j == 0 && c == 0)
		u[0] = 0;
}

/* F_0 + i F_{N/2} of x in the first lane: F of real lines, so that frequencies k and k' belong together. */
static void times_shared(const struct pm_poisson_fft *p, size_t j, double factor, const double *u, double *block)
{
	const struct pm_transform *l = &p->line[Z];
	for (size_t k = 0; k <= l->length - k; k++) {
		const size_t at = l->fft->at[k], partner = l->fft->at[pm_transform_partner(l, k)];
		const double v = nyquist(p, j, k, factor), s = 0.5 * (u[at * H] + v), d = 0.5 * (u[at * H] - v);
		double *a = block + at * L, *b = block + partner * L, ar = a[0], ai = a[H], br = b[0], bi = b[H];
		if (a == b) { /* both are real */
			a[0] = u[at * H] * ar, a[H] = v * ai;
			continue;
		}
		a[0] = s * ar + d * br, a[H] = s * ai - d * bi;
		b[0] = s * br + d * ar, b[H] = s * bi - d * ai;
	}
}

/* The lanes from `least` on. */
static void times(const double *u, size_t n, size_t least, double *a)
{
	for (size_t i = 0; i < n; i++, u += H, a += L)
		for (size_t q = least; q < H; q++)
			a[q] *= u[q], a[q + H] *= u[q];
}

/* The mode of constants, and modes that share a place, are looked at between forward and back; all others only multiplied. */
static void complex_pencils(struct pm_poisson_fft *p, size_t j, size_t c, double factor, struct scratch s, struct pm_fft_place here, struct pm_fft_place there)
{
	const struct pm_transform *l = &p->line[Z];
	const bool shared = p->shared && c == 0 && p->holds[j] == SHARED_BOTH;
	const struct pm_fft_place own = {s.block, L, 0, NULL};
	factors_of(p, j, c, factor, s.factors);
	if (shared || (j == 0 && c == 0)) {
		pm_fft_forward_moving(l->fft, here, s.block, own);
		if (j == 0 && c == 0)
			p->zero = s.block[0];
		if (shared)
			times_shared(p, j, factor, s.factors, s.block);
		times(s.factors, l->length, shared, s.block);
		pm_fft_backward_moving(l->fft, own, s.block, there);
	} else {
		pm_fft_times_moving(l->fft, here, s.factors, s.block, there);
	}
}

static void real_pencils(const struct pm_poisson_fft *p, size_t j, size_t c, double factor, double *block)
{
	const struct pm_transform *l = &p->line[Z];
	for (size_t m = 0; m < l->modes && l->least + m <= pm_transform_partner(l, l->least + m); m++) {
		double u[L], *a = block + l->fft->at[l->least + m] * L, *b = block + l->fft->at[pm_transform_partner(l, l->least + m)] * L;
		multiplier(p, j, m, c, L, factor, u);
		if (a == b) /* F_0 and F_{N/2}: a and b are its real and imaginary parts */
			for (int q = 0; q < L; q++)
				a[q] *= u[q];
		else
			pair_times(u, a, b);
	}
	if (l->least) /* walls at both ends: no such modes */
		memset(block, 0, L * sizeof *block), memset(block + l->fft->at[l->length / 2] * L, 0, L * sizeof *block);
}

static void folded_pencils(const struct pm_poisson_fft *p, size_t j, size_t c, double factor, double *block)
{
	const struct pm_transform *l = &p->line[Z];
	for (size_t m = 0; m < l->modes; m++) {
		double u[L], *a = block + l->map[m] * L;
		multiplier(p, j, m, c, L, factor, u);
		for (int q = 0; q < L; q++)
			a[q] *= u[q];
	}
}

/* From rows at `at` to those at `to`. */
static void pencils(struct pm_poisson_fft *p, size_t j, size_t c, double factor, struct scratch s, double *at, double *to, size_t stride)
{
	const struct pm_transform *l = &p->line[Z];
	if (p->complex) {
		const size_t some = some_of(p, Z);
		complex_pencils(p, j, c, factor, s, (struct pm_fft_place){at, stride, some, NULL}, (struct pm_fft_place){to, stride, some, NULL});
		return;
	}
	gather(at, stride, p->nodes[Z], s.block + l->row * L);
	if (l->fold)
		pm_transform_real(l, s.block);
	else
		pm_transform_forward(l, false, s.block);
	if (j == 0 && c == 0)
		p->zero = s.block[0];
	(l->fold ? folded_pencils : real_pencils)(p, j, c, factor, s.block);
	(l->fold ? pm_transform_real_back : pm_transform_backward)(l, s.block);
	scatter(s.block + l->row * L, p->nodes[Z], stride, to);
}

/* A unit of pencils: a slab of a row of modes y, in 2-D one chunk. */
static void unit(struct pm_poisson_fft *p, size_t u, double factor, struct scratch s, double *slab, double *to)
{
	if (!thick(p))
		pencils(p, 0, u, factor, s, slab, to, p->from ? L : p->row);
	for (size_t c = 0; c < p->chunks && thick(p); c++) {
		if (!p->streams && c + 1 < p->chunks)
			soon(slab + (c + 1) * L, p->row, p->nodes[Z]);
		pencils(p, u, c, factor, s, slab + c * L, to + c * L, p->row);
	}
}

/* Those of a mesh beyond the caches. */
static void turned_unit(struct pm_poisson_fft *p, size_t j, double factor, struct scratch s)
{
	const struct blocks from = by_pencils(p), to = by_planes(p);
	const size_t some = some_of(p, Z);
	for (size_t c = 0; c < p->chunks; c++) {
		double *at = from.at + j * from.y + c * from.c, *next = c + 1 < p->chunks ? at + from.c : NULL;
		if (!next && j + 1 < p->modes[Y])
			next = from.at + (j + 1) * from.y;
		complex_pencils(p, j, c, factor, s, (struct pm_fft_place){at, L, some, next}, (struct pm_fft_place){p->back ? s.block : at, L, some, NULL});
		if (p->back)
			blocks_out(s.block, p->nodes[Z], to.z, to.at + j * to.y + c * to.c);
	}
	pm_stream_end();
}

void pm_poisson_fft_pencils(struct pm_poisson_fft *p, double factor, double *own)
{
	const bool plane = thick(p);
	const size_t me = own ? (size_t)pm_world_rank() : 0, first = own ? p->units_of[me] : 0, size = p->nodes[Z] * p->row;
	const size_t units = own ? p->units_of[me + 1] - first : plane ? p->modes[Y] : p->chunks;
	const bool copies = plane && p->streams; /* long pieces of memory */
#pragma omp parallel for schedule(static) num_threads(p->threads)
	for (size_t i = 0; i < units; i++) {
		struct scratch s = thread_scratch(p);
		if (p->turned) {
			turned_unit(p, i, factor, s);
			continue;
		}
		if (own)
			pm_poisson_fft_unit(p, i, own, s.modes, false);
		else if (copies)
			memcpy(s.modes, p->w + i * p->slab, size * sizeof *p->w);
		double *w = own ? s.modes : p->w + i * (plane ? p->slab : L);
		unit(p, first + i, factor, s, own || copies ? s.modes : w, w);
		if (own)
			pm_poisson_fft_unit(p, i, own, s.modes, true);
	}
}
