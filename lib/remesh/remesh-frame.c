/* Remeshing a set: every strength is distributed to the nodes, the volume becomes that of the nodes, uniform values are kept, other values are an error,
 * dropped, or remeshed as strength times value (momentum for a velocity), whose total is then conserved like that of a strength.
 * SPDX-License-Identifier: GPL-3.0-or-later */
#include <stdlib.h>
#include <string.h>

#include "remesh/distortion.h"
#include "remesh/remesh-frame.h"
#include "stream/declare.h"
#include "stream/parts.h"
#include "transfer/on-nodes.h"
#include "world/world.h"

/* The treatment of a field. */
enum part { GONE, POSITION, STRENGTH, VALUE, VOLUME, UNIFORM, REFUSED };

struct entry {
	struct pm_field *old;
	enum part part;
	int first; /* value of the remesh */
};

/* One set on its way. */
struct work {
	struct pm_remesh r;
	int n;
	struct entry entry[PM_REMESH_VALUES];
	size_t particles;
	const double *x[3], *by;
	bool shared;            /* with other ranks: particles and nodes are those here */
	struct pm_planes planes;
	uint64_t *from, all;    /* [ranks + 1] the first of the kept nodes of every rank; the last is all */
};

static bool is_real(const struct pm_field *field) { return field->type == PM_F64 || field->type == PM_F32; }

static bool is_dropped(const struct pm_field *field, const struct pm_remesh_choice *c)
{
	for (int i = 0; i < c->ndrop; i++)
		if (!strcmp(c->drop[i], field->name))
			return true;
	return false;
}

static enum part part_of(const struct pm_field *field, const struct pm_remesh_choice *c)
{
	if (field->role != PM_STATE || !strcmp(field->name, "id") || !strcmp(field->name, "overlap"))
		return GONE;
	if (!strcmp(field->name, "x"))
		return POSITION;
	if (is_dropped(field, c))
		return GONE;
	if (!strcmp(field->name, "volume"))
		return c->by && !strcmp(c->by, "volume") && is_real(field) ? STRENGTH : VOLUME;
	if (field->extensive && is_real(field))
		return STRENGTH;
	if (field->uniform)
		return field->extensive ? REFUSED : UNIFORM;
	return c->by && is_real(field) ? VALUE : REFUSED;
}

static bool qualifies(const struct pm_frame *f, const char *set, const struct pm_remesh_choice *c)
{
	bool position = false, strength = false;
	for (size_t i = 0; i < f->nfields; i++)
		if (!strcmp(f->fields[i]->on, set)) {
			enum part part = part_of(f->fields[i], c);
			position |= part == POSITION;
			strength |= part == STRENGTH;
		}
	return position && strength;
}

const struct pm_kernel *pm_remesh_kernel(const char *option, const char *by, const struct pm_law *law)
{
	return pm_kernel_choose(!option && by && !strcmp(by, "volume") ? "m6prime" : option, NULL, law, "m4prime");
}

int pm_remesh_choose(const struct pm_frame *f, const char *only, const struct pm_remesh_choice *c, struct pm_sets *sets)
{
	sets->n = 0;
	if (only && !pm_frame_set(f, only))
		return pm_fail(PM_DATA, "no set '%s' (sls lists them)", only);
	for (size_t i = 0; i < f->nsets && sets->n < PM_SETS_MOST; i++) {
		const struct pm_set *set = f->sets[i];
		if ((only ? !strcmp(only, set->name) : !set->fixed) && qualifies(f, set->name, c))
			sets->name[sets->n++] = set->name;
	}
	if (sets->n)
		return 0;
	return pm_fail(PM_DATA, "no set%s%s%s has positions 'x' and a strength (mass, charge, circulation; --by volume carries values alone)", only ? " '" : "",
		only ? only : "", only ? "'" : "");
}

static int refuse(const struct pm_field *field)
{
	if (!is_real(field))
		return pm_fail(PM_DATA, "'%s' on '%s' is of type %s, which cannot be distributed to nodes (--drop %s removes it)", field->name, field->on,
			pm_type_names[field->type], field->name);
	return pm_fail(PM_DATA, "'%s' on '%s' is a value, which cannot be distributed to nodes (--by mass remeshes mass times %s, --drop %s removes it)",
		field->name, field->on, field->name, field->name);
}

