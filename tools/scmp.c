/* scmp: norms of the difference of two streams, field by field and frame by frame, particles matched by id. A field is compared with the second
 * stream as the reference. Holds the fields compared of one frame of each. SPDX-License-Identifier: GPL-3.0-or-later */
#include <stdio.h>
#include <string.h>

#include "measure/norms.h"
#include "mesh/grid.h"
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
	{.name = "field", .letter = 'f', .kind = PM_LIST, .unit = "NAME", .text = "compare these fields only, wherever they are", .offset = offsetof(struct config, fields)},
	{.name = "set", .kind = PM_LIST, .unit = "NAME", .text = "compare what is on these sets or meshes only", .offset = offsetof(struct config, on)},
	{.name = "tolerance", .letter = 't', .kind = PM_REAL, .high = 1e300, .text = "exit 1 if the norm of any field is larger (or not a number)", .offset = offsetof(struct config, tolerance)},
	{.name = "norm", .kind = PM_WORD, .choices = norms, .fallback = "relative_l2", .text = "the norm that --tolerance is held against", .offset = offsetof(struct config, norm)},
	{.name = "common", .kind = PM_FLAG, .text = "pass over fields that only one of the two has (an error without it)", .offset = offsetof(struct config, common)},
	{.name = "by-index", .kind = PM_FLAG, .text = "compare particles in the order in which they come, even where both have an id", .offset = offsetof(struct config, by_index)},
	{0}};

enum { most_pairs = 256 };

struct pairs { /* what is compared of two frames */
	struct pm_field *a[most_pairs], *b[most_pairs];
	int n;
};

static bool listed(const struct pm_list *list, const char *name)
{
	for (int i = 0; i < list->n; i++)
		if (!strcmp(list->item[i], name))
			return true;
	return !list->n;
}

/* Every field asked for is somewhere. */
static int asked(const struct config *c, const struct pm_frame *f)
{
	for (int i = 0; i < c->fields.n + c->on.n; i++) {
		const char *name = i < c->fields.n ? c->fields.item[i] : c->on.item[i - c->fields.n];
		bool there = i >= c->fields.n && (pm_frame_set(f, name) || pm_frame_mesh(f, name));
		for (size_t k = 0; k < f->nfields && i < c->fields.n; k++)
			there |= !strcmp(f->fields[k]->name, name);
		if (!there)
			return pm_fail(PM_DATA, "no %s '%s' in the first stream (sls lists what there is)", i < c->fields.n ? "field" : "set or mesh", name);
	}
	return 0;
}

/* The fields of one frame must be in the other. */
static int one_sided(const struct config *c, const struct pm_frame *f, const struct pm_frame *other, const char *which)
{
	for (size_t i = 0; i < f->nfields; i++) {
		const struct pm_field *p = f->fields[i];
		if (listed(&c->fields, p->name) && listed(&c->on, p->on) && !pm_frame_field(other, p->on, p->name))
			return pm_fail(PM_DATA, "'%s' on '%s' is in the %s stream only (--common passes over it, --field chooses)", p->name, p->on, which);
	}
	return 0;
}

static int same_shape(const struct pm_frame *f, const struct pm_field *a, const struct pm_frame *g, const struct pm_field *b)
{
	const struct pm_mesh *m = pm_frame_mesh(f, a->on), *k = pm_frame_mesh(g, b->on);
	if (a->components != b->components)
		return pm_fail(PM_DATA, "'%s' on '%s' has %d components in the first stream and %d in the second", a->name, a->on, a->components, b->components);
	for (int axis = 0; m && k && axis < f->dim; axis++) {
		if (m->cells[axis] != k->cells[axis])
			return pm_fail(PM_DATA, "the mesh '%s' has %zu cells along %c in the first stream and %zu in the second", a->on, m->cells[axis], "xyz"[axis], k->cells[axis]);
		if (fabs(m->lo[axis] - k->lo[axis]) > 1e-9 * m->h[axis] || fabs(m->h[axis] - k->h[axis]) > 1e-9 * m->h[axis])
			return pm_fail(PM_DATA, "the meshes '%s' do not lie at the same place along %c", a->on, "xyz"[axis]);
	}
	if (a->count != b->count)
		return pm_fail(PM_DATA, "'%s' has %zu values in the first stream and %zu in the second", a->on, a->count, b->count);
	return memcmp(a->half, b->half, sizeof a->half) ? pm_fail(PM_DATA, "'%s' on '%s' is staggered differently", a->name, a->on) : 0;
}

static bool both_id(const struct config *c, const struct pm_frame *f, const struct pm_frame *g, const char *on)
{
	const struct pm_field *a = pm_frame_field(f, on, "id"), *b = pm_frame_field(g, on, "id");
	return !c->by_index && a && b && pm_frame_set(f, on) && a->type == PM_I64 && b->type == PM_I64;
}

static int pair(const struct config *c, struct pm_frame *f, struct pm_frame *g, struct pairs *p)
{
	int status = 0;
	p->n = 0;
	if (f->dim != g->dim)
		return pm_fail(PM_DATA, "the first stream has %d dimensions, the second %d", f->dim, g->dim);
	if ((status = asked(c, f)))
		return status;
	if (!c->common && ((status = one_sided(c, f, g, "first")) || (status = one_sided(c, g, f, "second"))))
		return status;
	for (size_t i = 0; i < f->nfields && !status; i++) {
		struct pm_field *a = f->fields[i], *b = pm_frame_field(g, a->on, a->name);
		if (!b || !listed(&c->fields, a->name) || !listed(&c->on, a->on))
			continue;
		if (p->n == most_pairs)
			return pm_fail(PM_DATA, "more than %d fields (choose some with --field)", most_pairs);
		status = same_shape(f, a, g, b);
		p->a[p->n] = a, p->b[p->n++] = b;
		a->use |= PM_USE_READ, b->use |= PM_USE_READ;
		if (!status && both_id(c, f, g, a->on))
			pm_reads(f, a->on, "id"), pm_reads(g, a->on, "id");
	}
	if (!status && !p->n)
		return pm_fail(PM_DATA, "there is nothing to compare (sls lists the fields)");
	return status;
}

static double *weights(const struct pm_frame *f, const struct pm_mesh *m)
{
	struct pm_grid g = pm_grid_of(f, m);
	double *w = pm_alloc(pm_grid_size(&g), sizeof *w), *o = w;
	for (size_t k = 0; w && k < g.points[2]; k++)
		for (size_t j = 0; j < g.points[1]; j++)
			for (size_t i = 0; i < g.points[0]; i++)
				*o++ = pm_grid_weight(&g, i, j, k);
	return w;
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
	char at[64];
	size_t *match = NULL, *work = NULL;
	double *weight = NULL;
	const struct pm_mesh *m = pm_frame_mesh(f, a->on);
	bool id = both_id(c, f, g, a->on);
	int status = 0;
	if (m && !(weight = weights(f, m)))
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
	struct pairs p;
	int status = pair(c, f[0], f[1], &p);
	for (int i = 0; i < 2 && !status; i++)
		if (!(status = pm_read_payload(r[i], f[i], false, NULL)))
			status = pm_frame_ready(f[i]);
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
	struct pm_reader *r[2] = {NULL, NULL};
	int status = 0;
	if (!strcmp(s->args[0], "-") && !strcmp(s->args[1], "-"))
		return pm_fail(PM_USAGE, "standard input cannot be both streams (name a file)");
	for (int i = 0; i < 2 && !status; i++)
		status = (r[i] = pm_reader_open(strcmp(s->args[i], "-") ? s->args[i] : NULL)) ? 0 : -PM_DATA;
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
