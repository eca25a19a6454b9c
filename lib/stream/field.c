/* Field data: reference-counted buffers, copied on write; uniform values are expanded when they are read.
 * SPDX-License-Identifier: GPL-3.0-or-later */
#include <stdlib.h>
#include <string.h>

#include "stream/later.h"
#include "stream/limits.h"
#include "stream/parts.h"
#include "stream/run.h"
#include "world/world.h"

static bool is_real(const struct pm_field *field) { return field->type == PM_F64 || field->type == PM_F32; }

size_t pm_field_memory(const struct pm_field *field) { return field->type == PM_U8 ? 1 : 8; }

static size_t values(const struct pm_field *field) { return field->count * (size_t)field->components; }

/* The values will change: what is known of them is not true any longer. */
static void forget_note(struct pm_field *field)
{
	if (field->note)
		field->note->free(field->note);
	field->note = NULL;
	field->summed = false;
	field->within = 0;
}

/* ---- f32 ---- */

bool pm_field_rests(const struct pm_field *field) { return field->type == PM_F32 && !field->here && pm_world_alone(); }

float *pm_field_floats(const struct pm_field *field) { return field->buffer && !field->here ? field->buffer->floats : NULL; }

static void to_doubles(size_t n, const float *from, double *to)
{
#pragma omp parallel for schedule(static) if (n > 65536)
	for (size_t i = 0; i < n; i++)
		to[i] = from[i];
}

/* Doubles beside the floats. */
static int widen(const struct pm_field *field)
{
	struct pm_buffer *b = field->buffer;
	double *data = pm_alloc(values(field), sizeof *data);
	if (!data)
		return -PM_DATA;
	to_doubles(values(field), b->floats, data);
	b->data = data;
	return 0;
}

static struct pm_buffer *new_floats(const struct pm_field *field, bool zero)
{
	struct pm_buffer *b = pm_buffer_new(values(field), sizeof *b->floats, zero);
	if (b)
		pm_buffer_to_floats(b);
	return b;
}

/* Floats alone, rounded. */
static int narrow(struct pm_field *field)
{
	struct pm_buffer *b = field->buffer, *made = b->floats ? NULL : new_floats(field, false);
	const double *data = b->data;
	const size_t n = values(field);
	if (!b->floats && !made)
		return -PM_DATA;
	if (!b->floats) {
		float *restrict to = made->floats;
#pragma omp parallel for schedule(static) if (n > 65536)
		for (size_t i = 0; i < n; i++)
			to[i] = (float)data[i];
	}
	if (made) { /* other frames may have the doubles, as such */
		pm_buffer_free(b);
		field->buffer = made;
	} else
		pm_buffer_drop_data(b);
	return 0;
}

int pm_field_hold_floats(struct pm_field *field)
{
	struct pm_buffer *b = new_floats(field, false);
	if (!b)
		return -PM_DATA;
	pm_field_forget(field);
	field->buffer = b;
	return 0;
}

bool pm_field_adopt(struct pm_field *field, double *data)
{
	struct pm_buffer *b = pm_buffer_adopt(data);
	if (b) {
		pm_field_forget(field);
		field->buffer = b;
	}
	return b;
}

/* One number as doubles, for a stage that takes columns and yet asks for them. */
static int expand(const struct pm_field *field)
{
	struct pm_buffer *b = pm_buffer_new(values(field), sizeof(double), false);
	double *y = b ? b->data : NULL;
	if (!b)
		return -PM_DATA;
	for (int c = 0; c < field->components; c++)
		for (size_t i = 0; i < field->count; i++)
			*y++ = field->value[c];
	((struct pm_field *)(uintptr_t)field)->buffer = b; /* the values are the same */
	return 0;
}

struct pm_later *pm_later_free(struct pm_later *later)
{
	if (later && later->free)
		later->free(later);
	if (later)
		pm_field_free(later->from);
	free(later);
	return NULL;
}

const struct pm_later *pm_field_later_of(const struct pm_field *field) { return field->buffer ? field->buffer->later : NULL; }

struct pm_later *pm_field_later_alone(struct pm_field *field) { return field->buffer && pm_buffer_alone(field->buffer) ? field->buffer->later : NULL; }

