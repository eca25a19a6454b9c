/* The potential of charges on the surface of a box at the nodes of its surface: a convolution with a table of the lattice Green's function.
 *   phi(x) = sum over the nodes y of the surface of G(|x - y|) q(y)
 * Two faces always share an axis (two opposite ones two): along it the sum is a convolution, done mode by mode of a cosine and sine sum over twice the length,
 * where G, being even, has a real transform; across it the sum is done as it stands. A node on an edge belongs to the face of the lowest axis. An axis above
 * dim has one node and one mode, which makes the same code serve 2-D, where it is the plain double sum, and 1-D.
 * Cost: 100 N^3 operations in 3-D, 32 N^2 in 2-D; memory: three tables of N^3. SPDX-License-Identifier: GPL-3.0-or-later */
#include "poisson-mg/mg-open-parts.h"

#include "fft/fft-block.h"

#include <string.h>

enum { faces_most = 6 };

struct mg_faces {
	struct pm_grid grid;
	size_t n[3];     /* cells, 0 above dim */
	double *hat[3];  /* per axis c: transform of G along c, [mode 0..n_c][offset along the lower other axis][along the higher] */
	double *wave[3]; /* cos(pi m/n_c), m < 2 n_c, then the sines */
};

struct face {
	int axis;
	size_t at; /* node along its axis */
};

static size_t length(const struct mg_faces *s, int c) { return s->n[c] ? 2 * s->n[c] : 1; }
static int shared(int a, int b) { return a != b ? 3 - a - b : a == 2 ? 1 : 2; } /* the axis along which two faces are convolved */
static int lower(int c) { return c == 0; }
static int higher(int c) { return c == 2 ? 1 : 2; }

/* The transforms along c of sixteen lines at a time: pairs of even real lines as the two parts of complex ones come out as such. */
static void transform_lines(const struct mg_faces *s, int c, const double *table, const struct pm_fft *fft, size_t line, double *block)
{
	const size_t step[3] = {1, s->n[0] + 1, (s->n[0] + 1) * (s->n[1] + 1)};
	size_t n = s->n[c], wide = s->n[higher(c)] + 1, lines = (s->n[lower(c)] + 1) * wide;
	for (size_t q = 0; q < PM_FFT_LINES; q++) {
		size_t l = line + q < lines ? line + q : lines - 1;
		const double *from = table + l / wide * step[lower(c)] + l % wide * step[higher(c)];
		for (size_t m = 0; m < 2 * n; m++)
			block[m * PM_FFT_LINES + q] = from[step[c] * (m <= n ? m : 2 * n - m)];
	}
	pm_fft_forward(fft, block);
	for (size_t k = 0; k <= n; k++)
		for (size_t q = 0; q < PM_FFT_LINES && line + q < lines; q++)
			s->hat[c][k * lines + line + q] = block[fft->at[k] * PM_FFT_LINES + q];
}

static int transform_table(struct mg_faces *s, int c, const double *table)
{
	size_t size = (s->n[0] + 1) * (s->n[1] + 1) * (s->n[2] + 1), lines = size / (s->n[c] + 1);
	s->hat[c] = pm_alloc(size, sizeof(double));
	s->wave[c] = pm_alloc(2 * length(s, c), sizeof(double));
	if (!s->hat[c] || !s->wave[c])
		return -PM_DATA;
	for (size_t m = 0; m < length(s, c); m++) {
		s->wave[c][m] = cos(2 * pm_pi * (double)m / (double)length(s, c));
		s->wave[c][length(s, c) + m] = sin(2 * pm_pi * (double)m / (double)length(s, c));
	}
	if (s->n[c] == 0) { /* the only such axis in use is z in 2-D and 1-D */
		for (size_t l = 0; l < lines; l++)
			s->hat[c][l] = table[l / (s->n[1] + 1) + l % (s->n[1] + 1) * (s->n[0] + 1)];
		return 0;
	}
	struct pm_fft_plans planner = {0};
	const struct pm_fft *fft = pm_fft(&planner, length(s, c));
	int failed = !fft;
	#pragma omp parallel for num_threads(pm_threads()) schedule(static) if (size > mg_parallel)
	for (size_t b = 0; b < (lines + PM_FFT_LINES - 1) / PM_FFT_LINES; b++) {
		double *block = fft ? pm_alloc(length(s, c) * PM_FFT_LINES, sizeof *block) : NULL;
		if (block)
			transform_lines(s, c, table, fft, b * PM_FFT_LINES, block);
		else
			#pragma omp atomic write
			failed = 1;
		pm_free(block);
	}
	pm_fft_plans_clear(&planner);
	return failed ? -PM_DATA : 0;
}

struct mg_faces *pm_mg_faces_free(struct mg_faces *s)
{
	for (int c = 0; s && c < 3; c++)
		pm_free(s->hat[c]), pm_free(s->wave[c]);
	return pm_free(s);
}

struct mg_faces *pm_mg_faces_new(const struct pm_grid *g, const double *table)
{
	struct mg_faces *s = pm_zalloc(1, sizeof *s);
	if (!s)
		return NULL;
	s->grid = *g;
	for (int d = 0; d < g->dim; d++)
		s->n[d] = g->cells[d];
	for (int c = g->dim == 3 ? 0 : 2; c < 3; c++)
		if (transform_table(s, c, table))
			return pm_mg_faces_free(s);
	return s;
}

