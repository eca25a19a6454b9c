/* The loops of push: blocks of particles that stay in cache, each advanced by every action of the push and then taken through the faces of the
 * box, so that a push costs one pass through memory. Elementwise: the same bytes for any number of threads.
 * SPDX-License-Identifier: GPL-3.0-or-later */
#ifndef PM_STEP_ADVANCE_H
#define PM_STEP_ADVANCE_H

#include <string.h>

#include "mesh/particle-faces.h"
#include "step/step.h"

enum { PM_ADVANCE_BLOCK = 1024, PM_ADVANCE_ACTIONS = 16 };

/* One component of one state, with its rate and registers; n values each. */
struct pm_advanced {
	double *y;
	const double *k;
	double *q[PM_REGISTERS]; /* NULL beyond those in use */
	bool position;
};

/* What one push does to one group of lines. */
struct pm_advance {
	int actions;
	struct {
		const struct pm_step *step;
		int pass;
		double dt;
	} action[PM_ADVANCE_ACTIONS];
	int shift;     /* registers that remember rates: the newest goes to q[0]; 0 none */
	int registers; /* of the scheme itself begin behind this many */
};

/* The faces an axis has for one set. */
struct pm_bounds {
	double lo, hi; /* [length] */
	bool fold, mirror[2];
};

/* Lines of one axis, which is what a mirror changes together: x, v and their registers. */
static inline void pm_advance_faces(size_t i, size_t n, const struct pm_bounds *b, double *x, double *v, int nlines, const struct pm_advanced *lines)
{
	if (b->fold)
		pm_particle_faces_fold(n, b->lo, b->hi, x + i);
	if (!b->mirror[0] && !b->mirror[1])
		return;
	double *w[1 + 2 * PM_REGISTERS] = {v ? v + i : NULL};
	int nw = 1;
	for (int l = 0; l < nlines; l++)
		for (int r = 0; r < PM_REGISTERS; r++)
			if (lines[l].q[r] && nw < (int)(sizeof w / sizeof *w))
				w[nw++] = lines[l].q[r] + i;
	pm_particle_faces_reflect(n, b->lo, b->hi, b->mirror, x + i, nw, w);
}

static inline bool pm_advance_applies(const struct pm_step *step, bool position)
{
	return step->kind == PM_SCHEME || (step->kind == PM_DRIFT) == position;
}

static inline void pm_advance_line(size_t i, size_t n, const struct pm_advance *a, const struct pm_advanced *l)
{
	double *q[PM_REGISTERS];
	for (int r = 0; r < PM_REGISTERS; r++)
		q[r] = l->q[r] ? l->q[r] + i : NULL;
	for (int t = 0; t < a->actions; t++)
		if (pm_advance_applies(a->action[t].step, l->position))
			a->action[t].step->pass(a->action[t].pass, a->action[t].dt, n, l->y + i, l->k + i, q + a->registers);
	for (int r = a->shift - 1; r >= 0; r--)
		memcpy(q[r], r ? q[r - 1] : l->k + i, n * sizeof *q[r]);
}

static inline bool pm_advance_finite(size_t i, size_t n, const struct pm_advanced *l)
{
	bool finite = pm_finite_few(n, l->y + i);
	for (int r = 0; r < PM_REGISTERS; r++)
		finite &= !l->q[r] || pm_finite_few(n, l->q[r] + i);
	return finite;
}

/* Advances n particles along one axis (or, with x NULL, states that belong to none). lines: positions first, because their rate is the velocity
 * before this pass; but kicks go before drifts, and then the velocity is the new one. True if everything is finite afterwards. */
static inline bool pm_advance_axis(size_t n, const struct pm_advance *a, int nlines, const struct pm_advanced *lines, double *x, double *v,
	const struct pm_bounds *b)
{
	bool kick_first = a->actions && a->action[0].step->kind == PM_KICK;
	size_t blocks = (n + PM_ADVANCE_BLOCK - 1) / PM_ADVANCE_BLOCK;
	int bad = 0;
#pragma omp parallel for schedule(static) reduction(| : bad) if (n > 16384)
	for (size_t block = 0; block < blocks; block++) {
		size_t i = block * PM_ADVANCE_BLOCK, m = n - i < PM_ADVANCE_BLOCK ? n - i : PM_ADVANCE_BLOCK;
		for (int l = 0; l < nlines; l++)
			pm_advance_line(i, m, a, lines + (kick_first ? nlines - 1 - l : l));
		if (x && b)
			pm_advance_faces(i, m, b, x, v, nlines, lines);
		for (int l = 0; l < nlines; l++)
			bad |= !pm_advance_finite(i, m, lines + l);
	}
	return !bad;
}

/* Moves the values whose gone is 0 to the front, in order; size bytes each. The number left. */
static inline size_t pm_advance_compact(size_t n, const unsigned char *gone, size_t size, void *values)
{
	unsigned char *p = values;
	size_t left = 0;
	for (size_t i = 0; i < n; i++)
		if (!gone[i]) {
			if (left != i)
				memcpy(p + left * size, p + i * size, size);
			left++;
		}
	return left;
}

#endif