int pm_field_later(struct pm_field *field, struct pm_later *later, const struct pm_field *from)
{
	struct pm_buffer *b = calloc(1, sizeof *b);
	later->from = b ? pm_field_held(from) : NULL;
	if (!later->from) {
		free(b), pm_later_free(later);
		return pm_no_memory();
	}
	atomic_init(&b->users, 1);
	b->later = later;
	pm_field_forget(field);
	field->buffer = b;
	return 0;
}

static int make_now(const struct pm_field *field)
{
	struct pm_buffer *b = field->buffer;
	double *data = pm_alloc(values(field), sizeof *data);
	int status = data ? b->later->make(b->later, data) : -PM_DATA;
	if (status) {
		pm_free(data);
		return status;
	}
	b->oscillation = b->later->oscillation ? b->later->oscillation(b->later, data) : 0;
	b->later = pm_later_free(b->later);
	b->data = data;
	return 0;
}

static int bring(const struct pm_field *field)
{
	if (!field->buffer)
		return field->uniform && is_real(field) ? expand(field) : pm_fail(PM_DATA, "the values of '%s' are not here", field->name);
	if (field->buffer->later)
		return make_now(field);
	return field->buffer->data ? 0 : field->buffer->floats ? widen(field) : pm_buffer_join(field->buffer);
}

int pm_held_bring(const struct pm_field *field) { return field->buffer && field->buffer->data ? 0 : bring(field); }

/* The values: in a divided frame this rank's, else all of them, brought together where they are divided. */
static void *base_of(const struct pm_field *field)
{
	if (!field->here && !(field->buffer && field->buffer->data)) {
#pragma omp critical(pm_join) /* whoever asks first: threads may do so in a loop */
		if (bring(field))
			pm_cannot_go_on();
	}
	return field->here ? field->buffer->part : field->buffer->data;
}

/* All values will change on rank 0. */
static void *base_to_change(struct pm_field *field)
{
	void *base = base_of(field);
	if (!field->here && field->buffer->floats) /* the same */
		pm_buffer_drop_floats(field->buffer);
	if (field->summed) /* threads may ask, after the first one has */
		field->summed = false;
	if (!field->here && field->buffer->id)
		pm_buffer_undivide(field->buffer);
	return base;
}

struct pm_field *pm_field_held(const struct pm_field *field)
{
	struct pm_field *c = pm_field_copy(field, false);
	if (c && (c->buffer = field->buffer))
		atomic_fetch_add(&c->buffer->users, 1);
	return c;
}

void pm_held_free(struct pm_field *held) { pm_field_free(held); }

struct pm_later *pm_field_later_take(struct pm_field *field)
{
	struct pm_later *later = field->buffer->later;
	struct pm_field *from = later->from;
	if (!pm_buffer_alone(from->buffer)) {
		struct pm_buffer *b = pm_buffer_new(values(field), sizeof(double), false);
		if (!b)
			return NULL;
		memcpy(b->data, from->buffer->data, values(field) * sizeof(double));
		pm_buffer_free(from->buffer);
		from->buffer = b;
	}
	field->buffer->later = NULL;
	pm_field_forget(field);
	field->buffer = from->buffer;
	from->buffer = NULL;
	return later;
}

struct pm_field *pm_field_copy(const struct pm_field *field, bool with_data)
{
	struct pm_field *c = malloc(sizeof *c);
	if (!c) {
		pm_no_memory();
		return NULL;
	}
	*c = *field;
	c->more = json_deep_copy(field->more);
	c->use = 0;
	c->note = NULL;
	c->within = 0;
	if (!with_data)
		c->buffer = NULL;
	else if (c->buffer)
		atomic_fetch_add(&c->buffer->users, 1);
	return c;
}

struct pm_field *pm_field_free(struct pm_field *field)
{
	if (field) {
		forget_note(field);
		pm_buffer_free(field->buffer);
		json_decref(field->more);
		free(field);
	}
	return NULL;
}

int pm_field_hold(struct pm_field *field)
{
	struct pm_buffer *b = pm_buffer_new(values(field), pm_field_memory(field), false);
	if (!b)
		return -PM_DATA;
	forget_note(field);
	pm_buffer_free(field->buffer);
	field->buffer = b;
	return 0;
}

