/* Splits into words with the quoting rules of POSIX, without expansion; then into segments: runs of pmpipe words (fused), and chains of processes.
 * SPDX-License-Identifier: GPL-3.0-or-later */
#include <stdlib.h>
#include <string.h>
#include <unistd.h>

#include "base/nearest-name.h"
#include "sentence/process-chain.h"
#include "stage/internal.h"
#include "sentence/sentence.h"
#include "stream/acting-forces.h"
#include "stream/run.h"
#include "stage/apply.h"
#include "world/world.h"

enum { most_words = 64, most_arguments = 64 };

struct word {
	char *argv[most_arguments + 3]; /* two spare, for --no-history and --verbose or --quiet */
	int argc;
	const struct pm_tool *tool; /* NULL: a foreign program */
	struct pm_stage *stage;     /* pmpipe words: declared here even when they run as processes */
	bool makes;                 /* runs when priming */
};

struct segment {
	int first, count;        /* words */
	bool process;
	struct pm_chain *chain[2]; /* all its words; only those that make fields (priming) */
};

struct pm_sentence {
	int nwords, nsegments;
	uint64_t ready; /* shape of the last frame that needed no priming; 0: none */
	struct word word[most_words];
	struct segment segment[most_words];
};

/* ---- text to words ---- */

static int word_end(struct pm_sentence *s, char *buffer, size_t *n, bool *open)
{
	struct word *w = s->word + s->nwords;
	if (!*open)
		return 0;
	if (w->argc == most_arguments)
		return pm_fail(PM_USAGE, "more than %d words between two bars", most_arguments);
	buffer[*n] = 0;
	if (!(w->argv[w->argc] = strdup(buffer)))
		return pm_no_memory();
	w->argc++;
	*n = 0;
	*open = false;
	return 0;
}

static int stage_end(struct pm_sentence *s)
{
	if (!s->word[s->nwords].argc)
		return pm_fail(PM_USAGE, "there is no word before a bar, or after the last one");
	return ++s->nwords < most_words ? 0 : pm_fail(PM_USAGE, "more than %d stages", most_words - 1);
}

static int split(struct pm_sentence *s, const char *text, char *buffer)
{
	size_t n = 0;
	bool open = false;
	int status = 0;
	for (const char *c = text; *c && !status; c++) {
		if (*c == '\'' || *c == '"') {
			char quote = *c;
			open = true;
			for (c++; *c && *c != quote; c++) {
				if (quote == '"' && *c == '\\' && (c[1] == '"' || c[1] == '\\'))
					c++;
				buffer[n++] = *c;
			}
			if (!*c)
				return pm_fail(PM_USAGE, "a quote is not closed in the sentence");
		} else if (*c == '|') {
			status = word_end(s, buffer, &n, &open);
			status = status ? status : stage_end(s);
		} else if (*c == ' ' || *c == '\t' || *c == '\n') {
			status = word_end(s, buffer, &n, &open);
		} else if (*c == '#' && !open) {
			while (c[1] && c[1] != '\n')
				c++;
		} else {
			if (*c == '\\' && c[1])
				c++;
			open = true;
			buffer[n++] = *c;
		}
	}
	status = status ? status : word_end(s, buffer, &n, &open);
	return status ? status : stage_end(s);
}

/* ---- words to stages and segments ---- */

static bool in_list(const struct pm_list *list, const char *name)
{
	for (int i = 0; i < list->n; i++)
		if (!strcmp(list->item[i], name))
			return true;
	return false;
}

