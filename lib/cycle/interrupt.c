/* The handler only counts. SPDX-License-Identifier: GPL-3.0-or-later */
#include <signal.h>
#include <stdio.h>

#include "base/status-line.h"
#include "cycle/interrupt.h"
#include "sentence/process-chain.h"

static volatile sig_atomic_t stop, stops, waits;
enum { most_wait = 10 }; /* seconds for which a process may answer after a signal */

/* The first one waits for the end of the step; a second one does not. With processes it gives up the step and keeps the one before. */
static void on_signal(int signal_number)
{
	stop = signal_number;
	if (++stops > (waits ? 1 : 0))
		signal(signal_number, SIG_DFL);
}

bool pm_interrupt_gives_up(void)
{
	static double since;
	if (stop && since == 0) {
		since = pm_seconds();
		pm_status_clear();
		fprintf(stderr, "cycle: signal %d: waits for the processes of this step, %d s at most (a second signal does not wait)\n", (int)stop, most_wait);
	}
	return stops > 1 || (stop && pm_seconds() - since > most_wait);
}

static void listen_to(int signal_number)
{
	if (signal(signal_number, on_signal) == SIG_IGN && signal_number == SIGHUP)
		signal(signal_number, SIG_IGN); /* nohup */
}

void pm_interrupt_listen(void)
{
	pm_chain_give_up = pm_interrupt_gives_up;
	listen_to(SIGINT);
	listen_to(SIGTERM);
	listen_to(SIGHUP);
}

int pm_interrupted(void) { return stop; }

void pm_interrupt_waits(bool processes) { waits = processes; }
