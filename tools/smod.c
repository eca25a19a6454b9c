/* smod: shifts, turns, scales and boosts particles, and sets attributes of the frame. SPDX-License-Identifier: GPL-3.0-or-later */
#include <stdlib.h>
#include <string.h>

#include "law/law.h"
#include "mesh/rigid-motion.h"
#include "stage/attribute-options.h"
#include "stream/edit.h"
#include "stream/join.h"

struct config {
	struct pm_list sets, scale, constants, faces, particle_faces, units, store, rename, fixed, loose;
	struct pm_vector shift, boost, box;
	const char *rotate, *law;
	double dt, time;
	int64_t seed, step;
};

struct state {
	struct pm_turn turn; /* of the options */
};

static const struct pm_option options[] = {
	{.name = "set", .kind = PM_LIST, .unit = "NAME", PM_AT(sets), .text = "move and scale these sets only (every set without)"},
	{.name = "scale", .kind = PM_LIST, .unit = "FIELD=FACTOR", PM_AT(scale),
		.text = "multiply fields: x=2,v=0.5,mass=1e-3; box=2 stretches the box and its meshes about the origin"},
	{.name = "rotate", .kind = PM_TEXT, .unit = "AXIS,DEGREES", PM_AT(rotate), .text = "turn x and v about the origin: z,30; in 2-D only z"},
	{.name = "shift", .kind = PM_VECTOR, .unit = "length", PM_AT(shift), .text = "add to the positions (back into the box on periodic axes)"},
	{.name = "boost", .kind = PM_VECTOR, .unit = "length/time", PM_AT(boost), .text = "add to the velocities"},
	{.name = "dt", .kind = PM_REAL, .unit = "time", .high = 1e300, PM_AT(dt), .text = "the time step"},
	{.name = "time", .kind = PM_REAL, .unit = "time", PM_AT(time), .text = "the time"},
	{.name = "step", .kind = PM_INTEGER, .high = 1e15, PM_AT(step), .text = "the number of steps done"},
	{.name = "seed", .kind = PM_INTEGER, .high = 0x1p62, PM_AT(seed), .text = "the seed of what is random"},
	{.name = "law", .kind = PM_WORD, .choices = pm_law_names, PM_AT(law), .text = "the law the particles obey"},
	{.name = "constant", .kind = PM_LIST, .unit = "NAME=VALUE", PM_AT(constants), .text = "constants: G=1,softening=0.05"},
	{.name = "box", .kind = PM_VECTOR, .unit = "length", PM_AT(box), .text = "lo,hi of every axis, or all lo and then all hi; meshes span the new box"},
	{.name = "faces", .kind = PM_LIST, .unit = "WORD", PM_AT(faces),
		.text = "boundary of the fields: periodic, open, wall, neumann or absorbing; one word, one per axis, or low,high per axis"},
	{.name = "particle-faces", .kind = PM_LIST, .unit = "WORD", PM_AT(particle_faces),
		.text = "boundary of the particles: periodic, reflect, absorb or open"},
	{.name = "unit", .kind = PM_LIST, .unit = "FIELD=UNIT", PM_AT(units), .text = "units to write beside the fields"},
	{.name = "store", .kind = PM_LIST, .unit = "TYPE|FIELD=TYPE", PM_AT(store),
		.text = "store fields as f32 or f64: f32 for all that are real, or x=f32,v=f32"},
	{.name = "rename", .kind = PM_LIST, .unit = "OLD=NEW", PM_AT(rename), .text = "new names for fields, sets or meshes"},
	{.name = "fixed", .kind = PM_LIST, .unit = "SET", PM_AT(fixed), .text = "sets that are not pushed from here on"},
	{.name = "loose", .kind = PM_LIST, .unit = "SET", PM_AT(loose), .text = "sets that are pushed again"},
	{0},
};

