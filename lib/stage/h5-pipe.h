/* The stream at rest: a FILE.h5 is read and written by sh5 on a pipe, so that no other program links HDF5. SPDX-License-Identifier: GPL-3.0-or-later */
#ifndef PM_STAGE_H5_PIPE_H
#define PM_STAGE_H5_PIPE_H

#include "stream/wire.h"

struct pm_h5_pipe; /* an sh5 that writes for us */

const char *pm_home(void); /* the directory of this program, where its sisters are; NULL if it cannot be told */
bool pm_h5_pipe_is(const char *path); /* does it end in .h5? */
struct pm_reader *pm_h5_pipe_read(const char *path); /* a failure comes down the stream as an abort */
struct pm_reader *pm_h5_pipe_open(const char *path); /* a stream in a file of either kind, or standard input for NULL and "-" */
struct pm_writer *pm_h5_pipe_write(const char *path, struct pm_h5_pipe **rest);
/* While the stage fails: if sh5 failed first that is the reason, which becomes the message; else status as it is. */
int pm_h5_pipe_reason(struct pm_h5_pipe *rest, int status);
int pm_h5_pipe_close(struct pm_h5_pipe *rest); /* the writer is closed: waits; 0, or how sh5 failed. Accepts NULL. */

#endif
