/* The loops of push, block by block (state-advance.h); of arrays of floats a block is computed as doubles and rounded. Cost: the states, rates and registers
 * once through memory.
 * SPDX-License-Identifier: GPL-3.0-or-later */
#include <string.h>

#include "base/largest.h"
#include "mesh/particle-faces.h"
#include "push/state-advance.h"
#include "push/state-rates.h"

/* The lines of one axis, which a mirror changes together: x, v and their registers. */
static void take_through_faces(size_t n, const struct pm_bounds *b, double *x, double *v, int nlines, const struct pm_advanced *lines)
{
	if (b->fold)
		pm_particle_faces_fold(n, b->lo, b->hi, x);
	if (!b->mirror[0] && !b->mirror[1])
		return;
	double *w[1 + 2 * PM_REGISTERS] = {v};
	int nw = 1;
	for (int l = 0; l < nlines; l++)
		for (int r = 0; r < PM_REGISTERS; r++)
			if (lines[l].q[r] && nw < (int)(sizeof w / sizeof *w))
				w[nw++] = lines[l].q[r];
	pm_particle_faces_reflect(n, b->lo, b->hi, b->mirror, x, nw, w);
}

static bool applies(const struct pm_step *step, bool position)
{
	return step->kind == PM_SCHEME || (step->kind == PM_DRIFT) == position;
}

/* A pass of a composition: the part of dt that its kick or drift has. */
static void compose(const struct pm_step *step, int pass, double dt, size_t n, const struct pm_advanced *l)
{
	const double part = dt * (l->position ? step->drifts : step->kicks)[pass];
	for (size_t j = 0; j < n; j++)
		l->y[j] += part * l->k[j];
}

static void advance(size_t n, const struct pm_advance *a, const struct pm_advanced *l)
{
	double *q[PM_REGISTERS];
	for (int r = 0; r < PM_REGISTERS; r++)
		q[r] = l->q[r];
	for (int t = 0; t < a->actions; t++)
		if (a->action[t].step->kicks)
			compose(a->action[t].step, a->action[t].pass, a->action[t].dt, n, l);
		else if (applies(a->action[t].step, l->position))
			a->action[t].step->pass(a->action[t].pass, a->action[t].dt, n, l->y, l->k, q + a->registers);
	for (int r = a->shift - 1; r >= 0; r--)
		memcpy(q[r], r ? q[r - 1] : l->k, n * sizeof *q[r]);
}

static bool all_finite(size_t n, const struct pm_advanced *l)
{
	bool finite = pm_finite_few(n, l->y);
	for (int r = 0; r < PM_REGISTERS; r++)
		finite &= !l->q[r] || pm_finite_few(n, l->q[r]);
	return finite;
}

/* Blocks of floats as doubles, each once: the rate of a position is a state too. */
enum { few = 256 };

struct widened {
	int n;
	struct {
		const float *from;
		float *to; /* NULL: only read */
		double room[few];
	} of[2 * PM_RATES + 2];
};

static double *widen(struct widened *w, const float *from, float *to, size_t i, size_t m)
{
	int k = 0;
	while (k < w->n && w->of[k].from != from)
		k++;
	if (k == w->n) {
		w->of[w->n++].from = from, w->of[k].to = NULL;
		for (size_t j = 0; j < m; j++)
			w->of[k].room[j] = from[i + j];
	}
	if (to)
		w->of[k].to = to;
	return w->of[k].room;
}

static void put_back(const struct widened *w, size_t i, size_t m)
{
	for (int k = 0; k < w->n; k++)
		for (size_t j = 0; j < m && w->of[k].to; j++)
			w->of[k].to[i + j] = (float)w->of[k].room[j];
}