int pm_remesh_reads(struct pm_frame *f, const char *set, const struct pm_remesh_choice *c)
{
	const struct pm_field *x = pm_frame_field(f, set, "x"), *by = c->by ? pm_frame_field(f, set, c->by) : NULL;
	if (x->components != f->dim)
		return pm_fail(PM_DATA, "'x' on '%s' has %d components in %d-D", set, x->components, f->dim);
	if (c->by && (!by || part_of(by, c) != STRENGTH || by->components != 1))
		return pm_fail(PM_DATA, "--by %s: no strength of that name and one component on '%s'", c->by, set);
	for (size_t i = 0; i < f->nfields; i++) {
		struct pm_field *field = f->fields[i];
		enum part part = strcmp(field->on, set) ? GONE : part_of(field, c);
		if (part == REFUSED)
			return refuse(field);
		if (part == POSITION || part == STRENGTH || part == VALUE || part == VOLUME)
			field->use |= PM_USE_READ;
		if (!strcmp(field->on, set) && field->role == PM_STATE && (pm_is_strength(field) || !strcmp(field->name, "overlap") ||
			!strcmp(field->name, "volume")))
			field->use |= PM_USE_READ; /* those that are dropped too: they are summed, and the distortion needs the volume */
	}
	return 0;
}

void pm_remesh_drops(struct pm_frame *f, const char *set)
{
	unsigned roles = 1u << PM_CHANGE | 1u << PM_DERIVED;
	pm_drops_roles(f, set, roles | 1u << PM_REGISTER);
	pm_drops_roles(f, NULL, roles);
	json_object_del(pm_frame_set(f, set)->more, "scheme"); /* old rates of a multi-step scheme */
}

/* strength times value, one component. */
static double *product(size_t n, const double *q, const double *value)
{
	double *p = pm_alloc(n, sizeof *p);
#pragma omp parallel for schedule(static) if (n > 16384)
	for (size_t i = 0; i < (p ? n : 0); i++)
		p[i] = q[i] * value[i];
	return p;
}

static int add(struct work *w, struct entry *e, struct pm_strays *strays)
{
	const double *q[PM_COMPONENTS] = {0};
	double *made[PM_COMPONENTS] = {0};
	bool room = true;
	for (int c = 0; c < e->old->components; c++) {
		q[c] = pm_in(e->old, c);
		if (e->part == VALUE) {
			q[c] = made[c] = product(w->particles, w->by, q[c]);
			room = room && made[c];
		}
	}
	e->first = w->r.n;
	int status = pm_world_agree(room ? 0 : -PM_DATA);
	status = status ? status : pm_remesh_add(&w->r, w->particles, w->x, e->old->components, q, e->part == STRENGTH, strays);
	for (int c = 0; c < e->old->components; c++)
		pm_free(made[c]);
	return status;
}

/* The fields of the set, in the order of the stream; strengths and values are distributed to the nodes. */
static int collect(struct pm_frame *f, const char *set, const struct pm_remesh_choice *c, struct work *w, struct pm_strays *strays)
{
	int status = 0;
	w->particles = pm_frame_field(f, set, "x")->count;
	w->by = c->by ? pm_in(pm_frame_field(f, set, c->by), 0) : NULL;
	pm_positions(f, set, w->x);
	for (size_t i = 0; i < f->nfields && !status; i++) {
		struct entry e = {.old = f->fields[i]};
		if (strcmp(e.old->on, set))
			continue;
		if (w->n == PM_REMESH_VALUES)
			return pm_fail(PM_DATA, "more than %d fields on '%s' to remesh (leave some out with --drop)", PM_REMESH_VALUES, set);
		e.part = part_of(e.old, c);
		if (e.part == STRENGTH || e.part == VALUE)
			status = add(w, &e, strays);
		w->entry[w->n++] = e;
	}
	return status;
}

/* Component k of what the kept nodes have of a field. With other ranks they hold it as their planes have it, and it travels to where the new particles are. */
static int fill(int status, const struct work *w, const struct entry *e, int k, const uint64_t *to, double *out)
{
	double *own = status ? NULL : w->shared ? pm_alloc(w->r.kept + 1, sizeof *own) : out;
	if (!status && !own)
		status = pm_failed();
	if (!status && e->part == POSITION)
		pm_remesh_position(&w->r, k, own);
	else if (!status && e->part == VOLUME)
		pm_remesh_volume(&w->r, own);
	else if (!status)
		pm_remesh_value(&w->r, e->first + k, own);
	if (w->shared) {
		status = pm_world_recut(status, w->from, to, sizeof *own, own, out);
		pm_free(own);
	}
	return status;
}

static int divide(const struct work *w, const struct pm_remesh_choice *c, struct pm_field *made)
{
	double *by = pm_alloc(made->count + 1, sizeof *by);
	int status = by ? 0 : -PM_DATA;
	for (int i = 0; i < w->n; i++)
		if (!strcmp(w->entry[i].old->name, c->by))
			status = fill(status, w, &w->entry[i], 0, made->from, by);
	for (size_t p = 0; p < made->count && !status; p++)
		if (by[p] == 0)
			status = pm_fail(PM_DATA, "a node has no '%s' but another strength: '%s' is not defined there (--drop %s, or a positive kernel)", c->by,
				made->name, made->name);
	for (int k = 0; k < made->components && !status; k++)
		for (size_t p = 0; p < made->count; p++)
			pm_out(made, k)[p] /= by[p];
	pm_free(by);
	return status;
}

