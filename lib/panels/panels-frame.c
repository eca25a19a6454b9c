/* Walls in a flow of vortices in the plane: the panels feel the given stream and all vortices, and move all particles.
 * The vortices are summed at the midpoints as u = Gamma/(2 pi) (-y, x)/(r^2 + delta^2), Krasny's, which pp sums for the particles.
 * Cost: panels times particles, twice. SPDX-License-Identifier: GPL-3.0-or-later */
#include <stdio.h>
#include <string.h>

#include "law/law.h"
#include "panels/panels-frame.h"
#include "stream/declare.h"

bool pm_panels_moves(const struct pm_panels_choice *c, const struct pm_frame *f, const struct pm_set *set)
{
	return pm_set_moves(f, set) && strcmp(set->name, c->name) && (!c->set || !strcmp(c->set, set->name)) && !pm_frame_field(f, set->name, "v");
}

static const struct pm_field *vortices(const struct pm_frame *f, const struct pm_set *set, const char *field)
{
	const struct pm_field *q = pm_frame_field(f, set->name, field), *x = pm_frame_field(f, set->name, "x");
	return q && x && q->role == PM_STATE ? q : NULL;
}

int pm_panels_vector(struct pm_expression *e, struct pm_frame *f, const char *on, const char *text, const char *option)
{
	int status = text ? pm_expression_compile(e, f, on, text) : 0;
	return status || !text || e->nparts == f->dim ? status : pm_fail(PM_USAGE, "--%s '%s' has %d components, and %s has %d (with a comma between)",
		option, text, e->nparts, f->dim == 2 ? "the plane" : "space", f->dim);
}

static int declare_set(const struct pm_panels_choice *c, struct pm_frame *f)
{
	static const struct {
		const char *name;
		int components;
	} makes[] = {{"s", 1}, {"corners", 4}, {"x", 2}, {"normal", 2}, {"area", 1}}; /* of a panel in the plane: a length */
	struct pm_set *set = pm_frame_set(f, c->name);
	if (set && c->curve && (!pm_frame_field(f, c->name, "corners") || set->n != c->n))
		return pm_fail(PM_DATA, "the set '%s' is there, of other panels or of particles (--panels NAME, or without --curve)", c->name);
	if (!set && !c->curve)
		return pm_fail(PM_USAGE, "no --curve, and no set '%s' with 'corners' (--curve 'cos(2*pi*s), sin(2*pi*s)')", c->name);
	if (!set && !(set = pm_frame_set_new(f, c->name, c->n)))
		return -PM_DATA;
	set->fixed = true;
	for (int k = c->curve ? 0 : 1; k < 5; k++) {
		struct pm_field *field = !c->curve && k == 1 ? pm_reads(f, c->name, "corners") :
			pm_makes(f, c->name, makes[k].name, makes[k].components, k == 1 || k == 2 ? PM_STATE : PM_DERIVED);
		if (!field)
			return -PM_DATA;
		if (field->components != makes[k].components || field->type != PM_F64)
			return pm_fail(PM_DATA, "'corners' on '%s' must be 4 real numbers a panel: x, y of its beginning, x, y of its end", c->name);
		if (k && k != 3)
			snprintf(field->unit, sizeof field->unit, "length");
	}
	struct pm_field *strength = pm_makes(f, c->name, c->source ? "source" : "sheet", 1, PM_DERIVED);
	if (!strength)
		return -PM_DATA;
	snprintf(strength->unit, sizeof strength->unit, "length/time");
	return 0;
}

int pm_panels_declare_wall(const struct pm_panels_choice *c, struct pm_frame *f, struct pm_panels_job *job)
{
	for (int a = 0; a < 4; a++)
		if (f->face[a / 2][a % 2] != PM_OPEN)
			return pm_fail(PM_DATA, "the box is %s along %c, but panels are in open space (smod --faces open)",
				pm_face_names[f->face[a / 2][a % 2]], "xy"[a / 2]);
	int status = declare_set(c, f);
	if (!status)
		status = pm_panels_vector(&job->curve, f, c->name, c->curve, "curve");
	if (!status)
		status = pm_panels_vector(&job->velocity, f, c->name, c->velocity, "velocity");
	return status ? status : pm_panels_vector(&job->stream, f, c->name, c->stream, "stream");
}

