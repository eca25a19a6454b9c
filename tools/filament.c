/* filament: the velocity of vortex filaments by Biot and Savart, or by local induction (lib/filament/filament.c). SPDX-License-Identifier: GPL-3.0-or-later */
#include <string.h>

#include "filament/filament.h"
#include "stage/stage.h"
#include "stream/limits.h"

struct config {
	const char *set, *carry, *core;
	double local;
	int64_t images;
	bool replace;
};

static const char *const needs[] = {"x", "circulation", "core", "curve", "node"};

static const char *set_of(const struct config *o, const struct pm_frame *f)
{
	for (size_t i = 0; i < f->nsets && !o->set; i++)
		if (pm_frame_field(f, f->sets[i]->name, "curve"))
			return f->sets[i]->name;
	return o->set;
}

static int faces(const struct pm_frame *f)
{
	int periodic = 0;
	for (int d = 0; d < 3; d++) {
		const enum pm_face face = f->face[d][0], other = f->face[d][1];
		if ((face != PM_PERIODIC && face != PM_OPEN) || face != other)
			return pm_fail(PM_DATA, "the box is %s along %c: filaments are in open space, or periodic along one axis (smod --faces)",
				pm_face_names[face == PM_OPEN ? other : face], "xyz"[d]);
		periodic += face == PM_PERIODIC;
	}
	return periodic <= 1 ? 0 : pm_fail(PM_DATA, "the box is periodic along %d axes: filaments are in open space, or periodic along one (smod --faces)",
		periodic);
}

static int declare(struct pm_stage *s, struct pm_frame *f)
{
	const struct config *o = s->config;
	const char *set = set_of(o, f);
	if (f->dim != 3)
		return pm_fail(PM_DATA, "filaments are curves in space, and this frame is %d-D (pp is for vortices in the plane)", f->dim);
	if (!set || !pm_frame_set(f, set))
		return pm_fail(PM_DATA, "no set%s%s of filaments: x, circulation, core, and the integers curve and node (stab, scalc --type i64)",
			set ? " " : "", set ? set : "");
	for (int k = 0; k < 5; k++) {
		const struct pm_field *field = pm_reads(f, set, needs[k]);
		if (!field)
			return -PM_DATA;
		if ((field->type == PM_I64) != (k > 2) || field->type == PM_U8 || field->components != (k ? 1 : 3))
			return pm_fail(PM_DATA, "'%s' on '%s' must be %s", needs[k], set,
				k > 2 ? "one integer a node (scalc --type i64)" : k ? "one real number a node" : "a position in space");
	}
	if (o->carry && (!strcmp(o->carry, set) || !pm_frame_set(f, o->carry) || !pm_reads(f, o->carry, "x")))
		return pm_fail(PM_DATA, "--carry %s: no other set of that name with positions (sls lists the sets)", o->carry);
	if (o->carry && !pm_contributes(f, o->carry, "vel", "x", 3, "filament", o->replace))
		return -PM_DATA;
	return faces(f) || !pm_contributes(f, set, "vel", "x", 3, "filament", o->replace) ? -PM_DATA : 0;
}

static int frame(struct pm_stage *s, struct pm_frame *f)
{
	const struct config *o = s->config;
	const char *set = set_of(o, f);
	struct pm_filament c = {.domain = pm_domain_of(f), .n = pm_frame_set(f, set)->n, .local = isnan(o->local) ? 0 : o->local, .images = (int)o->images,
		.circulation = pm_in(pm_frame_field(f, set, "circulation"), 0), .core = pm_in(pm_frame_field(f, set, "core"), 0),
		.curve = pm_in_i64(pm_frame_field(f, set, "curve"), 0), .node = pm_in_i64(pm_frame_field(f, set, "node"), 0)};
	struct pm_field *vel = pm_frame_field(f, set, "vel");
	struct pm_filament_made made;
	double *u[3];
	for (int k = 0; pm_filament_cores[k].name; k++)
		if (!strcmp(pm_filament_cores[k].name, o->core))
			c.smoothing = pm_filament_cores[k].smoothing;
	for (int d = 0; d < 3; d++)
		c.x[d] = pm_in(pm_frame_field(f, set, "x"), d), u[d] = pm_out(vel, d);
	if (pm_filament_velocity(&c, u, &made))
		return -PM_DATA;
	pm_limits_add(vel, (struct pm_limits){.oscillation = made.oscillation});
	pm_report(s, f, "curves", (double)made.curves);
	pm_report(s, f, "length", made.length);
	for (int d = 0; d < 3 && !isnan(made.impulse[d]); d++)
		pm_report(s, f, (const char *const[]){"impulse_x", "impulse_y", "impulse_z"}[d], made.impulse[d]);
	if (!o->carry)
		return 0;
	const double *x[3];
	for (int d = 0; d < 3; d++)
		x[d] = pm_in(pm_frame_field(f, o->carry, "x"), d), u[d] = pm_out(pm_frame_field(f, o->carry, "vel"), d);
	return pm_filament_at(&c, pm_frame_set(f, o->carry)->n, x, u);
}

static const struct pm_option options[] = {
	{.name = "core-profile", .kind = PM_WORD, .fallback = "uniform", .choices = pm_filament_core_names, PM_AT(core),
		.text = "what the field core is the radius of: uniform vorticity, a Gaussian exp(-r^2/a^2), no fluid, or the smoothing length itself"},
	{.name = "local", .kind = PM_REAL, .unit = "length", .low = 1e-300, .high = 1e300, PM_AT(local),
		.text = "local induction alone, of this length to both sides of a node (4 R of a ring); default: Biot and Savart over all elements"},
	{.name = "images", .kind = PM_INTEGER, .unit = "periods", .fallback = "4", .high = 1000, PM_AT(images),
		.text = "periods of a periodic axis summed to both sides; beyond, curves through the box are straight"},
	{.name = "set", .kind = PM_TEXT, .unit = "NAME", PM_AT(set), .text = "the filaments (default: the first set with the field curve)"},
	{.name = "carry", .kind = PM_TEXT, .unit = "NAME", PM_AT(carry), .text = "another set that moves with the flow"},
	{.name = "replace", .kind = PM_FLAG, PM_AT(replace), .text = "replace the term filament if it is already there"},
	{0},
};
static const struct pm_example examples[] = {
	{"a ring of radius 1 and its speed, (ln(8/0.1) - 1/4)/(4 pi) = 0.329",
		"awk 'BEGIN { print \"x y z circulation core t\"; for (i = 0; i < 64; i++) print cos(i * 6.283185307 / 64), "
		"sin(i * 6.283185307 / 64), 0, 1, 0.1, i }' | stab - --law vortex --box=-2,2 --faces open --dt 0.01 | "
		"scalc --role state --type i64 'node = t' 'curve = 0' | filament | sls --data"},
	{0},
};
const struct pm_tool tool_filament = {
	.name = "filament",
	.summary = "velocity of vortex filaments: Biot and Savart over their elements, or local induction",
	.about = "vel += Gamma/(4 pi) integral of dl x (x - y)/(|x - y|^2 + sigma^2)^(3/2) over closed curves of straight elements, or over curves that "
		"pass once through a periodic axis, for ever; sigma follows from the core. A node's own two elements are an arc of a circle. Reports "
		"the length and the impulse. Order 2 in the length of the elements. See docs/methods/filament.md.",
	.kind = PM_FILTER,
	.makes = true,
	.reads = "x, circulation, core, curve, node",
	.adds = "vel (term filament)",
	.config = sizeof(struct config),
	.options = options,
	.examples = examples,
	.declare = declare,
	.frame = frame,
};
