/* scmp: norms of the difference of two streams, field by field and frame by frame, particles matched by id. A field is compared with the second
 * stream as the reference. Holds the fields compared of one frame of each. SPDX-License-Identifier: GPL-3.0-or-later */
#include <stdio.h>
#include <string.h>

#include "measure/norms.h"
#include "measure/field-pairs.h"
#include "stage/h5-pipe.h"
#include "stage/stage.h"

enum { L1, L2, MAX, RELATIVE_L2, RELATIVE_MAX };
static const char *const norms[] = {"l1", "l2", "max", "relative_l2", "relative_max", NULL};

struct config {
	struct pm_list fields, on;
	double tolerance;
	const char *norm;
	bool common, by_index;
};

static const struct pm_option options[] = {
	{.name = "field", .letter = 'f', .kind = PM_LIST, .unit = "NAME", PM_AT(fields), .text = "compare these fields only, wherever they are"},
	{.name = "set", .kind = PM_LIST, .unit = "NAME", PM_AT(on), .text = "compare what is on these sets or meshes only"},
	{.name = "tolerance", .letter = 't', .kind = PM_REAL, .high = 1e300, PM_AT(tolerance),
		.text = "exit 1 if the norm of any field is larger (or not a number)"},
	{.name = "norm", .kind = PM_WORD, .fallback = "relative_l2", .choices = norms, PM_AT(norm), .text = "the norm that --tolerance is held against"},
	{.name = "common", .kind = PM_FLAG, PM_AT(common), .text = "pass over fields that only one of the two has (an error without it)"},
	{.name = "by-index", .kind = PM_FLAG, PM_AT(by_index), .text = "compare particles in the order in which they come, even where both have an id"},
	{0},
};

static struct pm_field_pairs_choice choice_of(const struct config *c)
{
	return (struct pm_field_pairs_choice){.fields = c->fields.item, .on = c->on.item, .common = c->common, .by_index = c->by_index};
}

/* Where the difference is largest, in words. */
static void place(const struct pm_frame *f, const struct pm_field *a, bool id, size_t worst, char out[64])
{
	size_t points[3];
	const struct pm_mesh *m = pm_frame_mesh(f, a->on);
	if (m) {
		pm_mesh_points(f, m, points);
		snprintf(out, 64, "%zu,%zu,%zu", worst % points[0], worst / points[0] % points[1], worst / points[0] / points[1]);
	} else if (id && a->count)
		snprintf(out, 64, "%lld", (long long)pm_in_i64(pm_frame_field(f, a->on, "id"), 0)[worst]);
	else
		snprintf(out, 64, "%zu", worst);
}

struct state {
	uint64_t frame; /* from 1 */
	bool begun;     /* the line of words is out */
	bool over;      /* a norm was beyond the tolerance */
};

static void words(struct state *st)
{
	if (!st->begun)
		puts("frame\ton\tfield\tn\tl1\tl2\tmax\trelative_l2\trelative_max\tworst");
	st->begun = true;
}

static void row(const struct config *c, struct state *st, const char *on, const char *name, size_t n, const struct pm_norms *d, const char *at)
{
	const double all[] = {d->l1, d->l2, d->max, d->relative_l2, d->relative_max};
	words(st);
	printf("%llu\t%s\t%s\t%zu", (unsigned long long)st->frame, on, name, n);
	for (int i = 0; norms[i]; i++) {
		printf("\t%.10g", all[i]);
		if (!strcmp(norms[i], c->norm) && !(all[i] <= c->tolerance) && !isnan(c->tolerance) && !st->over) {
			pm_fail(PM_DATA, "frame %llu: '%s' on '%s': %s is %.4g, above %g", (unsigned long long)st->frame, name, on, c->norm, all[i], c->tolerance);
			st->over = true;
		}
	}
	printf("\t%s\n", at);
}

static int field_row(const struct config *c, const struct pm_frame *f, const struct pm_frame *g, const struct pm_field *a, const struct pm_field *b,
	struct state *st)
{
	const struct pm_field_pairs_choice choice = choice_of(c);
	char at[64];
	size_t *match = NULL, *work = NULL;
	double *weight = NULL;
	const struct pm_mesh *m = pm_frame_mesh(f, a->on);
	bool id = pm_field_pairs_by_id(&choice, f, g, a->on);
	int status = 0;
	if (m && !(weight = pm_field_pairs_weights(f, m)))
		status = -PM_DATA;
	if (id && a->count) {
		match = pm_alloc(a->count, sizeof *match), work = pm_alloc(a->count, sizeof *work);
		status = match && work ? pm_norms_match(a->count, pm_in_i64(pm_frame_field(f, a->on, "id"), 0), pm_in_i64(pm_frame_field(g, a->on, "id"), 0), match, work)
				       : -PM_DATA;
	}
	if (!status) {
		struct pm_norms d = pm_norms_of(a, b, match, weight);
		place(f, a, id, d.worst, at);
		row(c, st, a->on, a->name, a->count, &d, at);
	}
	pm_free(match), pm_free(work), pm_free(weight);
	return status;
}

