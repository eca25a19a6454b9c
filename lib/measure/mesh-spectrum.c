/* Spectrum of a field on a mesh: u = sum over k of u^_k exp(i k x), |u^_k|^2 summed over shells of |k|, all components together.
 * Real transforms along each axis in turn (fft/axis-transform.h): Hartley along periodic axes, whose squares summed over +-k along every axis are those of
 * the complex amplitudes, and cosines along others, which is the spectrum of the field with its even images, k = pi m/L. So the sum over all shells is the
 * mean square of the nodes (Parseval; end nodes of axes that are not periodic count half), to rounding.
 * Cost: N log N, one copy of a component; the sums go plane by plane and join in order, the same bytes for any number of threads.
 * Sources: Bracewell 1983 for the Hartley transform; Pope 2000, section 6.5 for shells.
 * SPDX-License-Identifier: GPL-3.0-or-later */
#include <omp.h>
#include <string.h>

#include "base/in-order.h"
#include "fft/axis-transform.h"
#include "fft/line-groups.h"
#include "measure/mesh-spectrum.h"

enum { L = PM_FFT_LINES };

static const size_t most_shells = 1u << 20;

/* The mesh as it is transformed: faces that are not periodic have even images. */
struct box {
	size_t points[3];
	struct pm_transform line[3];
	double unit[3];   /* [1/length] wave number of the first wave along an axis; 0 above dim */
	double norm;      /* of the squares */
};

static int box_of(const struct pm_grid *g, const struct pm_field *field, struct pm_fft_plans *plans, struct box *b)
{
	*b = (struct box){.norm = 1};
	for (int d = 0; d < 3; d++) {
		const enum pm_face as = d >= g->dim || g->face[d][0] == PM_PERIODIC ? PM_PERIODIC : PM_NEUMANN, face[2] = {as, as};
		b->points[d] = g->points[d];
		for (int c = 0; c < field->components && as == PM_NEUMANN; c++)
			if (field->staggered[c][d])
				return pm_fail(PM_DATA, "component %d of '%s' sits half a cell up axis %d, which is not periodic (spectra of staggered "
					"fields need periodic faces)", c, field->name, d);
		if (pm_transform_init_real(plans, face, d < g->dim ? g->cells[d] : 1, &b->line[d]))
			return -PM_DATA;
		b->unit[d] = d < g->dim ? (as == PM_PERIODIC ? 2 : 1) * pm_pi / ((double)g->cells[d] * g->h[d]) : 0;
		b->norm /= (double)b->line[d].length;
	}
	return 0;
}

/* Wave number of mode m along axis d in units of the axis, and in how many of the waves of the images it is. */
static double wave(const struct box *b, int d, size_t m, double *times)
{
	const bool even = b->line[d].face[0] == PM_NEUMANN;
	const size_t n = b->line[d].length;
	*times = even && m && 2 * m < n ? 2 : 1;
	return (double)(!even && 2 * m > n ? n - m : m) * b->unit[d];
}

static void transform(const struct box *b, int d, double *u, double *scratch, size_t lot)
{
	const struct pm_transform *line = &b->line[d];
	const size_t groups = pm_line_groups(b->points, d);
#pragma omp parallel for schedule(static) num_threads(pm_threads())
	for (size_t i = 0; i < groups; i++) {
		const struct pm_line_group g = pm_line_group(b->points, d, i);
		double *block = scratch + (size_t)omp_get_thread_num() * lot, *first = u + g.at;
		for (size_t j = 0; j < line->count; j++)
			for (size_t q = 0; q < L; q++)
				block[(line->row + j) * L + q] = q < g.lines ? first[j * g.step + q * g.across] : 0;
		pm_transform_real(line, block);
		for (size_t m = 0; m < line->modes; m++)
			for (size_t q = 0; q < g.lines; q++)
				first[m * g.step + q * g.across] = block[line->map[m] * L + q];
	}
}

/* What a plane adds to the shells. */
struct part {
	struct pm_sum waves, k, log[3], square; /* powers of ln(k/middle of the shell) */
};

