/* The sentence in force: typed, planned, or planned again. SPDX-License-Identifier: GPL-3.0-or-later */
#include <stdio.h>
#include <string.h>

#include "cycle/in-force.h"
#include "cycle/interrupt.h"
#include "stage/internal.h"

json_t *pm_cycle_report(struct pm_frame *f)
{
	json_t *mine = json_object_get(f->report, "cycle");
	if (!mine)
		json_object_set_new(f->report, "cycle", mine = json_object());
	return mine;
}

int pm_in_force_speak(struct pm_in_force *y, const char *sentence)
{
	y->words = pm_sentence_new(sentence, !strcmp(y->c->engine, "fused"), &y->c->moves);
	if (y->words)
		pm_sentence_notes(y->words, y->s);
	pm_interrupt_waits(y->words && pm_sentence_waits(y->words));
	return y->words ? 0 : pm_failed();
}

double pm_in_force_end(const struct pm_in_force *y, const struct pm_frame *f)
{
	return !isnan(y->c->time) ? y->c->time : y->c->steps != INT64_MIN ? f->time + (double)y->c->steps * f->dt : NAN;
}

/* The first sentence of --again, or that of the checkpoint. What is typed with --resume counts. */
static int begin_again(struct pm_in_force *y, struct pm_frame *f)
{
	struct pm_replan *r = &y->again;
	const struct pm_loop *c = y->c;
	int status = c->resume ? pm_replan_load(r, f) : 0;
	r->every = c->again != INT64_MIN ? c->again : r->every;
	r->accuracy = !c->resume || pm_given(y->s, "accuracy") ? c->accuracy : r->accuracy;
	r->end = !c->resume || !isnan(c->time) ? pm_in_force_end(y, f) : r->end;
	status = status || c->resume ? status : pm_replan_begin(r, f, y->s->quiet ? NULL : stderr);
	if (!status && y->s->entry)
		pm_replan_entry(r, y->s->entry, c);
	if (!status)
		pm_replan_save(r, f);
	return status;
}

int pm_in_force_plan(struct pm_in_force *y, struct pm_frame *f)
{
	const bool again = y->c->again != INT64_MIN || (y->c->resume && json_object_get(f->more, "plan"));
	const double end = pm_in_force_end(y, f);
	struct pm_replan *r = &y->again;
	FILE *warn = y->s->quiet ? NULL : stderr;
	int status = again ? begin_again(y, f) : y->c->resume ? pm_plan_again(f, r->sentence)
		: pm_plan_sentence(f, y->c->accuracy, end, r->sentence, warn);
	if (!status && !again && y->s->entry)
		json_array_append_new(json_object_get(y->s->entry, "arguments"), json_string(r->sentence));
	if (!status)
		pm_say(y->s, "%s", r->sentence);
	if (!status && y->c->resume)
		status = pm_sentence_safe(r->sentence);
	return status ? status : pm_in_force_speak(y, r->sentence);
}

int pm_in_force_finish(struct pm_in_force *y)
{
	int status = pm_sentence_end(y->words);
	status = status ? status : pm_sentence_timing(y->words, y->s->run->common.timing);
	const int end = pm_sentence_free(y->words);
	y->words = NULL;
	return status ? status : end;
}

/* Another sentence: it begins from state alone, so what the old one made is dropped. */
static int change(struct pm_in_force *y, struct pm_frame **f, const char *why)
{
	struct pm_frame *bare = pm_plan_bare(*f);
	int status = bare ? pm_in_force_finish(y) : pm_failed();
	if (bare)
		pm_frame_free(*f), *f = bare;
	pm_note(y->s, "step %lld, time %.6g: %s", (long long)(*f)->step, (*f)->time, why);
	pm_say(y->s, "%s", y->again.sentence);
	status = status ? status : pm_in_force_speak(y, y->again.sentence);
	if (status)
		return status;
	pm_sentence_forces(y->words, *f);
	pm_replan_record(&y->again, *f);
	char line[PM_REPLAN_WHY + 32];
	snprintf(line, sizeof line, "step %lld: %s", (long long)(*f)->step, why);
	json_object_set_new(pm_cycle_report(*f), "changed", json_string(line));
	return 0;
}

int pm_in_force_again(struct pm_in_force *y, struct pm_frame **f)
{
	char why[PM_REPLAN_WHY];
	if (!pm_replan_due(&y->again, *f))
		return 0;
	int status = pm_replan_decide(&y->again, *f, why);
	if (status >= 0)
		pm_replan_save(&y->again, *f);
	status = status > 0 ? change(y, f, why) : status;
	return status < 0 ? pm_fail(-status, "step %lld, planned again: %s", (long long)(*f)->step, pm_message()) : 0;
}
