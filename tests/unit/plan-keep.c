/* Hysteresis of cycle --plan --again: when a step, and the interval of an effect, change. SPDX-License-Identifier: GPL-3.0-or-later */
#include <string.h>

#include "check.h"
#include "cycle/plan-again.h"

static const struct pm_effect effect = {.name = "remeshing", .word = "remesh"};

/* A plan of pairs and leapfrog with a step, and an effect put in every so many steps (-1: left out). */
static struct pm_plan plan(double dt, int every)
{
	struct pm_plan p = {.method = {.pairs = true, .kernel = "m4prime", .order = "2", .scheme = "leapfrog", .dt = dt}, .neffects = 1,
		.law = pm_law_find("gravity")};
	p.effect[0].effect = &effect;
	p.effect[0].decision = (struct pm_decision){.answer = every < 0 ? PM_LEFT_OUT : PM_PUT_IN, .every = every < 0 ? 0 : every};
	return p;
}

static struct pm_replan_way in_force(const struct pm_frame *f, int every)
{
	struct pm_replan_way w;
	const struct pm_plan p = plan(1, every);
	pm_replan_way_of(&w, &p, f);
	return w;
}

/* The step after a decision: a of the plan for the accuracy, b of that for a third of it, 1 in force. */
static double step(const struct pm_frame *f, double a, double b, struct pm_replan_patience *patience)
{
	const struct pm_replan_way now = in_force(f, -1);
	struct pm_plan pa = plan(a, -1), pb = plan(b, -1);
	char why[PM_REPLAN_WHY];
	const bool changed = pm_replan_keep(&now, 1, &pa, &pb, f, patience, why);
	check(changed == (pa.method.dt != 1) && changed == !!strstr(why, "dt "), "a change of the step, and no other, is said: '%s'", why);
	return pa.method.dt;
}

static void steps(const struct pm_frame *f)
{
	struct pm_replan_patience p = {0};
	check_near(step(f, 0.95, 0.4, &p), 1, 0, "a step within a tenth of the one planned stays");
	check_near(step(f, 0.85, 0.4, &p), 1 / 1.5, 0, "one that is too long gets shorter by 1.5 at once");
	check_near(step(f, 0.3, 0.2, &p), 0.3, 0, "or as short as was asked for");
	check_near(step(f, 9, 1.4, &p), 1, 0, "it gets no longer where a third of the accuracy allows less than 1.5");
	p = (struct pm_replan_patience){0};
	check(step(f, 9, 4, &p) == 1 && step(f, 9, 3, &p) == 1, "twice a longer step would do, and is not taken");
	check_near(step(f, 9, 5, &p), 3, 0, "the third time the shortest of the three is");
	p = (struct pm_replan_patience){0};
	check(step(f, 9, 4, &p) == 1 && step(f, 1, 1, &p) == 1 && step(f, 9, 4, &p) == 1 && step(f, 9, 4, &p) == 1, "what is not in a row counts anew");
}

/* The interval after a decision: a and b as above; -1: out. */
static int interval(const struct pm_frame *f, int now, int a, int b, struct pm_replan_patience *patience)
{
	const struct pm_replan_way w = in_force(f, now);
	struct pm_plan pa = plan(1, a), pb = plan(1, b);
	char why[PM_REPLAN_WHY];
	pm_replan_keep(&w, 1, &pa, &pb, f, patience, why);
	return pa.effect[0].decision.answer == PM_PUT_IN ? pa.effect[0].decision.every : -1;
}

static void intervals(const struct pm_frame *f)
{
	struct pm_replan_patience p = {0};
	check(interval(f, -1, 0, 0, &p) == 0, "an effect that is needed comes in at once");
	check(interval(f, 9, 8, 4, &p) == 6 && interval(f, 9, 2, 1, &p) == 2, "an interval gets shorter by 1.5, or as short as was asked for");
	check(interval(f, 4, 9, 5, &p) == 4, "it gets no longer where a third of the accuracy allows less than 1.5");
	p = (struct pm_replan_patience){0};
	check(interval(f, 4, 9, 6, &p) == 4 && interval(f, 4, 9, 6, &p) == 4 && interval(f, 4, 9, 6, &p) == 6, "it gets longer at the third decision");
	p = (struct pm_replan_patience){0};
	check(interval(f, 0, -1, -1, &p) == 0 && interval(f, 0, -1, -1, &p) == 0 && interval(f, 0, -1, -1, &p) == -1, "an effect goes out at the third");
	p = (struct pm_replan_patience){0};
	for (int i = 0; i < 5; i++)
		check(interval(f, 0, -1, 0, &p) == 0, "and stays while a third of the accuracy needs it");
}

int main(void)
{
	struct pm_frame *f = pm_frame_new(3);
	if (check(f, "a frame")) {
		f->dt = 1;
		steps(f);
		intervals(f);
	}
	pm_frame_free(f);
	return check_done();
}
