/* Waves across a magnetic field: eps(omega, k) = 1 - sum over species s, n >= 1 of
 *     2 (omega_s^2/(k^2 v^2)) exp(-l) I_n(l) n^2 Omega^2/(omega^2 - n^2 Omega^2), l = (k v/Omega)^2; cold: omega_s^2/(omega^2 - Omega^2).
 * It rises from -infinity to infinity between two harmonics, so there is one root in each of these bands, found by halving, and none below the first.
 * I_n by Miller's recurrence from above.
 * Source: Bernstein 1958, Physical Review 109, 10; Stix 1992, section 11-10; Abramowitz and Stegun 9.12 (Miller). Cost: a harmonic each of 10 + 8 k v/Omega.
 * SPDX-License-Identifier: GPL-3.0-or-later */
#include <stdlib.h>

#include "plasma/bernstein.h"

void pm_bessel_scaled(double x, size_t n, double *value)
{
	double above = 0, here = 1e-250, sum = 0;
	for (size_t i = 0; i <= n; i++)
		value[i] = i == 0 && x == 0;
	if (x == 0)
		return;
	for (size_t i = n + 30 + (size_t)(9 * sqrt(x)); i-- > 0;) {
		const double below = above + 2 * (double)(i + 1) / x * here;
		above = here, here = below;
		if (here > 1e200) { /* what is larger by 1e200 makes the rest of the sum 0 */
			above *= 1e-200, here *= 1e-200, sum *= 1e-200;
			for (size_t j = i + 1; j <= n; j++)
				value[j] *= 1e-200;
		}
		if (i <= n)
			value[i] = here;
		sum += i ? 2 * here : here; /* I_0 + 2 (I_1 + I_2 + ...) = exp(x) */
	}
	for (size_t i = 0; i <= n; i++)
		value[i] /= sum;
}

static int by_frequency(const void *a, const void *b)
{
	const struct pm_harmonic *p = a, *q = b;
	return (p->frequency > q->frequency) - (p->frequency < q->frequency);
}

static size_t harmonics(const struct pm_gyrating *s, double k) { return s->vth > 0 ? 10 + (size_t)fmin(8 * k * s->vth / fabs(s->gyration), 1e5) : 1; }

/* Harmonics of the same frequency become one. */
static void unite(struct pm_bernstein *b)
{
	size_t kept = 0;
	qsort(b->harmonic, b->n, sizeof *b->harmonic, by_frequency);
	for (size_t j = 0; j < b->n; j++) {
		struct pm_harmonic *last = kept ? &b->harmonic[kept - 1] : NULL;
		if (last && b->harmonic[j].frequency - last->frequency < 1e-12 * last->frequency)
			last->weight += b->harmonic[j].weight;
		else
			b->harmonic[kept++] = b->harmonic[j];
	}
	b->n = kept;
}

int pm_bernstein_init(struct pm_bernstein *b, const struct pm_gyrating *s, int n, double k)
{
	size_t room = 1, most = 1;
	double total = 0, fastest = 0;
	for (int i = 0; i < n; i++) {
		const size_t own = harmonics(&s[i], k);
		room += own, most = own > most ? own : most;
		total += s[i].frequency * s[i].frequency;
	}
	double *bessel = pm_alloc(most + 1, sizeof *bessel);
	*b = (struct pm_bernstein){.harmonic = pm_alloc(room, sizeof *b->harmonic)};
	for (int i = 0; i < n && bessel && b->harmonic; i++) {
		const double w2 = s[i].frequency * s[i].frequency, turn = fabs(s[i].gyration), kv = k * s[i].vth;
		const size_t own = harmonics(&s[i], k);
		if (kv > 0)
			pm_bessel_scaled(kv / turn * (kv / turn), own, bessel);
		for (size_t j = 1; j <= own; j++) {
			const double f = (double)j * turn, weight = kv > 0 ? 2 * w2 * (f / kv) * (f / kv) * bessel[j] : w2;
			if (weight > 1e-30 * w2) /* roots at weaker ones are at the harmonic itself, and without field */
				b->harmonic[b->n++] = (struct pm_harmonic){f, weight};
			fastest = fmax(fastest, f);
		}
	}
	const bool whole = bessel && b->harmonic;
	pm_free(bessel);
	if (!whole) {
		pm_bernstein_free(b);
		return pm_no_memory();
	}
	unite(b);
	b->highest = 1.01 * sqrt(total + fastest * fastest); /* eps >= 1 - sum weight/(omega^2 - fastest^2), and weights of a species sum to omega_s^2 */
	return 0;
}

void pm_bernstein_free(struct pm_bernstein *b)
{
	pm_free(b->harmonic);
	*b = (struct pm_bernstein){0};
}

double pm_bernstein_epsilon(const struct pm_bernstein *b, double omega, double *slope)
{
	double eps = 1, rise = 0;
	for (size_t j = 0; j < b->n; j++) {
		const double f = b->harmonic[j].frequency, one = (omega - f) * (omega + f), part = b->harmonic[j].weight / one;
		eps -= part, rise += part / one;
	}
	if (slope)
		*slope = 2 * omega * rise;
	return eps;
}

double pm_bernstein_root(const struct pm_bernstein *b, size_t j)
{
	if (j >= b->n)
		return NAN;
	double low = b->harmonic[j].frequency, high = j + 1 < b->n ? b->harmonic[j + 1].frequency : b->highest;
	for (int i = 0; i < 100; i++) {
		const double middle = 0.5 * (low + high);
		if (middle <= low || middle >= high)
			break;
		if (pm_bernstein_epsilon(b, middle, NULL) < 0)
			low = middle;
		else
			high = middle;
	}
	return 0.5 * (low + high);
}

double pm_bernstein_nearest(const struct pm_bernstein *b, double omega)
{
	size_t at = 0;
	double best = NAN;
	while (at + 1 < b->n && b->harmonic[at + 1].frequency <= omega)
		at++;
	for (size_t j = at > 0 ? at - 1 : 0; j <= at + 1 && j < b->n; j++) {
		const double root = pm_bernstein_root(b, j);
		if (isnan(best) || fabs(root - omega) < fabs(best - omega))
			best = root;
	}
	return best;
}

double pm_bernstein_strongest(const struct pm_bernstein *b)
{
	double best = NAN, largest = 0, slope;
	for (size_t j = 0; j < b->n; j++) {
		const double root = pm_bernstein_root(b, j);
		pm_bernstein_epsilon(b, root, &slope);
		if (1 / (root * slope) > largest)
			largest = 1 / (root * slope), best = root;
	}
	return best;
}
