/* Half kicks of relativistic steps whose rates are left to be made too: the half that closes a step, and that which opens the next one, so that one pass over
 * the particles makes the rates, both halves and what needs the velocities then. Only where no particle can reach the speed of light to round-off or
 * overflow, which the largest speed and the largest fields tell before: a kick that is left cannot fail. Cost: a pass over the velocities, but where the pass
 * over the particles has looked at them.
 * SPDX-License-Identifier: GPL-3.0-or-later */
#include <stdlib.h>
#include <string.h>

#include "law/law.h"
#include "push/kick-later.h"
#include "stream/column.h"
#include "stream/field-value.h"
#include "stream/later.h"
#include "stream/reorder.h"
#include "transfer/gather-later.h"
#include "world/world.h"

enum { few_most = 256 };

struct kick_later {
	struct pm_later later; /* first member */
	struct pm_kicks kicks;
	int halves;
	struct {
		const struct pm_step *step;
		bool closing;
		double dt;
	} half[2];
	double c, charge, mass;
	double proper; /* bound of gamma |v| */
};

static void let_go(struct pm_later *later)
{
	struct kick_later *k = (struct kick_later *)later;
	pm_held_free(k->kicks.acc), pm_held_free(k->kicks.bfield);
}

static void kick_few(const struct pm_later *later, size_t m, double *const v[3], const double *const acc[3], const double *const b[3])
{
	const struct kick_later *k = (const struct kick_later *)later;
	double charge[few_most], mass[few_most];
	struct pm_magnetic a = {.v = {v[0], v[1], v[2]}, .acc = {acc[0], acc[1], acc[2]}, .b = {b[0], b[1], b[2]}, .charge = charge, .mass = mass,
		.alike = true, .c = k->c, .radiation_time = NAN};
	for (size_t i = 0; i < m; i++)
		charge[i] = k->charge, mass[i] = k->mass;
	for (int i = 0; i < k->halves; i++)
		k->half[i].step->magnetic(k->half[i].closing, k->half[i].dt, 0, m, &a);
}

static int make(const struct pm_later *later, double *to)
{
	const struct kick_later *k = (const struct kick_later *)later;
	const size_t n = later->from->count;
	const int components = later->from->components;
	if (pm_held_bring(k->kicks.acc) || pm_held_bring(k->kicks.bfield))
		return -PM_DATA;
	for (int c = 0; c < components; c++)
		memcpy(to + (size_t)c * n, pm_in(later->from, c), n * sizeof *to);
#pragma omp parallel for schedule(static) if (n > 16384)
	for (size_t p = 0; p < n; p += few_most) {
		double *v[3];
		const double *acc[3], *b[3];
		for (int c = 0; c < 3; c++) {
			v[c] = c < components ? to + (size_t)c * n + p : NULL;
			acc[c] = c < k->kicks.acc->components ? pm_in(k->kicks.acc, c) + p : NULL;
			b[c] = pm_in(k->kicks.bfield, c) + p;
		}
		kick_few(later, n - p < few_most ? n - p : few_most, v, acc, b);
	}
	return 0;
}

static struct pm_later *reorder(const struct pm_later *later, struct pm_reorder *r)
{
	struct kick_later *k = malloc(sizeof *k);
	if (!k)
		return pm_no_memory(), NULL;
	*k = *(const struct kick_later *)later;
	k->later.from = NULL, k->later.kicks = &k->kicks;
	k->kicks.acc = pm_held_reorder(k->kicks.acc, r), k->kicks.bfield = pm_held_reorder(k->kicks.bfield, r);
	return k->kicks.acc && k->kicks.bfield ? &k->later : pm_later_free(&k->later);
}

bool pm_kick_may_wait(const struct pm_moving *m, const struct pm_push *p)
{
	return p->later && pm_world_alone() && m->turned && m->b && !p->scheme && !p->moves && m->n == 1 && m->rates[0].state == m->v && m->v->type == PM_F64 &&
		m->v->components == 3;
}

