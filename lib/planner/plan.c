/* Makes a plan: the scales of the frame, the decision of every effect, and the sentence. The force of the frame is computed once, and a few steps if an
 * effect needs them. SPDX-License-Identifier: GPL-3.0-or-later */
#include <string.h>

#include "effect-parts/body-in-flow.h"
#include "effect-parts/effect-decision.h"
#include "planner/scales.h"
#include "planner/plan.h"

static bool in(const struct pm_list *list, const char *name)
{
	for (int i = 0; i < list->n; i++)
		if (!strcmp(list->item[i], name))
			return true;
	return false;
}

static const char by_the_user[] = " (by hand)";

/* The user's decision, if there is one. */
static void overrule(struct pm_plan_effect *e, const struct pm_plan_choice *c)
{
	const bool on = in(&c->on, e->effect->name), off = in(&c->off, e->effect->name);
	char text[sizeof e->decision.text - 16];
	if (!on && !off)
		return;
	snprintf(text, sizeof text, "%.*s", (int)sizeof text - 1, e->decision.text);
	snprintf(e->decision.text, sizeof e->decision.text, "%s%s", text, by_the_user);
	e->decision.answer = on ? PM_PUT_IN : PM_LEFT_OUT;
	e->decision.every = on && !e->decision.every ? 1 : e->decision.every;
	e->decision.kept = false;
	e->by_hand = true;
}

/* In two rounds: some effects revise their decision when all others are known. */
static void decide(const struct pm_frame *f, struct pm_plan *p, const struct pm_plan_choice *choice)
{
	struct pm_effect_case c;
	for (int i = 0; i < p->neffects; i++) {
		struct pm_plan_effect *e = &p->effect[i];
		pm_plan_case(f, p, i, &c);
		e->decision = (struct pm_decision){.answer = PM_LEFT_OUT};
		e->effect->decide(&c, &e->decision);
		overrule(e, choice);
		e->lacking = e->decision.answer == PM_PUT_IN && e->effect->word && (!e->effect->words || e->decision.named) && !e->decision.error &&
			!e->decision.brought;
	}
	for (int i = 0; i < p->neffects; i++)
		if (p->effect[i].effect->reconsider) {
			pm_plan_case(f, p, i, &c);
			p->effect[i].effect->reconsider(&c, &p->effect[i].decision);
			if (p->effect[i].effect->word && in(&choice->on, p->effect[i].effect->name) && !strstr(p->effect[i].decision.text, by_the_user))
				overrule(&p->effect[i], choice);
		}
}

static void know_effects(struct pm_plan *p)
{
	for (p->neffects = 0; pm_effects[p->neffects] && p->neffects < PM_EFFECTS; p->neffects++) {
		struct pm_plan_effect *e = &p->effect[p->neffects];
		*e = (struct pm_plan_effect){.effect = pm_effects[p->neffects], .saves = NAN, .noise = NAN};
		for (int k = 0; k < PM_EFFECT_OWN; k++)
			e->own[k] = NAN;
	}
}

/* The self field, as pairs smooth it: unsoftened, the closest pair of many would decide on the step. */
static bool measured(const struct pm_plan *p, const char *effect)
{
	return !strcmp(effect, "self-field") || (p->method.pairs && !strcmp(effect, "smoothing"));
}

/* Only the self field, to measure it. */
static int alone(const struct pm_frame *f, const struct pm_plan *p, struct pm_plan *q)
{
	*q = *p;
	q->method.grow = q->method.grow || (q->scales.kind == PM_VORTICES && q->scales.edge < HUGE_VAL); /* trials without remeshing go on to the rim */
	for (int i = 0; i < q->neffects; i++)
		q->effect[i].decision.answer = measured(p, q->effect[i].effect->name) ? PM_PUT_IN : PM_LEFT_OUT;
	return pm_plan_compose(f, q);
}

static int force_on(const struct pm_frame *f, struct pm_plan *p, const char *typed)
{
	struct pm_plan q;
	const bool own = !typed || !*typed;
	int status = own ? alone(f, p, &q) : 0;
	const double began = pm_seconds();
	struct pm_frame *g = status ? NULL : pm_plan_prime(f, own ? q.sentence : typed);
	p->force = pm_seconds() - began;
	if (!g)
		return pm_failed();
	for (int d = 0; !own && g->nmeshes && d < g->dim; d++)
		p->scales.h = fmax(d ? p->scales.h : 0, g->meshes[0]->h[d]);
	status = pm_scales_of_force(g, p->law, &p->scales);
	pm_frame_free(g);
	return status;
}

