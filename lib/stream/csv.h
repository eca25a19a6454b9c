/* Values separated by commas (RFC 4180), a row a line: no line break within quotes. SPDX-License-Identifier: GPL-3.0-or-later */
#ifndef PM_STREAM_CSV_H
#define PM_STREAM_CSV_H

#include <stdbool.h>
#include <stddef.h>

struct pm_csv_cell {
	const char *s, *e; /* without the quotes and the blanks around */
	bool quoted;       /* "" inside stands for one " */
	bool wrong;        /* a quote that does not end, or something behind its end */
};

/* What separates the names of a line: ',' or ';' where one stands outside of quotes and there is no tab, else 0 (blanks). */
char pm_csv_separator(const char *s, const char *e);
/* The cell that begins at s, in a line that ends at e; returns where the next one begins, NULL: that was the last. */
const char *pm_csv_next(const char *s, const char *e, struct pm_csv_cell *cell);
/* Writes a cell, in quotes where it needs them; returns the length, at most 2 n + 2. */
size_t pm_csv_write(char *out, const char *text, size_t n);

#endif