static double fastest(const struct pm_field *v)
{
	const double *x = pm_in(v, 0), *y = pm_in(v, 1), *z = pm_in(v, 2);
	double most = 0;
	const size_t n = v->count;
#ifdef __clang__ /* makes no vectors of a maximum that a NaN may stand beside, and warns */
#pragma omp parallel for schedule(static) reduction(max : most) if (n > 16384)
#else
#pragma omp parallel for simd schedule(static) reduction(max : most) if (n > 16384)
#endif
	for (size_t i = 0; i < n; i++) {
		const double v2 = x[i] * x[i] + y[i] * y[i] + z[i] * z[i];
		most = v2 > most ? v2 : most;
	}
	return sqrt(most);
}

/* What a half adds to gamma |v| at most; an explicit turn by an angle tau adds c tau. */
static double gained(const struct pm_gather_left *l, double dt, double c)
{
	return 2 * fabs(dt) * (fabs(l->factor) * l->most[0] + c * l->rate * l->most[1]);
}

static bool is_one(const struct pm_field *strength, double value) { return pm_value_is_one(strength) && strength->value[0] == value; }

static bool safe(double proper, double c) { return proper < 1e6 * c; }

static void add_half(struct kick_later *k, const struct pm_frame *f, const struct pm_moving *m, const struct pm_step *step)
{
	k->half[k->halves].step = step, k->half[k->halves].closing = m->closing, k->half[k->halves].dt = f->dt;
	k->halves++;
}

/* One more half to those that are left, of the same rates, charge, mass and c. */
static bool go_on(const struct pm_frame *f, const struct pm_moving *m, const struct pm_step *step, const struct pm_gather_left *l, struct pm_later *later)
{
	struct kick_later *k = (struct kick_later *)later;
	if (later->make != make || k->halves != 1 || pm_gather_left_of(k->kicks.acc, k->kicks.bfield) != l || !safe(k->proper + gained(l, f->dt, k->c), k->c))
		return false;
	if (!is_one(m->charge, k->charge) || !is_one(m->mass, k->mass) || pm_law_constant(f, "c", NAN) != k->c)
		return false;
	k->proper += gained(l, f->dt, k->c);
	add_half(k, f, m, step);
	return true;
}

static int begin(const struct pm_frame *f, const struct pm_moving *m, const struct pm_step *step, const struct pm_gather_left *l, const struct pm_field *acc)
{
	const double c = pm_law_constant(f, "c", NAN), bound = m->v->within * sqrt(3) * (1 + 1e-12);
	const double speed = bound > 0 && bound < 0.99 * c ? bound : fastest(m->v);
	const double proper = speed / sqrt(1 - speed * speed / (c * c)) + gained(l, f->dt, c);
	if (!(speed < c) || !safe(proper, c))
		return 0;
	struct kick_later *k = calloc(1, sizeof *k);
	if (!k)
		return pm_no_memory();
	*k = (struct kick_later){.later = {.make = make, .free = let_go, .reorder = reorder}, .kicks = {pm_field_held(acc), pm_field_held(m->b), kick_few},
		.c = c, .charge = m->charge->value[0], .mass = m->mass->value[0], .proper = proper};
	k->later.kicks = &k->kicks;
	if (!k->kicks.acc || !k->kicks.bfield)
		return pm_later_free(&k->later), -PM_DATA;
	add_half(k, f, m, step);
	const int status = pm_field_later(m->v, &k->later, m->v);
	return status ? status : 1;
}

int pm_kick_leave(const struct pm_frame *f, const struct pm_moving *m, const struct pm_step *step, struct pm_field *acc)
{
	if (!(m->v->use & PM_USE_LATER))
		return 0;
	const struct pm_gather_left *l = step->relativistic && !step->radiates ? pm_gather_left_of(acc, m->b) : NULL;
	struct pm_later *later = pm_field_later_alone(m->v);
	int left = 0;
	if (l && later)
		left = go_on(f, m, step, l, later);
	else if (l && !pm_field_later_of(m->v) && pm_value_is_one(m->charge) && pm_value_is_one(m->mass) &&
		fabs(m->charge->value[0] / m->mass->value[0]) == l->rate)
		left = begin(f, m, step, l, acc);
	return left ? left : pm_field_now(m->v) || pm_field_now(acc) || pm_field_now(m->b) ? -PM_DATA : 0;
}
