/* Images in plane walls: the field of particles in the half of space (or the quarter, the eighth) that walls leave is that of the particles and of their
 * images in every combination of the walls, in open space. A scalar strength changes its sign in a wall, where the potential is 0, and keeps it in a
 * neumann face, where its normal derivative is. Of a vector (vorticity, which is a curl) the components along a wall change their sign and the
 * normal one stays, so that nothing flows through; in a neumann face the other way round. Self images act too: a vortex beside a wall moves.
 * Source: Milne-Thomson 1968, Theoretical Hydrodynamics, 13.40; Jackson 1999, section 2.1. Sources 2^walls - 1 times more.
 * SPDX-License-Identifier: GPL-3.0-or-later */
#include <string.h>

#include "far/wall-images.h"

static bool closed(enum pm_face face) { return face == PM_WALL || face == PM_NEUMANN; }

bool pm_wall_alone(const struct pm_frame *f, int axis)
{
	const enum pm_face *face = f->face[axis];
	return (closed(face[0]) && face[1] == PM_OPEN) || (closed(face[1]) && face[0] == PM_OPEN);
}

/* The closed end of an axis that has one. */
static int end_of(const struct pm_frame *f, int axis) { return closed(f->face[axis][1]); }

/* The factor of component c of a strength (-1: it is a scalar) in the mirrors of the set of axes. */
static double parity(const struct pm_frame *f, unsigned mirrors, int c)
{
	double sign = 1;
	for (int a = 0; a < f->dim; a++)
		if (mirrors >> a & 1)
			sign *= (f->face[a][end_of(f, a)] == PM_WALL) == (c != a) ? -1 : 1;
	return sign;
}

static int inside(const struct pm_frame *f, unsigned walls, const struct pm_bodies *b)
{
	for (size_t i = 0; i < b->n; i++)
		for (int a = 0; a < f->dim; a++) {
			const int end = end_of(f, a);
			const double at = end ? f->hi[a] : f->lo[a], x = b->x[a][i];
			if (walls >> a & 1 && (end ? x > at : x < at))
				return pm_fail(PM_DATA, "a particle at %c = %.10g is outside the %s at %.10g, where there is no field (shorter steps, or "
					"particle faces that reflect)", "xyz"[a], x, pm_face_names[f->face[a][end]], at);
		}
	return 0;
}

/* Room for the images behind what is there; the old values stay. */
static bool grow(double **p, size_t had, size_t n)
{
	double *more = pm_alloc(n, sizeof *more);
	if (more)
		memcpy(more, *p, had * sizeof *more), pm_free(*p), *p = more;
	return more;
}

static bool room(const struct pm_frame *f, const struct pm_far *far, struct pm_bodies *b, size_t images)
{
	const size_t n = b->n * (images + 1) + 1, sets = b->sets * (images + 1) + 1;
	size_t *count = pm_alloc(sets, sizeof *count), *own = pm_zalloc(2 * sets, sizeof *own);
	bool good = count && own;
	if (good) {
		memcpy(count, b->count, b->sets * sizeof *count), memcpy(own, b->own, 2 * b->sets * sizeof *own);
		pm_free(b->count), pm_free(b->own);
		b->count = count, b->own = own;
	} else {
		pm_free(count), pm_free(own);
	}
	for (int d = 0; d < f->dim; d++)
		good = good && grow(&b->x[d], b->n, n);
	good = good && grow(&b->q, b->n, n);
	for (int d = 0; d < 3 && far->vector; d++)
		good = good && grow(&b->alpha[d], b->n, n);
	return good;
}

static bool weightless(const struct pm_bodies *b, size_t from, size_t n)
{
	bool none = true;
	for (size_t i = from; i < from + n && none; i++)
		for (int d = 0; d < 3 && none; d++)
			none = b->alpha[0] ? b->alpha[d][i] == 0 : b->q[i] == 0;
	return none;
}

/* One set in one combination of mirrors. */
static void reflect(const struct pm_frame *f, unsigned mirrors, struct pm_bodies *b, size_t from, size_t n)
{
	for (int a = 0; a < f->dim; a++) {
		const double twice = 2 * (end_of(f, a) ? f->hi[a] : f->lo[a]);
		for (size_t i = 0; i < n; i++)
			b->x[a][b->n + i] = mirrors >> a & 1 ? twice - b->x[a][from + i] : b->x[a][from + i];
	}
	for (size_t i = 0; i < n; i++)
		b->q[b->n + i] = parity(f, mirrors, -1) * b->q[from + i];
	for (int d = 0; d < 3 && b->alpha[0]; d++)
		for (size_t i = 0; i < n; i++)
			b->alpha[d][b->n + i] = parity(f, mirrors, d) * b->alpha[d][from + i];
	b->count[b->sets++] = n;
	b->n += n;
}

int pm_wall_images(const struct pm_frame *f, const struct pm_far *far, struct pm_bodies *b)
{
	unsigned walls = 0;
	size_t images = 1;
	for (int a = 0; a < f->dim; a++)
		if (pm_wall_alone(f, a))
			walls |= 1u << a, images *= 2;
	if (!walls)
		return 0;
	int status = inside(f, walls, b);
	if (!status && !room(f, far, b, images - 1))
		status = -PM_DATA;
	const size_t sets = b->sets;
	for (unsigned mirrors = 1; mirrors <= walls && !status; mirrors++)
		for (size_t s = 0, at = 0; s < sets && !(mirrors & ~walls); at += b->count[s++])
			if (!weightless(b, at, b->count[s]))
				reflect(f, mirrors, b, at, b->count[s]);
	return status;
}
