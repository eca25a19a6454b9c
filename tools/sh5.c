/* sh5: a stream in an HDF5 file, in the layout of openPMD 1.1 (docs/methods/hdf5.md), in both directions and exact to the byte. The only program that links
 * HDF5, which costs 5 ms to start; -i x.h5 and -o x.h5 of the others run it on a pipe. Cost: that of the disk.
 * SPDX-License-Identifier: GPL-3.0-or-later */
#include <string.h>

#include "h5/apart.h"
#include "h5/stream-copy.h"
#include "stage/file-operands.h"
#include "stage/h5-pipe.h"
#include "stage/stage.h"

struct config {
	const char *output;
};

struct state {
	struct pm_h5 *file;
};

static const struct pm_option options[] = {
	{.name = "output", .letter = 'o', .kind = PM_TEXT, .unit = "FILE", .cosmetic = true, PM_AT(output),
		.text = "write the stream on standard input to this HDF5 file, which appears when it is complete"},
	{0},
};

static const struct pm_example examples[] = {
	{"A cloud in a file, and a listing of the file", "pinit plummer -n 100 | sh5 -o cloud.h5; h5ls -r cloud.h5; sh5 cloud.h5 | sls"},
	{"Any tool reads and writes HDF5 through it", "pinit plummer -n 100 -o cloud.h5; p2m -i cloud.h5 -o mesh.h5; sls -i mesh.h5"},
	{0}};

static int begin(struct pm_stage *s)
{
	const struct config *c = s->config;
	if (!s->nargs && !c->output)
		return pm_fail(PM_USAGE, "which way? (sh5 FILE.h5 reads a file, sh5 -o FILE.h5 writes one)");
	for (int i = 0; i < s->nargs && !c->output; i++)
		if (pm_file_kind(s->args[i]) == PM_FILE_STREAM)
			return pm_fail(PM_USAGE, "'%s' is a stream already (sh5 %s -o FILE.h5 writes it as HDF5)", s->args[i], s->args[i]);
	if (c->output && !strcmp(c->output, "-"))
		return pm_fail(PM_USAGE, "-o -: HDF5 cannot be written to a pipe (-o FILE.h5)");
	s->files = s->nargs && c->output;
	if (s->nargs && !s->files)
		s->kind = PM_SOURCE;
	return 0;
}

static int to_file(struct pm_stage *s, struct state *st)
{
	struct pm_reader *r = pm_stage_reader(s);
	if (!r || !(st->file = pm_h5_create(((const struct config *)s->config)->output)))
		return pm_failed();
	return pm_h5_from_stream(st->file, r);
}

/* What the report says of a file of another program: how it was read, and what was left out. */
static void tell(void *stage, const struct pm_frame *f)
{
	const json_t *said = json_object_get(f->report, ((struct pm_stage *)stage)->word);
	const char *how = json_string_value(json_object_get(said, "read")), *less = json_string_value(json_object_get(said, "left_out"));
	if (how && less)
		pm_tell_once(stage, "%s; left out: %s", how, less);
}

static int from_file(struct pm_stage *s, struct state *st)
{
	struct pm_writer *w = pm_stage_writer(s);
	for (int i = 0; i < s->nargs; i++) {
		int apart = w ? pm_h5_read_apart(s->args[i], w, tell, s) : pm_failed();
		if (apart < 0)
			return apart;
		if (apart) /* the process that reads this file, and ends here */
			return (st->file = pm_h5_open(s->args[i], s->word)) ? pm_h5_to_stream(st->file, w, s->entry) : pm_failed();
	}
	return 0;
}

static int whole(struct pm_stage *s) { return s->kind == PM_SOURCE ? from_file(s, s->state) : to_file(s, s->state); }

static void done(struct pm_stage *s) { pm_h5_free(((struct state *)s->state)->file); }

const struct pm_tool tool_sh5 = {
	.name = "sh5",
	.summary = "HDF5 to stream and back, exactly",
	.about = "With FILE a source: the frames of an HDF5 file in the layout of openPMD 1.1, or a snapshot in GADGET's layout. "
		"With -o FILE a sink: writes its input as an openPMD file, which h5ls, h5dump, h5diff, openpmd-api and openpmd-viewer read. "
		 "Stream to HDF5 to stream gives equal bytes. Iterations are named by their step, or by the next free number if two frames have the same step. "
		 "-i FILE.h5 and -o FILE.h5 of any other tool run sh5 on a pipe.",
	.kind = PM_SINK,
	.config = sizeof(struct config),
	.state = sizeof(struct state),
	.options = options,
	.arguments = "[FILE...]",
	.arguments_text = "HDF5 files to read. With -o FILE.h5 the streams to write there; without them standard input.",
	.most = PM_FILES_MOST,
	.examples = examples,
	.begin = begin,
	.whole = whole,
	.free = done,
};
