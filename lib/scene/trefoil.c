/* A vortex tube tied into a trefoil knot about the z axis, with a Gaussian core: the closed curve
 *   X(s) = ((R + b cos 3s) cos 2s, (R + b cos 3s) sin 2s, b sin 3s)
 * smoothed, omega(x) = Gamma closed integral exp(-|x - X|^2/a^2)/(pi^(3/2) a^3) dX, which has no divergence and near the curve is the tube
 * Gamma/(pi a^2) exp(-r^2/a^2). The strands reconnect, and the knot comes apart into rings.
 * Source: Kida and Takaoka 1987, Phys. Fluids 30, 2911 (the knot); Moffatt 1969, J. Fluid Mech. 35, 117 (its helicity).
 * Exact: totals 0, impulse Gamma/2 closed integral X x dX; helicity and energy, double integrals over the curve with the core 2^(1/2) a, both kept without
 * viscosity. Sums of 384 points: trigonometric, so to round-off where a is beyond their distance. Cost: nodes times 384.
 * SPDX-License-Identifier: GPL-3.0-or-later */
#include <string.h>

#include "scene-parts/scene-space.h"

enum { GAMMA, RADIUS, WINDING, CORE, NU };
enum { POINTS = 384 };

static const struct pm_scene_parameter rows[] = {
	{.name = "circulation", .unit = "length^2/time", .otherwise = 1, .low = -1e300, .high = 1e300, .text = "circulation of the tube"},
	{.name = "radius", .unit = "length", .otherwise = 1, .low = 1e-300, .high = 1e300, .text = "radius R of the circle that the knot winds about"},
	{.name = "winding", .unit = "radius", .otherwise = 0.5, .low = 0.01, .high = 0.9, .text = "distance b of the tube from this circle, over R"},
	{.name = "core", .unit = "radius", .otherwise = 0.15, .low = 0.03, .high = 0.3, .text = "radius a of the core, over R"},
	{.name = "nu", .unit = "length^2/time", .high = 1e300, .text = "kinematic viscosity"},
	{0},
};

/* Point i of the curve, and dX of its share. */
static void curve(double R, double b, int i, double x[3], double dx[3])
{
	const double ds = 2 * pm_pi / POINTS, s = i * ds, r = R + b * cos(3 * s), slope = -3 * b * sin(3 * s);
	x[0] = r * cos(2 * s), x[1] = r * sin(2 * s), x[2] = b * sin(3 * s);
	dx[0] = ds * (slope * cos(2 * s) - 2 * r * sin(2 * s));
	dx[1] = ds * (slope * sin(2 * s) + 2 * r * cos(2 * s)), dx[2] = ds * 3 * b * cos(3 * s);
}

/* The choice with the points of its curve. */
struct knot {
	struct pm_scene_choice choice; /* first: omega() is handed it */
	double at[POINTS][3], dx[POINTS][3];
};

static void omega(const struct pm_scene_choice *c, const double x[3], double w[3])
{
	const struct knot *knot = (const struct knot *)c;
	const double R = c->value[RADIUS], b = c->value[WINDING] * R, a2 = pow(c->value[CORE] * R, 2);
	const double peak = c->value[GAMMA] / (pow(pm_pi, 1.5) * a2 * sqrt(a2));
	w[0] = w[1] = w[2] = 0;
	if (fabs(hypot(hypot(x[0], x[1]) - R, x[2]) - b) > 6 * sqrt(a2)) /* of the torus on which the curve lies */
		return;
	for (int i = 0; i < POINTS; i++) {
		const double *at = knot->at[i], *dx = knot->dx[i];
		const double r2 = (x[0] - at[0]) * (x[0] - at[0]) + (x[1] - at[1]) * (x[1] - at[1]) + (x[2] - at[2]) * (x[2] - at[2]);
		for (int d = 0; d < 3 && r2 < 36 * a2; d++)
			w[d] += peak * exp(-r2 / a2) * dx[d];
	}
}

