/* One message per thread, and the code that goes with it. SPDX-License-Identifier: GPL-3.0-or-later */
#include <errno.h>
#include <stdarg.h>
#include <stdio.h>
#include <string.h>

#include "base/base.h"

static _Thread_local char message[1024];
static _Thread_local int last = -PM_DATA;

int pm_fail(int code, const char *format, ...)
{
	char text[sizeof message]; /* so that the old message may be among the arguments */
	va_list ap;
	va_start(ap, format);
	vsnprintf(text, sizeof text, format, ap);
	va_end(ap);
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
