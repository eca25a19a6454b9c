/* The state of a frame as one vector (state-vector.h). Numbers are divided by a scale of their field, so that positions and velocities weigh alike.
 * SPDX-License-Identifier: GPL-3.0-or-later */
#include <math.h>
#include <string.h>

#include "modes/state-vector.h"
#include "push/random-walk.h"
#include "stream/run.h"

/* Is there a rate of this state? */
static bool has_rate(const struct pm_frame *f, const struct pm_field *field)
{
	for (size_t i = 0; i < f->nfields; i++)
		if (f->fields[i]->role == PM_CHANGE && !strcmp(f->fields[i]->on, field->on) && !strcmp(f->fields[i]->of, field->name))
			return true;
	return false;
}

/* Strengths and external fields on meshes are parameters, unless they have a rate. */
static bool takes(const struct pm_frame *f, const struct pm_frame *rates, const struct pm_field *field)
{
	const struct pm_set *set = pm_frame_set(f, field->on);
	if ((field->type != PM_F64 && field->type != PM_F32) || !field->count || (set && !pm_set_moves(f, set)))
		return false;
	return field->role == PM_REGISTER || (field->role == PM_STATE && ((set && !field->extensive) || has_rate(rates, field)));
}

/* Root of the mean square, about the mean for positions. */
static double rms(const struct pm_field *field, bool about_mean)
{
	double sum = 0;
	for (int c = 0; c < field->components; c++) {
		double mean = 0;
		const double *x = field->uniform ? NULL : pm_in(field, c);
		for (size_t i = 0; i < field->count && about_mean && x; i++)
			mean += x[i] / (double)field->count;
		for (size_t i = 0; i < field->count && x; i++)
			sum += (x[i] - mean) * (x[i] - mean) / (double)field->count;
		if (!x && !about_mean)
			sum += field->value[c] * field->value[c];
	}
	return sqrt(sum);
}

/* The mean distance of the particles of a set. */
static double spacing(const struct pm_frame *f, const char *on)
{
	const struct pm_field *x = pm_frame_field(f, on, "x");
	const double spread = x ? rms(x, true) * pow((double)x->count, -1.0 / f->dim) : 0, size = x ? rms(x, false) : 0;
	return spread > 0 ? spread : size > 0 ? size : 1;
}

static double scale_of(const struct pm_frame *f, double dt, const struct pm_field *field)
{
	const double length = spacing(f, field->on);
	const bool set = pm_frame_set(f, field->on) != NULL;
	if (set && !strcmp(field->name, "x"))
		return length;
	if (set && (!strcmp(field->name, "v") || field->role == PM_REGISTER))
		return length / dt;
	const double size = rms(field, false);
	return size > 0 ? size : 1;
}

int pm_state_vector_of(struct pm_state_vector *v, const struct pm_frame *f, const struct pm_frame *rates, double dt)
{
	*v = (struct pm_state_vector){0};
	for (int d = 0; d < f->dim; d++)
		v->period[d] = f->pface[d][0] == PM_PFOLD ? f->hi[d] - f->lo[d] : 0;
	for (size_t i = 0; i < f->nfields; i++) {
		const struct pm_field *field = f->fields[i];
		if (!takes(f, rates, field))
			continue;
		if (v->parts == PM_STATE_PARTS)
			return pm_fail(PM_DATA, "more than %d fields of state", PM_STATE_PARTS);
		struct pm_state_part *p = v->part + v->parts++;
		snprintf(p->on, sizeof p->on, "%s", field->on);
		snprintf(p->name, sizeof p->name, "%s", field->name);
		p->components = field->components;
		p->count = field->count;
		p->role = field->role;
		p->position = pm_frame_set(f, field->on) && !strcmp(field->name, "x");
		p->scale = scale_of(f, dt != 0 ? fabs(dt) : 1, field);
		v->n += (size_t)p->components * p->count;
	}
	return v->n ? 0 : pm_fail(PM_DATA, "no state with real numbers that moves (sls lists the fields)");
}

/* Positions back into the box. */
static void fold(const struct pm_frame *f, struct pm_field *field)
{
	double *x[3] = {NULL, NULL, NULL};
	for (int c = 0; c < f->dim && c < field->components; c++)
		x[c] = pm_out(field, c);
	pm_walk_faces(f, field->count, x);
}

struct pm_frame *pm_state_moved(const struct pm_state_vector *v, const struct pm_frame *f, const double *vector, double by)
{
	struct pm_frame *copy = pm_frame_copy(f);
	bool ready = copy != NULL;
	if (ready) {
		pm_drops_roles(copy, NULL, 1u << PM_CHANGE | 1u << PM_DERIVED);
		for (size_t i = 0; i < copy->nsets; i++)
			pm_drops_roles(copy, copy->sets[i]->name, 1u << PM_CHANGE | 1u << PM_DERIVED);
	}
	for (int k = 0; k < v->parts && ready && vector; k++)
		ready = pm_changes(copy, v->part[k].on, v->part[k].name) != NULL;
	ready = ready && !pm_frame_ready(copy);
	for (int k = 0; k < v->parts && ready && vector; k++) {
		const struct pm_state_part *p = v->part + k;
		struct pm_field *field = pm_frame_field(copy, p->on, p->name);
		for (int c = 0; c < p->components; c++, vector += p->count) {
			double *x = pm_out(field, c);
			for (size_t i = 0; i < p->count; i++)
				x[i] += by * p->scale * vector[i];
		}
		if (p->position)
			fold(copy, field);
	}
	ready = ready && !pm_frame_settle(copy);
	return ready ? copy : pm_frame_free(copy);
}

int pm_state_difference(const struct pm_state_vector *v, const struct pm_frame *a, const struct pm_frame *b, double by, double *out)
{
	for (int k = 0; k < v->parts; k++) {
		const struct pm_state_part *p = v->part + k;
		const struct pm_field *one = pm_frame_field(a, p->on, p->name), *two = pm_frame_field(b, p->on, p->name);
		if (!one || !two || one->count != p->count || two->count != p->count)
			return pm_fail(PM_DATA, "the sentence changes the number of values of '%s' on '%s': it has no linear map (leave out the "
				"word that removes or adds particles)", p->name, p->on);
		for (int c = 0; c < p->components; c++, out += p->count) {
			const double *x = one->uniform ? NULL : pm_in(one, c), *y = two->uniform ? NULL : pm_in(two, c);
			const double period = p->position && c < 3 ? v->period[c] : 0;
			for (size_t i = 0; i < p->count; i++) {
				double d = (x ? x[i] : one->value[c]) - (y ? y[i] : two->value[c]);
				if (period > 0)
					d -= period * nearbyint(d / period);
				out[i] = d / p->scale / by;
			}
		}
	}
	return 0;
}