/* Forces that cancel on a mesh must also cancel where it resolves the nearest pair: on one cell, or two, all do. */
static int measure_force(const struct pm_frame *f, struct pm_plan *p, const char *typed)
{
	const struct pm_scales *s = &p->scales;
	const size_t before[3] = {p->method.cells[0], p->method.cells[1], p->method.cells[2]};
	if (s->kind == PM_NO_FIELD || s->kind == PM_CARRIED || !(s->sources > 0))
		return 0;
	int status = force_on(f, p, typed);
	double h = s->h, points = s->points;
	const bool mesh = !typed && !s->pairs && f->nmeshes && s->sources > 1 && s->nearest > 0;
	while (mesh && !status && pm_effect_cancels(s) && h > s->nearest / 3 && points * pow(2, f->dim) <= 1e6) {
		for (int d = 0; d < f->dim; d++)
			p->method.cells[d] = 2 * (p->method.cells[d] ? p->method.cells[d] : f->meshes[0]->cells[d]);
		h *= 0.5, points *= pow(2, f->dim);
		status = force_on(f, p, typed);
	}
	memcpy(p->method.cells, before, sizeof before);
	return status;
}

static struct pm_frame *run_steps(const struct pm_effect_run *r, const struct pm_frame *f, int steps) { return pm_plan_run(f, r->sentence, steps); }

/* The numbers that only one effect needs. */
static int measure_own(const struct pm_frame *f, struct pm_plan *p)
{
	struct pm_effect_case c;
	struct pm_plan q;
	int status = alone(f, p, &q);
	const struct pm_effect_run run = {.steps = run_steps, .force = pm_plan_force, .sentence = q.sentence};
	for (int i = 0; i < p->neffects && !status; i++)
		if (p->effect[i].effect->measure) {
			pm_plan_case(f, p, i, &c);
			status = p->effect[i].effect->measure(&c, &run, p->effect[i].own);
		}
	return status;
}

/* Refuses choices that no sentence can express: faces and given fields belong to the frame. */
static int by_hand(const struct pm_frame *f, const struct pm_plan *p, const struct pm_plan_choice *choice)
{
	struct pm_effect_case c;
	char why[160] = "";
	for (int i = 0; i < p->neffects; i++) {
		const struct pm_effect *e = p->effect[i].effect;
		pm_plan_case(f, p, i, &c);
		if (e->stays && in(&choice->off, e->name))
			e->stays(&c, why);
		if (*why)
			return pm_fail(PM_USAGE, "--off %s: %s", e->name, why);
		const char *lacks = e->lacks && in(&choice->on, e->name) ? e->lacks(&c) : NULL;
		if (lacks)
			return pm_fail(PM_USAGE, "--on %s: %s", e->name, lacks);
	}
	return 0;
}

/* Why a law of vortices has nothing to plan: curves of the word filament, or no vorticity yet. */
static int no_vorticity(const struct pm_frame *f, const struct pm_law *law)
{
	for (size_t i = 0; i < f->nsets && law->vector; i++)
		if (pm_frame_field(f, f->sets[i]->name, "curve") && pm_frame_field(f, f->sets[i]->name, "core"))
			return pm_fail(PM_DATA, "'%s' are filaments, which no effect of a plan is about (cycle 'filament | push rk4')", f->sets[i]->name);
	return pm_fail(PM_DATA, "no particle has %s %s yet: nothing to plan (penalize makes that of a body's layer)", law->vector ? "an" : "a", law->strength);
}

/* The scales that need no force, and the method. */
static int begin(const struct pm_frame *f, const struct pm_plan_choice *c, struct pm_plan *p)
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
	if (p->scales.kind == PM_VORTICES && !(p->scales.sources > 0))
		return no_vorticity(f, p->law);
	p->scales.accuracy = c->accuracy;
	p->scales.time = isnan(c->time) || c->time == f->time ? 100 * fabs(f->dt) : fabs(c->time - f->time);
	if (p->law->evolves && !(p->scales.courant > 0))
		return pm_fail(PM_DATA, "no fields %s and %s on a mesh (p2m | maxwell --gauss makes them)", p->law->field, p->law->magnetic);
	if (!(p->scales.n > 0) && !p->law->evolves)
		return pm_fail(PM_DATA, "no particle that moves: nothing to plan");
	pm_plan_method(f, p);
	p->scales.pairs = p->method.pairs;
	know_effects(p);
	return 0;
}

