/* Shared by the files of lib/stage only. SPDX-License-Identifier: GPL-3.0-or-later */
#ifndef PM_STAGE_INTERNAL_H
#define PM_STAGE_INTERNAL_H

#include "base/replace.h"
#include "stage/h5-pipe.h"
#include "stage/stage.h"

/* Options of the library, the same for every tool. */
struct pm_common {
	bool help, man, complete, examples, version, no_history, verbose, quiet;
	const char *input, *output, *timing;
	int64_t threads, ranks;
};
extern const struct pm_option pm_common_options[];

struct pm_run {
	struct pm_common common;
	int ngiven;
	const char *given[128]; /* long names */
	int ncopies;
	char *copies[PM_LIST_MOST]; /* texts of list options, split into their items */
	struct pm_reader *reader;
	int operand; /* how many of the files among the arguments have been opened */
	struct pm_writer *writer;
	struct pm_replace text;     /* the file of a sink's text; path NULL: none, or one that is new */
	struct pm_h5_pipe *rest; /* the sh5 process after the writer if the output is HDF5; else NULL */
	struct pm_clock began;   /* when the stage was made */
};

enum { PM_ROWS = 3 };
/* The rows of a tool: its own, those computed, those of the library; any may be NULL. */
void pm_option_rows(const struct pm_tool *tool, const struct pm_option *rows[PM_ROWS]);
int pm_options_parse(struct pm_stage *s, int argc, char **argv);
struct pm_stage *pm_stage_make(const struct pm_tool *tool, int argc, char **argv, int *status); /* parsed, not begun */
int pm_stage_begin(struct pm_stage *s);
int pm_stage_frame(struct pm_stage *s, struct pm_frame *f); /* frame(), on this rank alone */
void pm_history_add(struct pm_stage *s, struct pm_frame *f);
struct pm_clock pm_work_clock(void);
void pm_work_since(struct pm_stage *s, struct pm_clock began);                /* counts the time since then as work */
void pm_timing_whole(struct pm_stage *s);                                     /* all since the stage was made is work, and that of ended processes */
int pm_timing_write(const struct pm_stage *s, const char *file);              /* file NULL: nothing; -: a sentence on standard error */
void pm_timing_table(size_t n, const struct pm_stage *const *words);          /* on standard error: set-up, work, share of the work of all */

void pm_help(const struct pm_tool *tool);
void pm_man(const struct pm_tool *tool);
void pm_complete(const struct pm_tool *tool);
void pm_print_examples(const struct pm_tool *tool);

#endif
