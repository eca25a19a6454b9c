/* Writes tables of text, by blocks of rows that threads fill. Cost: 20 to 200 ns a number, see lib/base/decimal.c.
 * SPDX-License-Identifier: GPL-3.0-or-later */
#include <stdlib.h>
#include <string.h>

#include "base/decimal.h"
#include "stream/csv.h"
#include "stream/table.h"
#include "world/world.h"

static void column_name(const struct pm_frame *f, const struct pm_field *field, int c, char *name)
{
	if (!strcmp(field->name, "x") && field->components == f->dim)
		snprintf(name, PM_NAME, "%c", "xyz"[c]);
	else if (!strcmp(field->name, "v") && field->components <= 3)
		snprintf(name, PM_NAME, "v%c", "xyz"[c]);
	else if (field->components == 1)
		snprintf(name, PM_NAME, "%s", field->name);
	else
		snprintf(name, PM_NAME, "%.58s_%d", field->name, c % PM_COMPONENTS);
	for (char *s = name; *s; s++)
		if ((unsigned char)*s <= ' ' || *s == '#')
			*s = '_';
}

int pm_table_columns(const struct pm_frame *f, const char *on, struct pm_table_column *column)
{
	int n = 0;
	for (size_t i = 0; i < f->nfields; i++) {
		struct pm_field *field = f->fields[i];
		bool text = field->type == PM_U8 && !strcmp(field->unit, "text");
		if (strcmp(field->on, on) || field->uniform)
			continue;
		for (int c = 0; c < (text ? 1 : field->components); c++, n++) {
			if (n == PM_COLUMNS)
				return pm_fail(PM_DATA, "'%s' has more than %d columns (leave some out with sel --drop)", on, PM_COLUMNS);
			column[n] = (struct pm_table_column){.field = field, .component = c, .text = text};
			if (text)
				snprintf(column[n].name, PM_NAME, "%s", field->name);
			else
				column_name(f, field, c, column[n].name);
			for (int k = 0, again = 0; k < n; k++)
				if (!strcmp(column[k].name, column[n].name)) /* 'y' besides the second component of x: a number is appended */
					snprintf(column[n].name, PM_NAME, "%.40s_%d_%d", field->name, c, again++), k = -1;
		}
	}
	return n;
}

static size_t letters_write(char *out, const struct pm_field *field, size_t row)
{
	const unsigned char *y = pm_in_u8(field, 0) + row;
	int n = field->components;
	char *o = out;
	while (n > 0 && !y[(size_t)(n - 1) * field->count])
		n--;
	for (int c = 0; c < n; c++) {
		unsigned char one = y[(size_t)c * field->count];
		if (one <= ' ' || one == '%' || one == '#' || one == 127)
			o += sprintf(o, "%%%02x", one);
		else
			*o++ = (char)one;
	}
	if (!n)
		*o++ = '%';
	return (size_t)(o - out);
}

static size_t csv_letters_write(char *out, const struct pm_field *field, size_t row)
{
	const unsigned char *y = pm_in_u8(field, 0) + row;
	char text[PM_COMPONENTS];
	int n = field->components;
	while (n > 0 && !y[(size_t)(n - 1) * field->count])
		n--;
	for (int c = 0; c < n; c++)
		text[c] = (char)y[(size_t)c * field->count];
	return pm_csv_write(out, text, (size_t)n);
}

static size_t value_write(char *o, bool csv, const struct pm_table_column *c, size_t row)
{
	const struct pm_field *field = c->field;
	if (c->text && csv)
		return csv_letters_write(o, field, row);
	if (c->text)
		return letters_write(o, field, row);
	if (field->type == PM_I64)
		return (size_t)sprintf(o, "%lld", (long long)pm_in_i64(field, c->component)[row]);
	if (field->type == PM_U8)
		return (size_t)sprintf(o, "%d", pm_in_u8(field, c->component)[row]);
	return pm_decimal_write(o, pm_in(field, c->component)[row], field->type == PM_F32);
}

static size_t rows_write(char *out, bool csv, size_t first, size_t last, int n, const struct pm_table_column *column)
{
	char *o = out;
	for (size_t row = first; row < last; row++)
		for (int i = 0; i < n; i++) {
			o += value_write(o, csv, column + i, row);
			*o++ = i + 1 == n ? '\n' : csv ? ',' : '\t';
		}
	return (size_t)(o - out);
}

/* The rows here, as text. */
static int rows_print(FILE *out, bool csv, size_t rows, int n, const struct pm_table_column *column)
{
	enum { blocks = 16 };
	size_t per = n ? 32768 / (size_t)n : 1, room = per * (size_t)n * (3 * PM_COMPONENTS + 1), length[blocks];
	char *text = n ? pm_alloc(blocks, room) : NULL;
	if (n && !text)
		return -PM_DATA;
	for (size_t first = 0; n && first < rows; first += blocks * per) {
#pragma omp parallel for schedule(dynamic)
		for (size_t b = 0; b < blocks; b++) {
			size_t from = first + b * per, to = from + per;
			length[b] = from < rows ? rows_write(text + b * room, csv, from, to < rows ? to : rows, n, column) : 0;
		}
		for (size_t b = 0; b < blocks; b++)
			fwrite(text + b * room, 1, length[b], out);
	}
	pm_free(text);
	return 0;
}

/* The rows of the other ranks, which all make theirs at once; rank 0 writes them rank after rank. */
static int rows_of_ranks(FILE *out, bool csv, size_t rows, int n, const struct pm_table_column *column)
{
	char *own = NULL;
	size_t bytes = 0;
	FILE *to = pm_world_rank() ? open_memstream(&own, &bytes) : out;
	int status = to ? rows_print(to, csv, rows, n, column) : pm_no_memory();
	if (to && to != out && fclose(to) && !status)
		status = pm_no_memory();
	for (int r = 1; r < pm_world_size(); r++) {
		void *text = NULL;
		size_t length = 0;
		status = pm_world_gather(status, own, r == pm_world_rank() ? bytes : 0, &text, &length);
		if (text)
			fwrite(text, 1, length, out);
		pm_free(text);
	}
	free(own);
	return status;
}

int pm_table_write(FILE *out, bool csv, size_t rows, int n, const struct pm_table_column *column)
{
	for (int i = 0; i < n; i++) {
		char name[2 * PM_NAME + 2];
		if (csv)
			fwrite(name, 1, pm_csv_write(name, column[i].name, strlen(column[i].name)), out);
		else
			fputs(column[i].name, out);
		fputc(i + 1 == n ? '\n' : csv ? ',' : '\t', out);
	}
	return n && column[0].field->here ? rows_of_ranks(out, csv, rows, n, column) : rows_print(out, csv, rows, n, column);
}
