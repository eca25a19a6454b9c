/* One line on the terminal that is rewritten in place, and is out of the way of messages. SPDX-License-Identifier: GPL-3.0-or-later */
#ifndef PM_STATUS_LINE_H
#define PM_STATUS_LINE_H

#include <stdbool.h>

bool pm_status_possible(void);         /* standard error is a terminal */
void pm_status_line(const char *text); /* in place of the line before, cut to the width of the terminal */
void pm_status_clear(void);            /* before any other text goes to the terminal; nothing to do where there is no such line */

#endif
