/* ionise: atoms and ions that lose electrons in the electric field (lib/ionisation/field-ionisation.c). SPDX-License-Identifier: GPL-3.0-or-later */
#include <string.h>

#include "ionisation/field-ionisation.h"
#include "kernel/kernel.h"
#include "stage/stage.h"

struct config {
	const char *element, *electrons, *kernel, *mesh, *method;
	double mass, charge, electron_mass, time_unit, length_unit;
	int64_t seed;
};

static const char *const rates[] = {"adk-bsi", "adk", NULL};

static struct pm_field_ionisation ionisation_of(const struct pm_stage *s, const struct pm_frame *f)
{
	const struct config *o = s->config;
	return (struct pm_field_ionisation){.set = s->args[0], .electrons = o->electrons, .kernel = o->kernel, .mesh = o->mesh,
		.element = pm_element_find(o->element), .mass = o->mass, .charge = o->charge, .electron_mass = o->electron_mass, .time_unit = o->time_unit,
		.length_unit = o->length_unit, .suppressed = !strcmp(o->method, "adk-bsi"), .seed = pm_given(s, "seed") ? (uint64_t)o->seed : f->seed};
}

static int begin(struct pm_stage *s)
{
	const struct config *o = s->config;
	char known[256] = "";
	for (size_t k = 0; pm_element_at(k); k++)
		strncat(strcat(known, k ? " " : ""), pm_element_at(k)->symbol, 2);
	if (!o->element)
		return pm_fail(PM_USAGE, "atoms of which element? (--element, one of %s)", known);
	if (!pm_element_find(o->element))
		return pm_fail(PM_USAGE, "there are no ionisation energies of '%s' (%s)", o->element, known);
	if (!pm_given(s, "mass"))
		return pm_fail(PM_USAGE, "the mass of one neutral atom, which tells how many a particle stands for? (--mass, as it was given to species)");
	if (!pm_given(s, "time-unit"))
		return pm_fail(PM_USAGE, "how long is the frame's unit of time? Rates are per second (--time-unit SECONDS)");
	return o->charge < 0 ? 0 : pm_fail(PM_USAGE, "an electron of the charge %g (--electron-charge -1)", o->charge);
}

static int declare(struct pm_stage *s, struct pm_frame *f)
{
	const struct pm_field_ionisation g = ionisation_of(s, f);
	const int status = pm_field_ionise_declare(&g, f);
	return status < 0 ? status : status == PM_FIELD_IONISE_WAITS ? PM_PASS : PM_HOLD;
}

static int frame(struct pm_stage *s, struct pm_frame *f)
{
	const struct pm_field_ionisation g = ionisation_of(s, f);
	struct pm_field_ionised r;
	const int status = pm_field_ionise_step(&g, f, &r);
	if (status)
		return status;
	pm_report_count(s, f, "ionisations", r.electrons);
	pm_report_sum(s, f, "ionisation_energy", r.energy);
	pm_report(s, f, "strongest_field", r.strongest);
	if (r.outside)
		pm_report_count(s, f, "outside", r.outside);
	if (r.critical > 1 && !g.suppressed)
		pm_tell_once(s, "the field is %.3g times that from where the barrier is suppressed, and the rate of tunnelling is too large there "
			"(--method adk-bsi)", r.critical);
	return 0;
}

static const struct pm_option options[] = {
	{.name = "element", .kind = PM_TEXT, .unit = "SYMBOL", PM_AT(element), .text = "of the atoms: H to Ar, Kr, Xe"},
	{.name = "mass", .kind = PM_REAL, .unit = "mass", .low = 1e-300, .high = 1e300, PM_AT(mass), .text = "of one neutral atom"},
	{.name = "time-unit", .kind = PM_REAL, .unit = "s", .low = 1e-300, .high = 1e300, PM_AT(time_unit), .text = "the frame's unit of time, in seconds"},
	{.name = "length-unit", .kind = PM_REAL, .unit = "m", .low = 1e-300, .high = 1e300, PM_AT(length_unit),
		.text = "the frame's unit of length, in metres; by default from the constant c"},
	{.name = "method", .kind = PM_WORD, .fallback = "adk-bsi", .choices = rates, PM_AT(method),
		.text = "tunnelling (Ammosov, Delone, Krainov), and above the barrier that of Bauer and Mulser; or tunnelling alone"},
	{.name = "electrons", .kind = PM_TEXT, .unit = "NAME", .fallback = "electrons", PM_AT(electrons), .text = "the set to which electrons are added"},
	{.name = "electron-charge", .kind = PM_REAL, .unit = "charge", .fallback = "-1", .low = -1e300, .high = 1e300, PM_AT(charge),
		.text = "of one electron"},
	{.name = "electron-mass", .kind = PM_REAL, .unit = "mass", .fallback = "1", .low = 1e-300, .high = 1e300, PM_AT(electron_mass),
		.text = "of one electron"},
	{.name = "kernel", .letter = 'k', .kind = PM_WORD, .choices = pm_kernel_names, PM_AT(kernel),
		.text = "the interpolation kernel (default: that of the field)"},
	{.name = "mesh", .kind = PM_TEXT, .unit = "NAME", PM_AT(mesh), .text = "the mesh (default: the first that has the field)"},
	{.name = "seed", .kind = PM_INTEGER, .high = 9e15, PM_AT(seed), .text = "seed of the random numbers; by default the frame's"},
	{0},
};
static const struct pm_example examples[] = {
	{"hydrogen in a field of 0.06 atomic units, 3.1e10 V/m, for 10 fs", "pinit plasma --length 1 --cells 4 --background 0 --dt 1 | "
		"scalc --mesh mesh --role state 'E = 0.06' | species hydrogen -n 1000 --charge 0 --mass 1836 | species electrons -n 0 | "
		"cycle -n 10 'push drift | ionise hydrogen --element H --mass 1836 --time-unit 1e-15 --length-unit 9.0441e-8' | sls --report"},
	{0},
};
const struct pm_tool tool_ionise = {
	.name = "ionise",
	.summary = "atoms and ions lose electrons in the electric field of the mesh",
	.about = "Each ion loses its electrons one after the other at the rate of tunnelling in the field |E| at its place (ADK), and of a suppressed barrier "
		"in stronger fields, as many within a step as that rate gives. An electron has the place and the velocity of its ion, which loses its mass "
		"and charge, so the density of charge and the field stay as they are. It stands behind the drift, where the field is: push boris/2 | p2m "
		"--current | maxwell | push drift | ionise ... | m2p | push boris/2, or push kick/2 drift | p2m | poisson-fft | mgrad | ionise ... | m2p | "
		"push kick/2. Random numbers depend on seed, set, id (or index), step and charge, not on threads. Reports ionisations, their energy and the "
		"strongest field in V/m. See docs/methods/ionise.md.",
	.kind = PM_FILTER,
	.reads = "x, v, id, the electric field of the mesh",
	.changes = "mass and charge of the ions; x, v, mass, charge, id of the electrons",
	.config = sizeof(struct config),
	.options = options,
	.arguments = "SET",
	.arguments_text = "the atoms and ions",
	.least = 1,
	.most = 1,
	.examples = examples,
	.begin = begin,
	.declare = declare,
	.frame = frame,
};
