/* Tables of text: a line of column names, then one row per line, separated by blanks or tabs, or by commas; lines that are empty or start with '#' are
 * skipped.
 * SPDX-License-Identifier: GPL-3.0-or-later */
#ifndef PM_STREAM_TABLE_H
#define PM_STREAM_TABLE_H

#include <stdio.h>

#include "stream/frame.h"

enum { PM_COLUMNS = 256 };

struct pm_table_column {
	char name[PM_NAME];
	struct pm_field *field; /* NULL: skip the column */
	int component;
	bool text;   /* a u8 field whose components are the letters, ended by 0 if shorter */
};

/* A text and the current position. */
struct pm_text {
	char *data;    /* all of it in memory, followed by a 0 that is not counted; with ranks: see text-ranks.h */
	size_t size, at;
	uint64_t line; /* of `at`, from 1 */
	bool csv;      /* its tables have commas */
	struct pm_text_ranks *ranks; /* all ranks read it, each its share of the rows; NULL: it is in memory */
};

int pm_text_open(struct pm_text *t, const char *path); /* reads all of it; "-" is standard input */
void pm_text_close(struct pm_text *t);
/* Of a file that all ranks can read; all call it. 1: each will read its share; 0: it is for rank 0 to open; or failure. */
int pm_text_open_by_ranks(struct pm_text *t, const char *path);
const char *pm_text_line(struct pm_text *t, size_t at, size_t *end); /* the text from there to byte *end, a newline or the end; valid until the next call */
/* Before a plain table: sets csv by its line of names; refuses semicolons. */
int pm_text_separator(struct pm_text *t);
/* The next line that is neither empty nor a comment, split into names; 0 at the end of the text. */
int pm_text_names(struct pm_text *t, size_t end, struct pm_table_column *column);
size_t pm_text_line_end(struct pm_text *t, size_t at); /* the newline, or the end of the text */
/* Of a text that ranks share all call the following with their status and get the agreed one; else a failure is returned as it is. */
/* Rows between the current position and end. */
int pm_table_count(int status, struct pm_text *t, size_t end, size_t *rows);
/* Before it holds data: a field gets as many values as rows will be read here. */
int pm_table_field(const struct pm_text *t, struct pm_field *field);
/* Reads the rows that were counted into fields that hold data for them. Errors are reported with line and column. */
int pm_table_read(int status, struct pm_text *t, size_t end, const struct pm_frame *f, int ncolumns, const struct pm_table_column *column);

/* The columns of the fields of `on` without uniform ones: x y z for x, vx vy vz for v, NAME, or NAME_0 NAME_1 ...; all different. Returns their number. */
int pm_table_columns(const struct pm_frame *f, const char *on, struct pm_table_column *column);
/* rows: of fields that ranks share those here; then all call, and rank 0 writes. */
int pm_table_write(FILE *out, bool csv, size_t rows, int ncolumns, const struct pm_table_column *column);

#endif
