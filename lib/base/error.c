/* One message per thread, and the code that goes with it. SPDX-License-Identifier: GPL-3.0-or-later */
#include <errno.h>
#include <stdarg.h>
#include <stdio.h>
#include <string.h>

#include "base/base.h"

static _Thread_local char message[1024];
static _Thread_local int last = -PM_DATA;

/* One line, whatever names and texts of a stream or a command are quoted in it: control characters, which a terminal would execute, become blanks or
 * question marks; so do those that UTF-8 writes as two bytes (C2 80 to C2 9F). */
static void one_line(char *text)
{
	for (unsigned char *c = (unsigned char *)text; *c; c++)
		if (*c < ' ' || *c == 0x7f)
			*c = *c == '\n' || *c == '\t' || *c == '\r' ? ' ' : '?';
		else if (*c == 0xc2 && c[1] >= 0x80 && c[1] < 0xa0)
			c[0] = c[1] = '?';
}

int pm_fail(int code, const char *format, ...)
{
	char text[sizeof message]; /* so that the old message may be among the arguments */
	va_list ap;
	va_start(ap, format);
	vsnprintf(text, sizeof text, format, ap);
	va_end(ap);
	one_line(text);
	memcpy(message, text, sizeof message);
	last = -code;
	return last;
}

int pm_fail_errno(const char *format, ...)
{
	char text[sizeof message / 2];
	int error = errno;
	va_list ap;
	va_start(ap, format);
	vsnprintf(text, sizeof text, format, ap);
	va_end(ap);
	return pm_fail(PM_DATA, "%s: %s", text, strerror(error));
}

int pm_failed(void) { return last; }

const char *pm_message(void) { return message; }

int pm_exit_code(int status) { return status >= 0 ? 0 : status == -PM_MISSING ? PM_DATA : -status; }
