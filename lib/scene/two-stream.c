/* Two beams of electrons, v0 and -v0, half of the density each (together omega_p = 1), before immobile ions; cold, or Maxwellian of width vth.
 * Cold beams grow for k v0 < 1 at gamma^2 = sqrt(2 a + 1/4) - a - 1/2, a = (k v0)^2, fastest at a = 3/8: gamma = 1/sqrt 8. Equal Maxwellian beams are
 * stable at every k below v0/vth = 1.30693. Quiet start: the particles of the two beams have the same places and opposite velocities; cold
 * beams are lattices, warm ones lattices in phase space with the weights of the Maxwellian (--loading: or of one weight, velocities by their quantiles,
 * positions by reversed bits or Sobol's sequence; or all at random). All are displaced by (A/k) sin(k q).
 * Source: Birdsall and Langdon 1985, sections 5-6 to 5-9; PIC-02, PIC-03, HC-04 of the reference cases.
 * Exact: mass, charge, gamma and omega of the wave that grows most (or is damped least). Cost N.
 * SPDX-License-Identifier: GPL-3.0-or-later */
#include <string.h>

#include "plasma/dispersion.h"
#include "scene-parts/scene-loading.h"
#include "scene-parts/scene-plasma.h"

enum { V0, VTH, AMPLITUDE, MODE, WAVENUMBER, VELOCITIES };

static const struct pm_scene_parameter rows[] = {
	{.name = "v0", .unit = "length/time", .otherwise = 0.6123724356957945, .high = 1e300, .text = "speed of each beam"},
	{.name = "vth", .unit = "length/time", .high = 1e300, .text = "thermal speed, the standard deviation of the velocity"},
	{.name = "amplitude", .otherwise = 1e-4, .high = 0.999, .text = "k A at the start"},
	{.name = "mode", .otherwise = 1, .low = 1, .high = 1e6, .text = "waves in the box"},
	{.name = "wavenumber", .unit = "1/length", .otherwise = 1, .low = 1e-300, .high = 1e300, .text = "k of mode 1; the box is 2 pi/k long"},
	{.name = "velocities", .otherwise = 1, .low = 1, .high = 3, .text = "components of v"},
	{0},
};

/* Positions in 0..1 and thermal velocities of one beam, in standard deviations, and weights with the sum 1; NULL where all are equal. */
static int one_beam(const struct pm_scene_choice *c, uint64_t n, double *place, double *z, double *weight)
{
	const bool warm = c->value[VTH] > 0;
	struct pm_scene_beams beams;
	if (c->loading != PM_LATTICE || !warm) {
		const enum pm_loading how = c->loading == PM_LATTICE ? PM_BIT_REVERSED : c->loading; /* of one axis that is a lattice */
		if (pm_scene_points(how, c->seed, n, warm ? 2 : 1, (double *const[PM_LOAD_AXES]){place, z}))
			return -PM_DATA;
		for (uint64_t i = 0; i < n; i++)
			z[i] = warm ? pm_scene_normal_of(z[i]) : 0;
		return 0;
	}
	if (pm_scene_beams_init(n, 0, &beams))
		return -PM_USAGE;
	for (uint64_t i = 0; i < n; i++) {
		const struct pm_scene_beam_point p = pm_scene_beam_at(&beams, i);
		place[i] = p.place, z[i] = p.velocity, weight[i] = p.weight;
	}
	return 0;
}

/* The beams from one (quiet: the same places, opposite velocities), or at random from all particles. */
static int fill(const struct pm_scene_choice *c, struct pm_frame *f, double length, double *x, double *v)
{
	const bool random = c->loading == PM_RANDOM, weighted = c->loading == PM_LATTICE && c->value[VTH] > 0;
	const uint64_t points = random ? c->n : c->n / 2;
	const double k = c->value[WAVENUMBER] * c->value[MODE];
	double *weight[2] = {NULL}, *one = pm_alloc(3 * points + 1, sizeof *one);
	int status = one ? weighted ? pm_scene_plasma_weights(f, weight) : 0 : -PM_DATA;
	status = status ? status : one_beam(c, points, one, one + points, one + 2 * points);
	for (uint64_t i = 0; i < c->n && !status; i++) {
		const uint64_t j = random ? i : i / 2;
		const double q = one[j] * length, sign = i % 2 ? -1 : 1;
		x[i] = pm_scene_fold(q + c->value[AMPLITUDE] / k * sin(k * q), length);
		v[i] = sign * (c->value[V0] + c->value[VTH] * one[points + j]);
		for (int w = 0; w < 2 && weighted; w++)
			weight[w][i] = (w ? 0.5 : -0.5) * length * one[2 * points + j];
	}
	if (!status && random)
		pm_scene_centre(c->n, NULL, v);
	pm_free(one);
	return status;
}

static int make(const struct pm_scene_choice *c, struct pm_frame *f)
{
	const double length = 2 * pm_pi / c->value[WAVENUMBER], share = c->n ? length / (double)c->n : 0;
	double *x[3], *v[3];
	if (pm_scene_plasma_whole(c->value[MODE], c->value[VELOCITIES], 1))
		return -PM_USAGE;
	if (c->n % 2)
		return pm_fail(PM_USAGE, "%llu particles do not make two equal beams (take an even -n)", (unsigned long long)c->n);
	/* of 1/omega_p, or of the time to cross a wave */
	pm_scene_plasma_world(f, length, 1, 0.1 / fmax(1, c->value[WAVENUMBER] * c->value[MODE] * (c->value[V0] + c->value[VTH])));
	if (pm_scene_mesh(f, 128) || pm_scene_plasma_set(f, c->n, (int)c->value[VELOCITIES], -share, share, x, v))
		return -PM_DATA;
	return fill(c, f, length, x[0], v[0]);
}

static double exact(const struct pm_frame *f, const char *quantity, double t)
{
	const double k1 = pm_frame_parameter(f, "wavenumber", 1), length = 2 * pm_pi / k1;
	const double a = pow(k1 * pm_frame_parameter(f, "mode", 1) * pm_frame_parameter(f, "v0", 0), 2);
	(void)t;
	if (!strcmp(quantity, "mass"))
		return length;
	if (!strcmp(quantity, "charge"))
		return -length;
	if (!strcmp(quantity, "gamma") && pm_frame_parameter(f, "vth", 0) == 0)
		return a < 1 ? sqrt(sqrt(2 * a + 0.25) - a - 0.5) : 0;
	if (!strcmp(quantity, "gamma") || !strcmp(quantity, "omega")) {
		const double v0 = pm_frame_parameter(f, "v0", 0), vth = pm_frame_parameter(f, "vth", 0), half = sqrt(0.5);
		const struct pm_wave_species beams[] = {{half, v0, vth}, {half, -v0, vth}};
		const double complex root = pm_wave_strongest(beams, 2, k1 * pm_frame_parameter(f, "mode", 1));
		return *quantity == 'o' ? fabs(creal(root)) < 1e-12 ? 0 : creal(root) : cimag(root);
	}
	return strcmp(quantity, "spread_along") ? NAN : hypot(pm_frame_parameter(f, "v0", 0), pm_frame_parameter(f, "vth", 0));
}

const struct pm_scene scene_two_stream = {
	.name = "two-stream",
	.sentence = "two beams of electrons through each other, cold or warm",
	.source = "Birdsall and Langdon 1985, chapter 5",
	.dims = 1u << 1,
	.dim = 1,
	.n = 10000,
	.loads = true,
	.parameters = rows,
	.make = make,
	.exact = exact,
};
