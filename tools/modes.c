/* modes: growth, frequency and shape of the linear modes of a sentence (lib/modes/modes.c). SPDX-License-Identifier: GPL-3.0-or-later */
#include <math.h>
#include <string.h>

#include "modes/modes.h"
#include "stage/stage.h"

struct config {
	struct pm_modes_choice choice;
	int64_t mode, count;
	bool table;
};

static int begin(struct pm_stage *s)
{
	const struct config *c = s->config;
	s->kind = c->table ? PM_SINK : PM_FILTER;
	return c->table && pm_given(s, "mode") ? pm_fail(PM_USAGE, "--mode chooses the mode that is written, and --table writes none") : 0;
}

/* Reads all data. */
static int declare(struct pm_stage *s, struct pm_frame *f)
{
	(void)s;
	for (size_t i = 0; i < f->nfields; i++)
		if (!pm_reads(f, f->fields[i]->on, f->fields[i]->name))
			return -PM_DATA;
	return PM_HOLD;
}

static void print(const struct pm_modes *m, const struct config *c)
{
	printf("mode\tgrowth\t+-\tfrequency\tgrowth_rate\tangular_frequency\tunstable\n");
	for (int k = 0; k < m->found.values && k < c->count; k++) {
		const struct pm_mode mode = pm_modes_mode(m, &c->choice, k);
		printf("%d\t%.8g\t%.2g\t%.8g\t%.8g\t%.8g\t%s\n", k + 1, mode.growth, mode.error, mode.frequency, mode.growth / m->dt, mode.frequency / m->dt,
			mode.unstable ? "yes" : "no");
	}
}

static void report(const struct pm_stage *s, struct pm_frame *f, const struct pm_modes *m, const struct pm_mode *mode, int k)
{
	pm_report(s, f, "mode", k + 1);
	if (isfinite(mode->growth))
		pm_report(s, f, "growth_per_step", mode->growth);
	pm_report(s, f, "growth_error", mode->error);
	pm_report(s, f, "frequency_per_step", mode->frequency);
	pm_report(s, f, "unstable", mode->unstable);
	pm_report(s, f, "moves", m->moves);
	pm_report(s, f, "vectors", m->found.vectors);
}

/* The sign of its growth is not known. */
static void tell(const struct pm_stage *s, const struct pm_modes *m, const struct config *c, int k)
{
	const struct pm_mode mode = pm_modes_mode(m, &c->choice, k);
	if (mode.error > c->choice.neutral)
		pm_note(s, "mode %d is not converged: after %d vectors its growth is %.2g +- %.2g a step (more --vectors)", k + 1, m->found.vectors,
			mode.growth, mode.error);
}

static int frame(struct pm_stage *s, struct pm_frame *f)
{
	const struct config *c = s->config;
	struct pm_modes m;
	int status = pm_modes_run(&m, f, s->args[0], &c->choice);
	const int k = (int)c->mode - 1;
	if (!status && !c->table && k >= m.found.values)
		status = pm_fail(PM_USAGE, "--mode %d: there are %d modes", k + 1, m.found.values);
	if (!status && m.found.values)
		tell(s, &m, c, c->table ? 0 : k);
	if (!status && c->table)
		print(&m, c);
	if (!status && !c->table) {
		const struct pm_mode mode = pm_modes_mode(&m, &c->choice, k);
		report(s, f, &m, &mode, k);
		status = pm_modes_fields(&m, k, f);
	}
	pm_modes_free(&m);
	return status;
}

static const struct pm_option options[] = {
	{.name = "table", .kind = PM_FLAG, PM_AT(table), .text = "print growth and frequency of the modes instead of writing the stream"},
	{.name = "count", .letter = 'k', .kind = PM_INTEGER, .unit = "modes", .fallback = "6", .low = 1, .high = 1000, PM_AT(count),
		.text = "with --table: how many modes"},
	{.name = "mode", .kind = PM_INTEGER, .fallback = "1", .low = 1, .high = 1000, PM_AT(mode),
		.text = "the mode that is written; 1 grows fastest"},
	{.name = "steps", .letter = 'n', .kind = PM_INTEGER, .unit = "steps", .fallback = "1", .low = 1, .high = 1e9, PM_AT(choice.steps),
		.text = "the map is this many steps: for a state that is periodic, those of its period"},
	{.name = "vectors", .kind = PM_INTEGER, .unit = "vectors", .fallback = "80", .low = 2, .high = 2000, PM_AT(choice.vectors),
		.text = "at most so many vectors; each takes two runs of the map"},
	{.name = "tolerance", .kind = PM_REAL, .fallback = "1e-6", .low = 1e-12, .high = 1, PM_AT(choice.tolerance),
		.text = "stop when the residual of the leading mode is below this, relative to |lambda|"},
	{.name = "displacement", .kind = PM_REAL, .fallback = "1e-5", .low = 1e-12, .high = 1, PM_AT(choice.displacement),
		.text = "how far the finite differences move the state, relative to the mean distance of particles"},
	{.name = "neutral", .kind = PM_REAL, .fallback = "3e-4", .low = 0, .high = 1, PM_AT(choice.neutral),
		.text = "a growth per step below this counts as none"},
	{.name = "moving", .kind = PM_FLAG, PM_AT(choice.moving), .text = "also where the frame is no equilibrium: the modes of these steps alone"},
	{.name = "seed", .kind = PM_INTEGER, .fallback = "1", .high = 9e15, PM_AT(choice.seed), .text = "seed of the first vector"},
	{0},
};

static const struct pm_example examples[] = {
	{"a leapfrog beyond its limit: a spring with omega dt = 2.1 grows by arcosh(1.205) = 0.63 a step",
		"printf 'x vx\\n0 0\\n' | stab - --law free | modes --table 'push --unsafe --dt 2.1 kick/2 drift | field acc=-x | push --unsafe kick/2'"},
	{"the wave that a large step makes grow in a plasma at rest, drawn",
		"pinit langmuir -n 128 --cells 32 --amplitude 0 | modes 'push --unsafe --dt 2.05 kick/2 drift | p2m | poisson-fft | mgrad | m2p | push "
		"--unsafe kick/2' | stab --plain | splot -x x mode_x -o mode.svg"},
	{0},
};

const struct pm_tool tool_modes = {
	.name = "modes",
	.summary = "growth, frequency and shape of the linear modes of a sentence",
	.about = "The state is moved a little in many directions, the sentence runs one step (or -n) on each, and Arnoldi's iteration gives the eigenvalues "
		"lambda of that linear map. A mode grows by ln|lambda| per step and turns by arg(lambda). The stream goes on with the fields mode_x, "
		"mode_v ... of one mode "
		"(and mode_x_imaginary), the largest displacement 1, and with growth_per_step in its report, by which margin finds limits. The "
		"frame must be an equilibrium, or return to itself after -n steps.",
	.kind = PM_FILTER,
	.reads = "everything",
	.adds = "mode_x, mode_v ...",
	.config = sizeof(struct config),
	.options = options,
	.arguments = "SENTENCE",
	.arguments_text = "the stages of one step, as for cycle",
	.least = 1,
	.most = 1,
	.examples = examples,
	.begin = begin,
	.declare = declare,
	.frame = frame,
};
