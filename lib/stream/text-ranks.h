/* A text file that all ranks read, each its share of the rows of a table; lines between tables each rank reads itself. No rank holds more of the text than a
 * line and a piece for each thread. Functions with a status are called by all ranks, and return the agreed one. SPDX-License-Identifier: GPL-3.0-or-later */
#ifndef PM_STREAM_TEXT_RANKS_H
#define PM_STREAM_TEXT_RANKS_H

#include "stream/table.h"

struct pm_text_ranks {
	int fd;
	size_t at, held, room; /* data of the text are its bytes from `at` on, so many of them */
	size_t nmarks, *mark;  /* where lines begin that begin a table or end one */
	uint64_t *rows;        /* of the table under way: the first one that each rank reads, one more than ranks */
};

/* 1: they will read it; 0: some rank cannot, or it is no file, so that rank 0 reads all; or failure. */
int pm_text_ranks_open(struct pm_text *t, const char *path);
void pm_text_ranks_close(struct pm_text *t);
const char *pm_text_ranks_line(struct pm_text *t, size_t at, size_t *end); /* the line from there on, followed by a newline or a 0, which is byte *end */
char *pm_text_ranks_piece(const struct pm_text *t, size_t begin, size_t end); /* followed by a 0; pm_free; NULL: failure. Threads may ask at once. */
/* The share of this rank of the lines between two beginnings of lines. */
void pm_text_ranks_share(struct pm_text *t, size_t *begin, size_t *end);
/* Where lines begin that `is` one of interest. */
int pm_text_ranks_marks(struct pm_text *t, bool (*is)(const char *line));
size_t pm_text_ranks_mark(const struct pm_text *t, size_t at); /* the first of these beyond there, or the end of the text */
/* Rows and lines of each rank: *first and *line become what there is before this one, *rows and *lines what all have. */
int pm_text_ranks_count(int status, struct pm_text *t, size_t *rows, uint64_t *lines, size_t *first, uint64_t *line);
int pm_text_ranks_field(const struct pm_text *t, struct pm_field *field); /* the rows read here are its values: without a status. 0 or failure */
void pm_text_ranks_field_free(struct pm_field *field); /* of a table whose reading failed, so that no stage gets it */
int pm_text_ranks_settle(int status, const struct pm_text *t, const struct pm_frame *f, struct pm_field *field); /* now divided as every field is */

#endif
