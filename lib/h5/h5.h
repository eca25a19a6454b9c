/* A stream in a file: frames in HDF5 in the layout of openPMD 1.1 (docs/methods/hdf5.md). Linked into sh5 only.
 * SPDX-License-Identifier: GPL-3.0-or-later */
#ifndef PM_H5_H
#define PM_H5_H

#include "stream/wire.h"

struct pm_h5;

/* Writing goes to PATH.part, which becomes PATH when the file is complete. */
struct pm_h5 *pm_h5_create(const char *path);
int pm_h5_put(struct pm_h5 *h, struct pm_frame *f, struct pm_reader *r); /* a header; its data and tail are read here */
int pm_h5_put_end(struct pm_h5 *h);                 /* an end marker stood here */
int pm_h5_finish(struct pm_h5 *h);

struct pm_h5 *pm_h5_open(const char *path, const char *word); /* word: as typed, the key of its report */
/* PM_GOT_FRAME, PM_GOT_END, PM_GOT_EOF or failure. foreign: the file was not written by sh5, and the frame has its data; else pm_h5_send writes it. */
int pm_h5_get(struct pm_h5 *h, struct pm_frame **f, bool *foreign);
int pm_h5_send(struct pm_h5 *h, struct pm_frame *f, struct pm_writer *w);

struct pm_h5 *pm_h5_free(struct pm_h5 *h); /* deletes an unfinished file */

#endif
