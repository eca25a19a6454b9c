/* Krasny's periodic vortex sheet: one wavelength L of a flat sheet of circulation Gamma per wavelength, as n vortices at
 *   x = s + A L sin(2 pi s/L), y = -A L sin(2 pi s/L), s = i L/n,
 * which the instability of Kelvin and Helmholtz rolls up. Krasny's delta, by which cosh(2 pi y/L) - cos(2 pi x/L) is increased, is the softening
 * delta L/(2^(1/2) pi). Waves of number m of the flat sheet grow at pi Gamma/L^2 (m exp(-m b) (1 - exp(-m b))/sinh b)^(1/2), cosh b = 1 + delta^2
 * (delta 0: pi m Gamma/L^2); in the wave that grows displacements are in the ratio y/x = -(m exp(-m b) sinh b/(1 - exp(-m b)))^(1/2).
 * Source: Krasny 1986, J. Comput. Phys. 65, 292, and J. Fluid Mech. 167, 65; VM-12 of the reference cases. Exact: circulation, gamma (m = 1). Cost n.
 * SPDX-License-Identifier: GPL-3.0-or-later */
#include <string.h>

#include "scene-parts/scene-vortices.h"
#include "scene-parts/scene-vortex-set.h"

enum { GAMMA, WAVELENGTH, DISTURBANCE, SMOOTHING };

static const struct pm_scene_parameter rows[] = {
	{.name = "circulation", .unit = "length^2/time", .otherwise = 1, .low = -1e300, .high = 1e300, .text = "of a wavelength of the sheet"},
	{.name = "wavelength", .unit = "length", .otherwise = 1, .low = 1e-300, .high = 1e300, .text = "the period"},
	{.name = "disturbance", .otherwise = 0.01, .low = -0.5, .high = 0.5, .text = "of the flat sheet, as part of the wavelength"},
	{.name = "smoothing", .otherwise = 0.5, .high = 1e3, .text = "Krasny's delta: softening = smoothing wavelength/(2^(1/2) pi)"},
	{0},
};

static int make(const struct pm_scene_choice *c, struct pm_frame *f)
{
	const double L = c->value[WAVELENGTH], gamma = c->value[GAMMA], n = (double)c->n;
	const double lo[3] = {0, -L / 2, 0}, hi[3] = {L, L / 2, 0};
	const size_t cells[3] = {128, 128, 1};
	struct pm_scene_vortices v;
	if (c->n < 2)
		return pm_fail(PM_USAGE, "a sheet has at least 2 vortices (-n 2)");
	f->dt = 0.01 * L * L / fmax(fabs(gamma), 1e-300);
	pm_frame_constant_set(f, "nu", 0);
	pm_frame_constant_set(f, "softening", c->value[SMOOTHING] * L / (sqrt(2) * pm_pi));
	if (pm_scene_vortex_box(c, f, 2, lo, hi, PM_PERIODIC, cells))
		return -PM_DATA;
	for (int side = 0; side < 2; side++)
		f->face[1][side] = PM_OPEN, f->pface[1][side] = PM_POPEN;
	if (pm_scene_vortices(f, c->n, L * L / n / n, &v))
		return -PM_DATA;
	for (uint64_t i = 0; i < c->n; i++) {
		const double s = (double)i / n, off = c->value[DISTURBANCE] * sin(2 * pm_pi * s);
		v.x[0][i] = L * (s + off < 0 ? s + off + 1 : s + off >= 1 ? s + off - 1 : s + off);
		v.x[1][i] = -L * off;
		v.circulation[i] = gamma / n;
	}
	return 0;
}

static double exact(const struct pm_frame *f, const char *quantity, double t)
{
	const double gamma = pm_frame_parameter(f, "circulation", 1), L = pm_frame_parameter(f, "wavelength", 1), d = pm_frame_parameter(f, "smoothing", 0.5);
	const double b = acosh(1 + d * d);
	(void)t;
	if (!strcmp(quantity, "circulation"))
		return gamma;
	if (!strcmp(quantity, "gamma"))
		return pm_pi * fabs(gamma) / (L * L) * (b > 0 ? sqrt(exp(-b) * -expm1(-b) / sinh(b)) : 1);
	return NAN;
}

const struct pm_scene scene_vortex_sheet = {
	.name = "vortex-sheet",
	.sentence = "a periodic vortex sheet that rolls up",
	.source = "Krasny 1986",
	.dims = 1u << 2,
	.dim = 2,
	.n = 400,
	.parameters = rows,
	.make = make,
	.exact = exact,
};
