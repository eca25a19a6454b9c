/* beale: strengths for which the smoothed particles are the function itself (lib/near/beale.c). SPDX-License-Identifier: GPL-3.0-or-later */
#include <stdlib.h>

#include "near/beale.h"
#include "stage/stage.h"
#include "stage/strength-report.h"

struct config {
	struct pm_sample_choice choice;
	const char *order;
	int64_t iterations;
	double tolerance;
};

static int begin(struct pm_stage *s)
{
	struct config *o = s->config;
	o->choice.order = atoi(o->order);
	o->choice.operator = "value";
	if (pm_given(s, "eps") && pm_given(s, "overlap"))
		return pm_fail(PM_USAGE, "--eps or --overlap, not both: either is the width");
	return 0;
}

static int declare(struct pm_stage *s, struct pm_frame *f)
{
	const struct config *o = s->config;
	struct pm_sample_choice c;
	if (f->substep)
		return PM_PASS;
	return pm_beale_choose(&o->choice, f, &c) || pm_sample_declare(&c, f) || !pm_changes(f, c.set, c.field) ? -PM_DATA : 0;
}

static int frame(struct pm_stage *s, struct pm_frame *f)
{
	const struct config *o = s->config;
	struct pm_sample_choice c;
	struct pm_strengths before, after;
	struct pm_beale_gain gain;
	int status = pm_beale_choose(&o->choice, f, &c);
	if (!status) {
		pm_strengths_of(f, c.set, &before);
		status = pm_beale(&c, f, (int)o->iterations, o->tolerance, &gain);
	}
	if (status)
		return status;
	pm_strengths_of(f, c.set, &after);
	pm_report_strengths(s, f, "given", &before, &after);
	pm_report(s, f, "iterations", gain.iterations);
	pm_report(s, f, "before", gain.before);
	pm_report(s, f, "after", gain.after);
	if (gain.after > 0.5 * gain.before && gain.after > o->tolerance)
		pm_tell_once(s, "the smoothed function differs from the given one by %.2g of its largest value, as good as unchanged: the mollifier is too "
			"narrow for the spacing or wide for the function (--overlap 1.5, more particles)", gain.after);
	return 0;
}

static const char *const orders[] = {"2", "4", NULL};
static const struct pm_option options[] = {
	{.name = "iterations", .letter = 'n', .kind = PM_INTEGER, .fallback = "10", .low = 0, .high = 1e6, PM_AT(iterations),
		.text = "at most so many; an iteration that makes the difference larger is taken back, and is the last"},
	{.name = "tolerance", .kind = PM_REAL, .fallback = "1e-9", .high = 1, PM_AT(tolerance),
		.text = "enough: largest difference at the particles over the largest value"},
	{.name = "field", .kind = PM_TEXT, .unit = "NAME", PM_AT(choice.field), .text = "a strength of particles with volumes (default: the law's)"},
	{.name = "set", .kind = PM_TEXT, .unit = "NAME", PM_AT(choice.set), .text = "the particles (default: the first set that has the field)"},
	{.name = "target", .kind = PM_TEXT, .unit = "NAME", .fallback = "sampled", PM_AT(choice.target),
		.text = "the smoothed function at the particles, a new field"},
	{.name = "order", .kind = PM_WORD, .fallback = "2", .choices = orders, PM_AT(order), .text = "of the Gaussian"},
	{.name = "eps", .kind = PM_REAL, .unit = "length", .low = 1e-60, .high = 1e60, PM_AT(choice.eps), .text = "width (default: from --overlap)"},
	{.name = "overlap", .kind = PM_REAL, .low = 0.01, .high = 100, PM_AT(choice.overlap),
		.text = "width over the spacing of the particles, (mean volume)^(1/dim) (default: 1.5)"},
	{.name = "cutoff", .kind = PM_REAL, .unit = "eps", .low = 0.1, .high = 1000, PM_AT(choice.cutoff),
		.text = "reach of the mollifier (default: as sample)"},
	{0},
};
static const struct pm_example examples[] = {
	{"vortices whose smoothed sum is the vorticity of the scene, and what that gained", "pinit lamb-oseen --cells 32 | beale | sls --report"},
	{0},
};
const struct pm_tool tool_beale = {
	.name = "beale",
	.summary = "strengths for which the smoothed particles are the function itself, by Beale's iteration",
	.about = "Gamma_p += V_p (u_p - sum_q Gamma_q zeta(x_p - x_q)), where u_p = Gamma_p/V_p as it came. Particles with strengths V u give u smoothed by "
		"zeta; these give u itself, but for the waves of the spacing. Reports iterations, and the largest difference before and after over the "
		"largest value. The total is not conserved; its change is reported. Acts between steps only. See docs/methods/beale.md.",
	.kind = PM_FILTER,
	.reads = "x, volume",
	.changes = "the strength",
	.adds = "sampled",
	.config = sizeof(struct config),
	.options = options,
	.examples = examples,
	.begin = begin,
	.declare = declare,
	.frame = frame,
};
