/* Electrons hotter, or streaming, across the wave vector than along it: the magnetic instabilities of Weibel and of filamentation. x is the axis of the wave;
 * velocities are Maxwellian with vth along x and vth sqrt(anisotropy) along y and z; half of the electrons stream with v0 along y, half with -v0; ions are a
 * background; omega_p = c = 1. --wave-field seeds B_z = A cos(k x), which grows at gamma; waves with k below sqrt(anisotropy - 1) grow.
 * Growth of cold streams: g^4 + g^2 (k^2 + 1/G^3) - k^2 v0^2/G = 0, G = 1/sqrt(1 - v0^2). Of a Maxwellian at rest (v << 1): the root i gamma of
 * gamma^2 + k^2 = a - 1 + a zeta Z(zeta), zeta = i gamma/(sqrt 2 k vth), a the anisotropy: 0.08287035 for the defaults (0.05, 10, k = 1).
 * Quiet start: Hammersley's points, in groups of four at one place with both signs of vx and of (vy, vz), so that no group carries a current.
 * Source: Weibel 1959, Physical Review Letters 2, 83; Fried 1959, Physics of Fluids 2, 337; PIC-09 of the reference cases. Exact: mass, charge, gamma.
 * Cost N. SPDX-License-Identifier: GPL-3.0-or-later */
#include <string.h>

#include "scene-parts/scene-electromagnetic.h"
#include "scene-parts/scene-loading.h"

enum { VTH, ANISOTROPY, V0, WAVENUMBER, MODE, FIELD };

static const struct pm_scene_parameter rows[] = {
	{.name = "vth", .unit = "length/time", .otherwise = 0.05, .high = 1, .text = "thermal speed, the standard deviation of the velocity"},
	{.name = "anisotropy", .otherwise = 10, .high = 1e6, .text = "temperature across x over that along x"},
	{.name = "v0", .unit = "length/time", .high = 0.999999, .text = "speed of each beam"},
	{.name = "wavenumber", .unit = "1/length", .otherwise = 1, .low = 1e-300, .high = 1e300, .text = "k of mode 1; the box is 2 pi/k long"},
	{.name = "mode", .otherwise = 1, .low = 1, .high = 1e6, .text = "waves in the box"},
	{.name = "wave-field", .otherwise = 1e-5, .low = -1e300, .high = 1e300, .text = "largest E of the wave (of weibel, B)"},
	{0},
};

struct wave {
	double k, amplitude;
};

static double magnetic(int c, const double x[3], const void *data)
{
	const struct wave *w = data;
	return c == 2 ? w->amplitude * cos(w->k * x[0]) : 0;
}

static int fill(const struct pm_scene_choice *c, double length, double *x, double *const v[3])
{
	const uint64_t groups = c->n / 4;
	const double across = c->value[VTH] * sqrt(c->value[ANISOTROPY]);
	double *room = pm_alloc(4 * groups + 1, sizeof *room);
	double *const u[PM_LOAD_AXES] = {room, room + groups, room + 2 * groups, room + 3 * groups};
	int status = room ? pm_scene_points(PM_BIT_REVERSED, c->seed, groups, 4, u) : -PM_DATA;
	for (uint64_t i = 0; i < c->n && !status; i++) {
		const uint64_t g = i / 4;
		const double along = i & 1 ? -1 : 1, sign = i & 2 ? -1 : 1;
		x[i] = pm_scene_fold(u[0][g] * length, length);
		v[0][i] = along * c->value[VTH] * pm_scene_normal_of(u[1][g]);
		v[1][i] = sign * (c->value[V0] + across * pm_scene_normal_of(u[2][g]));
		v[2][i] = sign * across * pm_scene_normal_of(u[3][g]);
		if (!(v[0][i] * v[0][i] + v[1][i] * v[1][i] + v[2][i] * v[2][i] < 1))
			status = pm_fail(PM_USAGE, "electron %llu would be faster than light (a smaller --vth, --anisotropy or --v0)", (unsigned long long)i);
	}
	pm_free(room);
	return status;
}

static int make(const struct pm_scene_choice *c, struct pm_frame *f)
{
	const double length = 2 * pm_pi / c->value[WAVENUMBER], share = c->n ? length / (double)c->n : 0;
	const struct wave w = {.k = c->value[WAVENUMBER] * c->value[MODE], .amplitude = c->value[FIELD]};
	double *x[3], *v[3];
	if (pm_scene_plasma_whole(c->value[MODE], 3, 1))
		return -PM_USAGE;
	if (c->n % 4)
		return pm_fail(PM_USAGE, "%llu electrons do not make groups of four (take a -n that 4 divides)", (unsigned long long)c->n);
	if (pm_scene_em_world(c, f, length, 64, 1) || pm_scene_em_fields(f, NULL, magnetic, &w) || pm_scene_plasma_set(f, c->n, 3, -share, share, x, v))
		return -PM_DATA;
	return fill(c, length, x[0], v);
}

/* Of a Maxwellian at rest: the positive root by bisection; i Z(i y) = -sqrt(pi) exp(y^2) erfc(y). 0: no growth. */
static double warm(double k, double vth, double a)
{
	double low = 0, high = sqrt(fmax(a - 1, 0));
	for (int i = 0; i < 100; i++) {
		const double g = 0.5 * (low + high), y = g / (sqrt(2) * k * vth), w = y < 25 ? y * exp(y * y) * erfc(y) : 1 / sqrt(pm_pi) * (1 - 0.5 / (y * y));
		if (g * g + k * k < a - 1 - a * sqrt(pm_pi) * w)
			low = g;
		else
			high = g;
	}
	return low;
}

static double exact(const struct pm_frame *f, const char *quantity, double t)
{
	const double length = 2 * pm_pi / pm_frame_parameter(f, "wavenumber", 1), k = 2 * pm_pi / length * pm_frame_parameter(f, "mode", 1);
	const double v = pm_frame_parameter(f, "v0", 0), slow = sqrt(1 - v * v), b = k * k + slow * slow * slow;
	(void)t;
	if (!strcmp(quantity, "mass") || !strcmp(quantity, "charge"))
		return *quantity == 'm' ? length : -length;
	if (strcmp(quantity, "gamma") || (v != 0 && pm_frame_parameter(f, "vth", 1) != 0))
		return NAN;
	return v != 0 ? sqrt(0.5 * (sqrt(b * b + 4 * k * k * v * v * slow) - b))
		: warm(k, pm_frame_parameter(f, "vth", 1), pm_frame_parameter(f, "anisotropy", 1));
}

const struct pm_scene scene_weibel = {
	.name = "weibel",
	.sentence = "electrons hot or streaming across a magnetic wave, which grows",
	.source = "Weibel 1959",
	.dims = 1u << 1,
	.dim = 1,
	.n = 16384,
	.parameters = rows,
	.make = make,
	.exact = exact,
};
