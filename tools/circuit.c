/* circuit: what is between the electrodes outside of a plasma (lib/circuit). SPDX-License-Identifier: GPL-3.0-or-later */
#include <string.h>

#include "circuit/circuit.h"
#include "stage/stage.h"

struct config {
	const char *at, *voltage, *current;
	double resistance, inductance, capacitance;
};

static const char *const places[] = {"x-low", "x-high", NULL};

static int begin(struct pm_stage *s)
{
	const struct config *o = s->config;
	if (o->current && (o->voltage || pm_given(s, "resistance") || pm_given(s, "inductance") || pm_given(s, "capacitance")))
		return pm_fail(PM_USAGE, "--current-source is all that passes: without --voltage, --resistance, --inductance and --capacitance");
	return 0;
}

static struct pm_circuit circuit_of(const struct config *o)
{
	return (struct pm_circuit){.side = !strcmp(o->at, "x-high"), .resistance = o->resistance, .inductance = o->inductance,
		.capacitance = isfinite(o->capacitance) ? o->capacitance : HUGE_VAL, .voltage = o->voltage ? o->voltage : "0", .current = o->current};
}

static int declare(struct pm_stage *s, struct pm_frame *f)
{
	const struct pm_circuit c = circuit_of(s->config);
	const int status = pm_circuit_declare(&c, f);
	return status < 0 ? status : status ? PM_HOLD : PM_PASS;
}

static int frame(struct pm_stage *s, struct pm_frame *f)
{
	const struct pm_circuit c = circuit_of(s->config);
	struct pm_circuit_state r;
	const int status = pm_circuit_step(&c, f, &r);
	if (status)
		return status;
	pm_report(s, f, "potential", r.potential);
	pm_report(s, f, "current", r.current);
	pm_report(s, f, "charge", r.charge);
	return 0;
}

static const struct pm_option options[] = {
	{.name = "at", .kind = PM_WORD, .fallback = "x-low", .choices = places, PM_AT(at), .text = "the electrode that is driven; the other is at ground"},
	{.name = "voltage", .kind = PM_TEXT, .unit = "EXPRESSION", PM_AT(voltage), .text = "of the source, in time and the frame's constants (default: 0)"},
	{.name = "current-source", .kind = PM_TEXT, .unit = "EXPRESSION", PM_AT(current), 
		.text = "current that flows into the electrode, in place of all else"},
	{.name = "resistance", .letter = 'R', .kind = PM_REAL, .fallback = "0", .low = 0, .high = 1e300, PM_AT(resistance), .text = "in series"},
	{.name = "inductance", .letter = 'L', .kind = PM_REAL, .fallback = "0", .low = 0, .high = 1e300, PM_AT(inductance), .text = "in series"},
	{.name = "capacitance", .letter = 'C', .kind = PM_REAL, .low = 1e-300, .high = 1e300, PM_AT(capacitance), .text = "in series (default: a wire)"},
	{0},
};
static const struct pm_example examples[] = {
	{"a diode behind a resistor", "pinit plasma --background 0 | smod --faces neumann,wall --particle-faces absorb --constant charge_x_low=0 | "
		"species electrons -n 0 | cycle -n 40 'push kick/2 drift | inject electrons --density 0.1 -n 50 | circuit --voltage -5 -R 10 | p2m | "
		"poisson-fft --x-low charge_x_low/eps0 | mgrad | m2p | push kick/2' | sls --report"},
	{0},
};
const struct pm_tool tool_circuit = {
	.name = "circuit",
	.summary = "drive the electrode of a plasma in 1-D through R, L and C in series",
	.about = "L I' + R I + q/C + phi = V(t), I = q', for electrodes of area 1, together with the field of the particles, so that the circuit limits no "
		"step. The electrode is a face neumann whose charge is the constant charge_x_low (or charge_x_high) of the frame: push adds what it collects, "
		"inject takes away what it emits, circuit adds I dt; the solver takes it as --x-low charge_x_low/eps0. The opposite face is a wall at "
		"ground. It stands behind the drift, and behind inject. Its state are the constants circuit_charge and circuit_current. Without this word "
		"the electrode floats. Reports potential, current and charge. See docs/methods/circuit.md.",
	.kind = PM_FILTER,
	.reads = "x, charge",
	.changes = "constants charge_x_low, circuit_charge, circuit_current",
	.config = sizeof(struct config),
	.options = options,
	.examples = examples,
	.begin = begin,
	.declare = declare,
	.frame = frame,
};
