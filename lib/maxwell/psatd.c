/* Pseudo-spectral analytical time-domain: every wave of the mesh through the whole step by its exact solution, with the current constant in the step, so
 * vacuum has no dispersion and no limit of the step. With D the derivative between points half a cell apart (yee-waves.h), K^2 = -D.D, w = c K, C = cos(w dt):
 *
 *   E' = E - dt J/eps0 + curl [ c^2 sin(w dt)/w B - (1 - C)/K^2 curl E + (dt - sin(w dt)/w)/K^2 curl J/eps0 ]
 *   B' = B + curl [ -sin(w dt)/w E - (1 - C)/K^2 curl B + (1 - C)/w^2 J/eps0 ]
 *
 * J is first multiplied by sin(k h/2)/(k h/2) along the axis of each component: what obeys the continuity of two-point differences (p2m --current) then obeys
 * that of D, so div E - rho/eps0 stays as it is, with D for div. div B stays as it is. Periodic boxes; fields where Yee has them.
 *
 * With --current-drift V the current is not constant in the step but moves on with V: J exp(-i k.V (t - t_middle)), over the mean of that factor, so that
 * charge is kept. Two of the coefficients become integrals over the step, which change (dt - sin(w dt)/w) and (1 - C)/w^2; without V they are those.
 * Source: Haber et al. 1973 (6th conference on numerical simulation of plasmas, 46); Vay, Haber and Godfrey 2013, J. Comput. Phys. 243, 260, eq. 13-14.
 * Cost: 15 transforms of a component a step, N log N. SPDX-License-Identifier: GPL-3.0-or-later */
#include "maxwell-parts/yee-waves.h"
#include "maxwell/maxwell.h"

enum { E, B = 3, J = 6, C = PM_WAVES_CHUNK };

struct complex3 {
	double re[3], im[3];
};

/* For eight waves: their values are w->field[..] + at. */
struct place {
	const struct pm_yee_waves *w;
	size_t at;
};

static struct complex3 load(const struct place *p, int field, size_t q)
{
	struct complex3 a;
	for (int d = 0; d < 3; d++) {
		a.re[d] = p->w->field[field + d][p->at + q];
		a.im[d] = p->w->field[field + d][p->at + C + q];
	}
	return a;
}

static void store(const struct place *p, int field, size_t q, const struct complex3 *a, double norm)
{
	for (int d = 0; d < 3; d++) {
		p->w->field[field + d][p->at + q] = a->re[d] * norm;
		p->w->field[field + d][p->at + C + q] = a->im[d] * norm;
	}
}

/* curl of E-like values at B's points (up), and of B-like ones at E's, with -conj D. */
static struct complex3 curl(const struct complex3 *d, const struct complex3 *a, bool up)
{
	const double s = up ? 1 : -1;
	struct complex3 r;
	for (int c = 0; c < 3; c++) {
		const int e = (c + 1) % 3, f = (c + 2) % 3;
		r.re[c] = s * (d->re[e] * a->re[f] - d->re[f] * a->re[e]) - (d->im[e] * a->im[f] - d->im[f] * a->im[e]);
		r.im[c] = s * (d->re[e] * a->im[f] - d->re[f] * a->im[e]) + (d->im[e] * a->re[f] - d->im[f] * a->re[e]);
	}
	return r;
}

/* to += factor a */
static void add(struct complex3 *to, double factor, const struct complex3 *a)
{
	for (int c = 0; c < 3; c++)
		to->re[c] += factor * a->re[c], to->im[c] += factor * a->im[c];
}

/* to += (re + i im) a */
static void add_times(struct complex3 *to, double re, double im, const struct complex3 *a)
{
	for (int c = 0; c < 3; c++) {
		to->re[c] += re * a->re[c] - im * a->im[c];
		to->im[c] += re * a->im[c] + im * a->re[c];
	}
}

static double sinc(double x) { return fabs(x) > 1e-4 ? sin(x) / x : 1 - x * x / 6; }

/* Integrals over the step of exp(-i o (t - dt/2)) with cos(w (dt - t)) and sin(w (dt - t))/w, over the mean of the first factor: cos part re, im; sin part. */
static void with_drift(double w, double o, double dt, double cosine[2], double sine[2])
{
	const double up = sinc(0.5 * (o + w) * dt), down = sinc(0.5 * (o - w) * dt), s = 0.5 * dt / sinc(0.5 * o * dt);
	const double c = cos(0.5 * w * dt), h = sin(0.5 * w * dt);
	cosine[0] = s * c * (up + down), cosine[1] = s * h * (up - down);
	sine[0] = s * h * (up + down) / w, sine[1] = -s * c * (up - down) / w;
}

