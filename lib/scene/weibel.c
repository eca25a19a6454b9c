/* Electrons hotter, or streaming, across the wave vector than along it: the magnetic instabilities of Weibel and of filamentation. x is the axis of the wave;
 * velocities are Maxwellian with vth along x and vth sqrt(anisotropy) along y and z; half of the electrons stream with v0 along y, half with -v0; ions are a
 * background; omega_p = c = 1. --wave-field seeds B_z = A cos(k x), which grows at gamma; waves with k below sqrt(anisotropy - 1) grow.
 * Growth of cold streams: g^4 + g^2 (k^2 + 1/G^3) - k^2 v0^2/G = 0, G = 1/sqrt(1 - v0^2). Else the root of the response of relativistic orbits, u = G v,
 * g^2 + k^2 + <(1 - vy^2)/G> + 2 i k <vx vy^2/(G s)> - k^2 <vy^2 (1 - vx^2)/(G s^2)> = 0, s = g + i k vx: 0.0806303 for the defaults (0.05, 10, k = 1). With
 * G = 1 that is gamma^2 + k^2 = a - 1 + a zeta Z(zeta), zeta = i gamma/(sqrt 2 k vth), a the anisotropy, of the textbooks: 0.0828704.
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
	if (pm_scene_em_world(c, f, length, 32, 1) || pm_scene_em_fields(f, NULL, magnetic, &w) || pm_scene_plasma_set(f, c->n, 3, -share, share, x, v))
		return -PM_DATA;
	return fill(c, length, x[0], v);
}

enum { ALONG = 512, ACROSS = 48, REACH = 6 }; /* velocities of the sums, up to six standard deviations; half of those along x and z, by symmetry */

/* Weights of the velocities vx > 0, and the means of (1 - vy^2)/G and vy^2/G over vy, vz there, c = 1. */
struct sums {
	double vx[ALONG], weight[ALONG], current[ALONG], stress[ALONG];
};

static void add_across(struct sums *s, int i, double vx, double across, double v0)
{
	for (int y = 0; y < ACROSS; y++)
		for (int z = 0; z < ACROSS / 2; z++) {
			const double a = REACH * ((2 * y + 1.0) / ACROSS - 1), b = REACH * (2 * z + 1.0) / ACROSS, vy = v0 + across * a, vz = across * b;
			const double rest = 1 - vx * vx - vy * vy - vz * vz, w = exp(-0.5 * (a * a + b * b));
			if (!(rest > 0)) /* the scene has no such electrons */
				continue;
			s->weight[i] += w;
			s->current[i] += w * (1 - vy * vy) * sqrt(rest);
			s->stress[i] += w * vy * vy * sqrt(rest);
		}
}

static void sum_up(struct sums *s, double vth, double across, double v0)
{
	double total = 0;
	*s = (struct sums){0};
	for (int i = 0; i < ALONG; i++) {
		const double a = REACH * (i + 0.5) / ALONG, w = exp(-0.5 * a * a);
		s->vx[i] = vth * a;
		add_across(s, i, s->vx[i], across, v0);
		s->weight[i] *= w, s->current[i] *= w, s->stress[i] *= w;
		total += s->weight[i];
	}
	for (int i = 0; i < ALONG; i++)
		s->current[i] /= total, s->stress[i] /= total;
}

/* The response at a growth g; both signs of vx together are real. */
static double response(const struct sums *s, double k, double g)
{
	double sum = g * g + k * k;
	for (int i = 0; i < ALONG; i++) {
		const double v2 = s->vx[i] * s->vx[i], q = k * k * v2, r = g * g + q;
		sum += s->current[i] + s->stress[i] * (2 * q / r - k * k * (1 - v2) * (g * g - q) / (r * r));
	}
	return sum;
}

/* The positive root by bisection; NAN: no wave grows. */
static double warm(double k, double vth, double across, double v0)
{
	struct sums s;
	double low = 0, high = 1;
	sum_up(&s, vth, across, v0);
	for (int i = 0; i < 60; i++) {
		const double g = 0.5 * (low + high);
		*(response(&s, k, g) < 0 ? &low : &high) = g;
	}
	return low > 0 ? low : NAN;
}

/* Growth; NAN: none. */
static double rate(double k, double vth, double across, double v)
{
	const double slow = sqrt(1 - v * v), b = k * k + slow * slow * slow;
	return vth > 0 ? warm(k, vth, across, v) : v > 0 ? sqrt(0.5 * (sqrt(b * b + 4 * k * k * v * v * slow) - b)) : NAN;
}

static double exact(const struct pm_frame *f, const char *quantity, double t)
{
	const double length = 2 * pm_pi / pm_frame_parameter(f, "wavenumber", 1), k = 2 * pm_pi / length * pm_frame_parameter(f, "mode", 1);
	const double v = pm_frame_parameter(f, "v0", 0), vth = pm_frame_parameter(f, "vth", 0), across = vth * sqrt(pm_frame_parameter(f, "anisotropy", 1));
	(void)t;
	if (!strcmp(quantity, "mass") || !strcmp(quantity, "charge"))
		return *quantity == 'm' ? length : -length;
	if (!strcmp(quantity, "spread_along"))
		return vth;
	if (!strcmp(quantity, "spread_across")) /* root mean square of y and z, v along y */
		return sqrt(across * across + 0.5 * v * v);
	if (!strcmp(quantity, "gamma"))
		return rate(k, vth, across, v);
	return strcmp(quantity, "omega") || isnan(rate(k, vth, across, v)) ? NAN : 0;
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
