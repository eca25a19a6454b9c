/* The potential of charges on the surface of a box at the nodes of its surface: a convolution with the lattice Green's function.
 *   phi(x) = sum over the nodes y of the surface of G(|x - y|) q(y)
 * Two faces always share an axis (two opposite ones two): along it the sum is a convolution, done mode by mode of a cosine and sine sum over twice the length,
 * where G, being even, has a real transform; across it the sum is done as it stands. A node on an edge belongs to the face of the lowest axis. An axis above
 * dim has one node and one mode, which makes the same code serve 2-D, where it is the plain double sum, and 1-D.
 * Ranks have every one some modes of every axis, with the transforms of G that these need, and some rows of the result; in 2-D some lines, and all of G.
 * Cost: 100 N^3 operations in 3-D, 32 N^2 in 2-D; memory: three tables of N^3, shared among the ranks. What ranks send: the charge, 12 N^2 numbers for each of
 * three axes, and the result, each to all; once, for the tables, 3 N^3 of them. SPDX-License-Identifier: GPL-3.0-or-later */
#include "poisson-mg/mg-open-parts.h"

#include "fft/fft-block.h"
#include "world/world.h"

#include <string.h>

enum { faces_most = 6 };

struct mg_faces {
	struct pm_grid grid;
	bool divided;
	size_t n[3];     /* cells, 0 above dim */
	double *hat[3];  /* per axis c: transform of G along c, [mode of this rank][offset along the lower other axis][along the higher] */
	double *wave[3]; /* cos(pi m/n_c), m < 2 n_c, then the sines */
};

/* A face seen along axis c: nodes m = 0 .. n_c of its lines. */
struct face {
	int axis, side, across; /* normal; the axis from line to line */
	size_t lines;
	size_t line, node;      /* steps from line to line and from node to node among the points of the face (poisson/boundary.h) */
};

static size_t length(const struct mg_faces *s, int c) { return s->n[c] ? 2 * s->n[c] : 1; }
static int shared(int a, int b) { return a != b ? 3 - a - b : a == 2 ? 1 : 2; } /* the axis along which two faces are convolved */
static int lower(int c) { return c == 0; }
static int higher(int c) { return c == 2 ? 1 : 2; }

/* The first of n things that rank r has. */
static size_t share_of(const struct mg_faces *s, size_t n, int r)
{
	return s->divided ? n * (size_t)r / (size_t)pm_world_size() : r > pm_world_rank() ? n : 0;
}

static void mine(const struct mg_faces *s, size_t n, size_t *from, size_t *to)
{
	*from = share_of(s, n, pm_world_rank());
	*to = share_of(s, n, pm_world_rank() + 1);
}

/* The modes of this rank along an axis; one above dim has one, which is everywhere. */
static void modes(const struct mg_faces *s, int c, size_t *from, size_t *to)
{
	mine(s, s->n[c] + 1, from, to);
	if (s->n[c] == 0)
		*from = 0, *to = 1;
}

/* The transforms along c of sixteen lines at a time, from line l on: pairs of even real lines as the two parts of complex ones come out as such.
 * out: [mode][line of first .. end - 1]. */
static void transform_lines(const struct mg_faces *s, int c, const struct mg_lattice *g, const struct pm_fft *fft, size_t l, const size_t part[2],
	double *block, double *out)
{
	const size_t n = s->n[c], wide = s->n[higher(c)] + 1, end = part[1], lines = end - part[0];
	for (size_t q = 0; q < PM_FFT_LINES; q++) {
		const size_t at = l + q < end ? l + q : end - 1;
		size_t x[3];
		x[lower(c)] = at / wide, x[higher(c)] = at % wide;
		for (size_t m = 0; m <= n; m++) {
			x[c] = m;
			block[m * PM_FFT_LINES + q] = pm_mg_lattice_value(g, x);
		}
		for (size_t m = n + 1; m < 2 * n; m++)
			block[m * PM_FFT_LINES + q] = block[(2 * n - m) * PM_FFT_LINES + q];
	}
	pm_fft_forward(fft, block);
	for (size_t k = 0; k <= n; k++)
		for (size_t q = 0; q < PM_FFT_LINES && l + q < end; q++)
			out[k * lines + l + q - part[0]] = block[fft->at[k] * PM_FFT_LINES + q];
}

