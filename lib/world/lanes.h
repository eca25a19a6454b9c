/* Lanes between the processes of a rehearsal: one from each rank to each, in memory that they share, so that most messages need no call of the system.
 * A rank that has nothing to do sleeps till one that concerns it rings its bell. SPDX-License-Identifier: GPL-3.0-or-later */
#ifndef PM_LANES_H
#define PM_LANES_H

#include <stdbool.h>
#include <stddef.h>
#include <stdint.h>

struct pm_lanes;

struct pm_lanes *pm_lanes_new(int n);          /* before the processes part; NULL and a message */
void pm_lanes_keep(struct pm_lanes *l, int rank); /* after it: this process is that rank, whose end the others see */
void pm_lanes_free(struct pm_lanes *l);        /* NULL: nothing */

/* How many of these bytes went into the lane to a rank, or came out of that from it, now. */
size_t pm_lanes_send(struct pm_lanes *l, int to, const void *data, size_t bytes);
size_t pm_lanes_take(struct pm_lanes *l, int from, void *data, size_t bytes);

uint32_t pm_lanes_rings(struct pm_lanes *l);   /* of this rank's bell until now */
void pm_lanes_awake(struct pm_lanes *l);       /* nothing is waited for */
/* Till something comes from `from` (-1: nobody is waited for), or, with `room`, some lane has room again; true: it is time to look who is still there. The
 * first call with new wishes tells them to the others and returns: something may have come before they knew. `rings`: before the lanes were last tried. */
bool pm_lanes_sleep(struct pm_lanes *l, uint32_t rings, int from, bool room);
bool pm_lanes_gone(struct pm_lanes *l, int rank); /* that process has ended */

#endif