static bool listed(const struct pm_list *list, const char *name)
{
	for (int i = 0; i < list->n; i++)
		if (!strcmp(list->item[i], name))
			return true;
	return !list->n;
}

static int begin(struct pm_stage *s)
{
	const struct config *c = s->config;
	for (int i = 0; i < c->store.n; i++) {
		const char *type = strchr(c->store.item[i], '=') ? strchr(c->store.item[i], '=') + 1 : c->store.item[i];
		if (strcmp(type, "f32") && strcmp(type, "f64"))
			return pm_fail(PM_USAGE, "--store '%s': f32 and f64 are the types to choose from", c->store.item[i]);
	}
	return pm_turn_of(c->rotate, &((struct state *)s->state)->turn);
}

/* ---- the header ---- */

static int rename_all(const struct config *c, struct pm_frame *f)
{
	for (int i = 0; i < c->rename.n; i++) {
		char old[PM_NAME];
		const char *new;
		int status = pm_attributes_words(c->rename.item[i], old, &new);
		if (status || (status = pm_frame_rename(f, old, new)))
			return status;
	}
	return 0;
}

static int fix(const struct pm_list *list, struct pm_frame *f, bool fixed)
{
	for (int i = 0; i < list->n; i++) {
		struct pm_set *set = pm_frame_set(f, list->item[i]);
		if (!set)
			return pm_fail(PM_DATA, "no set '%s' (sls lists what there is)", list->item[i]);
		set->fixed = fixed;
	}
	return 0;
}

static int attributes(const struct config *c, struct pm_frame *f)
{
	int status = 0;
	bool geometry = c->box.n || c->faces.n;
	if (f->substep && (c->fixed.n || c->loose.n))
		return pm_fail(PM_DATA, "which sets are fixed can change only between steps (substep %d here)", f->substep);
	if (f->substep && (!isnan(c->dt) || !isnan(c->time) || c->step >= 0))
		return pm_fail(PM_DATA, "time, dt and step can change only between steps (substep %d here)", f->substep);
	if ((geometry && (status = pm_frame_meshes_free(f))) || (status = pm_attributes_constants(f, &c->constants)) || (status = pm_attributes_law(f, c->law)) ||
		(status = pm_attributes_box(f, &c->box)) || (status = pm_attributes_faces(f, &c->faces)) || (status = pm_attributes_particle_faces(f, &c->particle_faces)))
		return status;
	f->dt = isnan(c->dt) ? f->dt : c->dt;
	f->step = c->step >= 0 ? c->step : f->step;
	f->seed = c->seed >= 0 ? (uint64_t)c->seed : f->seed;
	if (!isnan(c->time))
		f->time = f->start = c->time;
	if (c->box.n)
		pm_frame_meshes_span(f);
	return (status = fix(&c->fixed, f, true)) ? status : fix(&c->loose, f, false);
}

/* ---- what is loaded ---- */

/* The factor of a field; 1 where it has none. */
static int factor(const struct config *c, const char *name, double *out)
{
	*out = 1;
	for (int i = 0; i < c->scale.n; i++) {
		char field[PM_NAME];
		double value;
		int status = pm_attributes_pair(c->scale.item[i], field, &value);
		if (status)
			return status;
		if (!strcmp(field, name))
			*out *= value;
	}
	return 0;
}

static bool moves(const struct config *c, const struct pm_field *p)
{
	bool x = !strcmp(p->name, "x"), v = !strcmp(p->name, "v");
	return (x && (c->shift.n || c->rotate)) || (v && (c->boost.n || c->rotate));
}

