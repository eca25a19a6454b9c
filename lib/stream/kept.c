/* A note with a few blocks (kept.h). Each note has a number, by which a block knows that the other field's values are still those it was made from.
 * SPDX-License-Identifier: GPL-3.0-or-later */
#include <stdatomic.h>
#include <stdlib.h>

#include "stream/kept.h"
#include "world/world.h"

enum { most = 8 };

struct kept {
	struct pm_note note; /* first member */
	uint64_t number;
	int n;
	struct {
		const char *name;
		uint64_t with; /* number of the other field's note; 0: of this field alone */
		void *block;
	} of[most];
};

static void free_kept(struct pm_note *note)
{
	struct kept *k = (struct kept *)note;
	for (int i = 0; i < k->n; i++)
		pm_free(k->of[i].block);
	free(k);
}

/* A word that changes values may ask for sums before and after. */
static bool changes(const struct pm_field *field) { return field && field->use & (PM_USE_CHANGE | PM_USE_NEW) && !(field->use & PM_USE_DONE); }

static struct kept *kept_of(const struct pm_field *field)
{
	return field->note && field->note->free == free_kept ? (struct kept *)field->note : NULL;
}

/* The note, made if there is none; NULL: there is a note of another kind, or no memory. */
static struct kept *note_of(const struct pm_field *field)
{
	static _Atomic uint64_t last;
	struct kept *k = kept_of(field);
	if (k || field->note || !(k = calloc(1, sizeof *k)))
		return k;
	k->note.free = free_kept;
	k->number = atomic_fetch_add(&last, 1) + 1;
	((struct pm_field *)(uintptr_t)field)->note = &k->note; /* a note is no part of the field's value */
	return k;
}

const void *pm_kept(const struct pm_field *field, const struct pm_field *with, const char *name)
{
	const struct kept *k = kept_of(field), *other = with ? kept_of(with) : NULL;
	if (!k || (with && !other) || changes(field) || changes(with) || pm_world_size() > 1)
		return NULL;
	for (int i = 0; i < k->n; i++)
		if (k->of[i].name == name && k->of[i].with == (with ? other->number : 0))
			return k->of[i].block;
	return NULL;
}

bool pm_keep(const struct pm_field *field, const struct pm_field *with, const char *name, void *block)
{
	if (changes(field) || changes(with) || pm_world_size() > 1)
		return false;
	struct kept *k = note_of(field), *other = with ? note_of(with) : NULL;
	if (!k || (with && !other))
		return false;
	int i = 0;
	while (i < k->n && k->of[i].name != name) /* of other values of `with`: out of date */
		i++;
	if (i == most)
		return false;
	if (i < k->n)
		pm_free(k->of[i].block);
	k->n += i == k->n;
	k->of[i].name = name, k->of[i].with = with ? other->number : 0, k->of[i].block = block;
	return true;
}