/* A foreign word must be an executable program; checked before any input is read. */
static int foreign_check(const char *name)
{
	const char *names[256], *near;
	char path[4096], *list = strdup(getenv("PATH") ? getenv("PATH") : "/bin:/usr/bin"), *next = NULL;
	bool found = strchr(name, '/') ? access(name, X_OK) == 0 : false;
	if (!list)
		return pm_no_memory();
	for (char *dir = strchr(name, '/') ? NULL : strtok_r(list, ":", &next); dir && !found; dir = strtok_r(NULL, ":", &next)) {
		snprintf(path, sizeof path, "%s/%s", dir, name);
		found = access(path, X_OK) == 0;
	}
	free(list);
	if (!strcmp(name, "sh5")) /* a program of its own, which cycle does not know */
		return pm_fail(PM_USAGE, "sh5 reads or writes a file and cannot be part of the sentence (put it before or after cycle: cycle -o FILE.h5)");
	if (found)
		return 0;
	int n = 0;
	for (; n < 255 && pm_tools[n]; n++)
		names[n] = pm_tools[n]->name;
	names[n] = NULL;
	near = pm_nearest(name, names);
	if (near)
		return pm_fail(PM_USAGE, "no word '%s' (did you mean %s?)", name, near);
	return pm_fail(PM_USAGE, "no word '%s': neither a tool of pmpipe nor a program on PATH", name);
}

static int word_make(struct word *w, const struct pm_list *moves)
{
	w->tool = pm_tool_find(w->argv[0]);
	if (!w->tool) {
		w->makes = !in_list(moves, w->argv[0]);
		return foreign_check(w->argv[0]);
	}
	w->makes = w->tool->makes;
	w->argv[w->argc] = "--no-history"; /* appended last, also for the process; the history entry of cycle contains the whole sentence */
	if (!strcmp(w->tool->name, "cycle") || w->tool->kind == PM_SOURCE)
		return pm_fail(PM_USAGE, "'%s' cannot be part of a sentence", w->argv[0]);
	int status = 0;
	w->stage = pm_stage_make(w->tool, w->argc, w->argv, &status);
	if (status)
		return pm_fail(-status, "%s: %s", w->argv[0], pm_message());
	const struct pm_common *k = &w->stage->run->common; /* before begin, for beside --help arguments are not counted */
	if (k->input || k->output || k->timing || k->help || k->man || k->examples || k->complete || k->version || k->ranks > 0)
		return pm_fail(PM_USAGE, "'%s': options for files, ranks, timing and help belong to cycle itself, not inside the sentence", w->stage->word);
	if ((status = pm_stage_begin(w->stage)))
		return pm_fail(-status, "%s: %s", w->argv[0], pm_message());
	w->makes = w->makes && !w->stage->advances;
	if (w->stage->files && w->stage->nargs)
		return pm_fail(PM_USAGE, "%s: unexpected argument '%s' (inside a sentence no word reads files: cycle -i FILE does)", w->argv[0],
			w->stage->args[0]);
	if (w->stage->leaves_out)
		return pm_fail(PM_USAGE, "'%s' leaves frames out, but inside a sentence every frame must be passed on", w->stage->word);
	if (w->stage->kind == PM_SINK)
		return pm_fail(PM_USAGE, "'%s' ends a stream and cannot be part of a sentence (diag --tee FILE can)", w->argv[0]);
	return 0;
}

static void segments_make(struct pm_sentence *s, bool fused)
{
	for (int i = 0; i < s->nwords; i++) {
		bool process = !fused || !s->word[i].tool;
		struct segment *last = s->nsegments ? s->segment + s->nsegments - 1 : NULL;
		if (last && last->process == process)
			last->count++;
		else
			s->segment[s->nsegments++] = (struct segment){i, 1, process, {NULL, NULL}};
	}
}

int pm_sentence_free(struct pm_sentence *s)
{
	int status = 0;
	if (!s)
		return 0;
	for (int i = 0; i < s->nsegments; i++)
		for (int k = 0; k < 2; k++) {
			int end = pm_chain_close(s->segment[i].chain[k]);
			status = status ? status : end;
		}
	for (int i = 0; i <= s->nwords && i < most_words; i++) {
		pm_stage_free(s->word[i].stage);
		for (int k = 0; k < s->word[i].argc; k++)
			free(s->word[i].argv[k]);
	}
	free(s);
	return status;
}

