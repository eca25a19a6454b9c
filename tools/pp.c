/* pp: the far field straight from the particles, each pair summed (lib/far/pp-frame.c, pp.c); the reference for every other far field.
 * The law gives strength, factor and sign, lib/mollifier how a point is smoothed. SPDX-License-Identifier: GPL-3.0-or-later */
#include <string.h>

#include "far/pp-frame.h"
#include "far/pp-vortex.h"
#include "law/law.h"
#include "mollifier/mollifier.h"
#include "stage/stage.h"

struct config {
	struct pm_pp_choice pp;
	const char *loop, *form;
};

static int begin(struct pm_stage *s)
{
	struct config *c = s->config;
	c->pp.half = !strcmp(c->loop, "half");
	while (strcmp(pm_pp_form_names[c->pp.form], c->form))
		c->pp.form++;
	return 0;
}

static int declare(struct pm_stage *s, struct pm_frame *f) { return pm_pp_declare(&((const struct config *)s->config)->pp, f); }

static int frame(struct pm_stage *s, struct pm_frame *f)
{
	struct pm_pp_done done;
	int status = pm_pp_apply(&((const struct config *)s->config)->pp, f, &done);
	if (!status && done.coincident) {
		pm_report_count(s, f, "coincident", done.coincident);
		pm_say(s, "%llu pairs coincide and exert no force on each other (give them a --softening)", (unsigned long long)done.coincident);
	}
	if (!status && done.core > 0)
		pm_report(s, f, "core", done.core);
	return status;
}

/* Vortices in space and rows of images are summed by one rank. */
static bool divided(const struct pm_stage *s, const struct pm_frame *f)
{
	const struct pm_law *law = pm_law_of(f);
	return s && law && !law->vector && f->face[0][0] != PM_PERIODIC && f->face[1][0] != PM_PERIODIC;
}

static const char *const loops[] = {"half", "full", NULL};
static const struct pm_option options[] = {
	{.name = "softening", .kind = PM_REAL, .unit = "length", .high = 1e300, PM_AT(pp.softening),
		.text = "length over which a point is smoothed (default: the frame's constant softening)"},
	{.name = "overlap", .kind = PM_REAL, .fallback = "1.5", .low = 0.01, .high = 1e3, PM_AT(pp.overlap),
		.text = "of vortices in space without a softening: their core over their spacing (mean volume)^(1/3)"},
	{.name = "core-spreading", .kind = PM_REAL, .unit = "time", .low = -1e300, .high = 1e300, PM_AT(pp.spreading),
		.text = "viscosity of vortices without a mesh: the softening is that of this time, and its square grows by 4 nu a time"},
	{.name = "mollifier", .kind = PM_WORD, .choices = pm_mollifier_names, PM_AT(pp.mollifier),
		.text = "how a point is smoothed (default: the law's; gaussian, and no other, where cores spread)"},
	{.name = "loop", .kind = PM_WORD, .fallback = "half", .choices = loops, PM_AT(loop),
		.text = "each pair once by symmetry, or each target over all sources; equal to round-off (of vortices in space and periodic rows always full)"},
	{.name = "form", .kind = PM_WORD, .fallback = "transpose", .choices = pm_pp_form_names, PM_AT(form),
		.text = "of vortices in space, how they stretch: sum_d alpha_d grad u_d, whose total is 0; (alpha . grad) u; half of each; or not"},
	{.name = "potential", .kind = PM_FLAG, PM_AT(pp.potential), .text = "also compute the potential at each particle, without its own"},
	{.name = "set", .kind = PM_TEXT, .unit = "NAME", PM_AT(pp.set), .text = "add to this set only; every set with the strength remains a source"},
	{.name = "replace", .kind = PM_FLAG, PM_AT(pp.replace), .text = "replaces the term self if it is already there"},
	{0},
};
static const struct pm_example examples[] = {
	{"accelerations and potential of a star cluster", "pinit plummer -n 500 | pp --potential | sls"},
	{"a vortex ring without a mesh, a step", "pinit vortex-ring --core 0.15 --cells 28x28x14 | cycle -n 1 'pp | push rk2' | sls"},
	{"a point vortex becomes Lamb and Oseen's, by the growth of its core",
		"awk 'BEGIN { print \"x y circulation\\n0 0 1\\n0.2 0 0\" }' | stab - --law vortex --constant nu=0.01 --dt 0.1 --box -1,1 | "
		"cycle -n 5 'pp --core-spreading 0 --softening 0 | push rk4' | sls"},
	{"two ways of summing, compared", "pinit plummer -n 500 > a; pp --loop full < a > b; pp < a | scmp --field acc --tolerance 1e-12 b -"},
	{0},
};
const struct pm_tool tool_pp = {
	.name = "pp",
	.summary = "far field by direct summation over all pairs",
	.about = "Adds the law's field of every particle at every other (gravity: acc = -G sum m_j (x_i - x_j)/(r^2 + softening^2)^(3/2) in 3-D, "
		"2 G m/r in 2-D, 2 pi G m in 1-D; vortices in space: vel by Biot and Savart, and dalpha, their stretching). "
		"In open space, beside walls by images, or in the plane with one periodic axis. "
		"Cost N^2: 4 billion pairs per second and core on AVX-512. The bytes do not depend on the number of threads. "
		"Coincident particles without softening exert no force on each other and are counted.",
	.kind = PM_FILTER,
	.makes = true,
	.reads = "x and the law's strength",
	.adds = "the law's change (acc, vel; of vortices in space also dalpha, term stretching); with --potential its potential (phi, psi)",
	.config = sizeof(struct config),
	.options = options,
	.examples = examples,
	.begin = begin,
	.declare = declare,
	.frame = frame,
	.divided = divided,
};
