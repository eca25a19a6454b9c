/* Two streams compared frame by frame and field by field: norms of the difference as a table, particles matched by id. Holds one frame of each.
 * Cost: one pass over the data, and a sort of the ids; over ranks as match-ranks.c says. SPDX-License-Identifier: GPL-3.0-or-later */
#include <string.h>

#include "measure/compare-streams.h"
#include "stream/joint-frame.h"
#include "stream/parts-file.h"
#include "world/world.h"

const char *const pm_norm_names[] = {"l1", "l2", "max", "relative_l2", "relative_max", NULL};

/* Where the difference is largest, in words. */
static void place(const struct pm_frame *f, const struct pm_field *a, bool id, const struct pm_norms *d, char out[64])
{
	size_t points[3];
	const struct pm_mesh *m = pm_frame_mesh(f, a->on);
	if (m) {
		pm_mesh_points(f, m, points);
		snprintf(out, 64, "%zu,%zu,%zu", d->worst % points[0], d->worst / points[0] % points[1], d->worst / points[0] / points[1]);
	} else if (id && a->count)
		snprintf(out, 64, "%lld", (long long)d->worst_id);
	else
		snprintf(out, 64, "%zu", d->worst);
}

static void words(struct pm_comparison *c)
{
	if (!c->begun)
		fputs("frame\ton\tfield\tn\tl1\tl2\tmax\trelative_l2\trelative_max\tworst\n", c->out);
	c->begun = true;
}

static void row(struct pm_comparison *c, const char *on, const char *name, size_t n, const struct pm_norms *d, const char *at)
{
	const double all[] = {d->l1, d->l2, d->max, d->relative_l2, d->relative_max};
	words(c);
	fprintf(c->out, "%llu\t%s\t%s\t%zu", (unsigned long long)c->frame, on, name, n);
	for (int i = 0; pm_norm_names[i]; i++) {
		fprintf(c->out, "\t%.10g", all[i]);
		if (i == c->norm && !(all[i] <= c->tolerance) && !isnan(c->tolerance) && !c->over) {
			pm_fail(PM_DATA, "frame %llu: '%s' on '%s': %s is %.4g, above %g", (unsigned long long)c->frame, name, on, pm_norm_names[i], all[i],
				c->tolerance);
			c->over = true;
		}
	}
	fprintf(c->out, "\t%s\n", at);
}

/* Pairs first .. first + n - 1, which are on the same set or mesh. */
static int rows(struct pm_comparison *c, struct pm_frame *const f[2], const struct pm_field_pairs *p, int first, int n)
{
	char at[64];
	const bool id = pm_field_pairs_by_id(&c->choice, f[0], f[1], p->a[first]->on);
	struct pm_frame *joint = pm_joint_frame(f[0], f[1], p->a + first, p->b + first, n, id);
	const int status = joint ? c->joint(c->stage, joint) : pm_failed();
	pm_frame_free(joint);
	for (int i = 0; i < n && !status; i++) {
		const struct pm_field *a = p->a[first + i];
		place(f[0], a, id, &c->norms[i], at);
		row(c, a->on, a->name, a->count, &c->norms[i], at);
	}
	return status;
}

/* What ranks have read is finite. */
static int check(struct pm_comparison *c, struct pm_frame *f)
{
	struct pm_frame *those = pm_joint_check(f);
	const int status = those ? c->joint(c->stage, those) : pm_failed();
	pm_frame_free(those);
	for (size_t i = 0; i < f->nfields && !status; i++)
		f->fields[i]->finite |= f->fields[i]->use != 0;
	return status;
}

/* failed: which of the two could not be read, where one could not. */
static int read_both(struct pm_comparison *c, struct pm_reader *const r[2], struct pm_frame *const f[2], int *failed)
{
	int status = 0;
	for (int i = 0; i < 2 && !status; i++) {
		*failed = i;
		status = pm_world_size() == 1 ? pm_read_declared(r[i], f[i]) : pm_read_by_ranks(r[i], f[i]);
		status = status || pm_world_size() == 1 ? status : check(c, f[i]);
	}
	return status;
}

/* Puts the file and frame in front of the message of the failure. */
static int at_frame(const struct pm_comparison *c, const char *stream, int status)
{
	char why[1024];
	snprintf(why, sizeof why, "%s", pm_message());
	return pm_fail(-status, "frame %llu%s%s: %s", (unsigned long long)c->frame, *stream ? " of " : "", stream, why);
}

static int compare(struct pm_comparison *c, struct pm_reader *const r[2], struct pm_frame *f[2], const char *const name[2])
{
	struct pm_field_pairs p;
	int status = pm_field_pairs_of(&c->choice, f[0], f[1], &p), failed = 0;
	if (!status && (status = read_both(c, r, f, &failed)))
		return at_frame(c, name[failed], status);
	if (!status && !c->choice.fields[0] && !c->choice.on[0]) {
		double dt = fabs(f[0]->time - f[1]->time), relative = dt == 0 ? 0 : dt / fabs(f[1]->time);
		struct pm_norms d = {dt, dt, dt, relative, relative, 0, 0};
		row(c, "-", "time", 1, &d, "-");
	}
	for (int first = 0, n = 0; first < p.n && !status; first += n) {
		for (n = 1; first + n < p.n && !strcmp(p.a[first + n]->on, p.a[first]->on);)
			n++;
		status = rows(c, f, &p, first, n);
	}
	return status ? at_frame(c, "", status) : 0;
}

/* The next frame, across the end markers of concatenated streams; 0 at the end of the input. */
static int next(struct pm_reader *r, struct pm_frame **f)
{
	int got;
	do
		got = pm_read_header(r, f);
	while (got == PM_GOT_END);
	return got;
}

int pm_compare_streams(struct pm_comparison *c, struct pm_reader *const r[2], const char *const name[2])
{
	int status = 0, got[2] = {1, 1};
	while (!status && got[0] && got[1]) {
		struct pm_frame *f[2] = {NULL, NULL};
		c->frame++;
		for (int i = 0; i < 2 && !status; i++)
			if ((got[i] = next(r[i], &f[i])) < 0)
				status = at_frame(c, name[i], got[i]);
		if (!status && got[0] != got[1])
			status = pm_fail(PM_DATA, "'%s' ends after %llu frames, '%s' has more", name[got[0] != 0], (unsigned long long)c->frame - 1,
				name[got[0] == 0]);
		if (!status && got[0])
			status = compare(c, r, f, name);
		pm_frame_free(f[0]), pm_frame_free(f[1]);
	}
	if (!status)
		words(c);
	return status ? status : c->over ? -PM_DATA : 0;
}
