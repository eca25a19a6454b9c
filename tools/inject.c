/* inject: particles that come in during every step, at a face or in the volume (lib/load/injection.c). SPDX-License-Identifier: GPL-3.0-or-later */
#include <string.h>

#include "load/injection.h"
#include "stage/stage.h"

struct config {
	const char *at, *share;
	double number, weight, density, flux, charge, mass, vth, velocities;
	int64_t seed;
	struct pm_vector widths, drift;
};

static const char *const places[] = {"x-low", "x-high", "y-low", "y-high", "z-low", "z-high", "volume", NULL};

static int begin(struct pm_stage *s)
{
	const struct config *o = s->config;
	const bool volume = !strcmp(o->at, "volume");
	if (pm_given(s, "density") == pm_given(s, "influx"))
		return pm_fail(PM_USAGE, "--density of the plasma beyond the face, or --influx%s", pm_given(s, "influx") ? ", not both" : "");
	if (volume && pm_given(s, "density"))
		return pm_fail(PM_USAGE, "--density is of what is beyond a face; in the volume it is --influx, per volume and time");
	if (pm_given(s, "per-step") && pm_given(s, "statistical-weight"))
		return pm_fail(PM_USAGE, "-n particles a step or -w, not both: each follows from the other");
	return o->widths.n && pm_given(s, "vth") ? pm_fail(PM_USAGE, "--vth or --widths, not both") : 0;
}

static int injection_of(const struct pm_stage *s, const struct pm_frame *f, struct pm_injection *p)
{
	const struct config *o = s->config;
	const struct pm_field *v = pm_frame_field(f, s->args[0], "v");
	int place = 0;
	while (strcmp(o->at, places[place]))
		place++;
	*p = (struct pm_injection){.set = s->args[0], .axis = place < 6 ? place / 2 : -1, .side = place % 2, .charge = o->charge, .mass = o->mass,
		.density = o->density, .flux = o->flux, .weight = o->weight, .number = o->number, .share = o->share,
		.seed = pm_given(s, "seed") ? (uint64_t)o->seed : f->seed, .velocities = v ? v->components : o->velocities > 0 ? (int)o->velocities : f->dim};
	if (o->velocities > 0 && (o->velocities != p->velocities || p->velocities < f->dim))
		return pm_fail(PM_USAGE, "--velocities %g is not the number of components of v, %d", o->velocities, v ? v->components : f->dim);
	if (o->widths.n > p->velocities || o->drift.n > p->velocities)
		return pm_fail(PM_USAGE, "--%s has more numbers than v has components, %d", o->drift.n > p->velocities ? "drift" : "widths", p->velocities);
	for (int d = 0; d < 3; d++) {
		p->drift[d] = d < o->drift.n ? o->drift.x[d] : 0;
		p->vth[d] = o->widths.n ? d < o->widths.n ? o->widths.x[d] : 0 : o->vth;
		if (p->vth[d] < 0)
			return pm_fail(PM_USAGE, "--widths %g is negative", p->vth[d]);
	}
	return 0;
}

static int declare(struct pm_stage *s, struct pm_frame *f)
{
	struct pm_injection p;
	int status = injection_of(s, f, &p);
	status = status ? status : pm_injection_declare(&p, f);
	return status < 0 ? status : status == PM_INJECTION_WAITS ? PM_PASS : PM_HOLD;
}

static int frame(struct pm_stage *s, struct pm_frame *f)
{
	struct pm_injection p;
	uint64_t came = 0;
	int status = injection_of(s, f, &p);
	status = status ? status : pm_injection_step(&p, f, &came);
	if (status)
		return status;
	pm_report_count(s, f, "injected", came);
	pm_report_sum(s, f, "given_charge", (double)came * p.charge * p.weight);
	pm_report_sum(s, f, "given_mass", (double)came * p.mass * p.weight);
	return 0;
}

