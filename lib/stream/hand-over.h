/* Memory handed over between two programs of ours at the ends of a pipe (docs/stream.md): the reader listens on a socket that has the number of the pipe in its
 * name, the writer connects to it, and sends the descriptors of blocks. The bytes of the stream, and who reads the pipe otherwise, are as without.
 * SPDX-License-Identifier: GPL-3.0-or-later */
#ifndef PM_STREAM_HAND_OVER_H
#define PM_STREAM_HAND_OVER_H

#include "base/shared-block.h"
#include "stream/wire.h"

enum { PM_HAND_LEAST = 1 << 16 }; /* [bytes] of a field: smaller ones are copied */

/* What a line `given` says of a field, beside the id of its block. */
struct pm_given {
	uint64_t id;
	uint32_t crc;    /* if summed: the checksum of its bytes in the stream */
	bool summed, finite;
	bool floats;     /* the block has floats, where the field is of type f32; else doubles */
	bool comes;      /* with a descriptor on the socket */
};

struct pm_hands; /* one end */
struct pm_hands *pm_hands_listen(int pipe);  /* NULL: not a pipe, or there are no such sockets */
struct pm_hands *pm_hands_connect(int pipe); /* NULL: not a pipe, or who reads it does not listen */
struct pm_hands *pm_hands_close(struct pm_hands *h);

int pm_hands_give(struct pm_hands *h, struct pm_shared *b, bool *comes);          /* counts a use for the other end; 0 or failure */
struct pm_shared *pm_hands_take(struct pm_hands *h, const struct pm_given *what); /* with that use; NULL and a message */
/* A frame on its way holds its memory, and as many bytes of a pipe would hold hundreds of them: a writer waits until the one before has been read. False: the
 * other end has ended. */
bool pm_hands_wait(struct pm_hands *h);
void pm_hands_taken(struct pm_hands *h); /* the reader: of a frame in which something was given */

uint64_t pm_given_bits(const struct pm_given *g);
struct pm_given pm_given_of(uint64_t id, uint64_t bits);
/* Of a writer: true where the frames of its pipe are handed over; before a header. */
bool pm_writer_hands(struct pm_writer *w);
/* pm_write_payload of a frame whose values nobody here will use again: the next word may write into them. */
int pm_write_last(struct pm_writer *w, struct pm_frame *f);

#endif
