/* dispersion: the waves of a saved run by wave number and frequency, beside the dispersion relation of its species (lib/measure/wave-spectrum.c).
 * SPDX-License-Identifier: GPL-3.0-or-later */
#include "law/law.h"
#include "measure/wave-spectrum.h"
#include "picture/view.h"
#include "stage/stage.h"
#include "stream/wire.h"

struct config {
	int64_t waves;
	bool map;
	double lowest, highest;
	const char *component;
};
struct state {
	struct pm_wave_spectrum spectrum;
};

static struct pm_measure how_of(const struct pm_stage *s, const struct pm_frame *f)
{
	const struct config *o = s->config;
	const struct pm_law *law = pm_law_of(f);
	return law ? (struct pm_measure){.field = law->field, .potential = law->potential, .wave = o->component ? pm_view_component(o->component) : law->wave}
		: (struct pm_measure){.field = NULL};
}

static int begin(struct pm_stage *s)
{
	const struct config *o = s->config;
	((struct state *)s->state)->spectrum.modes = (int)o->waves;
	s->kind = o->map ? PM_FILTER : PM_SINK;
	s->leaves_out = true;
	if (o->component && (pm_view_component(o->component) < 0 || pm_view_component(o->component) > 2))
		return pm_fail(PM_USAGE, "--component '%s' is none of x, y, z", o->component);
	return o->map && o->waves < 2 ? pm_fail(PM_USAGE, "a mesh needs two waves at least (--waves 2)") : 0;
}

static int declare(struct pm_stage *s, struct pm_frame *f)
{
	const struct pm_measure how = how_of(s, f);
	const int status = f->substep ? pm_fail(PM_DATA, "frames inside a step have fields and times of different instants (cycle writes whole steps)")
		: pm_wave_reads(&how, f);
	return status ? status : s->kind == PM_FILTER ? PM_HOLD : 0;
}

static int frame(struct pm_stage *s, struct pm_frame *f)
{
	const struct pm_measure how = how_of(s, f);
	int status = pm_wave_add(&((struct state *)s->state)->spectrum, &how, f);
	return status ? status : s->kind == PM_FILTER ? PM_SKIP : 0;
}

static int flush(struct pm_stage *s, struct pm_writer *w)
{
	struct pm_wave_spectrum *spectrum = &((struct state *)s->state)->spectrum;
	if (!spectrum->n || pm_wave_done(spectrum))
		return spectrum->n ? -PM_DATA : 0;
	struct pm_frame *f = pm_wave_frame(spectrum, ((const struct config *)s->config)->highest);
	int status = f ? pm_write_frame(w, f) : -PM_DATA;
	pm_frame_free(f);
	return status;
}

static int end(struct pm_stage *s)
{
	struct pm_wave_spectrum *spectrum = &((struct state *)s->state)->spectrum;
	if (s->kind == PM_FILTER || !spectrum->n)
		return 0;
	if (pm_wave_done(spectrum))
		return -PM_DATA;
	if (spectrum->theory.why[0])
		pm_note(s, "no theory: %s", spectrum->theory.why);
	else if (spectrum->theory.kind != PM_ELECTROSTATIC) /* what is expected where nothing is said */
		pm_note(s, "theory: %s", pm_wave_theory_name(&spectrum->theory));
	const struct config *o = s->config;
	pm_wave_print(spectrum, (const double[2]){o->lowest, o->highest}, stdout);
	return 0;
}

static void release(struct pm_stage *s) { pm_wave_free(&((struct state *)s->state)->spectrum); }

static const struct pm_option options[] = {
	{.name = "waves", .letter = 'n', .kind = PM_INTEGER, .fallback = "16", .low = 1, .high = 1e5, PM_AT(waves),
		.text = "waves in the box along x: 1 to this"},
	{.name = "component", .kind = PM_TEXT, .unit = "x|y|z|NUMBER", PM_AT(component),
		.text = "component of the field (default: x, of light and of flows y)"},
	{.name = "as-mesh", .kind = PM_FLAG, PM_AT(map),
		.text = "write a frame of the mesh `waves` with the axes k and omega, for sdraw, in place of the table"},
	{.name = "lowest", .kind = PM_REAL, .unit = "1/time", .fallback = "0", .low = 0, .high = 1e300, PM_AT(lowest),
		.text = "lowest omega that is looked at in the table (for waves above what stands still)"},
	{.name = "highest", .kind = PM_REAL, .unit = "1/time", .fallback = "1e300", .low = 0, .high = 1e300, PM_AT(highest),
		.text = "highest omega that is looked at, in the table and the map (default: all; for slow waves beside fast ones)"},
	{0},
};

static const struct pm_example examples[] = {
	{"frequencies of the thermal noise of a plasma beside theory", "pinit plasma --length 30 | species electrons -n 4000 --loading random | "
		"cycle -q -n 400 --every 4 'push kick/2 drift | p2m | poisson-fft | mgrad | m2p | push kick/2' | dispersion -n 4"},
	{"a map of them", "pinit plasma --length 30 | species electrons -n 2000 --loading random | cycle -q -n 200 --every 2 'push kick/2 drift | p2m | "
		"poisson-fft | mgrad | m2p | push kick/2' | dispersion --as-mesh --highest 3 | sdraw --field log_power -o waves.png"},
	{0},
};

const struct pm_tool tool_dispersion = {
	.name = "dispersion",
	.summary = "waves of a saved run by wave number and frequency, beside the dispersion relation of its species",
	.about = "Reads all frames of a run, which must be equally spaced in time, and takes the waves along x of the law's field apart in time, under "
		"Hann's window. The table has for every wave number the frequency of the largest power, the resolution 2 pi/T, that power, and the nearest "
		"root omega + i gamma of the dispersion relation of Maxwellian species, of electrostatic waves or of light, with or without a uniform magnetic "
		"field along x or across it: each set counts as one, with its plasma frequency, drift and width in the first frame. See "
		"docs/methods/dispersion.md.",
	.kind = PM_SINK,
	.reads = "the law's field or potential on a mesh; v, mass, charge, bfield, B",
	.config = sizeof(struct config),
	.state = sizeof(struct state),
	.options = options,
	.examples = examples,
	.begin = begin,
	.declare = declare,
	.frame = frame,
	.flush = flush,
	.end = end,
	.free = release,
};