/* The point of line t of a face, node m along c; false if it belongs to another face. */
static bool node(const struct mg_faces *s, const struct face *f, int c, size_t t, size_t m, size_t *point)
{
	size_t at[3] = {0};
	at[f->axis] = f->at;
	at[3 - f->axis - c] = t;
	at[c] = m;
	*point = at[0] + (s->n[0] + 1) * (at[1] + (s->n[1] + 1) * at[2]);
	for (int e = 0; e < f->axis; e++)
		if (s->n[e] && (at[e] == 0 || at[e] == s->n[e]))
			return false;
	return true;
}

/* The transform of line t of a face, [mode][line]. */
static void line_in(const struct mg_faces *s, const struct face *f, int c, size_t t, const double *charge, double *re, double *im)
{
	size_t n = s->n[c], lines = s->n[3 - f->axis - c] + 1, long_ = length(s, c), point;
	for (size_t k = 0; k <= n; k++) {
		double a = 0, b = 0;
		for (size_t m = 0; m <= n; m++)
			if (node(s, f, c, t, m, &point) && charge[point] != 0) {
				a += charge[point] * s->wave[c][k * m % long_];
				b -= charge[point] * s->wave[c][long_ + k * m % long_];
			}
		re[k * lines + t] = a, im[k * lines + t] = b;
	}
}

static void line_out(const struct mg_faces *s, const struct face *f, int c, size_t t, const double *re, const double *im, double *out)
{
	size_t n = s->n[c], lines = s->n[3 - f->axis - c] + 1, long_ = length(s, c), point;
	for (size_t m = 0; m <= n; m++) {
		double sum = 0;
		if (!node(s, f, c, t, m, &point))
			continue;
		for (size_t k = 0; k <= n; k++) {
			double twice = k == 0 || k == n ? 1 : 2;
			sum += twice * (re[k * lines + t] * s->wave[c][k * m % long_] - im[k * lines + t] * s->wave[c][long_ + k * m % long_]);
		}
		out[point] -= sum / (double)long_;
	}
}

static size_t gap(size_t a, size_t b) { return a > b ? a - b : b - a; }

/* Mode k of target face b from source face a. */
static void multiply(const struct mg_faces *s, const struct face *a, const struct face *b, int c, size_t k, const double *source[2], double *target[2])
{
	size_t wide = s->n[higher(c)] + 1, from = s->n[3 - a->axis - c] + 1, to = s->n[3 - b->axis - c] + 1;
	const double *hat = s->hat[c] + k * (s->n[lower(c)] + 1) * wide;
	for (size_t t = 0; t < to; t++) {
		double re = 0, im = 0;
		for (size_t q = 0; q < from; q++) {
			size_t along = a->axis == b->axis ? gap(a->at, b->at) : gap(a->at, t); /* a's normal */
			size_t across = a->axis == b->axis ? gap(q, t) : gap(q, b->at);
			double g = hat[a->axis == lower(c) ? along * wide + across : across * wide + along];
			re += g * source[0][k * from + q], im += g * source[1][k * from + q];
		}
		target[0][k * to + t] += re, target[1][k * to + t] += im;
	}
}

/* All pairs of faces that share axis c; room: three pairs of arrays [mode][line] for each face. */
static void apply_axis(const struct mg_faces *s, int c, const double *charge, double *out, double *room)
{
	struct face face[faces_most];
	double *in[faces_most][2], *sum[faces_most][2];
	int n = 0;
	for (int axis = 0; axis < s->grid.dim; axis++)
		for (int high = 0; high < 2 && axis != c; high++, n++) {
			size_t size = (s->n[c] + 1) * (s->n[3 - axis - c] + 1);
			face[n] = (struct face){axis, high ? s->n[axis] : 0};
			for (int part = 0; part < 2; part++, room += 2 * size) {
				in[n][part] = room, sum[n][part] = room + size;
				memset(sum[n][part], 0, size * sizeof *room);
			}
		}
	for (int f = 0; f < n; f++) {
		#pragma omp parallel for num_threads(pm_threads()) if ((s->n[c] + 1) * (s->n[c] + 1) > 4096)
		for (size_t t = 0; t <= s->n[3 - face[f].axis - c]; t++)
			line_in(s, &face[f], c, t, charge, in[f][0], in[f][1]);
	}
	#pragma omp parallel for num_threads(pm_threads()) if ((s->n[c] + 1) * (s->n[c] + 1) > 4096)
	for (size_t k = 0; k <= s->n[c]; k++)
		for (int to = 0; to < n; to++)
			for (int from = 0; from < n; from++)
				if (shared(face[from].axis, face[to].axis) == c)
					multiply(s, &face[from], &face[to], c, k, (const double *[]){in[from][0], in[from][1]}, sum[to]);
	for (int f = 0; f < n; f++) {
		#pragma omp parallel for num_threads(pm_threads()) if ((s->n[c] + 1) * (s->n[c] + 1) > 4096)
		for (size_t t = 0; t <= s->n[3 - face[f].axis - c]; t++)
			line_out(s, &face[f], c, t, sum[f][0], sum[f][1], out);
	}
}

int pm_mg_faces_apply(const struct mg_faces *s, const double *charge, double *out)
{
	size_t most = s->n[0] > s->n[1] ? s->n[0] : s->n[1];
	most = (most > s->n[2] ? most : s->n[2]) + 1;
	double *room = pm_alloc(4 * faces_most * (s->grid.dim == 3 ? most : 1) * most, sizeof *room);
	for (int c = s->grid.dim == 3 ? 0 : 2; room && c < 3; c++)
		apply_axis(s, c, charge, out, room);
	pm_free(room);
	return room ? 0 : -PM_DATA;
}
