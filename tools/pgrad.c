/* pgrad: derivatives of what particles carry, at the particles (lib/near/derivative.c, lib/near/dcpse.c). SPDX-License-Identifier: GPL-3.0-or-later */
#include <stdlib.h>
#include <string.h>

#include "law/law.h"
#include "near/derivative-frame.h"
#include "stage/stage.h"

struct config {
	struct pm_derivative_choice choice;
	const char *method, *order, *sign, *side, *wall;
};

static int begin(struct pm_stage *s)
{
	struct config *o = s->config;
	struct pm_derivative_choice *c = &o->choice;
	c->corrected = !strcmp(o->method, "dc"), c->plus = !strcmp(o->sign, "plus"), c->images = !strcmp(o->wall, "images"), c->order = atoi(o->order);
	c->side = !strcmp(o->side, "below") ? -1 : !strcmp(o->side, "above") ? 1 : 0;
	if (pm_given(s, "eps") && pm_given(s, "overlap"))
		return pm_fail(PM_USAGE, "--eps or --overlap, not both: either is the width");
	if (c->corrected && c->plus)
		return pm_fail(PM_USAGE, "--sign plus is for --method integral: the weights of dc are for differences");
	if (c->side && c->plus)
		return pm_fail(PM_USAGE, "--sign plus with one side would give a constant a derivative (leave out one of the two)");
	if (!c->corrected && c->side && pm_given(s, "order"))
		return pm_fail(PM_USAGE, "half of a symmetric kernel has order 1 (leave out --order, or --method dc)");
	return 0;
}

/* The field that the choice names, else the law's strength. */
static struct pm_derivative_choice choice_of(const struct pm_stage *s, const struct pm_frame *f)
{
	struct pm_derivative_choice c = ((const struct config *)s->config)->choice;
	const struct pm_law *law = pm_law_of(f);
	if (!c.field && law)
		c.field = law->strength;
	return c;
}

static int declare(struct pm_stage *s, struct pm_frame *f)
{
	const struct pm_derivative_choice c = choice_of(s, f);
	return c.field ? pm_derivative_declare(&c, f) : pm_fail(PM_DATA, "the law has no strength (--field NAME)");
}

static int frame(struct pm_stage *s, struct pm_frame *f)
{
	const struct pm_derivative_choice c = choice_of(s, f);
	struct pm_derivative_took took;
	int status = pm_derivative_apply(&c, f, &took);
	if (!status) {
		pm_report(s, f, "eps", took.eps);
		pm_report(s, f, "cutoff", took.cutoff);
	}
	if (!status && took.widened)
		pm_report_count(s, f, "widened", took.widened);
	return status;
}

static bool divided(const struct pm_stage *s, const struct pm_frame *f) { return s && f; }

static const char *const methods[] = {"dc", "integral", NULL}, *const orders[] = {"2", "4", "6", "8", NULL}, *const signs[] = {"minus", "plus", NULL},
	*const sides[] = {"both", "below", "above", NULL}, *const walls[] = {"images", "none", NULL};
static const struct pm_option options[] = {
	{.name = "derivative", .kind = PM_TEXT, .unit = "WHICH", .fallback = "grad", PM_AT(choice.derivative),
		.text = "grad, lap, or the power of each axis: 1,0 is d/dx in the plane, 1,1 d2/dxdy; in all at most 4"},
	{.name = "field", .kind = PM_TEXT, .unit = "NAME", PM_AT(choice.field), .text = "of this field, a strength or a value (default: the law's strength)"},
	{.name = "set", .kind = PM_TEXT, .unit = "NAME", PM_AT(choice.set), .text = "the particles (default: the first set that has the field)"},
	{.name = "target", .kind = PM_TEXT, .unit = "NAME", .fallback = "derivative", PM_AT(choice.target), .text = "the field to make"},
	{.name = "method", .kind = PM_WORD, .fallback = "dc", .choices = methods, PM_AT(method),
		.text = "dc: weights corrected for the positions of the partners; integral: a Gaussian's derivative, for lattices and particles just remeshed"},
	{.name = "order", .kind = PM_WORD, .fallback = "2", .choices = orders, PM_AT(order), .text = "of the error in eps; dc to 6"},
	{.name = "side", .kind = PM_WORD, .fallback = "both", .choices = sides, PM_AT(side),
		.text = "partners below or above alone, along the axis of the derivative: upwind; order 1 with integral, that of --order with dc"},
	{.name = "sign", .kind = PM_WORD, .fallback = "minus", .choices = signs, PM_AT(sign),
		.text = "of f_p beside f_q in integral: minus is exact for constants; plus, of odd degree, conserves the total and diverges off lattices"},
	{.name = "eps", .kind = PM_REAL, .unit = "length", .low = 1e-60, .high = 1e60, PM_AT(choice.eps), .text = "width (default: from --overlap)"},
	{.name = "overlap", .kind = PM_REAL, .fallback = "1", .low = 1e-3, .high = 1e3, PM_AT(choice.overlap),
		.text = "eps over the spacing of the particles, (mean volume)^(1/dim)"},
	{.name = "cutoff", .kind = PM_REAL, .unit = "eps", .low = 1, .high = 40, PM_AT(choice.cutoff),
		.text = "reach (default: dc 3.1, 4.1, 5.1 for order 2, 4, 6 and more from the third derivative; integral 8 to 11 and half the degree)"},
	{.name = "wall", .kind = PM_WORD, .fallback = "images", .choices = walls, PM_AT(wall),
		.text = "mirror particles at faces that are wall (odd) or neumann (even), or nothing beyond them"},
	{0},
};

static const struct pm_example examples[] = {
	{"the gradient of x^2 + y at points placed at random, exact up to the rim",
		"pinit uniform --dim 2 -n 200 --faces open | scalc --role state 'f = x^2 + y' 'volume = 1/200' | pgrad --field f | sls --data"},
	{"advection of a value past particles at rest, upwind: an Eulerian scheme of particles",
		"awk 'BEGIN { print \"x f volume\"; for (i = 0; i < 40; i++) print (i + 0.5)/40, (i < 20), 1/40 }' | "
		"stab - --box 0,1 --faces periodic --dt 0.01 | cycle -n 9 \"field 'vel = 0' | pgrad --field f --method integral --side below | "
		"field 'df = -derivative' | push euler\" | sls"},
	{0},
};

const struct pm_tool tool_pgrad = {
	.name = "pgrad",
	.summary = "derivatives of what particles carry, at the particles",
	.about = "The gradient, the Laplacian or any derivative of degree 1 to 4 of a value (or of strength over volume) of particles, without a mesh: weights "
		"of each particle that make the moments over its own partners exact (dc), or the derivative of a Gaussian (integral), orders 2 to 8; from both "
		"sides or one. See docs/methods/pgrad.md.",
	.kind = PM_FILTER,
	.makes = true,
	.reads = "x, a strength or value, volume",
	.adds = "derivative (the same set)",
	.config = sizeof(struct config),
	.options = options,
	.examples = examples,
	.begin = begin,
	.declare = declare,
	.frame = frame,
	.divided = divided,
};
