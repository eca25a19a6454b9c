/* Planning again. A decision is plan's for the frame as it is now, but with the step and the mesh that the user gave, which what is in force has changed, and
 * with the length of the whole run as the time in which errors grow: towards the end of a run nothing becomes negligible because little time is left.
 * A new sentence begins between two steps from state alone: what the old words made is dropped, and the new ones are primed.
 * SPDX-License-Identifier: GPL-3.0-or-later */
#include <math.h>
#include <stdio.h>
#include <string.h>

#include "cycle/plan-again.h"
#include "planner/sentence-edit.h"
#include "stage/mesh-options.h"
#include "stream/run.h"

static struct pm_plan_choice choice_of(const struct pm_replan *r, const struct pm_frame *f, double accuracy)
{
	return (struct pm_plan_choice){.accuracy = accuracy, .time = isnan(r->end) ? NAN : f->time + (r->end - r->began)};
}

int pm_replan_begin(struct pm_replan *r, const struct pm_frame *f, FILE *warn)
{
	struct pm_plan p;
	r->first = r->decided = r->since = f->step;
	r->changes = 0;
	r->began = f->time;
	r->dt = f->dt;
	for (int d = 0; d < 3 && f->nmeshes; d++)
		r->cells[d] = f->meshes[0]->cells[d];
	const struct pm_plan_choice c = choice_of(r, f, r->accuracy);
	const int status = pm_plan_frame(f, &c, &p);
	if (status)
		return status;
	pm_replan_way_of(&r->way, &p, f);
	r->seen = pm_replan_look(f);
	memcpy(r->sentence, p.sentence, sizeof r->sentence);
	if (warn)
		pm_plan_warn(&p, "cycle", warn);
	return 0;
}

/* Few bodies: steps adapt to orbits already. */
static bool follows_orbits(const char *sentence)
{
	struct pm_edit e;
	char number[64];
	if (!pm_edit_read(&e, sentence))
		return false;
	const int dt = pm_edit_find(&e, "dt", 0);
	bool follows = dt >= 0 && pm_edit_value(&e, dt, (struct pm_edit_option){"oscillation", 0}, number);
	for (int i = pm_edit_find(&e, "push", 0); i >= 0; i = pm_edit_find(&e, "push", i + 1))
		follows = follows || pm_edit_says(&e, i, "ias15");
	return follows;
}

bool pm_replan_due(const struct pm_replan *r, const struct pm_frame *f)
{
	if (r->every < 1 || f->substep || f->step == r->decided)
		return false;
	return ((f->step - r->first) % r->every == 0 || pm_replan_crossed(r, f)) && !follows_orbits(r->sentence);
}

/* The frame as the user would have given it: state, step and mesh. A mesh that follows its particles stays as it is. NULL: failure. */
static struct pm_frame *as_given(const struct pm_replan *r, const struct pm_frame *f)
{
	struct pm_frame *g = pm_plan_bare(f);
	struct pm_cells cells = {.n = f->dim};
	if (!g)
		return NULL;
	memcpy(cells.cells, r->cells, sizeof cells.cells);
	g->dt = r->dt;
	const int status = g->nmeshes && !r->way.grow ? pm_mesh_take_cells(g, g->meshes[0], &cells) : 0;
	return status < 0 || pm_frame_settle(g) ? pm_frame_free(g) : g;
}

/* The words of the plan p for the frame f itself, whose step and mesh are those in force. */
static int words(struct pm_replan *r, const struct pm_frame *f, const struct pm_frame *g, struct pm_plan *p)
{
	struct pm_method *m = &p->method;
	const double length = fabs(m->dt), left = isnan(r->end) ? 0 : (r->end - f->time) * (f->dt < 0 ? -1 : 1);
	if (length == fabs(f->dt))
		m->dt = NAN;
	else
		m->dt = copysign(left > length ? left / ceil(left / length - 1e-9) : length, f->dt); /* a whole number of steps to the end */
	if (f->nmeshes && !memcmp(m->cells, f->meshes[0]->cells, sizeof m->cells))
		memset(m->cells, 0, sizeof m->cells);
	return pm_plan_compose(g, p);
}

static int decide(struct pm_replan *r, const struct pm_frame *f, const struct pm_frame *g, char why[PM_REPLAN_WHY])
{
	struct pm_plan a, b;
	struct pm_plan_choice c = choice_of(r, g, r->accuracy);
	c.untested = true;
	struct pm_replan_way now = r->way, to;
	int status = pm_plan_frame(g, &c, &a);
	if (now.grow && g->nmeshes)
		memcpy(now.cells, g->meshes[0]->cells, sizeof now.cells);
	const bool wary = !status && pm_replan_needs_wary(&now, fabs(f->dt), &a, g);
	c.accuracy = r->accuracy / 3;
	status = wary ? pm_plan_frame(g, &c, &b) : status;
	if (status)
		return status;
	r->patience.weak = pm_replan_weak(&r->seen, f);
	const bool new = pm_replan_keep(&now, fabs(f->dt), &a, wary ? &b : NULL, g, &r->patience, why);
	r->decided = f->step;
	r->seen = pm_replan_remember(&r->seen, f);
	if (!new)
		return 0;
	pm_replan_way_of(&to, &a, g);
	status = words(r, f, g, &a);
	r->way = to;
	r->since = f->step;
	r->changes++;
	memcpy(r->sentence, a.sentence, sizeof r->sentence);
	return status ? status : 1;
}

int pm_replan_decide(struct pm_replan *r, const struct pm_frame *f, char why[PM_REPLAN_WHY])
{
	struct pm_frame *g = as_given(r, f);
	const int status = g ? decide(r, f, g, why) : pm_failed();
	pm_frame_free(g);
	return status;
}
