/* Help, manual page, completion and examples, all printed from the same rows. SPDX-License-Identifier: GPL-3.0-or-later */
#include <ctype.h>
#include <stdarg.h>
#include <stdio.h>
#include <string.h>

#include "stage/file-operands.h"
#include "stage/internal.h"

static const char *const kinds[] = {"makes a stream", "reads a stream and writes one", "reads a stream and writes text"};

static void option_head(const struct pm_option *o, char *out, size_t size)
{
	static const char *const values[] = {"", "N", "X", "WORD", "TEXT", "CELLS", "X,Y,...", "WORD,..."};
	bool file = o->kind == PM_TEXT && o->unit && *o->unit;
	snprintf(out, size, "%c%c%s--%s%s%s", o->letter ? '-' : ' ', o->letter ? o->letter : ' ', o->letter ? ", " : "  ", o->name,
		o->kind == PM_FLAG ? "" : " ", file ? o->unit : values[o->kind]);
}

__attribute__((format(printf, 3, 4))) static void add(char *out, size_t size, const char *format, ...)
{
	size_t n = strlen(out);
	va_list ap;
	va_start(ap, format);
	vsnprintf(out + n, size - n, format, ap);
	va_end(ap);
}

/* The unit, range, default and choices of an option. */
static void option_facts(const struct pm_option *o, char *out, size_t size)
{
	*out = 0;
	if (o->kind != PM_TEXT && o->kind != PM_FLAG && o->unit && *o->unit && strcmp(o->unit, "1"))
		add(out, size, "; unit: %s", o->unit);
	if (o->low != 0 || o->high != 0)
		add(out, size, "; from %g to %g", o->low, o->high);
	for (int i = 0; o->choices && o->choices[i]; i++)
		add(out, size, "%s %s", i ? "," : "; one of", o->choices[i]);
	if (o->fallback)
		add(out, size, "; default %s", o->fallback);
}

/* A row of the library whose name the tool uses for an option of its own. */
static bool hidden(const struct pm_option *const rows[PM_ROWS], const struct pm_option *row)
{
	for (int k = 0; k < PM_ROWS; k++)
		for (const struct pm_option *o = rows[k]; o && o->name; o++)
			if (!strcmp(o->name, row->name))
				return o != row;
	return false;
}

static const char *arguments_of(const struct pm_tool *t) { return pm_takes_files(t) ? "[FILE...]" : t->arguments; }

static const char *arguments_text(const struct pm_tool *t) { return pm_takes_files(t) ? pm_files_text : t->arguments_text; }

void pm_help(const struct pm_tool *t)
{
	const struct pm_option *rows[PM_ROWS];
	const char *arguments = arguments_of(t);
	char head[128], facts[1024];
	pm_option_rows(t, rows);
	printf("%s: %s\n\nusage: %s [options]%s%s\n%s %s.\n", t->name, t->summary, t->name, arguments ? " " : "", arguments ? arguments : "",
		t->name, kinds[t->kind]);
	if (arguments)
		printf("%s: %s\n", arguments, arguments_text(t));
	if (t->reads)
		printf("reads: %s\n", t->reads);
	if (t->changes)
		printf("changes: %s\n", t->changes);
	if (t->adds)
		printf("adds: %s\n", t->adds);
	if (t->about)
		printf("\n%s\n", t->about);
	for (int k = 0; k < PM_ROWS; k++) {
		if (rows[k])
			printf("\n%s:\n", k == PM_ROWS - 1 ? "options of every tool" : k ? "further options" : "options");
		for (const struct pm_option *o = rows[k]; o && o->name; o++) {
			if (hidden(rows, o))
				continue;
			option_head(o, head, sizeof head);
			option_facts(o, facts, sizeof facts);
			printf("  %-26s %s%s\n", head, o->text, facts);
		}
	}
	if (t->examples)
		printf("\nexamples:\n");
	for (const struct pm_example *e = t->examples; e && e->command; e++)
		printf("  # %s\n  %s\n", e->text, e->command);
}

