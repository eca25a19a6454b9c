/* A run of a word on several ranks (docs/distributed.md). Rank 0 leads: it parses, reads, writes, decides and speaks, as a run alone does. The others follow:
 * they wait for what it asks them to do. SPDX-License-Identifier: GPL-3.0-or-later */
#ifndef PM_RANKS_H
#define PM_RANKS_H

#include "stage/stage.h"

enum { PM_RANKS_MOST = 64 }; /* rehearsed: a lane of shared memory for each pair */

int pm_ranks_launch(void);                           /* under a launcher: opens its world. 0 or failure */
int pm_ranks_rehearse(int n);                        /* --ranks. 0 or failure */
int pm_ranks_compare(const struct pm_tool *tool);    /* all ranks: are they the same program on the same kind of processor? 0 or failure, agreed */
int pm_ranks_follow(const struct pm_tool *tool);     /* ranks other than 0: returns the exit status when the run has ended */
int pm_ranks_end(void);                              /* rank 0: the others end. 0 or failure */

#endif
