/* The table of steps against its stated properties: stability limits on both axes, orders, registers (TI-01); leapfrog on the oscillator (TI-02) and on an
 * eccentric Kepler orbit (HC-17, PM-10). SPDX-License-Identifier: GPL-3.0-or-later */
#include <complex.h>
#include <gsl/gsl_eigen.h>
#include <stdlib.h>
#include <string.h>

#include "check.h"
#include "step/step.h"

enum { MOST = 8 };

/* A system y' = rate(y) of m real numbers. */
struct problem {
	int m;
	void (*rate)(const double *y, double *k);
};

/* A pass of a composition; the first half of y are positions. */
static void composed(const struct pm_step *step, int pass, double dt, size_t half, double *y, const double *k)
{
	for (size_t i = 0; i < half; i++) {
		y[half + i] += dt * step->kicks[pass] * k[half + i];
		y[i] += dt * step->drifts[pass] * y[half + i];
	}
}

/* One whole step of a scheme; memory: registers that hold old rates, `known` of them; returns how many are known afterwards. */
static int whole_step(const struct pm_step *asked, const struct problem *p, double dt, double *y, double memory[2][MOST], int known)
{
	const struct pm_step *step = known < asked->rates ? pm_step_find(asked->start) : asked;
	double own[PM_REGISTERS][MOST] = {{0}}, k[MOST];
	double *q[PM_REGISTERS];
	for (int r = 0; r < PM_REGISTERS; r++)
		q[r] = step == asked && r < asked->rates ? memory[r] : own[r];
	for (int pass = 0; pass < step->passes; pass++) {
		p->rate(y, k);
		if (step->kicks) {
			composed(step, pass, dt, (size_t)p->m / 2, y, k);
			continue;
		}
		step->pass(pass, dt, (size_t)p->m, y, k, q);
		if (asked->rates && (asked->changes ? step != asked && pass + 1 == step->passes : pass == 0)) {
			memcpy(memory[1], memory[0], sizeof memory[0]);
			memcpy(memory[0], k, sizeof k);
		}
	}
	return known < asked->rates ? known + 1 : known;
}

/* A step dt of an error-controlled scheme, no shorter and no longer than that, each number of y for itself; q: its registers. With second, the first half of y
 * are positions that go with the velocities behind them. Returns the number of iterations. */
static int controlled_step(const struct pm_step *step, const struct problem *p, double dt, double *y, double (*q)[MOST], bool known, bool second)
{
	const struct pm_control *c = step->control;
	const size_t half = second ? (size_t)p->m / 2 : 0, n = (size_t)p->m - half;
	double k[MOST], before = 0;
	struct pm_control_line l = {.y = y + half, .y_start = q[PM_CONTROL_START] + half, .y_rest = q[PM_CONTROL_REST] + half, .k = k + half,
		.k_start = q[PM_CONTROL_RATE] + half};
	if (second)
		l.x = y, l.x_start = q[PM_CONTROL_START], l.x_rest = q[PM_CONTROL_REST];
	for (int i = 0; i < PM_CONTROL_TERMS; i++)
		l.series[i] = q[PM_CONTROL_SERIES + i] + half, l.foretold[i] = q[PM_CONTROL_FORETOLD + i] + half;
	p->rate(y, k);
	c->begin(1, n, &l);
	for (int iteration = 1;; iteration++) {
		struct pm_control_norms norms = {0, 0, {0}};
		for (int node = 1; node < c->nodes; node++) {
			c->place(node, dt, n, &l);
			p->rate(y, k);
			c->correct(node, n, &l, &norms);
		}
		const double change = norms.change / norms.rate;
		if (change < c->converged || (iteration > 2 && change >= before && change < c->rounding) || iteration == c->most_iterations) {
			c->end(dt, 1, known, n, &l);
			return iteration;
		}
		before = change;
	}
}

