/* Scales of a frame: speeds and their spread, the collective frequency of the particles, Debye length, distances, the fields given on meshes, strain and
 * roughness of the field. omega^2 = |c| sum q^2/m over the volume V, c that of lap phi = c rho (masses: |c| M/V); V is the box if it is periodic, else
 * the ball with the same rms radius. Source: Birdsall and Langdon 1985, section 1-2; the definitions. Cost N, and N^2/2 below PM_SCALES_PAIRS
 * particles; no clock, sums in a fixed order.
 * SPDX-License-Identifier: GPL-3.0-or-later */
#include <string.h>

#include "effect-parts/set-overlap.h"
#include "mesh/mesh-sum.h"
#include "limit/rates.h"
#include "mesh/gradient.h"
#include "planner/scales.h"
#include "stream/column.h"
#include "stream/field-value.h"

static const struct pm_field *state(const struct pm_frame *f, const char *on, const char *name)
{
	const struct pm_field *field = name ? pm_frame_field(f, on, name) : NULL;
	if (!field || field->role != PM_STATE || (field->type != PM_F64 && field->type != PM_F32))
		return NULL;
	pm_field_bring(field);
	return field;
}

static bool takes_part(const struct pm_frame *f, const struct pm_law *law, const struct pm_set *set)
{
	return state(f, set->name, "x") && (pm_set_moves(f, set) || state(f, set->name, law->strength));
}

/* Its numbers, asked for once. */
static struct pm_column column(const struct pm_field *f, int c)
{
	return !f->count || pm_value_is_one(f) ? (struct pm_column){.value = f->value[c]} : pm_column_doubles(pm_in(f, c));
}

/* ---- speeds ---- */

/* The velocities of a set, and the strengths by which they are weighted. */
struct speeds {
	struct pm_column v[3], q;
	int components;
	double share; /* mean strength; 0: all alike */
};

static struct speeds speeds_of(const struct pm_field *v)
{
	struct speeds s = {.components = v->components < 3 ? v->components : 3};
	for (int c = 0; c < s.components; c++)
		s.v[c] = column(v, c);
	return s;
}

enum { SQUARE = 3 };

static void make_share(const void *data, size_t from, size_t to, void *part)
{
	for (size_t i = from; i < to; i++)
		pm_sum_add(part, fabs(pm_column_at(data, i)));
}

static void make_speeds(const void *data, size_t from, size_t to, void *part)
{
	const struct speeds s = *(const struct speeds *)data;
	struct pm_sum *sum = part;
	for (size_t i = from; i < to; i++) {
		const double weight = s.share > 0 ? fabs(pm_column_at(&s.q, i)) / s.share : 1;
		double v2 = 0;
		for (int c = 0; c < s.components; c++) {
			const double v = pm_column_at(&s.v[c], i);
			v2 += v * v;
			pm_sum_add(&sum[c], weight * v);
		}
		pm_sum_add(&sum[SQUARE], weight * v2);
	}
}

static double fastest(const struct speeds *s, size_t n)
{
	double most = 0;
#pragma omp parallel for schedule(static) reduction(max : most) if (n > pm_many_turns())
	for (size_t i = 0; i < n; i++) {
		double v2 = 0;
		for (int c = 0; c < s->components; c++)
			v2 += pm_column_at(&s->v[c], i) * pm_column_at(&s->v[c], i);
		most = v2 > most ? v2 : most;
	}
	return sqrt(most);
}

