/* again: runs what the history of a file records, and compares the result with the file (lib/again/). SPDX-License-Identifier: GPL-3.0-or-later */
#include <errno.h>
#include <fcntl.h>
#include <string.h>
#include <unistd.h>

#include "again/recorded-run.h"
#include "stage/file-operands.h"
#include "stage/h5-pipe.h"
#include "stage/stage.h"

struct config {
	const char *output;
	bool list;
};

static const struct pm_option options[] = {
	{.name = "output", .letter = 'o', .kind = PM_TEXT, .unit = "FILE", .cosmetic = true, PM_AT(output), .text = "write FILE instead of standard output"},
	{.name = "list", .kind = PM_FLAG, .cosmetic = true, PM_AT(list), .text = "print the sentence on standard output, and run nothing"},
	{0},
};

static const struct pm_example examples[] = {
	{"The same bytes from the history.", "pinit plummer -n 100 | p2m | poisson-fft > a.pm; again -q a.pm | cmp - a.pm"},
	{"What made a file.", "pinit two-body | cycle -n 4 --every 2 'push kick/2 drift | pp | push kick/2' > b.pm; again --list b.pm"},
	{0}};

/* The file as a stream, whatever its kind; -1 for standard input, which is gone once it has been read. */
static int reference(const char *path)
{
	if (!strcmp(path, "-"))
		return -1;
	return pm_file_kind(path) == PM_FILE_HDF5 ? pm_h5_pipe_fd(path) : open(path, O_RDONLY | O_CLOEXEC);
}

/* Reads n bytes, fewer only at the end. */
static ssize_t fill(int fd, char *to, size_t n)
{
	size_t done = 0;
	ssize_t k = 1;
	while (done < n && (k > 0 || errno == EINTR)) {
		k = read(fd, to + done, n - done);
		done += k > 0 ? (size_t)k : 0;
		if (!k)
			break;
	}
	return k < 0 ? -1 : (ssize_t)done;
}

/* Passes the stream on, and compares it with the file. */
static int copy(int from, int with, FILE *out, bool *same)
{
	static char a[65536], b[65536];
	ssize_t n, m;
	while ((n = fill(from, a, sizeof a)) > 0) {
		if (out && (fwrite(a, 1, (size_t)n, out) != (size_t)n || fflush(out)))
			return pm_fail_errno("cannot write the output");
		m = with >= 0 ? fill(with, b, (size_t)n) : n;
		*same &= m == n && (with < 0 || !memcmp(a, b, (size_t)n));
	}
	*same &= with < 0 || fill(with, b, 1) == 0;
	return n < 0 ? pm_fail_errno("cannot read the result") : 0;
}

static int run(struct pm_stage *s, struct pm_recorded_run *r)
{
	const char *path = s->args[0], *output = ((const struct config *)s->config)->output;
	int end = -1, with = reference(path), status;
	bool same = true;
	if (output && (status = pm_recorded_output(r, output)))
		return status;
	if ((status = pm_recorded_start(r, &end)))
		return status;
	status = copy(end, output ? -1 : with, output ? NULL : stdout, &same);
	int ended = pm_recorded_wait(r);
	if (status || ended)
		return ended ? ended : status;
	if (output && (status = copy(reference(output), with, NULL, &same)))
		return status;
	if (!same)
		pm_tell_once(s, "the run gives other bytes than '%s': no history has where cycle ended, which fields it wrote, a word's second time, or short "
			"forms of options, under which its reports stand (scmp compares the two)", path);
	else if (with >= 0)
		pm_say(s, "the same bytes as '%s'", path);
	return 0;
}

static int whole(struct pm_stage *s)
{
	const struct config *c = s->config;
	struct pm_recorded_run r = {0};
	struct pm_reader *in = pm_h5_pipe_open(s->args[0]);
	int status = in ? pm_recorded_read(&r, in) : -PM_DATA;
	if (in)
		pm_reader_close(in);
	if (!status)
		status = pm_recorded_commands(&r);
	if (!status && (c->list || !s->quiet))
		pm_recorded_print(&r, c->list ? stdout : stderr, c->list ? "" : "again: ");
	if (!status && !c->list)
		status = pm_recorded_check(&r);
	if (!status && !c->list) /* a writer of its own refuses a terminal */
		status = c->output || pm_stage_writer(s) ? run(s, &r) : -PM_USAGE;
	pm_recorded_free(&r);
	return status;
}

const struct pm_tool tool_again = {
	.name = "again",
	.summary = "runs what the history of a file records, and compares the result with the file",
	.about = "Prints the sentence of the history on standard error, checks it, runs it, and writes its stream. It is run from the last word on that makes "
		"a stream (pinit, stab, stack). The programs are those beside this one, of the version that the history names, started with the recorded "
		"options as they are: no shell parses them. Refused are other programs and versions, input files that are not there, words "
		"of other programs in the sentence of cycle, and options that write files. A history holds what changes results: how many steps cycle ran and "
		"which it wrote is taken from the frames; a single frame is taken for the last of a run from step 0. One line says so where the bytes "
		"differ from those of FILE.",
	.kind = PM_SOURCE,
	.config = sizeof(struct config),
	.options = options,
	.arguments = "FILE",
	.arguments_text = "a stream or an HDF5 file; - is standard input, with which nothing is compared",
	.least = 1,
	.most = 1,
	.examples = examples,
	.whole = whole,
};