/* kick/2 drift kick/2, where the first half of y are positions. */
static void leapfrog(const struct problem *p, double dt, double *y)
{
	size_t half = (size_t)p->m / 2;
	const struct pm_step *kick = pm_step_find("kick"), *drift = pm_step_find("drift");
	double k[MOST];
	p->rate(y, k);
	kick->pass(0, dt / 2, half, y + half, k + half, NULL);
	drift->pass(0, dt, half, y, y + half, NULL);
	p->rate(y, k);
	kick->pass(0, dt / 2, half, y + half, k + half, NULL);
}

static double complex lambda;
static void linear(const double *y, double *k)
{
	double complex r = lambda * (y[0] + I * y[1]);
	k[0] = creal(r), k[1] = cimag(r);
}
static void oscillator(const double *y, double *k) { k[0] = y[1], k[1] = -y[0]; }
static void pendulum(const double *y, double *k) { k[0] = y[1], k[1] = -sin(y[0]); }
static void kepler(const double *y, double *k)
{
	double r2 = y[0] * y[0] + y[1] * y[1], f = 1 / (r2 * sqrt(r2));
	k[0] = y[2], k[1] = y[3], k[2] = -f * y[0], k[3] = -f * y[1];
}

/* Spectral radius of the map of one step on (y, old rates) at lambda dt = z. */
static double amplification(const struct pm_step *step, double complex z)
{
	const bool whole = step->kind == PM_SCHEME, split = !whole || step->kicks;
	struct problem p = {2, split ? oscillator : linear};
	int m = 2 + 2 * step->rates;
	double a[MOST * MOST], radius = 0;
	lambda = z;
	for (int c = 0; c < m; c++) {
		double y[MOST] = {0}, memory[2][MOST] = {{0}};
		double *part = c < 2 ? y : memory[(c - 2) / 2];
		part[c % 2] = 1;
		if (whole)
			whole_step(step, &p, split ? cimag(z) : 1, y, memory, step->rates);
		else
			leapfrog(&p, cimag(z), y);
		for (int r = 0; r < m; r++)
			a[r * m + c] = r < 2 ? y[r] : memory[(r - 2) / 2][r % 2];
	}
	gsl_matrix_view view = gsl_matrix_view_array(a, (size_t)m, (size_t)m);
	gsl_vector_complex *values = gsl_vector_complex_alloc((size_t)m);
	gsl_eigen_nonsymm_workspace *w = gsl_eigen_nonsymm_alloc((size_t)m);
	gsl_eigen_nonsymm(&view.matrix, values, w);
	for (int i = 0; i < m; i++) {
		gsl_complex v = gsl_vector_complex_get(values, (size_t)i);
		check_worst(&radius, hypot(GSL_REAL(v), GSL_IMAG(v)));
	}
	gsl_eigen_nonsymm_free(w), gsl_vector_complex_free(values);
	return radius;
}

/* Largest |z| along a direction for which nothing grows; 3e-14 above one is round-off, and hides growth like z^4/8 below z = 7e-4. */
static double limit(const struct pm_step *step, double complex direction)
{
	const double scan = step->kicks ? 2e-4 : 0.05; /* the first gap of blanes-moan6, at pi, is 6e-4 wide */
	double lo = 0, hi = 0;
	while (hi < 16 && amplification(step, (hi + scan) * direction) <= 1 + 3e-14)
		hi += scan;
	for (lo = hi, hi += scan; hi - lo > 1e-9;) {
		double mid = 0.5 * (lo + hi);
		*(amplification(step, mid * direction) <= 1 + 3e-14 ? &lo : &hi) = mid;
	}
	return lo;
}

static void limits(const struct pm_step *s, const char *name)
{
	char text[128];
	/* 1e-3: the tolerance of the reference table */
	snprintf(text, sizeof text, "TI-01, limits: %s on the imaginary axis as claimed", name);
	check_near(limit(s, I), s->imaginary_limit, 1e-3, text);
	snprintf(text, sizeof text, "TI-01, limits: %s on the real axis as claimed", name);
	if (!isnan(s->real_limit) && !s->kicks)
		check_near(limit(s, -1), s->real_limit, 1e-3, text);
}