struct pm_sentence *pm_sentence_new(const char *text, bool fused, const struct pm_list *moves)
{
	struct pm_sentence *s = calloc(1, sizeof *s);
	char *buffer = malloc(strlen(text) + 1);
	int status = s && buffer ? split(s, text, buffer) : pm_no_memory();
	free(buffer);
	for (int i = 0; s && i < s->nwords && !status; i++)
		status = word_make(s->word + i, moves);
	if (status) {
		pm_sentence_free(s);
		return NULL;
	}
	segments_make(s, fused);
	return s;
}

void pm_sentence_notes(struct pm_sentence *s, const struct pm_stage *as)
{
	for (int i = 0; i < s->nwords; i++) {
		struct word *w = s->word + i;
		if (!w->stage || w->stage->verbose || w->stage->quiet || !(as->verbose || as->quiet))
			continue; /* what was typed behind the word stays */
		w->stage->verbose = as->verbose;
		w->stage->quiet = as->quiet;
		w->argv[w->argc + 1] = as->quiet ? "--quiet" : "--verbose"; /* of its process */
	}
}

/* ---- running ---- */

/* The argv lists of a segment, all its words or those that make fields. */
static struct pm_chain *chain_start(struct pm_sentence *s, const struct segment *g, bool priming)
{
	char **list[most_words + 1];
	int n = 0;
	for (int i = g->first; i < g->first + g->count; i++)
		if (!priming || s->word[i].makes)
			list[n++] = s->word[i].argv;
	list[n] = NULL;
	return n ? pm_chain_new(list) : NULL;
}

static int run_processes(struct pm_sentence *s, struct segment *g, bool priming, struct pm_frame **f)
{
	bool any = !priming;
	for (int i = g->first; i < g->first + g->count; i++)
		any |= s->word[i].makes;
	if (!any)
		return 0;
	if (!g->chain[priming])
		g->chain[priming] = chain_start(s, g, priming);
	if (!g->chain[priming])
		return -PM_DATA;
	return pm_chain_apply(g->chain[priming], f);
}

static int run_fused(struct pm_sentence *s, const struct segment *g, bool priming, struct pm_frame *f)
{
	for (int i = g->first; i < g->first + g->count; i++) {
		struct word *w = s->word + i;
		if (priming && !w->makes)
			continue;
		w->stage->fused = true;
		int status = pm_stage_apply(w->stage, f);
		if (status == PM_SKIP)
			return pm_fail(PM_USAGE, "'%s' left the frame out, but inside a sentence every frame must be passed on", w->stage->word);
		if (status < 0)
			return pm_fail(-status, "%s: %s", w->stage->word, pm_message());
	}
	return 0;
}

static int run_all(struct pm_sentence *s, bool priming, struct pm_frame **f)
{
	int status = 0;
	for (int i = 0; i < s->nsegments && !status; i++) {
		struct segment *g = s->segment + i;
		status = g->process ? run_processes(s, g, priming, f) : run_fused(s, g, priming, *f);
	}
	return status;
}

int pm_sentence_pass(struct pm_sentence *s, struct pm_frame **f) { return run_all(s, false, f); }

int pm_sentence_prime(struct pm_sentence *s, struct pm_frame **f) { return run_all(s, true, f); }

int pm_sentence_end(struct pm_sentence *s)
{
	for (int i = 0; i < s->nsegments; i++)
		for (int k = 0; k < s->segment[i].count && !s->segment[i].process; k++) {
			const struct word *w = s->word + s->segment[i].first + k;
			int status = w->tool->end ? w->tool->end(w->stage) : 0;
			if (status)
				return pm_fail(-status, "%s: %s", w->stage->word, pm_message());
		}
	return 0;
}

/* Does the running word drop a change that a word in front of it made? */
static bool undoes(const struct word *w, const struct pm_frame *h)
{
	bool any = false;
	for (size_t i = 0; i < h->ndropped && !w->makes; i++)
		any |= h->dropped[i]->role == PM_CHANGE;
	return any;
}

