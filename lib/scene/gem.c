/* Magnetic reconnection: Harris's current sheet with the perturbation of the GEM challenge, electrons and ions, in the plane; d_i = sqrt(m_i/m_e) is the
 * inertial length of the ions, and c = 1, omega_p = 1 of the electrons in the middle of the sheet. The box is 25.6 d_i by 12.8 d_i, periodic along x, with
 * conductors at +-y that reflect particles. A_z = B0 (d ln cosh(y/d) + psi0 cos(2 pi x/L_x) cos(pi y/L_y)), d = d_i/2, B = curl A by the differences of the
 * mesh (div B = 0 to round-off), and E = 0, since ions and electrons begin at the same places:
 *     B_x = B0 tanh(y/d),   n = 1/cosh^2(y/d) + 0.2,   B0^2/2 = T_e + T_i,   u_z = -2 T/(q B0 d) of the sheet, 0 of the 0.2
 * Each species keeps its balance, q u_z B_x n = T dn/dy. psi0 > 0 puts an X point in the middle and an O point at the ends.
 * Source: Harris 1962 (Nuovo Cimento 23, 115); Birn et al. 2001 (J. Geophys. Res. 106, 3715), psi of either sign. Exact: mass, charge, at psi0 = 0
 * energy_magnetic. Cost N. SPDX-License-Identifier: GPL-3.0-or-later */
#include <stdio.h>
#include <string.h>

#include "scene-parts/scene-electromagnetic.h"
#include "scene-parts/scene-loading.h"
#include "stream/declare.h"

enum { MASS, TEMPERATURE, ALFVEN, PSI };

static const double rest = 0.2; /* density of the plasma that does not drift */

static const struct pm_scene_parameter rows[] = {
	{.name = "mass-ratio", .otherwise = 25, .low = 1, .high = 1e9, .text = "mass of an ion over that of an electron"},
	{.name = "ion-temperature", .otherwise = 5, .low = 1e-6, .high = 1e6, .text = "temperature of the ions over that of the electrons"},
	{.name = "alfven-speed", .unit = "length/time", .otherwise = 0.1, .low = 1e-6, .high = 0.5, .text = "B0/sqrt(m_i/m_e), in units of c"},
	{.name = "perturbation", .otherwise = 0.1, .low = -10, .high = 10, .text = "psi0 in units of d_i; 0: the sheet alone"},
	{0},
};

struct sheet {
	double b0, d, psi, lx, ly, h[2];
	double t[2], u[2], mass; /* electrons, ions; of an ion */
};

static struct sheet sheet_of(double mass, double temperature, double alfven, double psi)
{
	const double di = sqrt(mass), b0 = alfven * di, pressure = 0.5 * b0 * b0, d = 0.5 * di;
	struct sheet s = {.b0 = b0, .d = d, .psi = psi * di, .lx = 25.6 * di, .ly = 12.8 * di, .mass = mass};
	for (int i = 0; i < 2; i++) {
		s.t[i] = pressure * (i ? temperature : 1) / (1 + temperature);
		s.u[i] = (i ? -2 : 2) * s.t[i] / (b0 * d);
	}
	return s;
}

static double sheet_number(const struct sheet *s) { return 2 * s->d * tanh(0.5 * s->ly / s->d) * s->lx; }

static double whole_number(const struct sheet *s) { return sheet_number(s) + rest * s->lx * s->ly; }

static double potential(const struct sheet *s, double x, double y)
{
	const double a = fabs(y) / s->d;
	return s->b0 * (s->d * (a + log1p(exp(-2 * a))) + s->psi * cos(2 * pm_pi * x / s->lx) * cos(pm_pi * y / s->ly));
}

static double magnetic(int c, const double x[3], const void *data)
{
	const struct sheet *s = data;
	const double a = 0.5 * s->h[0], b = 0.5 * s->h[1];
	if (c == 2)
		return 0;
	return c ? (potential(s, x[0] - a, x[1]) - potential(s, x[0] + a, x[1])) / s->h[0]
		: (potential(s, x[0], x[1] + b) - potential(s, x[0], x[1] - b)) / s->h[1];
}

static int world(const struct pm_scene_choice *c, struct pm_frame *f, struct sheet *s)
{
	const size_t cells[3] = {c->cells[0] ? c->cells[0] : 128, c->cells[0] ? c->cells[1] : 64, 1};
	pm_scene_plasma_world(f, s->lx, 0, 0);
	snprintf(f->law, sizeof f->law, "electromagnetic");
	pm_frame_constant_set(f, "c", 1);
	f->lo[0] = -0.5 * s->lx, f->hi[0] = 0.5 * s->lx;
	f->lo[1] = -0.5 * s->ly, f->hi[1] = 0.5 * s->ly;
	for (int side = 0; side < 2; side++)
		f->face[1][side] = PM_WALL, f->pface[1][side] = PM_PREFLECT;
	s->h[0] = s->lx / (double)cells[0], s->h[1] = s->ly / (double)cells[1];
	f->dt = 0.5 * fmin(s->h[0], s->h[1]);
	return pm_frame_mesh_new(f, "mesh", cells) ? 0 : -PM_DATA;
}