static void fill(struct pm_field *field)
{
	for (int c = 0; c < field->components; c++) {
		double v = field->value[c];
		size_t n = field->count;
		if (is_real(field)) {
			double *y = pm_out(field, c);
			for (size_t i = 0; i < n; i++)
				y[i] = v;
		} else if (field->type == PM_I64) {
			int64_t *y = pm_out_i64(field, c);
			for (size_t i = 0; i < n; i++)
				y[i] = (int64_t)v;
		} else
			memset(pm_out_u8(field, c), (int)v, n);
	}
}

/* The same in a divided frame, where buffers have parts alone. */
static int ready_here(struct pm_field *field)
{
	struct pm_buffer *old = field->buffer, *b;
	const bool change = field->use & PM_USE_CHANGE, copies = old && change && atomic_load(&old->users) > 1, fills = !old && !(field->use & PM_USE_NEW);
	if (old && change && !copies)
		old->data = pm_free(old->data); /* soon out of date */
	if ((old && !copies) || (!old && field->use & PM_USE_NEW && field->uniform))
		return 0;
	if (!(b = pm_buffer_new(values(field), pm_field_memory(field), !old && !fills && !(field->use & PM_USE_FILL))))
		return -PM_DATA;
	b->part = b->data;
	b->data = NULL;
	if (copies)
		memcpy(b->part, old->part, values(field) * pm_field_memory(field));
	pm_buffer_free(old);
	field->buffer = b;
	if (fills)
		fill(field);
	return 0;
}

/* One that rests, of a stage that takes columns. */
static int ready_floats(struct pm_field *field)
{
	const bool change = field->use & PM_USE_CHANGE, made = field->use & PM_USE_NEW;
	if (!field->buffer && field->uniform && (made || !change))
		return 0;
	if (field->buffer && !field->buffer->floats && narrow(field))
		return -PM_DATA;
	struct pm_buffer *old = field->buffer, *b;
	if (old && change && old->data)
		pm_buffer_drop_data(old);
	if (old && (!change || pm_buffer_alone(old)))
		return 0;
	if (!(b = new_floats(field, made && !(field->use & PM_USE_FILL))))
		return -PM_DATA;
	if (old)
		memcpy(b->floats, old->floats, values(field) * sizeof *b->floats);
	for (size_t i = 0, n = field->count; i < n * (size_t)field->components && !old && !made; i++)
		b->floats[i] = (float)field->value[i / n];
	pm_buffer_free(old);
	field->buffer = b;
	return 0;
}

/* Doubles of its own for one whose floats others have too. */
static int copy_of_floats(struct pm_field *field)
{
	struct pm_buffer *b = pm_buffer_new(values(field), sizeof(double), false);
	if (!b)
		return -PM_DATA;
	to_doubles(values(field), field->buffer->floats, b->data);
	pm_buffer_free(field->buffer);
	field->buffer = b;
	return 0;
}

int pm_field_ready(struct pm_field *field)
{
	if (field->use & PM_USE_WAITS)
		return 0;
	if (field->use & PM_USE_CHANGE) /* other values, and the limit stays */
		pm_limits_add(field, (struct pm_limits){.oscillation = pm_limits_of(field).oscillation});
	if (field->use & (PM_USE_CHANGE | PM_USE_NEW))
		forget_note(field);
	if (field->here)
		return ready_here(field);
	if (field->use & PM_USE_LATER && !(field->use & PM_USE_NEW) && pm_field_later_of(field))
		return 0;
	if (field->use & PM_USE_COLUMNS && pm_field_rests(field))
		return ready_floats(field);
	if (field->use & PM_USE_COLUMNS && field->uniform && !field->buffer && !(field->use & (PM_USE_CHANGE | PM_USE_NEW)))
		return 0;
	if (field->buffer && field->buffer->floats && field->use & PM_USE_CHANGE && !pm_buffer_alone(field->buffer))
		return copy_of_floats(field);
	if (field->buffer && field->use & PM_USE_CHANGE) /* before threads do */
		base_to_change(field);
	else if (field->buffer)
		base_of(field);
	if (field->buffer && field->use & PM_USE_CHANGE && !pm_buffer_alone(field->buffer)) {
		struct pm_buffer *b = pm_buffer_new(values(field), pm_field_memory(field), false);
		if (!b)
			return -PM_DATA;
		memcpy(b->data, base_of(field), values(field) * pm_field_memory(field));
		pm_buffer_free(field->buffer);
		field->buffer = b;
	}
	if (field->buffer)
		return 0;
	if (field->use & PM_USE_NEW && field->uniform)
		return 0;
	field->buffer = pm_buffer_new(values(field), pm_field_memory(field), field->use & PM_USE_NEW && !(field->use & PM_USE_FILL));
	if (!field->buffer)
		return -PM_DATA;
	if (!(field->use & PM_USE_NEW))
		fill(field);
	return 0;
}

