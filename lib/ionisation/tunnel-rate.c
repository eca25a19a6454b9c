/* The rate of tunnel ionisation in a quasi-static field E, in atomic units, of the electron with the magnetic quantum number 0 (Ammosov, Delone and Krainov
 * 1986, in the form of Nuter et al. 2011, eq. 1):
 *     W = A (2 l + 1) I (2 k^3/E)^(2 n - 1) exp(-2 k^3/(3 E)),   k = sqrt(2 I),   n = Z/k,   A = 2^(2 n)/(n Gamma(2 n)),
 * I the ionisation energy, Z the charge of the ion that is left, l the angular momentum of the electron; the effective one, n - 1, is in A. Of hydrogen this
 * is 4/E exp(-2/(3 E)). Where the field lies above the barrier the formula is too large, and in still larger fields falls again; there
 *     W = 2.4 E^2/k^4,
 * fitted to solutions of Schroedinger's equation for hydrogen (Bauer and Mulser 1999), from the field on where both are equal: 0.084 for hydrogen.
 * Cost: an exponential and a logarithm. SPDX-License-Identifier: GPL-3.0-or-later */
#include <math.h>

#include "ionisation/tunnel-rate.h"

static double log_tunnel(const struct pm_tunnel *t, double field)
{
	const double k = sqrt(2 * t->energy), a = 2 * k * k * k;
	return t->constant + (2 * t->n - 1) * (log(a) - log(field)) - a / (3 * field);
}

static double log_suppressed(const struct pm_tunnel *t, double field) { return log(2.4) + 2 * log(field) - 2 * log(2 * t->energy); }

/* The ratio of both has one maximum, where 2 k^3/(3 E) = 2 n + 1, and is above 1 there for every ion of the table (tests/unit/tunnel-rate.c). */
static double critical_field(const struct pm_tunnel *t)
{
	const double k = sqrt(2 * t->energy);
	double high = 2 * k * k * k / (3 * (2 * t->n + 1)), low = high / 1000;
	for (int i = 0; i < 60; i++) {
		const double middle = 0.5 * (low + high);
		if (log_tunnel(t, middle) < log_suppressed(t, middle))
			low = middle;
		else
			high = middle;
	}
	return high;
}

struct pm_tunnel pm_tunnel_of(const struct pm_element *e, int charge)
{
	struct pm_tunnel t = {.energy = e->energy[charge] / PM_HARTREE};
	t.n = (charge + 1) / sqrt(2 * t.energy);
	t.constant = 2 * t.n * log(2) - log(t.n) - lgamma(2 * t.n) + log(2 * pm_element_l(e->z - charge) + 1) + log(t.energy);
	t.critical = critical_field(&t);
	return t;
}

double pm_tunnel_rate(const struct pm_tunnel *t, double field, bool suppressed)
{
	if (!(field > 0))
		return 0;
	return exp(suppressed && field > t->critical ? log_suppressed(t, field) : log_tunnel(t, field));
}
