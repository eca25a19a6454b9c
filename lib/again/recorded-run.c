/* History to commands. The history keeps what changes results: it lacks cycle's -n and --every, which the steps of the frames give.
 * SPDX-License-Identifier: GPL-3.0-or-later */
#include <ctype.h>
#include <stdlib.h>
#include <string.h>
#include <unistd.h>

#include "again/recorded-run.h"
#include "sentence/sentence.h"
#include "stage/apply.h"

static const char *text(const json_t *entry, const char *key) { return json_string_value(json_object_get(entry, key)); }

static const json_t *entry_of(const struct pm_recorded_run *run, int k)
{
	return json_array_get(run->history, json_array_size(run->history) - (size_t)(run->n - k));
}

/* cycle --again records what it has decided so far: its own decisions, which the options repeat. */
static bool decides(const json_t *entry) { return json_object_get(json_object_get(entry, "options"), "again"); }

/* The history without these decisions: that of all frames of a run. A new reference. */
static json_t *of_all_frames(const json_t *history)
{
	json_t *same = json_deep_copy(history), *entry;
	size_t i;
	json_array_foreach(same, i, entry)
		if (decides(entry))
			json_object_set_new(entry, "arguments", json_array());
	return same;
}

int pm_recorded_read(struct pm_recorded_run *run, struct pm_reader *r)
{
	struct pm_frame *f = NULL;
	for (;;) {
		int got = pm_read_header(r, &f), status = got == PM_GOT_FRAME ? pm_read_declared(r, f) : got;
		if (got == PM_GOT_END)
			continue;
		if (got == PM_GOT_EOF)
			return run->frames ? 0 : pm_fail(PM_DATA, "it has no frames, and so no history");
		json_t *history = status ? NULL : of_all_frames(f->history);
		if (!status && run->history && !json_equal(run->history, history))
			status = pm_fail(PM_DATA, "frame %llu has another history than frame 1: these are several runs (sel --frames takes one out)",
				(unsigned long long)run->frames + 1);
		if (status < 0) {
			if (got == PM_GOT_FRAME)
				pm_frame_free(f);
			json_decref(history);
			return status;
		}
		run->frames++;
		run->first = run->frames == 1 ? f->step : run->first;
		run->second = run->frames == 2 ? f->step : run->second;
		run->last = f->step;
		if (!run->history)
			run->history = json_incref(history);
		json_decref(history);
		f = pm_frame_free(f);
	}
}

static bool makes_stream(const json_t *entry)
{
	static const char *const sources[] = {"pinit", "stack", "stab", "sh5", NULL};
	int i = 0;
	while (sources[i] && text(entry, "program") && strcmp(sources[i], text(entry, "program")))
		i++;
	return text(entry, "program") && sources[i];
}

static int add(char **argv, const char *format, const char *a, const char *b)
{
	int n = 0;
	while (argv[n])
		n++;
	if (n == PM_RECORDED_ARGUMENTS - 2)
		return pm_fail(PM_DATA, "its history has a word of more than %d arguments", n);
	return asprintf(argv + n, format, a, b) < 0 ? argv[n] = NULL, pm_no_memory() : 0;
}

/* cycle counts its steps from the beginning of the run; a single frame is taken for the last of a run from step 0. typed: the options have the length. */
static int cycle_length(const struct pm_recorded_run *run, bool typed, char **argv)
{
	char number[32];
	const int64_t from = run->frames > 1 ? run->first : 0, every = run->frames > 1 ? run->second - run->first : 0;
	snprintf(number, sizeof number, "%lld", (long long)(run->last - from));
	int status = typed ? 0 : add(argv, "-n", "", "");
	status = status || typed ? status : add(argv, "%s", number, "");
	snprintf(number, sizeof number, "%lld", (long long)every);
	if (!status && every > 0 && !(status = add(argv, "--every", "", "")))
		status = add(argv, "%s", number, "");
	return status;
}