static void join(struct pm_sum *all, struct pm_sum part)
{
	pm_sum_add(all, part.sum);
	pm_sum_add(all, part.carry);
}

static double middle(size_t j, double width) { return (j ? (double)j : 0.5) * width; }

static void add_plane(const struct box *b, const double *u, size_t z, double width, bool count, struct part *shell)
{
	double tx, ty, tz;
	const double kz = wave(b, 2, z, &tz);
	for (size_t y = 0; y < b->points[1]; y++) {
		const double ky = wave(b, 1, y, &ty), *row = u + (z * b->points[1] + y) * b->points[0];
		for (size_t x = !(y || z); x < b->points[0]; x++) { /* without the mean */
			const double kx = wave(b, 0, x, &tx), k = sqrt(kx * kx + ky * ky + kz * kz), times = tx * ty * tz;
			const size_t j = (size_t)(k / width + 0.5);
			struct part *to = shell + j;
			if (count) {
				const double t = log(k / middle(j, width));
				pm_sum_add(&to->waves, times), pm_sum_add(&to->k, times * k);
				pm_sum_add(&to->log[0], times * t), pm_sum_add(&to->log[1], times * t * t), pm_sum_add(&to->log[2], times * t * t * t);
			}
			/* a cosine of amplitude X over the length of nodes and images has |u^|^2 = X^2 in each of its `times` waves */
			pm_sum_add(&to->square, times * row[x] * row[x]);
		}
	}
}

/* Planes in lots, so that the shells of all of them need not fit into memory at once. */
static int add(const struct box *b, const double *u, bool count, struct pm_spectrum *s, struct part *all)
{
	const size_t planes = b->points[2], lot = planes < 32 ? planes : 32;
	struct part *parts = pm_alloc(lot * s->n, sizeof *parts);
	if (!parts)
		return -PM_DATA;
	for (size_t z = 0; z < planes; z += lot) {
		const size_t here = planes - z < lot ? planes - z : lot;
		memset(parts, 0, here * s->n * sizeof *parts);
#pragma omp parallel for schedule(static) num_threads(pm_threads())
		for (size_t i = 0; i < here; i++)
			add_plane(b, u, z + i, s->width, count, parts + i * s->n);
		for (size_t i = 0; i < here * s->n; i++) {
			struct part *to = all + i % s->n;
			join(&to->waves, parts[i].waves), join(&to->k, parts[i].k), join(&to->square, parts[i].square);
			for (int q = 0; q < 3; q++)
				join(&to->log[q], parts[i].log[q]);
		}
	}
	pm_free(parts);
	return 0;
}

/* Mean and mean square over the nodes. */
static void means(const struct pm_grid *g, const double *u, double *mean, double *square)
{
	struct pm_sum one = {0, 0}, two = {0, 0};
	double end[3][2], nodes = 1;
	for (int d = 0; d < 3; d++) {
		const bool whole = d >= g->dim || g->face[d][0] == PM_PERIODIC;
		end[d][0] = end[d][1] = whole ? 1 : 0.5;
		nodes *= d < g->dim ? (double)g->cells[d] : 1;
	}
	pm_sum_of_mesh(g->points, u, NULL, (const double (*)[2])end, &one);
	pm_sum_of_mesh(g->points, u, u, (const double (*)[2])end, &two);
	*mean = pm_sum_total(one) / nodes;
	*square += pm_sum_total(two) / nodes;
}

static int shells(const struct pm_grid *g, const struct box *b, double width, struct pm_spectrum *s)
{
	double most = 0;
	s->width = width;
	s->volume = 1;
	for (int d = 0; d < g->dim; d++) {
		s->width = width > 0 ? width : fmax(s->width, b->unit[d]);
		s->volume *= (double)g->cells[d] * g->h[d];
		most += pow((double)(b->line[d].length / 2) * b->unit[d], 2);
	}
	const double n = floor(sqrt(most) / s->width + 0.5) + 1;
	if (!(n <= (double)most_shells))
		return pm_fail(PM_USAGE, "%.3g shells of width %g (at most %zu)", n, s->width, most_shells);
	s->n = (size_t)n + 1;
	return (s->shell = pm_zalloc(s->n, sizeof *s->shell)) ? 0 : -PM_DATA;
}

