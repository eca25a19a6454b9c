/* With q = t/dt in a step, k the rates of the stages, D = y1 - y0, B = dt k_first - D and C = D - dt k_last - B:
 *   y(q) = y0 + q (D + (1 - q) (B + q (C + (1 - q) dt sum_j dense_j k_j))),
 * the cubic through values and rates at both ends, and for rk45 one term more, order 4. Source: Hairer, Norsett and Wanner 1993, section II.6.
 * Cost: the registers once through memory.
 * SPDX-License-Identifier: GPL-3.0-or-later */
#include <string.h>

#include "mesh/particle-faces.h"
#include "cycle/dense-output.h"
#include "push/step-clock.h"
#include "stream/declare.h"
#include "stream/frame-time.h"
#include "stream/run.h"

/* The pair whose rates a set carries; NULL: none. */
static const struct pm_step *pair_of(const struct pm_frame *f, const struct pm_set *s)
{
	const char *name = json_string_value(json_object_get(json_object_get(s->more, "scheme"), "name"));
	char q[PM_NAME];
	for (int i = 0; name && pm_steps[i]; i++)
		if (!strcmp(name, pm_steps[i]->name) && pm_steps[i]->embedded) {
			pm_register_name(q, pm_steps[i]->embedded->stages, "x");
			return pm_frame_field(f, s->name, q) ? pm_steps[i] : NULL;
		}
	return NULL;
}

bool pm_dense_has(const struct pm_frame *f)
{
	bool any = false;
	for (size_t i = 0; i < f->nsets; i++)
		if (pm_set_moves(f, f->sets[i])) {
			any = pair_of(f, f->sets[i]);
			if (!any)
				return false;
		}
	return any && f->substep == 0;
}

void pm_dense_leave_out(struct pm_frame *f)
{
	for (size_t i = 0; i < f->nsets; i++)
		pm_drops_roles(f, f->sets[i]->name, 1u << PM_REGISTER);
}

/* The registers of a state, declared as read; false: it has none. */
static bool registers(struct pm_frame *f, const struct pm_field *state, int stages, struct pm_field *q[PM_EMBEDDED_STAGES + 1])
{
	for (int i = 0; i <= stages; i++) {
		char name[PM_NAME];
		pm_register_name(name, i, state->name);
		struct pm_field *there = pm_frame_field(f, state->on, name);
		if (!there || there->role != PM_REGISTER || !(q[i] = pm_reads(f, state->on, name)))
			return false;
	}
	return true;
}

static void between(const struct pm_embedded *e, double q, double dt, size_t n, const double *const r[PM_EMBEDDED_STAGES + 1], double *y)
{
	const int s = e->stages;
#pragma omp parallel for schedule(static) if (n > 16384)
	for (size_t i = 0; i < n; i++) {
		double d = 0, last = 0;
		for (int j = 0; j < s; j++) {
			d += j + 1 < s ? dt * e->a[s - 1][j] * r[j + 1][i] : 0;
			last += dt * e->dense[j] * r[j + 1][i];
		}
		const double b = dt * r[1][i] - d, c = d - dt * r[s][i] - b;
		y[i] = r[0][i] + q * (d + (1 - q) * (b + q * (c + (1 - q) * last)));
	}
}

static int fill(struct pm_frame *f, struct pm_set *s, double time)
{
	const struct pm_step *pair = pair_of(f, s);
	const double dt = json_number_value(json_object_get(json_object_get(s->more, "scheme"), "dt"));
	struct pm_field *states[PM_RATES], *q[PM_RATES][PM_EMBEDDED_STAGES + 1];
	int n = 0, stages = pair->embedded->stages;
	for (size_t i = 0; i < f->nfields && n < PM_RATES; i++)
		if (f->fields[i]->role == PM_STATE && !strcmp(f->fields[i]->on, s->name) && registers(f, f->fields[i], stages, q[n]))
			states[n++] = f->fields[i];
	for (int i = 0; i < n; i++)
		if (!pm_changes(f, s->name, states[i]->name))
			return -PM_DATA;
	if (pm_frame_ready(f))
		return -PM_DATA;
	for (int i = 0; i < n; i++)
		for (int c = 0; c < states[i]->components && c < q[i][0]->components; c++) {
			const double *r[PM_EMBEDDED_STAGES + 1];
			for (int k = 0; k <= stages; k++)
				r[k] = pm_in(q[i][k], c);
			between(pair->embedded, (time - (f->time - dt)) / dt, dt, s->n, r, pm_out(states[i], c));
			if (!strcmp(states[i]->name, "x") && c < f->dim && f->pface[c][0] == PM_PFOLD)
				pm_particle_faces_fold(s->n, f->lo[c], f->hi[c], pm_out(states[i], c));
		}
	return 0;
}

struct pm_frame *pm_dense_frame(const struct pm_frame *f, double time)
{
	struct pm_frame *copy = pm_frame_copy(f);
	int status = copy ? 0 : -PM_DATA;
	for (size_t i = 0; i < f->nsets && !status; i++)
		if (pm_set_moves(f, f->sets[i]))
			status = fill(copy, copy->sets[i], time);
	if (!status) {
		pm_dense_leave_out(copy);
		pm_drops_roles(copy, NULL, 1u << PM_CHANGE | 1u << PM_DERIVED);
		for (size_t i = 0; i < copy->nsets; i++) {
			pm_drops_roles(copy, copy->sets[i]->name, 1u << PM_CHANGE | 1u << PM_DERIVED);
			json_object_del(copy->sets[i]->more, "scheme");
		}
		copy->step--;
		copy->time = copy->start = time;
		pm_frame_since_renew(copy);
		status = pm_frame_settle(copy);
	}
	return status ? pm_frame_free(copy) : copy;
}
