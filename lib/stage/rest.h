/* The stream at rest: a FILE.h5 is read and written by sh5 on a pipe, so that no other program links HDF5. SPDX-License-Identifier: GPL-3.0-or-later */
#ifndef PM_REST_H
#define PM_REST_H

#include "stream/wire.h"

struct pm_rest; /* an sh5 that writes for us */

const char *pm_home(void); /* the directory of this program, where its sisters are; NULL if it cannot be told */
bool pm_rest_is(const char *path); /* does it end in .h5? */
struct pm_reader *pm_rest_read(const char *path); /* a failure comes down the stream as an abort */
struct pm_reader *pm_rest_open(const char *path); /* a stream in a file of either kind, or standard input for NULL and "-" */
struct pm_writer *pm_rest_write(const char *path, struct pm_rest **rest);
/* While the stage fails: if sh5 failed first that is the reason, which becomes the message; else status as it is. */
int pm_rest_reason(struct pm_rest *rest, int status);
int pm_rest_close(struct pm_rest *rest); /* the writer is closed: waits; 0, or how sh5 failed. Accepts NULL. */

#endif
