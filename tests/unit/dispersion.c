/* The Faddeeva function against values of 15 digits, and roots of the dispersion relation against the reference cases.
 * SPDX-License-Identifier: GPL-3.0-or-later */
#include "check.h"
#include "plasma/bernstein.h"
#include "plasma/dispersion.h"

static void faddeeva(void)
{
	/* z, w: computed by Poppe and Wijers' algorithm (scipy.special.wofz, 1e-13), and exp(y^2) erfc(y) on the axis */
	static const double of[][4] = {{0.5, 0.5, 0.5331567079121748, 0.2304882313844585}, {1, 0, 0.36787944117144233, 0.6071577058413937},
		{3, 0.1, 0.007942680998770001, 0.20074234309867764}, {6, 1e-3, 1.6375340027605402e-05, 0.0953962061132771},
		{0.1, -0.5, 1.9176871281230734, 0.3048738022064808}, {2, -1, -0.20532558064658757, 0.14685548503016754},
		{30, 0, 0, 0.01881678486866075}, {1e-3, 20, 0.02817434867105165, 1.405217449977124e-06}, {0, 0.25, 0.770346547730997, 0}};
	for (size_t i = 0; i < sizeof of / sizeof *of; i++) {
		const double complex z = of[i][0] + I * of[i][1], want = of[i][2] + I * of[i][3], got = pm_faddeeva(z);
		check(cabs(got - want) < 3e-14 * cabs(want), "w(%g + %g i): relative error %.2g", of[i][0], of[i][1], cabs(got - want) / cabs(want));
		check(cabs(pm_faddeeva(-conj(z)) - conj(got)) < 1e-15 * cabs(got), "w(-conj z) = conj w(z) at %g + %g i", of[i][0], of[i][1]);
	}
	for (double y = 0; y < 20; y += 0.37)
		check(fabs(creal(pm_faddeeva(I * y)) - (y < 20 ? exp(y * y) * erfc(y) : 0)) < 1e-13 * creal(pm_faddeeva(I * y)) * fmax(1, y * y),
			"w(i %g) = exp(y^2) erfc(y)", y);
	/* the two rules meet, and Z' is that of Z, near and far */
	double worst = 0;
	for (double x = 0.013; x < 60; x *= 1.17)
		for (double y = -3; y < 3; y += 0.23) {
			const double complex z = x + I * y, d = 1e-4 * (1 + cabs(z));
			const double complex slope =
				(8 * (pm_plasma_z(z + d) - pm_plasma_z(z - d)) - (pm_plasma_z(z + 2 * d) - pm_plasma_z(z - 2 * d))) / (12 * d);
			worst = fmax(worst, cabs(slope - pm_plasma_z_slope(z)) / (cabs(slope) + 2 * cabs(z * pm_plasma_z(z)) + 1e-3));
		}
	check(worst < 1e-9, "Z' is the derivative of Z: %.2g", worst); /* of differences of order 4: rounding 1e-15/1e-4, d^4 times the fifth derivative */
}

static void root(const char *what, const struct pm_wave_species *s, int n, double k, double omega, double gamma, double tolerance)
{
	const double complex got = pm_wave_strongest(s, n, k);
	check(fabs(creal(got) - omega) <= tolerance && fabs(cimag(got) - gamma) <= tolerance, "%s: omega %.12g, gamma %.12g", what, creal(got), cimag(got));
}

/* Waves across B: roots by scipy.optimize.brentq of the sum of 200 harmonics with scipy.special.ive,
 * 1 - (2/k**2)*sum(ive(n, (k/O)**2)*(n*O)**2/(w*w - (n*O)**2)), omega_p = vth = 1, between harmonics 1, 2, 3 and the next. */
