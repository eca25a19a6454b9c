/* A far field is made in four steps, each of which needs the one before. SPDX-License-Identifier: GPL-3.0-or-later */
#include <stdio.h>
#include <string.h>

#include "mesh/force-words.h"

static const char *const word[] = {"p2m", "poisson-fft", "mgrad", "m2p"}; /* they make density, potential, field, change */

static bool held(const struct pm_frame *f, const char *mesh, const char *name)
{
	for (size_t i = 0; i < f->nmeshes; i++)
		if ((!mesh || !strcmp(mesh, f->meshes[i]->name)) && pm_frame_field(f, f->meshes[i]->name, name))
			return true;
	return false;
}

static bool pairs(const struct pm_frame *f, const struct pm_law *law)
{
	bool open = law->coefficient && law->strength && !law->vector;
	for (int k = 0; k < 2 * f->dim; k++)
		open = open && f->face[k / 2][k % 2] == PM_OPEN;
	return open;
}

const char *pm_force_words(const struct pm_frame *f, const struct pm_law *law, const char *mesh, const char *name, char text[PM_FORCE_WORDS])
{
	const char *const made[] = {law->density, law->potential, law->field, law->change};
	int first = 0, last = 0;
	if (law->evolves) {
		const bool field = held(f, mesh, law->field);
		snprintf(text, PM_FORCE_WORDS, "%s", !strcmp(name, law->density) ? "p2m" : !strcmp(name, law->field) ? "p2m | maxwell --gauss"
			: strcmp(name, law->change) ? "" : field ? "m2p" : "p2m | maxwell --gauss | m2p");
		return text;
	}
	while (last < 4 && !(made[last] && !strcmp(made[last], name)))
		last++;
	text[0] = 0;
	if (last == 4 || !law->strength)
		return text;
	for (int k = 0; k < last; k++)
		if (made[k] && held(f, mesh, made[k]))
			first = k + 1;
	for (int k = first; k <= last; k++)
		snprintf(text + strlen(text), PM_FORCE_WORDS - strlen(text), "%s%s", k > first ? " | " : "", word[k]);
	if (last == 3 && pairs(f, law))
		snprintf(text + strlen(text), PM_FORCE_WORDS - strlen(text), ", or pp");
	return text;
}
