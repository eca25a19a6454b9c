/* The difference of two runs of one frame, in the quantity that the accuracy is of:
 *   x      bodies in open space, points without inertia:  |x - x'| over the rms distance from their centre
 *   v      particles in a box, charges:                   |v - v'| over the largest |v| of the start, the middle and the end
 *   omega  vortices that are the nodes of a mesh:         |omega - omega'| over |omega|, at the nodes that both meshes have
 * all in l2 over particles or nodes. Cost: one pass over them, and for omega a deposit on the mesh of each run.
 * SPDX-License-Identifier: GPL-3.0-or-later */
#include <string.h>

#include "law/law.h"
#include "measure/norms.h"
#include "planner/plan-compare.h"

const char *pm_compare_what(const struct pm_frame *f, const struct pm_plan *p)
{
	const struct pm_scales *s = &p->scales;
	(void)f;
	if (pm_plan_nodes(p))
		return p->law->density;
	return s->second && (s->kind == PM_CHARGES || s->periodic || s->walls || !(fmax(s->n, s->sources) > 1)) ? "v" : "x";
}

static double apart(const struct pm_frame *f, int d, double x, double y)
{
	const double side = f->hi[d] - f->lo[d], z = x - y;
	return d < f->dim && f->pface[d][0] == PM_PFOLD ? z - side * floor(z / side + 0.5) : z;
}

/* Where b holds each of a's particles: NULL and *fits if one by one; else memory to free, or NULL without fit. */
static size_t *matched(const struct pm_frame *a, const struct pm_frame *b, const char *set, bool *fits)
{
	const struct pm_field *i = pm_frame_field(a, set, "id"), *j = pm_frame_field(b, set, "id");
	const struct pm_set *sa = pm_frame_set(a, set), *sb = pm_frame_set(b, set);
	*fits = sa && sb && sa->n == sb->n;
	if (*fits || !sa || !sb || !i || !j || !i->buffer || !j->buffer || sa->n > sb->n)
		return NULL;
	size_t *match = pm_alloc(sa->n, sizeof *match), at = 0, n = 0;
	for (; match && at < sb->n && n < sa->n; at++) /* both in the order of the frame */
		if (pm_in_i64(j, 0)[at] == pm_in_i64(i, 0)[n])
			match[n++] = at;
	*fits = match && n == sa->n;
	if (!*fits)
		pm_free(match), match = NULL;
	return match;
}

/* Sums of squares over the particles that move. */
struct squares {
	struct pm_sum difference, size;
	double n, all; /* particles compared; of b */
};

static void add_set(const struct pm_frame *a, const struct pm_frame *b, const char *set, const char *of, struct squares *s, bool *fits)
{
	const struct pm_field *p = pm_frame_field(a, set, of), *q = pm_frame_field(b, set, of);
	size_t *match = p && q && p->buffer && q->buffer ? matched(a, b, set, fits) : (*fits = false, NULL);
	const bool places = !strcmp(of, "x");
	for (int d = 0; *fits && d < q->components; d++) {
		for (size_t i = 0; i < q->count && !places; i++)
			pm_sum_add(&s->size, pow(pm_in(q, d)[i], 2));
		for (size_t i = 0; i < p->count; i++) {
			const double x = pm_in(p, d)[i], y = pm_in(q, d)[match ? match[i] : i];
			pm_sum_add(&s->difference, pow(places ? apart(b, d, x, y) : x - y, 2));
		}
	}
	s->n += *fits ? (double)p->count : 0;
	s->all += *fits ? (double)q->count : 0;
	pm_free(match);
}

/* Mean square distance of the particles that move from the centre: of the fixed ones if there are any (a sun), else of all. */
static double spread(const struct pm_frame *f)
{
	bool sun = false;
	double square = 0;
	for (size_t k = 0; k < f->nsets; k++)
		sun = sun || (!pm_set_moves(f, f->sets[k]) && f->sets[k]->n > 0);
	for (int d = 0; d < f->dim; d++) {
		struct pm_sum first[2] = {{0, 0}, {0, 0}}, second = {0, 0}; /* [1]: of those that move */
		double n[2] = {0, 0}, origin = NAN;
		for (size_t k = 0; k < f->nsets; k++) {
			const struct pm_field *x = pm_frame_field(f, f->sets[k]->name, "x");
			const bool moves = pm_set_moves(f, f->sets[k]);
			for (size_t i = 0; x && x->buffer && i < x->count; i++) {
				origin = isnan(origin) ? pm_in(x, d)[i] : origin;
				const double z = pm_in(x, d)[i] - origin;
				pm_sum_add(&first[moves], z);
				n[moves]++;
				if (moves)
					pm_sum_add(&second, z * z);
			}
		}
		const double mean = n[1] > 0 ? pm_sum_total(first[1]) / n[1] : 0, centre = sun && n[0] > 0 ? pm_sum_total(first[0]) / n[0] : mean;
		square += n[1] > 0 ? pm_sum_total(second) / n[1] - mean * mean + pow(mean - centre, 2) : 0;
	}
	return square;
}

