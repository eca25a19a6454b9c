/* The columns of diag, from bulk quantities and field energies. The total energy includes the pair energy if it is known (the energy of the particles
 * themselves), else the energy of the mesh; the virial ratio is 2 K/|W| with the same W.
 * SPDX-License-Identifier: GPL-3.0-or-later */
#include <string.h>

#include "law/law.h"
#include "measure/measure.h"

const char *const pm_column_names[PM_NAMED_COLUMNS + 1] = {
	[PM_STEP] = "step", [PM_TIME] = "time", [PM_ENERGY_KINETIC] = "energy_kinetic", [PM_ENERGY_MESH] = "energy_field_mesh",
	[PM_ENERGY_PAIR] = "energy_field_pair", [PM_ENERGY] = "energy",
	[PM_MOMENTUM] = "momentum_x", "momentum_y", "momentum_z", [PM_MOMENTUM_SCALE] = "momentum_scale",
	[PM_ANGULAR] = "angular_momentum_x", "angular_momentum_y", "angular_momentum_z",
	[PM_MASS] = "mass", [PM_PARTICLES] = "particles", [PM_CENTRE] = "centre_x", "centre_y", "centre_z",
	[PM_SPEED_RMS] = "speed_rms", [PM_DISTANCE_MAX] = "distance_max", [PM_VIRIAL_RATIO] = "virial_ratio",
	[PM_CROSSING_TIME] = "crossing_time", [PM_COULOMB_LOGARITHM] = "coulomb_logarithm", [PM_RELAXATION_TIME] = "relaxation_time",
	[PM_CIRCULATION] = "circulation", [PM_ALPHA] = "alpha_x", "alpha_y", "alpha_z", [PM_IMPULSE] = "impulse_x", "impulse_y", "impulse_z",
	[PM_ANGULAR_IMPULSE] = "angular_impulse", [PM_ANGULAR_IMPULSE_OF] = "angular_impulse_x", "angular_impulse_y", "angular_impulse_z",
	[PM_ENSTROPHY] = "enstrophy", [PM_PALINSTROPHY] = "palinstrophy", [PM_OMEGA_MAX] = "omega_max",
	[PM_OMEGA_CENTRE] = "omega_centre", [PM_DISSIPATION] = "dissipation", [PM_ENERGY_LOSS] = "energy_loss", [PM_DIVERGENCE] = "divergence",
	[PM_KOLMOGOROV_LENGTH] = "kolmogorov_length", [PM_KOLMOGOROV_TIME] = "kolmogorov_time", [PM_ENERGY_FLOW] = "energy_flow",
	[PM_HELICITY] = "helicity", [PM_RING_CIRCULATION] = "ring_circulation", [PM_RING_RADIUS] = "ring_radius", [PM_RING_POSITION] = "ring_position",
	[PM_RING_SPEED] = "ring_speed", [PM_DISTORTION] = "distortion",
	[PM_CHARGE] = "charge", [PM_ENERGY_COMPONENT] = "energy_field_x", "energy_field_y", "energy_field_z",
	[PM_ENERGY_ELECTRIC] = "energy_electric", [PM_ENERGY_MAGNETIC] = "energy_magnetic", [PM_GAUSS_RESIDUAL] = "gauss_residual",
	[PM_STRENGTH_SCALE] = "strength_scale", [PM_STRENGTH_ABSORBED] = "strength_absorbed", [PM_STRENGTH_CUT] = "strength_cut_off",
	[PM_STRENGTH_OUTSIDE] = "strength_outside", [PM_STRENGTH_GIVEN] = "strength_given", [PM_OUTSIDE] = "outside",
	[PM_LEVEL_INSIDE] = "level_inside", [PM_LEVEL_INTERFACE] = "level_interface", [PM_LEVEL_DIFFERENCE] = "level_difference",
	[PM_COLUMNS] = "flux", "flux_enclosed", "field_residual", "field_curl", "separation", "separation_v",
};

const char *const pm_columns_numbered[] = {"mode_", "radius_", NULL};