/* The lines of a block: from its first particle on. */
static void lines_from(size_t i, size_t m, int n, const struct pm_advanced *lines, struct widened *w, struct pm_advanced *to)
{
	for (int l = 0; l < n; l++) {
		to[l] = (struct pm_advanced){.position = lines[l].position};
		to[l].y = lines[l].y ? lines[l].y + i : widen(w, lines[l].y_floats, lines[l].y_floats, i, m);
		to[l].k = lines[l].k ? lines[l].k + i : widen(w, lines[l].k_floats, NULL, i, m);
		for (int r = 0; r < PM_REGISTERS; r++)
			to[l].q[r] = lines[l].q[r] ? lines[l].q[r] + i : NULL;
	}
}

/* What all blocks of an axis have in common. */
struct axis {
	const struct pm_advance *a;
	int nlines;
	const struct pm_advanced *lines;
	double *x, *v;
	const struct pm_bounds *b;
	bool fastest;
};

/* m particles from i on; w: room for floats, NULL where there are none. */
static int block_of(const struct axis *s, size_t i, size_t m, struct widened *w, int64_t *most)
{
	const bool kick_first = s->a->actions && (s->a->action[0].step->kind == PM_KICK || s->a->action[0].step->kicks);
	const struct pm_bounds *b = s->b;
	struct pm_advanced here[PM_RATES];
	int bad = 0;
	lines_from(i, m, s->nlines, s->lines, w, here);
	for (int l = 0; l < s->nlines; l++) {
		const struct pm_advanced *line = here + (kick_first ? s->nlines - 1 - l : l);
		advance(m, s->a, line);
		if (s->fastest && line->position)
			pm_largest_few(m, line->k, most);
	}
	if (b && (s->x || b->x_floats)) {
		double *place = s->x ? s->x + i : widen(w, b->x_floats, b->x_floats, i, m);
		take_through_faces(m, b, place, s->v ? s->v + i : b->v_floats ? widen(w, b->v_floats, b->v_floats, i, m) : NULL, s->nlines, here);
	}
	for (int l = 0; l < s->nlines; l++)
		bad |= !all_finite(m, here + l);
	if (w)
		put_back(w, i, m);
	return bad;
}

/* A few at a time, with room on the stack that doubles do not need. */
__attribute__((noinline)) static int block_of_floats(const struct axis *s, size_t from, size_t end, int64_t *most)
{
	struct widened w;
	int bad = 0;
	for (size_t i = from; i < end; i += few) {
		w.n = 0;
		bad |= block_of(s, i, end - i < few ? end - i : few, &w, most);
	}
	return bad;
}

bool pm_advance_axis(size_t n, const struct pm_advance *a, int nlines, const struct pm_advanced *lines, double *x, double *v,
	const struct pm_bounds *b, double *fastest)
{
	const struct axis s = {a, nlines, lines, x, v, b, fastest};
	size_t blocks = (n + PM_ADVANCE_BLOCK - 1) / PM_ADVANCE_BLOCK;
	bool floats = b && (b->x_floats || b->v_floats);
	int bad = 0;
	int64_t most = 0;
	for (int l = 0; l < nlines; l++)
		floats |= lines[l].y_floats || lines[l].k_floats;
#pragma omp parallel for schedule(static) reduction(| : bad) reduction(max : most) if (n * (size_t)nlines > pm_many_turns())
	for (size_t block = 0; block < blocks; block++) {
		const size_t i = block * PM_ADVANCE_BLOCK, end = n - i < PM_ADVANCE_BLOCK ? n : i + PM_ADVANCE_BLOCK;
		bad |= floats ? block_of_floats(&s, i, end, &most) : block_of(&s, i, end - i, NULL, &most);
	}
	if (fastest)
		*fastest = pm_of_bits(most);
	return !bad;
}

bool pm_advance_few(size_t n, const struct pm_advance *a, int nlines, const struct pm_advanced *lines, double *x, const struct pm_bounds *b, int64_t *most)
{
	const struct axis s = {a, nlines, lines, x, NULL, b, most != NULL};
	return !block_of(&s, 0, n, NULL, most);
}
