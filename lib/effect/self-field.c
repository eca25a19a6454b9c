/* Self field: the forces between the particles. Within the time T of the run it changes velocities by a T, relative to the speeds present; a small force
 * may grow, at most at the collective frequency omega (plasma, Jeans), so it may be left out only if (omega T)^2/2 is small too. Vortices have
 * no inertia: u T over their distance. Forces that cancel to round-off (a lattice) may grow as cosh(omega T) at most. Assumes that the force of the frame was
 * measured. Source: Birdsall and Langdon 1985, section 4-2; Binney and Tremaine 2008, section 5.2. SPDX-License-Identifier: GPL-3.0-or-later */
#include <stdio.h>
#include <string.h>

#include "effect-parts/effect-decision.h"
#include "effect-parts/effect-words.h"
#include "law/law.h"

static const char *symbol(const struct pm_scales *s) { return s->kind == PM_CHARGES ? "omega_p" : "sqrt(4 pi G rho)"; }

static void vortices(const struct pm_scales *s, struct pm_decision *d)
{
	const double moved = s->self * s->time / s->spacing;
	pm_effect_by(d, s, moved, moved);
	snprintf(d->text, sizeof d->text, "u T is %.2g neighbour distances", moved);
	d->kept = d->answer == PM_LEFT_OUT; /* without it the particles would not move */
	d->answer = PM_PUT_IN;
}

static void decide(const struct pm_effect_case *c, struct pm_decision *d)
{
	const struct pm_scales *s = c->scales;
	const double phase = s->omega * s->time;
	if (s->kind == PM_NO_FIELD || s->kind == PM_CARRIED) {
		pm_effect_off(d, "the law has none");
		return;
	}
	if (s->light) {
		pm_effect_by(d, s, phase, 1);
		snprintf(d->text, sizeof d->text, s->sources < 1 ? "light alone, no charges" : "omega_p T = %.2g; without it light would stand still", phase);
		return;
	}
	if (s->kind == PM_VORTICES && !s->second) {
		vortices(s, d);
		return;
	}
	if (s->sources < 2 && !s->walls) {
		pm_effect_off(d, s->sources < 1 ? "no particle has a strength" : "one particle, and no particle moves itself");
		return;
	}
	const double gain = s->self * s->time, part = gain / (gain + s->v_rms);
	pm_effect_by(d, s, phase, fmax(0.5 * phase * phase, part));
	d->kept = d->answer == PM_PUT_IN && part <= s->accuracy;
	snprintf(d->text, sizeof d->text, "%s T = %.2g, changes speeds by %.1g%s", symbol(s), phase, part, d->kept ? " and may grow" : "");
	if (pm_effect_cancels(s)) {
		pm_effect_off(d, "");
		d->number = s->self / (s->omega * s->omega * s->spacing);
		snprintf(d->text, sizeof d->text, "forces cancel to %.1g, and grow by cosh(%s T) = %.1g at most", d->number, symbol(s), cosh(fmin(phase, 700)));
	}
}

/* A magnetic field is interpolated by m2p, which also requires the law's field. */
static void reconsider(const struct pm_effect_case *c, struct pm_decision *d)
{
	const size_t at = strlen(d->text);
	if (d->answer == PM_PUT_IN || !pm_effect_in(c, "magnetic-rotation") || !isnan(c->scales->given))
		return;
	d->answer = PM_PUT_IN;
	d->kept = true;
	snprintf(d->text + at, sizeof d->text - at, ", but m2p wants %s beside %s", c->law->field, c->law->magnetic);
}

/* E and B of a mesh are gathered by the m2p that these words bring. */
static void stays(const struct pm_effect_case *c, char why[160])
{
	if (c->scales->light)
		snprintf(why, 160, "light is in the frame, and would stand still (sel --drop %s,%s | smod --law free goes on without fields)", c->law->field,
			c->law->magnetic);
}

/* The option of p2m for more cells, or for a separate mesh. */
static void cells(const struct pm_effect_case *c, const char *own, char text[64])
{
	const struct pm_frame *f = c->frame;
	const bool asked = c->method->cells[0] > 0;
	const size_t *n = asked || !f->nmeshes ? c->method->cells : f->meshes[0]->cells;
	bool cube = true;
	text[0] = 0;
	if (!n[0] || (!asked && !*own))
		return;
	for (int d = 1; d < f->dim; d++)
		cube = cube && n[d] == n[0];
	int at = snprintf(text, 64, " -n %zu", n[0]);
	for (int d = 1; d < f->dim && !cube; d++)
		at += snprintf(text + at, 64 - (size_t)at, "x%zu", n[d]);
}