/* Schemes without a stable oscillation: at |lambda| dt = doubling it doubles within a period, 2 pi/doubling steps. */
static void doubling(const struct pm_step *s, const char *name)
{
	char text[128];
	snprintf(text, sizeof text, "%s: an oscillation doubles within its period at the entry's limit", name);
	if (s->imaginary_limit == 0)
		check_near(pow(amplification(s, I * s->doubling), 2 * pm_pi / s->doubling), 2, 1e-9, text);
	else
		check(s->doubling == 0, "%s: no such limit where oscillations are stable", name);
}

/* Error of the pendulum at t = 2 with n steps, against many of rk4, or 100 of blanes-moan6 (round-off 3e-15) where the order is higher. */
static double pendulum_error(const struct pm_step *s, int n)
{
	struct problem p = {2, pendulum};
	double y[2] = {1.1, 0.4}, exact[2] = {1.1, 0.4}, memory[2][MOST] = {{0}};
	const int many = s->order < 6 ? 4000 : 100;
	for (int i = 0; i < many; i++)
		whole_step(pm_step_find(s->order < 6 ? "rk4" : "blanes-moan6"), &p, 2.0 / many, exact, memory, 0);
	memset(memory, 0, sizeof memory);
	for (int i = 0, known = 0; i < n; i++)
		if (s->kind == PM_SCHEME)
			known = whole_step(s, &p, 2.0 / n, y, memory, known);
		else
			leapfrog(&p, 2.0 / n, y);
	return hypot(y[0] - exact[0], y[1] - exact[1]);
}

static void orders(const struct pm_step *s, const char *name)
{
	double h[4], e[4];
	char text[128];
	for (int i = 0; i < 4; i++) {
		int n = (s->order < 6 ? 37 : 3) << i; /* with more steps round-off shows in order 6 */
		h[i] = 2.0 / n, e[i] = pendulum_error(s, n);
	}
	snprintf(text, sizeof text, "TI-01: %s: order of a nonlinear pendulum from four steps", name);
	check_order(4, h, e, s->order, text);
	check(log(e[2] / e[3]) / log(2) < s->order + 0.3, "TI-01: %s: and it is no higher than claimed (%.3f)", name, log(e[2] / e[3]) / log(2));
}

/* Root mean square error of one step of the pendulum from 30 places of its swing, against 20 shorter ones, whose truncation is below round-off. */
static double controlled_error(const struct pm_step *s, double dt, bool second)
{
	struct problem p = {2, pendulum};
	double from[2] = {1.1, 0.4}, sum = 0;
	for (int start = 0; start < 30; start++) {
		double y[2] = {from[0], from[1]}, exact[2] = {from[0], from[1]}, q[PM_REGISTERS][MOST] = {{0}}, fine[PM_REGISTERS][MOST] = {{0}};
		for (int i = 0; i < 20; i++)
			controlled_step(s, &p, dt / 20, exact, fine, i > 0, true);
		controlled_step(s, &p, dt, y, q, false, second);
		sum += pow(y[0] - exact[0], 2) + pow(y[1] - exact[1], 2);
		memset(fine, 0, sizeof fine);
		controlled_step(s, &p, 0.22, from, fine, false, true);
	}
	return sqrt(sum / 30);
}

/* Errors of 3e-15 to 8e-13: rounding below, 12 iterations above are no limit. */
static void controlled(const struct pm_step *s)
{
	double h[3], e[3];
	for (int i = 0; i < 3; i++)
		h[i] = 0.7 + 0.15 * i, e[i] = controlled_error(s, h[i], true);
	check_order(3, h, e, s->order, "ias15: order of a pendulum from three steps");
	check(e[2] < 1e-12, "ias15: a step of a sixth of a swing is right to 1e-12 (%.3g)", e[2]);
	/* a hundredth of the error of twice the step; rounding is 1e-16 */
	check_near(controlled_error(s, 0.35, false), 0, 3e-15, "ias15: equations of first order alone are as good with a shorter step");
}

