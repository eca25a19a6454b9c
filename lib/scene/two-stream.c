/* Two beams of electrons, v0 and -v0, half of the density each (together omega_p = 1), before immobile ions; cold, or Maxwellian of width vth.
 * Cold beams grow for k v0 < 1 at gamma^2 = sqrt(2 a + 1/4) - a - 1/2, a = (k v0)^2, fastest at a = 3/8: gamma = 1/sqrt 8. Equal Maxwellian beams are
 * stable at every k below v0/vth = 1.30693. Quiet start: particles of the two beams are mirror images; cold beams are lattices, warm ones
 * Hammersley's points (velocities by their quantiles, positions by reversed bits). Both are displaced by (A/k) sin(k q).
 * Source: Birdsall and Langdon 1985, sections 5-6 to 5-9; PIC-02, PIC-03, HC-04 of the reference cases.
 * Exact: mass, charge, gamma (cold). Cost N.
 * SPDX-License-Identifier: GPL-3.0-or-later */
#include <string.h>

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

static int make(const struct pm_scene_choice *c, struct pm_frame *f)
{
	const double length = 2 * pm_pi / c->value[WAVENUMBER], k = c->value[WAVENUMBER] * c->value[MODE], n = (double)c->n,
		share = c->n ? length / n : 0, vth = c->value[VTH];
	double *x[3], *v[3];
	if (pm_scene_plasma_whole(c->value[MODE], c->value[VELOCITIES], 1))
		return -PM_USAGE;
	if (c->n % 2)
		return pm_fail(PM_USAGE, "%llu particles do not make two equal beams (take an even -n)", (unsigned long long)c->n);
	pm_scene_plasma_world(f, length, 1, 0.1);
	if (pm_scene_mesh(f, 128) || pm_scene_plasma_set(f, c->n, (int)c->value[VELOCITIES], -share, share, x, v))
		return -PM_DATA;
#pragma omp parallel for schedule(static) if (c->n > 16384)
	for (uint64_t i = 0; i < c->n; i++) {
		const uint64_t j = i / 2;
		const double quantile = ((double)j + 0.5) / (n / 2), sign = i % 2 ? -1 : 1;
		const double place = vth > 0 ? pm_scene_bits_reversed(j) : quantile, q = (place + 0.5 / n) * length;
		x[0][i] = pm_scene_fold(q + c->value[AMPLITUDE] / k * sin(k * q), length);
		v[0][i] = sign * (c->value[V0] + (vth > 0 ? vth * pm_scene_normal_of(quantile) : 0));
	}
	return 0;
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
	return NAN;
}

const struct pm_scene scene_two_stream = {
	.name = "two-stream",
	.sentence = "two beams of electrons through each other, cold or warm",
	.source = "Birdsall and Langdon 1985, chapter 5",
	.dims = 1u << 1,
	.dim = 1,
	.n = 10000,
	.parameters = rows,
	.make = make,
	.exact = exact,
};
