/* A short pulse of light in a box that is to move with it, in units of c and omega_p: fields of
 *     A_z = a0 exp(-xi^2/(2 L^2) - y^2/w^2) cos(k xi),   xi = x - x0 - t,   E_z = -dA_z/dt, B = curl A
 * (linear polarisation, out of the plane), x0 at 5 L behind the front. The plasma comes in with the word window, electrons of density 1 by default; ions do not
 * move. Behind a pulse with a0 << 1 the plasma oscillates, E_x = E sin(k_p (x - v t)), with
 *     E = sqrt(pi)/4 a0^2 L exp(-L^2/4),   k_p = omega_p/v,   v = sqrt(1 - 1/k^2): the velocity of the group,
 * in the plane where a0 is that of y, by (d^2/dxi^2 + 1) phi = <a^2>/2, of which the source is local (long pulses of a narrow beam spread).
 * Source: Gorbunov and Kirsanov 1987, Sov. Phys. JETP 66, 290; Esarey, Schroeder and Leemans 2009, Rev. Mod. Phys. 81, 1229, sections II and III.
 * Exact: mass, charge, energy at t = 0. SPDX-License-Identifier: GPL-3.0-or-later */
#include <stdio.h>
#include <string.h>

#include "scene-parts/scene-electromagnetic.h"
#include "stream/declare.h"

enum { A0, WAVENUMBER, PULSE, WAIST, LENGTH };

static const struct pm_scene_parameter rows[] = {
	{.name = "a0", .otherwise = 0.1, .low = 0, .high = 1e3, .text = "amplitude of the pulse, e A/(m c)"},
	{.name = "wavenumber", .unit = "omega_p/c", .otherwise = 10, .low = 1.5, .high = 1e6, .text = "wave number of the light"},
	{.name = "pulse", .unit = "c/omega_p", .otherwise = 1, .low = 1e-3, .high = 1e6, .text = "length L of the pulse exp(-xi^2/(2 L^2))"},
	{.name = "waist", .unit = "c/omega_p", .otherwise = 5, .low = 1e-3, .high = 1e6, .text = "half width w of the beam exp(-y^2/w^2) in the plane"},
	{.name = "length", .unit = "c/omega_p", .otherwise = 24, .low = 1e-3, .high = 1e6, .text = "of the box"},
	{0},
};

struct pulse {
	double a0, k, L, w, x0;
	bool plane;
};

/* a0 exp(...) (cos, sin) of the place. */
static void at(const struct pulse *p, const double x[3], double *c, double *s, double *xi)
{
	*xi = x[0] - p->x0;
	const double y = p->plane ? x[1] / p->w : 0, envelope = p->a0 * exp(-0.5 * (*xi / p->L) * (*xi / p->L) - y * y);
	*c = envelope * cos(p->k * *xi);
	*s = envelope * sin(p->k * *xi);
}

/* dA/dx. */
static double along(const struct pulse *p, const double x[3])
{
	double c, s, xi;
	at(p, x, &c, &s, &xi);
	return -xi / (p->L * p->L) * c - p->k * s;
}

static double electric(int component, const double x[3], const void *data) { return component == 2 ? along(data, x) : 0; }

static double magnetic(int component, const double x[3], const void *data)
{
	const struct pulse *p = data;
	double c, s, xi;
	if (component == 1)
		return -along(p, x);
	at(p, x, &c, &s, &xi);
	return component == 0 && p->plane ? -2 * x[1] / (p->w * p->w) * c : 0;
}

static int make(const struct pm_scene_choice *c, struct pm_frame *f)
{
	const struct pulse p = {.a0 = c->value[A0], .k = c->value[WAVENUMBER], .L = c->value[PULSE], .w = c->value[WAIST],
		.x0 = c->value[LENGTH] - 5 * c->value[PULSE], .plane = c->dim == 2};
	double *x[3], *v[3], inverse = 0;
	if (c->n)
		return pm_fail(PM_USAGE, "the scene wakefield begins empty (without -n; window lets the plasma in)");
	if (!(p.x0 > 5 * p.L))
		return pm_fail(PM_USAGE, "the pulse of length %g does not fit the box of length %g (--length above 10 times --pulse)", p.L, c->value[LENGTH]);
	/* 32 cells a wave along, 8 of the waist across */
	size_t cells[3] = {(size_t)ceil(32 * c->value[LENGTH] * p.k / (2 * pm_pi)), 32, 1};
	pm_scene_plasma_world(f, c->value[LENGTH], 1, 0);
	snprintf(f->law, sizeof f->law, "electromagnetic");
	pm_frame_constant_set(f, "c", 1);
	f->face[0][0] = f->face[0][1] = PM_OPEN;
	f->pface[0][0] = f->pface[0][1] = PM_PABSORB;
	if (p.plane)
		f->lo[1] = -2 * p.w, f->hi[1] = 2 * p.w;
	for (int d = 0; d < f->dim; d++) {
		const double h = (f->hi[d] - f->lo[d]) / (double)(cells[d] = c->cells[0] ? c->cells[d] : cells[d]);
		inverse += 1 / (h * h);
	}
	f->dt = 0.98 / sqrt(inverse); /* near the limit, where waves along x have the least dispersion */
	return !pm_frame_mesh_new(f, "mesh", cells) || pm_scene_em_fields(f, electric, magnetic, &p) || pm_scene_plasma_set(f, 0, 3, 0, 0, x, v) ? -PM_DATA : 0;
}

static double exact(const struct pm_frame *f, const char *quantity, double t)
{
	const double a0 = pm_frame_parameter(f, "a0", 0.1), k = pm_frame_parameter(f, "wavenumber", 10), L = pm_frame_parameter(f, "pulse", 1);
	const double w = f->dim == 2 ? pm_frame_parameter(f, "waist", 5) : HUGE_VAL, across = f->dim == 2 ? w * sqrt(pm_pi / 2) : 1;
	if (!strcmp(quantity, "wake_field"))
		return sqrt(pm_pi) / 4 * a0 * a0 * L * exp(-L * L / 4);
	if (!strcmp(quantity, "wake_length"))
		return 2 * pm_pi * sqrt(1 - 1 / (k * k));
	if (t > 0)
		return NAN;
	if (!strcmp(quantity, "energy_field_mesh")) /* but for terms of exp(-k^2 L^2) */
		return 0.5 * sqrt(pm_pi) * a0 * a0 * L * across * (k * k + 0.5 / (L * L) + 0.5 / (w * w));
	return !strcmp(quantity, "mass") || !strcmp(quantity, "charge") ? 0 : NAN;
}

const struct pm_scene scene_wakefield = {
	.name = "wakefield",
	.sentence = "a short pulse of light; with the word window it goes through a plasma and leaves a wake",
	.source = "Esarey, Schroeder and Leemans 2009",
	.dims = 1u << 1 | 1u << 2,
	.dim = 1,
	.parameters = rows,
	.make = make,
	.exact = exact,
};
