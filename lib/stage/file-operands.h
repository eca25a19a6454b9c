/* Files typed behind the options of a word, read one after another as cat would. SPDX-License-Identifier: GPL-3.0-or-later */
#ifndef PM_STAGE_FILE_OPERANDS_H
#define PM_STAGE_FILE_OPERANDS_H

#include "stage/stage.h"

enum { PM_FILES_MOST = 1 << 20 }; /* as many as a command line can hold: for a tool's row `most` */
bool pm_takes_files(const struct pm_tool *tool); /* its arguments are streams to read: it reads one, and has no other arguments */
extern const char *const pm_files_text;          /* for the help of such a word */

/* A reader of the streams in s->args. Every file must be there before the first is read; it is opened when its turn comes. */
struct pm_reader *pm_operands_open(struct pm_stage *s);
const char *pm_operand_name(const struct pm_stage *s); /* the file that is read now, as typed; NULL if the input is not from such files */

#endif
