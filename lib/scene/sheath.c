/* A plasma between a hot plate that emits electrons and ions (x-low, at ground) and a collector that floats (x-high); both absorb. Reservoirs beyond the hot
 * plate: electrons of density 1, temperature 1, mass 1 and ions of density --ion-density, temperature --ion-temperature, mass --mass-ratio; a half
 * Maxwellian of each comes in (word inject). No collisions: with psi = phi/T_e, falling from 0 at the plate to psi_p of the plasma and psi_w of the collector,
 *     n_e = exp(psi) (1 + erf sqrt(psi - psi_w))/2,   n_i = n_0/2 exp(-t psi) erfc sqrt(-t psi),   t = T_e/T_i,
 * the currents cancel, exp(psi_w) = n_0 sqrt(T_i/m_i), and n_e = n_i in the plasma. The box is empty at the start.
 * Source: Schwager and Birdsall 1990 (Phys. Fluids B 2, 1057), section II; Kuhn 1981 (Plasma Phys. 23, 881). Exact: potential_wall, potential_plasma,
 * density (electrons in the plasma), flux (of ions), ion_speed (their mean velocity there). Cost 1. SPDX-License-Identifier: GPL-3.0-or-later */
#include <string.h>

#include "scene-parts/scene-plasma.h"
#include "stream/declare.h"

enum { LENGTH, MASS, TEMPERATURE, DENSITY };

static const struct pm_scene_parameter rows[] = {
	{.name = "length", .unit = "length", .otherwise = 40, .low = 1e-300, .high = 1e300, .text = "between the plates, in Debye lengths of the reservoir"},
	{.name = "mass-ratio", .otherwise = 100, .low = 1, .high = 1e9, .text = "mass of an ion over that of an electron"},
	{.name = "ion-temperature", .otherwise = 1, .low = 1e-6, .high = 1e6, .text = "temperature of the ions over that of the electrons"},
	{.name = "ion-density", .otherwise = 1.8, .low = 1e-6, .high = 2, .text = "density of the ions beyond the hot plate"},
	{0},
};

static int ions(struct pm_frame *f)
{
	struct pm_scene_body b;
	struct pm_field *q;
	if (pm_scene_set(f, "ions", 0, true, 0, &b) || !(q = pm_makes(f, "ions", "charge", 1, PM_STATE)))
		return -PM_DATA;
	q->extensive = q->uniform = true;
	return 0;
}

static int make(const struct pm_scene_choice *c, struct pm_frame *f)
{
	double *x[3], *v[3];
	if (c->n)
		return pm_fail(PM_USAGE, "the scene sheath begins empty (without -n; inject fills it)");
	pm_scene_plasma_world(f, c->value[LENGTH], 0, 0.2);
	pm_frame_constant_set(f, "charge_x_high", 0);
	f->face[0][0] = PM_WALL;
	f->face[0][1] = PM_NEUMANN;
	f->pface[0][0] = f->pface[0][1] = PM_PABSORB;
	return pm_scene_mesh(f, 80) || pm_scene_plasma_set(f, 0, c->dim, 0, 0, x, v) || ions(f) ? -PM_DATA : 0;
}

/* n_e - n_i at psi. */
static double charge(double psi, double wall, double density, double t)
{
	return 0.5 * (exp(psi) * (1 + erf(sqrt(fmax(0, psi - wall)))) - density * exp(-t * psi) * erfc(sqrt(-t * psi)));
}

static double exact(const struct pm_frame *f, const char *quantity, double time)
{
	const double mass = pm_frame_parameter(f, "mass-ratio", 100), T = pm_frame_parameter(f, "ion-temperature", 1);
	const double density = pm_frame_parameter(f, "ion-density", 1.8), flux = density * sqrt(T / (2 * pm_pi * mass));
	const double wall = log(density * sqrt(T / mass));
	double low = wall, high = 0; /* ions prevail at the collector, electrons at the plate */
	if (!strcmp(quantity, "mass") || !strcmp(quantity, "charge"))
		return time == 0 ? 0 : NAN;
	if (!(charge(wall, wall, density, 1 / T) < 0 && charge(0, wall, density, 1 / T) > 0))
		return NAN;
	for (int i = 0; i < 200; i++) {
		const double psi = 0.5 * (low + high);
		if (charge(psi, wall, density, 1 / T) > 0)
			high = psi;
		else
			low = psi;
	}
	const double n = 0.5 * density * exp(-low / T) * erfc(sqrt(-low / T));
	return !strcmp(quantity, "potential_wall") ? wall : !strcmp(quantity, "potential_plasma") ? low : !strcmp(quantity, "density") ? n :
		!strcmp(quantity, "flux") ? flux : !strcmp(quantity, "ion_speed") ? flux / n : NAN;
}

const struct pm_scene scene_sheath = {
	.name = "sheath",
	.sentence = "a plasma that a hot plate emits, in front of a collector that floats (inject fills it)",
	.source = "Schwager and Birdsall 1990, II",
	.dims = 1u << 1,
	.dim = 1,
	.n = 0,
	.parameters = rows,
	.make = make,
	.exact = exact,
};