static int compare(const struct config *c, struct pm_reader *r[2], struct pm_frame *f[2], struct state *st)
{
	const struct pm_field_pairs_choice choice = choice_of(c);
	struct pm_field_pairs p;
	int status = pm_field_pairs_of(&choice, f[0], f[1], &p);
	for (int i = 0; i < 2 && !status; i++)
		status = pm_read_declared(r[i], f[i]);
	if (!status && !c->fields.n && !c->on.n) {
		double dt = fabs(f[0]->time - f[1]->time), relative = dt == 0 ? 0 : dt / fabs(f[1]->time);
		struct pm_norms d = {dt, dt, dt, relative, relative, 0};
		row(c, st, "-", "time", 1, &d, "-");
	}
	for (int i = 0; i < p.n && !status; i++)
		status = field_row(c, f[0], f[1], p.a[i], p.b[i], st);
	return status;
}

/* The next frame, over the ends of streams that follow each other; 0 at the end of the input. */
static int next(struct pm_reader *r, struct pm_frame **f)
{
	int got;
	do
		got = pm_read_header(r, f);
	while (got == PM_GOT_END);
	return got;
}

/* The failure again, with the place in front. */
static int at_frame(const struct state *st, const char *stream, int status)
{
	char why[1024];
	snprintf(why, sizeof why, "%s", pm_message());
	return pm_fail(-status, "frame %llu%s%s: %s", (unsigned long long)st->frame, *stream ? " of " : "", stream, why);
}

static int streams(struct pm_stage *s, struct pm_reader *r[2])
{
	struct state *st = s->state;
	int status = 0, got[2] = {1, 1};
	while (!status && got[0] && got[1]) {
		struct pm_frame *f[2] = {NULL, NULL};
		st->frame++;
		for (int i = 0; i < 2 && !status; i++)
			if ((got[i] = next(r[i], &f[i])) < 0)
				status = at_frame(st, s->args[i], got[i]);
		if (!status && got[0] != got[1])
			status = pm_fail(PM_DATA, "'%s' ends after %llu frames, '%s' has more", s->args[got[0] != 0], (unsigned long long)st->frame - 1, s->args[got[0] == 0]);
		if (!status && got[0] && (status = compare(s->config, r, f, st)))
			status = at_frame(st, "", status);
		pm_frame_free(f[0]), pm_frame_free(f[1]);
	}
	if (!status)
		words(st);
	return status ? status : st->over ? -PM_DATA : 0;
}

static int whole(struct pm_stage *s)
{
	const struct config *c = s->config;
	struct pm_reader *r[2] = {NULL, NULL};
	int status = 0;
	if (c->fields.n == PM_LIST_MOST || c->on.n == PM_LIST_MOST) /* the lists end in NULL */
		return pm_fail(PM_USAGE, "--field and --set take at most %d names", PM_LIST_MOST - 1);
	if (!strcmp(s->args[0], "-") && !strcmp(s->args[1], "-"))
		return pm_fail(PM_USAGE, "standard input cannot be both streams (name a file)");
	for (int i = 0; i < 2 && !status; i++)
		status = (r[i] = pm_h5_pipe_open(s->args[i])) ? 0 : -PM_DATA;
	if (!status)
		status = streams(s, r);
	for (int i = 0; i < 2; i++)
		if (r[i])
			pm_reader_close(r[i]);
	return status;
}

static const struct pm_example examples[] = {
	{"Two ways to the same force; the second is the reference.", "pinit plummer -n 200 | p2m | poisson-fft | mgrad | m2p > a; pinit plummer -n 200 | pp > b; scmp --field acc a b"},
	{"Exit 1 unless two files hold the same numbers.", "pinit plummer -n 50 > a; cp a b; scmp --tolerance 0 a b"},
	{0}};

const struct pm_tool tool_scmp = {
	.name = "scmp",
	.summary = "norms of the difference of two streams, field by field",
	.about = "Prints for every field of every frame l1 = mean |a-b|, l2 = root mean |a-b|^2, max |a-b|, the last two also divided by those of b, and where the "
		 "difference is largest (an id, an index, or a mesh point). |.| is the length over the components; means over a mesh count points on its faces half. "
		 "Particles are matched by id where both streams have one, by index otherwise. What has another shape is refused; a stream that is shorter than "
		 "the other is exit 1. Without --field and --set the times are compared too.",
	.kind = PM_SINK,
	.config = sizeof(struct config),
	.state = sizeof(struct state),
	.options = options,
	.arguments = "A B",
	.arguments_text = "Two streams; - is standard input.",
	.least = 2,
	.most = 2,
	.examples = examples,
	.whole = whole,
};
