/* a(t) = exp(gamma t) (C cos(omega t) + S sin(omega t)) fitted to a part of a series, C and S complex: standing, travelling, or C alone where it does
 * not oscillate, or C exp(-i omega t) of a travelling wave within less than one and a half turns; for a column of diag also with a constant, exp(gamma
 * t) (B + C cos + S sin). Least squares of the residual over exp(gamma t), so that every e-folding counts the same: gamma and omega by Gauss and
 * Newton's method, the linear parameters projected out (Golub and Pereyra 1973). The standard error of gamma takes the residuals of neighbours as
 * correlated (Bartlett 1946), and the change of gamma between the halves of the window is added where it is larger than its own error. Cost: about 30
 * passes over the points. SPDX-License-Identifier: GPL-3.0-or-later */
#include "measure/exponential-fit.h"

enum { STEADY = 1, WAVE = 2, BEAT = 3, ROUNDS = 8 }; /* the number of functions: 1; cos, sin; 1, cos, sin */

static const double hopeless = 0.7; /* residual over envelope; it would be 1 without a fit */

struct fit { /* of points a..b-1, time from the middle in units of the length */
	const struct pm_series *s;
	size_t a, b;
	int shape;
	double middle, length, size; /* [time], [time], amplitude in the middle */
	double gamma, omega;         /* times length */
	double turn;                 /* times length: the rotation of the phase that is taken out of the points first */
	double c[3][2];              /* linear parameters, complex */
	double inverse[3][3];        /* of sum f f */
	double step[2], covariance, drift, drift_variance, residual;
};

static double at(const struct fit *f, size_t i) { return (f->s->t[i] - f->middle) / f->length; }

/* The point divided by the growth. */
static void scaled(const struct fit *f, size_t i, double t, double u[2])
{
	const double w = exp(-f->gamma * t) / f->size;
	const double c = f->turn != 0 ? cos(f->turn * t) : 1, s = f->turn != 0 ? sin(f->turn * t) : 0; /* times exp(-i turn t) */
	u[0] = (f->s->re[i] * c + f->s->im[i] * s) * w, u[1] = (f->s->im[i] * c - f->s->re[i] * s) * w;
}

static void functions(const struct fit *f, double t, double value[3], double slope[3])
{
	const double c = f->shape == STEADY ? 1 : cos(f->omega * t), s = f->shape == STEADY ? 0 : sin(f->omega * t);
	const double v[3] = {c, s, 1}, d[3] = {-s, c, 0};
	for (int k = 0; k < f->shape; k++)
		value[k] = v[k], slope[k] = d[k];
}

/* The inverse of a positive matrix of n <= 3 rows by Gauss and Jordan; false if it is singular. */
static bool invert(int n, double m[3][3], double inverse[3][3])
{
	for (int i = 0; i < n; i++)
		for (int j = 0; j < n; j++)
			inverse[i][j] = i == j;
	for (int p = 0; p < n; p++) {
		const double pivot = m[p][p];
		if (!(pivot > 1e-12))
			return false;
		for (int j = 0; j < n; j++)
			m[p][j] /= pivot, inverse[p][j] /= pivot;
		for (int i = 0; i < n; i++) {
			const double factor = i == p ? 0 : m[i][p];
			for (int j = 0; j < n; j++)
				m[i][j] -= factor * m[p][j], inverse[i][j] -= factor * inverse[p][j];
		}
	}
	return true;
}

/* The linear parameters for gamma and omega as they are. */
static bool solve_linear(struct fit *f)
{
	double m[3][3] = {{0}}, right[3][2] = {{0}}, v[3], d[3], u[2];
	for (size_t i = f->a; i < f->b; i++) {
		functions(f, at(f, i), v, d);
		scaled(f, i, at(f, i), u);
		for (int k = 0; k < f->shape; k++) {
			right[k][0] += v[k] * u[0], right[k][1] += v[k] * u[1];
			for (int l = 0; l < f->shape; l++)
				m[k][l] += v[k] * v[l];
		}
	}
	if (!invert(f->shape, m, f->inverse))
		return false;
	for (int k = 0; k < f->shape; k++)
		for (int p = 0; p < 2; p++) {
			f->c[k][p] = 0;
			for (int l = 0; l < f->shape; l++)
				f->c[k][p] += f->inverse[k][l] * right[l][p];
		}
	return true;
}

struct normal { double product[3][3], right[3], with[3][3][2]; }; /* derivatives by gamma, omega, drift: products, with the residual, with the functions */

