/* Growth rates and frequencies from series that are known. SPDX-License-Identifier: GPL-3.0-or-later */
#include <complex.h>
#include <string.h>

#include "check.h"
#include "measure/growth.h"

enum { SWINGS, RISES, TRAVELS, SATURATES, JITTERS, SETTLES, COSH, SQUARE, WHITE, THERMAL, SUNK, DROPS, SINKS, BOX };
enum { COUNT = 300 };

static struct pm_growth fit_of(int kind, int n, uint64_t seed, double gamma, double omega, double from, double to)
{
	struct pm_series s = {.column = kind == SQUARE};
	struct pm_growth g;
	double complex thermal = 0;
	for (int i = -COUNT; i < n; i++) {
		const double t = 0.1 * i, size = 0.02385 * exp(gamma * t);
		double z[2];
		pm_random_normal(seed, (uint64_t)(i + COUNT), 0, z);
		double complex a = cexp(0.7 * I) * size * cos(omega * t + 0.3);
		a = kind == RISES ? cexp(0.7 * I) * size : kind == TRAVELS ? size * cexp(-I * omega * t) : a;
		a = kind == SATURATES ? cexp(0.7 * I) * (1e-4 * exp(gamma * t) + 1e-5 * cos(3 * t)) / (1 + 1e-4 * exp(gamma * t)) : a;
		a *= kind == JITTERS ? 1 + (i % 2 ? 0.01 : -0.01) : 1; /* several local maxima in each half wave */
		a += kind == SETTLES ? 2e-4 * (z[0] + I * z[1]) + 0.01 * exp(-3 * t) : 0; /* noise of 1 %, and a second root that is gone soon */
		a = kind == COSH ? cosh(gamma * t) * 1e-4 : kind == SQUARE ? size * size * pow(cos(omega * t), 2) : a;
		a = kind == WHITE ? z[0] + I * z[1] : kind == BOX ? fmod(t, 5) < 2.5 : a;
		thermal = thermal * cexp((gamma + I * omega) * 0.1) + z[0] + I * z[1]; /* a damped wave that noise keeps alive; rms 8.2 for gamma = -0.15 */
		a = kind == SUNK ? exp(gamma * t) * cos(omega * t) + 0.25 * thermal / 8.2 : a;
		a = kind == DROPS ? (t < 12 ? exp(-0.15 * t) * cos(omega * t) : 0.25 * (z[0] + I * z[1])) : a;
		a = kind == SINKS ? (t < 10 ? exp(0.3 * (t - 10)) * cos(omega * t) : 0.02 * (z[0] + I * z[1])) : a;
		if (i >= 0)
			pm_series_add(&s, t, (double[]){creal(kind == THERMAL ? thermal : a), cimag(kind == THERMAL ? thermal : a)}, 0);
	}
	if (pm_growth_of(&s, from, to, &g))
		check(false, "the fit fails");
	pm_series_release(&s);
	return g;
}

static struct pm_growth fit(int kind, double gamma, double omega, double from, double to) { return fit_of(kind, COUNT, 1, gamma, omega, from, to); }

static void modes(void)
{
	const struct pm_grid g = {.dim = 2, .cells = {48, 5, 1}, .points = {48, 6, 1}, .h = {0.1, 0.1, 1},
		.face = {{PM_PERIODIC, PM_PERIODIC}, {PM_NEUMANN, PM_NEUMANN}}};
	double values[48 * 6], a[2];
	for (int j = 0; j < 6; j++)
		for (int i = 0; i < 48; i++)
			values[48 * j + i] = 2.385 * cos(2 * pm_pi * 3 * i / 48.0 - 0.4) + 7 + sin(2 * pm_pi * i / 48.0);
	pm_mode(&g, &(struct pm_field){0}, values, 3, a);
	check_near(hypot(a[0], a[1]), 2.385, 1e-13, "the amplitude of a mode among others and a mean");
	check_near(atan2(a[1], a[0]), -0.4, 1e-13, "and its phase");
	pm_mode(&g, &(struct pm_field){0}, values, 2, a);
	check_near(hypot(a[0], a[1]), 0, 1e-13, "an absent mode is 0");
}

static void exact(void)
{
	struct pm_growth g = fit(SWINGS, -0.153, 1.416, NAN, NAN);
	check_near(g.gamma, -0.153, 1e-9, "a damped standing wave: gamma");
	check_near(g.omega, 1.416, 1e-9, "and omega");
	check(g.points == COUNT && g.over_noise > 1e6 && !g.reason[0], "from all points if all are one exponential, and no noise");
	g = fit(SWINGS, 0, 0.98, 3, 25);
	check_near(g.omega, 0.98, 1e-9, "a wave of constant amplitude: omega");
	check_near(g.gamma, 0, 1e-9, "and gamma");
	check(g.from >= 3 && g.to <= 25 && g.points > 200, "in the window given");
	g = fit(RISES, 0.35, 0, NAN, NAN);
	check_near(g.gamma, 0.35, 1e-9, "a wave that only grows: gamma");
	check_near(g.omega, 0, 0, "and no frequency");
	g = fit(TRAVELS, -0.1, 2.1, NAN, NAN);
	check_near(g.gamma, -0.1, 1e-9, "a travelling wave: gamma");
	check_near(g.omega, 2.1, 1e-9, "and omega");
	g = fit(TRAVELS, 0.2, 0.15, 10, 29);
	check_near(g.gamma, 0.2, 1e-9, "a travelling wave that turns by less than half: gamma");
	check_near(g.omega, 0.15, 1e-9, "and omega");
	g = fit(SQUARE, -0.05, 0.7, NAN, NAN);
	check_near(g.gamma, -0.1, 1e-9, "an energy, the square of a damped wave: twice gamma");
	check_near(g.omega, 1.4, 1e-9, "and twice omega");
}