/* FNV-1a of a text with its end. */
static uint64_t with(uint64_t h, const char *text)
{
	do
		h = (h ^ (unsigned char)*text) * 1099511628211u;
	while (*text++);
	return h;
}

/* A number for all that decides whether declare() misses a field: which there are, where, and as what. */
static uint64_t shape(const struct pm_frame *f)
{
	uint64_t h = with(14695981039346656037u, f->law);
	for (size_t i = 0; i < f->nsets; i++)
		h = with(h + f->sets[i]->fixed, f->sets[i]->name);
	for (size_t i = 0; i < f->nmeshes; i++)
		h = with(h, f->meshes[i]->name);
	for (size_t i = 0; i < f->nfields; i++) {
		const struct pm_field *p = f->fields[i];
		h = with(with(with(h + (uint64_t)(8 * p->components + (int)p->role), p->name), p->on), p->of);
		for (int t = 0; t < p->nterms; t++)
			h = with(h, p->terms[t]);
	}
	return h | 1;
}

/* Tries declare() on a header without data: it reports missing fields without computing anything. What a word behind the force drops is missing
 * in every pass: no priming helps. A frame of the same shape as the last that needed none needs none: most steps. */
int pm_sentence_needs_priming(struct pm_sentence *s, const struct pm_frame *f)
{
	const uint64_t now = shape(f);
	if (now == s->ready)
		return 0;
	struct pm_frame *h = pm_frame_header(f);
	bool needs = false, known = h != NULL, made = false;
	const struct word *undid = NULL;
	for (int i = 0; i < s->nwords && known && !needs; i++) {
		struct word *w = s->word + i;
		if (!w->stage)
			break; /* the fields that a foreign word adds or changes are unknown before it runs */
		w->stage->trial = true;
		int status = pm_stage_declare(w->stage, h);
		w->stage->trial = false;
		needs = status == -PM_MISSING && !w->makes;
		known = status >= 0;
		made |= w->makes;
		if (w->makes || (made && known && undoes(w, h)))
			undid = w->makes ? NULL : w;
		if (needs && undid)
			pm_fail(PM_USAGE, "'%s' between the force and '%s' drops what the force computed (behind the last push, or in "
				"front of the words of the force)", undid->stage->word, w->stage->word);
		pm_frame_settle(h);
	}
	pm_frame_free(h);
	s->ready = known && !needs ? now : 0;
	return needs && undid ? -PM_USAGE : needs;
}

/* What a word does with the field: 0 nothing, 1 uses it, -1 it is gone or made anew; h: the header before the word, then behind it. */
static int use_by(struct pm_stage *stage, struct pm_frame *h, const struct pm_field *field)
{
	stage->trial = true;
	const int status = pm_stage_declare(stage, h);
	stage->trial = false;
	const struct pm_field *now = pm_frame_field(h, field->on, field->name);
	bool reads = status < 0 || (now && now->use & (PM_USE_READ | PM_USE_CHANGE));
	for (size_t i = 0; i < h->ndropped; i++) /* and where it is dropped behind that */
		reads |= !strcmp(h->dropped[i]->name, field->name) && !strcmp(h->dropped[i]->on, field->on) && h->dropped[i]->use & PM_USE_READ;
	const int use = reads ? 1 : !now || now->use & PM_USE_NEW ? -1 : 0;
	pm_frame_settle(h);
	return use;
}

bool pm_sentence_uses(struct pm_sentence *s, const struct pm_frame *f, const struct pm_field *field)
{
	struct pm_frame *h = pm_frame_header(f);
	int use = h ? 0 : 1;
	for (int i = 0; i < s->nwords && !use; i++)
		use = s->word[i].stage ? use_by(s->word[i].stage, h, field) : 1;
	pm_frame_free(h);
	return use >= 0; /* 0: nobody makes it again */
}

