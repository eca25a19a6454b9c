/* Nanbu: the angle after many small ones, with density proportional to exp(A cos theta) on the sphere, where coth A - 1/A = exp(-s) is the mean of cos theta.
 * For any s: a step may be as long as a collision time. A by Newton's iteration from Cohen's approximation (Cohen 1991, Rheologica Acta 30, 270).
 * Source: Nanbu 1997, Physical Review E 55, 4642. Cost: some ten exponentials and logarithms. SPDX-License-Identifier: GPL-3.0-or-later */
#include "collision/collision.h"

/* coth A - 1/A = exp(-s). Written for 1 - exp(-s), which small angles need to all its digits. */
static double concentration(double s)
{
	const double mean = exp(-s), less = -expm1(-s);
	if (s > 7)
		return 3 * mean; /* the next term is A^2/15 of it, below 6e-7 */
	double a = less < 0.05 ? 1 / less : mean * (3 - mean * mean) / (less * (1 + mean));
	for (int i = 0; i < 4 && less >= 0.05; i++) { /* below, 2/(exp(2 A) - 1) < 1e-16 */
		const double e = 2 / expm1(2 * a);
		a += (1 / a - e - less) / (1 / (a * a) - e * (e + 2));
	}
	return a;
}

static double turned(double s, uint64_t key, uint64_t id, uint64_t counter)
{
	double u[2];
	pm_random(key, id, counter, u);
	const double a = concentration(s);
	return a > 1e-8 ? fmin(2, -log1p(u[0] * expm1(-2 * a)) / a) : 2 * u[0];
}

const struct pm_collision collision_nanbu = {
	.name = "nanbu",
	.sentence = "the angle after many small ones, for any step",
	.source = "Nanbu 1997",
	.turned = turned,
};