/* Error of the pendulum at t = 2 in n steps of one length: of the member that is taken, and *other: of a run with the member it is compared with. */
static double pair_error(const struct pm_step *s, int n, double *other)
{
	const struct pm_embedded *e = s->embedded;
	struct problem p = {2, pendulum};
	double end[2][2], exact[2] = {1.1, 0.4}, memory[2][MOST] = {{0}};
	for (int i = 0; i < 100; i++)
		whole_step(pm_step_find("blanes-moan6"), &p, 0.02, exact, memory, 0);
	for (int lower = 0; lower < 2; lower++) {
		double y[2] = {1.1, 0.4}, dt = 2.0 / n;
		for (int i = 0; i < n; i++) {
			double k[PM_EMBEDDED_STAGES][2], at[2] = {0};
			for (int stage = 0; stage < e->stages; stage++) {
				for (int c = 0; c < 2; c++) {
					at[c] = y[c];
					for (int j = 0; j < stage; j++)
						at[c] += dt * e->a[stage][j] * k[j][c];
				}
				p.rate(at, k[stage]);
			}
			for (int c = 0; c < 2; c++) {
				y[c] = at[c];
				for (int j = 0; j < e->stages && lower; j++)
					y[c] -= dt * e->error[j] * k[j][c];
			}
		}
		memcpy(end[lower], y, sizeof y);
	}
	*other = hypot(end[1][0] - exact[0], end[1][1] - exact[1]);
	return hypot(end[0][0] - exact[0], end[0][1] - exact[1]);
}

static void pair(const struct pm_step *s)
{
	const struct pm_embedded *e = s->embedded;
	double h[3], high[3], low[3], sums = 0, zero = 0;
	char text[128];
	for (int i = 0; i < 3; i++)
		h[i] = 2.0 / (20 << i), high[i] = pair_error(s, 20 << i, &low[i]);
	snprintf(text, sizeof text, "%s: order of the member that is taken, a pendulum in three step lengths", s->name);
	check_order(3, h, high, s->order, text);
	snprintf(text, sizeof text, "%s: order of the member it is compared with", s->name);
	check_order(3, h, low, e->order, text);
	for (int i = 0; i < e->stages; i++) {
		double sum = -e->at[i];
		for (int j = 0; j < i; j++)
			sum += e->a[i][j];
		check_worst(&sums, fabs(sum));
		zero += e->error[i];
	}
	/* round-off of a dozen fractions of up to 30 */
	check_near(sums, 0, 1e-14, "the times of the stages are the sums of their rows");
	check_near(zero, 0, 1e-15, "the difference of the two members is no step");
}

static void promises(const struct pm_step *s, const char *name)
{
	check(!strcmp(s->name, name), "%s: the entry carries the name of its file", name);
	if (pm_step_decides(s)) {
		check(s->registers <= PM_REGISTERS, "%s: its registers are there", name);
		return;
	}
	check(s->passes <= PM_STEP_PASSES && pm_step_at(s, s->passes - 1) == 1, "%s: the last pass ends at the end of the step", name);
	double kicks = 0, drifts = 0, odd = 0;
	for (int i = 0; s->kicks && i < s->passes; i++) {
		kicks += s->kicks[i], drifts += s->drifts[i];
		check_worst(&odd, fabs(s->kicks[i] - s->kicks[s->passes - 1 - i]));
		check_worst(&odd, i + 1 < s->passes ? fabs(s->drifts[i] - s->drifts[s->passes - 2 - i]) : fabs(s->drifts[i]));
	}
	/* round-off of the printed digits of a dozen coefficients */
	check(!s->kicks || (fabs(kicks - 1) < 1e-14 && fabs(drifts - 1) < 1e-14 && odd == 0), "%s: a symmetric composition of one step", name);
	const struct pm_step *start = s->start ? pm_step_find(s->start) : NULL;
	check(!s->rates == !start && s->rates + (start ? start->registers : s->registers) <= PM_REGISTERS,
		"%s: its old rates and its starting scheme fit into the registers", name);
}

