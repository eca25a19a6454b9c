/* Fields in another order. Cost: a pass over a field, and as much memory as it has while the order lasts where others hold it too; of what is left to be made,
 * as much as of what it is made of. SPDX-License-Identifier: GPL-3.0-or-later */
#include <stdlib.h>

#include "stream/later.h"
#include "stream/limits.h"
#include "stream/parts.h"
#include "stream/reorder.h"
#include "stream/run.h"

enum { together = 256 };

static void take_bytes(size_t n, const unsigned char *from, const size_t *order, unsigned char *restrict to)
{
	for (size_t i = 0; i < n; i++)
		to[i] = from[order[i]];
}

/* One by one, the further ones fetched: vectors of what is far apart take longer. order has `ahead` more. */
static void take(size_t n, size_t ahead, const uint64_t *from, const size_t *order, uint64_t *restrict to)
{
	for (size_t i = 0; i < n; i++) {
		if (ahead)
			__builtin_prefetch(&from[order[i + ahead]]);
		to[i] = from[order[i]];
	}
}

static int reorder_values(struct pm_field *field, const struct pm_field *old, const size_t *order)
{
	const size_t n = field->count, size = pm_field_memory(field);
	if (pm_held_bring(old) || pm_field_hold(field))
		return -PM_DATA;
	for (int c = 0; c < field->components; c++) {
		const void *from = size == 1 ? (const void *)pm_in_u8(old, c) : (const void *)pm_in(old, c); /* eight bytes of either kind */
		void *to = size == 1 ? (void *)pm_out_u8(field, c) : (void *)pm_out(field, c);
#pragma omp parallel for schedule(static) if (n > 16384)
		for (size_t p = 0; p < n; p += together) {
			const size_t m = n - p < together ? n - p : together;
			const size_t ahead = p + 2 * together <= n ? together / 2 : 0;
			if (size == 1)
				take_bytes(m, from, order + p, (unsigned char *)to + p);
			else
				take(m, ahead, from, order + p, (uint64_t *)to + p);
		}
	}
	return 0;
}

/* The same left to be made of values in that order. */
static int reorder_later(struct pm_field *field, const struct pm_later *later, struct pm_reorder *r)
{
	struct pm_later *now = later->reorder(later, r);
	struct pm_field *from = now ? pm_held_reorder(later->from, r) : NULL;
	const int status = from ? pm_field_later(field, now, from) : -PM_DATA;
	if (now && !from)
		pm_later_free(now);
	pm_held_free(from);
	return status;
}

static int share(struct pm_field *field, const struct pm_field *made)
{
	struct pm_field *held = pm_field_held(made);
	if (!held)
		return -PM_DATA;
	pm_field_forget(field);
	field->buffer = held->buffer;
	held->buffer = NULL;
	pm_held_free(held);
	return 0;
}

static int add(struct pm_reorder *r, struct pm_reorder_known more)
{
	struct pm_reorder_known *of = realloc(r->of, (r->known + 1) * sizeof *of);
	if (!of)
		return pm_no_memory();
	r->of = of, of[r->known++] = more;
	return 0;
}

/* `old`, which others have too, has become the field's values. Takes it over. */
static int remember(struct pm_reorder *r, struct pm_field *old, const struct pm_field *field)
{
	struct pm_field *made = pm_field_held(field);
	const int status = made ? add(r, (struct pm_reorder_known){.was = old->buffer, .now = made, .old = old, .made = made}) : -PM_DATA;
	if (status)
		pm_held_free(old), pm_held_free(made);
	return status;
}

int pm_field_reorder(struct pm_field *field, struct pm_reorder *r)
{
	const bool finite = field->finite, shared = field->buffer && !pm_buffer_alone(field->buffer);
	const double within = field->within;
	const struct pm_later *later = pm_field_later_of(field);
	const struct pm_field *known = shared ? pm_reorder_find(r, field->buffer) : NULL;
	struct pm_field *old = pm_field_held(field);
	int status = old ? 0 : -PM_DATA;
	if (!status && known)
		status = share(field, known);
	else if (!status && later && later->reorder)
		status = reorder_later(field, later, r);
	else if (!status) {
		pm_limits_add(field, (struct pm_limits){.oscillation = pm_limits_of(field).oscillation}); /* other values, and the limit stays */
		status = reorder_values(field, old, r->order);
	}
	field->within = within;
	field->use |= finite && !status ? PM_USE_SEEN : 0;
	if (!status && shared && !known)
		return remember(r, old, field);
	pm_held_free(old);
	return status;
}

struct pm_field *pm_held_reorder(const struct pm_field *held, struct pm_reorder *r)
{
	struct pm_field *now = pm_field_held(held);
	if (now && !now->uniform && pm_field_reorder(now, r))
		pm_held_free(now), now = NULL;
	return now;
}

void *pm_reorder_find(const struct pm_reorder *r, const void *was)
{
	for (size_t i = 0; i < r->known; i++)
		if (r->of[i].was == was)
			return r->of[i].now;
	return NULL;
}

int pm_reorder_add(struct pm_reorder *r, const void *was, void *now) { return add(r, (struct pm_reorder_known){.was = was, .now = now}); }

void pm_reorder_free(struct pm_reorder *r)
{
	for (size_t i = 0; i < r->known; i++)
		pm_held_free(r->of[i].old), pm_held_free(r->of[i].made);
	free(r->of);
}
