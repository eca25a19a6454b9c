/* Field data: reference-counted buffers, copied on write; uniform values are expanded when they are read.
 * SPDX-License-Identifier: GPL-3.0-or-later */
#include <stdatomic.h>
#include <stdlib.h>
#include <string.h>

#include "stream/run.h"

struct pm_buffer {
	atomic_int users;
	void *data;
};

static bool is_real(const struct pm_field *field) { return field->type == PM_F64 || field->type == PM_F32; }

size_t pm_field_memory(const struct pm_field *field) { return field->type == PM_U8 ? 1 : 8; }

static size_t values(const struct pm_field *field) { return field->count * (size_t)field->components; }

static struct pm_buffer *buffer_free(struct pm_buffer *b)
{
	if (b && atomic_fetch_sub(&b->users, 1) == 1) {
		pm_free(b->data);
		free(b);
	}
	return NULL;
}

static void forget_note(struct pm_field *field)
{
	if (field->note)
		field->note->free(field->note);
	field->note = NULL;
}

static struct pm_buffer *buffer_new(size_t n, size_t size, bool zero)
{
	struct pm_buffer *b = malloc(sizeof *b);
	void *data = zero ? pm_zalloc(n, size) : pm_alloc(n, size);
	if (!b || !data) {
		free(b), pm_free(data);
		pm_no_memory();
		return NULL;
	}
	atomic_init(&b->users, 1);
	b->data = data;
	return b;
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
		buffer_free(field->buffer);
		json_decref(field->more);
		free(field);
	}
	return NULL;
}

int pm_field_hold(struct pm_field *field)
{
	struct pm_buffer *b = buffer_new(values(field), pm_field_memory(field), false);
	if (!b)
		return -PM_DATA;
	forget_note(field);
	buffer_free(field->buffer);
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

int pm_field_ready(struct pm_field *field)
{
	if (field->use & (PM_USE_CHANGE | PM_USE_NEW))
		forget_note(field);
	if (field->buffer && field->use & PM_USE_CHANGE && atomic_load(&field->buffer->users) > 1) {
		struct pm_buffer *b = buffer_new(values(field), pm_field_memory(field), false);
		if (!b)
			return -PM_DATA;
		memcpy(b->data, field->buffer->data, values(field) * pm_field_memory(field));
		buffer_free(field->buffer);
		field->buffer = b;
	}
	if (field->buffer)
		return 0;
	if (field->use & PM_USE_NEW && field->uniform)
		return 0;
	field->buffer = buffer_new(values(field), pm_field_memory(field), field->use & PM_USE_NEW && !(field->use & PM_USE_FILL));
	if (!field->buffer)
		return -PM_DATA;
	if (!(field->use & PM_USE_NEW))
		fill(field);
	return 0;
}

/* The place of the first value that is not finite; called only if there is one. */
static int not_finite(const struct pm_field *field, int code)
{
	for (int c = 0; c < field->components; c++)
		for (size_t i = 0; i < field->count; i++)
			if (!isfinite(pm_in(field, c)[i]))
				return pm_fail(code, "'%s' of '%s' is not finite: component %d, index %zu (%s)", field->name, field->on, c, i,
					code == PM_DATA ? "made by an earlier word; sel --drop removes the field" : "a smaller dt, or a larger softening");
	return 0;
}

int pm_field_check(struct pm_field *field, int code)
{
	if (field->finite || !is_real(field) || !field->buffer || field->use & PM_USE_ANY)
		return 0;
	field->finite = pm_finite(values(field), field->buffer->data);
	return field->finite ? 0 : not_finite(field, code);
}

int pm_field_settle(struct pm_field *field)
{
	unsigned use = field->use;
	field->use = 0;
	if (!(use & (PM_USE_CHANGE | PM_USE_NEW)) || field->uniform || !is_real(field) || !field->buffer)
		return 0;
	double *y = field->buffer->data;
	if (field->type == PM_F32)
		for (size_t i = 0, n = values(field); i < n; i++)
			y[i] = (float)y[i];
	field->finite = use & PM_USE_SEEN && field->type == PM_F64;
	return use & PM_USE_ANY ? 0 : pm_field_check(field, PM_NUMERICS);
}

int pm_field_resize(struct pm_field *field, size_t count)
{
	size_t old = field->count, keep = old < count ? old : count, size = pm_field_memory(field);
	field->count = count;
	forget_note(field);
	if (!field->buffer || count == old)
		return 0;
	struct pm_buffer *b = buffer_new(values(field), size, true);
	if (!b)
		return -PM_DATA;
	for (int c = 0; c < field->components; c++)
		memcpy((char *)b->data + (size_t)c * count * size, (char *)field->buffer->data + (size_t)c * old * size, keep * size);
	buffer_free(field->buffer);
	field->buffer = b;
	if (field->uniform)
		fill(field);
	return 0;
}

void pm_field_forget(struct pm_field *field)
{
	forget_note(field);
	field->buffer = buffer_free(field->buffer);
}

void *pm_field_bytes(struct pm_field *field) { return field->buffer ? field->buffer->data : NULL; }

static void *component(const struct pm_field *field, int c)
{
	return (char *)field->buffer->data + (size_t)c * field->count * pm_field_memory(field);
}

const double *pm_in(const struct pm_field *field, int c) { return component(field, c); }
double *pm_out(struct pm_field *field, int c) { return component(field, c); }
const int64_t *pm_in_i64(const struct pm_field *field, int c) { return component(field, c); }
int64_t *pm_out_i64(struct pm_field *field, int c) { return component(field, c); }
const unsigned char *pm_in_u8(const struct pm_field *field, int c) { return component(field, c); }
unsigned char *pm_out_u8(struct pm_field *field, int c) { return component(field, c); }
