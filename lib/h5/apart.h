/* HDF5 in a process of its own: libhdf5 crashes on some damaged files, and runs for ever on others. SPDX-License-Identifier: GPL-3.0-or-later */
#ifndef PM_H5_APART_H
#define PM_H5_APART_H

#include "h5/h5.h"

/* A second process reads the file; its stream is passed on here, frame by frame, and checked; seen() is called with each. 1: this is that process, which
 * writes the stream to standard output; else 0 or failure, for it is done. */
int pm_h5_read_apart(const char *path, struct pm_writer *w, void (*seen)(void *who, const struct pm_frame *f), void *who);
/* A second process writes the file. 1: this is that process; else failure. It does not return where that process has ended by itself. */
int pm_h5_write_apart(void);
/* It reads a further file, and may use more memory. */
void pm_h5_more_room(const char *path);
/* The process that reads goes on to the next piece of the file: it may use this much time for it [s], or be ended. */
void pm_h5_goes_on(size_t bytes);

#endif
