/* The columns of diag by name. SPDX-License-Identifier: GPL-3.0-or-later */
#include <stdio.h>
#include <string.h>

#include "base/decimal.h"
#include "law/law.h"
#include "level/level-frame.h"
#include "measure/diag-column.h"
#include "measure/known-energy.h"
#include "measure/law-field.h"
#include "measure/measure-field.h"
#include "measure/separation.h"
#include "measure/species-moments.h"

enum { exact = -1, first_mode = PM_COLUMNS + PM_COMPONENTS, first_separation = first_mode + PM_COMPONENTS,
	first_field = first_separation + 2, first_species = first_field + PM_FIELD_COLUMNS };


const struct pm_scene *pm_diag_scene(const struct pm_frame *f)
{
	for (int i = 0; pm_scenes[i]; i++)
		if (!strcmp(pm_scene_names[i], f->scene) && pm_scenes[i]->exact)
			return pm_scenes[i];
	return NULL;
}

/* The point of omega_centre: given by the scene, else the middle of the box. */
static double centre_of(const struct pm_frame *f, int d)
{
	const struct pm_scene *scene = pm_diag_scene(f);
	const double x = scene ? scene->exact(f, d ? "place_y" : "place_x", f->time) : NAN;
	return isnan(x) ? 0.5 * (f->lo[d] + f->hi[d]) : x;
}

/* Waves are those around a ring, or in the plane around a vortex. */
static bool of_ring(const struct pm_frame *f, const struct pm_law *law)
{
	return law->strength && law->of_potential == PM_CURL && f->face[0][0] == PM_OPEN;
}

static double (*level_of(const struct pm_frame *f))(const struct pm_frame *, const double[], double)
{
	const struct pm_scene *scene = pm_diag_scene(f);
	return scene ? scene->level : NULL;
}

struct pm_measure pm_diag_how(const struct pm_diag_request *g, const struct pm_frame *f)
{
	const struct pm_law *law = pm_law_of(f);
	struct pm_measure how = {.set = g->set, .strength = law->strength, .density = law->density, .potential = law->potential,
		.coefficient = law->coefficient ? law->coefficient(f) : 0, .vortices = law->of_potential == PM_CURL && law->strength, .vector = law->vector,
		.nu = pm_frame_constant(f, "nu", 0), .nradii = g->nradii,
		.fraction = g->fraction, .outside = true, .level = pm_level_there(f, g->set), .exact_level = level_of(f), .plasma = law->background != NULL,
		.field = law->field, .wave = law->wave, .nmodes = of_ring(f, law) ? 0 : g->nmodes, .nring_modes = of_ring(f, law) ? g->nmodes : 0,
		.centre = {centre_of(f, 0), centre_of(f, 1)}, .separation = {g->separation[0], g->separation[1]},
		.species = g->species, .field_errors = g->field_errors, .flux = g->flux, .nflux = g->nflux};
	if (law->evolves) {
		how.evolves = true;
		how.c = pm_law_constant(f, "c", 1), how.eps0 = pm_law_constant(f, "eps0", 1);
		how.coefficient = -1 / how.eps0;
	}
	memcpy(how.modes, g->mode, sizeof how.modes);
	pm_known_energy(f, law, g->pair, &how);
	return how;
}

/* Modes need the field of the law, or its potential, on a mesh that is periodic in x. */
static int has_mode(const struct pm_frame *f, const struct pm_law *law)
{
	const struct pm_measure how = {.field = law->field, .potential = law->potential};
	if (of_ring(f, law))
		return 0;
	if (f->face[0][0] != PM_PERIODIC)
		return pm_fail(PM_DATA, "modes need a box that is periodic in x (pinit --faces periodic)");
	return pm_law_field_mesh(&how, f) ? 0 : pm_fail(PM_DATA, "no field '%s' on a mesh for the modes (p2m | poisson-fft | mgrad makes one)",
		law->field ? law->field : "");
}

int pm_diag_reads(const struct pm_diag_request *g, struct pm_frame *f)
{
	const struct pm_law *law = pm_law_of(f);
	if (!law)
		return -PM_DATA;
	if (g->set && !pm_frame_set(f, g->set))
		return pm_fail(PM_DATA, "no set '%s' (sls lists them)", g->set);
	for (int k = 0; k < 2 * f->dim && g->pair; k++) {
		const enum pm_face face = f->face[k / 2][k % 2];
		if (face == PM_PERIODIC || face == PM_WALL || face == PM_NEUMANN)
			return pm_fail(PM_USAGE, "--pair sums over pairs in open space, but this box is %s (leave --pair out)", pm_face_names[face]);
	}
	if (g->nmodes && has_mode(f, law))
		return -PM_DATA;
	if (g->species && f->nsets > PM_SPECIES_MOST)
		return pm_fail(PM_DATA, "--species: %zu sets, at most %d (sel --set leaves others out)", f->nsets, PM_SPECIES_MOST);
	if (g->species && g->set)
		return pm_fail(PM_USAGE, "--species measures every set (leave --set out)");
	if (g->separation[0] && pm_separation_reads(f, g->separation))
		return -PM_DATA;
	const struct pm_measure how = pm_diag_how(g, f);
	pm_measure_reads(&how, f);
	return pm_field_reads(&how, f);
}

