/* Option rows drive the command line: types, ranges, defaults, choices, and the nearest name if one is misspelt. SPDX-License-Identifier: GPL-3.0-or-later */
#include <errno.h>
#include <stdlib.h>
#include <string.h>
#include <unistd.h>

#include "base/nearest-name.h"
#include "stage/file-operands.h"
#include "stage/internal.h"
#include "stage/ranks.h"

#define AT(member) .offset = offsetof(struct pm_common, member)
const struct pm_option pm_common_options[] = {
	{.name = "input", .letter = 'i', .kind = PM_TEXT, .unit = "FILE", .cosmetic = true, AT(input), .text = "read FILE instead of standard input"},
	{.name = "output", .letter = 'o', .kind = PM_TEXT, .unit = "FILE", .cosmetic = true, AT(output), .text = "write FILE instead of standard output"},
	{.name = "threads", .kind = PM_INTEGER, .unit = "1", .low = 1, .high = 4096, .cosmetic = true, AT(threads),
		.text = "number of threads; results do not depend on it (also OMP_NUM_THREADS)"},
	{.name = "ranks", .kind = PM_INTEGER, .unit = "1", .low = 1, .high = PM_RANKS_MOST, .cosmetic = true, AT(ranks),
		.text = "number of processes on this machine that share the work, to rehearse a run by an MPI launcher; results do not depend on it"},
	{.name = "timing", .kind = PM_TEXT, .unit = "FILE", .cosmetic = true, AT(timing),
		.text = "append a line to FILE: word, seconds of set-up, of work, of the processors in this work; -: on standard error, to read, "
			"of cycle a table of its words, with their sum in the line 'all'"},
	{.name = "no-history", .kind = PM_FLAG, .cosmetic = true, AT(no_history), .text = "add no entry to the history of the stream"},
	{.name = "quiet", .letter = 'q', .kind = PM_FLAG, .cosmetic = true, AT(quiet), .text = "print no notes on standard error, only errors"},
	{.name = "verbose", .letter = 'v', .kind = PM_FLAG, .cosmetic = true, AT(verbose), .text = "print decisions on standard error"},
	{.name = "help", .letter = 'h', .kind = PM_FLAG, .cosmetic = true, AT(help), .text = "print this help"},
	{.name = "man", .kind = PM_FLAG, .cosmetic = true, AT(man), .text = "print the manual page (troff)"},
	{.name = "examples", .kind = PM_FLAG, .cosmetic = true, AT(examples), .text = "print the examples, one command a line"},
	{.name = "complete", .kind = PM_FLAG, .cosmetic = true, AT(complete), .text = "print the options with their choices, for completion"},
	{.name = "version", .kind = PM_FLAG, .cosmetic = true, AT(version), .text = "print the version"},
	{0},
};
#undef AT

void pm_option_rows(const struct pm_tool *tool, const struct pm_option *rows[PM_ROWS])
{
	rows[0] = tool->options;
	rows[1] = tool->more ? tool->more() : NULL;
	rows[2] = pm_common_options;
}

static int unknown_option(const struct pm_tool *tool, const char *typed, const char *name)
{
	const struct pm_option *rows[PM_ROWS];
	const char *best = NULL;
	int least = 99;
	pm_option_rows(tool, rows);
	for (int k = 0; k < PM_ROWS; k++)
		for (const struct pm_option *o = rows[k]; o && o->name; o++)
			best = pm_nearer(name, o->name, best, &least);
	if (best)
		return pm_fail(PM_USAGE, "no option '%s' (did you mean --%s?)", typed, best);
	return pm_fail(PM_USAGE, tool->arguments ? "no option '%s' (%s --help lists them; behind -- an argument may begin with -)"
		: "no option '%s' (%s --help lists them)", typed, tool->name);
}

/* ---- values ---- */

