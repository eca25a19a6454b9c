/* scmp: norms of the difference of two streams, field by field and frame by frame, particles matched by id. A field is compared with the second
 * stream as the reference (lib/measure/compare-streams.c). SPDX-License-Identifier: GPL-3.0-or-later */
#include <string.h>

#include "measure/compare-streams.h"
#include "stage/apply.h"
#include "stage/h5-pipe.h"
#include "stage/stage.h"

struct config {
	struct pm_list fields, on;
	double tolerance;
	const char *norm;
	bool common, by_index;
};

struct state {
	struct pm_norms norms[PM_FIELD_PAIRS]; /* of the joint frame under way */
};

static const struct pm_option options[] = {
	{.name = "field", .letter = 'f', .kind = PM_LIST, .unit = "NAME", PM_AT(fields), .text = "compare only these fields, on any set or mesh"},
	{.name = "set", .kind = PM_LIST, .unit = "NAME", PM_AT(on), .text = "compare only fields on these sets or meshes"},
	{.name = "tolerance", .letter = 't', .kind = PM_REAL, .high = 1e300, PM_AT(tolerance),
		.text = "exit 1 if the norm of any field is larger (or not a number)"},
	{.name = "norm", .kind = PM_WORD, .fallback = "relative_l2", .choices = pm_norm_names, PM_AT(norm), .text = "the norm compared with --tolerance"},
	{.name = "common", .kind = PM_FLAG, PM_AT(common), .text = "skip fields that only one of the two has (otherwise an error)"},
	{.name = "by-index", .kind = PM_FLAG, PM_AT(by_index), .text = "compare particles by position in the stream, even if both have an id"},
	{0},
};

/* Of a joint frame, which ranks share. */
static int declare(struct pm_stage *s, struct pm_frame *joint)
{
	(void)s;
	pm_joint_declare(joint);
	return 0;
}

static int frame(struct pm_stage *s, struct pm_frame *joint) { return pm_joint_norms(joint, ((struct state *)s->state)->norms); }

static bool divided(const struct pm_stage *s, const struct pm_frame *joint) { return s && joint; }

static int joint_apply(void *s, struct pm_frame *joint) { return pm_stage_apply(s, joint); }

static int whole(struct pm_stage *s)
{
	const struct config *c = s->config;
	struct pm_reader *r[2] = {NULL, NULL};
	struct pm_comparison compare = {.choice = {.fields = c->fields.item, .on = c->on.item, .common = c->common, .by_index = c->by_index},
		.tolerance = c->tolerance, .out = stdout, .joint = joint_apply, .stage = s, .norms = ((struct state *)s->state)->norms};
	int status = 0;
	if (c->fields.n == PM_LIST_MOST || c->on.n == PM_LIST_MOST) /* the lists end in NULL */
		return pm_fail(PM_USAGE, "--field and --set allow at most %d names", PM_LIST_MOST - 1);
	if (!strcmp(s->args[0], "-") && !strcmp(s->args[1], "-"))
		return pm_fail(PM_USAGE, "standard input cannot be both streams (name a file)");
	while (strcmp(pm_norm_names[compare.norm], c->norm))
		compare.norm++;
	for (int i = 0; i < 2 && !status; i++)
		status = (r[i] = pm_h5_pipe_open(s->args[i])) ? 0 : -PM_DATA;
	if (!status)
		status = pm_compare_streams(&compare, r, s->args);
	for (int i = 0; i < 2; i++)
		if (r[i])
			pm_reader_close(r[i]);
	return status;
}

static const struct pm_example examples[] = {
	{"The same force computed in two ways; the second is the reference.", "pinit plummer -n 200 | p2m | poisson-fft | mgrad | m2p > a; pinit plummer -n "
		"200 | pp "
		"> b; scmp --field acc a b"},
	{"Exit 1 unless two files hold the same numbers.", "pinit plummer -n 50 > a; cp a b; scmp --tolerance 0 a b"},
	{0}};

const struct pm_tool tool_scmp = {
	.name = "scmp",
	.summary = "norms of the difference of two streams, field by field",
	.about = "Prints for every field of every frame l1 = mean |a-b|, l2 = root mean |a-b|^2, max |a-b|, the last two also divided by the norms of b, and "
		"where the "
		 "difference is largest (an id, an index, or a mesh point). |.| is the length over the components; means over a mesh count points on its "
		 "faces half. "
		 "Particles are matched by id where both streams have one, by index otherwise. Fields of different shapes are an error; streams of "
		"different lengths "
		 "are exit 1. Without --field and --set the times are compared too.",
	.kind = PM_SINK,
	.config = sizeof(struct config),
	.state = sizeof(struct state),
	.options = options,
	.arguments = "A B",
	.arguments_text = "Two streams; - is standard input.",
	.least = 2,
	.most = 2,
	.examples = examples,
	.declare = declare,
	.frame = frame,
	.divided = divided,
	.whole = whole,
};
