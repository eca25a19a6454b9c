/* The sentence of a plan: which words, in which order, from what the effects decided. SPDX-License-Identifier: GPL-3.0-or-later */
#include <stdarg.h>
#include <string.h>

#include "planner/plan.h"

__attribute__((format(printf, 3, 4))) static void add(struct pm_plan *p, const char *words, const char *reason, ...)
{
	struct pm_plan_word *s = &p->stage[p->nstages];
	va_list list;
	if (p->nstages == PM_PLAN_WORDS)
		return;
	snprintf(s->words, sizeof s->words, "%s", words);
	va_start(list, reason);
	vsnprintf(s->reason, sizeof s->reason, reason, list);
	va_end(list);
	s->seconds = NAN;
	p->nstages++;
}

static const struct pm_plan_effect *effect(const struct pm_plan *p, const char *name)
{
	for (int i = 0; i < p->neffects; i++)
		if (!strcmp(p->effect[i].effect->name, name))
			return &p->effect[i];
	return NULL;
}

bool pm_plan_has(const struct pm_plan *p, const char *name)
{
	const struct pm_plan_effect *e = effect(p, name);
	return e && e->decision.answer == PM_PUT_IN && !e->lacking;
}

static const char *because(const struct pm_plan *p, const char *name) { return effect(p, name)->decision.text; }

static bool holds(const struct pm_frame *f, const struct pm_mesh *m, const char *name)
{
	const struct pm_field *field = name ? pm_frame_field(f, m->name, name) : NULL;
	return field && field->role == PM_STATE;
}

const struct pm_mesh *pm_plan_given(const struct pm_frame *f, const struct pm_law *law)
{
	for (size_t i = 0; i < f->nmeshes; i++)
		if (holds(f, f->meshes[i], law->field) || holds(f, f->meshes[i], law->magnetic))
			return f->meshes[i];
	return NULL;
}

/* The mesh of the self field: one of its own where another holds given fields that would be in the way. "" the frame's. */
static const char *own_mesh(const struct pm_frame *f, const struct pm_law *law)
{
	const struct pm_mesh *given = pm_plan_given(f, law);
	return given && holds(f, given, law->field) ? " --mesh self" : "";
}

static void cells(const struct pm_frame *f, const struct pm_plan *p, char text[64])
{
	const bool own = *own_mesh(f, p->law);
	const size_t *c = p->method.cells[0] ? p->method.cells : f->nmeshes ? f->meshes[0]->cells : p->method.cells;
	int at = 0;
	text[0] = 0;
	if (!c[0] || (!p->method.cells[0] && !own))
		return;
	bool cube = true;
	for (int d = 1; d < f->dim; d++)
		cube = cube && c[d] == c[0];
	at = snprintf(text, 64, " -n %zu", c[0]);
	for (int d = 1; d < f->dim && !cube; d++)
		at += snprintf(text + at, 64 - (size_t)at, "x%zu", c[d]);
}

/* The words of the far field on a mesh, down to the field; m2p follows. */
static void on_mesh(const struct pm_frame *f, struct pm_plan *p)
{
	const struct pm_method *m = &p->method;
	const char *own = own_mesh(f, p->law), *default_kernel = p->law->kernel;
	char words[160], n[64];
	cells(f, p, n);
	snprintf(words, sizeof words, "p2m%s%s%s%s%s", own, n, strcmp(m->kernel, default_kernel) ? " --kernel " : "", strcmp(m->kernel, default_kernel) ? m->kernel : "",
		m->grow ? " --outside grow" : "");
	add(p, words, "on a mesh: %s; %s", m->why_far, m->why_mesh);
	snprintf(words, sizeof words, "poisson-fft%s%s%s", own, m->symbol ? " --symbol " : "", m->symbol ? m->symbol : "");
	add(p, words, "self field: on, %s", because(p, "self-field"));
	snprintf(words, sizeof words, "mgrad%s%s%s", own, strcmp(m->order, p->law->order) ? " --order " : "", strcmp(m->order, p->law->order) ? m->order : "");
	add(p, words, "%s, order %s", p->law->of_potential == PM_CURL ? "the curl" : "the gradient", m->order);
}

