/* Integrals of vortices in space. Of the particles: total alpha = sum alpha, impulse 1/2 sum x x alpha, angular impulse 1/3 sum x x (x x alpha); of a ring in
 * open space its circulation, radius and position. Of omega on the first mesh that holds it: enstrophy 1/2 int omega^2, dissipation 2 nu times that,
 * Kolmogorov's scales, the largest |omega|, divergence = max |div omega| h/max |omega| (differences of order 6, h the largest spacing). With the velocity
 * there (or its potential, law-field.c): energy 1/2 int u^2, helicity int u . omega. The other formula of the energy, 1/2 int psi . omega, is that of every
 * law (measure-frame.c).
 * A ring: its axis n is the direction of the impulse I; position = sum (x . n) w/sum w, w = 1/2 (x x alpha) . n; circulation 1/(2 pi) sum alpha_phi/r
 * about the axis through the centre of |alpha|; radius sqrt(|I|/(pi circulation)). Its wave m: amplitude of the core's displacement from the axis,
 * 2 sum W r exp(-i m phi)/sum W, W = alpha_phi/r: a where the core is at r = R + a cos(m phi).
 * Waves of a tube along the only periodic axis n, of length L, with X and Y across it: 2 sum alpha_n (X + i Y) exp(-2 pi i m n/L)/sum alpha_n: a exp(i theta)
 * where the axis is displaced by a cos(2 pi m n/L) in the plane at theta; its phase turns with that plane.
 * Its speed, from the velocities of its particles (the change vel): the rate of position, with dw/dt = 2 w u_r/r, since alpha_phi goes as r when circulation
 * is kept: sum of w (u . n + 2 (x . n - position) u_r/r) over sum w. So it is of rings round the axis without swirl (Helmholtz 1858; Saffman 1992, 10.2).
 * Missing quantities are NAN. Sums are compensated and serial, so that threads do not matter. Cost N and points of the mesh.
 * Source: Saffman 1992, sections 3.2 to 3.9 and 10.2. SPDX-License-Identifier: GPL-3.0-or-later */
#include <string.h>

#include "measure/law-field.h"
#include "mesh/gradient-parts.h"
#include "stream/declare.h"
#include "stream/over-stretches.h"
#include "world/world.h"

static bool counts(const struct pm_measure *how, const struct pm_frame *f, const struct pm_set *set)
{
	const struct pm_field *x = pm_frame_field(f, set->name, "x"), *q = pm_frame_field(f, set->name, how->strength);
	return (!how->set || !strcmp(how->set, set->name)) && q && q->components == 3 && x && x->components == 3;
}

void pm_vortex_space_reads(const struct pm_measure *how, struct pm_frame *f)
{
	if (!how->vortices || !how->vector)
		return;
	pm_law_field_reads(how, f);
	for (size_t i = 0; i < f->nsets; i++)
		if (counts(how, f, f->sets[i]) && pm_frame_field(f, f->sets[i]->name, "vel"))
			pm_reads(f, f->sets[i]->name, "vel");
}

static void cross(const double a[3], const double b[3], double c[3])
{
	for (int d = 0; d < 3; d++)
		c[d] = a[(d + 1) % 3] * b[(d + 2) % 3] - a[(d + 2) % 3] * b[(d + 1) % 3];
}

static double length(const double a[3]) { return sqrt(a[0] * a[0] + a[1] * a[1] + a[2] * a[2]); }

/* x and alpha of a particle, about an origin. */
static void particle(const struct pm_field *at, const struct pm_field *strength, const double origin[3], size_t i, double x[3], double alpha[3])
{
	for (int d = 0; d < 3; d++)
		x[d] = pm_in(at, d)[i] - origin[d], alpha[d] = pm_in(strength, d)[i];
}

struct sums {
	struct pm_sum alpha[3], impulse[3], angular[3], centre[3], size;
};

struct vortices {
	const struct pm_field *at, *strength, *vel; /* vel: of a ring; NULL: none */
	const double *centre, *axis; /* of a ring */
	const double *from, *quarter; /* unit vectors across the axis: phi = 0 and a quarter of a turn on */
	int mode;                    /* waves around it, or along a tube */
	int along;                   /* axis of a tube */
	double period;
};

static void make_sums(const void *data, size_t from, size_t to, void *part)
{
	const struct vortices *v = data;
	const double origin[3] = {0};
	struct sums *s = part;
	for (size_t i = from; i < to; i++) {
		double x[3], alpha[3], turn[3], twice[3];
		particle(v->at, v->strength, origin, i, x, alpha);
		cross(x, alpha, turn);
		cross(x, turn, twice);
		for (int d = 0; d < 3; d++) {
			pm_sum_add(&s->alpha[d], alpha[d]);
			pm_sum_add(&s->impulse[d], 0.5 * turn[d]);
			pm_sum_add(&s->angular[d], twice[d] / 3);
			pm_sum_add(&s->centre[d], length(alpha) * x[d]);
		}
		pm_sum_add(&s->size, length(alpha));
	}
}

