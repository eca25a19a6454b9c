/* The line is rewritten by a carriage return, and the rest erased by CSI K (ECMA-48), which every terminal of today knows.
 * SPDX-License-Identifier: GPL-3.0-or-later */
#include <stdio.h>
#include <sys/ioctl.h>
#include <unistd.h>

#include "base/status-line.h"

static bool shown;

bool pm_status_possible(void) { return isatty(STDERR_FILENO); }

static int width(void)
{
	struct winsize w;
	return !ioctl(STDERR_FILENO, TIOCGWINSZ, &w) && w.ws_col > 1 ? w.ws_col - 1 : 79;
}

void pm_status_line(const char *text)
{
	shown = true;
	fprintf(stderr, "\r%.*s\033[K", width(), text);
	fflush(stderr);
}

void pm_status_clear(void)
{
	if (shown)
		fputs("\r\033[K", stderr);
	shown = false;
}
