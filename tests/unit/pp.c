/* Direct sums: the fixture PM-04, both fast loops against the plain one, every mollifier against its stated properties, any number of threads, close and
 * coincident pairs (HC-19). SPDX-License-Identifier: GPL-3.0-or-later */
#include <stdlib.h>
#include <string.h>

#include "check.h"
#include "far/pp.h"

enum { MOST = 1100 };

struct bodies {
	size_t n;
	double x[3][MOST], q[MOST];
};
struct sums {
	double g[3][MOST], phi[MOST];
	uint64_t coincident;
};

static uint64_t minstd(uint64_t *state) { return *state = 16807 * *state % 2147483647; }

/* n particles of mass 1/n in the unit cube; x, y, z of one particle are consecutive numbers. */
static struct bodies fixture(size_t n)
{
	struct bodies b = {.n = n};
	uint64_t state = 1;
	for (size_t i = 0; i < n; i++) {
		for (int d = 0; d < 3; d++)
			b.x[d][i] = (double)minstd(&state) / 2147483647.0;
		b.q[i] = 1.0 / (double)n;
	}
	return b;
}

static struct sums sum(const struct pm_pp *p, const struct bodies *b, size_t targets, bool plain, bool potential)
{
	static struct sums s;
	memset(&s, 0, sizeof s);
	const double *x[3] = {b->x[0], b->x[1], b->x[2]};
	double *g[3] = {s.g[0], s.g[1], s.g[2]};
	(plain ? pm_pp_plain : pm_pp_sum)(p, targets, b->n, x, b->q, g, potential ? s.phi : NULL, &s.coincident);
	return s;
}

/* PM-04: G = 1, so that the coefficient of lap phi is 4 pi. */
static void fixture_values(const char *name, bool half, bool plain, double eps, double u, const double a0[3], double rms)
{
	struct bodies b = fixture(1000);
	struct pm_pp p = {.dim = 3, .delta = eps, .mollifier = pm_mollifier_find("plummer"), .half = half};
	struct sums s = sum(&p, &b, b.n, plain, true);
	struct pm_sum energy = {0}, square = {0};
	char text[160];
	for (size_t i = 0; i < b.n; i++) {
		pm_sum_add(&energy, 0.5 * b.q[i] * 4 * pm_pi * s.phi[i]);
		for (int d = 0; d < 3; d++)
			pm_sum_add(&square, s.g[d][i] * s.g[d][i]);
	}
	snprintf(text, sizeof text, "PM-04: %s, eps %g: potential energy of the minstd fixture", name, eps);
	check_near(pm_sum_total(energy), u, 1e-13, text);
	snprintf(text, sizeof text, "PM-04: %s, eps %g: rms acceleration", name, eps);
	check_near(4 * pm_pi * sqrt(pm_sum_total(square) / (double)b.n), rms, 1e-12, text);
	for (int d = 0; d < 3; d++) {
		snprintf(text, sizeof text, "PM-04: %s, eps %g: component %d of the acceleration of particle 0", name, eps, d);
		check_near(-4 * pm_pi * s.g[d][0], a0[d], 1e-11, text); /* the reference has 12 digits */
	}
}

static void pm_04(void)
{
	const double bare[3] = {1.92402927877, 1.08042713489, -0.510656396488}, soft[3] = {1.90890639535, 1.07398591166, -0.511505973216};
	const char *names[] = {"full loop", "half loop", "plain loop"};
	uint64_t state = 1;
	for (int i = 0; i < 10000; i++)
		minstd(&state);
	check(state == 1043618065, "the random numbers of the fixture are minstd");
	for (int i = 0; i < 3; i++) {
		fixture_values(names[i], i == 1, i == 2, 0, -0.948594200251237, bare, 2.33233822183884);
		fixture_values(names[i], i == 1, i == 2, 0.02, -0.945179423083813, soft, 2.0039070942471);
	}
}

/* Largest difference of any component, relative to the largest value. */
static double difference(size_t n, const struct sums *a, const struct sums *b, int dim, bool potential)
{
	double most = 0, scale = 0, most_phi = 0, scale_phi = 0;
	for (size_t i = 0; i < n; i++) {
		for (int d = 0; d < dim; d++)
			check_worst(&most, fabs(a->g[d][i] - b->g[d][i])), check_worst(&scale, fabs(b->g[d][i]));
		check_worst(&most_phi, fabs(a->phi[i] - b->phi[i])), check_worst(&scale_phi, fabs(b->phi[i]));
	}
	most = scale > 0 ? most / scale : most;
	check_worst(&most, potential && scale_phi > 0 ? most_phi / scale_phi : 0);
	return most;
}