int pm_panels_declare(const struct pm_panels_choice *c, struct pm_frame *f, struct pm_panels_job *job)
{
	const struct pm_law *law = pm_law_of(f);
	size_t found = 0;
	if (!law)
		return -PM_DATA;
	if (f->dim != 2 || !law->change || strcmp(law->change, "vel"))
		return pm_fail(PM_DATA, "panels are walls in a plane flow (law vortex or passive), and this frame is of the law '%s' in %d-D", law->name,
			f->dim);
	int status = pm_panels_declare_wall(c, f, job);
	if (status)
		return status;
	for (size_t i = 0; i < f->nsets; i++) {
		const char *on = f->sets[i]->name;
		if (!strcmp(on, c->name))
			continue;
		if (vortices(f, f->sets[i], "circulation") && (!pm_reads(f, on, "circulation") || !pm_reads(f, on, "x")))
			return -PM_DATA;
		if (vortices(f, f->sets[i], "circulation") && vortices(f, f->sets[i], "volume") && !pm_reads(f, on, "volume"))
			return -PM_DATA;
		if (!pm_panels_moves(c, f, f->sets[i]))
			continue;
		if (!pm_reads(f, on, "x") || !pm_contributes(f, on, "vel", "x", 2, "panels", c->replace))
			return -PM_DATA;
		found++;
	}
	if (!found)
		return pm_fail(PM_DATA, "no particles%s%s that a flow could move (sls lists the sets)", c->set ? " in the set " : "", c->set ? c->set : "");
	return 0;
}

static int corners(const struct pm_panels_choice *c, struct pm_frame *f, const struct pm_panels_job *job, struct pm_panels *p)
{
	struct pm_field *field = pm_frame_field(f, c->name, "corners"), *s = pm_frame_field(f, c->name, "s");
	const size_t n = p->n;
	for (int k = 0; k < 4; k++)
		p->corner[k] = c->curve ? pm_out(field, k) : (double *)(uintptr_t)pm_in(field, k); /* only read without --curve */
	if (!c->curve)
		return 0;
	for (int d = 0; d < 2; d++) { /* the end is that of s = 1, which must be the beginning */
		for (size_t i = 0; i < n; i++)
			pm_out(s, 0)[i] = (double)(i + 1) / (double)n;
		pm_expression_eval(&job->curve, f, d, n, p->corner[2 + d]);
		for (size_t i = 0; i < n; i++)
			pm_out(s, 0)[i] = (double)i / (double)n;
		pm_expression_eval(&job->curve, f, d, n, p->corner[d]);
	}
	const double gap = hypot(p->corner[2][n - 1] - p->corner[0][0], p->corner[3][n - 1] - p->corner[1][0]);
	if (!(gap <= 1e-9 * hypot(p->corner[2][n / 2] - p->corner[0][0], p->corner[3][n / 2] - p->corner[1][0])))
		return pm_fail(PM_DATA, "--curve '%s' is not closed: s = 1 is %g away from s = 0 (2*pi*s in place of s?)", c->curve, gap);
	return 0;
}

int pm_panels_wall(const struct pm_panels_choice *c, struct pm_frame *f, const struct pm_panels_job *job, struct pm_panels *p)
{
	p->length = pm_out(pm_frame_field(f, c->name, "area"), 0);
	for (int d = 0; d < 2; d++)
		p->x[d] = pm_out(pm_frame_field(f, c->name, "x"), d), p->normal[d] = pm_out(pm_frame_field(f, c->name, "normal"), d);
	const int status = corners(c, f, job, p);
	return status ? status : pm_panels_measure(p);
}

/* The core of the vortices, squared. */
static double core2(const struct pm_panels_choice *c, const struct pm_frame *f, const struct pm_field *volume, size_t j)
{
	const double given = isnan(c->softening) ? pm_frame_constant(f, "softening", NAN) : c->softening;
	return !isnan(given) ? given * given : volume ? pm_in(volume, 0)[j] : 0;
}

