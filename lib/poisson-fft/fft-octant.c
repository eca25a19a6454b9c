/* The transform of an even Green's function on a doubled domain is the cosine transform of one octant, n+1 separations per open axis. A function of
 * distance is sampled there. A transform known in closed form is sampled on frequencies of a period that keeps the box and the cut function
 * apart, at least n h + reach, brought to separations 0 ... n by a cosine transform and from there to the doubled domain: the 4n of Vico, Greengard
 * and Ferrando 2016, folded once. Axes do not mix, so planes take x and y, then pencils take z.
 * Several ranks: each makes its planes, one exchange turns them into blocks of columns, which it transforms, and one gives every rank what it wants.
 * Determinism: every number by one thread, no reductions. Cost: transforms of the octant, by closed form of twice its length or a little
 * more per axis (elongated boxes: (n h + reach)/(n h) times). Memory: two octants while it works.
 * SPDX-License-Identifier: GPL-3.0-or-later */
#include <omp.h>
#include <string.h>

#include "poisson-fft/fft-lattice.h"
#include "poisson-fft/fft-octant.h"
#include "world/world.h"

enum { L = PM_FFT_LINES };

struct side {
	bool open, fold;
	size_t samples, size; /* before and after */
	double step;          /* between samples: a length, or a wave number */
	double factor;        /* of the whole */
	struct pm_transform from, to;
};

struct work {
	struct pm_octant *o;
	struct side side[3];
	struct pm_green_case *cases; /* by modes of the axes that are not open */
	size_t ncases;
	struct pm_lattice *lattice;  /* of differences, where no closed form is known */
	bool fold;
	size_t block, plane;         /* [doubles] scratch of a thread: two blocks and a plane */
	double *scratch;
};

/* The next length without prime factors above 7. */
static size_t smooth(size_t n)
{
	for (;; n++) {
		size_t m = n;
		for (size_t p = 2; p < 8; p++)
			while (m % p == 0)
				m /= p;
		if (m == 1)
			return n;
	}
}

static int side_init(struct work *w, int d, struct pm_fft_plans *planner)
{
	struct side *s = &w->side[d];
	const enum pm_face even[2] = {PM_NEUMANN, PM_NEUMANN};
	size_t n = w->o->axis[d].n;
	double h = w->o->axis[d].h, reach = w->cases->reach + w->cases->width * 10;
	s->open = w->o->axis[d].open;
	s->fold = s->open && w->fold;
	s->samples = s->size = s->open ? n + 1 : n;
	s->step = s->factor = s->open ? h : 1;
	if (s->open && pm_transform_init(planner, even, n, &s->to))
		return -PM_DATA;
	if (s->fold) {
		size_t half = smooth((size_t)ceil(0.5 * ((double)n + reach / h)));
		if (pm_transform_init(planner, even, half > n ? half : n, &s->from))
			return -PM_DATA;
		s->samples = s->from.n + 1;
		s->step = pm_pi / ((double)s->from.n * h);
		s->factor = 0.5 / (double)s->from.n;
	}
	w->o->axis[d].size = s->size;
	return 0;
}

/* Samples in the rows of a block to frequencies of the doubled axis, in order. */
static void transform(const struct side *s, double *block, double *other)
{
	if (s->fold) {
		pm_transform_real(&s->from, block);
		for (size_t i = 0; i < s->size; i++)
			memcpy(other + i * L, block + s->from.fft->at[i] * L, L * sizeof *block);
		memcpy(block, other, s->size * L * sizeof *block);
	}
	pm_transform_real(&s->to, block);
	for (size_t i = 0; i < s->size; i++)
		for (int q = 0; q < L; q++)
			other[i * L + (size_t)q] = s->factor * block[s->to.fft->at[i] * L + (size_t)q];
}

/* Lines of `samples` numbers, stride doubles apart, in a block of up to L neighbours; the results take their places. */
static void columns(const struct side *s, size_t width, size_t stride, double *at, double *block, double *other)
{
	for (size_t i = 0; i < s->samples; i++)
		for (size_t q = 0; q < L; q++)
			block[i * L + q] = q < width ? at[i * stride + q] : 0;
	transform(s, block, other);
	for (size_t i = 0; i < s->size; i++)
		memcpy(at + i * stride, other + i * L, width * sizeof *at);
}

static void rows(const struct side *s, size_t count, size_t stride, double *at, double *block, double *other)
{
	double *row[L];
	for (size_t r = 0; r < count; r++)
		row[r] = at + r * stride;
	pm_fft_rows_in((const double *const *)row, count, s->samples, NULL, block);
	transform(s, block, other);
	pm_fft_rows_out(other, NULL, s->size, count, row);
}

