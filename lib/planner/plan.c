/* A plan: the frame's numbers, what every effect decides by them, and the sentence. The force of the frame is computed once for it, and where particles carry
 * a field a few steps without remeshing. SPDX-License-Identifier: GPL-3.0-or-later */
#include <string.h>

#include "planner/scales.h"
#include "planner/plan.h"

static bool in(const struct pm_list *list, const char *name)
{
	for (int i = 0; i < list->n; i++)
		if (!strcmp(list->item[i], name))
			return true;
	return false;
}

/* By hand, if the user did. */
static void overrule(struct pm_plan_effect *e, const struct pm_plan_choice *c)
{
	const bool on = in(&c->on, e->effect->name), off = in(&c->off, e->effect->name);
	char text[sizeof e->decision.text - 16];
	if (!on && !off)
		return;
	snprintf(text, sizeof text, "%s", e->decision.text);
	snprintf(e->decision.text, sizeof e->decision.text, "%s (by hand)", text);
	e->decision.answer = on ? PM_PUT_IN : PM_LEFT_OUT;
	e->decision.every = on && !e->decision.every ? 1 : e->decision.every;
	e->decision.kept = false;
	e->by_hand = true;
}

/* Words that plan-compose.c places; the others are named where they are needed. */
static bool places(const char *word) { return !strcmp(word, "diffuse") || !strcmp(word, "remesh"); }

/* A magnetic field is brought by m2p, which wants the law's field beside it. */
static void field_beside(struct pm_plan *p)
{
	struct pm_plan_effect *self = NULL, *magnetic = NULL;
	for (int i = 0; i < p->neffects; i++) {
		self = !strcmp(p->effect[i].effect->name, "self-field") ? &p->effect[i] : self;
		magnetic = !strcmp(p->effect[i].effect->name, "magnetic-rotation") ? &p->effect[i] : magnetic;
	}
	if (!self || !magnetic || magnetic->decision.answer != PM_PUT_IN || self->decision.answer == PM_PUT_IN || !isnan(p->scales.given))
		return;
	self->decision.answer = PM_PUT_IN;
	self->decision.kept = true;
	snprintf(self->decision.text + strlen(self->decision.text), sizeof self->decision.text - strlen(self->decision.text), ", but m2p wants %s beside %s", p->law->field,
		p->law->magnetic);
}

/* Effects that the words of the far field or push bring need no word of their own. */
static void decide(struct pm_plan *p, const struct pm_plan_choice *c)
{
	p->neffects = 0;
	for (int i = 0; pm_effects[i] && i < PM_PLAN_EFFECTS; i++) {
		struct pm_plan_effect *e = &p->effect[p->neffects++];
		*e = (struct pm_plan_effect){.effect = pm_effects[i], .saves = NAN};
		pm_effects[i]->decide(&p->scales, &e->decision);
		overrule(e, c);
		e->lacking = e->decision.answer == PM_PUT_IN && e->effect->word && !places(e->effect->word);
	}
	field_beside(p);
}

/* Only the self field, to measure it. */
static int alone(const struct pm_frame *f, const struct pm_plan *p, struct pm_plan *q)
{
	*q = *p;
	for (int i = 0; i < q->neffects; i++)
		q->effect[i].decision.answer = !strcmp(q->effect[i].effect->name, "self-field") ? PM_PUT_IN : PM_LEFT_OUT;
	return pm_plan_compose(f, q);
}

static int measure_force(const struct pm_frame *f, struct pm_plan *p)
{
	struct pm_plan q;
	if (p->scales.kind == PM_NO_FIELD || p->scales.kind == PM_CARRIED || !(p->scales.sources > 0))
		return 0;
	int status = alone(f, p, &q);
	const double began = pm_seconds();
	struct pm_frame *g = status ? NULL : pm_plan_prime(f, q.sentence);
	p->force = pm_seconds() - began;
	if (!g)
		return pm_failed();
	status = pm_scales_of_force(g, p->law, &p->scales);
	pm_frame_free(g);
	return status;
}

/* Mean |H - H0|/H0 of all sets that move, which have as many particles as before; weighted by their strength, for where there is none nothing is wrong. */
static double distortion(const struct pm_frame *f, const struct pm_frame *g, const char *strength)
{
	double sum = 0, all = 0;
	for (size_t k = 0; k < f->nsets; k++) {
		const struct pm_set *set = f->sets[k];
		if (!pm_set_moves(f, set) || !set->n)
			continue;
		double *H0 = pm_alloc(set->n, sizeof *H0), *H = pm_alloc(set->n, sizeof *H);
		bool ok = H0 && H && !pm_scales_overlap(f, set->name, f->meshes[0], H0) && !pm_scales_overlap(g, set->name, g->meshes[0], H);
		const struct pm_field *q = pm_frame_field(f, set->name, strength);
		for (size_t i = 0; ok && q && i < set->n; i++) {
			const double weight = q->uniform ? 1 : fabs(pm_in(q, 0)[i]);
			sum += H0[i] > 0 ? weight * fabs(H[i] - H0[i]) / H0[i] : 0;
			all += weight;
		}
		pm_free(H0), pm_free(H);
	}
	return all > 0 ? sum / all : NAN;
}