enum { RING_SUMS = 6 };

static double dot(const double a[3], const double b[3]) { return a[0] * b[0] + a[1] * b[1] + a[2] * b[2]; }

/* [0] 2 pi circulation, [1] sum of weights, [2] their moment along the axis; of w u . n, of w u_r/r, and the moment of that */
static void make_ring(const void *data, size_t from, size_t to, void *part)
{
	const struct vortices *v = data;
	const double *axis = v->axis;
	struct pm_sum *ring = part;
	for (size_t i = from; i < to; i++) {
		double x[3], alpha[3], turn[3];
		particle(v->at, v->strength, v->centre, i, x, alpha);
		cross(x, alpha, turn);
		const double along = dot(x, axis), about = dot(turn, axis);
		double across[3];
		for (int d = 0; d < 3; d++)
			across[d] = x[d] - along * axis[d];
		const double r = length(across);
		pm_sum_add(&ring[0], r > 0 ? about / (r * r) : 0);
		pm_sum_add(&ring[1], about);
		pm_sum_add(&ring[2], about * along);
		if (!v->vel)
			continue;
		const double u[3] = {pm_in(v->vel, 0)[i], pm_in(v->vel, 1)[i], pm_in(v->vel, 2)[i]}, wider = r > 0 ? about * dot(u, across) / (r * r) : 0;
		pm_sum_add(&ring[3], about * dot(u, axis));
		pm_sum_add(&ring[4], wider);
		pm_sum_add(&ring[5], wider * along);
	}
}

/* Sums of W, and of W r exp(-i m phi) */
static void make_wave(const void *data, size_t first, size_t to, void *part)
{
	const struct vortices *v = data;
	struct pm_sum *wave = part;
	for (size_t i = first; i < to; i++) {
		double x[3], alpha[3], turn[3], x1 = 0, x2 = 0, about = 0;
		particle(v->at, v->strength, v->centre, i, x, alpha);
		cross(x, alpha, turn);
		for (int d = 0; d < 3; d++)
			x1 += x[d] * v->from[d], x2 += x[d] * v->quarter[d], about += turn[d] * v->axis[d];
		const double r = hypot(x1, x2), w = r > 0 ? about / (r * r) : 0, angle = v->mode * atan2(x2, x1);
		pm_sum_add(&wave[0], w);
		pm_sum_add(&wave[1], w * r * cos(angle));
		pm_sum_add(&wave[2], -w * r * sin(angle));
	}
}

/* Sums of alpha along the tube, and of alpha (X + i Y) exp(-i m k n) */
static void make_bend(const void *data, size_t first, size_t to, void *part)
{
	const struct vortices *v = data;
	struct pm_sum *wave = part;
	const double *x = pm_in(v->at, (v->along + 1) % 3), *y = pm_in(v->at, (v->along + 2) % 3), *n = pm_in(v->at, v->along);
	const double *alpha = pm_in(v->strength, v->along);
	for (size_t i = first; i < to; i++) {
		const double angle = 2 * pm_pi * v->mode * (n[i] / v->period), c = cos(angle), s = sin(angle);
		pm_sum_add(&wave[0], alpha[i]);
		pm_sum_add(&wave[1], alpha[i] * (x[i] * c + y[i] * s));
		pm_sum_add(&wave[2], alpha[i] * (y[i] * c - x[i] * s));
	}
}

/* The sums of a wave over all sets: 2 (wave[1] + i wave[2])/wave[0]. */
static void wave_of(const struct pm_measure *how, const struct pm_frame *f, struct vortices *v, void (*make)(const void *, size_t, size_t, void *),
	double mode[2])
{
	const struct pm_parts parts = {.size = 3 * sizeof(struct pm_sum), .make = make, .join = pm_join_sums};
	struct pm_sum wave[3] = {0};
	for (size_t i = 0; i < f->nsets; i++) {
		v->at = pm_frame_field(f, f->sets[i]->name, "x"), v->strength = pm_frame_field(f, f->sets[i]->name, how->strength);
		if (counts(how, f, f->sets[i]))
			pm_over_stretches(v->at, &parts, v, wave);
	}
	for (int c = 0; c < 2; c++)
		mode[c] = 2 * pm_sum_total(wave[1 + c]) / pm_sum_total(wave[0]);
}