/* The lines of this rank, all modes. */
static int transform_part(const struct mg_faces *s, int c, const struct mg_lattice *g, const size_t part[2], double *out)
{
	struct pm_fft_plans planner = {0};
	const struct pm_fft *fft = pm_fft(&planner, length(s, c));
	const size_t lines = part[1] - part[0];
	int failed = !fft;
	#pragma omp parallel for num_threads(pm_threads()) schedule(static) if (lines * (s->n[c] + 1) > mg_parallel)
	for (size_t b = 0; b < (lines + PM_FFT_LINES - 1) / PM_FFT_LINES; b++) {
		double *block = fft ? pm_alloc(length(s, c) * PM_FFT_LINES, sizeof *block) : NULL;
		if (block)
			transform_lines(s, c, g, fft, part[0] + b * PM_FFT_LINES, part, block, out);
		else
			#pragma omp atomic write
			failed = 1;
		pm_free(block);
	}
	pm_fft_plans_clear(&planner);
	return failed ? pm_failed() : 0;
}

/* The first line of rank r: they are transformed sixteen together. */
static size_t first_line(const struct mg_faces *s, size_t lines, int r)
{
	const size_t at = share_of(s, (lines + PM_FFT_LINES - 1) / PM_FFT_LINES, r) * PM_FFT_LINES;
	return at < lines ? at : lines;
}

/* The modes of this rank from all ranks, of all lines; `own` has all modes of the lines of this rank, which is all there is without others. */
static int turn(int status, struct mg_faces *s, int c, double **own, size_t lines)
{
	const int ranks = pm_world_size(), me = pm_world_rank();
	const size_t all = s->n[c] + 1, here = first_line(s, lines, me + 1) - first_line(s, lines, me);
	if (!s->divided)
		return s->hat[c] = *own, *own = NULL, status;
	size_t from, to, *bytes = pm_zalloc(2 * (size_t)ranks, sizeof *bytes);
	void *in = NULL;
	mine(s, all, &from, &to);
	s->hat[c] = pm_alloc((to - from) * lines + 1, sizeof(double));
	status = status ? status : bytes && s->hat[c] ? 0 : pm_failed();
	for (int r = 0; r < ranks && bytes; r++)
		bytes[r] = (share_of(s, all, r + 1) - share_of(s, all, r)) * here * sizeof(double);
	status = pm_world_exchange(status, *own, bytes, &in, bytes ? bytes + ranks : NULL);
	const double *piece = in;
	for (int r = 0; r < ranks && !status; r++) {
		const size_t first = first_line(s, lines, r), n = first_line(s, lines, r + 1) - first;
		for (size_t k = 0; k < to - from; k++, piece += n)
			memcpy(s->hat[c] + k * lines + first, piece, n * sizeof *piece);
	}
	pm_free(in), pm_free(bytes);
	return status;
}

static int transform_table(int status, struct mg_faces *s, int c, const struct mg_lattice *g)
{
	const size_t wide = s->n[higher(c)] + 1, lines = (s->n[lower(c)] + 1) * wide, all = length(s, c);
	const size_t part[2] = {first_line(s, lines, pm_world_rank()), first_line(s, lines, pm_world_rank() + 1)};
	const bool one = s->n[c] == 0; /* z in 2-D and 1-D: all lines, of one node, on every rank */
	double *own = status ? NULL : pm_alloc((s->n[c] + 1) * (one ? lines : part[1] - part[0]) + 1, sizeof *own);
	s->wave[c] = status ? NULL : pm_alloc(2 * all, sizeof(double));
	status = status ? status : own && s->wave[c] ? 0 : pm_failed();
	for (size_t m = 0; m < all && !status; m++) {
		s->wave[c][m] = cos(2 * pm_pi * (double)m / (double)all);
		s->wave[c][all + m] = sin(2 * pm_pi * (double)m / (double)all);
	}
	for (size_t l = 0; l < lines && one && !status; l++) {
		size_t x[3] = {0};
		x[lower(c)] = l / wide, x[higher(c)] = l % wide;
		own[l] = pm_mg_lattice_value(g, x);
	}
	if (!one && !status)
		status = transform_part(s, c, g, part, own);
	if (one)
		s->hat[c] = own, own = NULL;
	else
		status = turn(status, s, c, &own, lines);
	pm_free(own);
	return status;
}

