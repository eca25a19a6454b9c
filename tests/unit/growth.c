/* Growth rates and frequencies from series that are known. SPDX-License-Identifier: GPL-3.0-or-later */
#include <complex.h>

#include "check.h"
#include "measure/growth.h"

enum { SWINGS, RISES, TRAVELS, SATURATES, JITTERS };

static struct pm_growth fit(int kind, double gamma, double omega, double from, double to)
{
	struct pm_series s = {0};
	for (int i = 0; i < 300; i++) {
		const double t = 0.1 * i, size = 0.02385 * exp(gamma * t);
		double complex a = cexp(0.7 * I) * size * cos(omega * t + 0.3);
		a = kind == RISES ? cexp(0.7 * I) * size : kind == TRAVELS ? size * cexp(-I * omega * t) : a;
		a = kind == SATURATES ? cexp(0.7 * I) * (1e-4 * exp(gamma * t) + 1e-5 * cos(3 * t)) / (1 + 1e-4 * exp(gamma * t)) : a;
		a *= kind == JITTERS ? 1 + (i % 2 ? 0.01 : -0.01) : 1; /* several local maxima in each half wave */
		pm_series_add(&s, t, (double[]){creal(a), cimag(a)});
	}
	const struct pm_growth g = pm_growth_of(&s, from, to);
	pm_series_release(&s);
	return g;
}

static void modes(void)
{
	const struct pm_grid g = {.dim = 2, .cells = {48, 5, 1}, .points = {48, 6, 1}, .h = {0.1, 0.1, 1},
		.face = {{PM_PERIODIC, PM_PERIODIC}, {PM_NEUMANN, PM_NEUMANN}}};
	double values[48 * 6], a[2];
	for (int j = 0; j < 6; j++)
		for (int i = 0; i < 48; i++)
			values[48 * j + i] = 2.385 * cos(2 * pm_pi * 3 * i / 48.0 - 0.4) + 7 + sin(2 * pm_pi * i / 48.0);
	pm_mode(&g, values, 3, a);
	check_near(hypot(a[0], a[1]), 2.385, 1e-13, "the amplitude of a mode among others and a mean");
	check_near(atan2(a[1], a[0]), -0.4, 1e-13, "and its phase");
	pm_mode(&g, values, 2, a);
	check_near(hypot(a[0], a[1]), 0, 1e-13, "an absent mode is 0");
}

int main(void)
{
	/* the maxima of parabolas through points 0.1 apart are accurate to (omega h)^4/100 */
	struct pm_growth g = fit(SWINGS, -0.153, 1.416, NAN, NAN);
	check_near(g.gamma, -0.153, 1e-4, "a damped standing wave: gamma");
	check_near(g.omega, 1.416, 1e-3, "and omega");
	check(g.points == 300, "from all points if no window is given");
	g = fit(SWINGS, 0, 0.98, 3, 25);
	check_near(g.omega, 0.98, 1e-3, "a wave of constant amplitude: omega");
	check_near(g.gamma, 0, 1e-4, "and gamma");
	check(g.from >= 3 && g.to <= 25 && g.points > 200, "in the window given");
	g = fit(JITTERS, -0.02, 0.98, NAN, NAN);
	check_near(g.omega, 0.98, 5e-3, "a wave with noise on it, one peak for each half wave: omega");
	check_near(g.gamma, -0.02, 5e-4, "and gamma");
	g = fit(RISES, 0.35, 0, NAN, NAN);
	check_near(g.gamma, 0.35, 1e-12, "a wave that only grows: gamma");
	check_near(g.omega, 0, 0, "and no frequency");
	g = fit(TRAVELS, -0.1, 2.1, NAN, NAN);
	check_near(g.gamma, -0.1, 1e-12, "a travelling wave: gamma");
	check_near(g.omega, 2.1, 1e-12, "and omega from the phase");
	g = fit(SATURATES, 0.5, 0, NAN, NAN);
	check_near(g.gamma, 0.475, 0.03, "growth that saturates: between 1 and 10 % of the maximum"); /* 1/(1 + 0.1) of it at the upper end */
	check(g.from > 7 && g.to < 20, "and not before or after (%g to %g)", g.from, g.to);
	g = fit(SWINGS, 0, 1, 5, 5.05);
	check(isnan(g.gamma) && g.points < 2, "one point gives no growth rate");
	modes();
	return check_done();
}
