/* pp: the far field straight from the particles, each pair summed (lib/far/pp.c); the reference for every other far field.
 * The law gives strength, factor and sign, lib/mollifier how a point is smoothed. SPDX-License-Identifier: GPL-3.0-or-later */
#include <string.h>

#include "far/bodies.h"
#include "far/pp.h"
#include "law/law.h"
#include "stage/stage.h"

struct config {
	const char *mollifier, *loop, *set;
	double softening;
	bool potential, replace;
};

static struct pm_far far_of(const struct pm_law *law, const struct config *cfg)
{
	return (struct pm_far){.strength = law->strength, .per = law->per, .change = law->change, .of = law->of, .potential = law->potential,
		.curl = law->of_potential == PM_CURL, .sign = law->sign, .set = cfg->set, .with_potential = cfg->potential};
}

static int open_space(const struct pm_frame *f)
{
	for (int a = 0; a < 2 * f->dim; a++)
		if (f->face[a / 2][a % 2] != PM_OPEN)
			return pm_fail(PM_DATA, "the box is %s along %c and pp sums in open space (p2m | poisson-fft | mgrad | m2p does such boxes; for "
				"periodic "
				"ones also the word ewald)", pm_face_names[f->face[a / 2][a % 2]], "xyz"[a / 2]);
	return 0;
}

/* What to sum, from the law, the frame and the options. */
static int method(const struct pm_stage *s, const struct pm_frame *f, const struct pm_law *law, struct pm_pp *p)
{
	const struct config *cfg = s->config;
	const char *name = cfg->mollifier ? cfg->mollifier : law->mollifier ? law->mollifier : "plummer";
	*p = (struct pm_pp){.dim = f->dim, .half = !strcmp(cfg->loop, "half"), .mollifier = pm_mollifier_find(name)};
	if (!p->mollifier)
		return -PM_DATA;
	if (!(p->mollifier->dims >> f->dim & 1))
		return pm_fail(PM_DATA, "the mollifier %s is not defined in %d-D (plummer, rankine and gaussian are)", name, f->dim);
	if (p->mollifier->bare)
		return 0;
	p->delta = pm_given(s, "softening") ? cfg->softening : pm_frame_constant(f, "softening", NAN);
	if (!(p->delta >= 0))
		return pm_fail(PM_DATA, "no softening length (--softening LENGTH, 0 if you mean it; smod --constant softening=LENGTH for the frame; or "
			"--mollifier none)");
	return 0;
}

static int declare(struct pm_stage *s, struct pm_frame *f)
{
	const struct config *cfg = s->config;
	const struct pm_law *law = pm_law_of(f);
	struct pm_pp p;
	int status = law ? open_space(f) : -PM_DATA;
	if (!status && !(law->strength && law->change && law->coefficient && law->dims >> f->dim & 1))
		return pm_fail(PM_DATA, "the law %s has no sum over pairs in %d-D", f->law, f->dim);
	if (!status)
		status = method(s, f, law, &p);
	struct pm_far far = far_of(law, cfg);
	return status ? status : pm_far_plan(f, &far, "self", cfg->replace);
}

static int frame(struct pm_stage *s, struct pm_frame *f)
{
	const struct pm_law *law = pm_law_of(f);
	struct pm_far far = far_of(law, s->config);
	struct pm_bodies b;
	struct pm_pp p;
	uint64_t coincident = 0;
	int status = method(s, f, law, &p);
	if (status)
		return status;
	status = pm_bodies_gather(f, &far, &b);
	if (!status)
		status = pm_pp_sum(&p, b.targets, b.n, (const double *const *)b.x, b.q, b.gradient, b.potential, &coincident);
	if (!status)
		pm_bodies_scatter(f, &far, law->coefficient(f), &b);
	if (!status && coincident) {
		pm_report_count(s, f, "coincident", coincident);
		pm_say(s, "%llu pairs coincide and exert nothing on each other (give them a --softening)", (unsigned long long)coincident);
	}
	pm_bodies_free(&b);
	return status;
}

static const char *const loops[] = {"half", "full", NULL};
static const struct pm_option options[] = {
	{.name = "softening", .kind = PM_REAL, .unit = "length", .high = 1e300, PM_AT(softening),
		.text = "length over which a point is smoothed; by default the frame's constant softening"},
	{.name = "mollifier", .kind = PM_WORD, .choices = pm_mollifier_names, PM_AT(mollifier),
		.text = "how a point is smoothed; by default what the law names"},
	{.name = "loop", .kind = PM_WORD, .fallback = "half", .choices = loops, PM_AT(loop),
		.text = "each pair once by symmetry, or each target over all sources; equal to round-off"},
	{.name = "potential", .kind = PM_FLAG, PM_AT(potential), .text = "also the potential at each particle, without its own"},
	{.name = "set", .kind = PM_TEXT, .unit = "NAME", PM_AT(set), .text = "acts on this set only; every set with the strength remains a source"},
	{.name = "replace", .kind = PM_FLAG, PM_AT(replace), .text = "computes the term self anew where it is there already"},
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
		"the number of threads. Coincident particles without softening exert nothing on each other and are counted.",
	.kind = PM_FILTER,
	.makes = true,
	.reads = "x and the law's strength",
	.adds = "the law's change (acc, vel); with --potential its potential (phi, psi)",
	.config = sizeof(struct config),
	.options = options,
	.examples = examples,
	.declare = declare,
	.frame = frame,
};