/* The same from heat kernels: over the nodes of the integral, the product of the kernels of y and z, and of x where that is open. */
static void lattice_row(const struct work *w, size_t y, size_t z, const struct pm_green_case *first, double *row)
{
	const struct side *s = w->side;
	const struct pm_lattice *l = w->lattice;
	const size_t at[3] = {0, y, z};
	double other[PM_LATTICE_NODES], r2 = 0;
	for (size_t q = 0; q < l->nodes; q++)
		other[q] = 1;
	for (int d = 1, open = s[0].open; d < 3; d++)
		if (s[d].open) {
			for (size_t q = 0; q < l->nodes; q++)
				other[q] *= l->heat[open][q * s[d].samples + at[d]];
			r2 += pow(s[d].step * (double)at[d], 2);
			open++;
		}
	memset(row, 0, s[0].samples * sizeof *row);
	for (size_t i = 0; i < s[0].samples; i++) {
		const struct pm_green_case *c = first + (s[0].open ? 0 : i);
		const double *weight = l->weight + (size_t)(c - w->cases) * l->nodes, x = s[0].open ? s[0].step * (double)i : 0;
		for (size_t q = 0; q < l->nodes && !s[0].open; q++)
			row[i] -= weight[q] * other[q];
		for (size_t q = 0; q < l->nodes && s[0].open && i == 0; q++)
			other[q] *= weight[q];
		if (s[0].open && i == 0)
			pm_lattice_row(l, s[0].samples - 1, other, row);
		row[i] += c->kappa > 0 ? 0 : pm_lattice_tail(l, r2 + x * x);
	}
}

/* One row of samples: y and z count samples of open axes, modes of others. */
static void fill_row(const struct work *w, size_t y, size_t z, double *row)
{
	const struct side *s = w->side;
	size_t mode = (s[1].open ? 0 : y) + (s[1].open ? 1 : s[1].samples) * (s[2].open ? 0 : z), along = s[0].open ? 0 : 1;
	const struct pm_green_case *c = w->cases + mode * (along ? s[0].samples : 1);
	if (w->lattice) {
		lattice_row(w, y, z, c, row);
		return;
	}
	double a = s[0].open ? s[0].step : 0, b = s[1].open ? s[1].step * (double)y : 0, d = s[2].open ? s[2].step * (double)z : 0;
	for (size_t i = 0; i < s[0].samples; i++, c += along) {
		double x = a * (double)i, r2 = x * x + b * b + d * d;
		row[i] = w->fold ? w->o->green->transform(c, r2) : w->o->green->at(c, r2);
	}
}

static void plane(const struct work *w, size_t z, double *out)
{
	const struct side *x = &w->side[0], *y = &w->side[1];
	double *block = w->scratch + (size_t)omp_get_thread_num() * (2 * w->block + w->plane), *other = block + w->block, *p = other + w->block;
	for (size_t j = 0; j < y->samples; j++)
		fill_row(w, j, z, p + j * x->samples);
	for (size_t j = 0; j < y->samples && x->open; j += L)
		rows(x, y->samples - j < L ? y->samples - j : L, x->samples, p + j * x->samples, block, other);
	for (size_t i = 0; i < x->size && y->open; i += L)
		columns(y, x->size - i < L ? x->size - i : L, x->samples, p + i, block, other);
	for (size_t j = 0; j < y->size; j++)
		for (size_t i = 0; i < w->o->row; i++)
			out[j * w->o->row + i] = i < w->o->rows && w->o->map[i] < x->size ? p[j * x->samples + w->o->map[i]] : 0;
}

static void planes(const struct work *w, double *out)
{
	size_t slab = w->side[1].size * w->o->row;
#pragma omp parallel for schedule(dynamic) num_threads(pm_threads()) if (w->side[2].samples * slab > 16384)
	for (size_t z = 0; z < w->side[2].samples; z++)
		plane(w, z, out + z * slab);
}

static void pencils(const struct work *w, double *out)
{
	size_t slab = w->side[1].size * w->o->row, blocks = (slab + L - 1) / L;
#pragma omp parallel for schedule(static) num_threads(pm_threads()) if (w->side[2].samples * slab > 16384)
	for (size_t b = 0; b < blocks; b++) {
		double *block = w->scratch + (size_t)omp_get_thread_num() * (2 * w->block + w->plane);
		columns(&w->side[2], slab - b * L < L ? slab - b * L : L, slab, out + b * L, block, block + w->block);
	}
}

