/* IAS15: Gauss-Radau integration of order 15 with its step chosen by its error. The rate of a step is a polynomial in h = t/dt,
 *   a(h) = a0 + b0 h + ... + b6 h^7 = a0 + h (g0 + (h - h1)(g1 + (h - h2)(g2 + ...))),
 * whose g are found by the rates at the nodes h1 to h7, again and again until b6 stays the same; v and x are its integrals. Steps have |b6| = epsilon |a0|
 * at most; sums are compensated (Kahan 1965), so that rounding alone lets the energy walk at random (Brouwer 1937).
 * Source: Rein and Spiegel 2015, MNRAS 446, 1424; Everhart 1985, in Dynamics of comets, 185. The nodes are the zeros of P7 + P8 on [0, 1].
 * Rates must be smooth: fields of bodies, not of meshes with kernels of low order. Usually two iterations, 15 evaluations of the force; 17 registers.
 * SPDX-License-Identifier: GPL-3.0-or-later */
#include "step/step.h"

enum { TERMS = PM_CONTROL_TERMS };

static const double node[TERMS + 1] = {0, 0.0562625605369221464656521910323, 0.180240691736892364987579942809, 0.352624717113169637373907770171,
	0.547153626330555383001448557652, 0.734210177215410531523210608307, 0.885320946839095768090359762932, 0.977520613561287501891174500429};

/* to[i] = sum over k >= i of row[k][i] from[k]: from the coefficients of one form of the polynomial to those of the other. */
struct basis {
	double row[TERMS][TERMS];
};

/* (h - h1)...(h - hk) as powers of h. All terms of a sum have one sign. */
static struct basis powers_of_products(void)
{
	struct basis b = {{{1}}};
	for (int k = 1; k < TERMS; k++)
		for (int i = 0; i <= k; i++)
			b.row[k][i] = (i ? b.row[k - 1][i - 1] : 0) - node[k] * b.row[k - 1][i];
	return b;
}

/* h^k as such products. */
static struct basis products_of_powers(void)
{
	struct basis b = {{{1}}};
	for (int k = 1; k < TERMS; k++)
		for (int i = 0; i <= k; i++)
			b.row[k][i] = (i ? b.row[k - 1][i - 1] : 0) + node[i + 1] * b.row[k - 1][i];
	return b;
}

static void convert(const struct basis *b, const double from[TERMS], double to[TERMS])
{
	for (int i = 0; i < TERMS; i++) {
		to[i] = 0;
		for (int k = TERMS - 1; k >= i; k--)
			to[i] += b->row[k][i] * from[k];
	}
}

static void take(double *const from[TERMS], size_t i, double to[TERMS])
{
	for (int k = 0; k < TERMS; k++)
		to[k] = from[k][i];
}

static void put(double *const to[TERMS], size_t i, const double from[TERMS])
{
	for (int k = 0; k < TERMS; k++)
		to[k][i] = from[k];
}

/* Coefficients of powers of t/dt as those of powers of t/(ratio dt). */
static void stretch(double b[TERMS], double ratio)
{
	double q = 1;
	for (int k = 0; k < TERMS; k++)
		b[k] *= q *= ratio;
}

/* The powers about the end of the step, where t/dt = 1: the binomial theorem. */
static void shift(const double b[TERMS], double to[TERMS])
{
	for (int i = 0; i < TERMS; i++) {
		double binomial = 1;
		to[i] = 0;
		for (int k = i; k < TERMS; k++) {
			to[i] += binomial * b[k];
			binomial = binomial * (k + 2) / (k + 1 - i);
		}
	}
}

static void begin(double ratio, size_t n, const struct pm_control_line *l)
{
	const struct basis powers = powers_of_products(), products = products_of_powers();
	for (size_t i = 0; i < n; i++) {
		l->y_start[i] = l->y[i];
		l->k_start[i] = l->k[i];
		if (l->x)
			l->x_start[i] = l->x[i];
	}
	for (size_t i = 0; i < n && ratio != 1; i++) {
		double g[TERMS], b[TERMS], e[TERMS];
		take(l->series, i, g), take(l->foretold, i, e);
		convert(&powers, g, b);
		stretch(b, ratio), stretch(e, ratio);
		convert(&products, b, g);
		put(l->series, i, g), put(l->foretold, i, e);
	}
}