/* TI-02: cos(theta) = 1 - (w dt)^2/2, and (v^2 + w^2 (1 - w^2 dt^2/4) x^2)/2 is constant. */
static void verlet(double dt, double phase)
{
	struct problem p = {2, oscillator};
	double y[2] = {1, 0}, a = sqrt(1 - dt * dt / 4), shadow = 0, turned = 0, last = 0;
	int n = 5000;
	for (int i = 0; i < n; i++) {
		leapfrog(&p, dt, y);
		double angle = atan2(-y[1] / a, y[0]), step = angle - last;
		turned += step - 2 * pm_pi * floor(step / (2 * pm_pi) + 0.5);
		last = angle;
		check_worst(&shadow, fabs(0.5 * (y[1] * y[1] + a * a * y[0] * y[0]) - 0.5 * a * a));
	}
	char text[128];
	snprintf(text, sizeof text, "TI-02: leapfrog at w dt = %g turns by the reference angle per step", dt);
	check_near(turned / n, phase, 1e-13, text);
	snprintf(text, sizeof text, "TI-02: leapfrog at w dt = %g keeps the shadow energy over %d steps", dt, n);
	check_near(shadow, 0, 1e-13, text);
}

static double energy(const double *y) { return 0.5 * (y[2] * y[2] + y[3] * y[3]) - 1 / hypot(y[0], y[1]); }

/* Direction of the apocentre, from the Laplace-Runge-Lenz vector. */
static double apsis(const double *y)
{
	double l = y[0] * y[3] - y[1] * y[2], r = hypot(y[0], y[1]);
	return atan2(-(-l * y[2] - y[1] / r), -(l * y[3] - y[0] / r));
}

/* HC-17: e = 0.9, 1000 steps per orbit, 1000 orbits. */
static void long_orbit(void)
{
	struct problem p = {4, kepler};
	double y[4] = {-1.9, 0, 0, -sqrt(0.1 / 1.9)}, dt = 2 * pm_pi / 1000, e0 = energy(y), worst = 0, turned = 0, last = apsis(y), rv = -1;
	double sn = 0, st = 0, stt = 0, se = 0, ste = 0;
	int orbits = 0;
	for (int i = 0; i < 1000000; i++) {
		leapfrog(&p, dt, y);
		double now = y[0] * y[2] + y[1] * y[3];
		if (rv > 0 && now <= 0) { /* just past the apocentre */
			double angle = apsis(y), de = energy(y) / e0 - 1, d = angle - last;
			turned += d - 2 * pm_pi * floor(d / (2 * pm_pi) + 0.5);
			last = angle, check_worst(&worst, fabs(de)), orbits++;
			sn++, st += orbits, stt += (double)orbits * orbits, se += de, ste += orbits * de;
		}
		rv = now;
	}
	double slope = (sn * ste - st * se) / (sn * stt - st * st);
	check(orbits >= 990, "HC-17: %d orbits were followed", orbits);
	check_near(worst, 0, 1e-8, "HC-17: leapfrog on e = 0.9: |dE/E| at the apocentre stays below 1e-8 for 1000 orbits");
	check_near(slope * orbits, 0, 1e-9, "HC-17: and has no trend");
	check_near(turned / orbits, -1.0773e-2, 1.0773e-4, "HC-17: precession -1.0773e-2 rad per orbit within 1 percent");
}