/* Takes the part of the derivatives out that the linear parameters can represent. */
static void project(const struct fit *f, struct normal *n)
{
	for (int x = 0; x < 3; x++)
		for (int y = 0; y < 3; y++)
			for (int k = 0; k < f->shape; k++)
				for (int l = 0; l < f->shape; l++)
					for (int p = 0; p < 2; p++)
						n->product[x][y] -= n->with[x][k][p] * f->inverse[k][l] * n->with[y][l][p];
}

/* Residual, Gauss and Newton's step, the variance of gamma, and the drift of gamma (the coefficient of t^2 in the exponent). */
static bool solve_rates(struct fit *f)
{
	struct normal n = {{{0}}, {0}, {{{0}}}};
	double square = 0, envelope = 0, together = 0, before[2] = {0}, v[3], d[3], u[2];
	for (size_t i = f->a; i < f->b; i++) {
		const double t = at(f, i);
		double g[2] = {0}, h[2] = {0};
		functions(f, t, v, d);
		scaled(f, i, t, u);
		for (int k = 0; k < f->shape; k++)
			for (int p = 0; p < 2; p++)
				g[p] += f->c[k][p] * v[k], h[p] += f->c[k][p] * d[k];
		for (int p = 0; p < 2; p++) {
			const double derivative[3] = {t * g[p], t * h[p], t * t * g[p]}, r = u[p] - g[p];
			for (int x = 0; x < 3; x++) {
				n.right[x] += derivative[x] * r;
				for (int y = 0; y < 3; y++)
					n.product[x][y] += derivative[x] * derivative[y];
				for (int k = 0; k < f->shape; k++)
					n.with[x][k][p] += derivative[x] * v[k];
			}
			square += r * r, envelope += g[p] * g[p], together += i > f->a ? r * before[p] : 0;
			before[p] = r;
		}
	}
	project(f, &n);
	const int rates = f->shape == STEADY ? 1 : 2, parts = f->s->column ? 1 : 2;
	const double free = (double)(f->b - f->a) * parts - rates - f->shape * parts, near = square > 0 ? together / square : 0;
	const double correlation = fmin(fmax(near, 0), 0.95), variance = free > 0 ? square / free * (1 + correlation) / (1 - correlation) : NAN;
	double m[3][3], inverse[3][3];
	const int row[3] = {0, rates == 1 ? 2 : 1, 2}; /* gamma, then omega if there is one, then the drift */
	for (int with_drift = 0; with_drift < 2; with_drift++) {
		const int rows = rates + with_drift;
		for (int i = 0; i < rows; i++)
			for (int j = 0; j < rows; j++)
				m[i][j] = n.product[row[i]][row[j]];
		if (!invert(rows, m, inverse))
			return false;
		double x[3] = {0};
		for (int i = 0; i < rows; i++)
			for (int j = 0; j < rows; j++)
				x[i] += inverse[i][j] * n.right[row[j]];
		if (with_drift)
			f->drift = x[rates], f->drift_variance = inverse[rates][rates] * variance;
		else
			f->step[0] = x[0], f->step[1] = rates == 2 ? x[1] : 0, f->covariance = inverse[0][0] * variance;
	}
	f->residual = envelope > 0 ? sqrt(square / envelope) : NAN;
	return isfinite(f->residual);
}

static bool converge(struct fit *f)
{
	for (int round = 0; round < ROUNDS; round++) {
		if (!solve_linear(f) || !solve_rates(f) || f->residual > hopeless)
			return false;
		f->gamma += fmin(fmax(f->step[0], -2), 2); /* further at once and the weights are others */
		f->omega += fmin(fmax(f->step[1], -1), 1);
		if (fabs(f->step[0]) + fabs(f->step[1]) < 1e-6)
			break;
	}
	return f->omega >= 0 && fabs(f->step[0]) + fabs(f->step[1]) < 0.1;
}

/* The direction in the complex plane in which the points divided by the growth are largest. */
static void axis_of(const struct fit *f, const double mean[2], double axis[2])
{
	double re = 0, im = 0, u[2];
	for (size_t i = f->a; i < f->b; i++) {
		scaled(f, i, at(f, i), u);
		u[0] -= mean[0], u[1] -= mean[1];
		re += u[0] * u[0] - u[1] * u[1], im += 2 * u[0] * u[1];
	}
	axis[0] = cos(0.5 * atan2(im, re)), axis[1] = sin(0.5 * atan2(im, re));
}

/* omega times length from the changes of sign along the axis; 0 if there are less than three. A change counts when the value has passed a third of the rms on
 * both sides, so that noise at a zero counts once. */