static int plan_set(const struct config *c, struct pm_frame *f, const char *on, int *touched)
{
	for (size_t k = 0, n = f->nfields; k < n;) { /* pm_changes moves a field to the end of the list */
		struct pm_field *p = f->fields[k];
		double by;
		int status = factor(c, p->name, &by);
		if (status)
			return status;
		if (strcmp(p->on, on) || p->use & PM_USE_CHANGE || !(moves(c, p) || by != 1)) {
			k++;
			continue;
		}
		if (p->type == PM_I64 || p->type == PM_U8)
			return pm_fail(PM_DATA, "'%s' holds whole numbers, which --scale does not multiply", p->name);
		if (p->role != PM_STATE)
			return pm_fail(PM_DATA, "'%s' is a %s field, which is computed again, not scaled", p->name, pm_role_names[p->role]);
		*touched |= 1;
		if (p->uniform && !moves(c, p) && strcmp(p->name, "x")) { /* stays uniform: no data to load; positions are folded */
			for (int i = 0; i < p->components; i++)
				p->value[i] *= by;
			k++;
			continue;
		}
		pm_changes(f, on, p->name);
		n--;
	}
	return 0;
}

static int scales_there(const struct config *c, const struct pm_frame *f)
{
	for (int i = 0; i < c->scale.n; i++) {
		char field[PM_NAME];
		double value;
		int status = pm_attributes_pair(c->scale.item[i], field, &value);
		bool there = !strcmp(field, "box");
		for (size_t k = 0; k < f->nsets && !there; k++)
			there = listed(&c->sets, f->sets[k]->name) && pm_frame_field(f, f->sets[k]->name, field);
		if (status || !there)
			return status ? status : pm_fail(PM_DATA, "no field '%s' to scale (sls lists what there is)", field);
		if (!strcmp(field, "box") && !(value > 0))
			return pm_fail(PM_USAGE, "the box can be scaled by what is above 0 only");
	}
	return 0;
}

static int vectors_fit(const struct config *c, const struct pm_turn *t, const struct pm_frame *f)
{
	for (size_t i = 0; i < f->nsets; i++) {
		const struct pm_field *v = pm_frame_field(f, f->sets[i]->name, "v");
		if (!listed(&c->sets, f->sets[i]->name))
			continue;
		if (c->shift.n && c->shift.n != f->dim)
			return pm_fail(PM_USAGE, "--shift takes %d numbers here, not %d", f->dim, c->shift.n);
		if (c->boost.n && (!v || c->boost.n != v->components))
			return v ? pm_fail(PM_USAGE, "--boost takes %d numbers here, not %d", v->components, c->boost.n) : pm_fail(PM_DATA, "no field 'v' on '%s' to boost", f->sets[i]->name);
	}
	if (t->axis[0] >= 0 && (f->dim == 1 || (f->dim == 2 && (t->axis[0] > 1 || t->axis[1] > 1))))
		return pm_fail(PM_USAGE, "--rotate: in %d dimensions %s", f->dim, f->dim == 1 ? "nothing turns" : "only z can be the axis");
	for (int i = 0; i < c->sets.n; i++)
		if (!pm_frame_set(f, c->sets.item[i]))
			return pm_fail(PM_DATA, "no set '%s' (sls lists what there is)", c->sets.item[i]);
	return 0;
}

static int declare(struct pm_stage *s, struct pm_frame *f)
{
	const struct config *c = s->config;
	int status, touched = c->box.n || c->faces.n || c->law || c->constants.n;
	double box;
	if ((status = scales_there(c, f)) || (status = factor(c, "box", &box)) || (box != 1 && (status = pm_frame_meshes_free(f))) || (status = vectors_fit(c, &((struct state *)s->state)->turn, f)) || (status = attributes(c, f)))
		return status;
	if (box != 1)
		pm_frame_stretch(f, box), touched = 1;
	for (size_t i = 0; i < f->nsets && !status; i++)
		if (listed(&c->sets, f->sets[i]->name))
			status = plan_set(c, f, f->sets[i]->name, &touched);
	if (status)
		return status;
	if (touched && f->substep)
		return pm_fail(PM_DATA, "particles, box and law can change only between steps (substep %d here)", f->substep);
	for (size_t i = 0; touched && i < f->nsets; i++)
		pm_drops_roles(f, f->sets[i]->name, 1u << PM_CHANGE | 1u << PM_DERIVED); /* they belonged to the state that was */
	if (touched)
		pm_drops_roles(f, NULL, 1u << PM_CHANGE | 1u << PM_DERIVED);
	for (int i = 0; i < c->store.n; i++)
		if ((status = pm_frame_store(f, c->store.item[i])))
			return status;
	for (int i = 0; i < c->units.n; i++) {
		const struct pm_list one = {.item = {c->units.item[i]}, .n = 1};
		bool done = false;
		for (size_t k = 0; k < f->nsets + f->nmeshes; k++)
			done |= !pm_attributes_units(f, k < f->nsets ? f->sets[k]->name : f->meshes[k - f->nsets]->name, &one);
		if (!done)
			return -PM_DATA;
	}
	return rename_all(c, f);
}