static void correct(int at, size_t n, const struct pm_control_line *l, struct pm_control_norms *norms)
{
	for (size_t i = 0; i < n; i++) {
		double g = (l->k[i] - l->k_start[i]) / node[at];
		for (int k = 1; k < at; k++)
			g = (g - l->series[k - 1][i]) / (node[at] - node[k]);
		if (at == TERMS) {
			norms->rate = fmax(norms->rate, fabs(l->k[i]));
			norms->change = fmax(norms->change, fabs(g - l->series[at - 1][i]));
			norms->term[at - 1] = fmax(norms->term[at - 1], fabs(g));
			for (int k = 0; k < at - 1; k++)
				norms->term[k] = fmax(norms->term[k], fabs(l->series[k][i]));
		}
		l->series[at - 1][i] = g;
	}
}

static void place(int at, double dt, size_t n, const struct pm_control_line *l)
{
	const struct basis powers = powers_of_products();
	const double h = node[at], s = dt * h;
	for (size_t i = 0; i < n; i++) {
		double g[TERMS], b[TERMS], y = 0, x = 0;
		take(l->series, i, g);
		convert(&powers, g, b);
		for (int k = TERMS - 1; k >= 0; k--) {
			y = h * (y + b[k] / (k + 2));
			x = h * (x + b[k] / ((k + 2) * (k + 3)));
		}
		l->y[i] = l->y_start[i] + (l->y_rest[i] + s * (l->k_start[i] + y));
		if (l->x)
			l->x[i] = l->x_start[i] + (l->x_rest[i] + s * (l->y_start[i] + s * (l->k_start[i] / 2 + x)));
	}
}

/* The sum as the nearest number and what that leaves out, to the last bit (Knuth 1969). */
static void add(double *sum, double *rest, double term)
{
	const double more = *rest + term, a = *sum, s = a + more, part = s - a;
	*rest = (a - (s - part)) + (more - part);
	*sum = s;
}

static void end(double dt, double ratio, bool known, size_t n, const struct pm_control_line *l)
{
	const struct basis powers = powers_of_products(), products = products_of_powers();
	for (size_t i = 0; i < n; i++) {
		double g[TERMS], b[TERMS], e[TERMS], next[TERMS];
		take(l->series, i, g), take(l->foretold, i, e);
		convert(&powers, g, b);
		if (l->x) {
			double x = l->x_start[i], rest = l->x_rest[i];
			for (int k = TERMS - 1; k >= 0; k--)
				add(&x, &rest, b[k] / ((k + 2) * (k + 3)) * dt * dt);
			add(&x, &rest, l->k_start[i] / 2 * dt * dt);
			add(&x, &rest, l->y_rest[i] * dt);
			add(&x, &rest, l->y_start[i] * dt);
			l->x[i] = x, l->x_rest[i] = rest;
		}
		double y = l->y_start[i], rest = l->y_rest[i];
		for (int k = TERMS - 1; k >= 0; k--)
			add(&y, &rest, b[k] / (k + 2) * dt);
		add(&y, &rest, l->k_start[i] * dt);
		l->y[i] = y, l->y_rest[i] = rest;
		/* the same polynomial goes on, and is wrong by as much as it was in this step; not where the next is another sort of step */
		shift(b, next);
		stretch(next, ratio <= 20 ? ratio : 0);
		for (int k = 0; k < TERMS; k++) {
			b[k] = next[k] + (known && ratio <= 20 ? b[k] - e[k] : 0);
			e[k] = next[k];
		}
		convert(&products, b, g);
		put(l->series, i, g), put(l->foretold, i, e);
	}
}

static void reject(double ratio, size_t n, const struct pm_control_line *l)
{
	const struct basis products = products_of_powers();
	for (size_t i = 0; i < n; i++) {
		double g[TERMS], e[TERMS];
		take(l->foretold, i, e);
		stretch(e, ratio);
		convert(&products, e, g);
		put(l->series, i, g), put(l->foretold, i, e);
	}
}

static const struct pm_control control = {
	.nodes = TERMS + 1,
	.at = node,
	.most_iterations = 12,
	.converged = 1e-16,
	.rounding = 1e-6, /* 4600 (the seventh divided difference) times 1e-16 of a position over the distance of a pair */
	.power = 7,
	.factor = 0.25,
	.begin = begin,
	.correct = correct,
	.place = place,
	.end = end,
	.reject = reject,
};

const struct pm_step step_ias15 = {
	.name = "ias15",
	.sentence = "Gauss-Radau scheme with error control, order 15",
	.source = "Rein and Spiegel 2015",
	.kind = PM_SCHEME,
	.passes = 15,
	.registers = PM_REGISTERS,
	.order = 15,
	.real_limit = NAN,
	.control = &control,
};