/* Of a failure in a divided frame: the first field that comes in, the last one that goes out, as alone. */
static void place(const struct pm_field *field, int code, int c, size_t i)
{
	if (field->here)
		pm_world_place(code == PM_DATA ? 1 : 3, code == PM_DATA ? field->order : 255 - field->order, c, field->first + i);
}

static const char *remedy(const struct pm_field *field, int code)
{
	if (code == PM_DATA)
		return "made by an earlier word; sel --drop removes the field";
	return field->type == PM_F32 ? "f32 ends at 3.4e38: smod --store f64, or a smaller dt, or a larger softening" : "a smaller dt, or a larger softening";
}

/* The place of the first value that is not finite; called only if there is one. */
static int not_finite(const struct pm_field *field, int code)
{
	for (int c = 0; c < field->components; c++)
		for (size_t i = 0; i < field->count; i++)
			if (!isfinite(pm_in(field, c)[i]))
				return place(field, code, c, i), pm_fail(code, "'%s' of '%s' is not finite: component %d, index %zu (%s)", field->name,
					field->on, c, (size_t)field->first + i, remedy(field, code));
	return 0;
}

static bool finite_floats(size_t n, const float *x)
{
	int bad = 0;
#pragma omp parallel for schedule(static) reduction(| : bad) if (n > 65536)
	for (size_t i = 0; i < n; i++)
		bad |= !(x[i] - x[i] == 0);
	return !bad;
}

int pm_field_now(struct pm_field *field)
{
	field->use &= ~(unsigned)(PM_USE_LATER | PM_USE_WAITS);
	return pm_field_ready(field);
}

bool pm_field_in_place(const struct pm_field *field, int holders)
{
	const struct pm_buffer *b = field->buffer;
	return b && b->data && !b->id && !field->here && pm_buffer_users(b) == 1 + holders;
}

void pm_field_changed(struct pm_field *field)
{
	field->use &= ~(unsigned)PM_USE_WAITS;
	forget_note(field);
}

int pm_field_check(struct pm_field *field, int code)
{
	if (field->finite || !is_real(field) || !field->buffer || field->use & PM_USE_ANY)
		return 0;
	field->finite = pm_field_floats(field) ? finite_floats(values(field), pm_field_floats(field)) : pm_finite(values(field), base_of(field));
	return field->finite ? 0 : not_finite(field, code);
}

int pm_field_settle(struct pm_field *field)
{
	unsigned use = field->use;
	field->use = 0;
	const bool rests = field->buffer && pm_field_rests(field);
	if (rests && field->uniform) /* its value need not be one that a float has */
		field->buffer = pm_buffer_free(field->buffer);
	else if (rests && field->buffer->data && narrow(field))
		return -PM_DATA;
	if (!(use & (PM_USE_CHANGE | PM_USE_NEW)) || field->uniform || !is_real(field) || !field->buffer)
		return 0;
	if (pm_field_later_of(field)) {
		field->finite = true;
		return 0;
	}
	double *y = rests ? NULL : base_of(field);
	if (field->type == PM_F32 && !rests)
		for (size_t i = 0, n = values(field); i < n; i++)
			y[i] = (float)y[i];
	field->finite = use & PM_USE_SEEN && field->type == PM_F64;
	return use & PM_USE_ANY ? 0 : pm_field_check(field, PM_NUMERICS);
}

