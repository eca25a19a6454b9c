/* Pairs of points, as many at a time as a register holds: force factor and potential of a mollified source, for every method that sums over pairs.
 * 1/r^dim from the 14-bit reciprocals with a correction of fourth order (6e-16). SPDX-License-Identifier: GPL-3.0-or-later */
#ifndef PM_FAR_PAIR_FORCES_H
#define PM_FAR_PAIR_FORCES_H

#define PM_SIMD_NARROW
#include "base/simd.h"
#include "mollifier/mollifier.h"

enum pm_pairs_mode { PM_SQUARE, PM_GUARDED, PM_OTHER }; /* bare at r^2 + delta2; the same where that may vanish; any mollifier */

static const double pm_pairs_least = 1e-200; /* of r^2: see lib/mollifier/bare.h */

struct pm_field_pairs {
	int dim;
	const struct pm_mollifier *mollifier;
	double delta;  /* [length] */
	double delta2; /* 0 unless the mollifier is bare at r^2 + delta^2 */
	double near2;  /* below this r^2 other mollifiers are evaluated one by one */
	enum pm_pairs_mode mode;
};

PM_SIMD_INLINE struct pm_field_pairs pm_field_pairs_of(const struct pm_mollifier *m, double delta, int dim)
{
	struct pm_field_pairs p = {.dim = dim, .mollifier = m, .delta = delta, .delta2 = m->square && !m->bare ? delta * delta : 0};
	p.near2 = m->square ? 0 : m->reach > 0 ? m->reach * m->reach * delta * delta : HUGE_VAL;
	p.mode = !m->square ? PM_OTHER : p.delta2 < pm_pairs_least ? PM_GUARDED : PM_SQUARE;
	return p;
}

static inline double pm_pairs_unit(int dim) { return dim == 1 ? 2 : dim == 2 ? 2 * pm_pi : 4 * pm_pi; }

/* r^-dim at squared distance d2, from below `pm_pairs_least` on 0. */
PM_SIMD_INLINE pm_simd pm_pairs_bare(int dim, pm_simd d2)
{
	if (dim == 2) {
		pm_simd y = pm_simd_reciprocal_start(d2), e = pm_simd_fnma(d2, y, pm_simd_all(1)), z = pm_simd_fma(y, e, y);
		return pm_simd_fma(z, e * e, z);
	}
	pm_simd y = pm_simd_rsqrt_start(d2), y2 = y * y, e = pm_simd_fnma(d2, y2, pm_simd_all(1));
	pm_simd a = dim == 3 ? y2 * y : y;
	double c1 = dim == 3 ? 1.5 : 0.5, c2 = dim == 3 ? 1.875 : 0.375, c3 = dim == 3 ? 2.1875 : 0.3125; /* (1-e)^(-3/2), (1-e)^(-1/2) */
	pm_simd s = pm_simd_fma(e, pm_simd_fma(e, pm_simd_all(c3), pm_simd_all(c2)), pm_simd_all(c1));
	return pm_simd_fma(a * e, s, a);
}

/* Lanes that need the mollifier's own functions. */
static __attribute__((noinline, unused)) void pm_pairs_one_by_one(const struct pm_field_pairs *p, bool potential, const pm_simd *r2, pm_simd *f, pm_simd *u)
{
	const struct pm_mollifier *m = p->mollifier;
	double c = pm_pairs_unit(p->dim);
	for (int l = 0; l < PM_SIMD_WIDTH; l++)
		if ((*r2)[l] < p->near2) {
			(*f)[l] = c * m->force((*r2)[l], p->delta, p->dim);
			if (potential)
				(*u)[l] = c * m->potential((*r2)[l], p->delta, p->dim);
		}
}

/* ln r, 0 for coincident particles. */
static __attribute__((noinline, unused)) void pm_pairs_logarithm(const pm_simd *d2, pm_simd *u)
{
	for (int l = 0; l < PM_SIMD_WIDTH; l++)
		(*u)[l] = (*d2)[l] < pm_pairs_least ? 0 : 0.5 * log((*d2)[l]);
}

/* Force factor and potential of a unit strength at r^2 + delta2 = d2, in units of pm_pairs_unit(dim). */
PM_SIMD_INLINE void pm_pairs_meet(const struct pm_field_pairs *p, int dim, enum pm_pairs_mode mode, bool potential, pm_simd d2, pm_simd *f, pm_simd *u)
{
	*f = pm_pairs_bare(dim, d2);
	if (mode != PM_SQUARE)
		*f = pm_simd_where_not_below(d2, pm_simd_all(pm_pairs_least), *f);
	if (potential && dim != 2)
		*u = dim == 3 ? -*f * d2 : *f * d2;
	else if (potential)
		pm_pairs_logarithm(&d2, u);
	if (mode == PM_OTHER && pm_simd_any_below(d2, pm_simd_all(p->near2)))
		pm_pairs_one_by_one(p, potential, &d2, f, u);
}

/* Lanes whose particle is not i, or comes after i; lane l is particle first + l. */
PM_SIMD_INLINE pm_simd pm_pairs_others(size_t first, size_t i, pm_simd v)
{
	int64_t at = (int64_t)i - (int64_t)first;
	return (pm_simd)((pm_simd_bits)v & (pm_simd_lanes() != at));
}
PM_SIMD_INLINE pm_simd pm_pairs_after(size_t first, size_t i, pm_simd v)
{
	int64_t at = (int64_t)i - (int64_t)first;
	return (pm_simd)((pm_simd_bits)v & (pm_simd_lanes() > at));
}

/* How many of the lanes, of which lane l is particle first + l, are in [from, to) and coincide. */
static __attribute__((noinline, unused)) unsigned pm_pairs_count(size_t first, size_t from, size_t to, const pm_simd *d2)
{
	unsigned c = 0;
	for (size_t l = 0; l < PM_SIMD_WIDTH; l++)
		c += first + l >= from && first + l < to && (*d2)[l] < pm_pairs_least;
	return c;
}

#endif
