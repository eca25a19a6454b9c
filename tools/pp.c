/* pp: the far field straight from the particles, each pair summed (lib/far/pp-frame.c, pp.c); the reference for every other far field.
 * The law gives strength, factor and sign, lib/mollifier how a point is smoothed. SPDX-License-Identifier: GPL-3.0-or-later */
#include <string.h>

#include "far/pp-frame.h"
#include "mollifier/mollifier.h"
#include "stage/stage.h"

struct config {
	struct pm_pp_choice pp;
	const char *loop;
};

static int begin(struct pm_stage *s)
{
	struct config *c = s->config;
	c->pp.half = !strcmp(c->loop, "half");
	return 0;
}

static int declare(struct pm_stage *s, struct pm_frame *f) { return pm_pp_declare(&((const struct config *)s->config)->pp, f); }

static int frame(struct pm_stage *s, struct pm_frame *f)
{
	uint64_t coincident = 0;
	int status = pm_pp_apply(&((const struct config *)s->config)->pp, f, &coincident);
	if (!status && coincident) {
		pm_report_count(s, f, "coincident", coincident);
		pm_say(s, "%llu pairs coincide and exert no force on each other (give them a --softening)", (unsigned long long)coincident);
	}
	return status;
}

static bool divided(const struct pm_stage *s, const struct pm_frame *f) { return s && f; }

static const char *const loops[] = {"half", "full", NULL};
static const struct pm_option options[] = {
	{.name = "softening", .kind = PM_REAL, .unit = "length", .high = 1e300, PM_AT(pp.softening),
		.text = "length over which a point is smoothed (default: the frame's constant softening)"},
	{.name = "mollifier", .kind = PM_WORD, .choices = pm_mollifier_names, PM_AT(pp.mollifier),
		.text = "how a point is smoothed (default: the law's)"},
	{.name = "loop", .kind = PM_WORD, .fallback = "half", .choices = loops, PM_AT(loop),
		.text = "each pair once by symmetry, or each target over all sources; equal to round-off"},
	{.name = "potential", .kind = PM_FLAG, PM_AT(pp.potential), .text = "also compute the potential at each particle, without its own"},
	{.name = "set", .kind = PM_TEXT, .unit = "NAME", PM_AT(pp.set), .text = "add to this set only; every set with the strength remains a source"},
	{.name = "replace", .kind = PM_FLAG, PM_AT(pp.replace), .text = "replaces the term self if it is already there"},
	{0},
};
static const struct pm_example examples[] = {
	{"accelerations and potential of a star cluster", "pinit plummer -n 500 | pp --potential | sls"},
	{"two ways of summing, compared", "pinit plummer -n 500 > a; pp --loop full < a > b; pp < a | scmp --field acc --tolerance 1e-12 b -"},
	{0},
};
const struct pm_tool tool_pp = {
	.name = "pp",
	.summary = "far field by direct summation over all pairs",
	.about = "Adds the law's field of every particle at every other (gravity: acc = -G sum m_j (x_i - x_j)/(r^2 + softening^2)^(3/2) in 3-D, "
		"2 G m/r in 2-D, 2 pi G m in 1-D). Open space only. Cost N^2: 4 billion pairs per second and core on AVX-512. The bytes do not depend on "
		"the number of threads. Coincident particles without softening exert no force on each other and are counted.",
	.kind = PM_FILTER,
	.makes = true,
	.reads = "x and the law's strength",
	.adds = "the law's change (acc, vel); with --potential its potential (phi, psi)",
	.config = sizeof(struct config),
	.options = options,
	.examples = examples,
	.begin = begin,
	.declare = declare,
	.frame = frame,
	.divided = divided,
};
