/* sample: the function that particles represent, at other points (lib/near/sample.c). SPDX-License-Identifier: GPL-3.0-or-later */
#include <stdlib.h>
#include <string.h>

#include "near/sample-frame.h"
#include "stage/stage.h"

struct config {
	struct pm_sample_choice choice;
	const char *order;
};

static int begin(struct pm_stage *s)
{
	struct config *o = s->config;
	o->choice.order = atoi(o->order);
	if (pm_given(s, "eps") && pm_given(s, "overlap"))
		return pm_fail(PM_USAGE, "--eps or --overlap, not both: either is the width");
	if (pm_given(s, "at") && pm_given(s, "mesh"))
		return pm_fail(PM_USAGE, "--at SET or --mesh NAME, not both: either are the points");
	if (!strcmp(o->choice.mollifier, "algebraic") && pm_given(s, "order") && o->choice.order != 4)
		return pm_fail(PM_USAGE, "the algebraic mollifier has order 4 (leave out --order)");
	if (strcmp(o->choice.correct, "none") && strcmp(o->choice.operator, "value"))
		return pm_fail(PM_USAGE, "--correct is of the value (leave out --operator)");
	if (!strcmp(o->choice.correct, "linear") && (o->choice.order != 2 || !strcmp(o->choice.mollifier, "algebraic")))
		return pm_fail(PM_USAGE, "--correct linear needs a mollifier without negative parts (the Gaussian of order 2; or --correct unity)");
	return 0;
}

static int declare(struct pm_stage *s, struct pm_frame *f) { return pm_sample_declare(&((const struct config *)s->config)->choice, f); }

static int frame(struct pm_stage *s, struct pm_frame *f)
{
	struct pm_sample_found found;
	int status = pm_sample_apply(&((const struct config *)s->config)->choice, f, &found);
	if (!status)
		pm_report(s, f, "eps", found.eps);
	if (!status && found.bare) {
		pm_report_count(s, f, "bare", found.bare);
		pm_say(s, "%zu points have hardly a particle in reach (volumes that sum to less than 0.02) and are not corrected", found.bare);
	}
	return status;
}

static const char *const orders[] = {"2", "4", NULL};
static const struct pm_option options[] = {
	{.name = "field", .kind = PM_TEXT, .unit = "NAME", PM_AT(choice.field),
		.text = "a strength, or a value of particles with volumes (default: the law's strength)"},
	{.name = "set", .kind = PM_TEXT, .unit = "NAME", PM_AT(choice.set), .text = "the particles (default: the first set that has the field)"},
	{.name = "mesh", .kind = PM_TEXT, .unit = "NAME", PM_AT(choice.mesh), .text = "at the nodes of this mesh (default: the first)"},
	{.name = "at", .kind = PM_TEXT, .unit = "NAME", PM_AT(choice.at),
		.text = "at the particles of this set instead: a line, a probe, the particles themselves"},
	{.name = "target", .kind = PM_TEXT, .unit = "NAME", .fallback = "sampled", PM_AT(choice.target), .text = "the field to make there"},
	{.name = "operator", .kind = PM_WORD, .fallback = "value", .choices = pm_sample_operator_names, PM_AT(choice.operator),
		.text = "the function, its gradient or its Laplacian"},
	{.name = "mollifier", .kind = PM_WORD, .fallback = "gaussian", .choices = pm_sample_kind_names, PM_AT(choice.mollifier),
		.text = "exp(-r^2/(2 eps^2)), or a rational function without exponentials"},
	{.name = "correct", .kind = PM_WORD, .fallback = "none", .choices = pm_sample_correction_names, PM_AT(choice.correct),
		.text = "at an open rim and between irregular particles: unity divides by the sum of the volumes, so that a constant stays (Shepard 1968); "
			"linear is exact for linear functions (reproducing kernels, Liu, Jun and Zhang 1995)"},
	{.name = "order", .kind = PM_WORD, .fallback = "2", .choices = orders, PM_AT(order),
		.text = "of the Gaussian: the error is eps^2, or eps^4 with negative parts; the algebraic one has 4"},
	{.name = "eps", .kind = PM_REAL, .unit = "length", .low = 1e-60, .high = 1e60, PM_AT(choice.eps), .text = "width (default: from --overlap)"},
	{.name = "overlap", .kind = PM_REAL, .low = 0.01, .high = 100, PM_AT(choice.overlap),
		.text = "width over the spacing of the particles, (mean volume)^(1/dim) (default: 1.5, algebraic 3); below 1 the function has holes"},
	{.name = "cutoff", .kind = PM_REAL, .unit = "eps", .low = 0.1, .high = 1000, PM_AT(choice.cutoff),
		.text = "reach of the mollifier (default: 8.5, of order 4 9, algebraic 40)"},
	{0},
};

static const struct pm_example examples[] = {
	{"the vorticity of the vortices on the mesh, smoothed", "pinit cone-vortex --cells 32 | sample | sls"},
	{"and its Laplacian at the vortices themselves", "pinit cone-vortex --cells 32 | sample --at vortices --operator lap --order 4 --target lap | sls"},
	{0},
};

const struct pm_tool tool_sample = {
	.name = "sample",
	.summary = "the function that particles represent, at the nodes of a mesh or at other particles",
	.about = "u(x) = sum over particles of strength * zeta_eps(x - x_p), its gradient or Laplacian, with a mollifier zeta of width eps: smooth, defined "
		"everywhere, of order 2 or 4 in eps where eps is larger than the spacing of the particles. Periodic faces repeat the particles, walls have odd "
		"images, neumann faces even ones; beyond open faces there is nothing. p2m is faster and as smooth as its kernel. See docs/methods/sample.md.",
	.kind = PM_FILTER,
	.makes = true,
	.reads = "x, a strength or value, volume",
	.adds = "sampled (mesh, or the set --at)",
	.config = sizeof(struct config),
	.options = options,
	.examples = examples,
	.begin = begin,
	.declare = declare,
	.frame = frame,
};
