/* Faces of the box for particles: fold, mirror, absorb.
 * A particle may have moved any distance: whole boxes are subtracted at once. NaN stays NaN.
 * SPDX-License-Identifier: GPL-3.0-or-later */
#include "mesh/particle-faces.h"

/* Whether any of a few values is not in [lo, hi), or [lo, hi] if closed. */
static inline bool any_outside(size_t n, double lo, double hi, bool closed, const double *x)
{
	int out = 0;
	for (size_t i = 0; i < n; i++)
		out |= (x[i] < lo) | (closed ? x[i] > hi : x[i] >= hi);
	return out;
}

void pm_particle_faces_fold(size_t n, double lo, double hi, double *x)
{
	enum { FEW = 128 }; /* most particles stay inside, and the test is cheaper than folding */
	double length = hi - lo;
	for (size_t b = 0; b < n; b += FEW) {
		size_t m = n - b < FEW ? n - b : FEW;
		if (!any_outside(m, lo, hi, false, x + b))
			continue;
		for (size_t i = b; i < b + m; i++) {
			double y = x[i] - length * floor((x[i] - lo) / length);
			y = y < lo || y >= hi ? lo : y; /* -1e-17 + L rounds to L, which is lo */
			x[i] = x[i] >= lo && x[i] < hi ? x[i] : y;
		}
	}
}

/* Mirrors one position; true if the velocity changes sign. */
static bool mirror_one(double lo, double hi, const bool mirror[2], double *x)
{
	double y = *x, length = hi - lo;
	bool flip = false;
	if (mirror[0] && mirror[1] && (y < lo - length || y > hi + length)) /* two mirrors: the motion repeats after two lengths */
		y -= 2 * length * floor((y - lo) / (2 * length));
	for (int i = 0; i < 2; i++) { /* no more are needed: after the first it is within one length */
		if (mirror[0] && y < lo)
			y = lo + (lo - y), flip = !flip;
		if (mirror[1] && y > hi)
			y = hi - (y - hi), flip = !flip;
	}
	*x = y;
	return flip;
}

void pm_particle_faces_reflect(size_t n, double lo, double hi, const bool mirror[2], double *x, int nw, double *const *w)
{
	if (!any_outside(n, lo, hi, true, x))
		return;
	for (size_t i = 0; i < n; i++)
		if (mirror_one(lo, hi, mirror, x + i))
			for (int k = 0; k < nw; k++)
				if (w[k])
					w[k][i] = -w[k][i];
}

void pm_particle_faces_absorb(size_t n, double lo, double hi, const bool absorb[2], const double *x, unsigned char *gone)
{
	for (size_t i = 0; i < n; i++)
		gone[i] |= (absorb[0] && x[i] < lo) || (absorb[1] && x[i] > hi);
}