/* ---- the data ---- */

/* The name a field had before --rename. */
static bool was(const struct config *c, const char *now, const char *name)
{
	for (int i = 0; i < c->rename.n; i++) {
		char old[PM_NAME];
		const char *new;
		if (!pm_attributes_words(c->rename.item[i], old, &new) && !strcmp(new, now))
			return !strcmp(old, name);
	}
	return !strcmp(now, name);
}

static int frame(struct pm_stage *s, struct pm_frame *f)
{
	const struct config *c = s->config;
	const struct pm_turn *t = &((struct state *)s->state)->turn;
	for (size_t i = 0; i < f->nfields; i++) {
		struct pm_field *p = f->fields[i];
		bool x = was(c, p->name, "x"), v = was(c, p->name, "v");
		double by = 1;
		if (!(p->use & PM_USE_CHANGE) || pm_frame_mesh(f, p->on))
			continue;
		for (int k = 0; k < c->scale.n; k++) {
			char field[PM_NAME];
			double value;
			if (!pm_attributes_pair(c->scale.item[k], field, &value) && was(c, p->name, field))
				by *= value;
		}
		for (int k = 0; by != 1 && k < p->components; k++)
			for (size_t j = 0; j < p->count; j++)
				pm_out(p, k)[j] *= by;
		if (t->axis[0] >= 0 && (x || v))
			pm_move_turn(t, p);
		if (x && c->shift.n)
			pm_move_add(p, c->shift.n, c->shift.x);
		if (v && c->boost.n)
			pm_move_add(p, c->boost.n, c->boost.x);
		if (x)
			pm_move_fold(f, p);
	}
	return 0;
}

static const struct pm_example examples[] = {
	{"A cluster that moves.", "pinit plummer -n 100 | smod --shift 5,0,0 --boost -0.3,0,0 | sls --data"},
	{"Half the size at the same energy: lengths by 1/2, velocities by sqrt 2.", "pinit plummer -n 100 | smod --scale x=0.5,v=1.4142135623730951,box=0.5 | sls --data"},
	{"Another time step and softening, single precision on the way.", "pinit plummer -n 100 | smod --dt 0.01 --constant softening=0.1 --store f32 | sls"},
	{0}};

const struct pm_tool tool_smod = {
	.name = "smod",
	.summary = "shifts, turns, scales and boosts; sets attributes",
	.about = "In this order: attributes, --scale, --rotate, --shift, --boost, --store, --rename. What moves particles, or changes the law, its constants or the box, drops derived and "
		 "change fields: they belonged to what was before. --scale multiplies the fields that are named and nothing else: whoever shrinks the lengths of a scene says what becomes of velocities, "
		 "masses and the box. Positions are not checked against an open box: p2m will name a particle outside.",
	.kind = PM_FILTER,
	.changes = "x, v, what --scale and --store name, attributes",
	.config = sizeof(struct config),
	.state = sizeof(struct state),
	.options = options,
	.examples = examples,
	.begin = begin,
	.declare = declare,
	.frame = frame,
};