int pm_field_resize(struct pm_field *field, size_t count)
{
	size_t old = field->count, keep = old < count ? old : count, size = pm_field_memory(field);
	const char *from = field->buffer && count != old ? base_of(field) : NULL;
	field->count = count;
	forget_note(field);
	if (!from)
		return 0;
	struct pm_buffer *b = pm_buffer_new(values(field), size, true);
	if (!b)
		return -PM_DATA;
	for (int c = 0; c < field->components; c++)
		memcpy((char *)b->data + (size_t)c * count * size, from + (size_t)c * old * size, keep * size);
	pm_buffer_free(field->buffer);
	field->buffer = b;
	if (field->uniform)
		fill(field);
	return 0;
}

void pm_field_forget(struct pm_field *field)
{
	if (field->buffer) /* the limit stays */
		pm_limits_add(field, (struct pm_limits){.oscillation = field->buffer->oscillation});
	forget_note(field);
	field->buffer = pm_buffer_free(field->buffer);
}

int pm_field_enter(struct pm_field *field, const uint64_t *from)
{
	const int me = pm_world_rank();
	field->count = (size_t)(from[me + 1] - from[me]);
	field->first = from[me];
	field->from = from;
	field->here = true;
	return 0;
}

int pm_field_share(struct pm_field *field, uint64_t grain)
{
	const uint64_t *from = pm_division_new(field->count, grain);
	return from ? pm_field_enter(field, from) : -PM_DATA;
}

int pm_field_recut(int status, struct pm_field *field, const uint64_t *from, const uint64_t *to)
{
	const size_t me = (size_t)pm_world_rank(), division = ((size_t)pm_world_size() + 1) * sizeof *to, size = pm_field_memory(field);
	const size_t before = field->count, after = (size_t)(to[me + 1] - to[me]);
	struct pm_buffer *b = field->buffer;
	char *part = status ? NULL : pm_alloc(after * (size_t)field->components + 1, size);
	status = status ? status : part ? 0 : pm_failed();
	for (int c = 0; c < field->components; c++)
		status = pm_world_recut(status, from, to, size, (char *)b->part + (size_t)c * before * size, part ? part + (size_t)c * after * size : NULL);
	if (status) {
		pm_free(part);
		return status;
	}
	forget_note(field);
	pm_free(b->part);
	b->part = part;
	if (b->from)
		memcpy(b->from, to, division);
	memcpy((uint64_t *)(uintptr_t)field->from, to, division);
	return pm_field_enter(field, field->from);
}

void pm_field_leave(struct pm_field *field, const uint64_t *from, uint64_t id)
{
	const size_t ranks = (size_t)pm_world_size();
	struct pm_buffer *b = field->buffer;
	field->count = (size_t)from[ranks];
	field->first = 0;
	field->from = NULL;
	field->here = false;
	if (!b || b->id == id || !b->part)
		return;
	b->from = malloc((ranks + 1) * sizeof *b->from);
	if (!b->from) {
		pm_cannot_go_on();
		return;
	}
	memcpy(b->from, from, (ranks + 1) * sizeof *b->from);
	b->id = id, b->size = pm_field_memory(field), b->components = field->components;
}

void pm_field_bring(const struct pm_field *field)
{
	if (field && field->buffer && field->count)
		base_of(field);
}

/* Whoever asks may write there. */
void *pm_field_bytes(struct pm_field *field) { return field->buffer ? base_to_change(field) : NULL; }

static const char *component(const struct pm_field *field, const void *base, int c)
{
	return (const char *)base + (size_t)c * field->count * pm_field_memory(field);
}

static const void *in(const struct pm_field *field, int c) { return component(field, base_of(field), c); }
static void *out(struct pm_field *field, int c) { return (void *)(uintptr_t)component(field, base_to_change(field), c); }

const double *pm_in(const struct pm_field *field, int c) { return in(field, c); }
double *pm_out(struct pm_field *field, int c) { return out(field, c); }
const int64_t *pm_in_i64(const struct pm_field *field, int c) { return in(field, c); }
int64_t *pm_out_i64(struct pm_field *field, int c) { return out(field, c); }
const unsigned char *pm_in_u8(const struct pm_field *field, int c) { return in(field, c); }
unsigned char *pm_out_u8(struct pm_field *field, int c) { return out(field, c); }
