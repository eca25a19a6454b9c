/* A stream in a file: FILE.h5 is read and written by sh5 through a pipe, so that no other program links HDF5. SPDX-License-Identifier: GPL-3.0-or-later */
#ifndef PM_STAGE_H5_PIPE_H
#define PM_STAGE_H5_PIPE_H

#include "stream/wire.h"

struct pm_h5_pipe; /* an sh5 process that writes a file for this program */

const char *pm_home(void); /* the directory of this program and the other words; NULL if unknown */
bool pm_h5_pipe_is(const char *path); /* does it end in .h5 or .hdf5? */
/* What a file holds, by its first bytes; by its name where it is no regular file. */
enum pm_file_kind { PM_FILE_OTHER, PM_FILE_STREAM, PM_FILE_HDF5 };
enum pm_file_kind pm_file_kind(const char *path);
int pm_h5_pipe_fd(const char *path); /* the file as a stream, to read; a failure to read it arrives there as an abort */
struct pm_reader *pm_h5_pipe_open(const char *path); /* a stream in a file of either kind, or standard input for NULL and "-" */
int pm_h5_pipe_first(const char *path, struct pm_frame **f); /* its first frame, whole; 0 or failure */
struct pm_writer *pm_h5_pipe_write(const char *path, struct pm_h5_pipe **rest);
/* After a failure of the stage: if sh5 failed first, its reason becomes the message; else returns status unchanged. */
int pm_h5_pipe_reason(struct pm_h5_pipe *rest, int status);
int pm_h5_pipe_close(struct pm_h5_pipe *rest); /* after closing the writer: waits for sh5; 0, or its failure. Accepts NULL. */

#endif
