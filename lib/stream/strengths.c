/* Sums of strengths, eight values at a time, by the law of sums (base/in-order.h). SPDX-License-Identifier: GPL-3.0-or-later */
#include <stdio.h>
#include <string.h>

#include "base/in-order.h"
#include "base/simd-sum.h"
#include "stream/kept.h"
#include "stream/over-stretches.h"
#include "stream/strengths.h"
#include "world/world.h"

enum { SUM, SCALE, SUMS };

bool pm_is_strength(const struct pm_field *field)
{
	return field->role == PM_STATE && field->extensive && (field->type == PM_F64 || field->type == PM_F32) && strcmp(field->name, "volume");
}

void pm_strength_name(const struct pm_field *field, int c, char name[PM_STRENGTH_NAME])
{
	snprintf(name, PM_STRENGTH_NAME, field->components > 1 ? "%.60s_%d" : "%.60s", field->name, c);
}

static void block(const void *data, size_t from, size_t to, void *part)
{
	const double *x = data;
	struct pm_sum *total = part;
	enum { P = PM_SIMD_PART, PARTS = PM_SIMD_WIDTH / P };
	pm_simd_part sum[SUMS][PARTS] = {{{0}}}, carry[SUMS][PARTS] = {{{0}}};
	for (; from + PM_SIMD_WIDTH <= to; from += PM_SIMD_WIDTH) {
		PM_SIMD_UNROLL
		for (int q = 0; q < PARTS; q++) { /* in registers */
			pm_simd_part v;
			memcpy(&v, x + from + q * P, sizeof v);
			pm_simd_part_sum_add(&sum[SUM][q], &carry[SUM][q], v);
			pm_simd_part_sum_add(&sum[SCALE][q], &carry[SCALE][q], pm_simd_part_abs(v));
		}
	}
	for (int k = 0; k < SUMS; k++) {
		struct pm_simd_sum s;
		memcpy(&s.sum, sum[k], sizeof s.sum), memcpy(&s.carry, carry[k], sizeof s.carry);
		if (from < to) {
			const pm_simd few = pm_simd_load_few(x + from, to - from);
			pm_simd_sum_add(&s, k == SUM ? few : pm_simd_abs(few));
		}
		pm_simd_sum_join(&total[k], &s);
	}
}

/* Sum and scale of each component. They are asked for after every step, and mostly nothing has changed. */
static void sums(const struct pm_field *field, double to[][SUMS])
{
	static const char name[] = "sums of a strength";
	const size_t bytes = (size_t)field->components * sizeof *to;
	const void *kept = pm_kept(field, NULL, name);
	if (kept) {
		memcpy(to, kept, bytes);
		return;
	}
	for (int c = 0; c < field->components; c++) {
		struct pm_sum all[SUMS] = {{0, 0}};
		const struct pm_parts parts = {.size = sizeof all, .make = block, .join = pm_join_sums};
		pm_over_stretches(field, &parts, pm_in(field, c), all);
		to[c][SUM] = pm_sum_total(all[SUM]);
		to[c][SCALE] = pm_sum_total(all[SCALE]);
	}
	void *copy = pm_alloc(1, bytes);
	if (copy && !pm_keep(field, NULL, name, memcpy(copy, to, bytes)))
		pm_free(copy);
}

const struct pm_strength *pm_strength_find(const struct pm_strengths *s, const char *on, const char *name)
{
	for (int i = 0; i < s->n; i++)
		if (!strcmp(s->of[i].name, name) && !strcmp(s->of[i].on, on))
			return &s->of[i];
	return NULL;
}

void pm_strengths_add(const struct pm_field *field, struct pm_strengths *s)
{
	const int first = s->n;
	double largest = 0, of[PM_COMPONENTS][SUMS];
	if (!field->uniform)
		sums(field, of);
	for (int c = 0; c < field->components && s->n < PM_STRENGTHS; c++) {
		struct pm_strength *one = &s->of[s->n];
		pm_strength_name(field, c, one->name);
		if (pm_strength_find(s, field->on, one->name))
			return;
		s->n++;
		snprintf(one->on, sizeof one->on, "%s", field->on);
		if (!field->uniform)
			one->sum = of[c][SUM], one->scale = of[c][SCALE];
		else {
			one->sum = (double)(field->here ? field->from[pm_world_size()] : field->count) * field->value[c];
			one->scale = fabs(one->sum);
		}
		largest = fmax(largest, one->scale);
	}
	for (int i = first; i < s->n; i++)
		s->of[i].size = largest;
}

void pm_strengths_of(const struct pm_frame *f, const char *set, struct pm_strengths *s)
{
	s->n = 0;
	for (size_t i = 0; i < f->nfields; i++) {
		const struct pm_field *field = f->fields[i];
		if (pm_is_strength(field) && (set ? !strcmp(field->on, set) : pm_frame_set(f, field->on) != NULL) && (field->buffer || field->uniform))
			pm_strengths_add(field, s);
	}
}

double pm_strength_reported(const struct pm_frame *f, const char *key, const char *name)
{
	char full[2 * PM_STRENGTH_NAME];
	const char *word;
	json_t *entry;
	double sum = 0;
	snprintf(full, sizeof full, "%s_%s", key, name);
	json_object_foreach(f->report, word, entry)
		sum += json_number_value(json_object_get(entry, full));
	return sum;
}

double pm_strength_permitted(const struct pm_frame *f, const char *name)
{
	return pm_strength_reported(f, "given", name) - pm_strength_reported(f, "absorbed", name) - pm_strength_reported(f, "lost", name) -
		pm_strength_reported(f, "outside", name);
}
