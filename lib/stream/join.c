/* Frames made from other frames. SPDX-License-Identifier: GPL-3.0-or-later */
#include <stdlib.h>
#include <string.h>

#include "stream/frame-time.h"
#include "stream/join.h"
#include "stream/parts-file.h"
#include "stream/run.h"
#include "world/world.h"

/* ---- less ---- */

static void fields_remove(struct pm_frame *f, const char *on, unsigned roles)
{
	for (size_t i = f->nfields; i-- > 0;)
		if ((!on || !strcmp(f->fields[i]->on, on)) && roles >> f->fields[i]->role & 1)
			pm_drops(f, f->fields[i]);
}

void pm_frame_remove(struct pm_frame *f, const char *name)
{
	fields_remove(f, name, ~0u);
	for (size_t i = 0; i < f->nsets; i++)
		if (!strcmp(f->sets[i]->name, name)) {
			json_decref(f->sets[i]->more);
			free(f->sets[i]);
			memmove(f->sets + i, f->sets + i + 1, (--f->nsets - i) * sizeof *f->sets);
			return;
		}
	for (size_t i = 0; i < f->nmeshes; i++)
		if (!strcmp(f->meshes[i]->name, name)) {
			json_decref(f->meshes[i]->more);
			free(f->meshes[i]);
			memmove(f->meshes + i, f->meshes + i + 1, (--f->nmeshes - i) * sizeof *f->meshes);
			return;
		}
}

static void compact(struct pm_field *field, const unsigned char *keep)
{
	size_t size = pm_field_memory(field), n = field->count;
	for (int c = 0; c < field->components; c++) {
		char *y = (char *)pm_field_bytes(field) + (size_t)c * n * size;
		for (size_t i = 0, k = 0; i < n; i++)
			if (keep[i])
				memmove(y + k++ * size, y + i * size, size);
	}
}

/* In a divided frame: what is kept here, then cut anew among the ranks. */
static int select_here(struct pm_frame *f, struct pm_set *set, size_t n, const unsigned char *keep)
{
	const size_t ranks = (size_t)pm_world_size(), me = (size_t)pm_world_rank();
	uint64_t *from = calloc(ranks + 1, sizeof *from), *to = NULL;
	for (size_t i = 0; from && i < n; i++)
		from[me + 1] += keep[i] != 0;
	int status = pm_world_count(from ? 0 : pm_no_memory(), PM_SUM_OF, ranks + 1, (int64_t *)from);
	for (size_t r = 0; r < ranks && !status; r++)
		from[r + 1] += from[r];
	if (!status && !(to = pm_division_new(from[ranks], pm_sum_block)))
		status = pm_failed();
	status = pm_world_agree(status);
	for (size_t i = 0; i < f->nfields && !status; i++) {
		struct pm_field *field = f->fields[i];
		if (strcmp(field->on, set->name))
			continue;
		if (field->here && !field->uniform) {
			compact(field, keep);
			status = pm_field_recut(status, field, from, to);
			continue;
		}
		pm_field_forget(field); /* equal values need no data */
		if (field->here) {
			memcpy((uint64_t *)(uintptr_t)field->from, to, (ranks + 1) * sizeof *to);
			pm_field_enter(field, field->from);
		} else
			field->count = (size_t)from[ranks];
	}
	if (!status)
		set->n = from[ranks];
	free(from), free(to);
	return status;
}

int pm_frame_select(struct pm_frame *f, struct pm_set *set, const unsigned char *keep)
{
	size_t left = 0;
	for (size_t i = 0; i < f->nfields; i++)
		if (!strcmp(f->fields[i]->on, set->name) && f->fields[i]->here)
			return select_here(f, set, f->fields[i]->count, keep);
	for (size_t i = 0; i < set->n; i++)
		left += keep[i] != 0;
	for (size_t i = 0; i < f->nfields; i++)
		if (!strcmp(f->fields[i]->on, set->name) && pm_field_bytes(f->fields[i]))
			compact(f->fields[i], keep);
	return pm_frame_set_resize(f, set, left);
}

/* ---- more ---- */

static const unsigned passing = 1u << PM_CHANGE | 1u << PM_DERIVED | 1u << PM_REGISTER;

static int same_constants(const struct pm_frame *a, const struct pm_frame *b)
{
	const char *key;
	json_t *value;
	json_object_foreach(b->constants, key, value) {
		json_t *here = json_object_get(a->constants, key);
		if (!here)
			json_object_set(a->constants, key, value);
		else if (json_is_number(here) && json_is_number(value) ? json_number_value(here) != json_number_value(value) : !json_equal(here, value))
			return pm_fail(PM_DATA, "the constant %s is %.10g in one scene and %.10g in another (smod --constant %s=...)",
				key, json_number_value(here),
				json_number_value(value), key);
	}
	return 0;
}