static struct pm_wave_shell shell_of(const struct part *p, double mid, double norm)
{
	struct pm_wave_shell a = {.waves = pm_sum_total(p->waves), .square = pm_sum_total(p->square) * norm * norm};
	double m[3];
	if (!(a.waves > 0))
		return a;
	for (int q = 0; q < 3; q++)
		m[q] = pm_sum_total(p->log[q]) / a.waves;
	a.k = pm_sum_total(p->k) / a.waves;
	a.log_k[0] = log(mid) + m[0], a.log_k[1] = fmax(0, m[1] - m[0] * m[0]), a.log_k[2] = m[2] - 3 * m[0] * m[1] + 2 * m[0] * m[0] * m[0];
	return a;
}

int pm_spectrum_of(const struct pm_grid *g, const struct pm_field *field, double width, struct pm_fft_plans *plans, struct pm_spectrum *s)
{
	const size_t size = pm_grid_size(g);
	struct box b;
	size_t longest = 1;
	*s = (struct pm_spectrum){0};
	int status = box_of(g, field, plans, &b);
	if (status || (status = shells(g, &b, width, s)))
		return status;
	for (int d = 0; d < 3; d++)
		longest = b.line[d].length > longest ? b.line[d].length : longest;
	const size_t lot = (longest + 2) * L;
	struct part *all = pm_zalloc(s->n, sizeof *all);
	double *u = pm_alloc(size, sizeof *u), *scratch = pm_alloc((size_t)pm_threads() * lot, sizeof *scratch);
	status = all && u && scratch ? 0 : -PM_DATA;
	for (int c = 0; c < field->components && !status; c++) {
		memcpy(u, pm_in(field, c), size * sizeof *u);
		means(g, u, &s->mean[c], &s->mean_square);
		for (int d = 0; d < g->dim; d++)
			transform(&b, d, u, scratch, lot);
		s->waves_square += u[0] * b.norm * u[0] * b.norm;
		status = add(&b, u, c == 0, s, all);
	}
	for (size_t j = 0; j < s->n && !status; j++) {
		s->shell[j] = shell_of(all + j, middle(j, s->width), b.norm);
		s->waves_square += s->shell[j].square;
	}
	pm_free(all), pm_free(u), pm_free(scratch);
	return status;
}

void pm_spectrum_free(struct pm_spectrum *s) { s->shell = pm_free(s->shell); }

/* One straight line, with the means of k^power over shells as the power of the last one says. */
static struct pm_slope line_of(const struct pm_spectrum *s, double from, double to, double power)
{
	struct pm_slope e = {.power = NAN, .error = NAN};
	double w = 0, mx = 0, my = 0, xx = 0, xy = 0, left = 0;
	for (int pass = 0; pass < 3; pass++)
		for (size_t j = 0; j < s->n; j++) {
			const struct pm_wave_shell *a = s->shell + j;
			if (!(a->k > 0 && a->square > 0 && a->k >= from && a->k <= to))
				continue;
			const double *l = a->log_k, x = l[0], y = log(a->square / a->waves) - power * power * (l[1] / 2 + power * l[2] / 6);
			const double dx = x - mx / w, dy = y - my / w;
			if (pass == 0)
				w += a->waves, mx += a->waves * x, my += a->waves * y, e.shells++;
			else if (pass == 1)
				xx += a->waves * dx * dx, xy += a->waves * dx * dy;
			else
				left += a->waves * (dy - xy / xx * dx) * (dy - xy / xx * dx);
		}
	if (e.shells < 3 || !(xx > 0))
		return e;
	e.power = xy / xx;
	e.error = sqrt(left / ((double)(e.shells - 2) * xx));
	return e;
}

struct pm_slope pm_spectrum_slope(const struct pm_spectrum *s, double from, double to)
{
	struct pm_slope e = {.power = 0};
	for (int i = 0; i < 20 && isfinite(e.power); i++) /* the correction is small, and each step lessens what is left of it by that */
		e = line_of(s, from, to, e.power);
	return e;
}