/* Everything that adds to acc or vel. */
static void forces(const struct pm_frame *f, struct pm_plan *p)
{
	const bool self = pm_plan_has(p, "self-field"), given = pm_plan_has(p, "external-field") || pm_plan_has(p, "magnetic-rotation");
	const struct pm_mesh *m = pm_plan_given(f, p->law);
	const char *own = own_mesh(f, p->law);
	char words[160];
	if (self && p->method.pairs)
		add(p, p->scales.softening > 0 && !pm_plan_has(p, "smoothing") ? "pp --softening 0" : "pp", "self field: on, %s; pair by pair: %s; smoothing: %s", because(p, "self-field"), p->method.why_far, because(p, "smoothing"));
	else if (self)
		on_mesh(f, p);
	if (pm_plan_has(p, "diffusion") && !p->method.pairs)
		add(p, "diffuse", "diffusion: on, %s", because(p, "diffusion"));
	if (self && !p->method.pairs) {
		snprintf(words, sizeof words, "m2p%s", own);
		add(p, words, "%s at the particles%s", p->law->field, pm_plan_has(p, "diffusion") ? ", and what diffusion does to their strengths" : "");
	}
	if (given && m && (*own || !self)) {
		snprintf(words, sizeof words, f->nmeshes > 1 || self ? "m2p --mesh %s" : "m2p", m->name);
		add(p, words, "external field: %s, %s%s", pm_plan_has(p, "external-field") ? "on" : "off", because(p, "external-field"),
			pm_plan_has(p, "magnetic-rotation") ? "; brings B" : "");
	}
}

static void push(struct pm_plan *p, const char *actions, const char *reason)
{
	char words[160];
	bool first = true; /* the step is said once, by the first push */
	for (int i = 0; i < p->nstages; i++)
		first = first && strncmp(p->stage[i].words, "push", 4);
	if (first && !isnan(p->method.dt))
		snprintf(words, sizeof words, "push --dt %.12g %s", p->method.dt, actions);
	else
		snprintf(words, sizeof words, "push %s", actions);
	add(p, words, "%s", reason);
}

static void remesh(const struct pm_frame *f, struct pm_plan *p)
{
	const struct pm_decision *d = &effect(p, "remeshing")->decision;
	char words[160], every[32] = "", edge[96] = "";
	bool open = false;
	for (int k = 0; k < 2 * f->dim; k++)
		open = open || f->face[k / 2][k % 2] != PM_PERIODIC;
	if (d->every > 1)
		snprintf(every, sizeof every, " --every %d", d->every);
	if (open) /* particles only where there is something; those that diffusion will need are kept, and what spreads takes its mesh along */
		snprintf(edge, sizeof edge, " --cut-off %.2g%s%s", p->scales.accuracy * 1e-3, pm_plan_has(p, "diffusion") ? " --rim 2" : "", p->method.grow ? " --outside grow" : "");
	snprintf(words, sizeof words, "remesh --kernel %s%s%s", p->method.kernel, every, edge);
	if (d->every > 1)
		add(p, words, "remesh: every %d steps, %s", d->every, d->text);
	else
		add(p, words, "remesh: every step, %s", d->text);
}

static void join(struct pm_plan *p)
{
	size_t at = 0;
	p->sentence[0] = 0;
	for (int i = 0; i < p->nstages && at < sizeof p->sentence; i++)
		at += (size_t)snprintf(p->sentence + at, sizeof p->sentence - at, "%s%s", i ? " | " : "", p->stage[i].words);
}

int pm_plan_compose(const struct pm_frame *f, struct pm_plan *p)
{
	const bool force = pm_plan_has(p, "self-field") || pm_plan_has(p, "external-field") || pm_plan_has(p, "magnetic-rotation");
	const bool magnetic = pm_plan_has(p, "magnetic-rotation");
	const char *half = magnetic ? "boris/2" : "kick/2";
	p->nstages = 0;
	p->method.grow = p->method.grow || (p->scales.open && pm_plan_has(p, "remeshing")); /* every remeshing sets a rim around */
	if (!force && !p->scales.second)
		return pm_fail(PM_DATA, "nothing moves in this frame: the law '%s' gives its particles no velocity, and they have none", p->law->name);
	if (!force) {
		p->method.dt = NAN; /* any step will do */
		push(p, "drift", "no force: straight lines");
	} else if (p->scales.second && !strcmp(p->method.scheme, "leapfrog")) {
		char actions[32], why[400];
		snprintf(actions, sizeof actions, "%s drift", half);
		snprintf(why, sizeof why, "%s%s%s", p->method.why_step, magnetic ? "; magnetic rotation: on, " : "", magnetic ? because(p, "magnetic-rotation") : "");
		push(p, actions, why);
		forces(f, p);
		push(p, half, "the second half of the kick");
	} else {
		forces(f, p);
		push(p, p->method.scheme, p->method.why_step);
	}
	if (pm_plan_has(p, "diffusion") && p->method.pairs)
		add(p, "walk", "diffusion: on, %s", because(p, "diffusion"));
	if (pm_plan_has(p, "remeshing"))
		remesh(f, p);
	join(p);
	return 0;
}
