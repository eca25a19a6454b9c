/* A Maxwellian plasma with a small wave, f = (1 + A cos k x) M(v), which is Landau damped. vth = 1 and omega_p = 1, so lambda_D = 1 and
 * the default k = 0.5 is k lambda_D = 0.5: omega = 1.4156619, gamma = -0.1533595; k = 0.3: 1.1598465, -0.01262037.
 * Quiet start: Hammersley's points, velocities by their quantiles, positions by reversed bits through the inverse of x + (A/k) sin k x; every second
 * particle is the mirror image of the one before, so the momentum is zero. Or, without noise, --beams of evenly spaced velocities with the weights
 * of the Maxwellian; they are in phase again (recurrence) after 2 pi/(k dv), dv = 12 vth over their number.
 * Source: Landau 1946; Birdsall and Langdon 1985, section 5-15 and chapter 16; PIC-01 of the reference cases.
 * Exact: mass, charge. Cost N.
 * SPDX-License-Identifier: GPL-3.0-or-later */
#include <string.h>

#include "scene-parts/scene-plasma.h"
#include "stream/declare.h"

enum { AMPLITUDE, MODE, WAVENUMBER, VTH, VELOCITIES, BEAMS };

static const struct pm_scene_parameter rows[] = {
	{.name = "amplitude", .otherwise = 0.02, .high = 0.999, .text = "k A at the start"},
	{.name = "mode", .otherwise = 1, .low = 1, .high = 1e6, .text = "waves in the box"},
	{.name = "wavenumber", .unit = "1/length", .otherwise = 0.5, .low = 1e-300, .high = 1e300, .text = "k of mode 1; the box is 2 pi/k long"},
	{.name = "vth", .unit = "length/time", .otherwise = 1, .high = 1e300, .text = "thermal speed, the standard deviation of the velocity"},
	{.name = "velocities", .otherwise = 1, .low = 1, .high = 3, .text = "components of v"},
	{.name = "beams", .high = 1e6, .text = "evenly spaced velocities from -6 to 6 vth, weighted; 0: each particle its own, all of one weight"},
	{0},
};

/* x with x + (a/k) sin(k x) = q. */
static double place(double q, double a, double k)
{
	double x = q;
	for (int i = 0; i < 50; i++) {
		const double step = (x + a / k * sin(k * x) - q) / (1 + a * cos(k * x));
		x -= step;
		if (fabs(step) < 1e-15 * q)
			break;
	}
	return x;
}

/* Beams of evenly spaced velocities, evenly spaced particles in each, masses in proportion to the Maxwellian. */
static int make_beams(const struct pm_scene_choice *c, struct pm_frame *f, double length, double k, double *x, double *v)
{
	const uint64_t beams = (uint64_t)c->value[BEAMS], each = c->n / beams;
	double total = 0, *weight[2];
	if (c->value[BEAMS] != floor(c->value[BEAMS]) || each * beams != c->n)
		return pm_fail(PM_USAGE, "%llu particles do not make %g beams of the same number (-n a multiple of --beams)",
			(unsigned long long)c->n, c->value[BEAMS]);
	for (int i = 0; i < 2; i++) {
		struct pm_field *field = pm_frame_field(f, "electrons", i ? "mass" : "charge");
		field->uniform = false;
		if (pm_field_ready(field))
			return -PM_DATA;
		weight[i] = pm_out(field, 0);
	}
	for (uint64_t b = 0; b < beams; b++)
		total += exp(-0.5 * pow(12 * ((double)b + 0.5) / (double)beams - 6, 2));
	for (uint64_t i = 0; i < c->n; i++) {
		const double u = 12 * ((double)(i / each) + 0.5) / (double)beams - 6, share = exp(-0.5 * u * u) / total * length / (double)each;
		/* each lattice is offset (golden section), or their images on the mesh would come into phase repeatedly */
		const double first = fmod(0.6180339887498949 * ((double)(i / each) + 1), 1);
		x[i] = pm_scene_fold(place(((double)(i % each) + first) / (double)each * length, c->value[AMPLITUDE], k), length);
		v[i] = c->value[VTH] * u;
		weight[0][i] = -share, weight[1][i] = share;
	}
	return 0;
}

static int make(const struct pm_scene_choice *c, struct pm_frame *f)
{
	const double length = 2 * pm_pi / c->value[WAVENUMBER], k = c->value[WAVENUMBER] * c->value[MODE], n = (double)c->n, share = c->n ? length / n : 0;
	double *x[3], *v[3];
	if (pm_scene_plasma_whole(c->value[MODE], c->value[VELOCITIES], 1))
		return -PM_USAGE;
	if (c->n % 2 && c->value[BEAMS] == 0)
		return pm_fail(PM_USAGE, "%llu particles do not make mirror images (take an even -n)", (unsigned long long)c->n);
	pm_scene_plasma_world(f, length, 1, 0.1);
	if (pm_scene_mesh(f, 64) || pm_scene_plasma_set(f, c->n, (int)c->value[VELOCITIES], -share, share, x, v))
		return -PM_DATA;
	if (c->value[BEAMS] > 0)
		return make_beams(c, f, length, k, x[0], v[0]);
#pragma omp parallel for schedule(static) if (c->n > 16384)
	for (uint64_t i = 0; i < c->n; i++) {
		const uint64_t j = i / 2;
		const double at = place((pm_scene_bits_reversed(j) + 0.5 / n) * length, c->value[AMPLITUDE], k);
		const double speed = c->value[VTH] * pm_scene_normal_of(((double)j + 0.5) / (n / 2));
		x[0][i] = pm_scene_fold(i % 2 ? length - at : at, length);
		v[0][i] = i % 2 ? -speed : speed;
	}
	return 0;
}

static double exact(const struct pm_frame *f, const char *quantity, double t)
{
	const double length = 2 * pm_pi / pm_frame_parameter(f, "wavenumber", 0.5);
	(void)t;
	return !strcmp(quantity, "mass") ? length : !strcmp(quantity, "charge") ? -length : NAN;
}

const struct pm_scene scene_landau = {
	.name = "landau",
	.sentence = "a wave in a Maxwellian plasma that is damped without collisions",
	.source = "Landau 1946, J. Phys. USSR 10, 25",
	.dims = 1u << 1,
	.dim = 1,
	.n = 20000,
	.parameters = rows,
	.make = make,
	.exact = exact,
};