struct mg_faces *pm_mg_faces_free(struct mg_faces *s)
{
	for (int c = 0; s && c < 3; c++)
		pm_free(s->hat[c]), pm_free(s->wave[c]);
	return pm_free(s);
}

struct mg_faces *pm_mg_faces_new(const struct pm_grid *g, int order, const struct pm_planes *planes)
{
	struct mg_faces *s = pm_zalloc(1, sizeof *s);
	struct mg_lattice *lattice = pm_mg_lattice_new(g, order);
	int status = pm_planes_agree(s && lattice ? 0 : pm_failed(), planes);
	for (int d = 0; d < g->dim && !status; d++)
		s->n[d] = g->cells[d];
	if (!status)
		s->grid = *g, s->divided = planes && planes->divided;
	for (int c = g->dim == 3 ? 0 : 2; c < 3 && !status; c++)
		status = pm_planes_agree(transform_table(0, s, c, lattice), planes);
	pm_mg_lattice_free(lattice);
	return status ? pm_mg_faces_free(s) : s;
}

static struct face face_of(const struct mg_faces *s, int axis, int side, int c)
{
	const struct pm_grid *g = &s->grid;
	struct face f = {.axis = axis, .side = side, .across = 3 - axis - c, .line = 1, .node = 1};
	f.lines = s->n[f.across] + 1;
	*(f.across > c ? &f.line : &f.node) = g->points[f.across > c ? c : f.across];
	return f;
}

static size_t at_of(const struct mg_faces *s, const struct face *f) { return f->side ? s->n[f->axis] : 0; }

/* The lines of a face whose nodes m belong to it, t[0] <= t < t[1]: those on its edges may belong to a face of a lower axis. */
static void owned(const struct mg_faces *s, const struct face *f, int c, size_t m, size_t t[2])
{
	const bool lent = c < f->axis && s->n[c] && (m == 0 || m == s->n[c]), ends = f->across < f->axis && s->n[f->across];
	t[0] = ends;
	t[1] = lent ? t[0] : f->lines - ends;
}

/* The transforms of the lines of a face, [mode][line], of the modes of this rank. packed: room for a face. */
static void lines_in(const struct mg_faces *s, const struct face *f, int c, const double *charge, double *packed, double *re, double *im)
{
	const size_t n = s->n[c], all = length(s, c), lines = f->lines;
	size_t from, to, own[2];
	modes(s, c, &from, &to);
	for (size_t m = 0; m <= n; m++) {
		owned(s, f, c, m, own);
		for (size_t t = 0; t < lines; t++)
			packed[m * lines + t] = t >= own[0] && t < own[1] ? charge[m * f->node + t * f->line] : 0;
	}
	#pragma omp parallel for num_threads(pm_threads()) if ((n + 1) * lines > 4096)
	for (size_t k = from; k < to; k++) {
		double *a = re + k * lines, *b = im + k * lines;
		memset(a, 0, lines * sizeof *a), memset(b, 0, lines * sizeof *b);
		for (size_t m = 0; m <= n; m++) {
			const double cosine = s->wave[c][k * m % all], sine = s->wave[c][all + k * m % all], *q = packed + m * lines;
			for (size_t t = 0; t < lines; t++)
				a[t] += q[t] * cosine, b[t] -= q[t] * sine;
		}
	}
}

enum { together = 64 }; /* lines, which are summed side by side */