static void tube_waves(const struct pm_measure *how, const struct pm_frame *f, struct pm_measures *m)
{
	int along = -1;
	for (int d = 0; d < 3; d++) {
		if (f->face[d][0] == PM_PERIODIC)
			along = along < 0 ? d : 3;
		else if (f->face[d][0] != PM_OPEN || f->face[d][1] != PM_OPEN)
			return;
	}
	for (int k = 0; k < how->nring_modes && along >= 0 && along < 3; k++)
		wave_of(how, f, &(struct vortices){.mode = how->modes[k], .along = along, .period = f->hi[along] - f->lo[along]}, make_bend, m->mode[k]);
}

static void ring_waves(const struct pm_measure *how, const struct pm_frame *f, const double centre[3], const double axis[3], struct pm_measures *m)
{
	double from[3] = {0}, quarter[3];
	int least = 0;
	for (int d = 1; d < 3; d++)
		least = fabs(axis[d]) < fabs(axis[least]) ? d : least;
	for (int d = 0; d < 3; d++)
		from[d] = (d == least) - axis[least] * axis[d];
	const double size = length(from);
	for (int d = 0; d < 3; d++)
		from[d] /= size;
	cross(axis, from, quarter);
	struct vortices v = {.centre = centre, .axis = axis, .from = from, .quarter = quarter};
	for (int k = 0; k < how->nring_modes; k++) {
		v.mode = how->modes[k];
		wave_of(how, f, &v, make_wave, m->mode[k]);
	}
}

static void add_ring(const struct pm_field *at, const struct pm_field *strength, const double centre[3], const double axis[3],
	const struct pm_field *vel, struct pm_sum ring[RING_SUMS])
{
	const struct pm_parts parts = {.size = RING_SUMS * sizeof *ring, .make = make_ring, .join = pm_join_sums};
	pm_over_stretches(at, &parts, &(struct vortices){.at = at, .strength = strength, .vel = vel, .centre = centre, .axis = axis}, ring);
}

static void add_sums(const struct pm_field *at, const struct pm_field *strength, struct sums *s)
{
	const struct pm_parts parts = {.size = sizeof *s, .make = make_sums, .join = pm_join_sums};
	pm_over_stretches(at, &parts, &(struct vortices){.at = at, .strength = strength}, s);
}

static void of_ring(const struct pm_measure *how, const struct pm_frame *f, const struct sums *s, struct pm_measures *m)
{
	double centre[3], axis[3], impulse[3];
	struct pm_sum ring[RING_SUMS] = {0};
	bool moves = true;
	const double size = pm_sum_total(s->size);
	for (int d = 0; d < 3; d++)
		impulse[d] = m->value[PM_IMPULSE + d], centre[d] = pm_sum_total(s->centre[d]) / size;
	const double I = length(impulse);
	bool open = I > 1e-9 * size * m->value[PM_DISTANCE_MAX];
	for (int k = 0; k < 6; k++)
		open = open && f->face[k / 2][k % 2] == PM_OPEN;
	if (!open)
		return;
	for (int d = 0; d < 3; d++)
		axis[d] = impulse[d] / I;
	for (size_t i = 0; i < f->nsets; i++)
		if (counts(how, f, f->sets[i])) {
			const char *set = f->sets[i]->name;
			const struct pm_field *vel = pm_frame_field(f, set, "vel");
			moves = moves && vel && vel->components == 3;
			add_ring(pm_frame_field(f, set, "x"), pm_frame_field(f, set, how->strength), centre, axis, moves ? vel : NULL, ring);
		}
	const double circulation = pm_sum_total(ring[0]) / (2 * pm_pi);
	m->value[PM_RING_CIRCULATION] = circulation;
	m->value[PM_RING_RADIUS] = circulation > 0 ? sqrt(I / (pm_pi * circulation)) : NAN;
	const double weight = pm_sum_total(ring[1]), middle = pm_sum_total(ring[2]) / weight;
	m->value[PM_RING_POSITION] = middle + dot(centre, axis);
	if (moves)
		m->value[PM_RING_SPEED] = (pm_sum_total(ring[3]) + 2 * (pm_sum_total(ring[5]) - middle * pm_sum_total(ring[4]))) / weight;
	ring_waves(how, f, centre, axis, m);
}

/* Of values like those of the field. */
static double largest(const struct pm_field *field, int components, const double *const y[])
{
	double most = 0;
	for (size_t i = 0; i < field->count; i++) {
		double square = 0;
		for (int c = 0; c < components; c++)
			square += y[c][i] * y[c][i];
		most = fmax(most, square);
	}
	return sqrt(pm_most_of_stretches(field, most));
}