/* As in vortex-ring: the vorticity ends 4 a beyond the curve, the box 8 a. */
static int make(const struct pm_scene_choice *c, struct pm_frame *f)
{
	const double R = c->value[RADIUS], b = c->value[WINDING] * R, a = c->value[CORE] * R, side = R + b + 8 * a, high = b + 8 * a;
	const double lo[3] = {-side, -side, -high}, hi[3] = {side, side, high}, peak = fabs(c->value[GAMMA]) / (pm_pi * a * a);
	const size_t cells[3] = {64, 64, 40};
	struct knot knot = {.choice = *c};
	for (int i = 0; i < POINTS; i++)
		curve(R, b, i, knot.at[i], knot.dx[i]);
	f->dt = 0.5 / fmax(peak, 1e-300);
	pm_frame_constant_set(f, "nu", c->value[NU]);
	return pm_scene_space(c, f, lo, hi, PM_OPEN, cells) ? -PM_DATA : pm_scene_space_vorticity(f, omega, &knot.choice, 1e-7 * peak);
}

/* Over the curve, of Gamma = 1: the impulse along z; helicity and energy by Biot and Savart's law and the vector potential of a core. */
struct integrals {
	double impulse, helicity, energy;
};
static struct integrals integrals_of(double R, double b, double core)
{
	struct integrals sum = {0};
	for (int i = 0; i < POINTS; i++) {
		double x[3], dx[3], y[3], dy[3];
		curve(R, b, i, x, dx);
		sum.impulse += 0.5 * (x[0] * dx[1] - x[1] * dx[0]);
		for (int j = 0; j < POINTS; j++) {
			curve(R, b, j, y, dy);
			const double z[3] = {x[0] - y[0], x[1] - y[1], x[2] - y[2]}, r = sqrt(z[0] * z[0] + z[1] * z[1] + z[2] * z[2]), s = r / core;
			const double along = dx[0] * dy[0] + dx[1] * dy[1] + dx[2] * dy[2];
			sum.energy += 0.5 * along * (r > 0 ? erf(s) / r : 2 / (sqrt(pm_pi) * core)) / (4 * pm_pi);
			const double twist = dx[0] * (dy[1] * z[2] - dy[2] * z[1]) + /* dX . dY x (X - Y) */
				 dx[1] * (dy[2] * z[0] - dy[0] * z[2]) + dx[2] * (dy[0] * z[1] - dy[1] * z[0]);
			sum.helicity += r > 0 ? twist * (erf(s) - 2 * s * exp(-s * s) / sqrt(pm_pi)) / (4 * pm_pi * r * r * r) : 0;
		}
	}
	return sum;
}

static double exact(const struct pm_frame *f, const char *quantity, double t)
{
	const double gamma = pm_frame_parameter(f, "circulation", 1), R = pm_frame_parameter(f, "radius", 1), a = R * pm_frame_parameter(f, "core", 0.15);
	const double kept = t == 0 || pm_frame_parameter(f, "nu", 0) == 0 ? 1 : NAN;
	static const char *const zero[] = {"alpha_x", "alpha_y", "alpha_z", "impulse_x", "impulse_y", NULL};
	for (int i = 0; zero[i]; i++)
		if (!strcmp(quantity, zero[i]))
			return 0;
	const bool impulse = !strcmp(quantity, "impulse_z"), helicity = !strcmp(quantity, "helicity");
	if (!impulse && !helicity && strcmp(quantity, "energy"))
		return NAN;
	const struct integrals of = integrals_of(R, R * pm_frame_parameter(f, "winding", 0.5), sqrt(2) * a);
	return impulse ? gamma * of.impulse : gamma * gamma * kept * (helicity ? of.helicity : of.energy);
}

const struct pm_scene scene_trefoil = {
	.name = "trefoil",
	.sentence = "a vortex tube tied into a trefoil knot",
	.source = "Kida and Takaoka 1987",
	.dims = 1u << 3,
	.dim = 3,
	.n_fixed = true,
	.shared = true,
	.parameters = rows,
	.make = make,
	.exact = exact,
};