/* All nodes are kept, and nobody else needs the strengths that they have: then they are the field. */
static bool adopt(struct work *w, const struct pm_remesh_choice *c, const struct entry *e, struct pm_field *made)
{
	if (e->part != STRENGTH || c->by || w->shared || w->r.kept != w->r.points || made->components != 1 || made->type != PM_F64)
		return false;
	const bool adopted = pm_field_adopt(made, w->r.node[e->first]);
	if (adopted)
		w->r.node[e->first] = NULL;
	return adopted;
}

static int renew(struct pm_frame *f, const char *set, struct work *w, const struct pm_remesh_choice *c, const struct entry *e)
{
	const struct pm_field *old = e->old;
	if (e->part == GONE) {
		pm_drops(f, e->old);
		return 0;
	}
	struct pm_field *made = pm_makes(f, set, old->name, old->components, PM_STATE);
	int status = made ? 0 : -PM_DATA;
	bool there = false;
	if (made) {
		json_decref(made->more);
		made->more = json_deep_copy(old->more);
		made->extensive = old->extensive;
		made->type = old->type;
		made->uniform = e->part == UNIFORM;
		made->use |= PM_USE_FILL;
		memcpy(made->unit, old->unit, sizeof made->unit);
		memcpy(made->value, old->value, sizeof made->value);
		status = w->shared ? pm_field_share(made, pm_sum_block) : 0;
		there = !status && adopt(w, c, e, made);
		status = status || there ? status : pm_field_ready(made);
	}
	status = pm_world_agree(status);
	for (int k = 0; !status && !there && e->part != UNIFORM && k < made->components; k++)
		status = fill(status, w, e, k, made->from, pm_out(made, k));
	if (!status && e->part == VALUE)
		status = divide(w, c, made);
	if (made && made->type == PM_F64)
		made->use |= PM_USE_DONE;
	if (!status && (e->part == STRENGTH || ((e->part == POSITION || e->part == VOLUME) && pm_remesh_is_finite(&w->r))))
		made->use |= PM_USE_SEEN; /* strengths were looked at on the nodes */
	if (!status && e->part == STRENGTH && made->components == 1 && made->type == PM_F64 && !w->shared)
		made->within = w->r.most[e->first];
	return pm_world_agree(status);
}

/* The particles are nodes of a periodic mesh, in its order: p2m and m2p need not look whether they are. */
static void note_nodes(const struct pm_frame *f, const char *set, const struct pm_grid *g, const struct work *w)
{
	const struct pm_field *x = pm_frame_field(f, set, "x");
	bool can = !w->shared && w->r.kept && x->type == PM_F64;
	for (int d = 0; d < g->dim; d++)
		can = can && g->face[d][0] == PM_PERIODIC;
	if (can)
		pm_on_nodes_keep(g, x);
}

static int keep_overlap(struct pm_frame *f, const char *set, const struct pm_mesh *m, const struct work *w)
{
	const struct pm_field *volume = pm_frame_field(f, set, "volume");
	const struct pm_grid g = pm_grid_of(f, m);
	const double *x[3];
	struct pm_field *made = pm_makes(f, set, "overlap", 1, PM_STATE);
	int status = made ? 0 : -PM_DATA;
	if (!status && w->shared)
		status = pm_field_share(made, pm_sum_block);
	status = pm_world_agree(status ? status : pm_field_ready(made));
	pm_positions(f, set, x);
	return status ? status : pm_overlap(&g, w->shared ? &w->planes : NULL, made->count, x, volume ? pm_in(volume, 0) : NULL, pm_out(made, 0));
}

/* What the nodes cut off held, and, if particles lay outside, what the set had more than all nodes together. */
static void note_loss(const struct work *w, const struct pm_strengths *before, const struct pm_strays *strays, struct pm_remesh_loss *loss)
{
	*loss = (struct pm_remesh_loss){.cut = w->r.cut, .strays = strays->count};
	for (int i = 0; i < w->n; i++)
		for (int c = 0; c < w->entry[i].old->components && w->entry[i].part == STRENGTH && loss->under.n < PM_STRENGTHS; c++) {
			const int value = w->entry[i].first + c;
			struct pm_strength *one = &loss->under.of[loss->under.n++], *out = &loss->outside.of[loss->outside.n++];
			pm_strength_name(w->entry[i].old, c, one->name);
			memcpy(out->name, one->name, sizeof out->name);
			one->sum = w->r.lost[value];
			const struct pm_strength *all = pm_strength_find(before, w->entry[i].old->on, one->name);
			out->sum = strays->count && all ? all->sum - pm_remesh_total(&w->r, value) : 0;
		}
}

