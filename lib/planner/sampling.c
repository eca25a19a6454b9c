/* The particles of a frame as a sample of a smooth density, measured without a mesh, so that no number depends on its cells.
 * Noise: a_k = sum |q| exp(-i k x)/sum |q| for the longest waves along the axes and diagonals of a periodic box. At random |a_k|^2 is exponential about 1/N,
 * so its mean is the median/ln 2; modes a dozen times above it are waves. A quiet start lies below 1/N.
 * Velocities: the variance of each component in boxes, about their mean; where it falls below a fifth as soon as the particles are split at the mean
 * velocity (a Maxwellian: 1 - 2/pi = 0.36) there are two beams. Source: Birdsall and Langdon 1985, chapters 12 and 16. Cost: 100 N sines in 1-D.
 * SPDX-License-Identifier: GPL-3.0-or-later */
#include <stdlib.h>
#include <string.h>

#include "planner/scales.h"
#include "stream/field-value.h"

enum { MODES = 32, DIRECTIONS = 13, BEAMS = 2 };

struct sample {
	size_t n;
	double *x[3], *v[3], *q; /* v NULL: none */
};

static const struct pm_field *state(const struct pm_frame *f, const char *on, const char *name)
{
	const struct pm_field *field = name ? pm_frame_field(f, on, name) : NULL;
	return field && field->role == PM_STATE && (field->type == PM_F64 || field->type == PM_F32) ? field : NULL;
}

static void drop(struct sample *p)
{
	for (int d = 0; d < 3; d++)
		pm_free(p->x[d]), pm_free(p->v[d]);
	pm_free(p->q);
}

/* All particles that move and have a strength. */
static int collect(const struct pm_frame *f, const struct pm_law *law, struct sample *p)
{
	size_t most = 1;
	bool ok = true;
	for (size_t k = 0; k < f->nsets; k++)
		most += pm_set_moves(f, f->sets[k]) && state(f, f->sets[k]->name, law->strength) ? (size_t)f->sets[k]->n : 0;
	for (int d = 0; d < f->dim; d++)
		ok = (p->x[d] = pm_alloc(most, sizeof(double))) && (p->v[d] = pm_alloc(most, sizeof(double))) && ok;
	p->q = pm_alloc(most, sizeof(double));
	for (size_t k = 0; k < f->nsets && ok && p->q; k++) {
		const char *set = f->sets[k]->name;
		const struct pm_field *x = state(f, set, "x"), *v = state(f, set, "v"), *q = state(f, set, law->strength);
		for (size_t i = 0; x && q && pm_set_moves(f, f->sets[k]) && i < x->count && p->n < most; i++, p->n++) {
			for (int d = 0; d < f->dim; d++)
				p->x[d][p->n] = pm_value_at(x, d, i), p->v[d][p->n] = v && d < v->components ? pm_value_at(v, d, i) : 0;
			p->q[p->n] = fabs(pm_value_at(q, 0, i));
		}
	}
	return ok && p->q ? 0 : -PM_DATA;
}

/* ---- waves and noise ---- */

/* The amplitudes of modes 1 ... n of the wave vector (2 pi/L) e, by powers of exp(-i k x). */
static void modes(const struct pm_frame *f, const struct sample *p, const int e[3], int n, double *power)
{
	double sum[MODES][2] = {{0}}, all = 0;
	for (size_t i = 0; i < p->n; i++) {
		double angle = 0, re = p->q[i], im = 0;
		for (int d = 0; d < f->dim; d++)
			angle += 2 * pm_pi * e[d] * (p->x[d][i] - f->lo[d]) / (f->hi[d] - f->lo[d]);
		const double c = cos(angle), s = sin(angle);
		for (int m = 0; m < n; m++) {
			const double next = re * c - im * s;
			im = re * s + im * c, re = next;
			sum[m][0] += re, sum[m][1] += im;
		}
		all += p->q[i];
	}
	for (int m = 0; m < n; m++)
		power[m] = all > 0 ? (sum[m][0] * sum[m][0] + sum[m][1] * sum[m][1]) / (all * all) : 0;
}

static int ascending(const void *a, const void *b)
{
	const double x = *(const double *)a, y = *(const double *)b;
	return (x > y) - (x < y);
}

/* Directions e of an octant's half: one of each pair e, -e. */
static int directions(int dim, int e[DIRECTIONS][3])
{
	int n = 0;
	for (int z = dim > 2 ? -1 : 0; z <= (dim > 2); z++)
		for (int y = dim > 1 ? -1 : 0; y <= (dim > 1); y++)
			for (int x = -1; x <= 1; x++)
				if (z > 0 || (z == 0 && (y > 0 || (y == 0 && x > 0))))
					e[n][0] = x, e[n][1] = y, e[n++][2] = z;
	return n;
}