void pm_sentence_forces(struct pm_sentence *s, struct pm_frame *f)
{
	struct pm_frame *h = pm_frame_header(f);
	int status = h ? 0 : pm_failed();
	pm_acting_forget(f);
	for (int i = 0; i < s->nwords && status >= 0 && s->word[i].stage; i++) {
		struct word *w = s->word + i;
		w->stage->trial = true;
		status = pm_stage_declare(w->stage, h);
		w->stage->trial = false;
		for (size_t k = 0; k < h->nfields && status >= 0; k++)
			if (pm_frame_set(h, h->fields[k]->on))
				pm_acting_note(f, h->fields[k]);
		pm_frame_settle(h);
	}
	pm_frame_free(h);
}

int pm_sentence_words(const struct pm_sentence *s) { return s->nwords; }

const struct pm_stage *pm_sentence_stage(const struct pm_sentence *s, int word) { return word < s->nwords ? s->word[word].stage : NULL; }

bool pm_sentence_says(const struct pm_sentence *s, const char *name)
{
	const size_t n = strlen(name);
	bool says = false;
	for (int i = 0; i < s->nwords && !says; i++) {
		const struct pm_stage *stage = s->word[i].stage;
		says = !stage || !strcmp(stage->tool->name, name);
		for (int k = 0; !says && k < stage->nargs; k++)
			says = !strncmp(stage->args[k], name, n) && (!stage->args[k][n] || stage->args[k][n] == '/');
	}
	return says;
}

bool pm_sentence_waits(const struct pm_sentence *s)
{
	for (int i = 0; i < s->nsegments; i++)
		if (s->segment[i].process)
			return true;
	return false;
}

static bool writes_files(const struct pm_stage *s)
{
	for (const struct pm_option *o = s->tool->options; o && o->name; o++)
		if (o->unit && !strcmp(o->unit, "FILE") && pm_given(s, o->name))
			return true;
	return false;
}

int pm_sentence_safe(const char *text)
{
	struct pm_sentence *s = calloc(1, sizeof *s);
	char *buffer = malloc(strlen(text) + 1);
	int status = s && buffer ? split(s, text, buffer) : pm_no_memory();
	free(buffer);
	for (int i = 0; s && i < s->nwords && !status; i++) {
		struct word *w = s->word + i;
		w->tool = pm_tool_find(w->argv[0]);
		w->stage = w->tool ? pm_stage_make(w->tool, w->argc, w->argv, &status) : NULL;
		if (!w->tool || (w->stage && !status && writes_files(w->stage)))
			status = pm_fail(PM_DATA, "the sentence in the history of the checkpoint is none of plan's: '%s' %s (type the sentence instead of "
				"--plan)", w->argv[0], w->tool ? "writes a file" : "is no word of pmpipe");
	}
	pm_sentence_free(s);
	return status;
}

void pm_sentence_ranks(const struct pm_sentence *s, const struct pm_stage *as)
{
	char whole[1000] = "", shared[1000] = "";
	for (int i = 0; i < s->nwords; i++) {
		const struct pm_stage *w = s->word[i].stage;
		char *list = w && w->frames[1] ? shared : whole;
		if (!w || w->frames[0] || w->frames[1])
			snprintf(list + strlen(list), 1000 - strlen(list), "%s%.60s", *list ? ", " : "", w ? w->word : s->word[i].argv[0]);
	}
	if (pm_world_size() > 1)
		pm_say(as, "%d ranks share: %s; on rank 0 alone: %s", pm_world_size(), *shared ? shared : "no word", *whole ? whole : "no word");
}

int pm_sentence_timing(const struct pm_sentence *s, const char *file)
{
	const struct pm_stage *words[most_words];
	size_t n = 0;
	int status = 0;
	for (int i = 0; i < s->nwords; i++)
		if (s->word[i].stage)
			words[n++] = s->word[i].stage;
	if (file && !strcmp(file, "-") && n)
		pm_timing_table(n, words);
	else
		for (size_t i = 0; i < n && !status; i++)
			status = pm_timing_write(words[i], file);
	return status;
}
