/* A cold plasma oscillation: electrons at rest on a lattice (or as --loading says), displaced by x = q + (A/k) sin(k q), before immobile ions; omega_p = 1.
 * Until sheets cross (A < 1: never) each electron oscillates about its own position, x = q + (A/k) sin(k q) cos t, for any A (Dawson 1959). On a mesh with
 * cic and the 3-point Laplacian the frequency is cos(k dx/2), with the leapfrog sin(omega dt/2) = (dt/2) cos(k dx/2). In 2-D and 3-D the box is a square
 * or a cube, and the wave runs along x or, with --axes, along a diagonal.
 * Source: Dawson 1959, Phys. Rev. 113, 383; Birdsall and Langdon 1985, chapter 4; PIC-06, PIC-07, PIC-16 of the reference cases.
 * Exact: mass, charge, kA, speed_rms, energy_kinetic. Cost N.
 * SPDX-License-Identifier: GPL-3.0-or-later */
#include <string.h>

#include "scene-parts/scene-loading.h"
#include "scene-parts/scene-plasma.h"

enum { AMPLITUDE, MODE, WAVENUMBER, VELOCITIES, AXES };

static const struct pm_scene_parameter rows[] = {
	{.name = "amplitude", .otherwise = 0.05, .high = 0.999, .text = "k A at the start"},
	{.name = "mode", .otherwise = 1, .low = 1, .high = 1e6, .text = "waves in the box, along each axis that the wave vector has"},
	{.name = "wavenumber", .unit = "1/length", .otherwise = 1, .low = 1e-300, .high = 1e300, .text = "k of mode 1; the box is 2 pi/k long"},
	{.name = "velocities", .otherwise = 1, .low = 1, .high = 3, .text = "components of v (as many as dimensions at least)"},
	{.name = "axes", .otherwise = 1, .low = 1, .high = 3, .text = "of the wave vector: 1 along x, 2 and 3 along the diagonals"},
	{0},
};

/* |k| of the wave. */
static double wavenumber(double k1, double mode, double axes) { return k1 * mode * sqrt(axes); }

static int make(const struct pm_scene_choice *c, struct pm_frame *f)
{
	const double length = 2 * pm_pi / c->value[WAVENUMBER], k1 = c->value[WAVENUMBER] * c->value[MODE], axes = c->value[AXES];
	const bool lattice = c->loading == PM_LATTICE;
	const size_t cells[] = {64, 32, 16}, side = c->n && lattice ? pm_scene_per_axis(c->n, f->dim) : 1;
	const double share = !c->n ? 0 : lattice ? pow(length / (double)side, f->dim) : pow(length, f->dim) / (double)c->n;
	const double swing = c->value[AMPLITUDE] / (k1 * axes);
	double *x[3], *v[3];
	if (!side || pm_scene_plasma_whole(c->value[MODE], c->value[VELOCITIES], 1))
		return -PM_USAGE;
	if (axes != floor(axes) || axes > f->dim)
		return pm_fail(PM_USAGE, "--axes %g is not a number of axes from 1 to %d", axes, f->dim);
	pm_scene_plasma_world(f, length, 1, 0.1);
	if (pm_scene_mesh(f, cells[f->dim - 1]) || pm_scene_plasma_set(f, c->n, (int)c->value[VELOCITIES], -share, share, x, v))
		return -PM_DATA;
	if (!lattice && pm_scene_points(c->loading, c->seed, c->n, f->dim, (double *const[PM_LOAD_AXES]){x[0], x[1], x[2]}))
		return -PM_DATA;
	for (uint64_t i = 0; i < c->n; i++) {
		const size_t at[3] = {i % side, i / side % side, i / side / side};
		double q[3], phase = 0;
		for (int d = 0; d < f->dim; d++) {
			q[d] = lattice ? ((double)at[d] + 0.5) / (double)side * length : x[d][i] * length;
			phase += d < axes ? k1 * q[d] : 0;
		}
		for (int d = 0; d < f->dim; d++)
			x[d][i] = pm_scene_fold(d < axes ? q[d] + swing * sin(phase) : q[d], length);
	}
	return 0;
}

static double exact(const struct pm_frame *f, const char *quantity, double t)
{
	const double k1 = pm_frame_parameter(f, "wavenumber", 1), volume = pow(2 * pm_pi / k1, f->dim);
	const double k = wavenumber(k1, pm_frame_parameter(f, "mode", 1), pm_frame_parameter(f, "axes", 1));
	const double a = pm_frame_parameter(f, "amplitude", 0.05), speed = a / k * fabs(sin(t)) / sqrt(2);
	if (!strcmp(quantity, "mass"))
		return volume;
	if (!strcmp(quantity, "charge"))
		return -volume;
	if (!strcmp(quantity, "kA"))
		return a * cos(t);
	if (!strcmp(quantity, "speed_rms"))
		return speed;
	if (!strcmp(quantity, "energy_kinetic"))
		return 0.5 * volume * speed * speed;
	return NAN;
}

const struct pm_scene scene_langmuir = {
	.name = "langmuir",
	.sentence = "a cold plasma that oscillates at omega_p = 1",
	.source = "Dawson 1959, Phys. Rev. 113, 383",
	.dims = 1u << 1 | 1u << 2 | 1u << 3,
	.dim = 1,
	.n = 4096,
	.loads = true,
	.parameters = rows,
	.make = make,
	.exact = exact,
};
