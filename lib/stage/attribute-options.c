/* Options that set attributes of a frame. SPDX-License-Identifier: GPL-3.0-or-later */
#include <stdlib.h>
#include <string.h>

#include "law/law.h"
#include "stage/attribute-options.h"
#include "stream/edit.h"

int pm_attributes_words(const char *text, char name[PM_NAME], const char **value)
{
	const char *sign = strchr(text, '=');
	if (!sign || sign == text || sign - text >= PM_NAME)
		return pm_fail(PM_USAGE, "'%s' is not NAME=VALUE", text);
	snprintf(name, PM_NAME, "%.*s", (int)(sign - text), text);
	*value = sign + 1;
	return 0;
}

int pm_attributes_pair(const char *text, char name[PM_NAME], double *value)
{
	const char *number;
	char *end;
	if (pm_attributes_words(text, name, &number))
		return -PM_USAGE;
	*value = strtod(number, &end);
	if (end == number || *end || !isfinite(*value))
		return pm_fail(PM_USAGE, "'%s' is not NAME=VALUE with a finite number", text);
	return 0;
}

static int check_constants(const struct pm_frame *f)
{
	const struct pm_law *law = pm_law_find(f->law);
	for (const struct pm_law_constant *c = law ? law->constants : NULL; c && c->name; c++)
		if (c->positive && !(pm_frame_constant(f, c->name, c->otherwise) > 0))
			return pm_fail(PM_USAGE, "%s=%g, but under the law %s the %s is above 0", c->name, pm_frame_constant(f, c->name, 0), law->name,
				c->text);
	return 0;
}

int pm_attributes_law(struct pm_frame *f, const char *law)
{
	const struct pm_law *l = law ? pm_law_find(law) : NULL;
	if (!law)
		return check_constants(f);
	if (!l)
		return -PM_USAGE;
	if (!(l->dims >> f->dim & 1))
		return pm_fail(PM_USAGE, "the law %s is not defined in %d dimensions", law, f->dim);
	snprintf(f->law, PM_NAME, "%s", law);
	for (const struct pm_law_constant *c = l->constants; c && c->name; c++)
		if (!json_object_get(f->constants, c->name))
			pm_frame_constant_set(f, c->name, c->otherwise);
	return check_constants(f);
}

int pm_attributes_constants(struct pm_frame *f, const struct pm_list *list)
{
	for (int i = 0; i < list->n; i++) {
		char name[PM_NAME];
		double value;
		if (pm_attributes_pair(list->item[i], name, &value))
			return -PM_USAGE;
		pm_frame_constant_set(f, name, value);
	}
	return 0;
}

int pm_attributes_units(struct pm_frame *f, const char *on, const struct pm_list *list)
{
	for (int i = 0; i < list->n; i++) {
		char name[PM_NAME];
		const char *unit;
		if (pm_attributes_words(list->item[i], name, &unit))
			return -PM_USAGE;
		struct pm_field *field = pm_frame_field(f, on, name);
		if (!field)
			return pm_fail(PM_DATA, "no field '%s' on '%s' to give the unit '%s'", name, on, unit);
		snprintf(field->unit, PM_NAME, "%.63s", unit);
	}
	return 0;
}

int pm_attributes_units_anywhere(struct pm_frame *f, const struct pm_list *list)
{
	for (int i = 0; i < list->n; i++) {
		const struct pm_list one = {.item = {list->item[i]}, .n = 1};
		bool done = false;
		for (size_t k = 0; k < f->nsets + f->nmeshes; k++)
			done |= !pm_attributes_units(f, k < f->nsets ? f->sets[k]->name : f->meshes[k - f->nsets]->name, &one);
		if (!done)
			return -PM_DATA;
	}
	return 0;
}

int pm_attributes_fixed(struct pm_frame *f, const struct pm_list *list, bool fixed)
{
	for (int i = 0; i < list->n; i++) {
		struct pm_set *set = pm_frame_set(f, list->item[i]);
		if (!set)
			return pm_fail(PM_DATA, "no set '%s' (sls lists what there is)", list->item[i]);
		set->fixed = fixed;
	}
	return 0;
}

int pm_attributes_rename(struct pm_frame *f, const struct pm_list *list)
{
	for (int i = 0; i < list->n; i++) {
		char old[PM_NAME];
		const char *new;
		int status = pm_attributes_words(list->item[i], old, &new);
		if (status || (status = pm_frame_rename(f, old, new)))
			return status;
	}
	return 0;
}

int pm_attributes_corners(const struct pm_vector *box, int dim, double lo[], double hi[])
{
	if (box->n != 2 && box->n != 2 * dim)
		return pm_fail(PM_USAGE, "--box needs lo,hi or all %d lo and then all %d hi, not %d numbers", dim, dim, box->n);
	for (int a = 0; a < dim; a++) {
		lo[a] = box->n == 2 ? box->x[0] : box->x[a], hi[a] = box->n == 2 ? box->x[1] : box->x[a + dim];
		if (!(hi[a] > lo[a]))
			return pm_fail(PM_USAGE, "--box: %g is not below %g", lo[a], hi[a]);
	}
	return 0;
}

int pm_attributes_box(struct pm_frame *f, const struct pm_vector *box) { return box->n ? pm_attributes_corners(box, f->dim, f->lo, f->hi) : 0; }

/* The words of a list for every face; out[axis][side] are indices into names. */
static int words(const struct pm_list *list, int dim, const char *const *names, const char *option, int out[3][2])
{
	if (list->n != 1 && list->n != dim && list->n != 2 * dim)
		return pm_fail(PM_USAGE, "--%s takes 1 word, %d (one per axis) or %d (low,high per axis), not %d", option, dim, 2 * dim, list->n);
	for (int a = 0; a < dim; a++)
		for (int side = 0; side < 2; side++) {
			const char *word = list->item[list->n == 1 ? 0 : list->n == dim ? a : 2 * a + side];
			int k = 0;
			while (names[k] && strcmp(names[k], word))
				k++;
			if (!names[k])
				return pm_fail(PM_USAGE, "--%s: '%s' is not a kind of face", option, word);
			out[a][side] = k;
		}
	for (int a = 0; a < dim; a++)
		if ((out[a][0] == 0) != (out[a][1] == 0)) /* periodic comes first in both lists */
			return pm_fail(PM_USAGE, "--%s: an axis is periodic at both faces or at none", option);
	return 0;
}

int pm_attributes_faces(struct pm_frame *f, const struct pm_list *list)
{
	int out[3][2];
	if (!list->n)
		return 0;
	if (words(list, f->dim, pm_face_names, "faces", out))
		return -PM_USAGE;
	for (int a = 0; a < f->dim; a++)
		for (int side = 0; side < 2; side++) {
			f->face[a][side] = (enum pm_face)out[a][side];
			if ((f->face[a][side] == PM_PERIODIC) != (f->pface[a][side] == PM_PFOLD))
				f->pface[a][side] = f->face[a][side] == PM_PERIODIC ? PM_PFOLD : PM_POPEN;
		}
	return 0;
}

int pm_attributes_particle_faces(struct pm_frame *f, const struct pm_list *list)
{
	int out[3][2];
	if (!list->n)
		return 0;
	if (words(list, f->dim, pm_particle_face_names, "particle-faces", out))
		return -PM_USAGE;
	for (int a = 0; a < f->dim; a++)
		for (int side = 0; side < 2; side++)
			f->pface[a][side] = (enum pm_particle_face)out[a][side];
	return 0;
}
