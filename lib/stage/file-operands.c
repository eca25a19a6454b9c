/* Streams in files, one after another: each must end where its last frame ends, so a cut file is told as that and never runs into the next one.
 * SPDX-License-Identifier: GPL-3.0-or-later */
#include <fcntl.h>
#include <string.h>
#include <unistd.h>

#include "stage/file-operands.h"
#include "stage/h5-pipe.h"
#include "stage/internal.h"

const char *const pm_files_text = "streams to read one after another instead of standard input; - is standard input, HDF5 is read through sh5";

bool pm_takes_files(const struct pm_tool *tool) { return !tool->arguments && tool->kind != PM_SOURCE; }

static bool standard(const char *path) { return !strcmp(path, "-"); }

/* The next file: 1 and its descriptor, 0 if there is none, or failure. */
static int next(void *from, int *fd)
{
	struct pm_stage *s = from;
	struct pm_run *run = s->run;
	if (run->operand == s->nargs)
		return 0;
	const char *path = s->args[run->operand++];
	*fd = standard(path) ? STDIN_FILENO : pm_file_kind(path) == PM_FILE_HDF5 ? pm_h5_pipe_fd(path) : open(path, O_RDONLY | O_CLOEXEC);
	if (*fd < 0 && pm_file_kind(path) != PM_FILE_HDF5)
		return pm_fail_errno("cannot open it");
	return *fd < 0 ? -PM_DATA : 1;
}

struct pm_reader *pm_operands_open(struct pm_stage *s)
{
	int inputs = 0, fd = -1;
	if (pm_given(s, "input")) {
		pm_fail(PM_USAGE, "-i %s and the file '%s': which one? (files are read in the order in which they are typed: %s A B)", s->run->common.input,
			s->args[0], s->tool->name);
		return NULL;
	}
	for (int i = 0; i < s->nargs; i++)
		if ((inputs += standard(s->args[i])) > 1) {
			pm_fail(PM_USAGE, "standard input can be read only once (one - among the files)");
			return NULL;
		} else if (!standard(s->args[i]) && access(s->args[i], R_OK)) {
			pm_fail_errno("cannot open '%s'", s->args[i]);
			return NULL;
		}
	struct pm_reader *r = next(s, &fd) > 0 ? pm_reader_of_fd(fd) : NULL;
	if (r)
		pm_reader_then(r, next, s);
	return r;
}

const char *pm_operand_name(const struct pm_stage *s)
{
	const char *path = s->run->operand ? s->args[s->run->operand - 1] : NULL;
	return path && standard(path) ? "standard input" : path;
}
