/* A plan as text: one stage per line with its reason, then the effects left out and those lacking; and as JSON.
 * SPDX-License-Identifier: GPL-3.0-or-later */
#include <string.h>

#include "planner/plan.h"
#include "stage/apply.h"
#include "stream/header.h"

/* The name in ordinary spelling. */
static const char *label(const struct pm_effect *e, char text[64])
{
	snprintf(text, 64, "%s", e->name);
	for (char *c = text; *c; c++)
		*c = *c == '-' ? ' ' : *c;
	return text;
}

/* The line for a needed effect without a word, or with one that plan does not place. */
static void lacking(FILE *out, const struct pm_plan_effect *e)
{
	if (e->lacking && pm_tool_find(e->effect->word))
		fprintf(out, ", the word %s does it, which plan does not place: the result lacks it", e->effect->word);
	else if (e->lacking)
		fputs(", no word for it yet: the result lacks it", out);
}

static const char *answer(const struct pm_plan_effect *e)
{
	return e->lacking ? "needed" : e->decision.answer != PM_PUT_IN ? "off" : e->effect->numerical || e->decision.error ? "error" : "on";
}

/* Is the result wrong by more than the accuracy for it? */
static bool warns(const struct pm_plan_effect *e) { return !strcmp(answer(e), "needed") || !strcmp(answer(e), "error"); }

void pm_plan_warn(const struct pm_plan *p, const char *tool, FILE *out)
{
	char name[64];
	if (*p->refused || *p->unproved)
		fprintf(out, "%s: %s\n", tool, *p->refused ? p->refused : p->unproved);
	if (*p->method.warning)
		fprintf(out, "%s: not promised: %s\n", tool, p->method.warning);
	for (int i = 0; i < p->neffects; i++)
		if (warns(&p->effect[i])) {
			fprintf(out, "%s: %s: %s", tool, label(p->effect[i].effect, name), p->effect[i].decision.text);
			lacking(out, &p->effect[i]);
			fputc('\n', out);
		}
}

static void stages(FILE *out, const struct pm_plan *p, bool cost)
{
	size_t width = 0;
	char text[32];
	for (int i = 0; i < p->nstages; i++) {
		width = strlen(p->stage[i].words) > width ? strlen(p->stage[i].words) : width;
	}
	for (int i = 0; i < p->nstages; i++) {
		pm_plan_duration(p->stage[i].seconds, text);
		fprintf(out, "%-*s %c  # ", (int)width, p->stage[i].words, i + 1 < p->nstages ? '|' : ' ');
		fprintf(out, cost ? "%8s  %s\n" : "%.0s%s\n", text, p->stage[i].reason);
	}
	if (cost)
		fprintf(out, "%-*s    # %8s  a step\n", (int)width, "", pm_plan_duration(p->cost.step, text));
}

static void effects(FILE *out, const struct pm_plan *p, bool cost, const char *which)
{
	char name[64], text[32];
	for (int i = 0; i < p->neffects; i++) {
		const struct pm_plan_effect *e = &p->effect[i];
		if (strcmp(answer(e), which))
			continue;
		fprintf(out, "# %-18s %-6s %s", label(e->effect, name), answer(e), e->decision.text);
		lacking(out, e);
		if (cost && !isnan(e->saves))
			fprintf(out, "; saves %s%s a step", e->saves > e->noise ? "" : "less than ", pm_plan_duration(fmax(e->saves, e->noise), text));
		fputc('\n', out);
	}
}

void pm_plan_print(FILE *out, const struct pm_plan *p, bool cost)
{
	if (*p->refused || *p->unproved)
		fprintf(out, "# %s\n", *p->refused ? p->refused : p->unproved);
	stages(out, p, cost);
	if (*p->method.warning)
		fprintf(out, "#\n# not promised: %s\n", p->method.warning);
	fprintf(out, "#\n# effects, for relative changes above %g within T = %g\n", p->scales.accuracy, p->scales.time);
	effects(out, p, cost, "needed");
	effects(out, p, cost, "error");
	effects(out, p, cost, "on");
	effects(out, p, cost, "off");
	if (cost)
		pm_plan_print_cost(out, p);
}

void pm_plan_print_json(FILE *out, const struct pm_plan *p, bool cost)
{
	json_t *all = json_pack("{s:s,s:o,s:o,s:[],s:[],s:[]}", "sentence", p->sentence, "accuracy", pm_json_number(p->scales.accuracy),
		"time", pm_json_number(p->scales.time), "stages", "effects", "warnings");
	if (*p->refused)
		json_object_set_new(all, "refused", json_string(p->refused));
	if (*p->unproved)
		json_object_set_new(all, "unproved", json_string(p->unproved));
	if (*p->method.warning)
		json_object_set_new(all, "not_promised", json_string(p->method.warning));
	for (int i = 0; i < p->nstages; i++) {
		json_t *s = json_pack("{s:s,s:s}", "words", p->stage[i].words, "reason", p->stage[i].reason);
		if (cost)
			json_object_set_new(s, "seconds", pm_json_number(p->stage[i].seconds));
		json_array_append_new(json_object_get(all, "stages"), s);
	}
	for (int i = 0; i < p->neffects; i++) {
		const struct pm_plan_effect *e = &p->effect[i];
		json_t *s = json_pack("{s:s,s:s,s:s,s:o,s:o,s:b}", "effect", e->effect->name, "answer", answer(e), "reason", e->decision.text, "number",
			pm_json_number(e->decision.number), "share", pm_json_number(e->decision.share), "by_hand", e->by_hand);
		if (cost)
			json_object_set_new(s, "saves", pm_json_number(e->saves)), json_object_set_new(s, "saves_noise", pm_json_number(e->noise));
		json_array_append_new(json_object_get(all, "effects"), s);
		if (warns(e))
			json_array_append_new(json_object_get(all, "warnings"), json_string(e->effect->name));
	}
	if (cost)
		json_object_set_new(all, "cost", pm_plan_cost_json(p));
	json_dumpf(all, out, JSON_SORT_KEYS | JSON_COMPACT);
	fputc('\n', out);
	json_decref(all);
}

static const char *untried(const struct pm_plan_effect *e)
{
	if (e->effect->numerical || e->decision.error)
		return "an error, no choice";
	return e->lacking ? "no word for it yet" : e->effect->word && !pm_tool_find(e->effect->word) ? "no word" : "nothing to compare";
}

void pm_plan_print_proof(FILE *out, const struct pm_plan *p, int steps, const struct pm_plan_proof *proof)
{
	char name[64], text[32], of[PM_NAME];
	fprintf(out, "%-18s %-6s %10s  %-12s %s\n", "effect", "plan", "difference", "of", "verdict");
	for (int i = 0; i < p->neffects; i++) {
		const struct pm_plan_effect *e = &p->effect[i];
		snprintf(text, sizeof text, !proof[i].tried ? "-" : proof[i].difference > 1 ? "> 1" : "%.2g", proof[i].difference);
		snprintf(of, sizeof of, "%s", proof[i].tried ? proof[i].of : "-");
		fprintf(out, "%-18s %-6s %10s  %-12s %s\n", label(e->effect, name), answer(e), text, of, proof[i].tried ? proof[i].verdict : untried(e));
	}
	fprintf(out, "# relative to a run of T = %g, from %d steps; above %g it matters\n", p->scales.time, steps, p->scales.accuracy);
}