static int same_physics(const struct pm_frame *a, const struct pm_frame *b)
{
	if (a->dim != b->dim)
		return pm_fail(PM_DATA, "one scene has %d dimensions, another %d", a->dim, b->dim);
	if (strcmp(a->law, b->law))
		return pm_fail(PM_DATA, "one scene obeys the law %s, another %s (smod --law)", a->law, b->law);
	if (a->time != b->time)
		return pm_fail(PM_DATA, "one scene is at time %.10g, another at %.10g (smod --time)", a->time, b->time);
	if (memcmp(a->face, b->face, sizeof a->face) || memcmp(a->pface, b->pface, sizeof a->pface))
		return pm_fail(PM_DATA, "the scenes have different faces (smod --faces, --particle-faces)");
	for (int d = 0; d < a->dim; d++)
		if (a->face[d][0] == PM_PERIODIC && (a->lo[d] != b->lo[d] || a->hi[d] != b->hi[d]))
			return pm_fail(PM_DATA, "the scenes are periodic along %c with different boxes (smod --box)", "xyz"[d]);
	return same_constants(a, b);
}

static int at_rest(const struct pm_frame *f)
{
	for (size_t i = 0; i < f->nfields; i++)
		if (pm_frame_mesh(f, f->fields[i]->on) && f->fields[i]->role == PM_STATE)
			return pm_fail(PM_DATA, "the mesh field '%s' is state, which cannot be combined (remove it with sel --drop)",
				f->fields[i]->name);
	return f->substep ? pm_fail(PM_DATA, "a scene is inside a step (substep %d); scenes can be combined only between steps", f->substep) : 0;
}

void pm_frame_meshes_span(struct pm_frame *f)
{
	for (size_t i = 0; i < f->nmeshes; i++)
		for (int a = 0; a < f->dim; a++) {
			f->meshes[i]->lo[a] = f->lo[a];
			f->meshes[i]->h[a] = (f->hi[a] - f->lo[a]) / (double)f->meshes[i]->cells[a];
		}
}

/* The name a set gets in frame a. */
static int set_name(const struct pm_frame *a, const struct pm_frame *b, const struct pm_set *set, const struct pm_join *join, char name[PM_NAME])
{
	const char *base = join->frames < (size_t)join->nnames ? join->names[join->frames] : set->name;
	if (base != set->name && b->nsets > 1)
		return pm_fail(PM_DATA, "the %zu sets of one scene cannot all be called '%s' (rename them with smod --rename)", b->nsets, base);
	snprintf(name, PM_NAME, "%s", base);
	for (int k = 2; a && !join->merge && (pm_frame_set(a, name) || pm_frame_mesh(a, name)); k++)
		snprintf(name, PM_NAME, "%.50s-%d", base, k);
	return 0;
}

static void next_id(const struct pm_frame *f, struct pm_join *join)
{
	for (size_t i = 0; i < f->nfields; i++) {
		const struct pm_field *p = f->fields[i];
		if (strcmp(p->name, "id") || p->type != PM_I64 || !pm_field_bytes((struct pm_field *)(uintptr_t)p))
			continue;
		for (size_t k = 0; k < p->count; k++)
			if (pm_in_i64(p, 0)[k] >= join->next_id && pm_in_i64(p, 0)[k] < INT64_MAX)
				join->next_id = pm_in_i64(p, 0)[k] + 1;
	}
}

/* Copies the values of `from` to `to` from index `at` on; adds offset to ids. */
static void values_copy(struct pm_field *to, size_t at, const struct pm_field *from, int64_t offset)
{
	size_t size = pm_field_memory(to);
	for (int c = 0; c < to->components; c++) {
		const char *y = (const char *)pm_field_bytes((struct pm_field *)(uintptr_t)from) + (size_t)c * from->count * size;
		memcpy((char *)pm_field_bytes(to) + ((size_t)c * to->count + at) * size, y, from->count * size);
	}
	for (size_t i = 0; offset && i < from->count; i++)
		pm_out_i64(to, 0)[at + i] += offset;
}

