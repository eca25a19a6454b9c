/* smove: scales, rotates, shifts and boosts the particles of a scene (lib/mesh/set-motion.c). SPDX-License-Identifier: GPL-3.0-or-later */
#include "stage/motion-options.h"
#include "stream/edit.h"

struct config {
	struct pm_motion_options motion;
};

struct state {
	struct pm_set_motion motion;
};

static const struct pm_option options[] = {
	PM_MOTION_ROWS,
	{0},
};

static int begin(struct pm_stage *s)
{
	const struct config *c = s->config;
	if (!pm_motion_given(&c->motion))
		return pm_fail(PM_USAGE, "nothing to do (--scale, --rotate, --shift or --boost)");
	return pm_motion_begin(&c->motion, &((struct state *)s->state)->motion);
}

static int declare(struct pm_stage *s, struct pm_frame *f)
{
	const struct config *c = s->config;
	struct pm_set_motion *m = &((struct state *)s->state)->motion;
	bool touched = false;
	int status = pm_motion_check(&c->motion, m, f);
	if (!status)
		status = pm_set_motion_declare(m, f, &touched);
	return !status && touched ? pm_frame_outdate(f) : status;
}

static int frame(struct pm_stage *s, struct pm_frame *f)
{
	pm_set_motion_apply(&((struct state *)s->state)->motion, f);
	return 0;
}

static void release(struct pm_stage *s) { pm_set_motion_clear(&((struct state *)s->state)->motion); }

static const struct pm_example examples[] = {
	{"A cluster that moves.", "pinit plummer -n 100 | smove --shift 5,0,0 --boost -0.3,0,0 | sls --data"},
	{"Half the size, still in equilibrium: lengths by 1/2, velocities by sqrt 2.",
		"pinit plummer -n 100 | smove --scale x=0.5,v=1.4142135623730951,box=0.5 | sls --data"},
	{"An orbit tilted by 30 degrees about the x axis.", "pinit two-body --eccentricity 0.5 | smove --rotate x,30 | stab --plain"},
	{0},
};

const struct pm_tool tool_smove = {
	.name = "smove",
	.summary = "shifts, rotates, scales and boosts particles",
	.about = "In this order: --scale, --rotate, --shift, --boost. Derived and change fields are dropped, because they were computed at the old positions. "
		"--scale multiplies the "
		"named fields only: to change the lengths of a scene consistently, also scale velocities, masses and the box as needed. "
		"Positions are "
		"not checked against an open box: p2m reports particles outside. See docs/methods/smove.md.",
	.kind = PM_FILTER,
	.changes = "x, v, the fields of --scale",
	.config = sizeof(struct config),
	.state = sizeof(struct state),
	.options = options,
	.examples = examples,
	.begin = begin,
	.declare = declare,
	.frame = frame,
	.free = release,
};