/* Back, to the rows of the face of this rank (of its higher axis; in 2-D and 1-D, which have one, all). */
static void lines_out(const struct mg_faces *s, const struct face *f, int c, const double *re, const double *im, double *out)
{
	const size_t n = s->n[c], all = length(s, c), lines = f->lines;
	size_t m0 = 0, m1 = n + 1, t0 = 0, t1 = lines;
	if (f->across > c && n)
		mine(s, lines, &t0, &t1);
	else if (n)
		mine(s, n + 1, &m0, &m1);
	#pragma omp parallel for num_threads(pm_threads()) if ((n + 1) * lines > 4096)
	for (size_t m = m0; m < m1; m++)
		for (size_t first = t0; first < t1; first += together) {
			const size_t here = t1 - first < together ? t1 - first : together;
			double sum[together] = {0};
			size_t own[2];
			for (size_t k = 0; k <= n; k++) {
				const double twice = k == 0 || k == n ? 1 : 2, cosine = s->wave[c][k * m % all], sine = s->wave[c][all + k * m % all];
				const double *a = re + k * lines + first, *b = im + k * lines + first;
				for (size_t t = 0; t < here; t++)
					sum[t] += twice * (a[t] * cosine - b[t] * sine);
			}
			owned(s, f, c, m, own);
			for (size_t t = first; t < first + here; t++)
				if (t >= own[0] && t < own[1])
					out[m * f->node + t * f->line] -= sum[t - first] / (double)all;
		}
}

static size_t gap(size_t a, size_t b) { return a > b ? a - b : b - a; }

/* Mode k, of hat number `row`, of lines t0 <= t < t1 of target face b from source face a. */
static void multiply(const struct mg_faces *s, const struct face *a, const struct face *b, size_t k, size_t row, const size_t t[2],
	double *const source[2], double *const target[2])
{
	const int c = shared(a->axis, b->axis);
	const size_t wide = s->n[higher(c)] + 1, from = a->lines, to = b->lines, at = at_of(s, a), other = at_of(s, b);
	const double *hat = s->hat[c] + row * (s->n[lower(c)] + 1) * wide;
	for (size_t l = t[0]; l < t[1]; l++) {
		double re = 0, im = 0;
		for (size_t q = 0; q < from; q++) {
			const size_t along = a->axis == b->axis ? gap(at, other) : gap(at, l); /* a's normal */
			const size_t across = a->axis == b->axis ? gap(q, l) : gap(q, other);
			const double g = hat[a->axis == lower(c) ? along * wide + across : across * wide + along];
			re += g * source[0][k * from + q], im += g * source[1][k * from + q];
		}
		target[0][k * to + l] += re, target[1][k * to + l] += im;
	}
}

/* Of each of n arrays of count[i] items of size[i] numbers the items of every rank to all. Takes the caller's status and returns the agreed one. */
static int share_items(int status, const struct mg_faces *s, int n, double *const array[], const size_t count[], const size_t size[])
{
	size_t here = 0, whole = 0, bytes = 0, from, to;
	void *gathered = NULL;
	if (!s->divided)
		return status;
	for (int i = 0; i < n; i++) {
		mine(s, count[i], &from, &to);
		here += (to - from) * size[i], whole += count[i] * size[i];
	}
	double *own = status ? NULL : pm_alloc(here + 1, sizeof *own), *all = status ? NULL : pm_alloc(whole + 1, sizeof *all), *next = own;
	status = status ? status : own && all ? 0 : pm_failed();
	for (int i = 0; i < n && !status; i++) {
		mine(s, count[i], &from, &to);
		memcpy(next, array[i] + from * size[i], (to - from) * size[i] * sizeof *next);
		next += (to - from) * size[i];
	}
	status = pm_world_gather(status, own, here * sizeof *own, &gathered, &bytes);
	if (gathered && !status)
		memcpy(all, gathered, bytes);
	pm_free(gathered);
	status = pm_world_share(status, 0, all, whole * sizeof *all);
	next = all;
	for (int r = 0; r < pm_world_size() && !status; r++)
		for (int i = 0; i < n; i++) {
			const size_t first = share_of(s, count[i], r), items = share_of(s, count[i], r + 1) - first;
			memcpy(array[i] + first * size[i], next, items * size[i] * sizeof *next);
			next += items * size[i];
		}
	pm_free(own), pm_free(all);
	return status;
}

/* The modes of this rank, and in 2-D its lines, of all pairs of faces that share axis c. */
static void convolve(const struct mg_faces *s, int c, int n, const struct face face[], double *in[][2], double *sum[][2])
{
	size_t from, to;
	modes(s, c, &from, &to);
	#pragma omp parallel for num_threads(pm_threads()) if ((s->n[c] + 1) * (s->n[c] + 1) > 4096)
	for (size_t k = from; k < to; k++)
		for (int target = 0; target < n; target++) {
			size_t t[2] = {0, face[target].lines};
			if (s->n[c] == 0)
				mine(s, face[target].lines, &t[0], &t[1]);
			for (int source = 0; source < n; source++)
				if (shared(face[source].axis, face[target].axis) == c)
					multiply(s, &face[source], &face[target], k, k - from, t, in[source], sum[target]);
		}
}