/* One wave, derivatives d, through dt; o: k.V of the current. */
static void advance_wave(const struct pm_yee *y, const struct complex3 *d, double dt, double o, struct complex3 *e, struct complex3 *b,
	const struct complex3 *j)
{
	double k2 = 0;
	for (int c = 0; c < 3; c++)
		k2 += d->re[c] * d->re[c] + d->im[c] * d->im[c];
	const double w = y->c * sqrt(k2), half = sin(0.5 * w * dt), still = k2 > 0 ? 2 * half * half / k2 : 0, sine = k2 > 0 ? sin(w * dt) / w : dt;
	const struct complex3 f = curl(d, e, true), g = curl(d, b, false), i = curl(d, j, true);
	struct complex3 x = {0}, z = {0};
	add(&x, y->c * y->c * sine, b);
	add(&x, -still, &f);
	add(&z, -sine, e);
	add(&z, -still, &g);
	if (k2 > 0) {
		double cosine[2] = {sine, 0}, swing[2] = {still / (y->c * y->c), 0};
		if (o != 0)
			with_drift(w, o, dt, cosine, swing);
		add_times(&x, (dt - cosine[0]) / (k2 * y->eps0), -cosine[1] / (k2 * y->eps0), &i);
		add_times(&z, swing[0] / y->eps0, swing[1] / y->eps0, j);
	}
	const struct complex3 more = curl(d, &x, false), turned = curl(d, &z, true);
	add(e, -dt / y->eps0, j);
	add(e, 1, &more);
	add(b, 1, &turned);
}

static void advance_row(const struct pm_yee *y, const struct pm_yee_waves *w, double dt, size_t j, size_t k)
{
	const struct pm_wave_axis *a = w->axis;
	struct place p = {.w = w};
	struct complex3 d = {.re = {0, a[1].re[j], a[2].re[k]}, .im = {0, a[1].im[j], a[2].im[k]}};
	for (size_t i = w->chunk[0] * C; i < w->chunk[1] * C && i < a[0].modes; i++) {
		const size_t q = i % C;
		p.at = pm_yee_waves_at(w, i / C, j, k);
		const size_t mode[3] = {i, j, k};
		struct complex3 e = load(&p, E, q), b = load(&p, B, q), current = {0};
		for (int c = 0; c < 3 && y->j[c]; c++) {
			const double ratio = a[c].ratio[mode[c]], re = w->field[J + c][p.at + q] * ratio, im = w->field[J + c][p.at + C + q] * ratio;
			const double cosine = y->nodal ? a[c].turn[0][mode[c]] : 1, sine = y->nodal ? a[c].turn[1][mode[c]] : 0;
			current.re[c] = cosine * re - sine * im;
			current.im[c] = cosine * im + sine * re;
		}
		d.re[0] = a[0].re[i], d.im[0] = a[0].im[i];
		advance_wave(y, &d, dt, a[0].k[i] * y->drift[0] + a[1].k[j] * y->drift[1] + a[2].k[k] * y->drift[2], &e, &b, &current);
		const double norm = pm_yee_waves_shortest(w, i, j, k) ? 0 : w->norm;
		store(&p, E, q, &e, norm);
		store(&p, B, q, &b, norm);
	}
}

static int advance(const struct pm_yee *y, double dt)
{
	struct pm_yee_waves w;
	int status = pm_yee_waves_init(&w, y, y->j[0] ? 9 : 6);
	for (int c = 0; c < 3; c++) {
		status = pm_yee_waves_forward(status, &w, y->e[c], E + c);
		status = pm_yee_waves_forward(status, &w, y->b[c], B + c);
		if (y->j[c])
			status = pm_yee_waves_forward(status, &w, y->j[c], J + c);
	}
	const size_t wide = w.y[1] - w.y[0], rows = status ? 0 : wide * w.axis[2].n;
#pragma omp parallel for schedule(static) num_threads(pm_threads()) if (rows > 64)
	for (size_t i = 0; i < rows; i++)
		advance_row(y, &w, dt, i % wide + w.y[0], i / wide);
	for (int c = 0; c < 3; c++) {
		status = pm_yee_waves_backward(status, &w, E + c, y->e[c]);
		status = pm_yee_waves_backward(status, &w, B + c, y->b[c]);
	}
	pm_yee_waves_free(&w);
	return status;
}

static double limit(const struct pm_grid *g) { return g ? INFINITY : 0; }

const struct pm_maxwell maxwell_psatd = {
	.name = "psatd",
	.sentence = "every wave by its exact solution, without dispersion and limit of the step; periodic boxes",
	.source = "Vay, Haber and Godfrey 2013",
	.order = 0,
	.spectral = true,
	.limit = limit,
	.advance = advance,
};
