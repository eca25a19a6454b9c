/* A stage: the definition of a tool, which runs in the same way as a process, fused inside cycle, or piped inside cycle (docs/stage.md).
 * A tool is one constant struct of this type named tool_<name>; the library does the rest.
 * SPDX-License-Identifier: GPL-3.0-or-later */
#ifndef PM_STAGE_H
#define PM_STAGE_H

#include "stream/declare.h"
#include "stream/wire.h"

PM_C_BEGIN

/* The type of the variable an option fills in the tool's config struct. Not given and no default: false, INT64_MIN, NAN, NULL, n = 0. */
enum pm_option_kind {
	PM_FLAG,    /* bool */
	PM_INTEGER, /* int64_t */
	PM_REAL,    /* double; finite */
	PM_WORD,    /* const char *, one of the choices */
	PM_TEXT,    /* const char * */
	PM_CELLS,   /* struct pm_cells: 64 or 64x32x32 */
	PM_VECTOR,  /* struct pm_vector: 1,2.5,-3 */
	PM_LIST     /* struct pm_list: words separated by commas; may be repeated */
};
enum { PM_LIST_MOST = 32 };
struct pm_cells {
	size_t cells[3];
	int n; /* numbers given; one stands for every axis (pm_cells_for) */
};
struct pm_vector {
	double x[PM_COMPONENTS];
	int n;
};
struct pm_list {
	const char *item[PM_LIST_MOST];
	int n;
};

struct pm_option {
	const char *name; /* long form, without the dashes; NULL ends the rows */
	char letter;      /* short form, 0 none */
	enum pm_option_kind kind;
	const char *unit;     /* shown in help: "length", "time", "cells", "FILE", ... */
	const char *fallback; /* the default, as one would type it; NULL none */
	double low, high;     /* inclusive range of numbers; both 0: any */
	const char *const *choices; /* of a PM_WORD (and of the items of a PM_LIST, if not NULL) */
	const char *const *numbered; /* further ones, up to the number that ends them ("mode_"); NULL none */
	const char *text;     /* one sentence */
	bool cosmetic;        /* does not change the results: kept out of the history */
	size_t offset;        /* in the config struct */
};

/* .offset of a member, in the rows of a tool that keeps its options in a struct config. */
#define PM_AT(member) .offset = offsetof(struct config, member)

struct pm_example {
	const char *text, *command; /* a command line that runs as printed, in an empty directory, in less than a second */
};

enum pm_kind { PM_SOURCE, PM_FILTER, PM_SINK };

/* What declare returns besides 0 and failure. */
enum {
	PM_PASS = 1, /* nothing to do in this frame: it is passed on unchanged, frame() is not called */
	PM_SKIP = 2, /* the frame is left out of the output */
	PM_HOLD = 3  /* the header of the result depends on data: everything is loaded first, and frame() may still change the header */
};

enum { PM_TOLD_MOST = 8 };

struct pm_stage {
	const struct pm_tool *tool;
	enum pm_kind kind;   /* from the tool; begin may change it (diag --tee: a filter) */
	void *config;        /* tool->config bytes, filled from the options */
	void *state;         /* tool->state bytes, zero at begin: only a cache (plans, hierarchies, orders) */
	int nargs;
	const char **args;   /* arguments that are not options */
	bool files;          /* they are streams to read one after another; begin may set it (stab, sh5) */
	char *word;          /* as typed, without the options of the library; the key of its report */
	json_t *entry;       /* for the history; NULL with --no-history */
	bool leaves_out;     /* set by begin: some frames are not written, so it cannot be part of a sentence */
	bool advances;       /* set by begin: it stands for a part of the step, so it is left out of priming, whatever tool->makes says */
	bool verbose, quiet; /* --verbose, --quiet: of the word, or of cycle for all its words */
	bool fused;          /* the next word of a sentence gets the frame in this process: values may be left to be made (stream/later.h) */
	bool trial;          /* cycle tries declare() on a header without data: it must not cache or count anything */
	bool idle;           /* it has reported that its effect is zero */
	const char *told[PM_TOLD_MOST]; /* formats that pm_tell_once has printed; NULL ends */
	int argc;
	char **argv;         /* as typed, for the other ranks */
	uint64_t frames[2];  /* computed with several ranks: on rank 0 alone, and divided */
	uint64_t sent[2];    /* [bytes], messages: by this rank, within divided frames */
	double shared;       /* [s] of work in these */
	double setup, seconds;  /* [s] set-up: begin, declare and the part of frame reported by pm_setup_since; work: the rest of frame */
	double processor;       /* [s] of the processors, by all threads, in the same work */
	struct pm_run *run;  /* of the library */
};

