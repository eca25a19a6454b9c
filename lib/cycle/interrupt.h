/* Signals that end a run of cycle: the step under way is finished, unless a second signal or a process that does not answer gives it up.
 * SPDX-License-Identifier: GPL-3.0-or-later */
#ifndef PM_CYCLE_INTERRUPT_H
#define PM_CYCLE_INTERRUPT_H

#include "base/base.h"

void pm_interrupt_listen(void);           /* to SIGINT, SIGTERM and SIGHUP, but for nohup; and the chains of processes ask pm_interrupt_gives_up */
int pm_interrupted(void);                 /* the signal that has come; 0 none */
void pm_interrupt_waits(bool processes);  /* some words of the sentence are processes, which may never answer; then a second signal does not wait */
bool pm_interrupt_gives_up(void);         /* a step that waits for processes is not waited for any longer */

#endif