/* Steps without remeshing, until it is too much. */
static int measure_distortion(const struct pm_frame *f, struct pm_plan *p)
{
	struct pm_plan q;
	if (p->scales.kind != PM_VORTICES || p->method.pairs || isnan(p->scales.overlap))
		return 0;
	int status = alone(f, p, &q);
	struct pm_frame *g = status ? NULL : pm_frame_copy(f);
	for (int i = 0; i < 4 && g; i++) {
		struct pm_frame *next = pm_plan_run(g, q.sentence, i ? 1 << (i - 1) : 1, NULL);
		pm_frame_free(g);
		g = next;
		p->scales.distortion[i] = g ? distortion(f, g, p->law->strength) : NAN;
		if (!(p->scales.distortion[i] <= p->scales.accuracy))
			break;
	}
	status = status ? status : g ? 0 : pm_failed();
	pm_frame_free(g);
	return status;
}

/* Of every stage in a step: the second step, or the first where steps are long. */
static int cost(const struct pm_frame *f, struct pm_plan *p)
{
	double measured[PM_PLAN_WORDS];
	struct pm_frame *g = pm_plan_run(f, p->sentence, p->force > 0.5 ? 1 : 2, measured);
	if (!g)
		return pm_failed();
	pm_frame_free(g);
	for (int i = 0; i < p->nstages; i++)
		p->stage[i].seconds = measured[i];
	return pm_plan_savings(f, p);
}

/* What no sentence can say: faces and given fields belong to the frame. */
static int by_hand(const struct pm_plan *p, const struct pm_plan_choice *c)
{
	if (in(&c->off, "periodic-images") && p->scales.periodic)
		return pm_fail(PM_USAGE, "--off periodic-images: they belong to the faces of the frame (smod --faces open)");
	if (in(&c->off, "magnetic-rotation") && !isnan(p->scales.cyclotron))
		return pm_fail(PM_USAGE, "--off magnetic-rotation: the field %s is in the frame (sel --drop %s)", p->law->magnetic, p->law->magnetic);
	if (in(&c->off, "external-field") && p->scales.given > 0 && !isnan(p->scales.cyclotron))
		return pm_fail(PM_USAGE, "--off external-field: the field %s is in the frame (sel --drop %s)", p->law->field, p->law->field);
	return 0;
}

int pm_plan_frame(const struct pm_frame *f, const struct pm_plan_choice *c, struct pm_plan *p)
{
	*p = (struct pm_plan){.law = pm_law_of(f)};
	if (!p->law)
		return -PM_DATA;
	if (f->substep)
		return pm_fail(PM_DATA, "the frame is inside a step (substep %d): plans begin between steps", f->substep);
	if (f->dt == 0 && (isnan(c->time) || c->time == f->time))
		return pm_fail(PM_DATA, "the frame has no time step (smod --dt DT)");
	int status = pm_scales_of(f, p->law, &p->scales);
	if (status)
		return status;
	p->scales.accuracy = c->accuracy;
	p->scales.time = isnan(c->time) || c->time == f->time ? 100 * fabs(f->dt) : fabs(c->time - f->time);
	if (!(p->scales.n > 0))
		return pm_fail(PM_DATA, "no particle that moves: nothing to plan");
	pm_plan_method(f, p);
	p->scales.pairs = p->method.pairs;
	decide(p, c); /* for the names of effects; the numbers of the force come next */
	status = by_hand(p, c);
	status = status ? status : measure_force(f, p);
	if (!status)
		pm_plan_mesh(f, p), pm_plan_step(f, p);
	if (!status && p->method.dt == 0)
		return pm_fail(PM_DATA, "two particles in one place have forces without bound, and no step is short enough (smod --constant softening=LENGTH)");
	status = status ? status : measure_distortion(f, p);
	if (status)
		return status;
	decide(p, c);
	status = pm_plan_compose(f, p);
	return status || !c->cost ? status : cost(f, p);
}

int pm_plan_sentence(const struct pm_frame *f, double accuracy, double end, char sentence[PM_PLAN_TEXT])
{
	const struct pm_plan_choice c = {.accuracy = accuracy, .time = end};
	struct pm_plan p;
	int status = pm_plan_frame(f, &c, &p);
	snprintf(sentence, PM_PLAN_TEXT, "%s", status ? "" : p.sentence);
	return status;
}

int pm_plan_again(const struct pm_frame *f, char sentence[PM_PLAN_TEXT])
{
	const char *said = NULL;
	size_t i;
	json_t *entry;
	json_array_foreach(f->history, i, entry)
	{
		const char *program = json_string_value(json_object_get(entry, "program"));
		if (program && !strcmp(program, "cycle"))
			said = json_string_value(json_array_get(json_object_get(entry, "arguments"), 0));
	}
	snprintf(sentence, PM_PLAN_TEXT, "%s", said ? said : "");
	return said ? 0 : pm_fail(PM_DATA, "the history of the checkpoint has no sentence to go on with (type it instead of --plan)");
}
