/* Higuera and Cary's relativistic kick with the reaction of the radiation (Landau and Lifshitz 1975, section 76, eq. 76.3, without the derivatives of the
 * fields along the orbit, which are smaller than the last term by 1/gamma): (gamma v)' = a + v x w + tau g, a = q E/m, w = q B/m, f = a + v x w,
 *     g = f x w + (v.a) a/c^2 - gamma^2 (f^2 - (v.a)^2/c^2) v/c^2,   tau = |q/m| radiation_time,
 * radiation_time = e^2/(6 pi eps0 m c^3) of a charge of |q/m| = 1. u = gamma v takes half a step of tau g before the opening half of the kick and one behind
 * the closing half: the last term is a decay of u, whose exponential is taken (midpoint rule), so that no step turns it round.
 * A circle about B: gamma = coth(tau w^2 t + arcoth gamma_0). Source: Tamburini et al. 2010 (New J. Phys. 12, 123005), eqs. 3 to 6, which have the
 * same terms. Second order. Cost: two of higuera-cary. SPDX-License-Identifier: GPL-3.0-or-later */
#include "step-parts/plain-pass.h"
#include "step-parts/proper-velocity.h"
#include "step/step.h"

struct reaction {
	double steady[3]; /* tau g but for its last term [length/time^2] */
	double decay;     /* of u [1/time] */
};

static void cross(const double a[3], const double b[3], double r[3])
{
	for (int c = 0; c < 3; c++)
		r[c] = a[(c + 1) % 3] * b[(c + 2) % 3] - a[(c + 2) % 3] * b[(c + 1) % 3];
}

static struct reaction reaction_of(const struct pm_magnetic_lanes *p, size_t l, const double u[3])
{
	const double gamma = pm_proper_gamma(p, u), c2 = p->c * p->c, q = p->charge[l] / p->mass[l], tau = fabs(q) * p->radiation_time;
	double v[3], a[3], w[3], f[3], turned[3];
	for (int c = 0; c < 3; c++) {
		v[c] = u[c] / gamma;
		a[c] = p->acc[c][l];
		w[c] = q * p->b[c][l];
	}
	cross(v, w, f);
	for (int c = 0; c < 3; c++)
		f[c] += a[c];
	cross(f, w, turned);
	const double work = pm_proper_dot(v, a);
	struct reaction r = {.decay = tau * gamma * (pm_proper_dot(f, f) - work * work / c2) / c2};
	for (int c = 0; c < 3; c++)
		r.steady[c] = tau * (turned[c] + work * a[c] / c2);
	return r;
}

static void decelerate(const struct pm_magnetic_lanes *p, double h, size_t l, double u[3])
{
	const struct reaction start = reaction_of(p, l, u);
	double half[3];
	for (int c = 0; c < 3; c++)
		half[c] = exp(-0.5 * h * start.decay) * u[c] + 0.5 * h * start.steady[c];
	const struct reaction middle = reaction_of(p, l, half);
	for (int c = 0; c < 3; c++)
		u[c] = exp(-h * middle.decay) * u[c] + h * exp(-0.5 * h * middle.decay) * middle.steady[c];
}

PM_SIMD_INLINE void kick(bool closing, double dt, const struct pm_magnetic_lanes *p)
{
	double changed[3][PM_MAGNETIC_LANES];
	for (size_t l = 0; l < PM_MAGNETIC_LANES; l++) {
		double u[3];
		pm_proper_load(p, l, u);
		if (!closing)
			decelerate(p, 0.5 * dt, l, u);
		pm_proper_higuera_cary(p, closing, dt, l, u);
		if (closing)
			decelerate(p, 0.5 * dt, l, u);
		pm_proper_store(p, l, u, changed);
	}
	pm_magnetic_put(p, changed);
}

static void magnetic(bool closing, double dt, size_t from, size_t to, const struct pm_magnetic *m)
{
	PM_MAGNETIC_HALVES(m, from, to, kick, closing, dt)
}

const struct pm_step step_landau_lifshitz = {
	.name = "landau-lifshitz",
	.sentence = "higuera-cary with the reaction of the radiation, by the constant radiation_time (landau-lifshitz/2)",
	.source = "Landau and Lifshitz 1975; Tamburini et al. 2010",
	.kind = PM_KICK,
	.passes = 1,
	.order = 2,
	.real_limit = NAN,
	.imaginary_limit = 2,
	.at = {1},
	.pass = pm_plain_pass,
	.magnetic = magnetic,
	.relativistic = true,
	.radiates = true,
};
