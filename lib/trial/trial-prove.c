/* plan --check: the effects, each with and without, then the choices of the sentence, each beside the next one; as text and as JSON.
 * SPDX-License-Identifier: GPL-3.0-or-later */
#include <string.h>

#include "stream/header.h"
#include "trial/trial.h"

static const char *const verdicts[] = {"pass", "fail", "cannot tell"};
static const char *const kinds[] = {"time", "space", "sampling", "rounding"};

static const char *short_number(double x, char text[24])
{
	snprintf(text, 24, isnan(x) ? "-" : x > 1 ? "> 1" : "%.2g", x);
	return text;
}

static void where(const struct pm_trial *t, const struct pm_plan *p, char text[160])
{
	if (t->part >= 1)
		snprintf(text, 160, "over the whole run, %lld steps", (long long)t->steps);
	else
		snprintf(text, 160, "over %.2g of the run, %lld steps, and continued to T = %g", t->part, (long long)t->steps, p->scales.time);
}

/* An effect that the plan needs and has no word for, or an error that it foresees; NULL none. A plan that says so has not decided wrongly. */
static const struct pm_plan_effect *lacking(const struct pm_plan *p)
{
	for (int i = 0; i < p->neffects; i++) {
		const struct pm_plan_effect *e = &p->effect[i];
		if (e->lacking || (e->decision.answer == PM_PUT_IN && (e->effect->numerical || e->decision.error)))
			return e;
	}
	return NULL;
}

static void print_trial(FILE *out, const struct pm_trial *t, const struct pm_plan *p, const struct pm_plan_effect *lacks)
{
	char difference[24], error[24], change[100], text[160];
	fprintf(out, "#\n%-10s %-34s %10s %10s  %s\n", "choice", "changed", "difference", "error", "by");
	for (int i = 0; i < t->n; i++) {
		const struct pm_trial_row *r = &t->row[i];
		snprintf(change, sizeof change, "%s -> %s", r->from, r->to);
		fprintf(out, "%-10s %-34s %10s %10s  %s\n", r->choice->name, change, short_number(r->difference, difference), short_number(r->error, error),
			r->text);
	}
	where(t, p, text);
	fprintf(out, "# relative differences of %s, %s; %.0f forces in all\n", t->of, text, t->evaluations);
	fprintf(out, "# error %.2g +- %.1g, accuracy %g: %s", t->error, t->uncertain, p->scales.accuracy, verdicts[t->verdict]);
	if (t->verdict == PM_TRIAL_FAIL && lacks)
		fprintf(out, ", as the plan says itself: %s%s", lacks->effect->name, lacks->lacking ? " is needed, and has no word" : "");
	fputs(t->part < 1 && t->verdict == PM_TRIAL_PASS ? ", as far as tested (-n tests more)\n" : "\n", out);
}

static json_t *trial_json(const struct pm_trial *t)
{
	json_t *all = json_pack("{s:s,s:s,s:o,s:o,s:s,s:o,s:I,s:I,s:[]}", "sentence", t->sentence, "of", t->of, "error", pm_json_number(t->error), "uncertain",
		pm_json_number(t->uncertain), "verdict", verdicts[t->verdict], "part", pm_json_number(t->part), "steps", (json_int_t)t->steps, "forces",
		(json_int_t)t->evaluations, "choices");
	for (int i = 0; i < t->n; i++) {
		const struct pm_trial_row *r = &t->row[i];
		json_array_append_new(json_object_get(all, "choices"), json_pack("{s:s,s:s,s:s,s:s,s:o,s:o,s:o,s:o,s:s}", "choice", r->choice->name, "kind",
			kinds[r->choice->kind], "from", r->from, "to", r->to, "difference", pm_json_number(r->difference), "error",
			pm_json_number(r->error), "uncertain", pm_json_number(r->uncertain), "order", pm_json_number(r->order), "by", r->text));
	}
	return all;
}