/* The waves along the axes that are not open, each with its kappa; whether any has one. */
static bool cases(struct work *w)
{
	const struct pm_octant *o = w->o;
	struct pm_green_case first = {.width = o->green->regular ? o->width : 0};
	size_t size[3];
	double longest = 0;
	for (int d = 0; d < 3; d++) {
		size[d] = o->axis[d].open ? 1 : o->axis[d].n;
		if (o->axis[d].open) {
			first.h[first.dim++] = o->axis[d].h;
			longest += pow(o->axis[d].h * (double)o->axis[d].n, 2);
		}
	}
	/* A fifth more, so that the oscillations of the truncation, which the mesh does not resolve, have decayed within the box. */
	first.reach = 1.2 * sqrt(longest) + 10 * first.width;
	size_t count = size[0] * size[1] * size[2], some = 0;
	w->ncases = count;
	if (!(w->cases = pm_alloc(count, sizeof *w->cases)))
		return false;
#pragma omp parallel for schedule(dynamic) num_threads(pm_threads()) reduction(+ : some) if (count > 16)
	for (size_t i = 0; i < count; i++) {
		size_t at[3] = {i % size[0], i / size[0] % size[1], i / size[0] / size[1]};
		struct pm_green_case *c = &w->cases[i];
		*c = first;
		for (int d = 0; d < 3; d++)
			c->k2 -= o->axis[d].open ? 0 : o->axis[d].lambda[at[d]];
		c->kappa = sqrt(c->k2 + o->screen2);
		some += c->kappa > 0;
		if (o->green->prepare)
			o->green->prepare(c);
	}
	return some > 0;
}

static int lattice(struct work *w)
{
	const struct pm_octant *o = w->o;
	size_t n[3] = {0, 0, 0};
	int open = 0;
	for (int d = 0; d < 3; d++)
		if (o->axis[d].open)
			n[open++] = o->axis[d].n;
	if (!o->green->differences || (open == 1 && o->symbol == PM_FD2))
		return 0;
	w->lattice = pm_lattice_new(open, n, o->symbol, w->ncases, w->cases);
	return w->lattice ? 0 : -PM_DATA;
}

static int scratch(struct work *w)
{
	size_t most = 0;
	for (int d = 0; d < 3; d++) {
		size_t length = w->side[d].fold ? w->side[d].from.length : 0;
		length = w->side[d].open && w->side[d].to.length > length ? w->side[d].to.length : length;
		most = length > most ? length : most;
	}
	w->block = (most + 2) * L;
	w->plane = (w->side[0].samples * w->side[1].samples + L) / L * L;
	w->scratch = pm_alloc((size_t)pm_threads() * (2 * w->block + w->plane), sizeof *w->scratch);
	return w->scratch ? 0 : -PM_DATA;
}

/* Of `slab` columns in blocks of L, the first that rank r transforms. */
static size_t column_of(size_t slab, size_t r)
{
	const size_t at = (slab + L - 1) / L * r / (size_t)pm_world_size() * L;
	return at < slab ? at : slab;
}

/* From planes `first` to `end`, one behind the other, to the columns of this rank along all planes. */
static int turn(int status, const struct work *w, const double *planes, size_t first, size_t end, size_t *bytes, double **in)
{
	const size_t ranks = (size_t)pm_world_size(), slab = w->side[1].size * w->o->row;
	double *out = status ? NULL : pm_alloc((end - first) * slab + 1, sizeof *out), *to = out;
	for (size_t r = 0; r < ranks; r++) {
		const size_t from = column_of(slab, r), n = column_of(slab, r + 1) - from;
		for (size_t z = 0; z < end - first && out; z++, to += n)
			memcpy(to, planes + z * slab + from, n * sizeof *to);
		bytes[r] = n * (end - first) * sizeof *to;
	}
	status = pm_world_exchange(status ? status : out ? 0 : pm_failed(), out, bytes, (void **)in, bytes + ranks);
	pm_free(out);
	return status;
}

