/* Values divided among the ranks (docs/distributed.md). Rank 0 holds the frame, and of a divided field its own stretch; the other ranks hold theirs under a
 * number, and do what rank 0 asks: requests. For lib/stream and the layer that runs stages.
 * SPDX-License-Identifier: GPL-3.0-or-later */
#ifndef PM_STREAM_PARTS_H
#define PM_STREAM_PARTS_H

#include <stdatomic.h>

#include "base/shared-block.h"
#include "stream/frame.h"

struct pm_buffer {
	atomic_int users;
	void *data;     /* all values, component by component; NULL: only the parts are there (rank 0), or never (other ranks) */
	void *part;     /* the own stretch; NULL: the values are not divided */
	uint64_t id;    /* of the parts on all ranks; 0: not divided */
	uint64_t *from; /* the beginnings of the stretches, one more than ranks; with id */
	size_t size;    /* [bytes] of a value; with id */
	int components; /* with id */
	float *floats;  /* the values of an f32 field that rests (below), beside data or in their place; NULL: data alone has them */
	struct pm_shared *shared; /* data, or where there are floats these, are in this block, which other processes may read; NULL: they are of this process */
	double oscillation;       /* [1/time] the limit (limits.h) that data told when they were made; 0: none */
	struct pm_later *later;   /* data are made by this when they are asked for (later.h); NULL: they are there, or divided */
	struct pm_note *note; /* ranks other than 0: that of its field between two words, for which a frame is made anew */
};
struct pm_buffer *pm_buffer_new(size_t n, size_t size, bool zero); /* data for n values; NULL: failure */
struct pm_buffer *pm_buffer_adopt(double *data); /* of pm_alloc, taken over; NULL: data of others are shared, or failure */
struct pm_buffer *pm_buffer_free(struct pm_buffer *b);             /* gives up one use; returns NULL */
struct pm_buffer *pm_buffer_of_shared(struct pm_shared *b);        /* takes over a use of it; NULL: failure, and the use is given up */
void pm_buffer_to_floats(struct pm_buffer *b);                     /* data becomes floats: the caller has filled it with them, or will */
void pm_buffer_drop_data(struct pm_buffer *b);                     /* the floats stay */
void pm_buffer_drop_floats(struct pm_buffer *b);                   /* data stays */
void pm_buffers_share(bool yes);                                   /* large new ones are in blocks that can be handed over (hand-over.h) */
int pm_buffer_users(const struct pm_buffer *b);                    /* those of other processes count as one */
bool pm_buffer_alone(const struct pm_buffer *b);                   /* one use, here and in other processes: it may be written */

/* An f32 field between two stages, where there are no ranks: */
bool pm_field_rests(const struct pm_field *field);    /* it is held as floats */
int pm_field_hold_floats(struct pm_field *field);     /* a buffer of its own, contents undefined */
/* Of f64: values that pm_alloc made become those of the field; false: they do not, as where fields are handed to other processes. */
bool pm_field_adopt(struct pm_field *field, double *data);
float *pm_field_floats(const struct pm_field *field); /* all components; NULL: it is not */

/* The division of n values: beginnings at multiples of a grain, as even as these allow; free() it. NULL: no memory. */
uint64_t *pm_division_new(uint64_t n, uint64_t grain);
/* Of a set 4096 particles; of a mesh a plane in 3-D, 16 rows in 2-D (a transform joins as many), in 1-D all points. */
uint64_t pm_division_grain(const struct pm_frame *f, const char *on);

/* Rank 0. 0 or failure. */
int pm_buffer_divide(struct pm_buffer *b, int components, size_t size, const uint64_t *from); /* gives every rank its part, if it has none */
int pm_buffer_join(struct pm_buffer *b);     /* brings all values together, if they are not; the parts stay valid */
/* The values of b behind those of a, whose parts they have; divided as `to`: *made has parts alone. */
int pm_buffer_append(const struct pm_buffer *a, const struct pm_buffer *b, const uint64_t *to, struct pm_buffer **made);
void pm_buffer_undivide(struct pm_buffer *b);/* all values will change here: the parts are forgotten */
uint64_t pm_parts_number(void);              /* a number for new parts */

enum pm_request { PM_REQUEST_END, PM_REQUEST_APPLY, PM_REQUEST_DIVIDE, PM_REQUEST_JOIN, PM_REQUEST_FORGET, PM_REQUEST_READ, PM_REQUEST_WRITE,
	PM_REQUEST_TALLY, PM_REQUEST_SOURCE, PM_REQUEST_APPEND };
int pm_request_send(enum pm_request what, const void *more, size_t bytes);           /* rank 0 */
int pm_request_take(enum pm_request *what, void **more, size_t *bytes);              /* the others; *more stays until the next */
int pm_request_parts(enum pm_request what, const void *more, size_t bytes);          /* does one that concerns parts alone */
/* Ranks other than 0: the part of this number, with a further use of it; NULL if there is none. take: it is given up here. */
struct pm_buffer *pm_parts_of(uint64_t id, bool take);
int pm_parts_keep(uint64_t id, struct pm_buffer *b);                                 /* a further use */
void pm_parts_free(void);

/* A field made in frame() of a divided frame, on all ranks: count is of all, and becomes that of this rank. Whoever runs the stage frees from. 0 or failure. */
int pm_field_share(struct pm_field *field, uint64_t grain);
/* A field of a divided frame: the values that are divided as `from` in its part, the first of them in front, are divided as `to` now. Takes the caller's status
 * and returns the agreed one. */
int pm_field_recut(int status, struct pm_field *field, const uint64_t *from, const uint64_t *to);
/* Between these the field is this rank's stretch alone: field->count values, the first of them number field->first. */
int pm_field_enter(struct pm_field *field, const uint64_t *from);
void pm_field_leave(struct pm_field *field, const uint64_t *from, uint64_t id); /* id: of the parts that the field has now */

#endif