static json_t *proof_json(const struct pm_plan *p, const struct pm_plan_proof *proof)
{
	json_t *all = json_array();
	for (int i = 0; i < p->neffects; i++)
		if (proof[i].tried)
			json_array_append_new(all, json_pack("{s:s,s:o,s:s,s:s,s:b}", "effect", p->effect[i].effect->name, "difference",
				pm_json_number(proof[i].difference), "of", proof[i].of, "verdict", proof[i].verdict, "wrong", proof[i].wrong));
	return all;
}

/* What was found of a sentence that fails. */
struct better {
	struct pm_trial trial;
	char why[200]; /* "": the trial passes */
};

static void print_better(FILE *out, const struct better *b)
{
	if (*b->why)
		fprintf(out, "# no sentence was found that passes: %s\n", b->why);
	else
		fprintf(out, "# this one passes, error %.2g +- %.1g:\n%s\n", b->trial.error, b->trial.uncertain, b->trial.sentence);
}

static void print_json(FILE *out, const struct pm_plan *p, const struct pm_plan_proof *proof, const struct pm_trial *t, const struct better *b)
{
	json_t *all = json_pack("{s:o,s:o,s:o}", "accuracy", pm_json_number(p->scales.accuracy), "effects", proof_json(p, proof), "trial", trial_json(t));
	if (*p->refused)
		json_object_set_new(all, "refused", json_string(p->refused));
	if (b && *b->why)
		json_object_set_new(all, "why", json_string(b->why));
	else if (b)
		json_object_set_new(all, "proposed", trial_json(&b->trial));
	json_dumpf(all, out, JSON_SORT_KEYS | JSON_COMPACT);
	fputc('\n', out);
	json_decref(all);
}

static int say(int wrong, bool fails, const struct pm_trial *t, const struct pm_plan *p)
{
	if (wrong)
		return pm_fail(PM_NUMERICS, "%d decision%s wrong%s", wrong, wrong > 1 ? "s were" : " was",
			fails ? ", and the accuracy is missed" : "");
	if (*p->refused)
		return pm_fail(PM_NUMERICS, "%s", p->refused);
	if (!fails)
		return 0;
	return pm_fail(PM_NUMERICS, "the error of %s is %.2g +- %.1g, more than the accuracy %g: by the %s", t->of, t->error, t->uncertain, p->scales.accuracy,
		t->worst < 0 ? "sentence" : t->row[t->worst].choice->name);
}

int pm_trial_prove(FILE *out, const struct pm_frame *f, const struct pm_plan *p, int64_t steps, const char *instead, bool json)
{
	struct pm_plan_proof proof[PM_EFFECTS];
	struct pm_trial *t = pm_alloc(1, sizeof *t);
	struct better *b = pm_alloc(1, sizeof *b);
	const int few = steps ? (int)fmin((double)steps, 1e6) : 4;
	int status = t && b ? 0 : pm_failed(), wrong = 0;
	for (int i = 0; i < p->neffects && instead; i++)
		proof[i] = (struct pm_plan_proof){.difference = NAN};
	if (!status && !instead)
		status = pm_plan_check(f, p, few, proof);
	status = status ? status : pm_trial_of(f, p, instead ? instead : p->sentence, steps, t);
	const struct pm_plan_effect *lacks = instead ? NULL : lacking(p);
	const bool fails = !status && t->verdict == PM_TRIAL_FAIL && !lacks;
	if (fails && *p->refused)
		b->trial = *t, snprintf(b->why, sizeof b->why, "rounding and chaos forbid the accuracy");
	else if (fails)
		status = pm_trial_refine(f, p, t, &b->trial, b->why);
	if (!status && json) {
		print_json(out, p, proof, t, fails ? b : NULL);
	} else if (!status) {
		if (*p->refused || *p->unproved)
			fprintf(out, "# %s\n", *p->refused ? p->refused : p->unproved);
		if (!instead)
			pm_plan_print_proof(out, p, few, proof);
		print_trial(out, t, p, lacks);
		if (fails)
			print_better(out, b);
	}
	for (int i = 0; i < p->neffects && !status; i++)
		wrong += proof[i].wrong;
	if (!status)
		status = say(wrong, fails, t, p);
	pm_free(t), pm_free(b);
	return status;
}
