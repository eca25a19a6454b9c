/* How fast a law's field makes particles oscillate and strains them. A flow: |grad u| on its mesh. Charges that move in the field they make: omega_p of all
 * of them in the box. Masses: the orbit that the largest acceleration of a particle belongs to (pm_orbit_rate), which never exceeds the true frequency, as the
 * gradient of g on the mesh would, which holds each particle's own cloud. A magnetic field: the largest |q B/m|.
 * Given fields other than a flow are left out: how they vary around a particle says nothing about its motion without the other forces.
 * Source: rates.h. Cost: one pass over the mesh (a flow) or over the strengths. SPDX-License-Identifier: GPL-3.0-or-later */
#include <string.h>

#include "limit/rates.h"
#include "stream/column.h"
#include "stream/declare.h"
#include "stream/later.h"
#include "stream/limits.h"
#include "stream/over-stretches.h"
#include "transfer/gather-limits.h"
#include "transfer/tile-gradient.h"

static bool is_flow(const struct pm_gather_job *j) { return !strcmp(j->law->of, "x"); }
static bool self(const struct pm_gather_job *j) { return j->field->role != PM_STATE && j->law->strength && j->law->coefficient; }

static bool counts(const struct pm_gather_job *j, const struct pm_frame *f, const struct pm_set *s)
{
	return pm_frame_field(f, s->name, j->law->strength) && (!j->law->per || (pm_set_moves(f, s) && pm_frame_field(f, s->name, j->law->per)));
}

int pm_gather_limits_declare(const struct pm_gather_job *j, struct pm_frame *f)
{
	for (size_t i = 0; i < f->nsets && self(j) && !is_flow(j); i++) {
		const char *set = f->sets[i]->name;
		if (!counts(j, f, f->sets[i]))
			continue;
		if ((j->law->per || !pm_frame_field(f, set, j->law->strength)->uniform) && !pm_reads(f, set, j->law->strength))
			return -PM_DATA;
		if (j->law->per && !pm_reads(f, set, j->law->per))
			return -PM_DATA;
	}
	return 0;
}

/* The most nodes of a row that are made at once, and with those on either side their distance from row to row. */
enum { PIECE = 1024, APART = PIECE + 16 /* not whole pages, which are in each other's way in the cache */ };

/* Nodes from-1..to of row y, to room[component][3 APART]. */
static void make_piece(const struct pm_gradient_later *l, size_t from, size_t to, size_t y, double *room)
{
	const size_t n = l->operator.grid.points[0], low = from ? from - 1 : 0, high = to < n ? to + 1 : n;
	if (!from)
		pm_tile_gradient_row(l, (const size_t[]){n - 1, y, 0}, 1, room, 3 * APART);
	pm_tile_gradient_row(l, (const size_t[]){low, y, 0}, high - low, room + !from, 3 * APART);
	if (to == n)
		pm_tile_gradient_row(l, (const size_t[]){0, y, 0}, 1, room + 1 + to - from, 3 * APART);
}

/* Of a flow that is left to be made the rows first..last-1, the nodes from..to-1: three rows are held at a time. */
static double strain_of_rows(const struct pm_gradient_later *l, size_t from, size_t to, size_t first, size_t last)
{
	const size_t rows = l->operator.grid.points[1];
	double room[6 * APART], most = 0; /* [component][row % 3][APART] */
	for (size_t y = first; y < last + 2; y++) { /* row y - 1 is made; row y - 2 then has both neighbours */
		make_piece(l, from, to, (y + rows - 1) % rows, room + y % 3 * APART);
		for (size_t c = 0; c < 2 && y >= first + 2; c++) {
			const double *u = room + c * 3 * APART + 1;
			const double *below = u + (y + 1) % 3 * APART, *here = u + (y + 2) % 3 * APART, *above = u + y % 3 * APART;
			most = fmax(most, pm_strain_in_plane(&l->operator.grid, to - from, here, below, above));
		}
	}
	return most;
}