static void bernstein(void)
{
	static const double of[][5] = {{0.5, 0.5, 0.6887802700294761, 1.2104696167178302, 1.5830372865096705},
		{1, 1, 1.1638724070828073, 2.106415885184735, 3.02777414705024}, {1.5, 0.4, 0.4133934767078011, 0.8251631602895605, 1.2337793598084046}};
	for (size_t i = 0; i < sizeof of / sizeof *of; i++) {
		const struct pm_gyrating s = {1, 0, 1, -of[i][1], 1};
		struct pm_bernstein b;
		check(!pm_bernstein_init(&b, &s, 1, of[i][0]), "Bernstein: memory");
		for (size_t j = 0; j < 3; j++) {
			check_near(pm_bernstein_root(&b, j), of[i][j + 2], 1e-13, "Bernstein: a root");
			check_near(pm_bernstein_nearest(&b, of[i][j + 2] + 0.01 * of[i][1]), of[i][j + 2], 1e-13, "Bernstein: the nearest root");
		}
		pm_bernstein_free(&b);
	}
	/* cold, two species: the upper and the lower hybrid frequency, roots of a quadratic in omega^2 */
	const struct pm_gyrating two[] = {{1, 0, 0, -0.8, 1}, {0.1, 0, 0, 0.008, 1}};
	const double p = 0.64 + 0.000064 + 1.01, q = 0.64 * 0.000064 + 0.000064 + 0.01 * 0.64;
	struct pm_bernstein b;
	check(!pm_bernstein_init(&b, two, 2, 1), "hybrid: memory");
	check_near(pm_bernstein_root(&b, 1), sqrt(0.5 * (p + sqrt(p * p - 4 * q))), 1e-14, "upper hybrid");
	check_near(pm_bernstein_root(&b, 0), sqrt(0.5 * (p - sqrt(p * p - 4 * q))), 1e-14, "lower hybrid");
	pm_bernstein_free(&b);
	double bessel[9]; /* scipy.special.ive(8, x) */
	pm_bessel_scaled(2.385, 8, bessel);
	check_near(bessel[8] / 1.0925554328255416e-05, 1, 1e-13, "exp(-x) I_8(x), x = 2.385");
	pm_bessel_scaled(1e-12, 8, bessel);
	check_near(bessel[8] / 9.688120039672773e-104, 1, 1e-13, "exp(-x) I_8(x), x = 1e-12");
	pm_bessel_scaled(5000, 8, bessel);
	check_near(bessel[8] / 0.005606039584412461, 1, 1e-12, "exp(-x) I_8(x), x = 5000");
}

static void light(const char *what, enum pm_light kind, double k, double vth, double turn, double ratio, double complex want)
{
	const struct pm_gyrating s = {1, 0, vth, -turn, ratio};
	const struct pm_light_case l = {kind, &s, 1, k, 1};
	const double complex got = cimag(want) > 0.01 ? pm_light_strongest(&l) : pm_light_nearest(&l, 1.02 * creal(want));
	double complex slope;
	check(cabs(got - want) < 2e-12, "%s: omega %.14g, gamma %.14g, off by %.2g", what, creal(got), cimag(got), cabs(got - want));
	const double complex at = want + 0.1 + 0.02 * I, d = 1e-5;
	const double complex rise = (pm_light_function(&l, at + d, &slope) - pm_light_function(&l, at - d, &slope)) / (2 * d);
	pm_light_function(&l, at, &slope);
	check(cabs(rise - slope) < 1e-5 * cabs(slope), "%s: the derivative, to %.2g", what, cabs(rise - slope) / cabs(slope)); /* d^2 times the third */
}