/* parts: with the values, which ranks have. */
static struct pm_field *field_like(struct pm_frame *f, const char *on, const struct pm_field *p, bool parts)
{
	struct pm_field *q = pm_makes(f, on, p->name, p->components, p->role);
	if (!q)
		return NULL;
	q->type = p->type, q->extensive = p->extensive, q->uniform = p->uniform;
	memcpy(q->value, p->value, sizeof q->value);
	memcpy(q->unit, p->unit, PM_NAME), memcpy(q->of, p->of, PM_NAME);
	json_object_update(q->more, p->more);
	if (parts) {
		q->use = 0;
		q->buffer = p->buffer;
		atomic_fetch_add(&q->buffer->users, 1);
		return q;
	}
	const bool ready = !pm_field_ready(q);
	q->use = 0; /* values are copied, whatever they are */
	return ready ? q : NULL;
}

static bool same_value(const struct pm_field *p, const struct pm_field *q)
{
	return p->uniform && q->uniform && !memcmp(p->value, q->value, (size_t)p->components * sizeof *p->value);
}

/* Appends the values of b's field to a's; if the result is not uniform, both are expanded. */
static int field_append(struct pm_frame *a, const char *on, const struct pm_field *q, size_t before, int64_t offset)
{
	struct pm_field *p = pm_frame_field(a, on, q->name), *spelt;
	if (!p || p->components != q->components || p->type != q->type || p->extensive != q->extensive)
		return pm_fail(PM_DATA, "'%s' on '%s' is missing in some scene, or differs in kind (--merge needs the same fields; sel --drop)", q->name, on);
	if (same_value(p, q))
		return 0;
	if (p->uniform || !p->buffer) { /* ready fills the values in; those of no particles have no memory yet */
		p->uniform = false, p->use = PM_USE_CHANGE;
		if (!p->buffer && pm_field_ready(p))
			return -PM_DATA;
		p->use = 0;
	}
	if (!(spelt = pm_field_copy(q, true)))
		return -PM_DATA;
	spelt->use = PM_USE_READ;
	int status = pm_field_ready(spelt);
	if (!status)
		values_copy(p, before, spelt, offset);
	pm_field_free(spelt);
	return status;
}

static bool same_kind(const struct pm_field *p, const struct pm_field *q)
{
	return p->components == q->components && p->type == q->type && p->extensive == q->extensive;
}

/* Values that ranks have, of fields of any of which rank 0 has no copy: appended by all, in front of the others. made: of each field of a; NULL: not so. */
static int parts_append(struct pm_frame *a, struct pm_set *into, const struct pm_frame *b, const char *set, int64_t offset, struct pm_buffer **made)
{
	int status = 0;
	for (size_t i = 0; i < a->nfields && !status; i++) {
		struct pm_field *p = a->fields[i];
		const struct pm_field *q = strcmp(p->on, into->name) ? NULL : pm_frame_field(b, set, p->name);
		if (!q || !same_kind(p, q) || p->uniform || q->uniform || (offset && !strcmp(p->name, "id")) || !(pm_parts_alone(p) || pm_parts_alone(q)))
			continue;
		if (!p->buffer || !q->buffer) /* of no particles */
			continue;
		uint64_t *cut[] = {pm_division_new(p->count, pm_sum_block), pm_division_new(q->count, pm_sum_block), pm_division_new(p->count + q->count,
			pm_sum_block)};
		status = cut[0] && cut[1] && cut[2] ? 0 : pm_no_memory();
		status = status ? status : pm_buffer_divide(p->buffer, p->components, pm_field_memory(p), cut[0]);
		status = status ? status : pm_buffer_divide(q->buffer, q->components, pm_field_memory(q), cut[1]);
		status = status ? status : pm_buffer_append(p->buffer, q->buffer, cut[2], &made[i]);
		free(cut[0]), free(cut[1]), free(cut[2]);
		if (!status)
			p->buffer = pm_buffer_free(p->buffer); /* there is nothing to resize */
	}
	return status;
}

static int set_merge(struct pm_frame *a, struct pm_set *into, const struct pm_frame *b, const struct pm_set *set, int64_t offset)
{
	size_t before = into->n, nfields = 0, expected = 0;
	struct pm_buffer **made = calloc(a->nfields + 1, sizeof *made);
	int status = made ? parts_append(a, into, b, set->name, offset, made) : pm_no_memory();
	status = status ? status : pm_frame_set_resize(a, into, into->n + set->n);
	for (size_t i = 0; made && i < a->nfields; i++) {
		expected += !strcmp(a->fields[i]->on, into->name);
		if (made[i])
			a->fields[i]->buffer = made[i], a->fields[i]->finite = false;
	}
	for (size_t i = 0; i < b->nfields && !status; i++)
		if (!strcmp(b->fields[i]->on, set->name) && !(passing >> b->fields[i]->role & 1)) {
			bool done = false;
			for (size_t k = 0; k < a->nfields; k++)
				done |= made[k] && !strcmp(a->fields[k]->name, b->fields[i]->name);
			if (!done)
				status = field_append(a, into->name, b->fields[i], before, strcmp(b->fields[i]->name, "id") ? 0 : offset);
			nfields++;
		}
	free(made);
	return status ? status : nfields == expected ? 0
		: pm_fail(PM_DATA, "'%s' has fields that are missing in some scene (--merge needs the same fields; sel --drop)", into->name);
}