/* Means over the particles; of charges by their strength, because a plasma may be sampled by particles of different weight. */
static void speeds(const struct pm_frame *f, const struct pm_law *law, struct pm_scales *s)
{
	struct pm_sum sum[4] = {{0, 0}};
	const struct pm_parts shares = {.size = sizeof *sum, .make = make_share, .join = pm_join_sums};
	const struct pm_parts parts = {.size = sizeof sum, .make = make_speeds, .join = pm_join_sums};
	double n = 0, mean = 0;
	for (size_t k = 0; k < f->nsets; k++) {
		const struct pm_field *v = pm_set_moves(f, f->sets[k]) ? state(f, f->sets[k]->name, "v") : NULL;
		const struct pm_field *q = v && s->kind == PM_CHARGES ? state(f, f->sets[k]->name, law->strength) : NULL;
		if (v) {
			struct speeds of = speeds_of(v);
			struct pm_sum share = {0, 0};
			if (q && !q->uniform && q->count) {
				of.q = column(q, 0);
				pm_over_set(&shares, &of.q, q->count, &share);
				of.share = pm_sum_total(share) / (double)q->count;
			}
			pm_over_set(&parts, &of, v->count, sum);
			s->v_max = fmax(s->v_max, fastest(&of, v->count));
			s->components = v->components > s->components ? v->components : s->components;
		}
		n += v ? (double)v->count : 0;
		s->second = s->second || v;
	}
	for (int c = 0; c < 3 && n > 0; c++)
		mean += pow(pm_sum_total(sum[c]) / n, 2);
	s->v_rms = n > 0 ? sqrt(pm_sum_total(sum[SQUARE]) / n) : 0;
	s->v_thermal = sqrt(fmax(0, s->v_rms * s->v_rms - mean));
}

/* ---- distances ---- */

/* The positions of all particles that take part, in one array. */
static size_t places(const struct pm_frame *f, const struct pm_law *law, size_t most, double *x[3])
{
	size_t n = 0;
	for (size_t k = 0; k < f->nsets; k++) {
		const struct pm_field *p = takes_part(f, law, f->sets[k]) ? state(f, f->sets[k]->name, "x") : NULL;
		const size_t m = !p ? 0 : p->count < most - n ? p->count : most - n;
		for (int d = 0; d < f->dim && m; d++) {
			const struct pm_column at = column(p, d);
			for (size_t i = 0; i < m; i++)
				x[d][n + i] = pm_column_at(&at, i);
		}
		n += m;
	}
	return n;
}

static double wrapped(const struct pm_frame *f, int d, double x)
{
	const double side = f->hi[d] - f->lo[d];
	return f->face[d][0] == PM_PERIODIC ? x - side * floor(x / side + 0.5) : x;
}

static double nearest(const struct pm_frame *f, size_t n, double *const x[3])
{
	double least = HUGE_VAL;
#pragma omp parallel for schedule(static) reduction(min : least) if (n > 200)
	for (size_t i = 0; i < n; i++)
		for (size_t j = 0; j < i; j++) {
			double r2 = 0;
			for (int d = 0; d < f->dim; d++)
				r2 += pow(wrapped(f, d, x[d][i] - x[d][j]), 2);
			least = fmin(least, r2);
		}
	return sqrt(least);
}

static double volume(const struct pm_frame *f, double spread)
{
	const double radius = spread * sqrt((f->dim + 2.0) / f->dim), ball[4] = {0, 2, pm_pi, 4 * pm_pi / 3};
	double box = 1;
	for (int d = 0; d < f->dim; d++)
		box *= f->hi[d] - f->lo[d];
	return f->face[0][0] == PM_PERIODIC || !(spread > 0) ? box : fmin(box, ball[f->dim] * pow(radius, f->dim));
}

/* Positions along an axis, and their mean. */
struct spread {
	const double *x;
	double mean;
};

static void make_spread(const void *data, size_t from, size_t to, void *part)
{
	const struct spread *s = data;
	for (size_t i = from; i < to; i++)
		pm_sum_add(part, (s->x[i] - s->mean) * (s->x[i] - s->mean));
}

static int distances(const struct pm_frame *f, const struct pm_law *law, struct pm_scales *s)
{
	double *x[3] = {NULL}, moment = 0;
	size_t most = 0;
	for (size_t k = 0; k < f->nsets; k++)
		most += takes_part(f, law, f->sets[k]) ? (size_t)f->sets[k]->n : 0;
	int status = 0;
	for (int d = 0; d < f->dim && !status; d++)
		status = (x[d] = pm_alloc(most + 1, sizeof *x[d])) ? 0 : -PM_DATA;
	const size_t n = status ? 0 : places(f, law, most, x);
	for (int d = 0; d < f->dim && n; d++) {
		struct pm_sum square = {0, 0};
		const double mean = pm_sum_array(n, x[d]) / (double)n;
		pm_over_set(&(struct pm_parts){.size = sizeof square, .make = make_spread, .join = pm_join_sums}, &(struct spread){x[d], mean}, n, &square);
		moment += pm_sum_total(square) / (double)n;
	}
	s->edge = HUGE_VAL;
	for (int k = 0; k < 2 * f->dim; k++)
		for (size_t i = 0; i < n && f->face[k / 2][k % 2] == PM_OPEN; i++)
			s->edge = fmin(s->edge, k % 2 ? f->hi[k / 2] - x[k / 2][i] : x[k / 2][i] - f->lo[k / 2]);
	s->spread = sqrt(moment);
	s->volume = volume(f, s->spread);
	s->spacing = n ? pow(s->volume / (double)n, 1.0 / f->dim) : NAN;
	s->nearest = n > 1 && n <= PM_SCALES_PAIRS && !status ? nearest(f, n, x) : s->spacing * pow(fmax(1, (double)n), -1.0 / f->dim);
	for (int d = 0; d < f->dim; d++)
		pm_free(x[d]);
	return status;
}

