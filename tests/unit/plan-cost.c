/* The arithmetic of the cost of a plan: periods of what is not done in every step, statistics of timed blocks, durations as text.
 * SPDX-License-Identifier: GPL-3.0-or-later */
#include <string.h>

#include "check.h"
#include "planner/plan.h"

static struct pm_plan_effect every(int steps, enum pm_answer answer)
{
	return (struct pm_plan_effect){.decision = {.answer = answer, .every = steps}};
}

static void periods(void)
{
	struct pm_plan p = {.neffects = 4, .effect = {every(4, PM_PUT_IN), every(0, PM_PUT_IN), every(6, PM_PUT_IN), every(5, PM_LEFT_OUT)}};
	check(pm_plan_period(&p) == 12, "every 4 and every 6 steps: both have been done after 12; what is left out does not count");
	p.neffects = 2;
	check(pm_plan_period(&p) == 4, "one action: its own interval");
	p.effect[0].lacking = true;
	check(pm_plan_period(&p) == 1, "a word that does not exist is never done");
}

static void statistics(void)
{
	struct pm_plan_timing t = {.blocks = 5, .wall = {1, 9, 2, 3, 1.5}, .word = {{5}, {1}, {2}, {100}, {3}}};
	struct pm_plan p = {.cost = {.step = 1.5, .low = 1, .high = 1}};
	double noise;
	check(pm_plan_word_seconds(&t, 0) == 3, "the seconds of a word are the median of the blocks");
	check_near(pm_plan_dearer(&p, &t, &noise), 0.5, 1e-14, "another sentence costs the difference of the medians");
	check_near(noise, (6.6 - 1) / 2, 1e-14, "the noise is half the range from the quickest block to nine tenths of them: 3 + 0.6 (9 - 3)");
	t.blocks = 1;
	pm_plan_dearer(&p, &t, &noise);
	check_near(noise, (1.5 - 1 / 1.5) / 2, 1e-14, "one block: a factor 1.5 both ways");
}

static void words(void)
{
	char text[32];
	check(!strcmp(pm_plan_duration(3e-7, text), "< 1 us") && !strcmp(pm_plan_duration(0, text), "< 1 us"), "nothing costs 0 us");
	check(!strcmp(pm_plan_duration(0.0123, text), "12.3 ms") && !strcmp(pm_plan_duration(900, text), "15 min"), "durations have their unit");
}

int main(void)
{
	periods();
	statistics();
	words();
	return check_done();
}