/* Lattices have no noise up to their own wavelength; a plasma's, in space and velocity, has sqrt(N) places. */
static void spectrum(const struct pm_frame *f, const struct sample *p, struct pm_scales *s)
{
	int e[DIRECTIONS][3];
	const int ne = directions(f->dim, e), n = (int)fmin(MODES, 0.4 * pow(s->effective, 1.0 / (f->dim + (f->dim == 1 && s->thermal > 0))));
	double power[DIRECTIONS * MODES], sorted[DIRECTIONS * MODES], field = 0, sources = 0;
	if (n < 2)
		return;
	for (int k = 0; k < ne; k++)
		modes(f, p, e[k], n, power + k * n);
	memcpy(sorted, power, sizeof *sorted * (size_t)(ne * n));
	qsort(sorted, (size_t)(ne * n), sizeof *sorted, ascending);
	s->noise = sorted[ne * n / 2] / log(2);
	s->wave = 0;
	for (int k = 0; k < ne; k++)
		for (int m = 0; m < n; m++) {
			const double a = power[k * n + m];
			double k2 = 0;
			for (int d = 0; d < f->dim; d++)
				k2 += pow(2 * pm_pi * e[k][d] * (m + 1) / (f->hi[d] - f->lo[d]), 2);
			if (a < fmax(12 * s->noise, 1e-24)) /* of some hundred exponential numbers the largest is six times the mean; round-off */
				continue;
			s->wave = fmax(s->wave, sqrt(a));
			field += a / k2, sources += a;
		}
	s->wave_length = sources > 0 ? sqrt(field / sources) : NAN;
}

/* ---- beams ---- */

struct box {
	double n, w, wv, wvv;
};

static size_t box_of(const struct pm_frame *f, const struct sample *p, size_t i, int per_axis)
{
	size_t place = 0;
	for (int d = 0; d < f->dim; d++) {
		const double u = (p->x[d][i] - f->lo[d]) / (f->hi[d] - f->lo[d]);
		place = place * (size_t)per_axis + (size_t)fmin(per_axis - 1, per_axis * (u - floor(u)));
	}
	return place;
}

/* The variance of a component within boxes, of the particles split at `at` into BEAMS, or not (at NAN). */
static double variance(const struct pm_frame *f, const struct sample *p, int c, double split, struct box *box, size_t boxes, int per_axis)
{
	double sum = 0, weight = 0;
	memset(box, 0, BEAMS * boxes * sizeof *box);
	for (size_t i = 0; i < p->n; i++) {
		const double v = p->v[c][i] - (isnan(split) ? 0 : split), w = p->q[i];
		struct box *b = &box[BEAMS * box_of(f, p, i, per_axis) + (!isnan(split) && v > 0)];
		b->n++, b->w += w, b->wv += w * v, b->wvv += w * v * v;
	}
	for (size_t k = 0; k < BEAMS * boxes; k++)
		if (box[k].n > 1 && box[k].w > 0) {
			sum += fmax(0, box[k].wvv - box[k].wv * box[k].wv / box[k].w) * box[k].n / (box[k].n - 1);
			weight += box[k].w;
		}
	return weight > 0 ? sum / weight : 0;
}

static int velocities(const struct pm_frame *f, const struct sample *p, struct pm_scales *s)
{
	const int per_axis = f->dim == 1 ? 64 : f->dim == 2 ? 16 : 8;
	const size_t boxes = (size_t)(pow(per_axis, f->dim) + 0.5);
	struct box *box = pm_alloc(BEAMS * boxes, sizeof *box);
	double thermal = 0, drift = 0;
	for (int c = 0; c < f->dim && box; c++) {
		double half[BEAMS][2] = {{0}}, all = 0, mean = 0;
		for (size_t i = 0; i < p->n; i++)
			mean += p->q[i] * p->v[c][i], all += p->q[i];
		mean = all > 0 ? mean / all : 0;
		for (size_t i = 0; i < p->n; i++)
			half[p->v[c][i] > mean][0] += p->q[i], half[p->v[c][i] > mean][1] += p->q[i] * p->v[c][i];
		const double one = variance(f, p, c, NAN, box, boxes, per_axis), two = variance(f, p, c, mean, box, boxes, per_axis);
		const bool beams = two < 0.2 * one && one > 1e-12 * s->v_rms * s->v_rms && half[0][0] > 0 && half[1][0] > 0;
		thermal += (beams ? two : one) / f->dim;
		drift += beams ? (half[0][1] * half[0][1] / half[0][0] + half[1][1] * half[1][1] / half[1][0]) / all : mean * mean;
		s->beams = s->beams || beams;
	}
	pm_free(box);
	s->thermal = sqrt(thermal), s->drift = sqrt(drift);
	return box ? 0 : -PM_DATA;
}

int pm_scales_sampling(const struct pm_frame *f, const struct pm_law *law, struct pm_scales *s)
{
	struct sample p = {.n = 0};
	double q = 0, q2 = 0;
	bool periodic = true;
	s->noise = s->wave_length = NAN;
	s->wave = s->effective = 0;
	s->bodies = pm_frame_constant(f, "bodies", s->kind == PM_CHARGES ? HUGE_VAL : s->n);
	if (s->kind == PM_NO_FIELD || s->kind == PM_CARRIED || (s->kind == PM_VORTICES && f->dim == 3))
		return 0;
	int status = collect(f, law, &p);
	for (size_t i = 0; i < p.n && !status; i++)
		q += p.q[i], q2 += p.q[i] * p.q[i];
	s->effective = q2 > 0 ? q * q / q2 : 0;
	for (int d = 0; d < f->dim; d++)
		periodic = periodic && f->face[d][0] == PM_PERIODIC && f->face[d][1] == PM_PERIODIC;
	if (!status && s->second && s->effective > 0)
		status = velocities(f, &p, s);
	if (!status && periodic && s->effective > 0)
		spectrum(f, &p, s);
	drop(&p);
	return status;
}