/* From columns to the planes that ranks want. */
static int deal(int status, const struct work *w, const double *columns, size_t *bytes, double **all)
{
	const struct pm_octant *o = w->o;
	const size_t ranks = (size_t)pm_world_size(), me = (size_t)pm_world_rank(), slab = w->side[1].size * o->row;
	const size_t n = column_of(slab, me + 1) - column_of(slab, me), held = o->held_of[me + 1] - o->held_of[me];
	double *out = status ? NULL : pm_alloc(o->held_of[ranks] * n + 1, sizeof *out), *in = NULL;
	for (size_t i = 0; i < o->held_of[ranks] && out; i++)
		memcpy(out + i * n, columns + o->held[i] * n, n * sizeof *out);
	for (size_t r = 0; r < ranks; r++)
		bytes[r] = (o->held_of[r + 1] - o->held_of[r]) * n * sizeof *out;
	status = pm_world_exchange(status ? status : out ? 0 : pm_failed(), out, bytes, (void **)&in, bytes + ranks);
	pm_free(out);
	*all = status ? NULL : pm_alloc(held * slab + 1, sizeof **all);
	const double *from = in;
	for (size_t r = 0; r < ranks && *all; r++) {
		const size_t at = column_of(slab, r), wide = column_of(slab, r + 1) - at;
		for (size_t i = 0; i < held; i++, from += wide)
			memcpy(*all + i * slab + at, from, wide * sizeof *from);
	}
	pm_free(in);
	return pm_world_agree(status ? status : *all ? 0 : pm_failed());
}

static int spectrum_of_ranks(int status, const struct work *w, double **all)
{
	const struct side *z = &w->side[2];
	const size_t ranks = (size_t)pm_world_size(), me = (size_t)pm_world_rank(), slab = w->side[1].size * w->o->row;
	const size_t first = z->samples * me / ranks, end = z->samples * (me + 1) / ranks, *held = w->o->held + w->o->held_of[me];
	const size_t n = z->open ? end - first : w->o->held_of[me + 1] - w->o->held_of[me];
	const size_t wide = column_of(slab, me + 1) - column_of(slab, me);
	double *planes = status ? NULL : pm_alloc(n * slab + 1, sizeof *planes), *columns_in = NULL;
	size_t *bytes = status ? NULL : pm_alloc(2 * ranks, sizeof *bytes);
	status = pm_world_agree(status ? status : planes && bytes ? 0 : pm_failed());
#pragma omp parallel for schedule(dynamic) num_threads(pm_threads()) if (n * slab > 16384)
	for (size_t i = 0; i < (status ? 0 : n); i++)
		plane(w, z->open ? first + i : held[i], planes + i * slab);
	if (status || !z->open) {
		*all = status ? pm_free(planes) : planes;
		pm_free(bytes);
		return status;
	}
	status = turn(status, w, planes, first, end, bytes, &columns_in);
	pm_free(planes);
#pragma omp parallel for schedule(static) num_threads(pm_threads()) if (z->samples * wide > 16384)
	for (size_t b = 0; b < (status ? 0 : (wide + L - 1) / L); b++) {
		double *block = w->scratch + (size_t)omp_get_thread_num() * (2 * w->block + w->plane);
		columns(z, wide - b * L < L ? wide - b * L : L, wide, columns_in + b * L, block, block + w->block);
	}
	status = status ? status : deal(status, w, columns_in, bytes, all);
	pm_free(columns_in), pm_free(bytes);
	return status;
}

/* All planes here. */
static int spectrum(const struct work *w, double **out)
{
	const struct side *z = &w->side[2];
	const size_t slab = w->side[1].size * w->o->row;
	double *all = pm_alloc(z->samples * slab, sizeof *all);
	if (!all)
		return -PM_DATA;
	planes(w, all);
	if (z->open)
		pencils(w, all);
	*out = all;
	if (z->samples == z->size)
		return 0;
	if ((*out = pm_alloc(z->size * slab, sizeof *all)))
		memcpy(*out, all, z->size * slab * sizeof *all);
	pm_free(all);
	return *out ? 0 : -PM_DATA;
}

int pm_octant_spectrum(int status, struct pm_octant *o, struct pm_fft_plans *planner, double **all)
{
	struct work w = {.o = o};
	*all = NULL;
	if (!status) {
		bool screened = cases(&w);
		w.fold = !o->green->at || (screened && o->green->transform && o->green->smooth(w.cases));
		if (!w.cases || lattice(&w) || side_init(&w, 0, planner) || side_init(&w, 1, planner) || side_init(&w, 2, planner) || scratch(&w))
			status = -PM_DATA;
	}
	if (o->held_of)
		status = spectrum_of_ranks(status, &w, all);
	else if (!status)
		status = spectrum(&w, all);
	pm_free(w.scratch);
	pm_free(w.cases);
	pm_lattice_free(w.lattice);
	return status;
}
