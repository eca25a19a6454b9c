/* stack: combines scenes frame by frame: the particles of several streams in one box. SPDX-License-Identifier: GPL-3.0-or-later */
#include <stdio.h>
#include <string.h>

#include "stage/attribute-options.h"
#include "stage/h5-pipe.h"
#include "stream/join.h"
#include "world/world.h"

struct config {
	struct pm_list names;
	struct pm_vector box;
	bool merge;
};

enum { most_inputs = 32 };

struct state {
	struct pm_reader *reader[most_inputs];
	uint64_t frames;
};

static const struct pm_option options[] = {
	{.name = "as", .kind = PM_LIST, .unit = "NAME", PM_AT(names),
		.text = "names for the sets, one per stream (default: their own; a repeated name becomes NAME-2)"},
	{.name = "merge", .kind = PM_FLAG, PM_AT(merge), .text = "sets of the same name become one set"},
	{.name = "box", .kind = PM_VECTOR, .unit = "length", PM_AT(box),
		.text = "lo,hi of every axis, or all lo and then all hi (default: the smallest box that contains all boxes)"},
	{0},
};

static int begin(struct pm_stage *s)
{
	int standard = 0;
	for (int i = 0; i < s->nargs; i++)
		standard += !strcmp(s->args[i], "-");
	return standard > 1 ? pm_fail(PM_USAGE, "standard input can be only one of the streams") : 0;
}

static int open_all(struct pm_stage *s, struct state *st)
{
	for (int i = 0; i < s->nargs && !st->reader[i]; i++)
		if (!(st->reader[i] = pm_h5_pipe_open(s->args[i])))
			return -PM_DATA;
	return 0;
}

/* Puts the stream and the frame in front of the message of the failure. */
static int blame(const struct pm_stage *s, int i, int status)
{
	char why[1024];
	snprintf(why, sizeof why, "%s", pm_message());
	return pm_fail(-status, "%s: frame %llu: %s", s->args[i], (unsigned long long)((struct state *)s->state)->frames, why);
}

/* The next frame of stream i, across the end markers of concatenated streams. */
static int next(struct pm_stage *s, int i, struct pm_frame **f)
{
	int got;
	do
		got = pm_read_frame(((struct state *)s->state)->reader[i], f);
	while (got == PM_GOT_END);
	return got < 0 ? blame(s, i, got) : got;
}

static int join_next(struct pm_stage *s, int i, struct pm_frame *f, struct pm_join *join)
{
	struct pm_frame *g = NULL;
	int64_t before = join->next_id;
	int got = next(s, i, &g);
	if (got == 0)
		got = pm_fail(PM_DATA, "'%s' ends before '%s'", s->args[i], s->args[0]);
	if (got > 0 && (got = pm_frame_join(f, g, join)))
		got = blame(s, i, got);
	if (!got && before > 0)
		pm_report(s, f, "first_id_free", (double)join->next_id);
	pm_frame_free(g);
	return got;
}

static int stacked(struct pm_stage *s, struct pm_frame **f)
{
	const struct config *c = s->config;
	struct state *st = s->state;
	struct pm_join join = {.merge = c->merge, .names = c->names.item, .nnames = c->names.n};
	struct pm_frame *other = NULL;
	int status = open_all(s, st);
	*f = NULL;
	st->frames++;
	if (!status)
		status = next(s, 0, f);
	if (status < 0)
		return status;
	if (!status) { /* all must end here */
		for (int i = 1; i < s->nargs && !status; i++)
			if ((status = next(s, i, &other)) > 0)
				status = pm_fail(PM_DATA, "'%s' ends before '%s'", s->args[0], s->args[i]);
		pm_frame_free(other);
		return status;
	}
	if ((status = pm_frame_join_first(*f, &join)))
		status = blame(s, 0, status);
	for (int i = 1; i < s->nargs && !status; i++)
		status = join_next(s, i, *f, &join);
	if (!status && c->box.n && !(status = pm_attributes_box(*f, &c->box)))
		pm_frame_meshes_span(*f);
	if (status)
		*f = pm_frame_free(*f);
	return status ? status : 1;
}

/* Ranks keep what they have read of a file; of ids rank 0 looks at all. */
static int source(struct pm_stage *s, struct pm_frame **f)
{
	const bool apart = pm_world_apart(false);
	const int more = stacked(s, f);
	pm_world_apart(apart);
	return more;
}

static void done(struct pm_stage *s)
{
	struct state *st = s->state;
	for (int i = 0; i < most_inputs; i++)
		if (st->reader[i])
			pm_reader_close(st->reader[i]);
}

static const struct pm_example examples[] = {
	{"Two clusters that fall towards each other, as one set.",
		"pinit plummer -n 500 --seed 1 | smove --shift 5,0,0 --boost -0.3,0,0 > a; pinit plummer -n 300 --seed 2 | smove --shift -5,0,0 --boost "
		"0.3,0,0 > b; stack --merge a b | sls"},
	{"The same as two sets.", "pinit plummer -n 50 > a; stack --as bulge,halo a a | sls"},
	{0}};

const struct pm_tool tool_stack = {
	.name = "stack",
	.summary = "combines scenes into one",
	.about = "Reads a frame of every stream and writes one frame with the sets of all. Dimensions, law, time and faces must agree, and the constants "
		"that several of them have; the box is the smallest that contains all boxes, the time step the smallest, the default mesh that of the "
		"first, spanning "
		"the new box. A set "
		 "whose name "
		 "is taken is renamed NAME-2, or joined to the other with --merge. Ids stay unique: if ids of a later stream could coincide with earlier "
		"ones, the "
		 "same number is added to all ids of that stream, so that its smallest becomes the first free id. Derived fields and changes are dropped, "
		"because "
		 "they are those of the separate scenes.",
	.kind = PM_SOURCE,
	.config = sizeof(struct config),
	.state = sizeof(struct state),
	.options = options,
	.arguments = "FILE...",
	.arguments_text = "Streams; - is standard input.",
	.least = 1,
	.most = most_inputs,
	.examples = examples,
	.begin = begin,
	.free = done,
	.source = source,
};
