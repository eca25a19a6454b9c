/* Calls from the reader to the writer while a field is passed on. SPDX-License-Identifier: GPL-3.0-or-later */
#ifndef PM_STREAM_FORWARD_H
#define PM_STREAM_FORWARD_H

#include "stream/wire.h"

/* Before a field that has data: where the frame is handed over, the line that announces copies. */
int pm_forward_begin(struct pm_writer *w, size_t bytes);
int pm_forward(struct pm_writer *w, const void *piece, size_t n);
int pm_forward_done(struct pm_writer *w, const struct pm_field *field, uint32_t crc); /* pads; the next field in order must be this one */
int pm_forward_held(struct pm_writer *w, struct pm_field *field); /* all of that at once, of a field whose data are held */

#endif
