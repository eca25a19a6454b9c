/* Walls in a flow of vortices in space: the triangles feel the given stream and all vortices at their centroids, move all particles, and stretch vortices:
 * dalpha += (alpha . grad) u of a flow without vorticity, in which all forms of the term are one.
 * The vortices are summed at the centroids as u = -1/(4 pi) r cross alpha/(r^2 + delta^2)^(3/2), Rosenhead and Moore's core (pp --mollifier plummer).
 * Cost: panels times particles, twice. SPDX-License-Identifier: GPL-3.0-or-later */
#include <stdio.h>
#include <string.h>

#include "law/law.h"
#include "panels/surface-frame.h"
#include "panels/triangles.h"
#include "stream/declare.h"
#include "transfer/transfer-frame.h"

enum { corners = 9 };

static const struct pm_field *vortices(const struct pm_frame *f, const struct pm_set *set)
{
	const struct pm_field *alpha = pm_frame_field(f, set->name, "alpha"), *x = pm_frame_field(f, set->name, "x");
	return alpha && x && alpha->role == PM_STATE && alpha->components == 3 ? alpha : NULL;
}

/* 20 m^2 panels. */
static size_t parts(size_t n) { return (size_t)lround(sqrt((double)n / 20)); }

static int check(const struct pm_panels_choice *c, const struct pm_frame *f)
{
	const struct pm_law *law = pm_law_of(f);
	if (!law)
		return -PM_DATA;
	if (!law->change || strcmp(law->change, "vel"))
		return pm_fail(PM_DATA, "panels are walls in a flow (law vortex or passive), and this frame is of the law '%s'", law->name);
	if (c->curve)
		return pm_fail(PM_USAGE, "--curve is a wall in the plane, and this frame is in 3-D (--surface 'x, y, z')");
	if (!c->source || c->circulation != 0)
		return pm_fail(PM_USAGE, "walls in space are of sources, which have no circulation (without --kind vortex and --circulation)");
	for (int a = 0; a < 6; a++)
		if (f->face[a / 2][a % 2] != PM_OPEN)
			return pm_fail(PM_DATA, "the box is %s along %c, but panels are in open space (smod --faces open)",
				pm_face_names[f->face[a / 2][a % 2]], "xyz"[a / 2]);
	const size_t m = parts(c->n);
	if (c->surface && (c->n < 20 || 20 * m * m != c->n))
		return pm_fail(PM_USAGE, "%zu triangles do not divide a sphere evenly: 20 m^2 do (-n %zu or %zu)", c->n, 20 * (m ? m : 1) * (m ? m : 1),
			20 * (m + 1) * (m + 1));
	return 0;
}

static int declare_panels(const struct pm_panels_choice *c, struct pm_frame *f)
{
	static const struct {
		const char *name, *unit;
		int components;
		enum pm_role role;
	} makes[] = {{"corners", "length", corners, PM_STATE}, {"x", "length", 3, PM_STATE}, {"normal", "", 3, PM_DERIVED}, {"area", "length^2", 1, PM_DERIVED},
		{"source", "length/time", 1, PM_DERIVED}};
	struct pm_set *set = pm_frame_set(f, c->name);
	if (set && c->surface && (!pm_frame_field(f, c->name, "corners") || set->n != c->n))
		return pm_fail(PM_DATA, "the set '%s' is there, of other panels or of particles (--panels NAME, or without --surface)", c->name);
	if (!set && !c->surface)
		return pm_fail(PM_USAGE, "no --surface, and no set '%s' with 'corners' (--surface 'x, y, z' is the unit sphere)", c->name);
	if (!set && !(set = pm_frame_set_new(f, c->name, c->n)))
		return -PM_DATA;
	set->fixed = true;
	for (int k = 0; k < 5; k++) {
		struct pm_field *field = !c->surface && k == 0 ? pm_reads(f, c->name, "corners") :
			pm_makes(f, c->name, makes[k].name, makes[k].components, makes[k].role);
		if (!field)
			return -PM_DATA;
		if (field->components != makes[k].components || field->type != PM_F64)
			return pm_fail(PM_DATA, "'corners' on '%s' must be 9 real numbers a panel: x, y, z of three corners", c->name);
		if (c->surface || k)
			snprintf(field->unit, sizeof field->unit, "%s", makes[k].unit);
	}
	return 0;
}

