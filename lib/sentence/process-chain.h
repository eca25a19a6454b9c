/* A chain: words run as long-lived processes joined by pipes. A frame goes in at one end and comes out at the other.
 * SPDX-License-Identifier: GPL-3.0-or-later */
#ifndef PM_SENTENCE_PROCESS_CHAIN_H
#define PM_SENTENCE_PROCESS_CHAIN_H

#include "stream/wire.h"

struct pm_chain;

extern bool (*pm_chain_give_up)(void); /* cycle's: a process that does not answer is not waited for any longer; NULL: it is */
/* words: the argv of each process, NULL ends each and all; words of pmpipe are found beside this program, others on PATH. */
struct pm_chain *pm_chain_new(char ***words);
/* Sends the frame through the chain and replaces it by the result. */
int pm_chain_apply(struct pm_chain *c, struct pm_frame **f);
int pm_chain_close(struct pm_chain *c); /* sends the end, waits for the processes; frees in any case */

#endif
