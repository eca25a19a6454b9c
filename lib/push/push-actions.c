/* Parses the arguments of push: kick, drift/2, boris/2, clear or the name of a scheme; refuses orders that do not make a step.
 * SPDX-License-Identifier: GPL-3.0-or-later */
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "base/nearest-name.h"
#include "push/push-set.h"

static const struct pm_step *find(const char *name, size_t length)
{
	for (int i = 0; pm_steps[i]; i++)
		if (strlen(pm_step_names[i]) == length && !strncmp(pm_step_names[i], name, length))
			return pm_steps[i];
	return NULL;
}

static int unknown(const char *word)
{
	const char *near = pm_nearest(word, pm_step_names);
	char schemes[256] = "";
	for (int i = 0; pm_steps[i]; i++)
		if (pm_steps[i]->kind == PM_SCHEME)
			snprintf(schemes + strlen(schemes), sizeof schemes - strlen(schemes), "%s%s", *schemes ? ", " : "", pm_step_names[i]);
	return pm_fail(PM_USAGE, "no action '%s'%s%s%s (kick[/N], drift[/N], boris/2, boris-tan/2, relativistic/2, vay/2, higuera-cary/2, "
		"landau-lifshitz/2, clear, or one "
		"of %s)", word,
		near ? ", did you mean '" : "", near ? near : "", near ? "'?" : "", schemes);
}

/* Can the action, 1/n of a step, be combined with those before it? */
static int allowed(const struct pm_push *p, const struct pm_step *step, const char *word, double n)
{
	if (step->kind == PM_KICK && p->drift > 0)
		return pm_fail(PM_USAGE, "'%s' after drift has no force at the new positions (push drift | force | push kick)", word);
	if (step->magnetic && n != 2)
		return pm_fail(PM_USAGE, "'%s' (%s is written %s/2: push %s/2 drift | force | push %s/2)", word, step->name, step->name, step->name,
			step->name);
	if (p->magnetic || (step->magnetic && p->actions.actions))
		if (step->kind != PM_DRIFT)
			return pm_fail(PM_USAGE, "'%s': no kick stands beside a magnetic one (push boris/2 drift | force | push boris/2)", word);
	if (p->scheme || (step->kind == PM_SCHEME && p->actions.actions))
		return pm_fail(PM_USAGE, "'%s': a whole scheme stands alone", word);
	if (p->actions.actions == PM_ADVANCE_ACTIONS)
		return pm_fail(PM_USAGE, "more than %d actions", PM_ADVANCE_ACTIONS);
	return 0;
}

int pm_push_action(struct pm_push *p, const char *word)
{
	const char *slash = strchr(word, '/');
	const struct pm_step *step = find(word, slash ? (size_t)(slash - word) : strlen(word));
	char *end = "";
	double n = slash ? strtod(slash + 1, &end) : 1;
	if (p->clear)
		return pm_fail(PM_USAGE, "'%s' after clear (put clear last: it takes the rates away)", word);
	if ((p->clear = !strcmp(word, "clear")))
		return 0;
	if (!step)
		return unknown(word);
	if (*end || (slash && !slash[1]) || !(n >= 1 && n <= 1e9) || (slash && step->kind == PM_SCHEME))
		return pm_fail(PM_USAGE, "'%s' (a part of a step is written kick/N or drift/N, N from 1 to 1e9; schemes have no parts)", word);
	int status = allowed(p, step, word, n);
	if (status)
		return status;
	p->part[p->actions.actions] = 1 / n;
	p->actions.action[p->actions.actions++].step = step;
	p->kick += step->kind == PM_KICK ? 1 / n : 0;
	p->drift += step->kind == PM_DRIFT ? 1 / n : 0;
	p->scheme = step->kind == PM_SCHEME ? step : NULL;
	p->magnetic = step->magnetic ? step : p->magnetic;
	p->moves = p->moves || step->kind != PM_KICK;
	return 0;
}