/* The set "ions" at the places of the electrons. */
static int ions(struct pm_frame *f, uint64_t n, double share, const struct sheet *s, struct pm_scene_body *b)
{
	struct pm_field *q, *v;
	if (pm_scene_set(f, "ions", n, true, share * s->mass, b) || !(q = pm_makes(f, "ions", "charge", 1, PM_STATE)) ||
		!(v = pm_makes(f, "ions", "v", 3, PM_STATE)) || pm_field_ready(v))
		return -PM_DATA;
	snprintf(q->unit, sizeof q->unit, "charge");
	snprintf(v->unit, sizeof v->unit, "length/time");
	q->extensive = q->uniform = true;
	q->value[0] = share;
	for (int c = 0; c < 3; c++)
		b->v[c] = pm_out(v, c);
	return 0;
}

/* Particles of both species, the first `drifting` of them the sheet's; along x and y neither species has momentum. */
static int load(const struct pm_scene_choice *c, const struct sheet *s, double *const x[2][3], double *const v[2][3])
{
	const uint64_t drifting = (uint64_t)(sheet_number(s) / whole_number(s) * (double)c->n + 0.5);
	double *room = pm_alloc(PM_LOAD_AXES * c->n + 1, sizeof *room), *u[PM_LOAD_AXES];
	for (int a = 0; a < PM_LOAD_AXES; a++)
		u[a] = room + (uint64_t)a * c->n;
	int status = room ? pm_scene_points(PM_RANDOM, c->seed, c->n, PM_LOAD_AXES, u) : -PM_DATA;
	for (uint64_t i = 0; i < 2 * c->n && !status; i++) {
		const uint64_t p = i / 2;
		const int k = i & 1;
		const double w = 2 * u[7][p] - 1, vth = sqrt(s->t[k] / (k ? s->mass : 1));
		double square = 0;
		x[k][0][p] = s->lx * (u[6][p] - 0.5);
		x[k][1][p] = p < drifting ? s->d * atanh(w * tanh(0.5 * s->ly / s->d)) : 0.5 * s->ly * w;
		for (int a = 0; a < 3; a++) {
			v[k][a][p] = vth * pm_scene_normal_of(u[3 * k + a][p]) + (p < drifting && a == 2 ? s->u[k] : 0);
			square += v[k][a][p] * v[k][a][p];
		}
		if (!(square < 1))
			status = pm_fail(PM_USAGE, "particle %llu would be faster than light (a smaller --alfven-speed)", (unsigned long long)p);
	}
	for (int i = 0; i < 4 && !status; i++)
		pm_scene_centre(c->n, NULL, v[i / 2][i % 2]);
	pm_free(room);
	return status;
}

static int make(const struct pm_scene_choice *c, struct pm_frame *f)
{
	struct sheet s = sheet_of(c->value[MASS], c->value[TEMPERATURE], c->value[ALFVEN], c->value[PSI]);
	struct pm_scene_body b;
	double *x[2][3], *v[2][3];
	const double share = c->n ? whole_number(&s) / (double)c->n : 0;
	if (world(c, f, &s) || pm_scene_em_fields(f, NULL, magnetic, &s) || pm_scene_plasma_set(f, c->n, 3, -share, share, x[0], v[0]) ||
		ions(f, c->n, share, &s, &b))
		return -PM_DATA;
	memcpy(x[1], b.x, sizeof x[1]);
	memcpy(v[1], b.v, sizeof v[1]);
	return load(c, &s, x, v);
}

static double exact(const struct pm_frame *f, const char *quantity, double t)
{
	const double mass = pm_frame_parameter(f, "mass-ratio", 25), psi = pm_frame_parameter(f, "perturbation", 0.1);
	const struct sheet s = sheet_of(mass, pm_frame_parameter(f, "ion-temperature", 5), pm_frame_parameter(f, "alfven-speed", 0.1), psi);
	(void)t;
	if (!strcmp(quantity, "mass"))
		return whole_number(&s) * (1 + mass);
	if (!strcmp(quantity, "charge"))
		return 0;
	return !strcmp(quantity, "energy_magnetic") && psi == 0 ? 0.5 * s.b0 * s.b0 * s.lx * (s.ly - 2 * s.d * tanh(0.5 * s.ly / s.d)) : NAN;
}

const struct pm_scene scene_gem = {
	.name = "gem",
	.sentence = "reconnection of magnetic fields: a current sheet of electrons and ions, perturbed",
	.source = "Birn et al. 2001",
	.dims = 1u << 2,
	.dim = 2,
	.n = 65536,
	.random = true,
	.parameters = rows,
	.make = make,
	.exact = exact,
};
