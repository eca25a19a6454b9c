/* A Maxwellian plasma with a small wave, f = (1 + A cos k x) M(v), which is Landau damped. vth = 1 and omega_p = 1, so lambda_D = 1 and
 * the default k = 0.5 is k lambda_D = 0.5: omega = 1.4156619, gamma = -0.1533595; k = 0.3: 1.1598465, -0.01262037.
 * Quiet start: a lattice of --beams evenly spaced velocities with the weights of the Maxwellian, without noise until they are in phase again (recurrence)
 * after 2 pi/(k dv), dv = 12 vth over their number. --loading bit-reversed and sobol: particles of one weight, velocities by their quantiles, positions
 * through the inverse of x + (A/k) sin k x; every second particle is the mirror image of the one before, so the momentum is zero. random: neither.
 * Source: Landau 1946; Birdsall and Langdon 1985, section 5-15 and chapter 16; PIC-01 of the reference cases.
 * Exact: mass, charge; omega and gamma of the wave, small and after its other roots have gone (lib/plasma). Cost N.
 * SPDX-License-Identifier: GPL-3.0-or-later */
#include <string.h>

#include "plasma/dispersion.h"
#include "scene-parts/scene-loading.h"
#include "scene-parts/scene-plasma.h"

enum { AMPLITUDE, MODE, WAVENUMBER, VTH, VELOCITIES, BEAMS };

static const struct pm_scene_parameter rows[] = {
	{.name = "amplitude", .otherwise = 0.02, .high = 0.999, .text = "k A at the start"},
	{.name = "mode", .otherwise = 1, .low = 1, .high = 1e6, .text = "waves in the box"},
	{.name = "wavenumber", .unit = "1/length", .otherwise = 0.5, .low = 1e-300, .high = 1e300, .text = "k of mode 1; the box is 2 pi/k long"},
	{.name = "vth", .unit = "length/time", .otherwise = 1, .high = 1e300, .text = "thermal speed, the standard deviation of the velocity"},
	{.name = "velocities", .otherwise = 1, .low = 1, .high = 3, .text = "components of v"},
	{.name = "beams", .high = 1e6, .text = "evenly spaced velocities from -6 to 6 vth, weighted (--loading lattice); 0: sqrt(0.8 n)"},
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

/* A lattice in phase space with the weights of the Maxwellian. */
static int make_lattice(const struct pm_scene_choice *c, struct pm_frame *f, double length, double k, double *x, double *v)
{
	double *weight[2];
	struct pm_scene_beams beams;
	if (pm_scene_beams_init(c->n, c->value[BEAMS], &beams))
		return -PM_USAGE;
	if (pm_scene_plasma_weights(f, weight))
		return -PM_DATA;
#pragma omp parallel for schedule(static) if (c->n > 16384)
	for (uint64_t i = 0; i < c->n; i++) {
		const struct pm_scene_beam_point p = pm_scene_beam_at(&beams, i);
		x[i] = pm_scene_fold(place(p.place * length, c->value[AMPLITUDE], k), length);
		v[i] = c->value[VTH] * p.velocity;
		weight[0][i] = -p.weight * length, weight[1][i] = p.weight * length;
	}
	return 0;
}

/* The sequences: half of the particles, and their mirror images. At random: all of them, at rest together. */
static int make_equal(const struct pm_scene_choice *c, double length, double k, double *x, double *v)
{
	const uint64_t points = c->loading == PM_RANDOM ? c->n : c->n / 2;
	double *const u[PM_LOAD_AXES] = {x, v};
	if (c->value[BEAMS] > 0)
		return pm_fail(PM_USAGE, "--beams is for --loading lattice");
	if (points + points != c->n && points != c->n)
		return pm_fail(PM_USAGE, "%llu particles do not make mirror images (take an even -n)", (unsigned long long)c->n);
	if (pm_scene_points(c->loading, c->seed, points, 2, u))
		return -PM_DATA;
	for (uint64_t i = points; i-- > 0;) { /* from the end, because the images go between */
		const double at = place(x[i] * length, c->value[AMPLITUDE], k), speed = c->value[VTH] * pm_scene_normal_of(v[i]);
		const uint64_t first = points == c->n ? i : 2 * i;
		if (points != c->n)
			x[first + 1] = pm_scene_fold(length - at, length), v[first + 1] = -speed;
		x[first] = pm_scene_fold(at, length), v[first] = speed;
	}
	if (points == c->n)
		pm_scene_centre(c->n, NULL, v);
	return 0;
}

static int make(const struct pm_scene_choice *c, struct pm_frame *f)
{
	const double length = 2 * pm_pi / c->value[WAVENUMBER], k = c->value[WAVENUMBER] * c->value[MODE], n = (double)c->n, share = c->n ? length / n : 0;
	double *x[3], *v[3];
	if (pm_scene_plasma_whole(c->value[MODE], c->value[VELOCITIES], 1))
		return -PM_USAGE;
	pm_scene_plasma_world(f, length, 1, 0.1 / fmax(1, k * c->value[VTH])); /* of 1/omega_p, or of the time to cross a wave */
	if (pm_scene_mesh(f, 64) || pm_scene_plasma_set(f, c->n, (int)c->value[VELOCITIES], -share, share, x, v))
		return -PM_DATA;
	return c->loading == PM_LATTICE ? make_lattice(c, f, length, k, x[0], v[0]) : make_equal(c, length, k, x[0], v[0]);
}

static double exact(const struct pm_frame *f, const char *quantity, double t)
{
	const double length = 2 * pm_pi / pm_frame_parameter(f, "wavenumber", 0.5);
	(void)t;
	if (!strcmp(quantity, "omega") || !strcmp(quantity, "gamma")) {
		const struct pm_wave_species s = {1, 0, pm_frame_parameter(f, "vth", 1)};
		const double complex root = pm_wave_strongest(&s, 1, 2 * pm_pi / length * pm_frame_parameter(f, "mode", 1));
		return *quantity == 'o' ? creal(root) : cimag(root);
	}
	if (!strcmp(quantity, "bounce")) /* of a particle in a trough of the wave at the start: sqrt(k q E/m), k E = A */
		return sqrt(pm_frame_parameter(f, "amplitude", 0.02));
	if (!strcmp(quantity, "spread_along"))
		return pm_frame_parameter(f, "vth", 1);
	return !strcmp(quantity, "mass") ? length : !strcmp(quantity, "charge") ? -length : NAN;
}

const struct pm_scene scene_landau = {
	.name = "landau",
	.sentence = "a wave in a Maxwellian plasma that is damped without collisions",
	.source = "Landau 1946, J. Phys. USSR 10, 25",
	.dims = 1u << 1,
	.dim = 1,
	.n = 20000,
	.loads = true,
	.parameters = rows,
	.make = make,
	.exact = exact,
};
