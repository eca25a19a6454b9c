/* push: the only word that moves particles and advances time. It is independent of the law: x' = v (or vel), v' = acc, any other state by the change field
 * that names it. Actions and schemes are files of lib/step; lib/push holds the rules, the clock and the loops. SPDX-License-Identifier: GPL-3.0-or-later */
#include <stdlib.h>

#include "stage/control-options.h"
#include "stage/strength-report.h"
#include "stream/acting-forces.h"
#include "stream/frame-time.h"
#include "world/world.h"

struct config {
	double dt;
	const char *set;
	struct pm_push push;
};

struct state { /* set by declare for frame */
	struct pm_moving *moving;
	size_t n;
	const struct pm_mesh *mesh; /* for the Courant number; NULL none */
	struct pm_control_tally tally;
};

static int begin(struct pm_stage *s)
{
	struct config *cfg = s->config;
	for (int i = 0; i < s->nargs; i++) {
		int status = pm_push_action(&cfg->push, s->args[i]);
		if (status)
			return status;
	}
	if (cfg->push.open && !(cfg->push.drift > 0))
		return pm_fail(PM_USAGE, "--open belongs to drift (push drift --open | force | push kick)");
	return pm_given(s, "dt") && cfg->dt == 0 ? pm_fail(PM_USAGE, "--dt must not be 0") : pm_control_begin(s, &cfg->push);
}

static int take_dt(const struct pm_stage *s, struct pm_frame *f)
{
	const struct config *cfg = s->config;
	if (pm_given(s, "dt") && f->substep && cfg->dt != f->dt)
		return pm_fail(PM_DATA, "--dt %g in the middle of a step of dt %g (it may change only at substep 0)", cfg->dt, f->dt);
	if (pm_given(s, "dt"))
		pm_frame_dt_set(f, cfg->dt);
	return f->dt != 0 && isfinite(f->dt) ? 0 : pm_fail(PM_DATA, "the frame has no time step (push --dt, or the word dt)");
}

static int declare(struct pm_stage *s, struct pm_frame *f)
{
	struct config *cfg = s->config;
	struct state *state = s->state;
	cfg->push.later = s->fused;
	const struct pm_set *named = cfg->set ? pm_frame_set(f, cfg->set) : NULL;
	bool steps = cfg->push.actions.actions > 0;
	int status = steps ? take_dt(s, f) : 0;
	if (!status && cfg->set && !named)
		return pm_fail(PM_DATA, "no set '%s' (sls lists the sets)", cfg->set);
	if (!status && named && steps && !pm_set_moves(f, named))
		return pm_fail(PM_DATA, "'%s' does not move: %s", cfg->set, named->fixed ? "it is fixed" : "it has no positions 'x'");
	void *room = realloc(state->moving, (f->nsets + 1) * sizeof *state->moving);
	if (!room)
		return pm_no_memory();
	state->moving = room;
	state->n = 0, state->mesh = pm_push_mesh(f);
	for (size_t i = 0; i < f->nsets && steps && !status; i++)
		if (pm_set_moves(f, f->sets[i]) && (!named || named == f->sets[i]))
			status = pm_moving_declare(f, f->sets[i], &cfg->push, &state->moving[state->n++]);
	if (!status && steps && !state->n)
		return pm_fail(PM_DATA, f->nsets ? "no set moves (has 'x', not fixed; species adds one)" : "no particles (species, stab and pinit make them)");
	if (status)
		return status;
	if (cfg->push.clear || cfg->push.moves)
		pm_push_drops(f, &cfg->push, cfg->set);
	if (pm_control_chosen(&cfg->push))
		return (status = pm_control_frame(f, state->n, state->moving, &cfg->push)) ? status : PM_HOLD;
	if (steps)
		pm_clock_close(f);
	return cfg->push.moves && pm_moving_face(f, PM_PABSORB) ? PM_HOLD : 0;
}

static int stable(struct pm_stage *s, const struct pm_frame *f, const struct pm_moving *m)
{
	const double strain = pm_moving_strain(f, m);
	if (strain > 1)
		pm_tell_once(s, "dt |grad u| is %.3g for '%s' (dt %g): above 1 particles cross within a step, and the error is large "
			"(the word dt --lcfl 0.5 chooses a step)", strain, m->set->name, f->dt);
	return pm_moving_stable(f, m, &((const struct config *)s->config)->push);
}

