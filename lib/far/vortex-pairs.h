/* Pairs of vortices in space, as many at a time as a register holds: the factors f and f'/r of a mollified vector potential, u = sum f alpha x s, and the
 * potential itself. All from 1/r to 2e-16. The Gaussian core: erf(s) = 1 - exp(-s^2) P(1/(s + 3)), with P the polynomial of degree 15 with the least error
 * for s in 0.7..6.5 (7e-17; Chebyshev's expansion by mpmath.chebyfit, 40 digits), and below s^2 = 1/2 polynomials of degree 9 for f and its slope (5e-17).
 * SPDX-License-Identifier: GPL-3.0-or-later */
#ifndef PM_FAR_VORTEX_PAIRS_H
#define PM_FAR_VORTEX_PAIRS_H

#include "far/pair-forces.h"

enum pm_vortex_mode { PM_VORTEX_SQUARE, PM_VORTEX_ALGEBRAIC, PM_VORTEX_GAUSSIAN, PM_VORTEX_GAUSSIAN_4, PM_VORTEX_OTHER, PM_VORTEX_MODES };

static const double pm_vortex_least = 1e-120; /* of r^2: closer points without a core coincide, because 1/r^5 overflows */

struct pm_vortex_pairs {
	const struct pm_mollifier *mollifier;
	double delta, delta2; /* [length], its square where it is added to r^2 */
	double near2;         /* below this r^2 the core is evaluated; beyond, a point's */
	double unit, unit2;   /* 1/delta, 1/delta^2 */
	enum pm_vortex_mode mode;
};

PM_SIMD_INLINE struct pm_vortex_pairs pm_vortex_pairs_of(const struct pm_mollifier *m, double delta)
{
	struct pm_vortex_pairs p = {.mollifier = m, .delta = delta, .unit = 1 / delta, .unit2 = 1 / delta / delta,
		.near2 = m->reach * m->reach * delta * delta};
	const bool point = m->bare || delta * delta < pm_vortex_least;
	p.mode = point ? PM_VORTEX_OTHER : m->square ? PM_VORTEX_SQUARE : m->loop == PM_LOOP_ALGEBRAIC ? PM_VORTEX_ALGEBRAIC :
		m->loop == PM_LOOP_GAUSSIAN ? PM_VORTEX_GAUSSIAN : m->loop == PM_LOOP_GAUSSIAN_4 ? PM_VORTEX_GAUSSIAN_4 : PM_VORTEX_OTHER;
	if (p.mode == PM_VORTEX_SQUARE || p.mode == PM_VORTEX_ALGEBRAIC)
		p.delta2 = delta * delta;
	if (point)
		p.near2 = 0;
	else if (m->reach <= 0)
		p.near2 = HUGE_VAL;
	return p;
}

PM_SIMD_INLINE pm_simd pm_vortex_rsqrt(pm_simd d2)
{
	pm_simd y = pm_simd_rsqrt_start(d2), e = pm_simd_fnma(d2, y * y, pm_simd_all(1));
	pm_simd s = pm_simd_fma(e, pm_simd_fma(e, pm_simd_all(0.3125), pm_simd_all(0.375)), pm_simd_all(0.5));
	return pm_simd_fma(y * e, s, y);
}

PM_SIMD_INLINE pm_simd pm_vortex_polynomial(const double *c, int degree, pm_simd t)
{
	pm_simd p = pm_simd_all(c[degree]);
	PM_SIMD_UNROLL
	for (int k = degree - 1; k >= 0; k--)
		p = pm_simd_fma(p, t, pm_simd_all(c[k]));
	return p;
}

/* In units of 1/delta^3, 1/delta^5 and 1/delta; y = 1/r, anything where r vanishes. fourth: of the blob of order 4, whose kernels differ by multiples of
 * the blob of order 2 (lib/mollifier/gaussian-4.c). */
