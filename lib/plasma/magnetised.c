/* Waves exp(i k x - i omega t) of light in a plasma with a uniform magnetic field, species not relativistic.
 * Along B, right (+) and left (-):  omega^2 - c^2 k^2 + sum omega_s^2 (zeta_0 Z(zeta) + (a - 1)(1 + zeta Z(zeta))) = 0,
 *     zeta_0 = (omega - k u)/(sqrt 2 k v), zeta = (omega - k u +- Omega_s)/(sqrt 2 k v), a the temperature across over that along, Omega_s = q B/m;
 *     cold: sum -omega_s^2 (omega - k u)/(omega - k u +- Omega_s). At B = 0 and a > 1 this is Weibel's instability.
 * Across B, cold: ordinary, omega^2 = c^2 k^2 + sum omega_s^2; extraordinary, S (S - c^2 k^2/omega^2) = D^2 with
 *     S = 1 - sum omega_s^2/(omega^2 - Omega_s^2), D = sum omega_s^2 Omega_s/(omega (omega^2 - Omega_s^2)).
 * Source: Stix 1992, sections 1-3, 2-5 and 10-4; Davidson 1983 (Handbook of Plasma Physics 1, 521). Checked by scipy and PIC-09 (tests/unit/dispersion.c).
 * Cost: a Faddeeva function a species and Newton step. SPDX-License-Identifier: GPL-3.0-or-later */
#include "plasma/magnetised.h"

static double complex along(const struct pm_light_case *l, double complex omega, double complex *slope)
{
	double complex value = omega * omega - l->c * l->c * l->k * l->k;
	*slope = 2 * omega;
	for (int i = 0; i < l->n; i++) {
		const struct pm_gyrating *s = &l->species[i];
		const double turn = l->kind == PM_LEFT ? -s->gyration : s->gyration, scale = sqrt(2) * l->k * s->vth, w2 = s->frequency * s->frequency;
		const double complex moving = omega - l->k * s->drift, d = moving + turn;
		if (s->vth > 0) {
			const double complex zeta = d / scale, z1 = pm_plasma_z_slope(zeta), z = pm_plasma_z(zeta), z2 = -2 * (z + zeta * z1);
			value += w2 * (moving / scale * z - 0.5 * (s->ratio - 1) * z1);
			*slope += w2 / scale * (z + moving / scale * z1 - 0.5 * (s->ratio - 1) * z2);
		} else {
			const double complex part = turn == 0 ? 1 : moving / d;
			value -= w2 * part;
			*slope -= turn == 0 ? 0 : w2 * turn / (d * d);
		}
	}
	return value;
}

static double complex across(const struct pm_light_case *l, double complex omega, double complex *slope)
{
	double complex s = 1, d = 0, s1 = 0, d1 = 0;
	const double complex w = omega * omega;
	const double light = l->c * l->c * l->k * l->k;
	for (int i = 0; i < l->n; i++) {
		const double w2 = l->species[i].frequency * l->species[i].frequency, o = l->species[i].gyration;
		const double complex one = w - o * o;
		s -= w2 / one;
		s1 += 2 * omega * w2 / (one * one);
		d += w2 * o / (omega * one);
		d1 -= w2 * o * (3 * w - o * o) / (w * one * one);
	}
	*slope = s1 * (2 * s - light / w) + 2 * s * light / (w * omega) - 2 * d * d1;
	return s * (s - light / w) - d * d;
}

static double total(const struct pm_light_case *l)
{
	double sum = 0;
	for (int i = 0; i < l->n; i++)
		sum += l->species[i].frequency * l->species[i].frequency;
	return sum;
}

double complex pm_light_function(const struct pm_light_case *l, double complex omega, double complex *slope)
{
	if (l->kind == PM_EXTRAORDINARY)
		return across(l, omega, slope);
	if (l->kind != PM_ORDINARY)
		return along(l, omega, slope);
	*slope = 2 * omega;
	return omega * omega - l->c * l->c * l->k * l->k - total(l);
}

double complex pm_light_root(const struct pm_light_case *l, double complex start)
{
	double complex omega = start, slope;
	for (int i = 0; i < 80; i++) {
		const double complex step = pm_light_function(l, omega, &slope) / slope;
		omega -= step;
		if (!isfinite(creal(omega)) || !isfinite(cimag(omega)))
			return NAN;
		if (cabs(step) < 1e-13 * cabs(omega))
			return omega;
	}
	return NAN;
}

/* Larger is better. NAN: growth alone. */
static double worth(double near, double complex root)
{
	if (isnan(near))
		return cimag(root);
	return -cimag(root) > 0.5 * fabs(creal(root)) + 1e-9 ? -INFINITY : -cabs(root - near);
}

static double complex better(const struct pm_light_case *l, double complex start, double near, double complex best)
{
	const double complex root = pm_light_root(l, start);
	if (isnan(creal(root)) || creal(root) < -1e-9 * cabs(start))
		return best;
	return isnan(creal(best)) || worth(near, root) > worth(near, best) + 1e-12 ? root : best;
}

/* Starts from 0 to above the cut-offs, evenly and by a constant ratio, on both sides of the real axis. */
static double complex search(const struct pm_light_case *l, double near)
{
	static const double up[] = {-0.1, -0.01, 1e-4, 0.03, 0.3};
	enum { even = 60, ups = sizeof up / sizeof *up };
	double range = sqrt(total(l)) + l->c * l->k;
	double complex best = NAN;
	for (int i = 0; i < l->n; i++)
		range = fmax(range, 2 * fabs(l->species[i].gyration) + l->c * l->k + sqrt(total(l)));
	for (int j = 0; j < ups; j++) {
		for (int i = 0; i <= even; i++)
			best = better(l, range * (i / (double)even + I * up[j]), near, best);
		for (double small = 0.03 * range; small > 1e-5 * range; small *= 0.7)
			best = better(l, small * (1 + I * up[j]), near, best);
		if (near > 0)
			best = better(l, near * (1 + I * up[j]), near, best);
	}
	return isnan(creal(best)) || worth(near, best) == -INFINITY ? NAN : best;
}

double complex pm_light_nearest(const struct pm_light_case *l, double omega) { return search(l, omega); }

double complex pm_light_strongest(const struct pm_light_case *l) { return search(l, NAN); }