/* ---- collective frequency ---- */

struct pulls {
	struct pm_column q[PM_COMPONENTS], m;
	int components;
	bool squares, masses;
};

static struct pulls pulls_of(const struct pm_field *q, const struct pm_field *m, bool squares)
{
	struct pulls p = {.components = q->components, .squares = squares, .masses = m};
	for (int c = 0; c < p.components; c++)
		p.q[c] = column(q, c);
	if (m)
		p.m = column(m, 0);
	return p;
}

/* Of a strength: its absolute value, or the length of a vector. */
static double size_of(const struct pulls *p, size_t i)
{
	double size = fabs(pm_column_at(&p->q[0], i));
	for (int c = 1; c < p->components; c++)
		size = hypot(size, pm_column_at(&p->q[c], i));
	return size;
}

static double pull(const struct pulls *p, size_t i)
{
	const double a = size_of(p, i);
	return !p->squares ? a : p->masses && pm_column_at(&p->m, i) > 0 ? a * a / pm_column_at(&p->m, i) : 0;
}

static void make_pulls(const void *data, size_t from, size_t to, void *part)
{
	for (size_t i = from; i < to; i++)
		pm_sum_add(part, pull(data, i));
}

static void strengths(const struct pm_frame *f, const struct pm_law *law, struct pm_scales *s)
{
	const bool squares = law->per != NULL, turns = s->kind == PM_VORTICES;
	const struct pm_parts parts = {.size = sizeof(struct pm_sum), .make = make_pulls, .join = pm_join_sums};
	struct pm_sum total = {0, 0};
	double dense = 0, largest_pull = 0;
	for (size_t k = 0; k < f->nsets && law->strength; k++) {
		const char *set = f->sets[k]->name;
		const struct pm_field *q = state(f, set, law->strength), *m = squares ? state(f, set, law->per) : NULL;
		const struct pm_field *v = turns ? state(f, set, "volume") : NULL;
		if (!q)
			continue;
		const struct pulls of = pulls_of(q, m, squares);
		const bool one = pm_value_is_one(q) && (!m || pm_value_is_one(m)) && !v; /* then all are the first */
		pm_over_set(&parts, &of, q->count, &total);
		for (size_t i = 0; i < (one && q->count ? 1 : q->count); i++) {
			const double a = size_of(&of, i);
			s->sources += a > 0 ? one ? (double)q->count : 1 : 0;
			dense = v && pm_value_at(v, 0, i) > 0 ? fmax(dense, a / pm_value_at(v, 0, i)) : dense;
			largest_pull = fmax(largest_pull, pull(&of, i));
			s->ratio = fmax(s->ratio, m && pm_column_at(&of.m, i) > 0 ? a / pm_column_at(&of.m, i) : squares ? 0 : 1);
		}
	}
	const double c = law->coefficient ? fabs(law->coefficient(f)) : s->light ? 1 / pm_frame_constant(f, "eps0", 1) : 0;
	const double sum = pm_sum_total(total);
	s->omega = turns ? fmax(dense, sum / s->volume) : sqrt(c * sum / s->volume);
	const double r = fmax(s->softening, s->nearest), sphere[4] = {1, 2, 2 * pm_pi * r, 4 * pm_pi * r * r};
	s->encounter = turns ? largest_pull / (pm_pi * r * r) : sqrt(2 * c * largest_pull / (sphere[f->dim] * r));
	s->debye = s->omega > 0 ? s->v_thermal / sqrt(s->components > 0 ? s->components : s->dim) / s->omega : NAN;
}