/* In and out agree but for the losses that are counted. */
static int balance(const struct pm_frame *f, const char *set, const struct pm_strengths *before, const struct pm_remesh_loss *loss)
{
	struct pm_strengths after;
	pm_strengths_of(f, set, &after);
	for (int i = 0; i < loss->under.n; i++) {
		const char *name = loss->under.of[i].name;
		const struct pm_strength *in = pm_strength_find(before, set, name), *out = pm_strength_find(&after, set, name);
		const double counted = loss->under.of[i].sum + loss->outside.of[i].sum, off = in && out ? out->sum + counted - in->sum : 0;
		if (in && fabs(off) > pm_strength_tolerance * in->scale)
			return pm_fail(PM_NUMERICS, "the sum of '%s' of '%s' was %.6g and is %.6g, with %.3g counted as lost: %.3g is missing (an error of "
				"remesh; another --kernel may do)", name, set, in->sum, out->sum, counted, -off);
	}
	return 0;
}

/* The planes of this rank, where the particles are divided. */
static int share(struct pm_frame *f, const char *set, const struct pm_mesh *m, const struct pm_grid *g, struct work *w)
{
	struct pm_field nodes = {.count = pm_grid_size(g)};
	if (!(w->shared = pm_frame_field(f, set, "x")->here))
		return 0;
	int status = pm_field_share(&nodes, pm_division_grain(f, m->name));
	status = pm_world_agree(status ? status : pm_planes_init(&w->planes, g, &nodes));
	free((void *)(uintptr_t)nodes.from);
	if (!status)
		pm_remesh_share(&w->r, &w->planes);
	return status;
}

/* How many particles there will be, and whose planes have them. */
static int count(struct work *w)
{
	const size_t ranks = (size_t)pm_world_size();
	w->all = w->r.kept;
	if (!w->shared)
		return 0;
	int status = (w->from = calloc(ranks + 1, sizeof *w->from)) ? 0 : pm_no_memory();
	if (!status)
		w->from[pm_world_rank() + 1] = w->r.kept;
	status = pm_world_count(status, PM_SUM_OF, ranks + 1, (int64_t *)w->from);
	for (size_t r = 0; r < ranks && !status; r++)
		w->from[r + 1] += w->from[r];
	w->all = status ? 0 : w->from[ranks];
	return status;
}

/* Particles that the mesh has no room for. Their number becomes that of all ranks. */
static int judge(const struct pm_frame *f, const char *set, const struct pm_mesh *m, const struct pm_transfer *t, const struct pm_remesh_choice *c,
	struct pm_strays *strays)
{
	int status = 0;
	int64_t all = (int64_t)strays->count;
	strays->first += pm_frame_field(f, set, "x")->first;
	if (strays->count && !c->out && c->mask)
		status = pm_fail(PM_DATA, "particle %zu of '%s' is beyond the mesh, or deeper in a body than 16 cells (a smaller step, or --outside "
			"drop)", strays->first, set);
	else if (strays->count && !c->out)
		status = pm_strays_refuse(strays, set, m, t, "a larger box, --outside grow or drop, or a --cut-off that keeps particles from spreading");
	status = pm_world_count(status, PM_SUM_OF, 1, &all);
	strays->count = (uint64_t)all;
	return status;
}

int pm_remesh_set(struct pm_frame *f, const char *set, const struct pm_mesh *m, const struct pm_remesh_choice *c, struct pm_remesh_loss *loss)
{
	const struct pm_grid g = pm_grid_of(f, m);
	struct work w = {.r = pm_remesh_on(&g, c->kernel)};
	struct pm_strays strays = {.count = 0};
	struct pm_strengths before;
	double square, kept;
	pm_strengths_of(f, set, &before);
	pm_remesh_squared(f, set, c, &square);
	w.r.mask = c->mask;
	const struct pm_transfer t = {.grid = g, .kernel = c->kernel};
	int status = share(f, set, m, &g, &w);
	status = status ? status : collect(f, set, c, &w, &strays);
	status = status ? status : judge(f, set, m, &t, c, &strays);
	status = status ? status : pm_remesh_keep(&w.r, c->cut_off, c->rim);
	status = status ? status : count(&w);
	if (!status) {
		note_loss(&w, &before, &strays, loss);
		pm_frame_set(f, set)->n = w.all;
	}
	for (int i = 0; i < w.n && !status; i++)
		status = renew(f, set, &w, c, &w.entry[i]);
	if (!status && pm_remesh_squared(f, set, c, &kept) && square > 0)
		loss->square = 1 - kept / square;
	if (!status)
		status = balance(f, set, &before, loss);
	if (!status)
		note_nodes(f, set, &g, &w);
	if (!status && c->overlap)
		status = keep_overlap(f, set, m, &w);
	pm_remesh_free(&w.r);
	pm_planes_free(&w.planes);
	free(w.from);
	return status;
}
