/* sel: selects frames, sets, meshes, fields, and particles by an expression (lib/expression/selection.c).
 * SPDX-License-Identifier: GPL-3.0-or-later */
#include "stage/selection-options.h"
#include "stage/strength-report.h"

struct config {
	struct pm_list frames;
	struct pm_selection_options kept;
	const char *where;
	int64_t every;
	bool last;
};

struct state {
	uint64_t frame;         /* from 1 */
	struct pm_frame *kept;  /* the last one so far, with --last */
};

#define AT_KEPT(member) PM_AT(kept.member)
static const struct pm_option options[] = {
	{.name = "frames", .kind = PM_LIST, .unit = "N|N:M", PM_AT(frames),
		.text = "frames by number, counted from 1: 1,3,5:10 or 7: for all from the seventh"},
	{.name = "every", .kind = PM_INTEGER, .unit = "steps", .fallback = "1", .low = 1, .high = 1e15, PM_AT(every),
		.text = "frames whose step number is a multiple of this"},
	{.name = "last", .kind = PM_FLAG, PM_AT(last), .text = "only the last frame of each stream, after the other selections"},
	PM_SELECTION_ROWS(AT_KEPT, 1),
	{.name = "where", .kind = PM_TEXT, .unit = "EXPRESSION", PM_AT(where), .text = "keep the particles for which this is true: 'x < 0.5 && mass > 0'"},
	{0},
};

static int begin(struct pm_stage *s)
{
	const struct config *c = s->config;
	s->leaves_out = c->frames.n || c->every > 1 || c->last;
	return pm_frame_numbers_check(&(struct pm_names){c->frames.item, c->frames.n});
}

static struct pm_selection selection_of(const struct config *c)
{
	struct pm_selection selection = pm_selection_of(&c->kept);
	selection.where = c->where;
	return selection;
}

static int declare(struct pm_stage *s, struct pm_frame *f)
{
	const struct config *c = s->config;
	struct state *st = s->state;
	const struct pm_names frames = {c->frames.item, c->frames.n};
	const struct pm_selection selection = selection_of(c);
	st->frame += !s->trial;
	if (f->step % c->every || !pm_frame_numbers_contain(&frames, st->frame + s->trial))
		return PM_SKIP;
	int status = pm_selection_declare(&selection, f);
	return status ? status : c->where || c->last ? PM_HOLD : 0;
}

static int frame(struct pm_stage *s, struct pm_frame *f)
{
	const struct config *c = s->config;
	struct state *st = s->state;
	const struct pm_selection selection = selection_of(c);
	struct pm_strengths before, after;
	int status = 0;
	if (c->where) {
		pm_strengths_of(f, NULL, &before);
		status = pm_selection_apply(&selection, f);
	}
	if (c->where && !status) {
		pm_strengths_of(f, NULL, &after);
		pm_report_strengths(s, f, "given", &before, &after);
	}
	if (status || !c->last)
		return status;
	pm_frame_free(st->kept);
	st->kept = pm_frame_copy(f);
	return st->kept ? PM_SKIP : -PM_DATA;
}

static bool divided(const struct pm_stage *s, const struct pm_frame *f)
{
	const struct config *c = s->config;
	const struct pm_selection selection = selection_of(c);
	return !c->last && pm_selection_divides(&selection, f);
}

static int flush(struct pm_stage *s, struct pm_writer *w)
{
	struct state *st = s->state;
	int status = st->kept ? pm_write_frame(w, st->kept) : 0;
	st->kept = pm_frame_free(st->kept);
	return status;
}

static void done(struct pm_stage *s) { pm_frame_free(((struct state *)s->state)->kept); }

static const struct pm_example examples[] = {
	{"The particles within a distance, without their velocities.", "pinit plummer -n 1000 | sel --where 'x^2+y^2+z^2 < 1' --drop v | sls"},
	{"The first and the third frame.", "pinit plummer -n 10 > a; cat a a a | sel --frames 1,3 | sls"},
	{"The last frame, positions only.", "pinit plummer -n 10 | cycle -n 3 --every 1 'push kick/2 drift | pp | push kick/2' | sel --last --field x,id | "
		"sls"},
	{0}};

const struct pm_tool tool_sel = {
	.name = "sel",
	.summary = "selects frames, sets, fields and particles",
	.about = "Kinds for which nothing is named are kept. Frames are counted from 1 over the whole input, as in messages. --where keeps the particles "
		"for which an expression is not 0 (see scalc); their derived fields and changes keep the values computed with all particles. The names in "
		"--set, --field or --drop must exist in every frame.",
	.kind = PM_FILTER,
	.config = sizeof(struct config),
	.state = sizeof(struct state),
	.options = options,
	.examples = examples,
	.begin = begin,
	.declare = declare,
	.frame = frame,
	.divided = divided,
	.flush = flush,
	.free = done,
};
