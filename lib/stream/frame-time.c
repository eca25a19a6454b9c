/* The time of a frame by its number of steps. SPDX-License-Identifier: GPL-3.0-or-later */
#include "stream/frame-time.h"

static double began(const struct pm_frame *f) { return f->substep ? f->start : f->time; }

double pm_frame_time_at(const struct pm_frame *f, int64_t step) { return f->since_time + (double)(step - f->since_step) * f->dt; }

bool pm_frame_since_holds(const struct pm_frame *f) { return pm_frame_time_at(f, f->step) == began(f); }

void pm_frame_since_renew(struct pm_frame *f)
{
	f->since_time = began(f);
	f->since_step = f->step;
}

void pm_frame_dt_set(struct pm_frame *f, double dt)
{
	if (dt == f->dt)
		return;
	f->dt = dt;
	pm_frame_since_renew(f);
}
