/* Reading and writing the stream (docs/stream.md): header, data, tail, end, abort. One reader and one writer for every engine.
 * SPDX-License-Identifier: GPL-3.0-or-later */
#ifndef PM_STREAM_WIRE_H
#define PM_STREAM_WIRE_H

#include "stream/frame.h"

PM_C_BEGIN

enum { PM_LINE = 64, PM_PIECE = 256 * 1024 };

/* Result of pm_read_header; negative: a failure, or an abort in the stream (with its code and message). */
enum { PM_GOT_EOF = 0, PM_GOT_FRAME = 1, PM_GOT_END = 2 };

struct pm_reader;
struct pm_writer;

struct pm_reader *pm_reader_open(const char *path); /* NULL: standard input; NULL returned on failure */
struct pm_reader *pm_reader_of_fd(int fd);          /* closes fd when closed */
struct pm_reader *pm_reader_close(struct pm_reader *r);
/* Where its input ends between two streams, it asks for the next one: 1 and a descriptor, 0 if there is none, or failure. */
void pm_reader_then(struct pm_reader *r, int (*next)(void *from, int *fd), void *from);
uint64_t pm_reader_frame(const struct pm_reader *r);  /* number of the frame being read, from 1 in every input */
bool pm_reader_aborted(const struct pm_reader *r);    /* the failure was an abort sent by a stage upstream */

/* Next header. Fields of the frame hold no data yet (uniform ones their values). */
int pm_read_header(struct pm_reader *r, struct pm_frame **f);
/* The data and the tail of that frame, after a stage has declared its fields: loads the fields in use (all if hold), passes unchanged ones to the
 * writer if there is one, discards the rest. Checks every checksum; values of fields in use must be finite. */
int pm_read_payload(struct pm_reader *r, struct pm_frame *f, bool hold, struct pm_writer *w);
/* The same for a program that declares its reads but runs no stage: loads those fields, discards the rest. */
int pm_read_declared(struct pm_reader *r, struct pm_frame *f);
/* A whole frame, everything loaded: header and payload in one call. */
int pm_read_frame(struct pm_reader *r, struct pm_frame **f);
void pm_reader_give_up(struct pm_reader *r, bool (*when)(void)); /* asked five times a second while it waits */

/* NULL or -: standard output (refused on a terminal). A file that is there is replaced when a whole stream has been written and the writer is closed; until
 * then, and where the stream is cut, it stays as it was. */
struct pm_writer *pm_writer_open(const char *path);
struct pm_writer *pm_writer_lasting(const char *path); /* also where no file is there yet, and on the disk before it counts as written */
int pm_writer_file(const struct pm_writer *w);         /* its descriptor */
bool pm_writer_to_file(const struct pm_writer *w);     /* all ranks may write it, at their own offsets */
struct pm_writer *pm_writer_of_fd(int fd);
int pm_writer_close(struct pm_writer *w);           /* 0 or failure; frees in any case */
bool pm_writer_dirty(const struct pm_writer *w);    /* something has been written */

int pm_write_header(struct pm_writer *w, const struct pm_frame *f);
int pm_write_payload(struct pm_writer *w, struct pm_frame *f); /* the fields not forwarded by pm_read_payload, and the tail */
int pm_write_frame(struct pm_writer *w, struct pm_frame *f);   /* header, all fields, tail */
int pm_write_end(struct pm_writer *w);
/* Ends the stream with an abort: fills the bytes announced with zeros and writes the reason. */
int pm_write_abort(struct pm_writer *w, int code, const char *message);

PM_C_END

#endif
