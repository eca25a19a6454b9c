/* Particles beyond the open faces of a mesh: they are on no node, and feel those inside as one ball of constant density with the strength
 * Q = sum q_i, the centre X = sum |q_i| x_i / sum |q_i| and the second moment of those inside (and of the mesh force between points:
 * of two kernels of w cells, w/6 h^2 an axis):
 *     phi(x) = c Q Phi(x - X),  lap Phi = ball of radius R,  R^2 = (D + 2) (sigma^2 + w h^2/6),  sigma^2 = the second moment per open axis, D open axes.
 * So beyond R the force is that of a point, with an error of the order of (sigma/d)^2 at the distance d. In one dimension it is exact, and R = 0. Those inside
 * receive the reaction as a uniform field, grad sum_j c q_j Phi(X - x_j), so each its share by strength, and sum q_i grad phi_i = 0 to round-off. With
 * strengths of one sign X is the centre of the forces too, and the torques cancel. Particles outside do not act on each other.
 * Faces: along axes that are periodic or between neumann faces the mean remains (D falls by one, c is divided by the length); between walls, or wall and
 * neumann, the field decays exponentially: 0. A face opposite to an open one reflects: the images of the ball, not those of the particle itself.
 * Source: Hockney and Eastwood 1988, section 6-5 (isolated systems); Barnes and Hut 1986 for the monopole. Cost: a pass over the particles.
 * SPDX-License-Identifier: GPL-3.0-or-later */
#include <string.h>

#include "mollifier/mollifier.h"
#include "transfer/outside.h"
#include "transfer/transfer-axis.h"

static bool is_closed(enum pm_face face) { return face == PM_WALL || face == PM_NEUMANN; }
static bool is_open(const struct pm_grid *g, int d) { return g->face[d][0] != PM_PERIODIC && !(is_closed(g->face[d][0]) && is_closed(g->face[d][1])); }

bool pm_outside_open(const struct pm_grid *g)
{
	bool any = false;
	for (int d = 0; d < g->dim; d++)
		any |= is_open(g, d);
	return any;
}

static double length(const struct pm_grid *g, int d) { return (double)g->cells[d] * g->h[d]; }

/* Open axes, and what the others do to the coefficient. */
static void set_axes(struct pm_outside_force *o)
{
	const struct pm_grid *g = &o->transfer.grid;
	for (int d = 0; d < g->dim; d++) {
		const enum pm_face low = g->face[d][0], high = g->face[d][1];
		const bool even = low == PM_PERIODIC || (low == PM_NEUMANN && high == PM_NEUMANN);
		if (!is_open(g, d)) {
			o->coefficient *= even ? 1 / length(g, d) : 0;
			continue;
		}
		o->axis[o->open++] = d;
		const enum pm_face mirror = is_closed(low) ? low : high;
		o->image[d] = !is_closed(mirror) ? 0 : mirror == PM_WALL ? -1 : 1;
		o->plane[d] = is_closed(low) ? g->lo[d] : g->lo[d] + length(g, d);
	}
}

/* The sets whose names the field has as terms, or all that have the strength. */
static int sources_of(const struct pm_frame *f, const struct pm_law *law, const struct pm_field *made, struct pm_sets *sets)
{
	const char *const needs[] = {"x", law->strength, NULL};
	if (!made->nterms)
		return pm_sets_choose(f, NULL, needs, "p2m reads it", sets);
	sets->n = 0;
	for (int i = 0; i < made->nterms; i++) {
		struct pm_sets one;
		int status = pm_sets_choose(f, made->terms[i], needs, "p2m has read it", &one);
		if (status)
			return status;
		sets->name[sets->n++] = one.name[0];
	}
	return 0;
}

static bool has_sources(const struct pm_frame *f, const char *strength)
{
	for (size_t i = 0; i < f->nsets; i++)
		if (pm_frame_field(f, f->sets[i]->name, strength))
			return true;
	return false;
}