/* Largest magnitude of a state field on a mesh; NAN if there is none. */
static double largest(const struct pm_frame *f, const char *name)
{
	double most = NAN;
	for (size_t k = 0; k < f->nmeshes; k++) {
		const struct pm_field *y = state(f, f->meshes[k]->name, name);
		for (size_t i = 0; y && i < (y->uniform ? 1 : y->count); i++) {
			double here = 0;
			for (int c = 0; c < y->components; c++)
				here += pm_value_at(y, c, i) * pm_value_at(y, c, i);
			most = fmax(most, sqrt(here));
		}
	}
	return most;
}

/* The mean of |H - 1| over sets with a volume. */
static int coverage(const struct pm_frame *f, struct pm_scales *s)
{
	struct pm_sum sum = {0, 0}, width = {0, 0};
	double n = 0;
	for (size_t k = 0; k < f->nsets && f->nmeshes; k++) {
		const struct pm_set *set = f->sets[k];
		const struct pm_field *v = state(f, set->name, "volume");
		if (!pm_set_moves(f, set) || !v || !set->n)
			continue;
		double *H = pm_alloc(set->n, sizeof *H);
		int status = H ? pm_set_overlap(f, set->name, f->meshes[0], H) : -PM_DATA;
		for (size_t i = 0; i < set->n && !status; i++)
			H[i] = fabs(H[i] - 1);
		pm_sum_of_set(status ? 0 : set->n, H, NULL, &sum);
		for (size_t i = 0; i < set->n && !status; i++)
			H[i] = pow(fabs(pm_value_at(v, 0, i)), 1.0 / f->dim);
		pm_sum_of_set(status ? 0 : set->n, H, NULL, &width);
		n += (double)set->n;
		pm_free(H);
		if (status)
			return status;
	}
	s->overlap = n > 0 ? pm_sum_total(sum) / n : NAN;
	s->width = n > 0 ? pm_sum_total(width) / n : NAN;
	return 0;
}

static void geometry(const struct pm_frame *f, struct pm_scales *s)
{
	s->h = s->points = NAN;
	s->box = HUGE_VAL;
	for (int d = 0; d < f->dim; d++) {
		s->box = fmin(s->box, f->hi[d] - f->lo[d]);
		for (int side = 0; side < 2; side++) {
			s->periodic = s->periodic || f->face[d][side] == PM_PERIODIC;
			s->open = s->open || f->face[d][side] == PM_OPEN;
			s->walls = s->walls || (f->face[d][side] != PM_PERIODIC && f->face[d][side] != PM_OPEN);
		}
	}
	if (!f->nmeshes)
		return;
	size_t points[3];
	s->points = (double)pm_mesh_points(f, f->meshes[0], points);
	s->h = 0;
	for (int d = 0; d < f->dim; d++)
		s->h = fmax(s->h, f->meshes[0]->h[d]);
}

int pm_scales_of(const struct pm_frame *f, const struct pm_law *law, struct pm_scales *s)
{
	*s = (struct pm_scales){.dim = f->dim, .law = law->name, .dt = f->dt, .time = NAN, .accuracy = NAN, .self = NAN, .self_max = NAN, .strain = NAN,
		.rough = NAN, .length = NAN, .mesh_error = NAN, .overlap = NAN, .width = NAN, .courant = NAN, .magnetic = NAN, .wiggle = NAN};
	s->kind = !law->field ? PM_NO_FIELD : !law->strength ? PM_CARRIED : law->of_potential == PM_CURL ? PM_VORTICES : law->per ? PM_CHARGES : PM_MASSES;
	s->softening = pm_frame_constant(f, "softening", 0);
	s->nu = pm_frame_constant(f, "nu", 0);
	s->light = law->evolves;
	s->c = pm_frame_constant(f, "c", s->light ? 1 : NAN);
	for (size_t k = 0; k < f->nsets; k++)
		s->n += pm_set_moves(f, f->sets[k]) ? (double)f->sets[k]->n : 0;
	geometry(f, s);
	speeds(f, law, s);
	int status = distances(f, law, s);
	strengths(f, law, s);
	const double field = largest(f, law->field), B = largest(f, law->magnetic);
	s->given = law->per ? field * s->ratio : field;
	s->cyclotron = B * s->ratio;
	pm_scales_orbits(f, law, s);
	status = status || !s->light ? status : pm_scales_light(f, law, s);
	return status || s->kind != PM_VORTICES ? status : coverage(f, s);
}

