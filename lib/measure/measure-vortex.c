/* Integrals of vortices in the plane: circulation sum G, impulse (sum G y, -sum G x), angular impulse -1/2 sum G r^2 of the particles;
 * enstrophy 1/2 int omega^2, dissipation 2 nu times that, palinstrophy 1/2 int |grad omega|^2 (differences of order 6) and max |omega|, omega at a given
 * point (by m6prime, exact at a node) on the first mesh that holds omega; the largest distortion of the sets. In open space waves around the centre of
 * |G|: 2 sum G r exp(-i m phi)/sum G, as of a ring in space. Missing quantities are NAN. Sums follow the law of sums (base/in-order.h).
 * Cost N and points of the mesh. Source: Saffman 1992, sections 3.2 to 3.7. SPDX-License-Identifier: GPL-3.0-or-later */
#include <string.h>

#include "measure/measure.h"
#include "remesh/distortion.h"
#include "mesh/gradient-parts.h"
#include "transfer/transfer.h"
#include "stream/declare.h"
#include "stream/over-stretches.h"
#include "world/world.h"

/* A set of vortices that is to be measured: it has positions and strengths. */
static bool counts(const struct pm_measure *how, const struct pm_frame *f, const struct pm_set *set)
{
	const struct pm_field *x = pm_frame_field(f, set->name, "x"), *q = pm_frame_field(f, set->name, how->strength);
	return (!how->set || !strcmp(how->set, set->name)) && q && x && x->components == (how->vector ? 3 : 2);
}

static const struct pm_mesh *covered(const struct pm_measure *how, const struct pm_frame *f)
{
	for (size_t i = 0; i < f->nmeshes; i++)
		if (pm_frame_field(f, f->meshes[i]->name, how->density))
			return f->meshes[i];
	return NULL;
}

void pm_vortex_reads(const struct pm_measure *how, struct pm_frame *f)
{
	const char *const names[] = {"volume", "overlap"};
	for (size_t i = 0; i < f->nsets && how->vortices; i++)
		for (int k = 0; k < 2; k++)
			if (counts(how, f, f->sets[i]) && pm_frame_field(f, f->sets[i]->name, names[k]))
				pm_reads(f, f->sets[i]->name, names[k]);
	const struct pm_mesh *mesh = how->vortices ? covered(how, f) : NULL;
	if (mesh)
		pm_reads(f, mesh->name, how->density);
}

struct vortices {
	const double *x, *y, *q;
};

static void make(const void *data, size_t from, size_t to, void *part)
{
	const struct vortices *v = data;
	const double *x = v->x, *y = v->y, *q = v->q;
	struct pm_sum *sum = part;
	for (size_t i = from; i < to; i++) {
		pm_sum_add(&sum[0], q[i]);
		pm_sum_add(&sum[1], q[i] * y[i]);
		pm_sum_add(&sum[2], -q[i] * x[i]);
		pm_sum_add(&sum[3], -0.5 * q[i] * (x[i] * x[i] + y[i] * y[i]));
	}
}

static void of_particles(const struct pm_field *at, const struct pm_field *circulation, struct pm_sum sum[4])
{
	const struct pm_parts parts = {.size = 4 * sizeof *sum, .make = make, .join = pm_join_sums};
	pm_over_stretches(at, &parts, &(struct vortices){pm_in(at, 0), pm_in(at, 1), pm_in(circulation, 0)}, sum);
}

struct wave {
	const double *x, *y, *q, *centre; /* centre NULL: the sums that give it, of |G|, |G| x, |G| y */
	int mode;
};

/* Sums of G, and of G r exp(-i m phi) about the centre. */
static void make_wave(const void *data, size_t from, size_t to, void *part)
{
	const struct wave *v = data;
	struct pm_sum *sum = part;
	for (size_t i = from; i < to; i++) {
		const double size = fabs(v->q[i]), x = v->x[i] - (v->centre ? v->centre[0] : 0), y = v->y[i] - (v->centre ? v->centre[1] : 0);
		const double r = hypot(x, y), angle = v->mode * atan2(y, x);
		pm_sum_add(&sum[0], v->centre ? v->q[i] : size);
		pm_sum_add(&sum[1], v->centre ? v->q[i] * r * cos(angle) : size * x);
		pm_sum_add(&sum[2], v->centre ? -v->q[i] * r * sin(angle) : size * y);
	}
}

static void wave_sums(const struct pm_measure *how, const struct pm_frame *f, const double *centre, int mode, double total[3])
{
	const struct pm_parts parts = {.size = 3 * sizeof(struct pm_sum), .make = make_wave, .join = pm_join_sums};
	struct pm_sum sum[3] = {0};
	for (size_t i = 0; i < f->nsets; i++) {
		const struct pm_field *at = pm_frame_field(f, f->sets[i]->name, "x"), *q = pm_frame_field(f, f->sets[i]->name, how->strength);
		if (counts(how, f, f->sets[i]))
			pm_over_stretches(at, &parts, &(struct wave){pm_in(at, 0), pm_in(at, 1), pm_in(q, 0), centre, mode}, sum);
	}
	for (int k = 0; k < 3; k++)
		total[k] = pm_sum_total(sum[k]);
}