/* Fluid at rest around a body: the same frame with the vorticity that its first step makes at the wall; else NULL, or with a message if *status. */
static struct pm_frame *started(const struct pm_frame *f, int *status)
{
	const struct pm_law *law = pm_law_of(f);
	struct pm_scene_solid b;
	struct pm_scales s;
	char sentence[512];
	*status = law ? 0 : -PM_DATA;
	if (*status || law->of_potential != PM_CURL || !law->strength || !f->nmeshes || f->substep || f->dt == 0 || !pm_effect_body(f, &b))
		return NULL;
	*status = pm_scales_of(f, law, &s);
	if (*status || s.sources > 0)
		return NULL;
	pm_effect_layer(f, sentence);
	struct pm_frame *g = pm_plan_run(f, sentence, 1), *bare = g ? pm_plan_bare(g) : NULL;
	pm_frame_free(g);
	if (bare)
		bare->time = f->time, bare->step = f->step;
	*status = bare ? 0 : pm_failed();
	return bare;
}

/* The first step's sheet is as thin as the cells; it soon is as thick as the layer. */
static void spread(const struct pm_frame *f, struct pm_scales *s)
{
	const double delta = pm_effect_layer_thickness(f, s->nu, s->self);
	if (delta > 0)
		s->rough = fmin(s->rough, pow(delta, -2));
}

static int plan_of(const struct pm_frame *f, bool begun, const struct pm_plan_choice *c, struct pm_plan *p)
{
	int status = begin(f, c, p);
	status = status ? status : by_hand(f, p, c);
	status = status ? status : pm_scales_sampling(f, p->law, &p->scales);
	if (!status)
		pm_plan_few_bodies(f, p);
	status = status ? status : measure_force(f, p, NULL);
	if (!status && begun)
		spread(f, &p->scales);
	if (!status)
		pm_plan_mesh(f, p), pm_plan_cure(f, p);
	status = status ? status : pm_plan_step(f, p);
	if (!status && p->method.dt == 0)
		return pm_fail(PM_DATA, "two particles in one place have forces without bound, and no step is short enough (smod --constant softening=LENGTH)");
	status = status ? status : measure_own(f, p);
	if (status)
		return status;
	decide(f, p, c);
	status = pm_plan_compose(f, p);
	if (!status && pm_plan_too_dear(f, p, c->within))
		return 0;
	status = status || c->untested ? status : pm_plan_digits(f, p);
	status = status || !c->cost ? status : pm_plan_price(f, p);
	return status || !c->cost ? status : pm_plan_savings(f, p);
}

int pm_plan_frame(const struct pm_frame *f, const struct pm_plan_choice *c, struct pm_plan *p)
{
	int status;
	struct pm_frame *g = started(f, &status);
	status = status ? status : plan_of(g ? g : f, g, c, p);
	pm_frame_free(g);
	return status;
}

int pm_plan_decide(const struct pm_frame *f, const struct pm_effect *effect, const struct pm_plan_choice *c, struct pm_decision *d)
{
	struct pm_plan p;
	struct pm_effect_case one;
	int status = begin(f, c, &p), i = 0;
	*d = (struct pm_decision){.answer = PM_LEFT_OUT};
	if (c->force && *c->force)
		p.method.pairs = p.scales.pairs = false;
	status = status ? status : measure_force(f, &p, c->force);
	if (status)
		return status;
	while (p.effect[i].effect != effect)
		i++;
	pm_plan_case(f, &p, i, &one);
	if (effect->measure && c->force && *c->force)
		status = effect->measure(&one, &(struct pm_effect_run){.steps = run_steps, .force = pm_plan_force, .sentence = c->force}, p.effect[i].own);
	if (!status)
		effect->decide(&one, d);
	return status;
}

int pm_plan_sentence(const struct pm_frame *f, double accuracy, double end, char sentence[PM_PLAN_TEXT], FILE *warn)
{
	const struct pm_plan_choice c = {.accuracy = accuracy, .time = end};
	struct pm_plan p;
	int status = pm_plan_frame(f, &c, &p);
	snprintf(sentence, PM_PLAN_TEXT, "%s", status ? "" : p.sentence);
	if (warn && !status)
		pm_plan_warn(&p, "cycle", warn);
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