static double turns(const struct fit *f)
{
	double mean[2] = {0}, axis[2], u[2], square = 0, first = 0, last = 0;
	size_t changes = 0;
	int side = 0;
	for (size_t i = f->a; i < f->b && f->s->column; i++) {
		scaled(f, i, at(f, i), u);
		mean[0] += u[0] / (double)(f->b - f->a);
	}
	axis_of(f, mean, axis);
	for (int pass = 0; pass < 2; pass++)
		for (size_t i = f->a; i < f->b; i++) {
			const double t = at(f, i);
			scaled(f, i, t, u);
			const double x = (u[0] - mean[0]) * axis[0] + (u[1] - mean[1]) * axis[1];
			if (!pass) {
				square += x * x / (double)(f->b - f->a);
				continue;
			}
			const int now = 9 * x * x < square ? 0 : x < 0 ? -1 : 1;
			if (now && side && now != side)
				first = changes ? first : t, last = t, changes++;
			side = now ? now : side;
		}
	return changes > 2 ? pm_pi * (double)(changes - 1) / (last - first) : 0;
}

/* The slope of the unwrapped phase, times length. */
static double rotation(const struct fit *f)
{
	double phase = 0, t1 = 0, p1 = 0, tt = 0, tp = 0;
	const double n = (double)(f->b - f->a);
	for (size_t i = f->a; i < f->b; i++) {
		const double t = at(f, i);
		const double *re = f->s->re, *im = f->s->im;
		if (i > f->a)
			phase += atan2(im[i] * re[i - 1] - re[i] * im[i - 1], re[i] * re[i - 1] + im[i] * im[i - 1]);
		t1 += t / n, p1 += phase / n, tt += t * t, tp += t * phase;
	}
	return (tp - n * t1 * p1) / (tt - n * t1 * t1);
}

/* The frequency near the one counted from which the fit is best. */
static void choose_frequency(struct fit *f, double counted)
{
	double best = HUGE_VAL, omega = counted;
	for (int j = -3; j <= 3; j++) {
		f->omega = counted + j * 0.5 * pm_pi;
		if (f->omega > 0.5 * pm_pi && solve_linear(f) && solve_rates(f) && f->residual < best)
			best = f->residual, omega = f->omega;
	}
	f->omega = omega;
}

static double envelope(const struct fit *f, double t)
{
	double sum = 0;
	for (int k = 0; k < f->shape; k++)
		sum += f->c[k][0] * f->c[k][0] + f->c[k][1] * f->c[k][1];
	return f->size * exp(f->gamma * t) * sqrt(sum);
}

bool pm_exponential_fit(const struct pm_series *s, size_t a, size_t b, double gamma, struct pm_exponential *e)
{
	const size_t mid = a + (b - a) / 2;
	struct fit steady = {.s = s, .a = a, .b = b, .middle = 0.5 * (s->t[a] + s->t[b - 1]), .length = s->t[b - 1] - s->t[a], .shape = STEADY};
	for (size_t i = mid > a ? mid - 1 : mid; i < b && (i <= mid + 1 || !(steady.size > 0)); i++)
		steady.size = fmax(steady.size, hypot(s->re[i], s->im[i]));
	if (!(steady.length > 0) || !(steady.size > 0))
		return false;
	steady.gamma = gamma * steady.length;
	struct fit wave = steady, *best = &steady;
	const double counted = turns(&steady);
	const bool straight = converge(&steady);
	wave.shape = s->column ? BEAT : WAVE;
	if (counted > 0 && b - a >= 8) {
		choose_frequency(&wave, counted);
		/* one and a half turns at least, and clearly better than no oscillation */
		if (converge(&wave) && wave.omega > 3 * pm_pi && (!straight || wave.residual < 0.7 * steady.residual))
			best = &wave;
	}
	/* a travelling wave in less than that: its phase turns by a radian at least, and without it the fit is clearly better */
	struct fit turned = steady;
	turned.gamma = gamma * steady.length;
	turned.turn = best == &steady && !s->column && b - a >= 8 ? rotation(&steady) : 0;
	const bool travels = fabs(turned.turn) > 1 && converge(&turned) && (!straight || turned.residual < 0.5 * steady.residual);
	if (travels)
		turned.omega = fabs(turned.turn), best = &turned;
	if (best == &steady && !straight)
		return false;
	const double drift = fmax(0, best->drift * best->drift - best->drift_variance), error = sqrt(best->covariance + drift);
	*e = (struct pm_exponential){.gamma = best->gamma / best->length, .omega = best->shape == STEADY && !travels ? 0 : best->omega / best->length,
		.error = error / best->length, .residual = best->residual, .first = envelope(best, -0.5), .last = envelope(best, 0.5)};
	return isfinite(error);
}
