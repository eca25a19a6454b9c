/* neutrals: collisions of a species with a gas of neutral atoms (lib/collide/neutral-gas.c). SPDX-License-Identifier: GPL-3.0-or-later */
#include "collide/neutral-gas.h"
#include "stage/stage.h"

struct config {
	const char *set, *ions;
	double density, mass, gas_mass, vth;
	struct pm_vector drift;
	int64_t seed;
};

struct state {
	struct pm_cross_section table[PM_GAS_PROCESSES]; /* of @FILE */
};

static int gas_of(const struct pm_stage *s, const struct pm_frame *f, struct pm_gas *g)
{
	const struct config *o = s->config;
	const struct state *state = s->state;
	*g = (struct pm_gas){.set = o->set, .ions = o->ions, .mass = o->mass, .gas_mass = o->gas_mass, .density = o->density, .vth = o->vth, .n = s->nargs,
		.seed = f && !pm_given(s, "seed") ? f->seed : (uint64_t)o->seed};
	for (int c = 0; c < 3; c++)
		g->drift[c] = c < o->drift.n ? o->drift.x[c] : 0;
	int status = 0;
	for (int k = 0; k < s->nargs && !status; k++) {
		status = pm_gas_process_of(s->args[k], &g->process[k]);
		g->process[k].table = state->table[k];
	}
	return status;
}

static int begin(struct pm_stage *s)
{
	struct pm_gas g;
	if (!pm_given(s, "density"))
		return pm_fail(PM_USAGE, "how dense is the gas? (--density atoms per volume)");
	int status = gas_of(s, NULL, &g);
	for (int k = 0; k < s->nargs && !status; k++) {
		const char *file = pm_gas_file_of(g.process[k].section);
		status = file ? pm_cross_section_read(&((struct state *)s->state)->table[k], file) : 0;
	}
	return status;
}

static int declare(struct pm_stage *s, struct pm_frame *f)
{
	struct pm_gas g;
	int status = gas_of(s, f, &g);
	status = status ? status : pm_gas_declare(&g, f);
	return status < 0 ? status : status == PM_GAS_WAITS ? PM_PASS : g.ions ? PM_HOLD : 0;
}

static int frame(struct pm_stage *s, struct pm_frame *f)
{
	const struct config *o = s->config;
	struct pm_gas g;
	struct pm_gas_record r;
	int status = gas_of(s, f, &g);
	status = status ? status : pm_gas_step(&g, f, &r);
	if (status)
		return status;
	pm_report_count(s, f, "collisions", r.collisions);
	pm_report(s, f, "probability", r.most);
	if (o->ions) {
		pm_report_count(s, f, "ionisations", r.pairs);
		pm_report_sum(s, f, "given_mass", r.given_mass);
	}
	if (r.most > 0.2)
		pm_tell_once(s, "a particle collides with the probability %.2g in a step, and more than once is left out (a shorter dt)", r.most);
	return 0;
}

static void done(struct pm_stage *s)
{
	for (int k = 0; k < PM_GAS_PROCESSES; k++)
		pm_cross_section_free(&((struct state *)s->state)->table[k]);
}

static const struct pm_option options[] = {
	{.name = "set", .kind = PM_TEXT, .unit = "NAME", .fallback = "electrons", PM_AT(set), .text = "the particles that collide"},
	{.name = "ions", .kind = PM_TEXT, .unit = "NAME", PM_AT(ions), .text = "the set to which 'ionise' adds"},
	{.name = "density", .kind = PM_REAL, .unit = "1/volume", .low = 0, .high = 1e300, PM_AT(density), .text = "atoms per volume"},
	{.name = "mass", .kind = PM_REAL, .unit = "mass", .fallback = "1", .low = 1e-300, .high = 1e300, PM_AT(mass), .text = "of one real particle"},
	{.name = "gas-mass", .kind = PM_REAL, .unit = "mass", .fallback = "1836", .low = 1e-300, .high = 1e300, PM_AT(gas_mass), .text = "of one atom"},
	{.name = "vth", .kind = PM_REAL, .unit = "length/time", .fallback = "0", .low = 0, .high = 1e300, PM_AT(vth),
		.text = "standard deviation of each component of the velocity of the atoms"},
	{.name = "drift", .kind = PM_VECTOR, .unit = "length/time", PM_AT(drift), .text = "their mean velocity (default: 0)"},
	{.name = "seed", .kind = PM_INTEGER, .high = 9e15, PM_AT(seed), .text = "seed of the random numbers; by default the frame's"},
	{0},
};
static const struct pm_example examples[] = {
	{"electrons that lose their direction at a constant rate of 0.1", "pinit plasma | species electrons -n 2000 --velocities 3 --drift 2 --vth 0.1 | "
		"cycle -n 50 \"push drift | neutrals --density 0.1 'elastic: 1/g'\" | sls --report"},
	{"ions that exchange their charge with a cold gas of their own mass", "pinit plasma | species ions -n 2000 --velocities 3 --charge 1 | "
		"cycle -n 50 \"push drift | neutrals --set ions --gas-mass 1 --density 0.1 --vth 0.05 'elastic: 0.5' 'exchange: 1'\" | sls --report"},
	{0},
};
const struct pm_tool tool_neutrals = {
	.name = "neutrals",
	.summary = "collisions of particles with a gas of neutral atoms",
	.about = "Each PROCESS is KIND: CROSS-SECTION, an expression in the relative speed g, the energy m M/(m + M) g^2/2 and the frame's constants, or "
		"@FILE, a table of energy and cross-section, linear between its rows. elastic "
		"turns the relative velocity to any direction; exchange gives the particle the velocity of the atom; 'excite E' does as elastic and takes E "
		"of the energy; 'ionise E' shares what is left above E equally with a second particle like it, and adds an ion to the set --ions. "
		"The probability in a step is 1 - exp(-n sigma g dt) for an atom drawn from the gas, which stays as it is. It stands behind the last push, "
		"with ionise behind the drift, once a step. v needs 3 components. Random numbers depend on seed, set, id (or index) and step, not on "
		"threads. Reports collisions, the largest probability and ionisations. See docs/methods/neutrals.md.",
	.kind = PM_FILTER,
	.reads = "id",
	.changes = "v",
	.config = sizeof(struct config),
	.state = sizeof(struct state),
	.options = options,
	.arguments = "PROCESS...",
	.arguments_text = "'elastic: SIGMA', 'exchange: SIGMA', 'excite ENERGY: SIGMA', 'ionise ENERGY: SIGMA'",
	.least = 1,
	.most = PM_GAS_PROCESSES,
	.examples = examples,
	.begin = begin,
	.declare = declare,
	.frame = frame,
	.free = done,
};