static int command(const struct pm_recorded_run *run, const json_t *entry, char **argv)
{
	const char *name;
	json_t *value, *arguments = json_object_get(entry, "arguments");
	size_t i;
	bool dash = false;
	if (!text(entry, "program") || !text(entry, "version"))
		return pm_fail(PM_DATA, "its history has an entry without a program and a version");
	int status = add(argv, "%s", text(entry, "program"), "");
	json_object_foreach(json_object_get(entry, "options"), name, value) {
		if (!status)
			status = json_is_true(value) || json_is_string(value) ? add(argv, "--%s", name, "") :
				pm_fail(PM_DATA, "its history has an option '%s' that is neither text nor true", name);
		if (!status && json_is_string(value)) /* as people type it: the reports of a word are under its text */
			status = add(argv, "%s", json_string_value(value), "");
	}
	if (!status && !strcmp(text(entry, "program"), "cycle"))
		status = cycle_length(run, decides(entry), argv);
	json_array_foreach(arguments, i, value)
		dash |= json_is_string(value) && json_string_value(value)[0] == '-' && json_string_value(value)[1];
	if (!status && dash)
		status = add(argv, "--", "", "");
	json_array_foreach(arguments, i, value)
		if (!status)
			status = json_is_string(value) ? add(argv, "%s", json_string_value(value), "") :
				pm_fail(PM_DATA, "its history has an argument that is no text");
	return status;
}

int pm_recorded_commands(struct pm_recorded_run *run)
{
	const size_t all = json_array_size(run->history);
	size_t from = all;
	while (from && !makes_stream(json_array_get(run->history, from - 1)))
		from--;
	if (!all)
		return pm_fail(PM_DATA, "it has no history (it was made with --no-history, or by a program that keeps none)");
	if (!from)
		return pm_fail(PM_DATA, "its history does not say where the stream came from: no pinit, stab, stack or sh5");
	if (all - from + 1 > PM_RECORDED_MOST)
		return pm_fail(PM_DATA, "its history has more than %d words", PM_RECORDED_MOST);
	for (size_t i = from - 1; i < all; i++) {
		if (!(run->argv[run->n] = calloc(PM_RECORDED_ARGUMENTS, sizeof(char *))))
			return pm_no_memory();
		int status = command(run, json_array_get(run->history, i), run->argv[run->n++]);
		if (status)
			return status;
	}
	return 0;
}

int pm_recorded_output(struct pm_recorded_run *run, const char *path)
{
	char **argv = run->argv[run->n - 1], *option;
	int status = add(argv, "--output=%s", path, ""), last = 0;
	while (!status && argv[last + 1])
		last++;
	option = argv[last]; /* in front of the arguments */
	for (; last > 1; last--)
		argv[last] = argv[last - 1];
	argv[last] = option;
	return status;
}

static void print_quoted(FILE *out, const char *s)
{
	bool plain = *s;
	for (const char *c = s; *c; c++)
		plain &= isalnum((unsigned char)*c) || strchr("_./:=+,@%-", *c);
	if (plain) {
		fputs(s, out);
		return;
	}
	putc('\'', out);
	for (; *s; s++)
		if (*s == '\'')
			fputs("'\\''", out);
		else
			putc(iscntrl((unsigned char)*s) && *s != '\n' && *s != '\t' ? '?' : *s, out);
	putc('\'', out);
}

void pm_recorded_print(const struct pm_recorded_run *run, FILE *out, const char *before)
{
	fputs(before, out);
	for (int k = 0; k < run->n; k++)
		for (int i = 0; run->argv[k][i]; i++) {
			fputs(i ? " " : k ? " | " : "", out);
			print_quoted(out, run->argv[k][i]);
		}
	putc('\n', out);
	fflush(out);
}

