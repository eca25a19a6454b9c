/* spectrum: the spectrum of a field on a mesh in shells of wave numbers (lib/measure/mesh-spectrum.c). SPDX-License-Identifier: GPL-3.0-or-later */
#include <stdio.h>
#include <string.h>

#include "fft/fftw-plan.h"
#include "measure/spectrum-frame.h"
#include "stage/stage.h"

struct config {
	struct pm_spectrum_choice choice;
	const char *fit, *format;
};
struct state {
	double from, to; /* [1/length] of the fit */
	struct pm_fft_plans plans;
	struct pm_spectrum_source source;
	uint64_t frames;
};

static int begin(struct pm_stage *s)
{
	const struct config *c = s->config;
	struct state *state = s->state;
	int used = 0;
	state->from = state->to = NAN;
	if (c->fit && (sscanf(c->fit, "%lf:%lf%n", &state->from, &state->to, &used) != 2 || c->fit[used] ||
		!(state->from > 0 && state->to > state->from)))
		return pm_fail(PM_USAGE, "--fit '%s' (it is written K0:K1, 0 < K0 < K1)", c->fit);
	return 0;
}

static int declare(struct pm_stage *s, struct pm_frame *f)
{
	return pm_spectrum_declare(&((const struct config *)s->config)->choice, f, &((struct state *)s->state)->source);
}

static int frame(struct pm_stage *s, struct pm_frame *f)
{
	const struct config *c = s->config;
	struct state *state = s->state;
	const struct pm_spectrum_print print = {.out = stdout, .json = !strcmp(c->format, "json"), .head = !state->frames++,
		.from = state->from, .to = state->to};
	return pm_spectrum_frame(&c->choice, f, &state->source, &state->plans, &print);
}

static void release(struct pm_stage *s) { pm_fft_plans_clear(&((struct state *)s->state)->plans); }

static const char *const formats[] = {"tsv", "json", NULL};
static const struct pm_option options[] = {
	{.name = "field", .kind = PM_TEXT, .unit = "NAME", .cosmetic = true, PM_AT(choice.field),
		.text = "a scalar or vector on a mesh (default: the velocity of vortices, else the law's density)"},
	{.name = "mesh", .kind = PM_TEXT, .unit = "NAME", .cosmetic = true, PM_AT(choice.mesh), .text = "the mesh (default: the first that has the field)"},
	{.name = "shell", .kind = PM_REAL, .unit = "1/length", .low = 1e-60, .high = 1e60, .cosmetic = true, PM_AT(choice.shell),
		.text = "width of a shell (default: the wave number of the longest wave along the shortest axis)"},
	{.name = "fit", .kind = PM_TEXT, .unit = "K0:K1", .cosmetic = true, PM_AT(fit), .text = "fit a power of k between these wave numbers"},
	{.name = "contrast", .kind = PM_FLAG, .cosmetic = true, PM_AT(choice.contrast), .text = "divide by the mean: the spectrum of rho/mean - 1"},
	{.name = "format", .kind = PM_WORD, .fallback = "tsv", .choices = formats, .cosmetic = true, PM_AT(format),
		.text = "a line per shell, or an object per frame"},
	{0},
};

static const struct pm_example examples[] = {
	{"The noise of particles at random: power/volume is 1/n without the kernel's part",
		"pinit uniform -n 2000 --dim 3 --faces periodic | p2m --kernel tsc -n 16 | spectrum --contrast --fit 6:30"},
	{"The kinetic energy of a flow over its wave numbers", "pinit taylor-green-3d --cells 16 | p2m | poisson-fft | mgrad | spectrum --field u"},
	{"A picture of it", "pinit uniform -n 500 --dim 2 --faces periodic | p2m -n 32 | spectrum | splot power --x k --log -o power.png"},
	{0},
};

const struct pm_tool tool_spectrum = {
	.name = "spectrum",
	.summary = "the spectrum of a field on a mesh",
	.about = "u = sum over k of u^(k) exp(i k x). The columns are, for each shell of wave numbers, the mean |k|, the number of waves, energy = "
		"1/2 sum of |u^|^2 over the width of the shell (for a velocity the energy spectrum E(k)), power = volume of the box times the mean of "
		"|u^|^2 (P(k)), and the time. The sum of energy times width is half of the mean square about the mean, to rounding; a line behind the "
		"table says so. Axes that are not periodic have cosines, k = pi m/L. See docs/methods/spectrum.md.",
	.kind = PM_SINK,
	.reads = "a field on a mesh",
	.config = sizeof(struct config),
	.state = sizeof(struct state),
	.options = options,
	.examples = examples,
	.begin = begin,
	.declare = declare,
	.frame = frame,
	.free = release,
};