static int not_a_choice(const struct pm_option *o, const char *value)
{
	char list[512] = "";
	const char *near = pm_nearest(value, o->choices);
	for (int i = 0; o->choices[i]; i++)
		snprintf(list + strlen(list), sizeof list - strlen(list), "%s%s", i ? ", " : "", o->choices[i]);
	if (strlen(list) + 1 == sizeof list) /* cut: too many to be read here */
		snprintf(list, sizeof list, "those that --help lists");
	if (near)
		return pm_fail(PM_USAGE, "--%s '%s' is not one of %s (did you mean %s?)", o->name, value, list, near);
	return pm_fail(PM_USAGE, "--%s '%s' is not one of %s", o->name, value, list);
}

static bool is_choice(const struct pm_option *o, const char *value)
{
	for (int i = 0; o->choices && o->choices[i]; i++)
		if (!strcmp(o->choices[i], value))
			return true;
	for (int i = 0; o->numbered && o->numbered[i]; i++) {
		const size_t n = strlen(o->numbered[i]);
		if (!strncmp(value, o->numbered[i], n) && value[n] && strspn(value + n, "0123456789.e-") == strlen(value + n))
			return true;
	}
	return !o->choices;
}

static int number(const struct pm_option *o, const char *text, const char *stop, double *out)
{
	char *end;
	errno = 0;
	double x = strtod(text, &end);
	if (end == text || (*end && !strchr(stop, *end)) || !isfinite(x) || errno == ERANGE)
		return pm_fail(PM_USAGE, "--%s '%s' is not a number", o->name, text);
	if ((o->low != 0 || o->high != 0) && !(x >= o->low && x <= o->high))
		return pm_fail(PM_USAGE, "--%s %g is outside its range, %g to %g", o->name, x, o->low, o->high);
	*out = x;
	return 0;
}

static int integer(const struct pm_option *o, const char *text, int64_t *out)
{
	char *end;
	errno = 0;
	long long x = strtoll(text, &end, 10);
	if (*end == 'e' || *end == '.') { /* 1e6 is accepted for a million */
		double d;
		if (!number(o, text, "", &d) && d == floor(d) && fabs(d) < 0x1p53) {
			x = (long long)d;
			end = "";
		}
	}
	if (end == text || *end || errno)
		return pm_fail(PM_USAGE, "--%s '%s' is not a whole number", o->name, text);
	if ((o->low != 0 || o->high != 0) && !((double)x >= o->low && (double)x <= o->high))
		return pm_fail(PM_USAGE, "--%s %lld is outside its range, %.17g to %.17g", o->name, x, o->low, o->high);
	*out = x;
	return 0;
}

static int cells(const struct pm_option *o, const char *text, struct pm_cells *out)
{
	const char *p = text;
	for (out->n = 0; out->n < 3; out->n++) {
		char *end;
		errno = 0;
		long long x = strtoll(p, &end, 10);
		if (end == p || errno || x < 1 || x > 1 << 30 || (*end && *end != 'x'))
			return pm_fail(PM_USAGE, "--%s '%s' is not a number of cells (64 or 64x32x32)", o->name, text);
		out->cells[out->n] = (size_t)x;
		if (!*end) {
			out->n++;
			return 0;
		}
		p = end + 1;
	}
	return pm_fail(PM_USAGE, "--%s '%s' has more than three axes", o->name, text);
}

static int vector(const struct pm_option *o, const char *text, struct pm_vector *out)
{
	const char *p = text;
	for (out->n = 0; out->n < PM_COMPONENTS;) {
		int status = number(o, p, ",", &out->x[out->n]);
		if (status)
			return status;
		out->n++;
		p = strchr(p, ',');
		if (!p)
			return 0;
		p++;
	}
	return pm_fail(PM_USAGE, "--%s '%s' has more than %d numbers", o->name, text, PM_COMPONENTS);
}