static void add_vortices(const struct pm_panels_choice *c, const struct pm_frame *f, const struct pm_panels *p, double *const u[2])
{
	for (size_t k = 0; k < f->nsets; k++) {
		const char *on = f->sets[k]->name;
		const struct pm_field *q = vortices(f, f->sets[k], "circulation"), *volume = vortices(f, f->sets[k], "volume");
		if (!q || !strcmp(on, c->name))
			continue;
		const double *gamma = pm_in(q, 0), *x = pm_in(pm_frame_field(f, on, "x"), 0), *y = pm_in(pm_frame_field(f, on, "x"), 1);
		if (volume)
			pm_field_bring(volume);
		const size_t n = f->sets[k]->n;
#pragma omp parallel for schedule(static) if (n * p->n > 4096)
		for (size_t i = 0; i < p->n; i++) {
			double sum[2] = {0};
			for (size_t j = 0; j < n; j++) {
				const double dx = p->x[0][i] - x[j], dy = p->x[1][i] - y[j], r2 = dx * dx + dy * dy + core2(c, f, volume, j);
				const double w = r2 > 0 ? gamma[j] / (2 * pm_pi * r2) : 0;
				sum[0] -= w * dy, sum[1] += w * dx;
			}
			u[0][i] += sum[0], u[1][i] += sum[1];
		}
	}
}

void pm_panels_add_given(const struct pm_expression *e, const struct pm_frame *f, size_t n, double sign, double *work, double *const u[2])
{
	for (int d = 0; d < 2; d++) {
		pm_expression_eval(e, f, d, n, work);
		for (size_t i = 0; i < n; i++)
			u[d][i] += sign * work[i];
	}
}

/* What the wall does to the totals: sources give out what a wall that grows displaces; a sheet cannot follow a wall that turns. */
static int totals(const struct pm_panels_choice *c, const struct pm_panels *p, double *const wall[2], double *sum)
{
	double along = 0, most = 0;
	for (size_t k = 0; k < p->curves; k++)
		sum[k] = c->source ? 0 : c->circulation;
	for (size_t i = 0; i < p->n; i++) {
		if (c->source)
			sum[p->curve[i]] -= (wall[0][i] * p->normal[0][i] + wall[1][i] * p->normal[1][i]) * p->length[i];
		along += (-wall[0][i] * p->normal[1][i] + wall[1][i] * p->normal[0][i]) * p->length[i];
		most += hypot(wall[0][i], wall[1][i]) * p->length[i];
	}
	if (!c->source && fabs(along) > 1e-9 * most)
		return pm_fail(PM_USAGE, "the --velocity has the circulation %g along the wall: no sheet can follow that (--kind source)",
			-along);
	return 0;
}

int pm_panels_apply(const struct pm_panels_choice *c, struct pm_frame *f, const struct pm_panels_job *job, struct pm_panels_solver *solver,
	struct pm_panels_solved *done)
{
	struct pm_panels p = {.n = pm_frame_set(f, c->name)->n, .source = c->source};
	const size_t n = p.n;
	double *work = pm_zalloc(6 * n + 1, sizeof *work), *u[2] = {work, work + n}, *wall[2] = {work + 2 * n, work + 3 * n};
	double *strength = pm_out(pm_frame_field(f, c->name, c->source ? "source" : "sheet"), 0);
	struct pm_panels_flow flow = {.u = {u[0], u[1]}, .total = work + 4 * n};
	p.curve = pm_zalloc(n + 1, sizeof *p.curve);
	if (!work || !p.curve) {
		pm_free(work), pm_free(p.curve);
		return -PM_DATA;
	}
	int status = pm_panels_wall(c, f, job, &p);
	if (!status && c->velocity)
		pm_panels_add_given(&job->velocity, f, n, -1, work + 5 * n, wall);
	if (!status)
		status = totals(c, &p, wall, work + 4 * n);
	if (!status) {
		memcpy(u[0], wall[0], 2 * n * sizeof *work);
		if (c->stream)
			pm_panels_add_given(&job->stream, f, n, 1, work + 5 * n, u);
		add_vortices(c, f, &p, u);
		status = pm_panels_solve(&p, &flow, solver, strength, done);
	}
	for (size_t k = 0; k < f->nsets && !status; k++)
		if (pm_panels_moves(c, f, f->sets[k])) {
			struct pm_field *x = pm_frame_field(f, f->sets[k]->name, "x"), *vel = pm_frame_field(f, f->sets[k]->name, "vel");
			const double *at[2] = {pm_in(x, 0), pm_in(x, 1)};
			double *to[2] = {pm_out(vel, 0), pm_out(vel, 1)};
			pm_panels_at(&p, strength, f->sets[k]->n, at, to);
		}
	pm_free(work), pm_free(p.curve);
	return status;
}
