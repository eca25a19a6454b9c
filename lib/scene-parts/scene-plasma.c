/* A plasma in a periodic box.
 * SPDX-License-Identifier: GPL-3.0-or-later */
#include <stdio.h>
#include <string.h>

#include "scene-parts/scene-plasma.h"
#include "stream/declare.h"

void pm_scene_plasma_world(struct pm_frame *f, double length, double background, double dt)
{
	pm_scene_world(f, 0, length, PM_PERIODIC, 0, dt);
	snprintf(f->law, sizeof f->law, "electrostatic");
	json_object_del(f->constants, "G");
	pm_frame_constant_set(f, "eps0", 1);
	pm_frame_constant_set(f, "background", background);
}

int pm_scene_plasma_set(struct pm_frame *f, uint64_t n, int velocities, double charge, double mass, double *x[3], double *v[3])
{
	struct pm_scene_body b;
	if (pm_scene_set(f, "electrons", n, true, mass, &b))
		return -PM_DATA;
	struct pm_field *old = pm_frame_field(f, "electrons", "v"), *q = pm_makes(f, "electrons", "charge", 1, PM_STATE);
	struct pm_field *w = velocities > f->dim ? pm_makes(f, "electrons", "v", velocities, PM_STATE) : old;
	if (!q || !w || pm_field_ready(w))
		return -PM_DATA;
	snprintf(q->unit, sizeof q->unit, "charge");
	snprintf(w->unit, sizeof w->unit, "length/time");
	q->extensive = q->uniform = true;
	q->value[0] = charge;
	for (int c = 0; c < 3; c++) {
		x[c] = c < f->dim ? b.x[c] : NULL;
		v[c] = c < w->components ? pm_out(w, c) : NULL;
	}
	return 0;
}

int pm_scene_plasma_weights(struct pm_frame *f, double *weight[2])
{
	for (int i = 0; i < 2; i++) {
		struct pm_field *field = pm_frame_field(f, "electrons", i ? "mass" : "charge");
		field->uniform = false;
		if (pm_field_ready(field))
			return -PM_DATA;
		weight[i] = pm_out(field, 0);
	}
	return 0;
}

int pm_scene_plasma_given(struct pm_frame *f, const char *name, const char *unit, int components, const double *value)
{
	struct pm_field *field = pm_makes(f, "mesh", name, components, PM_STATE);
	if (!field)
		return -PM_DATA;
	snprintf(field->unit, sizeof field->unit, "%s", unit);
	field->uniform = true;
	memcpy(field->value, value, (size_t)components * sizeof *value);
	return 0;
}

int pm_scene_plasma_whole(double mode, double velocities, int least)
{
	if (mode != floor(mode))
		return pm_fail(PM_USAGE, "--mode %g is not a whole number of waves", mode);
	if (velocities != floor(velocities) || velocities < least)
		return pm_fail(PM_USAGE, "--velocities %g is not a number of components from %d to 3", velocities, least);
	return 0;
}

double pm_scene_fold(double x, double length)
{
	x -= length * floor(x / length);
	return x >= length ? 0 : x;
}