int pm_outside_init(struct pm_outside_force *o, const struct pm_frame *f, const struct pm_mesh *m, const struct pm_field *made)
{
	const struct pm_law *law = pm_law_of(f);
	*o = (struct pm_outside_force){.law = law};
	if (!law)
		return -PM_DATA;
	const struct pm_kernel *kernel = NULL;
	for (int i = 0; pm_kernel_names[i]; i++)
		if (!strcmp(pm_kernel_names[i], made->kernel))
			kernel = pm_kernel_find(made->kernel);
	o->transfer = (struct pm_transfer){.grid = pm_grid_of(f, m), .kernel = kernel, .components = 1, .rim = made->rim};
	const bool known = law->strength && !law->vector && law->coefficient && kernel && made->role == PM_DERIVED && has_sources(f, law->strength);
	if (!known || !pm_outside_open(&o->transfer.grid))
		return 0;
	o->strength = law->strength;
	o->coefficient = law->coefficient(f);
	o->charge = law->background ? pm_frame_constant(f, law->background, 0) : 0;
	set_axes(o);
	int status = sources_of(f, law, made, &o->sources);
	return status ? status : 1;
}

int pm_outside_reads(const struct pm_outside_force *o, struct pm_frame *f)
{
	int status = 0;
	for (size_t i = 0; i < o->sources.n && !status; i++)
		if (!(status = pm_reads_positions(f, o->sources.name[i])))
			status = pm_reads_strength(f, o->sources.name[i], o->strength);
	return status;
}

int pm_outside_any(const struct pm_frame *f, const char *set, const struct pm_transfer *t, bool *any)
{
	const size_t n = pm_frame_field(f, set, "x")->count;
	const double *x[3];
	struct pm_axis axes[3];
	pm_positions(f, set, x);
	*any = false;
	if (pm_axes_init(axes, t, t->staggered[0]))
		return -PM_DATA;
	for (size_t p = 0; p < n && !*any; p++)
		for (int d = 0; d < t->grid.dim; d++) {
			double u;
			*any |= !pm_axis_locate(&axes[d], x[d][p], &u);
		}
	pm_axes_free(axes);
	return 0;
}

int pm_outside_find(const struct pm_frame *f, const char *set, const struct pm_transfer *t, unsigned char *mask, struct pm_strays *closed)
{
	const struct pm_field *positions = pm_frame_field(f, set, "x");
	const size_t n = positions->count;
	const double *x[3];
	struct pm_axis axes[3];
	*closed = (struct pm_strays){.count = 0};
	pm_positions(f, set, x);
	if (pm_axes_init(axes, t, t->staggered[0]))
		return -PM_DATA;
	for (size_t p = 0; p < n; p++) {
		bool out = false;
		int wall = -1;
		double u;
		for (int d = 0; d < t->grid.dim; d++)
			if (!pm_axis_locate(&axes[d], x[d][p], &u)) {
				const bool above = (x[d][p] - axes[d].lo) / axes[d].h > axes[d].high;
				out = true;
				wall = wall < 0 && is_closed(t->grid.face[d][above]) ? d : wall;
			}
		if (mask)
			mask[p] = out;
		if (wall >= 0)
			pm_strays_note(closed, p, t->grid.dim, x, wall);
	}
	closed->first += positions->first;
	pm_axes_free(axes);
	return 0;
}

void pm_outside_pair(const struct pm_outside_force *o, const double at[3], const double from[3], double radius, double *potential, double gradient[3])
{
	const struct pm_mollifier *m = pm_mollifier_find(o->open == 1 ? "none" : "rankine");
	*potential = gradient[0] = gradient[1] = gradient[2] = 0;
	for (int image = 0; image < 8; image++) {
		double r[3] = {0}, r2 = 0, sign = o->coefficient;
		for (int d = 0; d < 3; d++)
			sign *= image >> d & 1 ? o->image[d] : 1;
		for (int k = 0; k < o->open; k++) {
			const int d = o->axis[k];
			r[d] = at[d] - (image >> d & 1 ? 2 * o->plane[d] - from[d] : from[d]);
			r2 += r[d] * r[d];
		}
		if (sign == 0)
			continue;
		const double force = sign * m->force(r2, radius, o->open);
		*potential += sign * m->potential(r2, radius, o->open);
		for (int d = 0; d < 3; d++)
			gradient[d] += force * r[d];
	}
}

void pm_outside_at(const struct pm_outside_force *o, const double x[3], double *potential, double gradient[3])
{
	const struct pm_outside_ball *const balls[] = {&o->inside, &o->background};
	*potential = gradient[0] = gradient[1] = gradient[2] = 0;
	for (int b = 0; b < 2; b++) {
		double phi, g[3];
		if (balls[b]->strength == 0)
			continue;
		pm_outside_pair(o, x, balls[b]->centre, balls[b]->radius, &phi, g);
		*potential += balls[b]->strength * phi;
		for (int d = 0; d < 3; d++)
			gradient[d] += balls[b]->strength * g[d];
	}
}