static double particles(const struct pm_frame *a, const struct pm_frame *b, const struct pm_frame *const scaled[3], const char *of)
{
	struct squares s = {{0, 0}, {0, 0}, 0, 0};
	bool fits = true;
	for (size_t k = 0; k < b->nsets && fits; k++)
		if (pm_set_moves(b, b->sets[k]))
			add_set(a, b, b->sets[k]->name, of, &s, &fits);
	double scale = strcmp(of, "x") ? pm_sum_total(s.size) : s.all * spread(b);
	for (int i = 0; i < 3 && fits && strcmp(of, "x"); i++) {
		struct squares other = {{0, 0}, {0, 0}, 0, 0};
		for (size_t k = 0; scaled[i] && k < b->nsets && fits; k++)
			if (pm_set_moves(b, b->sets[k]) && pm_frame_set(scaled[i], b->sets[k]->name))
				add_set(scaled[i], scaled[i], b->sets[k]->name, of, &other, &fits);
		scale = fmax(scale, pm_sum_total(other.size));
	}
	const double difference = pm_sum_total(s.difference);
	return !fits || !(s.n > 0) ? NAN : difference == 0 ? 0 : sqrt(difference / s.n / (scale / s.all));
}

/* The value at a place of a mesh that has a node there; 0 beyond it, where its density is. NAN: between nodes. */
static double at_place(const struct pm_mesh *m, const size_t points[3], const double *values, const double x[3])
{
	size_t place = 0;
	for (int d = 2; d >= 0; d--) {
		const double i = points[d] > 1 ? (x[d] - m->lo[d]) / m->h[d] : 0, node = floor(i + 0.5);
		if (fabs(i - node) > 1e-6)
			return NAN;
		if (node < 0 || node >= (double)points[d])
			return 0;
		place = place * points[d] + (size_t)node;
	}
	return values[place];
}

static double on_mesh(const struct pm_frame *a, const struct pm_frame *b, const char *density)
{
	const struct pm_mesh *m = a->meshes[0], *n = b->meshes[0];
	const bool swap = m->h[0] > n->h[0] * (1 + 1e-9); /* at the nodes of the coarser one */
	const struct pm_frame *coarse = swap ? a : b, *fine = swap ? b : a;
	const struct pm_mesh *c = coarse->meshes[0], *g = fine->meshes[0];
	const double *u = pm_in(pm_frame_field(coarse, c->name, density), 0), *w = pm_in(pm_frame_field(fine, g->name, density), 0);
	size_t cp[3], gp[3], common = 0;
	const size_t all = pm_mesh_points(coarse, c, cp);
	struct pm_sum difference = {0, 0}, size = {0, 0};
	pm_mesh_points(fine, g, gp);
	for (size_t i = 0; i < all; i++) {
		const double x[3] = {c->lo[0] + c->h[0] * (double)(i % cp[0]), c->lo[1] + c->h[1] * (double)(i / cp[0] % cp[1]),
			c->lo[2] + c->h[2] * (double)(i / cp[0] / cp[1])};
		const double there = at_place(g, gp, w, x);
		if (isnan(there))
			continue;
		common++;
		pm_sum_add(&difference, pow(u[i] - there, 2));
		pm_sum_add(&size, pow(swap ? there : u[i], 2));
	}
	const double d = pm_sum_total(difference);
	return !common ? NAN : d == 0 ? 0 : sqrt(d / pm_sum_total(size));
}

double pm_compare(const struct pm_frame *a, const struct pm_frame *b, const struct pm_frame *const scaled[3], const struct pm_plan *p, const char *of)
{
	if (strcmp(of, p->law->density ? p->law->density : ""))
		return particles(a, b, scaled, of);
	char words[80];
	snprintf(words, sizeof words, "p2m --kernel m6prime%s", p->method.grow ? " --outside grow" : "");
	struct pm_frame *x = pm_plan_prime(a, words), *y = x ? pm_plan_prime(b, words) : NULL;
	const double d = y ? on_mesh(x, y, of) : NAN;
	pm_frame_free(x), pm_frame_free(y);
	return d;
}
