/* The limits of change fields, in memory and in the tail. Cost: a few words per change field.
 * SPDX-License-Identifier: GPL-3.0-or-later */
#include <stdio.h>
#include <string.h>

#include "stream/later.h"
#include "stream/limits.h"
#include "stream/parts.h"

static const char *const names[] = {"decay", "oscillation", "strain"};

static double usable(double rate) { return isfinite(rate) && rate > 0 ? rate : 0; }

void pm_limits_add(struct pm_field *change, struct pm_limits more)
{
	struct pm_limits *all = &change->limits;
	all->decay = usable(all->decay + usable(more.decay));
	all->oscillation = fmax(all->oscillation, usable(more.oscillation));
	all->strain = fmax(all->strain, usable(more.strain));
}

/* By values that were left to be made, or are. */
static double told(const struct pm_field *change)
{
	const struct pm_later *later = pm_field_later_of(change);
	if (later && later->oscillation)
		(void)pm_in(change, 0);
	return change->buffer ? usable(change->buffer->oscillation) : 0;
}

struct pm_limits pm_limits_of(const struct pm_field *change)
{
	struct pm_limits all = change->limits;
	all.oscillation = fmax(all.oscillation, told(change));
	all.decay += usable(json_number_value(json_object_get(change->more, "fastest")));
	return all;
}

struct pm_limits pm_limits_most(const struct pm_field *change, double enough)
{
	const struct pm_later *later = pm_field_later_of(change);
	const double most = later && later->most ? later->most(later, enough) : 0;
	if (!(most > 0))
		return pm_limits_of(change); /* where they are left, makes them */
	struct pm_limits all = change->limits;
	all.oscillation = fmax(all.oscillation, most);
	return all;
}

void pm_limits_key(const struct pm_field *field, char key[PM_LIMITS_KEY]) { snprintf(key, PM_LIMITS_KEY, "%s/%s", field->on, field->name); }

json_t *pm_limits_json(const struct pm_frame *f)
{
	json_t *all = NULL;
	for (size_t i = 0; i < f->nfields; i++) {
		struct pm_limits l = f->fields[i]->limits;
		l.oscillation = fmax(l.oscillation, told(f->fields[i]));
		const double value[] = {l.decay, l.oscillation, l.strain};
		char key[PM_LIMITS_KEY];
		if (!(l.decay > 0 || l.oscillation > 0 || l.strain > 0))
			continue;
		json_t *entry = json_object();
		for (int k = 0; k < 3; k++)
			json_object_set_new(entry, names[k], json_real(value[k]));
		pm_limits_key(f->fields[i], key);
		all = all ? all : json_object();
		json_object_set_new(all, key, entry);
	}
	return all;
}

int pm_limits_check(const json_t *limits)
{
	bool good = !limits || json_is_object(limits);
	const char *key;
	json_t *entry;
	json_object_foreach((json_t *)(uintptr_t)limits, key, entry)
		for (int k = 0; k < 3 && good; k++) {
			const json_t *value = json_object_get(entry, names[k]);
			good = json_is_object(entry) && (!value || (json_is_number(value) && json_number_value(value) >= 0));
		}
	return good ? 0 : pm_fail(PM_DATA, "the limits in the tail are not rates by change field ({\"owner/change\": {decay, oscillation, strain}})");
}

void pm_limits_take(const json_t *limits, const char *key, struct pm_field *change)
{
	const json_t *entry = json_object_get(limits, key);
	double value[3];
	for (int k = 0; k < 3; k++)
		value[k] = json_number_value(json_object_get(entry, names[k]));
	pm_limits_add(change, (struct pm_limits){.decay = value[0], .oscillation = value[1], .strain = value[2]});
}

int pm_limits_take_all(const json_t *limits, struct pm_frame *f)
{
	int status = pm_limits_check(limits);
	for (size_t i = 0; i < f->nfields && !status && limits; i++) {
		char key[PM_LIMITS_KEY];
		pm_limits_key(f->fields[i], key);
		pm_limits_take(limits, key, f->fields[i]);
	}
	return status;
}
