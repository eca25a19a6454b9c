/* collide: Coulomb collisions between charges of a cell (lib/collide, lib/collision). SPDX-License-Identifier: GPL-3.0-or-later */
#include "collide/collide-frame.h"
#include "law/law.h"
#include "stage/stage.h"

struct config {
	const char *mesh, *method;
	struct pm_list between;
	double logarithm, weight;
	int64_t seed;
};

static int begin(struct pm_stage *s)
{
	const struct config *o = s->config;
	return o->between.n > 2 ? pm_fail(PM_USAGE, "--between takes two sets, or one (A,B)") : 0;
}

static struct pm_collide collide_of(const struct pm_stage *s, const struct pm_frame *f)
{
	const struct config *o = s->config;
	const int n = o->between.n;
	return (struct pm_collide){.mesh = o->mesh, .between = {n ? o->between.item[0] : NULL, n ? o->between.item[n - 1] : NULL},
		.method = pm_collision_find(o->method), .logarithm = o->logarithm, .weight = o->weight,
		.seed = pm_given(s, "seed") ? (uint64_t)o->seed : f->seed};
}

static int declare(struct pm_stage *s, struct pm_frame *f)
{
	const struct pm_collide c = collide_of(s, f);
	return !c.method ? -PM_DATA : f->substep ? PM_PASS : pm_collide_declare(&c, f);
}

static int frame(struct pm_stage *s, struct pm_frame *f)
{
	const struct pm_collide c = collide_of(s, f);
	const struct pm_law *law = pm_law_of(f);
	struct pm_collided r;
	int status = pm_collide_step(&c, f, &r);
	if (status)
		return status;
	pm_report_count(s, f, "collisions", r.pairs);
	pm_report(s, f, "logarithm", r.logarithm);
	pm_report(s, f, "turn", r.turn);
	if (r.turn > 0.07)
		pm_tell_once(s, "a step turns pairs by 1 - cos = %.2g on average, and from 0.07 on rates are 10 %% too low (a shorter dt)", r.turn);
	if (r.weighted)
		pm_tell_once(s, "the particles of '%s' have unequal masses at one charge over mass, and collide takes each for a body of its own mass: rates "
			"are wrong where these are weights (pinit --loading random)", r.weighted);
	if (law->relativistic && r.fastest > 0.3 * pm_frame_constant(f, "c", 1))
		pm_tell_once(s, "the speeds reach %.2g c, and collide is not relativistic", r.fastest / pm_frame_constant(f, "c", 1));
	if (r.single && r.pairs)
		pm_tell_once(s, "each particle is taken for one charge; one that stands for W collides W times less (--statistical-weight W, or smod "
			"--constant bodies=N)");
	return 0;
}

static const struct pm_option options[] = {
	{.name = "method", .kind = PM_WORD, .fallback = "nanbu", .choices = pm_collision_names, PM_AT(method), .text = "how the angle of a pair is drawn"},
	{.name = "between", .kind = PM_LIST, .unit = "A,B", PM_AT(between),
		.text = "only collisions of these two sets with each other (A,A: within A); by default all, within and between, that have charge and move"},
	{.name = "logarithm", .kind = PM_REAL, .low = 0, .high = 1e3, PM_AT(logarithm),
		.text = "Coulomb's logarithm; by default that of each pair of sets, log(Debye length/b0), at least 2"},
	{.name = "statistical-weight", .letter = 'w', .kind = PM_REAL, .low = 1e-300, .high = 1e300, PM_AT(weight),
		.text = "electrons (ions) that a particle stands for; by default the constant bodies over the particles, else 1"},
	{.name = "mesh", .kind = PM_TEXT, .unit = "NAME", PM_AT(mesh), .text = "the mesh whose cells hold the particles that collide (default: the first)"},
	{.name = "seed", .kind = PM_INTEGER, .high = 9e15, PM_AT(seed), .text = "seed of the random numbers; by default the frame's"},
	{0},
};
static const struct pm_example examples[] = {
	{"collisions alone, of electrons that are twice as fast along x",
		"pinit uniform -n 4000 --dispersion 1 --cells 4 --dt 0.05 | smod --law electrostatic | scalc --extensive 'charge = -mass' | "
		"scalc 'v = 2*vx, vy, vz' | cycle -n 40 'push drift | collide --statistical-weight 0.002' | sls --report"},
	{"a plasma with collisions in every step",
		"pinit weibel -n 2000 --cells 16 | sel --drop E,B | smod --law electrostatic | "
		"cycle -n 5 'push kick/2 drift | p2m | poisson-fft | mgrad | m2p | push kick/2 | collide --statistical-weight 10' | sls --report"},
	{0},
};
const struct pm_tool tool_collide = {
	.name = "collide",
	.summary = "scatter charges by the collisions that a mesh leaves out",
	.about = "Coulomb collisions as many small-angle encounters: in every cell the particles of each set meet in random pairs, and the relative "
		"velocity of a pair turns by a random angle whose mean square is 8 pi n log(L) b0^2 u dt where it is small, b0 = q_a q_b/(4 pi eps0 m_ab "
		"u^2), u the relative speed, m_ab the reduced mass, n the density of the fewer. Momentum and energy are kept to round-off. It stands behind "
		"the last push, once a step. Velocities need 3 components; in 1-D and 2-D a cell is 1 long across. Random numbers depend on seed, sets, id "
		"(or index) and step, not on threads. Reports the number of pairs, Coulomb's logarithm (the least) and the mean of 1 - cos of the angles. "
		"Law electrostatic or electromagnetic; not relativistic. See docs/methods/collide.md.",
	.kind = PM_FILTER,
	.reads = "x, charge, mass, id",
	.changes = "v",
	.config = sizeof(struct config),
	.options = options,
	.examples = examples,
	.begin = begin,
	.declare = declare,
	.frame = frame,
};