static int set_add(struct pm_frame *a, const char *name, const struct pm_frame *b, const struct pm_set *set, int64_t offset)
{
	struct pm_set *s = pm_frame_set_new(a, name, set->n);
	if (!s)
		return pm_no_memory();
	s->fixed = set->fixed;
	for (size_t i = 0; i < b->nfields; i++) {
		const struct pm_field *p = b->fields[i];
		if (strcmp(p->on, set->name) || passing >> p->role & 1)
			continue;
		const bool parts = pm_parts_alone(p) && !(offset && !strcmp(p->name, "id"));
		struct pm_field *q = field_like(a, name, p, parts);
		if (!q)
			return -PM_DATA;
		if (!p->uniform && !parts)
			values_copy(q, 0, p, strcmp(p->name, "id") ? 0 : offset);
	}
	return 0;
}

/* The number to add to the ids of b so that none is below next_id; 0 if none is. */
static int64_t id_offset(const struct pm_frame *b, const struct pm_join *join)
{
	int64_t least = INT64_MAX;
	for (size_t i = 0; i < b->nfields; i++)
		for (size_t k = 0; !strcmp(b->fields[i]->name, "id") && b->fields[i]->type == PM_I64 && b->fields[i]->buffer && k < b->fields[i]->count; k++)
			least = pm_in_i64(b->fields[i], 0)[k] < least ? pm_in_i64(b->fields[i], 0)[k] : least;
	return least >= join->next_id ? 0 : join->next_id - least;
}

static void history_join(struct pm_frame *a, const struct pm_frame *b)
{
	size_t i, k;
	json_t *e, *h;
	json_array_foreach(b->history, i, e) {
		bool there = false;
		json_array_foreach(a->history, k, h) there |= json_equal(h, e) == 1;
		if (!there)
			json_array_append_new(a->history, json_deep_copy(e));
	}
}

int pm_frame_join_first(struct pm_frame *a, struct pm_join *join)
{
	char name[PM_NAME];
	int status = at_rest(a);
	fields_remove(a, NULL, passing);
	for (size_t i = 0; i < a->nsets && !status; i++) {
		char old[PM_NAME];
		if ((status = set_name(NULL, a, a->sets[i], join, name)))
			break;
		memcpy(old, a->sets[i]->name, PM_NAME);
		for (size_t k = 0; k < a->nfields; k++)
			if (!strcmp(a->fields[k]->on, old))
				memcpy(a->fields[k]->on, name, PM_NAME);
		memcpy(a->sets[i]->name, name, PM_NAME);
	}
	next_id(a, join);
	join->frames++;
	return status;
}

int pm_frame_join(struct pm_frame *a, const struct pm_frame *b, struct pm_join *join)
{
	char name[PM_NAME];
	int status;
	if ((status = at_rest(b)) || (status = same_physics(a, b)))
		return status;
	int64_t offset = id_offset(b, join);
	for (size_t i = 0; i < b->nsets && !status; i++) {
		if ((status = set_name(a, b, b->sets[i], join, name)))
			break;
		struct pm_set *into = join->merge ? pm_frame_set(a, name) : NULL;
		status = into ? set_merge(a, into, b, b->sets[i], offset) : set_add(a, name, b, b->sets[i], offset);
	}
	for (int d = 0; d < a->dim; d++)
		a->lo[d] = fmin(a->lo[d], b->lo[d]), a->hi[d] = fmax(a->hi[d], b->hi[d]);
	pm_frame_dt_set(a, a->dt > 0 && b->dt > 0 ? fmin(a->dt, b->dt) : fmax(a->dt, b->dt));
	pm_frame_meshes_span(a);
	next_id(a, join);
	history_join(a, b);
	if (strcmp(a->scene, b->scene) || !json_equal(a->parameters, b->parameters)) {
		snprintf(a->scene, PM_NAME, "stack");
		json_object_clear(a->parameters);
	}
	join->frames++;
	return status;
}
