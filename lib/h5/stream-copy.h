/* A stream into an HDF5 file and back, frame by frame: what sh5 does. SPDX-License-Identifier: GPL-3.0-or-later */
#ifndef PM_H5_STREAM_COPY_H
#define PM_H5_STREAM_COPY_H

#include "h5/h5.h"

/* Each 0 or failure. The stream into the file, which is finished where the stream ends. */
int pm_h5_from_stream(struct pm_h5 *h, struct pm_reader *r);
/* The file onto the stream. entry: appended to the history of frames that were no stream before; NULL none. */
int pm_h5_to_stream(struct pm_h5 *h, struct pm_writer *w, json_t *entry);

#endif
