/* sls: lists attributes, sets, meshes and fields of a stream; reads data only with --data. SPDX-License-Identifier: GPL-3.0-or-later */
#include <stdio.h>
#include <string.h>

#include "measure/frame-listing.h"
#include "stage/stage.h"

static const char *const formats[] = {"text", "json", NULL};

struct config {
	const char *format;
	struct pm_listing listing;
};

struct state {
	uint64_t frames;
};

static const struct pm_option options[] = {
	{.name = "data", .letter = 'd', .kind = PM_FLAG, PM_AT(listing.data), .text = "read the data too: smallest, largest and mean value of every component"},
	{.name = "history", .kind = PM_FLAG, PM_AT(listing.history), .text = "print the programs and options that made the frame"},
	{.name = "report", .kind = PM_FLAG, PM_AT(listing.report), .text = "print the reports of the stages: iterations, means removed, counts"},
	{.name = "format", .kind = PM_WORD, .fallback = "text", .choices = formats, PM_AT(format),
		.text = "text for people, json (one line per frame) for programs"},
	{0},
};

static int begin(struct pm_stage *s)
{
	pm_stage_no_entry(s); /* listing adds no entry to the history */
	return 0;
}

static int declare(struct pm_stage *s, struct pm_frame *f)
{
	for (size_t i = 0; ((const struct config *)s->config)->listing.data && i < f->nfields; i++)
		f->fields[i]->use |= PM_USE_READ;
	return 0;
}

static int frame(struct pm_stage *s, struct pm_frame *f)
{
	const struct config *c = s->config;
	struct state *st = s->state;
	st->frames++;
	if (!strcmp(c->format, "json"))
		return pm_list_json(stdout, &c->listing, f);
	pm_list_text(stdout, &c->listing, f, st->frames);
	return 0;
}

static bool divided(const struct pm_stage *s, const struct pm_frame *f) { return f && ((const struct config *)s->config)->listing.data; }

static int end(struct pm_stage *s)
{
	if (!strcmp(((const struct config *)s->config)->format, "text"))
		printf("%llu frames\n", (unsigned long long)((struct state *)s->state)->frames);
	return 0;
}

static const struct pm_example examples[] = {
	{"What a scene holds.", "pinit plummer -n 1000 | sls"},
	{"The extent of its particles.", "pinit plummer -n 1000 | sls --data"},
	{"How a stream was made, for a program.", "pinit plummer -n 1000 | sls --history --format json"},
	{0}};

const struct pm_tool tool_sls = {
	.name = "sls",
	.summary = "lists what a stream holds",
	.about = "Prints the attributes of every frame, its particle sets and meshes, and of every field the name, the number of components, the type, the "
		"role, whether it is a "
		 "strength or a value, unit, the state it is the change of, its terms, and its value if uniform. Data are read only with --data, which prints "
		 "smallest, largest and mean values. With --format json every frame is one line: the header of the stream, with report and data "
		 "added.",
	.kind = PM_SINK,
	.config = sizeof(struct config),
	.state = sizeof(struct state),
	.options = options,
	.examples = examples,
	.begin = begin,
	.declare = declare,
	.frame = frame,
	.divided = divided,
	.end = end,
};