static const struct pm_option options[] = {
	{.name = "at", .kind = PM_WORD, .fallback = "x-low", .choices = places, PM_AT(at), .text = "the face through which particles come, or the whole box"},
	{.name = "density", .kind = PM_REAL, .unit = "1/volume", .low = 0, .high = 1e300, PM_AT(density),
		.text = "real particles per volume of the Maxwellian beyond the face, of which the half that moves inward comes in"},
	{.name = "influx", .kind = PM_REAL, .unit = "1/(area time)", .low = 0, .high = 1e300, PM_AT(flux),
		.text = "real particles that come in; with --at volume per volume and time"},
	{.name = "vth", .kind = PM_REAL, .unit = "length/time", .fallback = "1", .low = 0, .high = 1e300, PM_AT(vth),
		.text = "standard deviation of each component of v of that Maxwellian, sqrt(T/m)"},
	{.name = "widths", .kind = PM_VECTOR, .unit = "length/time", PM_AT(widths), .text = "that of the components one by one, in place of --vth"},
	{.name = "drift", .kind = PM_VECTOR, .unit = "length/time", PM_AT(drift), .text = "its mean velocity, from the first component on (default: 0)"},
	{.name = "charge", .kind = PM_REAL, .unit = "charge", .fallback = "-1", .low = -1e300, .high = 1e300, PM_AT(charge), .text = "of one real particle"},
	{.name = "mass", .kind = PM_REAL, .unit = "mass", .fallback = "1", .low = 1e-300, .high = 1e300, PM_AT(mass), .text = "of one real particle"},
	{.name = "per-step", .letter = 'n', .kind = PM_REAL, .low = 1e-9, .high = 1e9, PM_AT(number), .text = "particles a step, in the mean"},
	{.name = "statistical-weight", .letter = 'w', .kind = PM_REAL, .low = 1e-300, .high = 1e300, PM_AT(weight),
		.text = "real particles for which one stands; by default as those that are there, if all are equal"},
	{.name = "share", .kind = PM_TEXT, .unit = "EXPRESSION", PM_AT(share),
		.text = "part of them that comes in, 0 to 1, in x, y, z, time and the frame's constants ('abs(y-6) < 1': a slit)"},
	{.name = "velocities", .kind = PM_REAL, .low = 1, .high = 3, PM_AT(velocities), .text = "components of v of a set that is made here"},
	{.name = "seed", .kind = PM_INTEGER, .high = 9e15, PM_AT(seed), .text = "seed of the random numbers; by default the frame's"},
	{0},
};
static const struct pm_example examples[] = {
	{"a cathode and an absorbing anode", "pinit plasma --background 0 | smod --faces wall --particle-faces absorb | species electrons -n 0 | "
		"cycle -n 20 'push kick/2 drift | inject electrons --density 0.1 -n 50 | p2m | poisson-fft --x-high 5 | mgrad | m2p | push kick/2' | sls"},
	{"a beam through a slit", "pinit plasma --dim 2 --background 0 | smod --faces wall --particle-faces absorb | "
		"inject electrons --density 0.1 --drift 5 --vth 0.1 -n 500 --share 'abs(y-6) < 1' | sls --report"},
	{0},
};
const struct pm_tool tool_inject = {
	.name = "inject",
	.summary = "let particles come in at a face of the box, or in its volume, in every step",
	.about = "Through a face comes the half of a drifting Maxwellian that moves inward (normal velocities have the density v f(v)), each particle at a "
		"random moment of the step. It stands behind the drift (push kick/2 drift | inject | p2m ...) or behind the last push, "
		"with light in front of p2m --current, and acts once a "
		"step. Numbers and random numbers depend on seed, set, face and step: not on threads, and a run that was interrupted goes on with the same "
		"particles. A face with a constant charge_x_low (charge_x_high, ...) is an electrode: the charge that comes in is taken from it. Reports "
		"injected, given_charge and given_mass. See docs/methods/inject.md.",
	.kind = PM_FILTER,
	.changes = "x, v, mass, charge, id",
	.adds = "the set, if it is missing between steps",
	.config = sizeof(struct config),
	.options = options,
	.arguments = "SET",
	.arguments_text = "the set that grows",
	.least = 1,
	.most = 1,
	.examples = examples,
	.begin = begin,
	.declare = declare,
	.frame = frame,
};