static struct pm_diag_column named(int from, const char *name)
{
	struct pm_diag_column column = {.from = from};
	snprintf(column.name, sizeof column.name, "%s", name);
	return column;
}

struct pm_diag_column pm_diag_column(enum pm_column c) { return named((int)c, pm_column_names[c]); }

struct pm_diag_column pm_diag_radius(const struct pm_diag_request *g, int k)
{
	char name[PM_NAME];
	snprintf(name, sizeof name, "radius_%g", g->fraction[k]);
	return named(PM_COLUMNS + k, name);
}

struct pm_diag_column pm_diag_mode(const struct pm_diag_request *g, int k)
{
	char name[PM_NAME];
	snprintf(name, sizeof name, "mode_%d", g->mode[k]);
	return named(first_mode + k, name);
}

struct pm_diag_column pm_diag_separation(int k) { return named(first_separation + k, pm_column_names[PM_COLUMNS + PM_FIELD_COLUMNS + k]); }

struct pm_diag_column pm_diag_field(enum pm_field_column k) { return named(first_field + (int)k, pm_column_names[PM_COLUMNS + (int)k]); }

struct pm_diag_column pm_diag_moment(const struct pm_frame *f, size_t set, enum pm_moment k)
{
	char name[PM_DIAG_NAME];
	snprintf(name, sizeof name, "%s_%s", pm_moment_names[k], f->sets[set]->name);
	return named(first_species + (int)set * PM_MOMENTS + (int)k, name);
}

struct pm_diag_column pm_diag_exact(const char *name)
{
	struct pm_diag_column column = {.from = exact};
	snprintf(column.name, sizeof column.name, "exact_%.*s", PM_NAME - 1, name);
	return column;
}

/* prefix and a number, to the end of the name. */
static bool numbered(const char *name, const char *prefix, double *x)
{
	const size_t n = strlen(prefix);
	const size_t digits = strncmp(name, prefix, n) ? 0 : pm_decimal_read(name + n, x);
	return digits && !name[n + digits];
}

bool pm_diag_find(struct pm_diag_request *g, const char *name, struct pm_diag_column *column)
{
	double x = 0;
	for (int c = 0; c < PM_COLUMNS; c++)
		if (!strcmp(name, pm_column_names[c]))
			return *column = pm_diag_column((enum pm_column)c), true;
	for (int k = 0; k < 2; k++)
		if (g->separation[0] && !strcmp(name, pm_diag_separation(k).name))
			return *column = pm_diag_separation(k), true;
	for (int k = 0; k < PM_FIELD_COLUMNS; k++)
		if (!strcmp(name, pm_diag_field((enum pm_field_column)k).name) && (k >= PM_FIELD_RESIDUAL || g->flux)) {
			g->field_errors = g->field_errors || k >= PM_FIELD_RESIDUAL;
			return *column = pm_diag_field((enum pm_field_column)k), true;
		}
	if (!strncmp(name, "exact_", strlen("exact_")))
		return *column = pm_diag_exact(name + strlen("exact_")), true;
	int k = 0;
	if (numbered(name, "radius_", &x) && x > 0 && x <= 1) {
		while (k < g->nradii && g->fraction[k] != x)
			k++;
		if (k < PM_COMPONENTS) {
			g->nradii = k < g->nradii ? g->nradii : k + 1;
			g->fraction[k] = x;
			return *column = pm_diag_radius(g, k), true;
		}
	} else if (numbered(name, "mode_", &x) && x >= 1 && x <= 1e6 && x == floor(x)) {
		while (k < g->nmodes && g->mode[k] != (int)x)
			k++;
		if (k < PM_COMPONENTS) {
			g->nmodes = k < g->nmodes ? g->nmodes : k + 1;
			g->mode[k] = (int)x;
			return *column = pm_diag_mode(g, k), true;
		}
	}
	return false;
}

double pm_diag_value(const struct pm_diag_column *column, const struct pm_measures *m, const struct pm_frame *f)
{
	const struct pm_scene *scene = column->from == exact ? pm_diag_scene(f) : NULL;
	if (column->from == exact)
		return scene ? scene->exact(f, column->name + strlen("exact_"), f->time) : NAN;
	if (column->from >= first_species) { /* a frame whose sets are others has no such number */
		const size_t set = (size_t)(column->from - first_species) / PM_MOMENTS;
		const enum pm_moment k = (enum pm_moment)((column->from - first_species) % PM_MOMENTS);
		return set < f->nsets && !strcmp(pm_diag_moment(f, set, k).name, column->name) ? m->species[set][k] : NAN;
	}
	if (column->from >= first_field)
		return m->field[column->from - first_field];
	if (column->from >= first_separation)
		return m->separation[column->from - first_separation];
	if (column->from >= first_mode)
		return hypot(m->mode[column->from - first_mode][0], m->mode[column->from - first_mode][1]);
	return column->from < PM_COLUMNS ? m->value[column->from] : m->radius[column->from - PM_COLUMNS];
}