static void loops(const struct pm_mollifier *m, int dim)
{
	static const size_t sizes[] = {1, 2, 7, 33, 257};
	const bool long_one = m->square && dim == 3; /* several blocks of sources, many tiles */
	double worst = 0;
	for (int k = 0; k < 5 + long_one; k++)
		for (int v = 0; v < 8; v++) {
			struct bodies b = fixture(k < 5 ? sizes[k] : MOST - 3);
			for (size_t i = 0; i < b.n; i++)
				b.q[i] = i % 5 == 4 ? 0 : i % 3 ? 0.7 : -1.3; /* test particles and both signs */
			size_t targets = v & 4 ? (b.n + 1) / 2 : b.n;
			struct pm_pp p = {.dim = dim, .delta = m->bare ? 0 : 0.0385, .mollifier = m, .half = v & 1};
			struct sums fast = sum(&p, &b, targets, false, v & 2), plain = sum(&p, &b, targets, true, v & 2);
			check_worst(&worst, difference(targets, &fast, &plain, dim, v & 2));
			if (fast.coincident || plain.coincident)
				worst = INFINITY;
		}
	/* 1e-13: sums of 1100 terms of either sign, each good to 1e-15 */
	char text[128];
	snprintf(text, sizeof text, "%s in %d-D: half and full loop equal the plain loop", m->name, dim);
	check_near(worst, 0, 1e-13, text);
}

static void threads(void)
{
	struct bodies b = fixture(1037);
	for (int half = 0; half < 2; half++) {
		struct pm_pp p = {.dim = 3, .delta = 0.01, .mollifier = pm_mollifier_find("plummer"), .half = half};
		bool same = true;
		pm_threads_use(1);
		struct sums one = sum(&p, &b, b.n, false, true);
		for (int t = 2; t < 4; t++) {
			pm_threads_use(t);
			struct sums many = sum(&p, &b, b.n, false, true);
			same = same && !memcmp(&one, &many, sizeof one);
		}
		check(same, "the %s loop gives equal bytes for 1, 2 and 3 threads", half ? "half" : "full");
		double p_total = 0, scale = 0;
		for (size_t i = 0; i < b.n; i++)
			p_total += b.q[i] * one.g[0][i], scale += b.q[i] * fabs(one.g[0][i]);
		/* 1100 terms and as many additions, each good to 1e-16 */
		check_near(p_total / scale, 0, 1e-14, half ? "the half loop keeps momentum to round-off" : "the full loop keeps momentum to round-off");
	}
}

/* Derivative of the potential by r, centred differences of fourth order. */
static double slope(const struct pm_mollifier *m, double r, double delta, int dim)
{
	double h = 1e-3 * fmax(fmin(r, delta), 1e-2), y[4];
	const double at[] = {-2, -1, 1, 2};
	for (int i = 0; i < 4; i++)
		y[i] = m->potential((r + at[i] * h) * (r + at[i] * h), delta, dim);
	return ((y[0] - y[3]) + 8 * (y[2] - y[1])) / (12 * h);
}

static double bare_force(double r, int dim) { return dim == 1 ? 0.5 / r : dim == 2 ? 0.5 / (pm_pi * r * r) : 0.25 / (pm_pi * r * r * r); }
static double bare_potential(double r, int dim) { return dim == 1 ? 0.5 * r : dim == 2 ? 0.5 * log(r) / pm_pi : -0.25 / (pm_pi * r); }

static void promises(const struct pm_mollifier *m, const char *name, int dim)
{
	static const double at[] = {0.0123, 0.3, 0.77, 0.99, 1.01, 1.5, 3.3, 6.4};
	double delta = 0.85, worst = 0, far = 0, h[3], e[3];
	char text[128];
	check(!strcmp(m->name, name), "%s: the entry carries the name of its file", name);
	for (int i = 0; i < 8; i++) {
		double r = at[i] * delta, f = m->force(r * r, delta, dim);
		check_worst(&worst, fabs(slope(m, r, delta, dim) / (f * r) - 1));
	}
	snprintf(text, sizeof text, "%s in %d-D: the force is the derivative of the potential", name, dim);
	check_near(worst, 0, 1e-9, text); /* differences of fourth order with step 1e-3 leave 1e-11, round-off 1e-12 */
	double edge = (m->reach > 0 ? m->reach : 1) * delta, below = m->potential(edge * edge * (1 - 1e-10), delta, dim);
	snprintf(text, sizeof text, "%s in %d-D: the potential is continuous", name, dim);
	check_near(m->potential(edge * edge * (1 + 1e-10), delta, dim) / below, 1, 1e-8, text);
	check(isfinite(m->force(0, delta, dim)) && isfinite(m->potential(0, delta, dim)), "%s in %d-D: finite at r = 0", name, dim);
	double near = m->force(1e-12, delta, dim), zero = m->force(0, delta, dim);
	snprintf(text, sizeof text, "%s in %d-D: the force factor is smooth at r = 0", name, dim);
	if (!m->bare)
		check_near(near / zero, 1, 1e-9, text);
	for (int i = 0; i < 3; i++) {
		double r = delta * (40 << i);
		h[i] = 1.0 / (40 << i), e[i] = fabs(m->force(r * r, delta, dim) / bare_force(r, dim) - 1);
	}
	snprintf(text, sizeof text, "%s in %d-D: the force tends to the bare one", name, dim);
	if (m->order)
		check_order(3, h, e, m->order, text);
	for (double s = m->reach > 0 ? m->reach : 1; s < 40 && !m->order; s *= 1.7) {
		double r = s * delta;
		check_worst(&far, fabs(m->force(r * r, delta, dim) / bare_force(r, dim) - 1));
		check_worst(&far, fabs(m->potential(r * r, delta, dim) - bare_potential(r, dim)));
	}
	snprintf(text, sizeof text, "%s in %d-D: bare beyond its reach", name, dim);
	if (!m->order)
		check_near(far, 0, 4e-16, text);
}