/* All pairs of faces that share axis c; room: one array [mode][line], and two pairs of them for each face. */
static int apply_axis(int status, const struct mg_faces *s, int c, const struct pm_boundary *charge, struct pm_boundary *out, size_t most, double *room)
{
	struct face face[faces_most];
	double *in[faces_most][2], *sum[faces_most][2], *sums[2 * faces_most];
	size_t count[2 * faces_most], each[2 * faces_most];
	double *packed = room;
	int n = 0;
	room += status ? 0 : most;
	for (int axis = 0; axis < s->grid.dim && !status; axis++)
		for (int high = 0; high < 2 && axis != c; high++, n++) {
			face[n] = face_of(s, axis, high, c);
			const size_t size = (s->n[c] + 1) * face[n].lines;
			for (int part = 0; part < 2; part++, room += 2 * size) {
				in[n][part] = room, sum[n][part] = sums[2 * n + part] = room + size;
				count[2 * n + part] = s->n[c] ? s->n[c] + 1 : face[n].lines, each[2 * n + part] = s->n[c] ? face[n].lines : 1;
				memset(sum[n][part], 0, size * sizeof *room);
			}
			lines_in(s, &face[n], c, charge->value[axis][high], packed, in[n][0], in[n][1]);
		}
	convolve(s, c, n, face, in, sum);
	status = share_items(status, s, 2 * n, sums, count, each);
	for (int f = 0; f < n && !status; f++)
		lines_out(s, &face[f], c, sum[f][0], sum[f][1], out->value[face[f].axis][face[f].side]);
	return status;
}

/* The nodes on edges from the faces that they belong to. */
static void fill_edges(const struct mg_faces *s, struct pm_boundary *b)
{
	const size_t *points = s->grid.points;
	for (int axis = 1; axis < s->grid.dim; axis++)
		for (int side = 0; side < 2; side++)
			for (size_t i = 0; i < pm_boundary_points(&s->grid, axis); i++) {
				const int low = 0, high = axis == 1 ? 2 : 1;
				size_t x[3];
				x[axis] = side ? s->n[axis] : 0, x[low] = i % points[low], x[high] = i / points[low];
				for (int d = axis - 1; d >= 0; d--) /* the lowest axis last */
					if (x[d] == 0 || x[d] == s->n[d])
						b->value[axis][side][i] = b->value[d][x[d] > 0][d == 0 ? x[1] + points[1] * x[2] : x[0] + points[0] * x[2]];
			}
}

int pm_mg_faces_apply(int status, const struct mg_faces *s, const struct pm_boundary *charge, struct pm_boundary *out)
{
	size_t most = s->n[0] > s->n[1] ? s->n[0] : s->n[1], count[faces_most], each[faces_most];
	double *rows[faces_most];
	int n = 0;
	most = (most > s->n[2] ? most : s->n[2]) + 1;
	most *= s->grid.dim == 3 ? most : 1; /* nodes of a face */
	double *room = status ? NULL : pm_alloc((4 * faces_most + 1) * most, sizeof *room);
	status = status ? status : room ? 0 : pm_failed();
	for (int axis = 0; axis < s->grid.dim; axis++)
		for (int side = 0; side < 2; side++, n++) {
			rows[n] = out->value[axis][side];
			count[n] = s->n[higher(axis)] + 1, each[n] = s->n[lower(axis)] + 1;
			memset(rows[n], 0, count[n] * each[n] * sizeof *rows[n]);
		}
	for (int c = s->grid.dim == 3 ? 0 : 2; c < 3; c++)
		status = apply_axis(status, s, c, charge, out, most, room);
	if (s->grid.dim == 3)
		status = share_items(status, s, n, rows, count, each);
	if (!status)
		fill_edges(s, out);
	pm_free(room);
	return status;
}