/* Of a flow that is left to be made, in the plane. */
static double strain_later(const struct pm_gradient_later *l)
{
	const size_t n = l->operator.grid.points[0], rows = l->operator.grid.points[1], pieces = (n + PIECE - 1) / PIECE;
	const size_t parts = n * rows > pm_many_turns() / 4 ? (size_t)pm_threads() : 1;
	double most = 0;
#pragma omp parallel for collapse(2) num_threads((int)parts) schedule(static) reduction(max : most)
	for (size_t t = 0; t < parts; t++)
		for (size_t p = 0; p < pieces; p++)
			most = fmax(most, strain_of_rows(l, p * PIECE, p + 1 < pieces ? (p + 1) * PIECE : n, rows * t / parts, rows * (t + 1) / parts));
	return most;
}

void pm_gather_limits_prepare(struct pm_gather_job *j, const struct pm_frame *f)
{
	const double *u[PM_COMPONENTS];
	const struct pm_gradient_later *left = is_flow(j) && f->dim == 2 ? pm_gather_gradient(j) : NULL;
	for (int c = 0; c < j->field->components && is_flow(j) && !left; c++)
		u[c] = pm_in(j->field, c);
	if (left)
		j->limits.strain = strain_later(left);
	else if (is_flow(j))
		j->limits.strain = pm_strain(&j->transfer.grid, j->field, u);
	else if (self(j) && j->law->per)
		j->limits.oscillation = pm_plasma_frequency(f, j->law);
	else if (self(j))
		j->pull = fabs(j->law->coefficient(f)) * pm_strength_total(f, j->law->strength);
}

double pm_gather_limits_most(const struct pm_gather_job *j, const struct pm_frame *f, const char *set)
{
	const struct pm_field *change = pm_frame_field(f, set, j->law->change);
	return j->pull > 0 && !(change->use & PM_USE_FILL) ? sqrt(pm_most(change, NULL)) : 0;
}

/* Of m particles: charge, mass and the components of B. */
static double largest_rate(size_t m, const double *const v[5])
{
	const double *q = v[0], *mass = v[1], *x = v[2], *y = v[3], *z = v[4];
	double most = 0;
#ifndef __clang__ /* makes no vectors of a maximum that a NaN may stand beside, and warns */
#pragma omp simd reduction(max : most)
#endif
	for (size_t i = 0; i < m; i++) {
		const double rate = fabs(q[i] / mass[i]) * sqrt(x[i] * x[i] + y[i] * y[i] + z[i] * z[i]);
		most = rate > most ? rate : most;
	}
	return most;
}

/* Largest |q B/m|. */
static double gyration(const struct pm_gather_job *j, const struct pm_frame *f, const struct pm_field *b)
{
	enum { few = 512 };
	struct pm_column column[5] = {pm_column_of(pm_frame_field(f, b->on, j->law->strength), 0), pm_column_of(pm_frame_field(f, b->on, j->law->per), 0)};
	const size_t n = b->count;
	double most = 0;
	for (int c = 0; c < 3; c++)
		column[2 + c] = pm_column_of(b, c);
#pragma omp parallel for schedule(static) reduction(max : most) if (n > pm_many_turns() / 4)
	for (size_t from = 0; from < n; from += few) {
		const size_t m = n - from < few ? n - from : few;
		double room[5][few];
		const double *v[5];
		for (int c = 0; c < 5; c++) {
			v[c] = pm_column_take(&column[c], from, m, room[c]);
			for (size_t i = 0; i < m && c > 1 && b->type == PM_F32; i++)
				room[c][i] = (float)v[c][i]; /* as at the end of the stage */
			v[c] = c > 1 && b->type == PM_F32 ? room[c] : v[c];
		}
		const double here = largest_rate(m, v);
		most = here > most ? here : most;
	}
	return pm_most_of_stretches(b, most);
}

void pm_gather_limits_add(const struct pm_gather_job *j, struct pm_frame *f, const char *set, double before, double most)
{
	struct pm_field *change = pm_frame_field(f, set, j->law->change), *b = pm_frame_field(f, set, "bfield");
	struct pm_limits found = j->limits;
	if (j->pull > 0 && !pm_field_later_of(change)) /* of this field alone: at least the difference of the largest values */
		found.oscillation = sqrt(pm_orbit_rate(f->dim, sqrt(most > 0 ? most : pm_most(change, NULL)) - before, j->pull));
	pm_limits_add(change, found);
	if (b && j->law->magnetic && j->law->per && b->use & (PM_USE_CHANGE | PM_USE_NEW) && !pm_field_later_of(b))
		pm_limits_add(b, (struct pm_limits){.oscillation = gyration(j, f, b)});
}