/* PM-10: position after whole periods; the scheme is the same, so only round-off and its growth may differ. */
static void orbit(const char *scheme, int steps, int orbits, double x0, double y0, double tolerance)
{
	struct problem p = {4, kepler};
	double y[4] = {-1.9, 0, 0, -sqrt(0.1 / 1.9)}, memory[2][MOST] = {{0}};
	for (int i = 0; i < steps * orbits; i++)
		if (strcmp(scheme, "kdk"))
			whole_step(pm_step_find(scheme), &p, 2 * pm_pi / steps, y, memory, 0);
		else
			leapfrog(&p, 2 * pm_pi / steps, y);
	char text[128];
	snprintf(text, sizeof text, "PM-10: Kepler e = 0.9, %s, %d steps per orbit, %d orbits: x", scheme, steps, orbits);
	check_near(y[0], x0, tolerance, text);
	snprintf(text, sizeof text, "PM-10: Kepler e = 0.9, %s, %d steps per orbit, %d orbits: y", scheme, steps, orbits);
	check_near(y[1], y0, tolerance, text);
}

/* A ring of vortices seen from its centre: r' = u, u r = 1 across r. */
static void ring(const double *y, double *k)
{
	double r2 = y[0] * y[0] + y[1] * y[1];
	k[0] = -y[1] / r2, k[1] = y[0] / r2;
}

/* Of one step, times from r = 1: rk2 evaluates its second pass at r sqrt(1 + dt^2) and ends at r sqrt(1 + dt^4/(4 (1 + dt^2))); midpoint at r. */
static void vortex(double dt)
{
	struct problem p = {2, ring};
	double heun[2] = {1, 0}, middle[2] = {1, 0}, memory[2][MOST] = {{0}};
	char text[128];
	whole_step(pm_step_find("rk2"), &p, dt, heun, memory, 0);
	whole_step(pm_step_find("midpoint"), &p, dt, middle, memory, 0);
	snprintf(text, sizeof text, "rk2 makes a ring of vortices grow by (Omega dt)^4/8, Omega dt = %g", dt);
	check_near(hypot(heun[0], heun[1]), sqrt(1 + pow(dt, 4) / (4 * (1 + dt * dt))), 1e-15, text);
	snprintf(text, sizeof text, "midpoint keeps its radius, Omega dt = %g", dt);
	check_near(hypot(middle[0], middle[1]), 1, 1e-15, text);
	snprintf(text, sizeof text, "midpoint turns it by 2 atan(Omega dt/2), Omega dt = %g", dt);
	check_near(atan2(middle[1], middle[0]), 2 * atan(dt / 2), 1e-15, text);
}

int main(void)
{
	vortex(0.1), vortex(0.3851), vortex(1.7);
	for (int i = 0; pm_steps[i]; i++) {
		promises(pm_steps[i], pm_step_names[i]);
		if (pm_steps[i]->control) {
			controlled(pm_steps[i]);
			continue;
		}
		if (pm_steps[i]->embedded)
			pair(pm_steps[i]);
		if (pm_step_decides(pm_steps[i])) /* an implicit one needs the passes of a sentence: tests/tool/implicit.bats */
			continue;
		limits(pm_steps[i], pm_step_names[i]);
		doubling(pm_steps[i], pm_step_names[i]);
		orders(pm_steps[i], pm_step_names[i]);
	}
	verlet(0.1, 0.10004171361154);
	verlet(0.5, 0.505360510284157);
	orbit("kdk", 1000, 1, -1.899890053, 0.02043960759, 1e-8);
	orbit("kdk", 1000, 10, -1.889015833, 0.2040059636, 1e-6);
	orbit("kdk", 4000, 10, -1.899956311, 0.01288462278, 1e-6);
	orbit("rk4", 1000, 10, -1.889329315, -0.03909421541, 1e-6);
	orbit("rk4", 4000, 10, -1.899993061, -4.399275757e-05, 1e-6);
	long_orbit();
	return check_done();
}