/* Text in troff: backslashes and leading dots or quotes are escaped, hyphens are minus signs. */
static void troff(const char *text)
{
	bool start = true;
	for (; *text; text++) {
		if (start && (*text == '.' || *text == '\''))
			fputs("\\&", stdout);
		start = *text == '\n';
		if (*text == '\\')
			fputs("\\e", stdout);
		else if (*text == '-')
			fputs("\\-", stdout);
		else if (*text == '\n' && text[1] == '\n') {
			fputs("\n.PP", stdout);
		} else
			putchar(*text);
	}
}

static void paragraph(const char *head, const char *text)
{
	if (!text)
		return;
	printf(".TP\n%s\n", head);
	troff(text);
	putchar('\n');
}

static void man_options(const struct pm_tool *t)
{
	const struct pm_option *rows[PM_ROWS];
	char head[128], facts[1024];
	pm_option_rows(t, rows);
	for (int k = 0; k < PM_ROWS; k++)
		for (const struct pm_option *o = rows[k]; o && o->name; o++) {
			if (hidden(rows, o))
				continue;
			option_head(o, head, sizeof head);
			option_facts(o, facts, sizeof facts);
			const char *h = head;
			while (*h == ' ')
				h++;
			printf(".TP\n.B ");
			troff(h);
			putchar('\n');
			troff(o->text);
			troff(facts);
			putchar('\n');
		}
}

void pm_man(const struct pm_tool *t)
{
	char title[PM_NAME];
	snprintf(title, sizeof title, "%s", t->name);
	for (char *c = title; *c; c++)
		*c = (char)toupper((unsigned char)*c);
	printf(".TH %s 1 2026-11-21 \"pmpipe " PM_VERSION "\" \"pmpipe\"\n.SH NAME\n", title);
	troff(t->name);
	printf(" \\- ");
	troff(t->summary);
	printf("\n.SH SYNOPSIS\n.B ");
	troff(t->name);
	printf("\n[options]");
	if (arguments_of(t)) {
		putchar(' ');
		troff(arguments_of(t));
	}
	printf("\n.SH DESCRIPTION\n");
	troff(t->name);
	putchar(' ');
	troff(kinds[t->kind]);
	printf(".\n");
	if (t->about) {
		troff(t->about);
		putchar('\n');
	}
	paragraph(arguments_of(t) ? arguments_of(t) : "", arguments_text(t));
	paragraph("reads", t->reads);
	paragraph("changes", t->changes);
	paragraph("adds", t->adds);
	printf(".SH OPTIONS\n");
	man_options(t);
	printf(".SH EXIT STATUS\n0 fine; 1 data or system; 2 usage; 3 numerics (not finite, not converged, unstable).\n");
	if (t->examples)
		printf(".SH EXAMPLES\n");
	for (const struct pm_example *e = t->examples; e && e->command; e++) {
		printf(".TP\n");
		troff(e->text);
		printf("\n.EX\n");
		troff(e->command);
		printf("\n.EE\n");
	}
	printf(".SH SEE ALSO\nThe stream and the methods are described in docs/ of the source.\n");
}

static void complete(const char *dashes, const char *name, const char *const *choices)
{
	printf("%s%s", dashes, name);
	for (int i = 0; choices && choices[i]; i++)
		printf(" %s", choices[i]);
	putchar('\n');
}

void pm_complete(const struct pm_tool *t)
{
	const struct pm_option *rows[PM_ROWS];
	pm_option_rows(t, rows);
	for (int k = 0; k < PM_ROWS; k++)
		for (const struct pm_option *o = rows[k]; o && o->name; o++)
			if (!hidden(rows, o))
				complete("--", o->name, o->choices);
	if (t->arguments_choices)
		complete("", t->arguments, t->arguments_choices);
}

void pm_print_examples(const struct pm_tool *t)
{
	for (const struct pm_example *e = t->examples; e && e->command; e++)
		puts(e->command);
}