int pm_surface_declare(const struct pm_panels_choice *c, struct pm_frame *f, struct pm_panels_job *job)
{
	size_t found = 0;
	int status = check(c, f);
	if (!status)
		status = declare_panels(c, f);
	for (size_t i = 0; i < f->nsets && !status; i++) {
		const char *on = f->sets[i]->name;
		const struct pm_field *alpha = vortices(f, f->sets[i]);
		const bool moves = strcmp(on, c->name) && pm_panels_moves(c, f, f->sets[i]);
		if (!strcmp(on, c->name) || (!alpha && !moves))
			continue;
		if (!pm_reads(f, on, "x") || (alpha && !pm_reads(f, on, "alpha")))
			return -PM_DATA;
		if (alpha && pm_frame_field(f, on, "volume") && !pm_reads(f, on, "volume"))
			return -PM_DATA;
		if (moves && !pm_contributes(f, on, "vel", "x", 3, "panels", c->replace))
			return -PM_DATA;
		if (moves && alpha && !pm_contributes(f, on, "dalpha", "alpha", 3, "panels", c->replace))
			return -PM_DATA;
		found += moves;
	}
	if (!status && !found)
		status = pm_fail(PM_DATA, "no particles%s%s that a flow could move (sls lists the sets)", c->set ? " in the set " : "", c->set ? c->set : "");
	if (!status)
		status = pm_panels_vector(&job->curve, f, c->name, c->surface, "surface");
	if (!status)
		status = pm_panels_vector(&job->velocity, f, c->name, c->velocity, "velocity");
	return status ? status : pm_panels_vector(&job->stream, f, c->name, c->stream, "stream");
}

/* The expressions at the corners of the divided sphere, which are x in them. */
static int shape(const struct pm_panels_choice *c, struct pm_frame *f, const struct pm_panels_job *job, struct pm_triangles *t)
{
	struct pm_field *field = pm_frame_field(f, c->name, "corners");
	const size_t n = t->n;
	double *sphere = c->surface ? pm_alloc(corners * n + 1, sizeof *sphere) : NULL, *at[corners];
	for (int k = 0; k < corners; k++)
		t->corner[k] = c->surface ? pm_out(field, k) : (double *)(uintptr_t)pm_in(field, k); /* only read without --surface */
	if (!c->surface)
		return 0;
	if (!sphere)
		return -PM_DATA;
	for (int k = 0; k < corners; k++)
		at[k] = sphere + (size_t)k * n;
	pm_triangles_sphere(parts(n), at);
	for (int k = 0; k < 3; k++) {
		for (int d = 0; d < 3; d++)
			memcpy(t->x[d], at[3 * k + d], n * sizeof *sphere);
		for (int d = 0; d < 3; d++)
			pm_expression_eval(&job->curve, f, d, n, t->corner[3 * k + d]);
	}
	pm_free(sphere);
	return 0;
}

/* The core of the vortices, squared. */
static double core2(const struct pm_panels_choice *c, const struct pm_frame *f, const double *volume, size_t j)
{
	const double given = isnan(c->softening) ? pm_frame_constant(f, "softening", NAN) : c->softening, side = isnan(given) && volume ? cbrt(volume[j]) : 0;
	return !isnan(given) ? given * given : side * side;
}