/* Warm waves along B: roots by the secant method with scipy.special.wofz; PIC-09; cold ones are roots of cubics and of quadratics in omega^2 (numpy.roots). */
static void lights(void)
{
	light("whistler, warm", PM_RIGHT, 1, 0.1, 1, 1, 0.4383011886197098 - 1.813002948281589e-07 * I);
	light("whistler at its resonance", PM_RIGHT, 2, 0.1, 1, 1, 0.675920617799777 - 0.090867840750401 * I);
	light("right wave above", PM_RIGHT, 1, 0.1, 0.5, 1, 1.57431147349948);
	light("whistler, ratio 3", PM_RIGHT, 1, 0.1, 1, 3, 0.45552308339568254 + 6.858864965552194e-07 * I);
	light("left wave", PM_LEFT, 1, 0.1, 1, 1, 1.2474609931447198);
	light("left wave, half the field", PM_LEFT, 1, 0.1, 0.5, 1, 1.3139966685290247);
	light("PIC-09: Weibel", PM_RIGHT, 1, 0.05, 0, 10, 0.0828703529139575 * I);
	light("PIC-09: Weibel, 25", PM_RIGHT, 1.5, 0.05, 0, 25, 0.170759931507873 * I);
	light("cold whistler", PM_RIGHT, 1, 0, 1, 1, 0.445041867912629); /* 2 sin(pi/14): of w^3 - w^2 - 2 w + 1 */
	light("cold left wave", PM_LEFT, 1, 0, 1, 1, 1.246979603717467); /* 2 sin(3 pi/14) */
	light("extraordinary wave", PM_EXTRAORDINARY, 1, 0, 1, 1, 1.7320508075688772);
	light("extraordinary wave, slow", PM_EXTRAORDINARY, 1, 0, 0.5, 1, sqrt(1.625 - sqrt(1.625 * 1.625 - 2.25)));
	light("ordinary wave", PM_ORDINARY, 2, 0, 1, 1, 2.23606797749979);
	light("no field, cold", PM_RIGHT, 1, 0, 0, 1, 1.4142135623730951);
}

int main(void)
{
	const struct pm_wave_species warm = {1, 0, 1};
	faddeeva();
	bernstein();
	lights();
	root("PIC-01: k = 0.3", &warm, 1, 0.3, 1.15984648059191, -0.0126203684211172, 1e-12);
	root("PIC-01: k = 0.5", &warm, 1, 0.5, 1.41566188860454, -0.153359466909605, 1e-12);
	root("PIC-01: k = 1", &warm, 1, 1, 2.04590486569062, -0.851330458692056, 1e-12);
	const double half = sqrt(0.5);
	const struct pm_wave_species cold[] = {{half, 1, 0}, {half, -1, 0}};
	root("PIC-02: fastest", cold, 2, sqrt(0.375), 0, 0.353553390593274, 1e-8); /* a double root along k v0: half the digits */
	root("PIC-02: k v0 = 0.3", cold, 2, 0.3, 0, 0.256405640402469, 1e-12);
	const struct pm_wave_species streams[] = {{half, 3, 1}, {half, -3, 1}}, slow[] = {{half, 1.3, 1}, {half, -1.3, 1}};
	root("PIC-03: v0 = 3", streams, 2, 0.2, 0, 0.284509686204960, 1e-12);
	check(cimag(pm_wave_strongest(slow, 2, 0.2)) < 0, "PIC-03: v0 = 1.3 is stable: %.5f", cimag(pm_wave_strongest(slow, 2, 0.2)));
	const struct pm_wave_species bump[] = {{sqrt(0.9), 0, 1}, {sqrt(0.1), 4.5, 0.5}};
	root("PIC-04", bump, 2, 0.3, 1.00121789363112, 0.198097975843025, 1e-12);
	const struct pm_wave_species buneman[] = {{1, 1, 0}, {sqrt(1 / 1836.15267343), 0, 0}};
	check_near(cimag(pm_wave_strongest(buneman, 2, 1.006166)), 0.05437200, 1e-8, "PIC-05");
	/* ion-acoustic: omega = k c_s/sqrt(1 + k^2) for cold ions, where electrons' inertia m_e/m_i is left out */
	const struct pm_wave_species acoustic[] = {{1, 0, 1}, {0.01, 0, 0}};
	const double complex ion = pm_wave_nearest(acoustic, 2, 0.2, 0.002);
	check(fabs(creal(ion) - 0.01 * 0.2 / sqrt(1.04)) < 1e-6 && cimag(ion) < 0, "ion-acoustic wave: %.9g %.3g", creal(ion), cimag(ion));
	return check_done();
}