/* The options of cycle that decide on its sentences leave a trace with --again alone. */
static bool of_again(const json_t *entry, const char *name)
{
	static const char *const names[] = {"plan", "again", "accuracy", "steps", "time", "until", NULL};
	int i = 0;
	while (names[i] && strcmp(names[i], name))
		i++;
	return decides(entry) && !strcmp(text(entry, "program"), "cycle") && names[i];
}

/* Options of the library, and others that leave no trace in a history (they may write files), are those of a forged one. */
static int options_check(const struct pm_tool *tool, const json_t *entry)
{
	const char *name;
	json_t *value;
	json_t *given = json_object_get(entry, "options");
	if (given && !json_is_object(given))
		return pm_fail(PM_DATA, "the options of '%s' are no list of names: the history was edited", text(entry, "program"));
	json_object_foreach(given, name, value) {
		const struct pm_option *rows[] = {tool ? tool->options : NULL, tool && tool->more ? tool->more() : NULL};
		bool known = false;
		for (int k = 0; k < 2; k++)
			for (const struct pm_option *o = rows[k]; o && o->name; o++)
				known |= !strcmp(o->name, name) && (!o->cosmetic || of_again(entry, name)) && (o->kind == PM_FLAG) == json_is_true(value);
		if (!known)
			return pm_fail(PM_DATA, "'%s' never records an option --%s: the history was edited", text(entry, "program"), name);
	}
	return 0;
}

static int files_check(const json_t *entry)
{
	size_t i;
	json_t *value;
	const char *program = text(entry, "program");
	if (!strcmp(program, "pinit"))
		return 0;
	json_array_foreach(json_object_get(entry, "arguments"), i, value) {
		if (!strcmp(json_string_value(value), "-"))
			return pm_fail(PM_DATA, "'%s -' read standard input, which no history keeps (make the run from a file)", program);
		if (access(json_string_value(value), R_OK))
			return pm_fail_errno("its history needs the file '%s'", json_string_value(value));
	}
	return 0;
}

static int entry_check(const json_t *entry)
{
	const char *program = text(entry, "program"), *version = text(entry, "version");
	const struct pm_tool *tool = pm_tool_find(program);
	if (!tool && strcmp(program, "sh5"))
		return pm_fail(PM_DATA, "'%s' is no word of pmpipe (run the sentence above yourself if you know the program)", program);
	if (!makes_stream(entry) && (tool->kind != PM_FILTER || (!tool->arguments && json_array_size(json_object_get(entry, "arguments")))))
		return pm_fail(PM_DATA, "'%s' never stands like this in a history: it was edited", program);
	if (strcmp(version, PM_VERSION))
		return pm_fail(PM_DATA, "it was made by %s of version %s, and this is %s (install that version, or run the sentence above yourself)", program,
			version, PM_VERSION);
	int status = options_check(tool, entry);
	if (!status && makes_stream(entry))
		status = files_check(entry);
	const char *sentence = strcmp(program, "cycle") ? NULL : json_string_value(json_array_get(json_object_get(entry, "arguments"), 0));
	if (!status && sentence && pm_sentence_safe(sentence))
		status = pm_fail(PM_DATA, "its sentence has a word that is none of pmpipe's, or that writes a file (run it yourself if you trust it)");
	return status;
}

int pm_recorded_check(const struct pm_recorded_run *run)
{
	int status = 0, cycles = 0;
	for (int k = 0; k < run->n && !status; k++) {
		cycles += !strcmp(run->argv[k][0], "cycle");
		status = entry_check(entry_of(run, k));
	}
	if (!status && cycles > 1)
		status = pm_fail(PM_DATA, "two cycles made it, and where the first one ended is not recorded (run the sentence above yourself, with the "
			"-n of each)");
	return status;
}

void pm_recorded_free(struct pm_recorded_run *run)
{
	for (int k = 0; k < run->n; k++) {
		for (int i = 0; run->argv[k][i]; i++)
			free(run->argv[k][i]);
		free(run->argv[k]);
	}
	json_decref(run->history);
}