/* The smallest scales of turbulence, from the dissipation eps of a unit mass: length (nu^3/eps)^(1/4), time (nu/eps)^(1/2) (Pope 2000, 5.7). An open box has
 * no mean to take eps from. */
static void kolmogorov(const struct pm_frame *f, double nu, struct pm_measures *m)
{
	double volume = 1;
	for (int d = 0; d < 3; d++)
		volume *= f->face[d][0] == PM_OPEN || f->face[d][1] == PM_OPEN ? NAN : f->hi[d] - f->lo[d];
	const double eps = m->value[PM_DISSIPATION] / volume;
	if (!(eps > 0))
		return;
	m->value[PM_KOLMOGOROV_LENGTH] = sqrt(nu * sqrt(nu / eps));
	m->value[PM_KOLMOGOROV_TIME] = sqrt(nu / eps);
}

static int of_mesh(const struct pm_measure *how, const struct pm_grid *g, const struct pm_field *field, struct pm_measures *m)
{
	struct pm_operator div;
	const double *const omega[3] = {pm_in(field, 0), pm_in(field, 1), pm_in(field, 2)};
	double *out = pm_alloc(field->count + 1, sizeof *out), z = 0;
	if (pm_world_agree(out ? 0 : -PM_DATA))
		return pm_free(out), -PM_DATA;
	const double most = largest(field, 3, omega);
	for (int c = 0; c < 3; c++)
		z += pm_energy_of_field(g, field, omega[c], omega[c]);
	m->value[PM_ENSTROPHY] = z;
	m->value[PM_DISSIPATION] = 2 * how->nu * z;
	m->value[PM_OMEGA_MAX] = most;
	if (!pm_operator_init(&div, g, PM_OP_DIV, 6, 3, false) && !pm_world_agree(pm_operator_apply_planes(&div, 1, field, omega, &out, NULL)))
		m->value[PM_DIVERGENCE] = most > 0 ? largest(field, 1, (const double *const *)&out) * fmax(g->h[0], fmax(g->h[1], g->h[2])) / most : 0;
	pm_free(out);
	return 0;
}

static int of_flow(const struct pm_measure *how, const struct pm_frame *f, const struct pm_field *omega, struct pm_measures *m)
{
	struct pm_law_field flow;
	int status = pm_law_field_of(how, f, &flow);
	if (!status && flow.field && flow.field->components == 3 && !strcmp(flow.field->on, omega->on)) {
		const struct pm_grid g = pm_grid_of(f, pm_frame_mesh(f, omega->on));
		double energy = 0, helicity = 0;
		for (int c = 0; c < 3; c++) {
			energy += pm_energy_of_field(&g, flow.field, pm_in(flow.field, c), pm_in(flow.field, c));
			helicity += 2 * pm_energy_of_field(&g, flow.field, pm_in(flow.field, c), pm_in(omega, c));
		}
		m->value[PM_ENERGY_FLOW] = energy;
		m->value[PM_HELICITY] = helicity;
	}
	pm_law_field_free(&flow);
	return status;
}

int pm_vortex_space_of(const struct pm_measure *how, const struct pm_frame *f, struct pm_measures *m)
{
	struct sums s = {0};
	const struct pm_field *omega = NULL;
	if (!how->vortices || !how->vector)
		return 0;
	for (int k = 0; k < how->nring_modes; k++)
		m->mode[k][0] = m->mode[k][1] = NAN;
	bool any = false;
	for (size_t i = 0; i < f->nsets; i++)
		if (counts(how, f, f->sets[i])) {
			add_sums(pm_frame_field(f, f->sets[i]->name, "x"), pm_frame_field(f, f->sets[i]->name, how->strength), &s);
			any = true;
		}
	for (int d = 0; d < 3 && any; d++) {
		m->value[PM_ALPHA + d] = pm_sum_total(s.alpha[d]);
		m->value[PM_IMPULSE + d] = pm_sum_total(s.impulse[d]);
		m->value[PM_ANGULAR_IMPULSE_OF + d] = pm_sum_total(s.angular[d]);
	}
	if (any)
		of_ring(how, f, &s, m), tube_waves(how, f, m);
	for (size_t i = 0; i < f->nmeshes && !omega; i++)
		omega = pm_frame_field(f, f->meshes[i]->name, how->density);
	if (!omega || omega->components != 3)
		return 0;
	const struct pm_grid g = pm_grid_of(f, pm_frame_mesh(f, omega->on));
	int status = of_mesh(how, &g, omega, m);
	kolmogorov(f, how->nu, m);
	return status ? status : of_flow(how, f, omega, m);
}
