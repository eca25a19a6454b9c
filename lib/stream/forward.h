/* Data of fields piece by piece: from the reader to the writer while a field is passed on, from and to programs that hold none.
 * SPDX-License-Identifier: GPL-3.0-or-later */
#ifndef PM_STREAM_FORWARD_H
#define PM_STREAM_FORWARD_H

#include "stream/piece-ring.h"

/* Before a field that has data: where the frame is handed over, the line that announces copies. */
int pm_forward_begin(struct pm_writer *w, size_t bytes);
void *pm_forward_room(struct pm_writer *w); /* PM_PIECE bytes, where a piece may be made; NULL: failure */
int pm_forward(struct pm_writer *w, const void *piece, size_t n); /* at most PM_PIECE bytes */
int pm_forward_done(struct pm_writer *w, const struct pm_field *field, uint32_t crc); /* pads; the next field in order must be this one */
int pm_forward_held(struct pm_writer *w, struct pm_field *field); /* all of that at once, of a field whose data are held */

/* Instead of pm_read_payload, for a program that holds no field: the next `bytes` of the data (at most PM_PIECE, of one component, f32 as float), valid until
 * the next call; behind all of them the tail. */
int pm_read_values(struct pm_reader *r, size_t bytes, const void **values);
int pm_read_tail(struct pm_reader *r, struct pm_frame *f);
uint32_t pm_reader_sum(const struct pm_reader *r); /* CRC-32C of the component whose last value has been read */

/* A writer in a process made by fork(), whose descriptor is a new pipe now. Its data go into the ring, if there is one; the reader takes them from there. */
void pm_writer_forked(struct pm_writer *w, struct pm_ring *ring);
void pm_reader_ring(struct pm_reader *r, struct pm_ring *ring);

#endif
