/* The 64-byte lines of the stream, with the checksum of their words and of the block behind them. SPDX-License-Identifier: GPL-3.0-or-later */
#ifndef PM_STREAM_LINE_H
#define PM_STREAM_LINE_H

#include "stream/wire.h"

struct pm_line {
	char word[16];      /* frame, tail, end, abort, or another in small letters; shared, given and copied: hand-over.h */
	uint64_t number[2]; /* frame, abort, shared and given have two, the others one */
	bool sealed;        /* false: of a version that wrote no checksum */
	uint32_t crc, seal; /* CRC-32C of the words before the checksum; the checksum of the line */
};

int pm_line_parse(const char text[PM_LINE], struct pm_line *line);
int pm_line_check(const struct pm_line *line, const void *block, size_t bytes, const char *what); /* the checksum, unless PM_UNSEALED=1 */
void pm_line_seal(char out[PM_LINE], const char *words, const void *block, size_t bytes);         /* the words, their checksum, spaces, newline */

static inline size_t pm_line_padded(size_t bytes) { return (bytes + PM_LINE - 1) / PM_LINE * PM_LINE; }

#endif
