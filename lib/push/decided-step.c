/* Lines, header and clock of schemes whose step ends where the data say so (decided-step.h). Cost: little; folding goes once through the positions.
 * SPDX-License-Identifier: GPL-3.0-or-later */
#include <stdlib.h>

#include "mesh/particle-faces.h"
#include "push/decided-step.h"
#include "stream/declare.h"
#include "world/world.h"

static struct pm_decided_line line_of(struct pm_moving *m, struct pm_rate *rate, int c, bool paired)
{
	struct pm_decided_line l = {.moving = m, .rate = rate, .c = c, .n = rate->state->count, .y = pm_out(rate->state, c)};
	const struct pm_field *k = rate->rate;
	l.k = k->use & (PM_USE_CHANGE | PM_USE_NEW) ? pm_out(rate->rate, c) : pm_in(k, c);
	for (int i = 0; i < PM_REGISTERS; i++)
		l.q[i] = rate->q[i] ? pm_out(rate->q[i], c) : NULL;
	for (int r = 0; r < m->n && paired && rate->state == m->v; r++)
		if (m->rates[r].state == m->x && c < m->x->components)
			l.x = pm_out(m->x, c), l.x_start = pm_out(m->rates[r].q[0], c);
	return l;
}

int pm_decided_lines(size_t n, struct pm_moving *moving, bool paired, struct pm_decided_line **lines)
{
	int count = 0;
	*lines = calloc(n * PM_RATES * PM_COMPONENTS + 1, sizeof **lines);
	if (!*lines)
		return pm_no_memory();
	for (size_t i = 0; i < n; i++)
		for (int r = 0; r < moving[i].n; r++)
			for (int c = 0; c < pm_rate_components(&moving[i].rates[r]); c++)
				if (!(paired && moving[i].v && moving[i].rates[r].state == moving[i].x))
					(*lines)[count++] = line_of(&moving[i], &moving[i].rates[r], c, paired);
	return count;
}

void pm_decided_fold(const struct pm_frame *f, size_t n, const struct pm_moving *moving)
{
	for (size_t i = 0; i < n; i++)
		for (int a = 0; a < f->dim && a < moving[i].x->components; a++)
			if (f->pface[a][0] == PM_PFOLD)
				pm_particle_faces_fold(moving[i].x->count, f->lo[a], f->hi[a], pm_out(moving[i].x, a));
}

double pm_decided_recall(const struct pm_moving *m, const char *key)
{
	const double x = json_number_value(json_object_get(json_object_get(m->set->more, "scheme"), key));
	return isfinite(x) ? x : 0;
}

void pm_decided_mark(struct pm_frame *f, size_t n, struct pm_moving *moving, json_t *memory, int pass, double at)
{
	json_object_set_new(memory, "name", json_string(moving[0].pass.step->name));
	for (size_t i = 0; i < n; i++) {
		struct pm_set *s = moving[i].set;
		if (!s->more)
			s->more = json_object();
		json_object_set(s->more, "scheme", memory);
		s->pass = pass;
		s->drift = pass ? at : 1;
		s->kick = !pass;
	}
	json_decref(memory);
	pm_clock_close(f);
}

void pm_decided_drop(struct pm_frame *f, size_t n, struct pm_moving *moving, int from)
{
	for (size_t i = 0; i < n; i++)
		for (int r = 0; r < moving[i].n; r++)
			for (int q = from; q < PM_REGISTERS; q++)
				if (moving[i].rates[r].q[q]) {
					pm_drops(f, moving[i].rates[r].q[q]);
					moving[i].rates[r].q[q] = NULL;
				}
}

void pm_decided_largest(const struct pm_field *state, size_t n, double *x)
{
	if (state->here && pm_world_largest(0, n, x))
		pm_cannot_go_on();
}

double pm_decided_max(size_t n, const double *y)
{
	double most = 0;
#pragma omp parallel for schedule(static) reduction(max : most) if (n > pm_many_turns())
	for (size_t i = 0; i < n; i++)
		most = fmax(most, fabs(y[i]));
	return most;
}
