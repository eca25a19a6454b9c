/* Quoting as RFC 4180 (Shafranovich 2005), section 2, rules 5 to 7. Blanks around a cell are dropped. SPDX-License-Identifier: GPL-3.0-or-later */
#include <string.h>

#include "stream/csv.h"

static bool is_blank(char c) { return c == ' ' || c == '\t' || c == '\r'; }

char pm_csv_separator(const char *s, const char *e)
{
	char found = 0;
	bool quoted = false;
	for (; s < e && *s != '\t'; s++) {
		quoted ^= *s == '"';
		if (!quoted && (*s == ',' || *s == ';') && !found)
			found = *s;
	}
	return s < e ? 0 : found;
}

const char *pm_csv_next(const char *s, const char *e, struct pm_csv_cell *cell)
{
	while (s < e && is_blank(*s))
		s++;
	*cell = (struct pm_csv_cell){.s = s, .quoted = s < e && *s == '"'};
	if (cell->quoted) {
		for (cell->s = ++s; s < e && (*s != '"' || (s + 1 < e && s[1] == '"')); s++)
			s += *s == '"';
		cell->wrong = s >= e;
		cell->e = s < e ? s++ : e;
		while (s < e && is_blank(*s))
			s++;
		cell->wrong = cell->wrong || (s < e && *s != ',');
	}
	const char *comma = memchr(s, ',', (size_t)(e - s));
	if (!cell->quoted) {
		cell->e = comma ? comma : e;
		while (cell->e > cell->s && is_blank(cell->e[-1]))
			cell->e--;
	}
	return comma ? comma + 1 : NULL;
}

size_t pm_csv_write(char *out, const char *text, size_t n)
{
	char *o = out;
	bool plain = n == 0 || (text[0] != ' ' && text[n - 1] != ' ' && text[0] != '#');
	for (size_t i = 0; i < n; i++)
		plain = plain && !strchr(",\"\r\n\t", text[i]);
	if (!plain)
		*o++ = '"';
	for (size_t i = 0; i < n; i++) {
		if (text[i] == '"')
			*o++ = '"';
		*o++ = text[i];
	}
	if (!plain)
		*o++ = '"';
	return (size_t)(o - out);
}
