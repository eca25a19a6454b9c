/* species: adds one to a plasma: particles drawn from a density and a distribution of velocities (lib/load, lib/distribution).
 * SPDX-License-Identifier: GPL-3.0-or-later */
#include <string.h>

#include "law/law.h"
#include "load/species.h"
#include "stage/stage.h"

struct config {
	int64_t n, seed;
	double charge, mass, velocities, vth, kappa, ring;
	const char *profile, *distribution, *f[3], *loading;
	struct pm_vector widths, drift, range;
	bool weighted;
};

/* Of v with n components; the drift may have fewer. */
static int components(const struct config *o, int n, struct pm_distribution_choice *c)
{
	if (o->drift.n > n || (o->widths.n && o->widths.n != n))
		return pm_fail(PM_USAGE, "--%s has %d numbers, and v has %d component%s (--velocities)", o->drift.n > n ? "drift" : "widths",
			o->drift.n > n ? o->drift.n : o->widths.n, n, n == 1 ? "" : "s");
	for (int d = 0; d < n; d++) {
		c->drift[d] = d < o->drift.n ? o->drift.x[d] : 0;
		c->vth[d] = o->widths.n ? o->widths.x[d] : o->vth;
		if (c->vth[d] < 0)
			return pm_fail(PM_USAGE, "--widths %g is negative", c->vth[d]);
	}
	return 0;
}

/* What would change nothing is a mistake. */
static int unused(const struct pm_stage *s, int velocities)
{
	const struct config *o = s->config;
	static const char *const given[] = {"vth", "widths", "drift"};
	bool all = true;
	for (int k = 0; k < velocities; k++)
		all = all && o->f[k];
	for (int k = 0; all && k < 3; k++)
		if (pm_given(s, given[k]))
			return pm_fail(PM_USAGE, "--%s, but every component of v has its distribution by an expression (leave one out)", given[k]);
	return 0;
}

static int species_of(const struct pm_stage *s, const struct pm_frame *f, struct pm_species *p)
{
	const struct config *o = s->config;
	const struct pm_distribution *d = pm_distribution_find(o->distribution);
	struct pm_distribution_choice *c = &p->choice;
	if (!d)
		return -PM_USAGE;
	const int least = d->least > f->dim ? d->least : f->dim, velocities = o->velocities > 0 ? (int)o->velocities : least;
	*p = (struct pm_species){.name = s->args[0], .n = (uint64_t)o->n, .charge = o->charge, .mass = o->mass, .density = o->profile,
		.weighted = o->weighted, .distribution = d, .f = {o->f[0], o->f[1], o->f[2]}, .range = o->range.n ? o->range.x : NULL,
		.choice = {.velocities = velocities, .kappa = o->kappa, .ring = o->ring, .c = pm_frame_constant(f, "c", 0)}};
	/* species at random must not have each other's numbers */
	p->seed = (pm_given(s, "seed") ? (uint64_t)o->seed : f->seed) ^ (uint64_t)pm_crc32c(0, p->name, strlen(p->name)) << 20;
	while (strcmp(o->loading, pm_loading_names[p->loading]))
		p->loading++;
	if (o->velocities > 0 && o->velocities != velocities)
		return pm_fail(PM_USAGE, "--velocities %g is not a number of components from 1 to 3", o->velocities);
	if (velocities < least)
		return pm_fail(PM_USAGE, "--velocities %d: %s in %d-D needs %d components of v", velocities, d->name, f->dim, least);
	for (int k = 0; k < 3; k++)
		if (o->f[k] && (k >= velocities || strcmp(d->name, "maxwellian")))
			return pm_fail(PM_USAGE, k >= velocities ? "--f%c, but v has %d components (--velocities)"
				: "--f%c gives that component's distribution; the others can only be maxwellian", 'x' + k, velocities);
	if (d->isotropic && o->widths.n)
		return pm_fail(PM_USAGE, "%s has one width for all components (--vth)", d->name);
	return unused(s, velocities) || components(o, velocities, c) ? -PM_USAGE : d->check ? d->check(c) : 0;
}

static int begin(struct pm_stage *s)
{
	const struct config *o = s->config;
	if (o->range.n && (o->range.n != 2 || !(o->range.x[0] < o->range.x[1])))
		return pm_fail(PM_USAGE, "--range takes the lowest and the highest velocity (--range=-3,3)");
	if (o->range.n && !o->f[0] && !o->f[1] && !o->f[2])
		return pm_fail(PM_USAGE, "--range is for --fx, --fy and --fz");
	if (pm_given(s, "kappa") && strcmp(o->distribution, "kappa") != 0)
		return pm_fail(PM_USAGE, "--kappa is for --distribution kappa");
	if (pm_given(s, "ring") && strcmp(o->distribution, "ring") != 0)
		return pm_fail(PM_USAGE, "--ring is for --distribution ring");
	if (!strcmp(o->loading, pm_loading_names[PM_LATTICE]))
		return pm_fail(PM_USAGE, "--loading lattice is for scenes (bit-reversed and sobol are the quiet starts here)");
	if (o->widths.n && pm_given(s, "vth"))
		return pm_fail(PM_USAGE, "--vth or --widths, not both");
	return o->weighted && !o->profile ? pm_fail(PM_USAGE, "--weighted is for a --profile") : 0;
}

static int declare(struct pm_stage *s, struct pm_frame *f)
{
	struct pm_species p;
	int status = species_of(s, f, &p);
	return status ? status : f->substep ? pm_fail(PM_DATA, "particles can be added only between steps (substep %d here)", f->substep)
		: pm_species_declare(&p, f);
}