static int move(const struct pm_stage *s, struct pm_frame *f, const struct pm_moving *m, const double *h, double *crossed)
{
	const struct pm_push *p = &((const struct config *)s->config)->push;
	struct pm_strengths before, after, lost;
	uint64_t absorbed = lost.n = 0; /* the rest of it is large: to clear it took a tenth of a step of two bodies */
	for (int r = 0; r < m->n; r++)
		pm_acting_note(f, m->rates[r].rate);
	pm_moving_given(f, m, &before);
	if (pm_world_agree(pm_moving_run(f, m, p, h, crossed)))
		return -PM_DATA;
	pm_moving_given(f, m, &after);
	pm_report_strengths(s, f, "given", &before, &after);
	if (p->moves && pm_moving_face(f, PM_PABSORB) && pm_moving_absorb(f, m, &absorbed, &lost))
		return -PM_DATA;
	if (absorbed)
		pm_report_count(s, f, "absorbed", absorbed);
	pm_report_strengths(s, f, "absorbed", NULL, &lost);
	return 0;
}

static int frame(struct pm_stage *s, struct pm_frame *f)
{
	const struct config *cfg = s->config;
	struct state *state = s->state;
	const double *h = state->mesh && cfg->push.moves ? state->mesh->h : NULL;
	double crossed = 0;
	int status = 0;
	if (pm_control_chosen(&cfg->push))
		return pm_control_pass(s, f, state->n, state->moving, &cfg->push, &state->tally);
	for (size_t i = 0; i < state->n && !status; i++)
		status = stable(s, f, &state->moving[i]);
	for (size_t i = 0; i < state->n && !status; i++)
		status = move(s, f, &state->moving[i], h, &crossed);
	status = h ? pm_world_largest(status, 1, &crossed) : status;
	if (h && !status)
		pm_report(s, f, "courant", crossed);
	return status;
}

static bool divided(const struct pm_stage *s, const struct pm_frame *f) { return s && f; }

static int end(struct pm_stage *s) { return pm_control_end(s, &((const struct config *)s->config)->push, &((const struct state *)s->state)->tally); }

static void release(struct pm_stage *s) { free(((struct state *)s->state)->moving); }

static const struct pm_option options[] = {
	{.name = "dt", .kind = PM_REAL, .unit = "time", PM_AT(dt), .text = "overrides the frame's time step and records it; only at substep 0"},
	PM_CONTROL_ROWS,
	{.name = "set", .kind = PM_TEXT, .unit = "NAME", PM_AT(set), .text = "moves this set only; time advances when the others have moved too"},
	{.name = "open", .kind = PM_FLAG, PM_AT(push.open), .text = "the drift does not complete the step: a kick is still to come"},
	{.name = "unsafe", .kind = PM_FLAG, PM_AT(push.unsafe), .text = "allow steps too long for the scheme to be stable, in a decay or an oscillation"},
	{0},
};

static const struct pm_example examples[] = {
	{"a step of leapfrog with the direct sum", "pinit two-body | pp | push kick/2 drift | pp | push kick/2 | sls"},
	{"ten steps of it", "pinit two-body | cycle -n 10 'push kick/2 drift | pp | push kick/2' | sls"},
	{"one step of Runge-Kutta is four passes of the force", "pinit two-body | pp | push rk4 | pp | push rk4 | pp | push rk4 | pp | push rk4 | sls"},
	{0},
};

const struct pm_tool tool_push = {
	.name = "push",
	.summary = "advance state by its rates, and time with it",
	.about = "Actions are kick[/N], drift[/N], boris/2 (a kick that also rotates v about bfield) and clear, or one whole scheme, which takes one pass of "
		"the sentence per stage. A set with v moves by x' = v, v' = acc; a set with x alone by x' = vel; any other state by the change field that "
		"names it. A missing rate is an error, never zero. Moving particles drops change and derived fields; kick keeps them. A step is complete "
		"when drift has reached 1 and kick 0 or 1 in every set that moves. Particles are folded, mirrored or absorbed at the faces of the box.",
	.kind = PM_FILTER,
	.reads = "v, acc, vel and other change fields; bfield, charge and mass for boris",
	.changes = "x, v and the states that change fields name; time, step",
	.adds = "registers q_x, q_v ... between the passes of a scheme",
	.config = sizeof(struct config),
	.state = sizeof(struct state),
	.options = options,
	.arguments = "ACTION...",
	.arguments_choices = pm_step_names,
	.arguments_text = "kick, drift (with /N a part of the step), boris/2, boris-tan/2, relativistic/2, vay/2, higuera-cary/2, "
		"landau-lifshitz/2, clear; or a scheme: "
		"euler, rk2, midpoint, lsrk3, rk4, ab2, ab3, leapfrog2, yoshida4, yoshida6, blanes-moan4, blanes-moan6; implicit-euler, implicit-midpoint, "
		"trapezoid; with error control ias15, rk45, rk23, rk4-double, midpoint-double",
	.least = 1,
	.most = PM_ADVANCE_ACTIONS,
	.examples = examples,
	.begin = begin,
	.declare = declare,
	.frame = frame,
	.divided = divided,
	.end = end,
	.free = release,
};
