/* Measures of a whole frame: every set (or one), the first mesh that holds both density and potential. Quantities that the frame does not hold are
 * NAN, never zero. SPDX-License-Identifier: GPL-3.0-or-later */
#include <string.h>

#include "level/level-frame.h"
#include "measure/measure-field.h"
#include "measure/measure.h"
#include "measure/separation.h"
#include "measure/species-moments.h"
#include "stream/declare.h"
#include "stream/strengths.h"
#include "world/world.h"

static bool chosen(const struct pm_measure *how, const struct pm_set *set) { return !how->set || !strcmp(how->set, set->name); }

static const struct pm_mesh *solved(const struct pm_measure *how, const struct pm_frame *f)
{
	for (size_t i = 0; how->potential && i < f->nmeshes; i++)
		if (pm_frame_field(f, f->meshes[i]->name, how->density) && pm_frame_field(f, f->meshes[i]->name, how->potential))
			return f->meshes[i];
	return NULL;
}

void pm_measure_reads(const struct pm_measure *how, struct pm_frame *f)
{
	const char *const names[] = {"x", "v", "mass", how->strength, how->potential};
	for (size_t i = 0; i < f->nsets; i++)
		for (size_t k = 0; k < sizeof names / sizeof *names && chosen(how, f->sets[i]); k++)
			if (names[k] && pm_frame_field(f, f->sets[i]->name, names[k]))
				pm_reads(f, f->sets[i]->name, names[k]);
	const struct pm_mesh *mesh = solved(how, f);
	if (mesh) {
		pm_reads(f, mesh->name, how->density);
		pm_reads(f, mesh->name, how->potential);
	}
	pm_maxwell_reads(how, f);
	pm_vortex_reads(how, f);
	pm_vortex_space_reads(how, f);
	pm_plasma_reads(how, f);
	pm_outside_of_reads(how, f);
	pm_level_reads(f, how->set);
}

static const double *values(const struct pm_frame *f, const char *on, const char *name, int component)
{
	const struct pm_field *field = name ? pm_frame_field(f, on, name) : NULL;
	return field && component < field->components ? pm_in(field, component) : NULL;
}

static struct pm_measured bodies(const struct pm_measure *how, const struct pm_frame *f, const struct pm_set *set)
{
	const char *on = set->name;
	struct pm_measured b = {.n = set->n, .c = how->c, .mass = values(f, on, "mass", 0), .strength = values(f, on, how->strength, 0),
		.phi = values(f, on, how->potential, 0)};
	while (b.dim < 3 && (b.x[b.dim] = values(f, on, "x", b.dim)))
		b.dim++;
	while (b.vdim < 3 && (b.v[b.vdim] = values(f, on, "v", b.vdim)))
		b.vdim++;
	const char *const names[] = {"x", "v", "mass", how->strength, how->potential};
	for (size_t k = 0; k < sizeof names / sizeof *names && !b.field; k++) {
		const struct pm_field *field = names[k] ? pm_frame_field(f, on, names[k]) : NULL;
		b.field = field && field->here ? field : NULL;
	}
	if (b.field)
		b.all = b.n, b.n = b.field->count;
	return b;
}

static double mesh_energy(const struct pm_measure *how, const struct pm_frame *f)
{
	const struct pm_mesh *mesh = solved(how, f);
	if (!mesh)
		return NAN;
	const struct pm_grid g = pm_grid_of(f, mesh);
	double sum = 0;
	for (int c = 0; c < (how->vector ? 3 : 1); c++) {
		const double *density = values(f, mesh->name, how->density, c), *potential = values(f, mesh->name, how->potential, c);
		sum += density && potential ? pm_energy_of_field(&g, pm_frame_field(f, mesh->name, how->density), density, potential) : NAN;
	}
	return sum;
}

static double pair_energy(const struct pm_measure *how, size_t n, const struct pm_measured *b)
{
	double sum = how->potential && !how->vector ? 0 : NAN; /* pairs of vectors are not summed */
	for (size_t i = 0; i < n && how->potential && !how->vector; i++) {
		if (!b[i].strength)
			continue;
		for (size_t k = i; k < n && how->pair; k++)
			if (b[k].strength)
				sum += pm_energy_of_pairs(&b[i], &b[k], how->coefficient, how->softening, how->pair);
		if (!how->pair)
			sum += b[i].phi ? pm_energy_at_particles(&b[i]) : NAN;
	}
	return sum;
}