/* " --kernel tsc", or nothing if it is the law's. */
static const char *option(const char *name, const char *value, const char *law, char text[64])
{
	text[0] = 0;
	if (value && (!law || strcmp(value, law)))
		snprintf(text, 64, " --%s %s", name, value);
	return text;
}

/* Differences of order 4 and 6 are one-sided beside open faces, where what makes the field would act on itself (docs/methods/mgrad.md). */
static const char *rim(const struct pm_effect_case *c)
{
	const char *order = c->scales->open && c->method->order ? c->method->order : "";
	return !strcmp(order, "4") ? " --rim 1" : !strcmp(order, "6") ? " --rim 2" : "";
}

static void on_mesh(const struct pm_effect_case *c, struct pm_words *w)
{
	const struct pm_method *m = c->method;
	const char *own = pm_effect_own_mesh(c->frame, c->law);
	char words[160], n[64], text[64];
	cells(c, own, n);
	snprintf(words, sizeof words, "p2m%s%s%s%s%s", own, n, option("kernel", m->kernel, c->law->kernel, text), rim(c),
		m->grow ? " --outside grow" : "");
	pm_words_add(w, PM_SLOT_DENSITY, words, "on a mesh: %s; %s", m->why_far, m->why_mesh);
	snprintf(words, sizeof words, "poisson-fft%s%s", own, option("symbol", m->symbol, NULL, text));
	pm_words_add(w, PM_SLOT_POTENTIAL, words, "self field: on, %s", c->decision->text);
	snprintf(words, sizeof words, "mgrad%s%s", own, option("order", m->order, c->law->order, text));
	pm_words_add(w, PM_SLOT_FIELD, words, "%s, order %s", c->law->of_potential == PM_CURL ? "the curl" : "the gradient", m->order);
	snprintf(words, sizeof words, "m2p%s", own);
	pm_words_add(w, PM_SLOT_PARTICLES, words, "%s at the particles", c->law->field);
}

/* Maxwell's equations: the current of the way from x to x + v dt, before the particles go it. */
static void with_light(const struct pm_effect_case *c, struct pm_words *w)
{
	char words[160], text[64];
	snprintf(words, sizeof words, "p2m --current%s", option("kernel", c->method->kernel, c->law->kernel, text));
	pm_words_add(w, PM_SLOT_DENSITY, words, "the current of the particles on their way, which keeps charge");
	pm_words_add(w, PM_SLOT_POTENTIAL, "maxwell", "self field: on, %s", c->decision->text);
	pm_words_add(w, PM_SLOT_MESH, "push drift", "the way itself");
	pm_words_add(w, PM_SLOT_PARTICLES, c->method->conserving ? "m2p --energy-conserving" : "m2p", "%s and %s at the particles", c->law->field,
		c->law->magnetic);
}

static void ask(const struct pm_effect_case *c, struct pm_method *m)
{
	if (c->scales->light && !strcmp(m->kick, "kick/2"))
		m->kick = "boris/2";
}

static void words(const struct pm_effect_case *c, struct pm_words *w)
{
	if (c->decision->answer != PM_PUT_IN)
		return;
	if (c->scales->light) {
		with_light(c, w);
		return;
	}
	if (c->method->pairs)
		pm_words_add(w, PM_SLOT_PARTICLES, "pp", "self field: on, %s; pair by pair: %s", c->decision->text, c->method->why_far);
	else
		on_mesh(c, w);
}

static bool reversible(const struct pm_effect_case *c)
{
	const struct pm_scales *s = c->scales;
	return !s->light && c->law->strength && (c->decision->answer == PM_PUT_IN || s->sources > 0) && (isnan(s->cyclotron) || !isnan(s->given));
}

const struct pm_effect effect_self_field = {
	.name = "self-field",
	.sentence = "the field that the particles make together",
	.source = "Birdsall and Langdon 1985, section 4-2",
	.force = true,
	.decide = decide,
	.reconsider = reconsider,
	.stays = stays,
	.ask = ask,
	.words = words,
	.reversible = reversible,
};
