/* A whistler: the right wave of light below the gyration frequency, along x and a uniform magnetic field B_x = B, in electrons at rest or (--vth) Maxwellian;
 * ions are a background; omega_p = c = 1. With F = E_y + i E_z = A exp(i(omega t - k x)) the cold wave is
 *     B_y + i B_z = i (k/omega) F,  v_y + i v_z = i F/(omega - B),  omega^2 - k^2 = omega/(omega - B),  0 < omega < B
 * and --vth adds velocities of Hammersley's points, in groups of four at one place: both signs of vx and of (vy, vz). omega is then that of the warm wave,
 * which is damped near B. The wave is small where A/(B - omega) is well below 1.
 * Source: Stix 1992, sections 2-3 and 10-4; Birdsall and Langdon 1985, section 15-4. Exact: mass, charge, omega, gamma. Cost N.
 * SPDX-License-Identifier: GPL-3.0-or-later */
#include <string.h>

#include "plasma/magnetised.h"
#include "scene-parts/scene-electromagnetic.h"
#include "scene-parts/scene-loading.h"

enum { MAGNETIC, FIELD, WAVENUMBER, MODE, VTH };

static const struct pm_scene_parameter rows[] = {
	{.name = "magnetic-field", .otherwise = 1, .low = 1e-300, .high = 1e300, .text = "B along z (of whistler, x); the gyration frequency"},
	{.name = "wave-field", .otherwise = 1e-3, .low = -1e300, .high = 1e300, .text = "largest E of the wave (of weibel, B)"},
	{.name = "wavenumber", .unit = "1/length", .otherwise = 1, .low = 1e-300, .high = 1e300, .text = "k of mode 1; the box is 2 pi/k long"},
	{.name = "mode", .otherwise = 1, .low = 1, .high = 1e6, .text = "waves in the box"},
	{.name = "vth", .unit = "length/time", .high = 1, .text = "thermal speed, the standard deviation of the velocity"},
	{0},
};

struct whistler {
	double k, field, amplitude, omega;
};

/* The root of w^3 - B w^2 - (k^2 + 1) w + k^2 B between 0 and B, where its sign changes: k^2 B at 0, -B at B. */
static double cold(double k, double field)
{
	double low = 0, high = field;
	for (int i = 0; i < 200; i++) {
		const double w = 0.5 * (low + high);
		if ((w * w - k * k) * (w - field) > w)
			low = w;
		else
			high = w;
	}
	return 0.5 * (low + high);
}

/* The warm root that the cold one becomes as the electrons are heated. */
static double complex warm(double k, double field, double vth)
{
	enum { steps = 40 };
	double complex root = cold(k, field);
	for (int i = 1; i <= steps && vth > 0 && !isnan(creal(root)); i++) {
		const struct pm_gyrating s = {1, 0, vth * i / steps, -field, 1};
		root = pm_light_root(&(struct pm_light_case){PM_RIGHT, &s, 1, k, 1}, root);
	}
	return root;
}

static double electric(int c, const double x[3], const void *data)
{
	const struct whistler *w = data;
	return c == 1 ? w->amplitude * cos(w->k * x[0]) : c == 2 ? -w->amplitude * sin(w->k * x[0]) : 0;
}

static double magnetic(int c, const double x[3], const void *data)
{
	const struct whistler *w = data;
	const double most = w->amplitude * w->k / w->omega;
	return c == 1 ? most * sin(w->k * x[0]) : c == 2 ? most * cos(w->k * x[0]) : w->field;
}

static int fill(const struct pm_scene_choice *c, const struct whistler *w, double length, double *x, double *const v[3])
{
	const uint64_t groups = (c->n + 3) / 4;
	const double vth = c->value[VTH], most = w->amplitude / (w->omega - w->field);
	double *room = pm_alloc(4 * groups + 1, sizeof *room);
	double *const u[PM_LOAD_AXES] = {room, room + groups, room + 2 * groups, room + 3 * groups};
	int status = room ? pm_scene_points(PM_BIT_REVERSED, c->seed, groups, 4, u) : -PM_DATA;
	for (uint64_t i = 0; i < c->n && !status; i++) {
		const uint64_t g = i / 4;
		const double along = i & 1 ? -vth : vth, over = i & 2 ? -vth : vth;
		x[i] = vth > 0 ? pm_scene_fold(u[3][g] * length, length) : ((double)i + 0.5) / (double)c->n * length;
		v[0][i] = along * pm_scene_normal_of(u[0][g]);
		v[1][i] = most * sin(w->k * x[i]) + over * pm_scene_normal_of(u[1][g]);
		v[2][i] = most * cos(w->k * x[i]) + over * pm_scene_normal_of(u[2][g]);
		if (!(v[0][i] * v[0][i] + v[1][i] * v[1][i] + v[2][i] * v[2][i] < 1))
			status = pm_fail(PM_USAGE, "electron %llu would be faster than light (a smaller --vth or --wave-field)", (unsigned long long)i);
	}
	pm_free(room);
	return status;
}

static int make(const struct pm_scene_choice *c, struct pm_frame *f)
{
	const double length = 2 * pm_pi / c->value[WAVENUMBER], share = c->n ? length / (double)c->n : 0;
	struct whistler w = {.k = c->value[WAVENUMBER] * c->value[MODE], .field = c->value[MAGNETIC], .amplitude = c->value[FIELD]};
	double *x[3], *v[3];
	w.omega = cold(w.k, w.field);
	if (pm_scene_plasma_whole(c->value[MODE], 3, 1))
		return -PM_USAGE;
	if (c->value[VTH] > 0 && c->n % 4)
		return pm_fail(PM_USAGE, "%llu electrons do not make groups of four (take a -n that 4 divides)", (unsigned long long)c->n);
	if (pm_scene_em_world(c, f, length, 64, 1) || pm_scene_em_fields(f, electric, magnetic, &w) ||
		pm_scene_plasma_set(f, c->n, 3, -share, share, x, v))
		return -PM_DATA;
	f->dt = fmin(f->dt, 0.1 / w.field);
	return fill(c, &w, length, x[0], v);
}

static double exact(const struct pm_frame *f, const char *quantity, double t)
{
	const double k1 = pm_frame_parameter(f, "wavenumber", 1), k = k1 * pm_frame_parameter(f, "mode", 1);
	const double field = pm_frame_parameter(f, "magnetic-field", 1);
	(void)t;
	if (!strcmp(quantity, "mass") || !strcmp(quantity, "charge"))
		return (*quantity == 'm' ? 2 : -2) * pm_pi / k1;
	if (!strcmp(quantity, "field_along"))
		return field;
	if (!strcmp(quantity, "spread_along") || !strcmp(quantity, "spread_across"))
		return pm_frame_parameter(f, "vth", 0);
	if (strcmp(quantity, "omega") && strcmp(quantity, "gamma"))
		return NAN;
	const double complex root = warm(k, field, pm_frame_parameter(f, "vth", 0));
	return *quantity == 'o' ? creal(root) : cimag(root);
}

const struct pm_scene scene_whistler = {
	.name = "whistler",
	.sentence = "light that turns with the electrons, along a magnetic field",
	.source = "Stix 1992, 2-3",
	.dims = 1u << 1,
	.dim = 1,
	.n = 4096,
	.parameters = rows,
	.make = make,
	.exact = exact,
};
