/* The dispersion relation eps(omega, k) = 0 of electrostatic waves, omega = real part + i gamma, waves exp(i k x - i omega t).
 * Source: Landau 1946; Fried and Conte 1961; Stix 1992, section 8-3. Checked against PIC-01 to PIC-05 of the reference cases (tests/unit/dispersion.c).
 * Cost: a Faddeeva function a species and Newton step. SPDX-License-Identifier: GPL-3.0-or-later */
#include "plasma/dispersion.h"

double complex pm_dielectric(const struct pm_wave_species *s, int n, double k, double complex omega, double complex *slope)
{
	double complex eps = 1;
	*slope = 0;
	for (int i = 0; i < n; i++) {
		const double w2 = s[i].frequency * s[i].frequency, scale = sqrt(2) * k * s[i].vth;
		const double complex d = omega - k * s[i].drift;
		if (s[i].vth > 0) {
			const double complex zeta = d / scale, z1 = pm_plasma_z_slope(zeta), z = -(1 + 0.5 * z1) / zeta;
			eps -= w2 / (scale * scale) * z1;
			*slope += w2 / (scale * scale * scale) * 2 * (z + zeta * z1);
		} else {
			eps -= w2 / (d * d);
			*slope += 2 * w2 / (d * d * d);
		}
	}
	return eps;
}

double complex pm_wave_root(const struct pm_wave_species *s, int n, double k, double complex start)
{
	double complex omega = start, slope;
	for (int i = 0; i < 60; i++) {
		const double complex step = pm_dielectric(s, n, k, omega, &slope) / slope;
		omega -= step;
		if (!isfinite(creal(omega)) || !isfinite(cimag(omega)))
			return NAN;
		if (cabs(step) < 1e-13 * cabs(omega))
			return omega;
	}
	return NAN;
}

/* Starts from 0 to the largest frequency of any species, moved by its drift and its spread. */
static void frequencies(const struct pm_wave_species *s, int n, double k, double range[2])
{
	double total = 0;
	range[0] = range[1] = 0;
	for (int i = 0; i < n; i++)
		total += s[i].frequency * s[i].frequency;
	for (int i = 0; i < n; i++) {
		const double half = sqrt(total) + 3 * k * s[i].vth;
		range[0] = fmin(range[0], k * s[i].drift - half);
		range[1] = fmax(range[1], k * s[i].drift + half);
	}
}

/* How good a root is: larger is better. */
struct wish {
	double near; /* NAN: growth alone */
};

static double worth(const struct wish *w, double complex root)
{
	if (isnan(w->near))
		return cimag(root);
	return -cimag(root) > 0.5 * fabs(creal(root)) + 1e-9 ? -INFINITY : -fabs(creal(root) - w->near);
}

/* Keeps the better of a root and what Newton's method makes of a start; of a pair omega, -conj(omega) the one that runs along k. */
static double complex better(const struct pm_wave_species *s, int n, double k, double complex start, const struct wish *w, double complex best)
{
	const double complex root = pm_wave_root(s, n, k, start);
	if (isnan(creal(root)) || creal(root) < -1e-9 * cabs(start))
		return best;
	return isnan(creal(best)) || worth(w, root) > worth(w, best) + 1e-12 ? root : best;
}

/* Starts over the range, and near 0, where waves of heavy species are, on both sides of the axis. */
static double complex search(const struct pm_wave_species *s, int n, double k, const struct wish *w)
{
	static const double up[] = {-0.3, -0.1, -0.01, 1e-4, 0.03, 0.1, 0.3};
	enum { along = 60, ups = sizeof up / sizeof *up };
	double range[2];
	double complex best = NAN;
	frequencies(s, n, k, range);
	const double scale = 0.5 * (range[1] - range[0]);
	for (int j = 0; j < ups; j++) {
		for (int i = 0; i <= along; i++)
			best = better(s, n, k, range[0] + (range[1] - range[0]) * i / along + I * scale * up[j], w, best);
		for (double small = 0.3 * scale; small > 1e-4 * scale; small *= 0.6)
			best = better(s, n, k, small * (1 + I * up[j]), w, best);
		if (w->near > 0)
			best = better(s, n, k, w->near * (1 + I * up[j]), w, best);
	}
	return isnan(creal(best)) || worth(w, best) == -INFINITY ? NAN : best;
}

double complex pm_wave_strongest(const struct pm_wave_species *s, int n, double k) { return search(s, n, k, &(struct wish){NAN}); }

double complex pm_wave_nearest(const struct pm_wave_species *s, int n, double k, double omega) { return search(s, n, k, &(struct wish){omega}); }