/* The copies live as long as the stage. */
static int list(struct pm_run *run, const struct pm_option *o, const char *text, struct pm_list *out)
{
	char *copy = strdup(text), *next = NULL;
	if (!copy)
		return pm_no_memory();
	if (run->ncopies < PM_LIST_MOST)
		run->copies[run->ncopies++] = copy;
	for (char *item = strtok_r(copy, ",", &next); item; item = strtok_r(NULL, ",", &next)) {
		if (!is_choice(o, item))
			return not_a_choice(o, item);
		if (out->n == PM_LIST_MOST)
			return pm_fail(PM_USAGE, "--%s has more than %d items", o->name, PM_LIST_MOST);
		out->item[out->n++] = item;
	}
	return 0;
}

static int set_value(struct pm_run *run, const struct pm_option *o, const char *text, char *config)
{
	void *at = config + o->offset;
	switch (o->kind) {
	case PM_FLAG:
		*(bool *)at = true;
		return 0;
	case PM_INTEGER:
		return integer(o, text, at);
	case PM_REAL:
		return number(o, text, "", at);
	case PM_WORD:
		if (!is_choice(o, text))
			return not_a_choice(o, text);
		/* fall through */
	case PM_TEXT:
		*(const char **)at = text;
		return 0;
	case PM_CELLS:
		return cells(o, text, at);
	case PM_VECTOR:
		return vector(o, text, at);
	case PM_LIST:
		return list(run, o, text, at);
	}
	return 0;
}

static int set_default(struct pm_run *run, const struct pm_option *o, char *config)
{
	if (o->fallback)
		return set_value(run, o, o->fallback, config);
	if (o->kind == PM_INTEGER)
		*(int64_t *)(void *)(config + o->offset) = INT64_MIN;
	if (o->kind == PM_REAL)
		*(double *)(void *)(config + o->offset) = NAN;
	return 0; /* the rest is zero already */
}

/* ---- the command line ---- */

struct found {
	const struct pm_option *row;
	bool common;
};

static struct found find(const struct pm_tool *tool, const char *name, size_t length, char letter)
{
	const struct pm_option *rows[PM_ROWS];
	pm_option_rows(tool, rows);
	for (int k = 0; k < PM_ROWS; k++)
		for (const struct pm_option *o = rows[k]; o && o->name; o++)
			if (letter ? o->letter == letter : strlen(o->name) == length && !strncmp(o->name, name, length))
				return (struct found){o, k == PM_ROWS - 1};
	return (struct found){0};
}

static int word_add(struct pm_stage *s, const char *text)
{
	size_t old = s->word ? strlen(s->word) : 0, n = strlen(text);
	char *word = realloc(s->word, old + n + 2);
	if (!word)
		return pm_no_memory();
	if (old)
		word[old++] = ' ';
	memcpy(word + old, text, n + 1);
	s->word = word;
	return 0;
}

static void note(struct pm_stage *s, const struct pm_option *o, const char *value)
{
	if (s->run->ngiven < 128)
		s->run->given[s->run->ngiven++] = o->name;
	if (o->cosmetic)
		return;
	json_t *options = json_object_get(s->entry, "options");
	const char *before = json_string_value(json_object_get(options, o->name));
	json_t *now = o->kind == PM_FLAG ? json_true() : o->kind == PM_LIST && before ? json_sprintf("%s,%s", before, value) : json_string(value);
	json_object_set_new(options, o->name, now);
}

/* One option at argv[i]; returns the number of words used, or failure. */
static int option(struct pm_stage *s, int argc, char **argv, int i)
{
	char *typed = argv[i], *value = NULL;
	bool is_long = typed[1] == '-';
	char *name = typed + 1 + is_long, *equals = is_long ? strchr(name, '=') : NULL;
	size_t length = equals ? (size_t)(equals - name) : strlen(name);
	struct found f = find(s->tool, name, length, is_long ? 0 : *name);
	if (!f.row)
		return unknown_option(s->tool, typed, name);
	int took = 1;
	if (is_long)
		value = equals ? equals + 1 : NULL;
	else
		value = name[1] ? name + 1 : NULL;
	if (f.row->kind == PM_FLAG && value)
		return pm_fail(PM_USAGE, "option '%s' takes no value", typed);
	if (f.row->kind != PM_FLAG && !value) {
		if (i + 1 >= argc)
			return pm_fail(PM_USAGE, "option '%s' needs a value", typed);
		value = argv[i + 1];
		took = 2;
	}
	char *config = f.common ? (char *)&s->run->common : s->config;
	int status = set_value(s->run, f.row, value, config);
	if (status)
		return status;
	note(s, f.row, value);
	if (!f.common)
		status = word_add(s, typed);
	if (!f.common && took == 2 && !status)
		status = word_add(s, value);
	return status ? status : took;
}

