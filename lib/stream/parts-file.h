/* Fields of a regular file, read and written by all ranks, each its own stretch at its own offset. The bytes and checksums are those of one rank alone.
 * SPDX-License-Identifier: GPL-3.0-or-later */
#ifndef PM_STREAM_PARTS_FILE_H
#define PM_STREAM_PARTS_FILE_H

#include "stream/parts.h"

/* Where a field is in a file. */
struct pm_parts_place {
	const char *path;
	uint64_t offset; /* [bytes] of its first value */
	bool lasting;    /* it will be waited for */
	int only;        /* to write this component alone, counted from 1; 0: all of them, one after the other */
};

struct pm_reader;
/* As pm_read_declared (wire.h), by all ranks where the input is a file: what they read stays with them, and is not checked to be finite. */
int pm_read_by_ranks(struct pm_reader *r, struct pm_frame *f);

enum { PM_PARTS_ELSEWHERE = 1 }; /* a rank does not see the file */
/* Rank 0. Each 0, PM_PARTS_ELSEWHERE or failure, agreed; *crc: CRC-32C of all bytes of the field on the wire. */
int pm_parts_read(const struct pm_frame *f, struct pm_field *field, const struct pm_parts_place *place, uint32_t *crc); /* the field gets parts alone */
int pm_parts_write(const struct pm_field *field, const struct pm_parts_place *place, uint32_t *crc);                    /* it has parts */
/* What all ranks have written to this file is on the disk when it returns: each waits for what it wrote itself, once for all fields. */
int pm_parts_lasting(const char *path);
bool pm_parts_worth_reading(const struct pm_frame *f, const struct pm_field *field); /* several ranks would have some */
bool pm_parts_alone(const struct pm_field *field);                                   /* they are all there is: rank 0 has no copy */
/* The other ranks, asked to. */
int pm_parts_file_follow(enum pm_request what, const void *more, size_t bytes);

#endif