/* The field of a Gaussian exp(-r^2)/pi^(dim/2), summed over a lattice of particles with the mollifier: its error falls as delta^order. */
static void fitted(const struct pm_mollifier *m, int dim, int order)
{
	static const double at[3][3] = {{0.3, 0.2, 0.1}, {0.7, -0.4, 0.5}, {1.1, 0.9, -0.2}};
	double h[3], e[3];
	char text[128];
	for (int k = 0; k < 3; k++) {
		const double delta = 0.16 * pow(0.8, k), spacing = delta / 1.5; /* overlap 1.5: the sum in place of the integral leaves 1e-9 */
		const int n = (int)(4.2 / spacing);
		h[k] = delta, e[k] = 0;
		for (int t = 0; t < 3; t++) {
			const double want = pm_mollifier_find("gaussian")->force(at[t][0] * at[t][0] + (dim > 1) * at[t][1] * at[t][1] +
				(dim > 2) * at[t][2] * at[t][2], 1, dim) * at[t][0];
			double sum = 0;
			for (int i = -n; i <= n; i++)
				for (int j = dim > 1 ? -n : 0; j <= (dim > 1 ? n : 0); j++)
					for (int l = dim > 2 ? -n : 0; l <= (dim > 2 ? n : 0); l++) {
						const double x = i * spacing, y = j * spacing, z = l * spacing, dx = at[t][0] - x,
							dy = dim > 1 ? at[t][1] - y : 0, dz = dim > 2 ? at[t][2] - z : 0;
						sum += exp(-x * x - y * y - z * z) * m->force(dx * dx + dy * dy + dz * dz, delta, dim) * dx;
					}
			check_worst(&e[k], fabs(sum * pow(spacing / sqrt(pm_pi), dim) - want));
		}
	}
	snprintf(text, sizeof text, "%s in %d-D: the field of a Gaussian", m->name, dim);
	check_order(3, h, e, order, text);
}

/* HC-19: a pair at distance r: its own forces and the force on a third particle. */
static void close_pair(double r, double eps, bool half)
{
	struct bodies b = {.n = 3, .q = {1, 1, 1}};
	b.x[0][1] = r, b.x[1][2] = 2;
	struct pm_pp p = {.dim = 3, .delta = eps, .mollifier = pm_mollifier_find("plummer"), .half = half};
	struct sums s = sum(&p, &b, 3, false, true);
	bool meets = r > 1e-100, finite = true; /* r^2 is not 0 */
	char text[160];
	for (int i = 0; i < 3; i++)
		for (int d = 0; d < 3; d++)
			finite = finite && isfinite(s.g[d][i]) && isfinite(s.phi[i]);
	check(finite, "HC-19: r = %g, eps = %g, %s loop: all finite", r, eps, half ? "half" : "full");
	double want = eps > 0 ? r / (eps * eps * eps) : meets ? 1 / (r * r) : 0;
	snprintf(text, sizeof text, "HC-19: r = %g, eps = %g, %s loop: the force of the pair", r, eps, half ? "half" : "full");
	want += r / pow(4 + r * r + eps * eps, 1.5); /* the third particle */
	check_near(want > 0 ? 4 * pm_pi * s.g[0][1] / want : 1 + s.g[0][1], 1, 1e-14, text);
	check(s.coincident == (!meets && eps == 0), "HC-19: r = %g, eps = %g, %s loop: %s", r, eps, half ? "half" : "full",
		!meets && eps == 0 ? "one coincident pair is counted" : "no coincident pair is counted");
}

int main(void)
{
	pm_04();
	for (int i = 0; pm_mollifiers[i]; i++)
		for (int dim = 1; dim < 4; dim++)
			if (pm_mollifiers[i]->dims >> dim & 1) {
				promises(pm_mollifiers[i], pm_mollifier_names[i], dim);
				loops(pm_mollifiers[i], dim);
			}
	for (int dim = 1; dim < 4; dim++) {
		fitted(pm_mollifier_find("gaussian"), dim, 2);
		fitted(pm_mollifier_find("gaussian-4"), dim, 4);
		fitted(pm_mollifier_find("gaussian-6"), dim, 6);
	}
	threads();
	for (int half = 0; half < 2; half++)
		for (int i = 0; i < 3; i++)
			close_pair((const double[]){1e-12, 1e-200, 0}[i], 0, half), close_pair((const double[]){1e-12, 1e-200, 0}[i], 0.01, half);
	return check_done();
}