static int utf8_check(int argc, char **argv)
{
	for (int i = 1; i < argc; i++) {
		json_t *j = json_string(argv[i]);
		json_decref(j);
		if (!j)
			return pm_fail(PM_USAGE, "word %d of the command line is not UTF-8", i);
	}
	return 0;
}

static int arguments_check(const struct pm_stage *s)
{
	const struct pm_tool *t = s->tool;
	const struct pm_common *c = &s->run->common;
	if (c->help || c->man || c->complete || c->examples || c->version)
		return 0;
	if (c->quiet && c->verbose)
		return pm_fail(PM_USAGE, "--quiet and --verbose exclude each other (leave one of them out)");
	if (s->nargs > t->most && !s->files)
		return pm_fail(PM_USAGE, access(s->args[t->most], F_OK) ? "unexpected argument '%s' (expected: %s)" :
			"unexpected argument '%s' (expected: %s; -i reads a file)", s->args[t->most], t->arguments ? t->arguments : "options only");
	if (s->nargs < t->least)
		return pm_fail(PM_USAGE, "%s is missing (%s)", t->arguments, t->arguments_text);
	return 0;
}

/* `-` is standard input, and -1 begins a number: no option has a digit for its letter. */
static bool begins_option(const char *text) { return text[0] == '-' && text[1] && !strchr("0123456789.", text[1]); }

int pm_options_parse(struct pm_stage *s, int argc, char **argv)
{
	const struct pm_option *rows[PM_ROWS];
	int bad = utf8_check(argc, argv);
	if (bad)
		return bad;
	pm_option_rows(s->tool, rows);
	for (int k = 0; k < PM_ROWS; k++)
		for (const struct pm_option *o = rows[k]; o && o->name; o++) {
			int status = set_default(s->run, o, k == PM_ROWS - 1 ? (char *)&s->run->common : s->config);
			if (status)
				return status;
		}
	if (word_add(s, s->tool->name))
		return -PM_DATA;
	bool only_words = false;
	s->files = pm_takes_files(s->tool);
	json_t *arguments = json_array();
	json_object_set_new(s->entry, "arguments", arguments);
	for (int i = 1; i < argc;) {
		if (!only_words && !strcmp(argv[i], "--")) {
			only_words = true;
			i++;
		} else if (!only_words && begins_option(argv[i])) {
			int took = option(s, argc, argv, i);
			if (took < 0)
				return took;
			i += took;
		} else {
			if (!s->files && word_add(s, argv[i]))
				return -PM_DATA;
			if (!s->files) /* as with -i, where a stream came from changes no result */
				json_array_append_new(arguments, json_string(argv[i]));
			s->args[s->nargs++] = argv[i++];
		}
	}
	return arguments_check(s);
}

bool pm_given(const struct pm_stage *s, const char *name)
{
	for (int i = 0; i < s->run->ngiven; i++)
		if (!strcmp(s->run->given[i], name))
			return true;
	return false;
}

int pm_cells_for(const struct pm_cells *c, int dim, size_t out[3])
{
	if (c->n != 1 && c->n != dim)
		return pm_fail(PM_USAGE, "%d numbers of cells for a frame of %d dimensions (one, or one per axis)", c->n, dim);
	for (int a = 0; a < 3; a++)
		out[a] = a >= dim ? 1 : c->n == 1 ? c->cells[0] : c->cells[a];
	return 0;
}