bool pm_column_exists(enum pm_column c, int dim, int vdim)
{
	const int most = vdim > dim ? vdim : dim;
	if (c >= PM_MOMENTUM && c < PM_MOMENTUM + 3)
		return (int)(c - PM_MOMENTUM) < most;
	if (c >= PM_CENTRE && c < PM_CENTRE + 3)
		return (int)(c - PM_CENTRE) < dim;
	if (c >= PM_ENERGY_COMPONENT && c < PM_ENERGY_COMPONENT + 3)
		return (int)(c - PM_ENERGY_COMPONENT) < dim;
	if (c == PM_CIRCULATION || c == PM_ANGULAR_IMPULSE || c == PM_PALINSTROPHY || c == PM_OMEGA_CENTRE)
		return dim == 2;
	if ((c >= PM_ALPHA && c < PM_ALPHA + 3) || c == PM_IMPULSE + 2 || (c >= PM_ANGULAR_IMPULSE_OF && c < PM_ANGULAR_IMPULSE_OF + 3) ||
		(c >= PM_DIVERGENCE && c <= PM_RING_SPEED))
		return dim == 3;
	if (c >= PM_CROSSING_TIME && c <= PM_RELAXATION_TIME)
		return dim == 3;
	if (c >= PM_ANGULAR && c < PM_ANGULAR + 3)
		return most == 3 ? dim > 1 : most == 2 && c == PM_ANGULAR + 2;
	return true;
}

bool pm_column_suits(enum pm_column c, const struct pm_measure *how)
{
	const bool any = c == PM_STEP || c == PM_TIME || c == PM_ENERGY_MESH || c == PM_ENERGY_PAIR || c == PM_ENERGY || c == PM_PARTICLES ||
		c == PM_DISTANCE_MAX;
	if (c >= PM_CROSSING_TIME && c <= PM_RELAXATION_TIME)
		return how->strength && !strcmp(how->strength, "mass");
	if (c >= PM_LEVEL_INSIDE)
		return how->level;
	if (c >= PM_STRENGTH_SCALE)
		return how->strength != NULL;
	if (c >= PM_ENERGY_ELECTRIC)
		return how->evolves;
	if (c >= PM_CHARGE)
		return how->plasma;
	return any || how->vortices == (c >= PM_CIRCULATION && c <= PM_DISTORTION);
}

/* Of masses in open space: crossing time R/v of R = G M^2/|W| and the rms velocity v (in equilibrium v^2 = G M/R), the logarithm of the largest over the
 * smallest distance of an encounter, R over R/N or, if larger, the softening (on a mesh the cell), and N/(8 ln Lambda) crossing times, in which
 * encounters change velocities by themselves. Source: Binney and Tremaine 2008, section 1.2.1. */
static void relaxation(const struct pm_frame *f, const struct pm_particle_sums *bulk, double w, bool mesh, struct pm_measures *m)
{
	const double radius = pm_law_constant(f, "G", 1) * bulk->mass * bulk->mass / fabs(w), v = sqrt(2 * bulk->kinetic / bulk->mass);
	const double least = mesh && f->nmeshes ? f->meshes[0]->h[0] : pm_frame_constant(f, "softening", 0);
	const double logarithm = log(fmin(bulk->n, radius / least));
	m->value[PM_CROSSING_TIME] = w < 0 && v > 0 ? radius / v : NAN;
	m->value[PM_COULOMB_LOGARITHM] = w < 0 && logarithm > 0 ? logarithm : NAN;
	m->value[PM_RELAXATION_TIME] = bulk->n / (8 * m->value[PM_COULOMB_LOGARITHM]) * m->value[PM_CROSSING_TIME];
}

void pm_measures_of(const struct pm_frame *f, const struct pm_particle_sums *bulk, double mesh, double pair, bool field, struct pm_measures *m)
{
	const double w = isnan(pair) ? mesh : pair;
	m->value[PM_STEP] = (double)f->step;
	m->value[PM_TIME] = f->time;
	m->value[PM_ENERGY_KINETIC] = bulk->kinetic;
	m->value[PM_ENERGY_MESH] = mesh;
	m->value[PM_ENERGY_PAIR] = pair;
	m->value[PM_ENERGY] = bulk->kinetic + (field ? w : 0);
	for (int d = 0; d < 3; d++) {
		m->value[PM_MOMENTUM + d] = bulk->momentum[d];
		m->value[PM_ANGULAR + d] = bulk->angular[d];
		m->value[PM_CENTRE + d] = bulk->moment[d] / bulk->mass; /* NAN without particles */
	}
	m->value[PM_MOMENTUM_SCALE] = bulk->scale;
	m->value[PM_MASS] = bulk->mass;
	m->value[PM_PARTICLES] = bulk->n;
	m->value[PM_SPEED_RMS] = sqrt(bulk->square / bulk->movers);
	m->value[PM_DISTANCE_MAX] = bulk->farthest;
	m->value[PM_VIRIAL_RATIO] = 2 * bulk->kinetic / fabs(w);
	relaxation(f, bulk, w, isnan(pair), m);
}