static void waves_around(const struct pm_measure *how, const struct pm_frame *f, struct pm_measures *m)
{
	double total[3];
	if (!how->nring_modes)
		return;
	wave_sums(how, f, NULL, 0, total);
	const double centre[2] = {total[1] / total[0], total[2] / total[0]};
	for (int k = 0; k < how->nring_modes; k++) {
		wave_sums(how, f, centre, how->modes[k], total);
		for (int c = 0; c < 2; c++)
			m->mode[k][c] = 2 * total[1 + c] / total[0];
	}
}

/* 1/2 int |grad omega|^2; NAN if the mesh is too small for the differences, or without memory. */
static double palinstrophy(const struct pm_grid *g, const struct pm_field *field)
{
	struct pm_operator o;
	const size_t n = field->count;
	const double *omega = pm_in(field, 0);
	double *slope = pm_alloc(2 * n + 1, sizeof *slope), sum = NAN;
	int status = pm_world_agree(slope ? 0 : -PM_DATA);
	status = status ? status : pm_operator_init(&o, g, PM_OP_GRAD, 6, 1, false); /* the same on all ranks */
	if (!status)
		status = pm_world_agree(pm_operator_apply_planes(&o, 1, field, &omega, (double *const[]){slope, slope + n}, NULL));
	if (!status)
		sum = pm_energy_of_field(g, field, slope, slope) + pm_energy_of_field(g, field, slope + n, slope + n);
	pm_free(slope);
	return sum;
}

/* omega at a point, which is a particle of rank 0; NAN if the point is outside the mesh. */
static double at_place(const struct pm_grid *g, const struct pm_field *field, const double place[2])
{
	struct pm_planes planes;
	const struct pm_transfer t = {.grid = *g, .kernel = pm_kernel_find("m6prime"), .components = 1, .planes = &planes};
	struct pm_strays strays = {.count = 0};
	const double *const x[3] = {&place[0], &place[1]}, *omega = pm_in(field, 0);
	double value = 0, *out = &value;
	int status = pm_world_agree(pm_planes_init(&planes, g, field));
	status = status ? status : pm_gather(&t, !field->here || !pm_world_rank(), x, &omega, NULL, &out, &strays);
	value = status || strays.count ? NAN : value;
	if (field->here && pm_world_share(status, 0, &value, sizeof value))
		value = NAN;
	pm_planes_free(&planes);
	return value;
}

static void of_mesh(const struct pm_measure *how, const struct pm_frame *f, const struct pm_mesh *mesh, const struct pm_field *field, struct pm_measures *m)
{
	const struct pm_grid g = pm_grid_of(f, mesh);
	const double *omega = pm_in(field, 0);
	double most = 0;
	for (size_t i = 0; i < field->count; i++)
		most = fmax(most, fabs(omega[i]));
	m->value[PM_OMEGA_MAX] = pm_most_of_stretches(field, most);
	m->value[PM_ENSTROPHY] = pm_energy_of_field(&g, field, omega, omega);
	m->value[PM_DISSIPATION] = 2 * how->nu * m->value[PM_ENSTROPHY];
	m->value[PM_OMEGA_CENTRE] = at_place(&g, field, how->centre);
	m->value[PM_PALINSTROPHY] = palinstrophy(&g, field);
}

void pm_vortex_of(const struct pm_measure *how, const struct pm_frame *f, struct pm_measures *m)
{
	struct pm_sum sum[4] = {0};
	const struct pm_mesh *mesh = how->vortices ? covered(how, f) : NULL, *first = pm_frame_mesh(f, NULL);
	double worst = NAN, here;
	for (int k = PM_CIRCULATION; k <= PM_DISTORTION; k++)
		m->value[k] = NAN;
	if (!how->vortices)
		return;
	for (size_t i = 0; i < f->nsets; i++) {
		const char *set = f->sets[i]->name;
		if (!counts(how, f, f->sets[i]))
			continue;
		if (!how->vector)
			of_particles(pm_frame_field(f, set, "x"), pm_frame_field(f, set, how->strength), sum);
		if (first && !pm_distortion(f, set, first, &here))
			worst = fmax(worst, here);
	}
	m->value[PM_DISTORTION] = worst;
	if (how->vector) /* measure-vortex-space.c */
		return;
	static const int column[] = {PM_CIRCULATION, PM_IMPULSE, PM_IMPULSE + 1, PM_ANGULAR_IMPULSE};
	for (int k = 0; k < 4; k++)
		m->value[column[k]] = pm_sum_total(sum[k]);
	waves_around(how, f, m);
	if (mesh)
		of_mesh(how, f, mesh, pm_frame_field(f, mesh->name, how->density), m);
}