static void disturbed(void)
{
	struct pm_growth g = fit(JITTERS, -0.02, 0.98, NAN, NAN);
	check_near(g.omega, 0.98, 1e-3, "a wave with 1 % of jitter: omega");
	check_near(g.gamma, -0.02, 1e-4, "and gamma");
	g = fit(SATURATES, 0.5, 0, NAN, NAN);
	check_near(g.gamma, 0.5, 0.01, "growth that saturates: within 2 %");
	check(g.from > 3 && g.to < 19, "and not before or after (%g to %g)", g.from, g.to); /* at 18.4 it would be 1 */
	g = fit(COSH, 0.5, 0, NAN, NAN);
	check_near(g.gamma, 0.5, 0.001, "a wave that starts at rest, once its other half is gone");
	check(g.from > 2, "which the window leaves out (from %g)", g.from);
	double sum = 0, inside = 0;
	for (uint64_t seed = 1; seed <= 20; seed++) {
		g = fit_of(SETTLES, COUNT, seed, -0.15, 1.4, NAN, NAN);
		sum += (g.gamma + 0.15) / 20, inside += fabs(g.gamma + 0.15) < 2 * g.error;
		check(fabs(g.gamma + 0.15) < 0.004 && g.error < 0.002, "a damped wave in noise: gamma %g +- %g", g.gamma, g.error);
		check(g.to < 29 && g.over_noise > 5, "until it has sunk into it (%g, %g)", g.to, g.over_noise);
	}
	check_near(sum, 0, 0.0006, "without bias"); /* 3 standard errors of the mean of 20 */
	check(inside >= 16, "and the standard error is one: %g of 20 within two of them", inside);
}

/* No rate where there is none, whatever the seed. */
static void none(void)
{
	const uint64_t seeds = check_sanitized() ? 1 : 10;
	int found = 0;
	struct pm_growth g = fit(SWINGS, 0, 1, 5, 5.05);
	check(isnan(g.gamma) && g.points < 3 && strstr(g.reason, "too few"), "one point gives no growth rate: %s", g.reason);
	for (uint64_t seed = 1; seed <= seeds; seed++) {
		found += isfinite(fit_of(WHITE, 100, seed, 0, 0, NAN, NAN).gamma);
		found += isfinite(fit_of(WHITE, COUNT, seed, 0, 0, NAN, NAN).gamma);
		found += isfinite(fit_of(THERMAL, COUNT, seed, -0.5, 3, NAN, NAN).gamma);
		found += isfinite(fit_of(THERMAL, COUNT, seed, -1, 0, NAN, NAN).gamma);
	}
	check(found <= 1, "noise has no growth rate: %d of %d", found, 4 * (int)seeds);
	found = 0;
	for (uint64_t seed = 1; seed <= seeds; seed++)
		found += isfinite(fit_of(SUNK, COUNT, seed, -0.15, 1.4, NAN, NAN).gamma);
	check(found <= 1, "nor a damped wave among thermal ones of a quarter of its size: %d of %d", found, (int)seeds);
	g = fit(DROPS, 0, 1.4, NAN, NAN);
	check(isnan(g.gamma) && strstr(g.reason, "times the noise") && strstr(g.reason, "or several waves at once"),
			"nor one that is damped to noise of a quarter of its size: %g %s", g.gamma, g.reason);
	g = fit(SINKS, 0, 1.4, NAN, NAN);
	check(isnan(g.gamma) && strstr(g.reason, "short times"), "nor one that grows and is gone: %g %s", g.gamma, g.reason);
	g = fit(WHITE, 0, 0, NAN, NAN);
	check(strstr(g.reason, "noise") || strstr(g.reason, "no window is an exponential"), "and it is said: %s", g.reason);
	g = fit(WHITE, 0, 0, 3, 25);
	check(isnan(g.gamma) && strstr(g.reason, "the window is no exponential"), "in a window given too: %s", g.reason);
	g = fit(BOX, 0, 0, NAN, NAN);
	check(isnan(g.gamma), "a square wave of full height is no exponential (%g)", g.gamma);
	struct pm_series s = {0};
	for (int i = 0; i < COUNT; i++)
		pm_series_add(&s, i, (double[]){1e-17 * exp(0.1 * i / 10), 0}, 1);
	check(!pm_growth_of(&s, NAN, NAN, &g) && isnan(g.gamma) && strstr(g.reason, "rounding"), "nor has rounding: %s", g.reason);
	pm_series_release(&s);
}

int main(void)
{
	exact();
	disturbed();
	none();
	modes();
	return check_done();
}
