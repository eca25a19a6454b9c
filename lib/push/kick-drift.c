/* v += a k, v += b k, x += c v of one axis, and x folded into a periodic box: the loops of state-advance.c in one, the sums of a particle in their order, so
 * the same bytes. Cost: x and v read and written once, k read once, where those loops read 13 numbers of a particle and write 3, all in the L1 cache.
 * SPDX-License-Identifier: GPL-3.0-or-later */
#define PM_SIMD_NARROW
#include "base/simd.h"
#include "mesh/particle-faces.h"
#include "push/kick-drift.h"

bool pm_kick_drift_is(const struct pm_advance *close, const struct pm_advance *open, struct pm_kick_drift *to)
{
	const bool plain = open->actions == 2 && open->action[0].step->kind == PM_KICK && open->action[1].step->kind == PM_DRIFT &&
		(!close || (close->actions == 1 && close->action[0].step->kind == PM_KICK));
	if (plain)
		*to = (struct pm_kick_drift){.kicks = close ? 2 : 1, .kick = {close ? close->action[0].dt : 0, open->action[0].dt},
			.drift = open->action[1].dt};
	return plain;
}

PM_SIMD_INLINE void raise_bits(pm_simd_bits *most, pm_simd v)
{
	const pm_simd_bits size = (pm_simd_bits)v & INT64_MAX, above = size > *most;
	*most = (size & above) | (*most & ~above);
}

PM_SIMD_INLINE int64_t largest_of(pm_simd_bits v)
{
	int64_t most = 0;
	for (int l = 0; l < PM_SIMD_WIDTH; l++)
		most = v[l] > most ? v[l] : most;
	return most;
}

/* Of whole vectors. */
PM_SIMD_INLINE bool move(bool twice, size_t n, const struct pm_kick_drift *s, const struct pm_bounds *b, const double *k, double *v, double *x, int64_t *most)
{
	const pm_simd first = pm_simd_all(s->kick[0]), second = pm_simd_all(s->kick[1]), drift = pm_simd_all(s->drift);
	const pm_simd lo = pm_simd_all(b->lo), below_hi = pm_simd_all(nextafter(b->hi, -INFINITY));
	pm_simd_bits size = {0};
	bool finite = true;
	for (size_t i = 0; i < n; i += PM_SIMD_WIDTH) {
		const pm_simd rate = pm_simd_load_any(k + i);
		pm_simd w = pm_simd_load_any(v + i);
		w = twice ? w + first * rate : w;
		w += second * rate;
		const pm_simd y = pm_simd_load_any(x + i) + drift * w;
		pm_simd_store_any(v + i, w);
		pm_simd_store_any(x + i, y);
		__builtin_prefetch(v + i + PM_KICK_DRIFT_AHEAD, 1);
		raise_bits(&size, w);
		if (pm_simd_outside(y, lo, below_hi)) {
			pm_particle_faces_fold(PM_SIMD_WIDTH, b->lo, b->hi, x + i);
			finite = finite && pm_finite_few(PM_SIMD_WIDTH, x + i);
		}
	}
	const int64_t largest = largest_of(size);
	*most = largest > *most ? largest : *most;
	return finite && isfinite(pm_of_bits(largest));
}

size_t pm_kick_drift(size_t n, const struct pm_kick_drift *s, const struct pm_bounds *b, const double *k, double *v, double *x, int64_t *most, bool *finite)
{
	n -= n % PM_SIMD_WIDTH;
	*finite &= s->kicks == 2 ? move(true, n, s, b, k, v, x, most) : move(false, n, s, b, k, v, x, most);
	return n;
}