PM_SIMD_INLINE void pm_vortex_gaussian(const struct pm_vortex_pairs *p, bool fourth, pm_simd r2, pm_simd y, pm_simd *f, pm_simd *slope, pm_simd *u)
{
	static const double erfcx[] = {0.2245626810502295967, 0.1961533934919514514, 0.07596934908157716719, 0.02310616183147472387, 0.005288485982287136675,
		0.0008123314434640339912, 0.00004958598224762631286, -9.630083149797361266e-6, -2.160562962050521445e-6, 7.730815866441108226e-8,
		6.416916375125796309e-8, -3.990857924399412526e-10, -2.03791010498081883e-9, 3.267844652033583713e-11, 6.253471480807827567e-11,
		-3.218568895523190709e-12};
	static const double inner[] = {0.9999999999999999456, -0.5999999999999782388, 0.2142857142842765015, -0.05555555551867343792, 0.01136363588262336754,
		-0.001923073314051136417, 0.0002777612523826351761, -0.00003496697625728334321, 3.834486810109375783e-6, -3.137690206274235477e-7};
	static const double inner_slope[] = {-0.59999999999999995, 0.4285714285714085781, -0.1666666666653456797, 0.04545454542065896144,
		-0.009615384173430699698, 0.001666663350591789138, -0.0002450828544666353598, 0.00003128510342116156704, -3.468130929056874129e-6,
		2.859837663273807806e-7};
	const double over_root_pi = 0.56418958354775628695, low = 0.5, root = 4 * over_root_pi / 3;
	pm_simd x = r2 * pm_simd_all(p->unit2), s = r2 * y * pm_simd_all(p->unit), one = pm_simd_all(1), z = s + pm_simd_all(3);
	pm_simd e = pm_simd_where_not_below(pm_simd_all(600), x, pm_simd_exp(-x));
	pm_simd v = pm_simd_reciprocal_start(z);
	for (int k = 0; k < 2; k++) /* 14, 28, 56 bits */
		v = pm_simd_fma(v, pm_simd_fnma(z, v, one), v);
	pm_simd t = (v - pm_simd_all(0.18776671408250355619)) * pm_simd_all(12.120689655172413793);
	pm_simd c = pm_vortex_polynomial(erfcx, 15, t), y1 = y * pm_simd_all(p->delta); /* 1/s */
	pm_simd F = pm_simd_fnma(e, pm_simd_fma(s, pm_simd_all(2 * over_root_pi), c), one) * (y1 * y1 * y1);
	pm_simd S = pm_simd_fnma(pm_simd_all(3), F, e * pm_simd_all(4 * over_root_pi)) * (y1 * y1);
	if (pm_simd_any_below(x, pm_simd_all(low))) {
		pm_simd near = x - pm_simd_where_not_below(x, pm_simd_all(low), x);
		pm_simd G = pm_vortex_polynomial(inner, 9, near) * pm_simd_all(root), T = pm_vortex_polynomial(inner_slope, 9, near) * pm_simd_all(2 * root);
		F = pm_simd_where_not_below(x, pm_simd_all(low), F) + (G - pm_simd_where_not_below(x, pm_simd_all(low), G));
		S = pm_simd_where_not_below(x, pm_simd_all(low), S) + (T - pm_simd_where_not_below(x, pm_simd_all(low), T));
	}
	*f = F, *slope = S, *u = -pm_simd_fma(F, x, e * pm_simd_all(2 * over_root_pi));
	if (fourth) {
		const pm_simd blob = e * pm_simd_all(over_root_pi);
		*f += blob + blob, *slope -= pm_simd_all(4) * blob, *u -= blob;
	}
}

/* Lanes that need the mollifier's own functions. */
static __attribute__((noinline, unused)) void pm_vortex_one_by_one(const struct pm_vortex_pairs *p, const pm_simd *r2, pm_simd *f, pm_simd *slope, pm_simd *u)
{
	const struct pm_mollifier *m = p->mollifier;
	const double c = 4 * pm_pi;
	for (int l = 0; l < PM_SIMD_WIDTH; l++)
		if ((*r2)[l] < p->near2) {
			(*f)[l] = c * m->force((*r2)[l], p->delta, 3);
			(*slope)[l] = c * m->slope((*r2)[l], p->delta);
			(*u)[l] = c * m->potential((*r2)[l], p->delta, 3);
		}
}

/* 4 pi times f, f'/r and phi of a unit strength at squared distance r2. */
PM_SIMD_INLINE void pm_vortex_meet(const struct pm_vortex_pairs *p, enum pm_vortex_mode mode, pm_simd r2, pm_simd *f, pm_simd *slope, pm_simd *u)
{
	pm_simd d2 = r2 + pm_simd_all(p->delta2), y = pm_vortex_rsqrt(d2), three = pm_simd_all(-3);
	if (mode == PM_VORTEX_ALGEBRAIC) {
		pm_simd y2 = y * y, q = pm_simd_all(p->delta2) * y2, y3 = y * y2;
		*f = y3 * pm_simd_fma(q, pm_simd_all(1.5), pm_simd_all(1));
		*slope = y3 * y2 * pm_simd_fma(q, pm_simd_all(-7.5), three);
		*u = -y * pm_simd_fma(q, pm_simd_all(0.5), pm_simd_all(1));
		return;
	}
	if (mode == PM_VORTEX_OTHER)
		y = pm_simd_where_not_below(d2, pm_simd_all(pm_vortex_least), y);
	if ((mode == PM_VORTEX_GAUSSIAN || mode == PM_VORTEX_GAUSSIAN_4) && pm_simd_any_below(r2, pm_simd_all(p->near2))) {
		const double c = p->unit, c3 = c * p->unit2;
		pm_vortex_gaussian(p, mode == PM_VORTEX_GAUSSIAN_4, r2, y, f, slope, u);
		*f *= pm_simd_all(c3), *slope *= pm_simd_all(c3 * p->unit2), *u *= pm_simd_all(c);
		return;
	}
	pm_simd y2 = y * y;
	*f = y * y2, *slope = three * *f * y2, *u = -y;
	if (mode == PM_VORTEX_OTHER && pm_simd_any_below(r2, pm_simd_all(p->near2)))
		pm_vortex_one_by_one(p, &r2, f, slope, u);
}

#endif
