/* A cold plasma oscillation: electrons at rest on a lattice, displaced by x = q + (A/k) sin(k q), before immobile ions; omega_p = 1.
 * Until sheets cross (A < 1: never) each electron swings about its own place, x = q + (A/k) sin(k q) cos t, for any A (Dawson 1959). On a mesh with
 * cic and the 3-point Laplacian the frequency is cos(k dx/2), with the leapfrog sin(omega dt/2) = (dt/2) cos(k dx/2).
 * Source: Dawson 1959, Phys. Rev. 113, 383; Birdsall and Langdon 1985, chapter 4; PIC-06, PIC-07, PIC-16 of the reference cases.
 * Exact: mass, charge, kA, speed_rms, energy_kinetic. Cost N.
 * SPDX-License-Identifier: GPL-3.0-or-later */
#include "scene/plasma.h"

enum { AMPLITUDE, MODE, WAVENUMBER, VELOCITIES };

static const struct pm_scene_parameter rows[] = {
	{"amplitude", "", 0.05, 0, 0.999, "k A at the start"},
	{"mode", "", 1, 1, 1e6, "waves in the box"},
	{"wavenumber", "1/length", 1, 1e-300, 1e300, "k of mode 1; the box is 2 pi/k long"},
	{"velocities", "", 1, 1, 3, "components of v"},
	{0},
};

static int make(const struct pm_scene_choice *c, struct pm_frame *f)
{
	const double length = 2 * pm_pi / c->value[WAVENUMBER], k = c->value[WAVENUMBER] * c->value[MODE], n = (double)c->n, share = c->n ? length / n : 0;
	double *x[3], *v[3];
	if (scene_plasma_whole(c->value[MODE], c->value[VELOCITIES], 1))
		return -PM_USAGE;
	scene_plasma_world(f, length, 1, 0.1);
	if (scene_mesh(f, 64) || scene_plasma_set(f, c->n, (int)c->value[VELOCITIES], -share, share, x, v))
		return -PM_DATA;
	for (uint64_t i = 0; i < c->n; i++) {
		const double q = ((double)i + 0.5) / n * length;
		x[0][i] = scene_plasma_fold(q + c->value[AMPLITUDE] / k * sin(k * q), length);
	}
	return 0;
}

static double exact(const struct pm_frame *f, const char *quantity, double t)
{
	const double k1 = pm_frame_parameter(f, "wavenumber", 1), k = k1 * pm_frame_parameter(f, "mode", 1), length = 2 * pm_pi / k1;
	const double a = pm_frame_parameter(f, "amplitude", 0.05), speed = a / k * fabs(sin(t)) / sqrt(2);
	if (!strcmp(quantity, "mass"))
		return length;
	if (!strcmp(quantity, "charge"))
		return -length;
	if (!strcmp(quantity, "kA"))
		return a * cos(t);
	if (!strcmp(quantity, "speed_rms"))
		return speed;
	if (!strcmp(quantity, "energy_kinetic"))
		return 0.5 * length * speed * speed;
	return NAN;
}

const struct pm_scene scene_langmuir = {
	.name = "langmuir",
	.sentence = "a cold plasma that oscillates at omega_p = 1",
	.source = "Dawson 1959, Phys. Rev. 113, 383",
	.dims = 1u << 1,
	.dim = 1,
	.n = 4096,
	.parameters = rows,
	.make = make,
	.exact = exact,
};