struct pm_tool {
	const char *name, *summary;        /* one sentence, no full stop */
	const char *about;                 /* a paragraph or two: the equation, the source, the limits */
	enum pm_kind kind;
	bool makes;                        /* makes change or derived fields from state, and changes no state: runs when cycle primes */
	const char *reads, *changes, *adds;/* fields, for people */
	size_t config, state;
	const struct pm_option *options;   /* rows; may be NULL */
	const struct pm_option *(*more)(void); /* further rows computed from a table; may be NULL */
	const char *arguments, *arguments_text; /* synopsis of the arguments that are not options ("ACTION..."), and a sentence; NULL none */
	const char *const *arguments_choices; /* what they may be, for completion, NULL ends; NULL none */
	int least, most;                   /* how many of them */
	const struct pm_example *examples; /* {0} ends */
	int (*begin)(struct pm_stage *s);  /* options are parsed; nothing has been read */
	int (*declare)(struct pm_stage *s, struct pm_frame *f);   /* the header alone: declare fields (pm_reads ...), change attributes; 0, PM_..., failure */
	int (*frame)(struct pm_stage *s, struct pm_frame *f);  /* the data are there: compute */
	/* Behind declare(): can the ranks share this frame, each with its own stretch of every field in use (docs/distributed.md)? NULL: never. */
	/* Of a source f is NULL: can they make the frames together, each its own stretch? */
	bool (*divided)(const struct pm_stage *s, const struct pm_frame *f);
	int (*flush)(struct pm_stage *s, struct pm_writer *w); /* filters: before an end marker goes out; may write frames held back */
	int (*end)(struct pm_stage *s);    /* the input ended well */
	void (*free)(struct pm_stage *s);
	int (*source)(struct pm_stage *s, struct pm_frame **f); /* sources: 1 and a frame, 0 no more */
	int (*whole)(struct pm_stage *s);  /* replaces the whole loop over frames (cycle, scmp) */
};

/* main of every tool. */
int pm_main(const struct pm_tool *tool, int argc, char **argv);

/* For tools. */
bool pm_given(const struct pm_stage *s, const char *option);       /* was it typed? */
void pm_stage_no_entry(struct pm_stage *s);                        /* begin(), source(): it leaves no entry in the history (looking, text of whole frames) */
int pm_cells_for(const struct pm_cells *c, int dim, size_t cells[3]); /* 0, or failure if the count of numbers does not fit */
void pm_say(const struct pm_stage *s, const char *format, ...) __attribute__((format(printf, 2, 3))); /* a line on stderr, with --verbose only */
void pm_note(const struct pm_stage *s, const char *format, ...) __attribute__((format(printf, 2, 3))); /* a line on stderr, not with --quiet */
void pm_tell_once(struct pm_stage *s, const char *format, ...) __attribute__((format(printf, 2, 3))); /* frame(): as pm_note, the first time */
/* declare(): the effect is zero here; prints the reason once (--verbose) and returns PM_PASS. */
int pm_idle(struct pm_stage *s, const char *format, ...) __attribute__((format(printf, 2, 3)));
void pm_setup_since(struct pm_stage *s, struct pm_clock began);    /* frame(): counts the time since `began` as set-up, not as work */
struct pm_reader *pm_stage_reader(struct pm_stage *s);             /* whole(): the input, opened */
struct pm_writer *pm_stage_writer(struct pm_stage *s);             /* whole(): the output, opened */
/* Reports travel in the tail under the stage's word; counts are added over steps, other values are replaced. */
void pm_report(const struct pm_stage *s, struct pm_frame *f, const char *key, double value);
void pm_report_sum(const struct pm_stage *s, struct pm_frame *f, const char *key, double value); /* added over steps, as counts are */
void pm_report_count(const struct pm_stage *s, struct pm_frame *f, const char *key, uint64_t count);
void pm_report_text(const struct pm_stage *s, struct pm_frame *f, const char *key, const char *value);

PM_C_END

#endif