static void add_vortices(const struct pm_panels_choice *c, const struct pm_frame *f, const struct pm_triangles *t, double *normal)
{
	for (size_t k = 0; k < f->nsets; k++) {
		const struct pm_field *alpha = strcmp(f->sets[k]->name, c->name) ? vortices(f, f->sets[k]) : NULL;
		const struct pm_field *volume = alpha ? pm_frame_field(f, f->sets[k]->name, "volume") : NULL;
		const size_t n = f->sets[k]->n;
		const double *x[3], *a[3], *v = volume ? pm_in(volume, 0) : NULL;
		if (!alpha)
			continue;
		pm_positions(f, f->sets[k]->name, x);
		for (int d = 0; d < 3; d++)
			a[d] = pm_in(alpha, d);
#pragma omp parallel for schedule(static) if (n * t->n > 4096)
		for (size_t i = 0; i < t->n; i++) {
			double sum = 0;
			for (size_t j = 0; j < n; j++) {
				const double r[3] = {t->x[0][i] - x[0][j], t->x[1][i] - x[1][j], t->x[2][i] - x[2][j]};
				const double r2 = r[0] * r[0] + r[1] * r[1] + r[2] * r[2] + core2(c, f, v, j), w = r2 > 0 ? 1 / (4 * pm_pi * r2 * sqrt(r2)) : 0;
				sum += w * (t->normal[0][i] * (a[1][j] * r[2] - a[2][j] * r[1]) + t->normal[1][i] * (a[2][j] * r[0] - a[0][j] * r[2]) +
					t->normal[2][i] * (a[0][j] * r[1] - a[1][j] * r[0]));
			}
			normal[i] += sum;
		}
	}
}

/* Of an expression, the part along the normals. */
static void add_given(const struct pm_expression *e, const struct pm_frame *f, const struct pm_triangles *t, double sign, double *work, double *normal)
{
	for (int d = 0; d < 3; d++) {
		pm_expression_eval(e, f, d, t->n, work);
		for (size_t i = 0; i < t->n; i++)
			normal[i] += sign * work[i] * t->normal[d][i];
	}
}

static int move(const struct pm_panels_choice *c, struct pm_frame *f, const struct pm_triangles *t, const double *strength)
{
	int status = 0;
	for (size_t k = 0; k < f->nsets && !status; k++) {
		const char *on = f->sets[k]->name;
		if (!strcmp(on, c->name) || !pm_panels_moves(c, f, f->sets[k]))
			continue;
		const struct pm_field *alpha = vortices(f, f->sets[k]);
		struct pm_field *vel = pm_frame_field(f, on, "vel"), *change = alpha ? pm_frame_field(f, on, "dalpha") : NULL;
		struct pm_triangles_at at = {.n = f->sets[k]->n};
		pm_positions(f, on, at.x);
		for (int d = 0; d < 3; d++) {
			at.u[d] = pm_out(vel, d);
			if (alpha)
				at.alpha[d] = pm_in(alpha, d), at.change[d] = pm_out(change, d);
		}
		status = pm_triangles_at(t, strength, &at);
	}
	return status;
}

int pm_surface_apply(const struct pm_panels_choice *c, struct pm_frame *f, const struct pm_panels_job *job, struct pm_panels_solver *solver,
	struct pm_panels_solved *done)
{
	struct pm_triangles t = {.n = pm_frame_set(f, c->name)->n};
	double *work = pm_zalloc(3 * t.n + 1, sizeof *work), *normal = work + t.n, *total = work + 2 * t.n;
	double *strength = pm_out(pm_frame_field(f, c->name, "source"), 0);
	t.surface = pm_zalloc(t.n + 1, sizeof *t.surface);
	t.area = pm_out(pm_frame_field(f, c->name, "area"), 0);
	for (int d = 0; d < 3; d++)
		t.x[d] = pm_out(pm_frame_field(f, c->name, "x"), d), t.normal[d] = pm_out(pm_frame_field(f, c->name, "normal"), d);
	int status = work && t.surface ? shape(c, f, job, &t) : -PM_DATA;
	if (!status)
		status = pm_triangles_measure(&t);
	if (!status) {
		if (c->velocity)
			add_given(&job->velocity, f, &t, -1, work, normal);
		for (size_t i = 0; i < t.n; i++) /* sources give out what a wall that grows displaces */
			total[t.surface[i]] -= normal[i] * t.area[i];
		if (c->stream)
			add_given(&job->stream, f, &t, 1, work, normal);
		add_vortices(c, f, &t, normal);
		status = pm_triangles_solve(&t, normal, total, solver, strength, done);
	}
	if (!status)
		status = move(c, f, &t, strength);
	pm_free(work), pm_free(t.surface);
	return status;
}
