/* smod: sets attributes of the frame, stores and renames its fields; particles are moved by smove, whose options smod still accepts.
 * SPDX-License-Identifier: GPL-3.0-or-later */
#include <stdio.h>
#include <string.h>

#include "law/law.h"
#include "stage/attribute-options.h"
#include "stage/motion-options.h"
#include "stream/edit.h"
#include "stream/frame-time.h"
#include "stream/join.h"

struct config {
	struct pm_motion_options motion;
	struct pm_list constants, faces, particle_faces, units, store, rename, fixed, loose;
	struct pm_vector box;
	const char *law;
	double dt, time;
	int64_t seed, step;
};

struct state {
	struct pm_set_motion motion;
};

static const struct pm_option options[] = {
	PM_MOTION_ROWS,
	{.name = "dt", .kind = PM_REAL, .unit = "time", .high = 1e300, PM_AT(dt), .text = "the time step"},
	{.name = "time", .kind = PM_REAL, .unit = "time", PM_AT(time), .text = "the time"},
	{.name = "step", .kind = PM_INTEGER, .high = 1e15, PM_AT(step), .text = "the number of steps done"},
	{.name = "seed", .kind = PM_INTEGER, .high = 0x1p62, PM_AT(seed), .text = "the seed of random numbers"},
	{.name = "law", .kind = PM_WORD, .choices = pm_law_names, PM_AT(law), .text = "the law of the particles"},
	{.name = "constant", .kind = PM_LIST, .unit = "NAME=VALUE", PM_AT(constants), .text = "constants: G=1,softening=0.05"},
	{.name = "box", .kind = PM_VECTOR, .unit = "length", PM_AT(box), .text = "lo,hi of every axis, or all lo and then all hi; meshes span the new box"},
	{.name = "faces", .kind = PM_LIST, .unit = "WORD", PM_AT(faces),
		.text = "boundary of the fields: periodic, open, wall, neumann or absorbing; one word, one per axis, or low,high per axis"},
	{.name = "particle-faces", .kind = PM_LIST, .unit = "WORD", PM_AT(particle_faces),
		.text = "boundary of the particles: periodic, reflect, absorb or open"},
	{.name = "unit", .kind = PM_LIST, .unit = "FIELD=UNIT", PM_AT(units), .text = "units of the fields"},
	{.name = "store", .kind = PM_LIST, .unit = "TYPE|FIELD=TYPE", PM_AT(store),
		.text = "store fields as f32 or f64: f32 alone for all real fields, or x=f32,v=f32"},
	{.name = "rename", .kind = PM_LIST, .unit = "OLD=NEW", PM_AT(rename), .text = "new names for fields, sets or meshes"},
	{.name = "fixed", .kind = PM_LIST, .unit = "SET", PM_AT(fixed), .text = "sets that push must not move from now on"},
	{.name = "loose", .kind = PM_LIST, .unit = "SET", PM_AT(loose), .text = "sets that push moves again"},
	{0},
};

static int begin(struct pm_stage *s)
{
	const struct config *c = s->config;
	for (int i = 0; i < c->store.n; i++) {
		const char *type = strchr(c->store.item[i], '=') ? strchr(c->store.item[i], '=') + 1 : c->store.item[i];
		if (strcmp(type, "f32") && strcmp(type, "f64"))
			return pm_fail(PM_USAGE, "--store '%s': f32 and f64 are the types to choose from", c->store.item[i]);
	}
	return pm_motion_begin(&c->motion, &((struct state *)s->state)->motion);
}

static int attributes(const struct config *c, struct pm_frame *f)
{
	int status = 0;
	bool geometry = c->box.n || c->faces.n;
	if (f->substep && (c->fixed.n || c->loose.n))
		return pm_fail(PM_DATA, "which sets are fixed can change only between steps (substep %d here)", f->substep);
	if (f->substep && (!isnan(c->dt) || !isnan(c->time) || c->step >= 0))
		return pm_fail(PM_DATA, "time, dt and step can change only between steps (substep %d here)", f->substep);
	if ((geometry && (status = pm_frame_meshes_free(f))) || (status = pm_attributes_constants(f, &c->constants)) ||
		(status = pm_attributes_law(f, c->law)) || (status = pm_attributes_box(f, &c->box)) || (status = pm_attributes_faces(f, &c->faces)) ||
		(status = pm_attributes_particle_faces(f, &c->particle_faces)))
		return status;
	f->dt = isnan(c->dt) ? f->dt : c->dt;
	f->step = c->step >= 0 ? c->step : f->step;
	f->seed = c->seed >= 0 ? (uint64_t)c->seed : f->seed;
	if (!isnan(c->time))
		f->time = f->start = c->time;
	if (!isnan(c->dt) || !isnan(c->time) || c->step >= 0)
		pm_frame_since_renew(f);
	if (c->box.n)
		pm_frame_meshes_span(f);
	return (status = pm_attributes_fixed(f, &c->fixed, true)) ? status : pm_attributes_fixed(f, &c->loose, false);
}

static int declare(struct pm_stage *s, struct pm_frame *f)
{
	const struct config *c = s->config;
	struct pm_set_motion *m = &((struct state *)s->state)->motion;
	bool touched = c->box.n || c->faces.n || c->law || c->constants.n;
	int status = pm_motion_check(&c->motion, m, f);
	if (!status)
		status = attributes(c, f);
	if (!status)
		status = pm_set_motion_declare(m, f, &touched);
	if (!status && touched)
		status = pm_frame_outdate(f);
	for (int i = 0; i < c->store.n && !status; i++)
		status = pm_frame_store(f, c->store.item[i]);
	if (!status)
		status = pm_attributes_units_anywhere(f, &c->units);
	return status ? status : pm_attributes_rename(f, &c->rename);
}

static int frame(struct pm_stage *s, struct pm_frame *f)
{
	pm_set_motion_apply(&((struct state *)s->state)->motion, f);
	return 0;
}

/* After the work, so that a failure is one line. */
static int end(struct pm_stage *s)
{
	if (pm_motion_given(&((const struct config *)s->config)->motion))
		fputs("smod: --scale, --rotate, --shift and --boost are now options of smove (smod still accepts them)\n", stderr);
	return 0;
}

static void release(struct pm_stage *s) { pm_set_motion_clear(&((struct state *)s->state)->motion); }

static const struct pm_example examples[] = {
	{"Change the time step and softening, and store in single precision.", "pinit plummer -n 100 | smod --dt 0.01 --constant softening=0.1 --store f32 "
		"| sls"},
	{"Rename a set, and let push move it from now on.", "pinit kepler | smod --loose sun --rename sun=centre | sls"},
	{0},
};

const struct pm_tool tool_smod = {
	.name = "smod",
	.summary = "sets attributes: time step, law, constants, box and faces, units, types, names",
	.about = "In this order: attributes, --store, --rename. A change of the law, its constants or the box drops derived and change fields, because they "
		"are no longer valid. Particles are moved by smove; its options --set, --scale, --rotate, --shift and --boost still work here, after the "
		"attributes.",
	.kind = PM_FILTER,
	.changes = "attributes, the fields of --store",
	.config = sizeof(struct config),
	.state = sizeof(struct state),
	.options = options,
	.examples = examples,
	.begin = begin,
	.declare = declare,
	.frame = frame,
	.end = end,
	.free = release,
};
