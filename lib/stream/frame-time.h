/* The time of a frame by its number of steps, not as a sum of steps, whose round-off would grow with their number:
 *   time = since.time + (step - since.step) dt
 * since is where dt, time or step were last set. SPDX-License-Identifier: GPL-3.0-or-later */
#ifndef PM_STREAM_FRAME_TIME_H
#define PM_STREAM_FRAME_TIME_H

#include "stream/frame.h"

double pm_frame_time_at(const struct pm_frame *f, int64_t step); /* the time at which that step begins */
bool pm_frame_since_holds(const struct pm_frame *f);             /* since gives the frame's own time; within a step, that at which it began */
void pm_frame_since_renew(struct pm_frame *f);                   /* since = the frame's own time and step; after time, dt or step were set */
void pm_frame_dt_set(struct pm_frame *f, double dt);             /* the next steps have this length; only at substep 0 */

#endif