static int radii(const struct pm_measure *how, size_t n, const struct pm_measured *b, struct pm_measures *m)
{
	size_t total = 0, at = 0;
	for (size_t i = 0; i < n; i++)
		total += b[i].mass ? b[i].n : 0;
	struct pm_shell *shell = pm_alloc(total + 1, sizeof *shell);
	if (!shell)
		return -PM_DATA;
	for (size_t i = 0; i < n; i++)
		for (size_t p = 0; p < b[i].n && b[i].mass; p++, at++) {
			double r2 = 0;
			for (int d = 0; d < b[i].dim; d++)
				r2 += pow(b[i].x[d][p] - m->value[PM_CENTRE + d], 2);
			shell[at] = (struct pm_shell){sqrt(r2), b[i].mass[p], at};
		}
	pm_radii(total, shell, how->nradii, how->fraction, m->radius);
	pm_free(shell);
	return 0;
}

static int of_level(const struct pm_measure *how, const struct pm_frame *f, struct pm_measures *m)
{
	struct pm_level_measures level = {NAN, NAN, NAN};
	const int status = how->level ? pm_level_of(f, how->set, how->exact_level, &level) : 0;
	m->value[PM_LEVEL_INSIDE] = level.inside;
	m->value[PM_LEVEL_INTERFACE] = level.interface;
	m->value[PM_LEVEL_DIFFERENCE] = level.difference;
	return status;
}

bool pm_measure_shared(const struct pm_measure *how) { return !how->nradii; }

static int measure(const struct pm_measure *how, const struct pm_frame *f, struct pm_measures *m)
{
	size_t n = 0;
	struct pm_particle_sums bulk = {0};
	struct pm_measured *b = pm_alloc(f->nsets + 1, sizeof *b);
	if (!b)
		return -PM_DATA;
	for (size_t i = 0; i < f->nsets; i++)
		if (chosen(how, f->sets[i]))
			b[n++] = bodies(how, f, f->sets[i]);
	for (size_t i = 0; i < n; i++)
		pm_particle_sums_add(&b[i], &bulk);
	for (size_t i = 0; i < f->nsets && i < PM_SPECIES_MOST && how->species; i++) {
		const struct pm_measured one = bodies(how, f, f->sets[i]);
		pm_moments_of(&one, m->species[i]);
	}
	double outside, beyond;
	int status = pm_outside_of(how, f, &outside, &beyond);
	status = status ? status : pm_maxwell_of(how, f, m);
	const double mesh = how->evolves ? m->value[PM_ENERGY_ELECTRIC] + m->value[PM_ENERGY_MAGNETIC] : mesh_energy(how, f) + beyond;
	pm_measures_of(f, &bulk, mesh, pair_energy(how, n, b), how->potential || how->evolves, m);
	m->value[PM_OUTSIDE] = outside;
	if (how->unknown[0])
		m->value[PM_ENERGY] = NAN;
	pm_vortex_of(how, f, m);
	status = status ? status : pm_vortex_space_of(how, f, m);
	status = status ? status : pm_plasma_of(how, f, m);
	pm_account_of(how, f, m);
	status = status ? status : of_level(how, f, m);
	if (!status && how->nradii)
		status = radii(how, n, b, m);
	status = status ? status : pm_field_of(how, f, m->field);
	if (!status && how->separation[0])
		status = pm_separation_of(f, how->separation, m->separation);
	pm_free(b);
	return status;
}

bool pm_measure_divided(const struct pm_frame *f)
{
	bool divided = false;
	for (size_t i = 0; i < f->nfields; i++)
		divided = divided || f->fields[i]->here;
	return divided;
}

/* A frame that is not divided is measured by this rank alone, also between the words of cycle. */
int pm_measure_frame(const struct pm_measure *how, const struct pm_frame *f, struct pm_measures *m)
{
	const bool before = pm_world_apart(!pm_measure_divided(f) || pm_world_size() == 1);
	const int status = measure(how, f, m);
	pm_world_apart(before);
	return status;
}
