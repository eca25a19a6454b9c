/* The sums of those inside an open mesh, and what those outside do to them (outside.c has the equations). By the law of sums (base/in-order.h).
 * Cost: two passes over the particles. SPDX-License-Identifier: GPL-3.0-or-later */
#include "stream/over-stretches.h"
#include "transfer/outside.h"
#include "world/world.h"

enum { SUMS = 6, REACTIONS = 5 }; /* q, |q|, |q| (x - middle) per axis, |q| (x - middle)^2 over the open axes */

static double length(const struct pm_grid *g, int d) { return (double)g->cells[d] * g->h[d]; }
static double middle(const struct pm_grid *g, int d) { return g->lo[d] + 0.5 * length(g, d); }

/* Those of one set that are outside, and the sums of those inside. */
struct tally {
	const struct pm_field *field; /* positions */
	size_t n;
	const double *x[3], *q;
	unsigned char *mask;
};

struct of_set {
	const struct pm_outside_force *o;
	const struct tally *s;
};

/* Of those inside; compensated, because the reaction must balance to round-off. */
static void make_inside(const void *data, size_t from, size_t to, void *part)
{
	const struct pm_outside_force *o = ((const struct of_set *)data)->o;
	const struct tally *s = ((const struct of_set *)data)->s;
	const struct pm_grid *g = &o->transfer.grid;
	struct pm_sum *sum = part;
	for (size_t p = from; p < to; p++) {
		double a = fabs(s->q[p]), square = 0;
		if (s->mask[p])
			continue;
		for (int k = 0; k < o->open; k++) {
			const double r = s->x[o->axis[k]][p] - middle(g, o->axis[k]);
			pm_sum_add(&sum[2 + o->axis[k]], a * r);
			square += r * r;
		}
		pm_sum_add(&sum[0], s->q[p]);
		pm_sum_add(&sum[1], a);
		pm_sum_add(&sum[5], a * square);
	}
}

/* sigma2: second moment per open axis. In one dimension every body beyond a face is beyond all that is inside: a point is exact. */
static double radius(const struct pm_outside_force *o, double sigma2)
{
	double h = 0;
	for (int k = 0; k < o->open; k++)
		h = fmax(h, o->transfer.grid.h[o->axis[k]]);
	return o->open == 1 ? 0 : sqrt((o->open + 2) * (sigma2 + o->transfer.kernel->width * h * h / 6));
}

static void make_balls(struct pm_outside_force *o, const struct pm_sum total[SUMS])
{
	const struct pm_grid *g = &o->transfer.grid;
	const double all = pm_sum_total(total[1]);
	double square = all > 0 ? pm_sum_total(total[5]) / all : 0, sides = 0, volume = 1;
	o->inside.strength = pm_sum_total(total[0]);
	for (int d = 0; d < g->dim; d++) {
		const double mean = all > 0 ? pm_sum_total(total[2 + d]) / all : 0;
		square -= mean * mean;
		o->inside.centre[d] = middle(g, d) + mean;
		o->background.centre[d] = middle(g, d);
		volume *= length(g, d);
	}
	for (int k = 0; k < o->open; k++)
		sides += length(g, o->axis[k]) * length(g, o->axis[k]) / 12;
	o->inside.radius = radius(o, fmax(0, square / o->open));
	o->background.strength = o->charge * volume;
	o->background.radius = radius(o, sides / o->open);
}

/* What those that are outside do at the centre of those inside: gradient, potential, energy. */
static void make_outside(const void *data, size_t from, size_t to, void *part)
{
	const struct pm_outside_force *o = ((const struct of_set *)data)->o;
	const struct tally *s = ((const struct of_set *)data)->s;
	struct pm_sum *sum = part;
	for (size_t p = from; p < to; p++) {
		double x[3] = {0}, phi, g[3];
		if (!s->mask[p])
			continue;
		for (int d = 0; d < o->transfer.grid.dim; d++)
			x[d] = s->x[d][p];
		pm_outside_at(o, x, &phi, g);
		pm_sum_add(&sum[4], s->q[p] * phi);
		pm_outside_pair(o, o->inside.centre, x, o->inside.radius, &phi, g);
		pm_sum_add(&sum[3], s->q[p] * phi);
		for (int d = 0; d < 3; d++)
			pm_sum_add(&sum[d], s->q[p] * g[d]);
	}
}

static int measure(struct pm_outside_force *o, const struct pm_frame *f, struct tally *tally, double **made)
{
	struct pm_sum total[SUMS] = {{0, 0}}, sum[REACTIONS] = {{0, 0}};
	const struct pm_parts inside = {.size = sizeof total, .make = make_inside, .join = pm_join_sums};
	const struct pm_parts outside = {.size = sizeof sum, .make = make_outside, .join = pm_join_sums};
	int status = 0;
	o->count = o->within = 0;
	for (size_t i = 0; i < o->sources.n && !status; i++) {
		struct tally *s = &tally[i];
		struct pm_strays closed;
		const double *q[PM_COMPONENTS];
		s->field = pm_frame_field(f, o->sources.name[i], "x");
		s->n = s->field->count;
		s->mask = pm_alloc(s->n + 1, 1);
		pm_positions(f, o->sources.name[i], s->x);
		status = s->mask ? pm_strengths(f, o->sources.name[i], o->strength, q, &made[i]) : -PM_DATA;
		if (!status)
			status = pm_outside_find(f, o->sources.name[i], &o->transfer, s->mask, &closed);
		s->q = q[0];
		for (size_t p = 0; p < s->n && !status; p++)
			o->count += s->mask[p];
		o->within += s->n;
		status = s->field->here ? pm_world_agree(status) : status;
		if (!status)
			pm_over_stretches(s->field, &inside, &(struct of_set){o, s}, total);
	}
	int64_t counts[2] = {(int64_t)o->count, (int64_t)o->within};
	status = o->sources.n && tally[0].field && tally[0].field->here ? pm_world_count(status, PM_SUM_OF, 2, counts) : status;
	o->count = (uint64_t)counts[0], o->within = (uint64_t)(counts[1] - counts[0]);
	if (status)
		return status;
	make_balls(o, total);
	for (size_t i = 0; i < o->sources.n; i++)
		pm_over_stretches(tally[i].field, &outside, &(struct of_set){o, &tally[i]}, sum);
	for (int d = 0; d < 3; d++)
		o->gradient[d] = pm_sum_total(sum[d]);
	o->potential = pm_sum_total(sum[3]);
	o->energy = pm_sum_total(sum[4]);
	return 0;
}

int pm_outside_measure(struct pm_outside_force *o, const struct pm_frame *f)
{
	struct tally *tally = pm_zalloc(o->sources.n + 1, sizeof *tally);
	double **made = pm_zalloc(o->sources.n + 1, sizeof *made);
	int status = tally && made ? measure(o, f, tally, made) : -PM_DATA;
	for (size_t i = 0; i < o->sources.n; i++) {
		if (tally)
			pm_free(tally[i].mask);
		if (made)
			pm_free(made[i]);
	}
	pm_free(tally);
	pm_free(made);
	return status;
}
