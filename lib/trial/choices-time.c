/* The choices that a sentence has made, and the next ones: each changes one of them in the text of the sentence, or in the frame that it runs on; here
 * those of time.
 * SPDX-License-Identifier: GPL-3.0-or-later */
#include <string.h>

#include "trial/choices.h"

static const struct pm_edit_option dt = {"dt", 0}, tolerance = {"tolerance", 0}, every = {"every", 0};

/* Rules of dt: each is halved, or what makes half the step of it. */
static int shorter_rules(struct pm_edit *e, int w, char from[48], char to[48])
{
	static const char *const rules[] = {"oscillation", "courant", "lcfl", "plasma", "max", "acceleration", "min", NULL};
	char value[64], half[64];
	int n = 0;
	for (const char *const *r = rules; *r; r++) {
		const struct pm_edit_option o = {*r, 0};
		if (!pm_edit_value(e, w, o, value))
			continue;
		snprintf(half, sizeof half, "%.12g", strtod(value, NULL) * (strcmp(*r, "acceleration") ? 0.5 : 0.25));
		if (!pm_edit_set(e, w, o, half))
			return 0;
		if (!n++) {
			snprintf(from, 48, "dt --%s %.24s", *r, value);
			snprintf(to, 48, "dt --%s %.24s", *r, half);
		}
	}
	return n > 0;
}

/* What is done every k steps is done every 2 k half steps. */
static bool keep_intervals(struct pm_edit *e)
{
	bool fits = true;
	char value[64];
	for (int w = -1; (w = pm_edit_find(e, "remesh", w + 1)) >= 0 && fits;) {
		const long long k = pm_edit_value(e, w, every, value) ? strtoll(value, NULL, 10) : 1;
		snprintf(value, sizeof value, "%lld", 2 * k);
		fits = pm_edit_set(e, w, every, value);
	}
	return fits;
}

static int half_step(const struct pm_plan *p, struct pm_edit *e, struct pm_frame **f, char from[48], char to[48])
{
	char value[64];
	int w = pm_edit_find(e, "dt", 0);
	(void)p;
	if (w >= 0 && pm_edit_chooser(e, value) < 0)
		return shorter_rules(e, w, from, to) && keep_intervals(e);
	if ((w = pm_edit_chooser(e, value)) >= 0) { /* its step goes as the 7th root of its tolerance */
		snprintf(from, 48, "tolerance %.32s", value);
		snprintf(value, sizeof value, "%.3g", strtod(value, NULL) / 128);
		snprintf(to, 48, "%.32s", value);
		return pm_edit_set(e, w, tolerance, value);
	}
	const double step = pm_edit_step(e, *f);
	const int at = pm_edit_setter(e, value);
	w = at >= 0 ? at : pm_edit_find(e, "push", 0);
	if (w < 0 || step == 0 || !strcmp(e->word[w], "push drift") || pm_edit_find(e, "walk", 0) >= 0)
		return 0; /* straight lines have no error of the step; half steps of a random walk draw other numbers */
	snprintf(value, sizeof value, "%.12g", step / 2);
	snprintf(from, 48, "dt = %.3g", step);
	snprintf(to, 48, "dt = %.3g", step / 2);
	return pm_edit_set(e, w, dt, value) && keep_intervals(e);
}

/* Leapfrog of two pushes becomes a scheme of one; a scheme of one another. */
static int other_scheme(const struct pm_plan *p, struct pm_edit *e, struct pm_frame **f, char from[48], char to[48])
{
	static const char *const next[][2] = {{"yoshida4", "blanes-moan4"}, {"blanes-moan4", "blanes-moan6"}, {"yoshida6", "blanes-moan6"}, {"blanes-moan6",
		"blanes-moan4"}, {"lsrk3", "rk4"}, {"rk4", "lsrk3"}, {"rk2", "rk4"}, {"midpoint", "rk4"}, {"ab2", "ab3"}, {"ab3", "rk4"}, {"euler", "rk4"}};
	const int first = pm_edit_find(e, "push", 0), last = first < 0 ? -1 : pm_edit_find(e, "push", first + 1);
	char value[64];
	(void)p, (void)f;
	for (size_t i = 0; i < sizeof next / sizeof next[0] && first >= 0; i++) {
		char *name = strstr(e->word[first], next[i][0]), rest[PM_EDIT_WORD];
		if (!name || !pm_edit_says(e, first, next[i][0]))
			continue;
		snprintf(from, 48, "%s", next[i][0]);
		snprintf(to, 48, "%s", next[i][1]);
		snprintf(rest, sizeof rest, "%s", name + strlen(next[i][0]));
		snprintf(name, PM_EDIT_WORD - (size_t)(name - e->word[first]), "%s%s", next[i][1], rest);
		return 1;
	}
	if (last < 0 || !pm_edit_says(e, first, "kick/2") || !pm_edit_says(e, first, "drift") || !pm_edit_says(e, last, "kick/2") ||
		pm_edit_find(e, "push", last + 1) >= 0)
		return 0;
	const bool set = pm_edit_value(e, first, dt, value);
	snprintf(e->word[last], PM_EDIT_WORD, "push %s%s%sblanes-moan4", set ? "--dt " : "", set ? value : "", set ? " " : "");
	pm_edit_remove(e, first);
	if (pm_edit_find(e, "dt", 0) == 0) { /* a step by the force stands behind the force, before the only push */
		char words[PM_EDIT_WORD];
		snprintf(words, sizeof words, "%s", e->word[0]);
		memmove(e->word[0], e->word[1], (size_t)(last - 2) * PM_EDIT_WORD);
		snprintf(e->word[last - 2], PM_EDIT_WORD, "%s", words);
	}
	snprintf(from, 48, "leapfrog");
	snprintf(to, 48, "blanes-moan4");
	return 1;
}

const struct pm_choice pm_choices[] = {
	{.name = "step", .kind = PM_TRIAL_TIME, .refines = true, .alter = half_step},
	{.name = "mesh", .kind = PM_TRIAL_SPACE, .refines = true, .alter = pm_choice_finer},
	{.name = "mesh", .kind = PM_TRIAL_SPACE, .refines = true, .alter = pm_choice_coarser},
	{.name = "scheme", .kind = PM_TRIAL_TIME, .alter = other_scheme},
	{.name = "kernel", .kind = PM_TRIAL_SPACE, .alter = pm_choice_kernel},
	{.name = "gradient", .kind = PM_TRIAL_SPACE, .alter = pm_choice_gradient},
	{.name = "solver", .kind = PM_TRIAL_SPACE, .alter = pm_choice_solver},
	{.name = "pairs", .kind = PM_TRIAL_SPACE, .alter = pm_choice_pairs},
	{.name = "particles", .kind = PM_TRIAL_SAMPLING, .alter = pm_choice_particles},
	{.name = "last bit", .kind = PM_TRIAL_ROUNDING, .alter = pm_choice_last_bit},
	{.name = NULL},
};