static int frame(struct pm_stage *s, struct pm_frame *f)
{
	struct pm_species p;
	double weight;
	int status = species_of(s, f, &p);
	status = status ? status : pm_species_fill(&p, f, &weight);
	if (status)
		return status;
	pm_report(s, f, "weight", weight);
	const struct pm_law *law = pm_law_of(f);
	if (law && law->strength && strcmp(law->strength, "charge") && p.charge != 0 && p.n)
		pm_tell_once(s, "the law %s has no charges: '%s' are %llu particles of the mass %.4g (smod --law electrostatic in front of species; or "
			"--charge 0, if they are meant so)", law->name, p.name, (unsigned long long)p.n, weight * p.mass);
	return 0;
}

static const struct pm_option options[] = {
	{.name = "particles", .letter = 'n', .kind = PM_INTEGER, .fallback = "10000", .high = 1e12, PM_AT(n), .text = "number of particles"},
	{.name = "profile", .kind = PM_TEXT, .unit = "EXPRESSION", PM_AT(profile),
		.text = "density profile: real particles per volume, in x, y, z and the frame's constants ('1 + 0.1*cos(2*pi*x/Lx)'; default: 1)"},
	{.name = "weighted", .kind = PM_FLAG, PM_AT(weighted), .text = "particles evenly in the box, with weights as the density; else equal weights"},
	{.name = "charge", .kind = PM_REAL, .unit = "charge", .fallback = "-1", .low = -1e300, .high = 1e300, PM_AT(charge), .text = "of one real particle"},
	{.name = "mass", .kind = PM_REAL, .unit = "mass", .fallback = "1", .low = 1e-300, .high = 1e300, PM_AT(mass), .text = "of one real particle"},
	{.name = "distribution", .kind = PM_WORD, .fallback = "maxwellian", .choices = pm_distribution_names, PM_AT(distribution), .text = "of the velocities"},
	{.name = "vth", .kind = PM_REAL, .unit = "length/time", .fallback = "1", .low = 0, .high = 1e300, PM_AT(vth),
		.text = "standard deviation of each component of v, sqrt(T/m)"},
	{.name = "widths", .kind = PM_VECTOR, .unit = "length/time", PM_AT(widths), .text = "that of the components one by one, in place of --vth"},
	{.name = "drift", .kind = PM_VECTOR, .unit = "length/time", PM_AT(drift), .text = "mean velocity, from the first component on (default: 0)"},
	{.name = "kappa", .kind = PM_REAL, .low = -1e9, .high = 1e9, PM_AT(kappa), .text = "of --distribution kappa, above 1.5"},
	{.name = "ring", .kind = PM_REAL, .unit = "length/time", .low = 0, .high = 1e300, PM_AT(ring), .text = "speed of --distribution ring"},
	{.name = "fx", .kind = PM_TEXT, .unit = "EXPRESSION", PM_AT(f[0]),
		.text = "density of the first component of v, about --drift, an expression in v up to a factor ('v^2*exp(-v^2/2)')"},
	{.name = "fy", .kind = PM_TEXT, .unit = "EXPRESSION", PM_AT(f[1]), .text = "of the second"},
	{.name = "fz", .kind = PM_TEXT, .unit = "EXPRESSION", PM_AT(f[2]), .text = "of the third"},
	{.name = "range", .kind = PM_VECTOR, .unit = "LOW,HIGH", PM_AT(range),
		.text = "velocities between which these expressions count (default: where they are above 1e-14 of their largest value)"},
	{.name = "velocities", .kind = PM_REAL, .low = 1, .high = 3, PM_AT(velocities),
		.text = "components of v (default: the dimensions, or what the distribution needs)"},
	{.name = "loading", .kind = PM_WORD, .fallback = "sobol", .choices = pm_loading_names, PM_AT(loading),
		.text = "points in phase space: quiet by Sobol's sequence or by reversed digits, or at random (thermal noise)"},
	{.name = "seed", .kind = PM_INTEGER, .high = 9e15, PM_AT(seed), .text = "seed of the random numbers; by default the frame's"},
	{0},
};

static const struct pm_example examples[] = {
	{"a wave in hot electrons, and mobile ions", "pinit plasma --length 12.566 | species electrons -n 8000 --profile '1 + 0.05*cos(x/2)' | "
		"species ions -n 8000 --charge 1 --mass 1836 --vth 0.02 | smod --constant background=0 | sls"},
	{"any distribution: two streams of one species",
		"pinit plasma | species electrons -n 1000 --fx 'v^2*exp(-v^2/2)' --profile '1 + 0.05*cos(x/2)' | sls"},
	{"a slab in the plane with a hot ring",
		"pinit plasma --dim 2 | species electrons -n 900 --distribution ring --ring 3 --vth 0.2 --profile 'abs(x-6) < 2' | sls"},
	{0},
};

const struct pm_tool tool_species = {
	.name = "species",
	.summary = "add a species to a plasma: particles from a density and a distribution of velocities",
	.about = "Makes the set NAME with x, v, mass, charge and id. Places and velocities come through the inverse of their cumulative distributions "
		"from points that fill phase space evenly or at random. A particle stands for W = (integral of the density)/n real ones, with "
		"their charge and mass; W is reported. The names of expressions are x y z (--profile) or v (--fx), Lx Ly Lz, time and the constants of the "
		"frame. Species with the same density, n and sequence have the same places, so they begin neutral. See docs/methods/species.md.",
	.kind = PM_FILTER,
	.adds = "a set with x, v, mass, charge, id",
	.config = sizeof(struct config),
	.options = options,
	.arguments = "NAME",
	.arguments_text = "the name of the set",
	.least = 1,
	.most = 1,
	.examples = examples,
	.begin = begin,
	.declare = declare,
	.frame = frame,
};
