/* A set in another order (lib/stream/reorder.h): its values, what others hold, and what is left to be made. SPDX-License-Identifier: GPL-3.0-or-later */
#include <string.h>

#include "check.h"
#include "stream/column.h"
#include "stream/declare.h"
#include "stream/later.h"
#include "stream/limits.h"
#include "stream/reorder.h"
#include "stream/run.h"

enum { N = 20011 };

static size_t order[N];

static void need(bool good)
{
	if (!good) {
		check(false, "%s", pm_message());
		exit(1);
	}
}

/* Twice the values it is made of, plus those of a field that is held. */
struct sum {
	struct pm_later later;
	struct pm_field *held;
};

static void let_go(struct pm_later *later) { pm_held_free(((struct sum *)later)->held); }

static int make(const struct pm_later *later, double *to)
{
	const struct sum *s = (const struct sum *)later;
	need(!pm_held_bring(s->held));
	for (size_t i = 0; i < N; i++)
		to[i] = 2 * pm_in(later->from, 0)[i] + pm_in(s->held, 0)[i];
	return 0;
}

static double largest(const struct pm_later *later, const double *values) { return later->from ? values[0] * 0 + 7 : 0; }

static struct pm_later *reorder(const struct pm_later *later, struct pm_reorder *r)
{
	struct sum *s = malloc(sizeof *s);
	need(s);
	*s = *(const struct sum *)later;
	s->later.from = NULL, s->held = pm_held_reorder(s->held, r);
	need(s->held);
	return &s->later;
}

static struct pm_field *field(struct pm_frame *f, const char *name, int type, double value)
{
	struct pm_field *p = pm_makes(f, "a", name, 1, PM_STATE);
	need(p);
	p->type = type;
	need(!pm_frame_ready(f));
	for (size_t i = 0; i < N; i++)
		if (type == PM_I64)
			pm_out_i64(p, 0)[i] = (int64_t)i;
		else
			pm_out(p, 0)[i] = value * (1 + (double)i);
	need(!pm_frame_settle(f));
	return p;
}

static struct pm_field *left(struct pm_frame *f, const char *name, const struct pm_field *from, const struct pm_field *held, bool stays)
{
	struct pm_field *p = pm_makes(f, "a", name, 1, PM_CHANGE);
	struct sum *s = calloc(1, sizeof *s);
	need(p && s);
	*s = (struct sum){.later = {.make = make, .free = let_go, .oscillation = largest, .reorder = stays ? reorder : NULL}, .held = pm_field_held(held)};
	p->use |= PM_USE_FILL;
	need(s->held && !pm_frame_ready(f) && !pm_field_later(p, &s->later, from) && !pm_frame_settle(f));
	return p;
}

/* value (1 + place of old): of how many values is that not so? */
static int wrong(const struct pm_field *p, double value)
{
	int bad = 0;
	for (size_t i = 0; i < N; i++)
		bad += pm_in(p, 0)[i] != value * (1 + (double)order[i]);
	return bad;
}

int main(void)
{
	struct pm_frame *f = pm_frame_new(1);
	need(f && pm_frame_set_new(f, "a", N));
	for (size_t i = 0; i < N; i++)
		order[i] = i * 7919 % N;
	struct pm_field *id = field(f, "id", PM_I64, 0), *x = field(f, "x", PM_F64, 3), *y = field(f, "y", PM_F64, 5);
	struct pm_field *rate = left(f, "rate", x, y, true), *both = left(f, "both", x, rate, true), *made = left(f, "made", x, y, false);
	struct pm_field *old = pm_field_held(x), *all[] = {id, both, rate, made, y, x};
	struct pm_reorder r = {.order = order};
	x->within = 4e4, y->within = 0;
	for (int i = 0; i < 6; i++) {
		all[i]->use = PM_USE_CHANGE | PM_USE_WAITS;
		need(!pm_field_reorder(all[i], &r));
	}
	pm_reorder_free(&r);
	int bad = 0;
	for (size_t i = 0; i < N; i++)
		bad += pm_in_i64(id, 0)[i] != (int64_t)order[i];
	check(bad == 0 && wrong(x, 3) == 0 && wrong(y, 5) == 0, "integers and reals are in the new order");
	check(x->within == 4e4, "the bound of the values is kept");
	check(pm_in(old, 0)[1] == 6, "whoever held the values has them as they were");
	check(pm_field_later_of(rate) && pm_field_later_of(both) && !pm_field_later_of(made), "what can stay left to be made does, in any order of the fields");
	const struct sum *s = (const struct sum *)pm_field_later_of(both), *t = (const struct sum *)pm_field_later_of(rate);
	check(s && t && s->held->buffer == rate->buffer && t->held->buffer == y->buffer && s->later.from->buffer == x->buffer,
		"what several have is put into order once, and they have it together");
	check(wrong(both, 17) == 0 && wrong(rate, 11) == 0 && wrong(made, 11) == 0, "made of the values in the new order");
	check(pm_limits_of(made).oscillation == 7 && pm_limits_of(rate).oscillation == 7, "the limit that values tell is kept");
	pm_held_free(old);
	pm_frame_free(f);
	return check_done();
}