/* ---- scales of the force ---- */

static double length_of(const struct pm_grid *g, int components, const double *const y[], double mean)
{
	const struct pm_parts parts = {.size = sizeof(struct pm_sum), .make = make_spread, .join = pm_join_sums};
	struct pm_sum sum = {0, 0};
	for (int c = 0; c < components; c++)
		pm_over_mesh(&parts, &(struct spread){y[c], mean}, g->points, &sum);
	return sqrt(pm_sum_total(sum));
}

static int roughness(const struct pm_grid *g, int components, const double *const density[], double size, double *rough)
{
	struct pm_operator lap;
	const size_t n = pm_grid_size(g);
	double *made = pm_alloc((size_t)components * n, sizeof *made), *out[PM_COMPONENTS];
	int status = made ? pm_operator_init(&lap, g, PM_OP_LAP, 4, components, false) : -PM_DATA;
	for (int k = 0; k < components; k++)
		out[k] = made + (size_t)k * n;
	if (!status)
		status = pm_operator_apply(&lap, 1, density, out, NULL);
	*rough = status ? NAN : length_of(g, components, (const double *const *)out, 0) / size;
	pm_free(made);
	return status;
}

static int mesh_scales(const struct pm_frame *f, const struct pm_law *law, const struct pm_mesh *m, struct pm_scales *s)
{
	const struct pm_field *rho = pm_frame_field(f, m->name, law->density), *field = pm_frame_field(f, m->name, law->field);
	const struct pm_grid g = pm_grid_of(f, m);
	const double *y[PM_COMPONENTS], *r[PM_COMPONENTS], c = law->coefficient ? fabs(law->coefficient(f)) : 0;
	double size = 0;
	if (!rho || !field || field->role != PM_DERIVED)
		return 0;
	for (int k = 0; k < field->components; k++)
		y[k] = pm_in(field, k);
	for (int k = 0; k < rho->components; k++) {
		r[k] = pm_in(rho, k);
		const double mean = s->periodic ? pm_grid_sum(&g, r[k], NULL) / (double)rho->count : 0, here = length_of(&g, 1, &r[k], mean);
		size = k ? hypot(size, here) : here;
	}
	s->length = length_of(&g, field->components, y, 0) / (c * size);
	if (s->kind != PM_VORTICES)
		return 0;
	s->strain = pm_strain(&g, field, y);
	return size > 0 ? roughness(&g, rho->components, r, size, &s->rough) : 0;
}

static void make_squares(const void *data, size_t from, size_t to, void *part)
{
	const struct pulls *a = data;
	for (size_t i = from; i < to; i++)
		for (int c = 0; c < a->components; c++)
			pm_sum_add(part, pm_column_at(&a->q[c], i) * pm_column_at(&a->q[c], i));
}

int pm_scales_of_force(const struct pm_frame *f, const struct pm_law *law, struct pm_scales *s)
{
	const struct pm_parts parts = {.size = sizeof(struct pm_sum), .make = make_squares, .join = pm_join_sums};
	struct pm_sum square = {0, 0};
	double n = 0, most = 0;
	for (size_t k = 0; k < f->nsets; k++) {
		const struct pm_field *a = pm_set_moves(f, f->sets[k]) ? pm_frame_field(f, f->sets[k]->name, law->change) : NULL;
		pm_field_bring(a);
		if (a) {
			const struct pulls of = pulls_of(a, NULL, false);
			pm_over_set(&parts, &of, a->count, &square);
		}
		most = a ? fmax(most, sqrt(pm_most(a, NULL))) : most;
		n += a ? (double)a->count : 0;
	}
	s->self = n > 0 ? sqrt(pm_sum_total(square) / n) : 0;
	s->self_max = most;
	int status = 0;
	for (size_t k = 0; k < f->nmeshes && !status; k++)
		status = mesh_scales(f, law, f->meshes[k], s);
	return status;
}
