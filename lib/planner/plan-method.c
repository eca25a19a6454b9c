/* How the effects of a plan are computed: pairs or a mesh, and by the measured atlas kernel, gradient and cells. SPDX-License-Identifier: GPL-3.0-or-later */
#include <string.h>

#include "effect-parts/effect-decision.h"
#include "far/pp-frame.h"
#include "planner/force-error.h"
#include "planner/plan.h"

/* Nanoseconds of one core: a pair of pp (data/atlas/force.tsv: 7815 for each of 20000); a point of the transform's mesh with all work on it, a particle
 * to the mesh and back (docs/speed.md). */
static const double ns_pair = 0.39, ns_point = 5, ns_particle = 100;

static double cost_pairs(const struct pm_scales *s) { return ns_pair * s->n * s->sources; }

double pm_plan_cost_mesh(const struct pm_scales *s) { return ns_point * s->points * (s->open ? pow(2, s->dim) : 1) + ns_particle * s->n; }

double pm_plan_force_seconds(const struct pm_scales *s) { return 1e-9 * (s->pairs ? cost_pairs(s) : pm_plan_cost_mesh(s)); }

static bool all_open(const struct pm_scales *s) { return s->open && !s->periodic && !s->walls; }

/* The period of a row of softened point vortices whose images pp sums, without a wall beside it; 0: another box. */
static double row_period(const struct pm_frame *f, const struct pm_scales *s)
{
	const int axis = pm_pp_periodic_axis(f);
	return axis >= 0 && f->face[!axis][0] == PM_OPEN && f->face[!axis][1] == PM_OPEN && s->kind == PM_VORTICES ? f->hi[axis] - f->lo[axis] : 0;
}

/* pp softens the sum over the row, cosh ky - cos kx + (k delta)^2/2 (Krasny); a mesh adds softened images, cosh k(y^2 + delta^2)^(1/2) - cos kx: near a vortex
 * the two differ by this part. */
static double row_error(double period, double softening) { return period > 0 ? pow(2 * pm_pi * softening / period, 2) / 12 : 0; }

/* Vortices that represent a field: their volumes fill the mesh. */
static bool is_field(const struct pm_scales *s)
{
	return s->kind == PM_VORTICES && s->overlap < 0.3 && s->width > 0.7 * s->h && s->width < 1.4 * s->h;
}

/* pp sums in open space and over rows of point vortices; particles that represent a field need a mesh. */
static bool pairs(const struct pm_frame *f, const struct pm_plan *p, char why[160])
{
	const struct pm_scales *s = &p->scales;
	const bool field = is_field(s);
	const double a = cost_pairs(s), b = f->nmeshes ? pm_plan_cost_mesh(s) : HUGE_VAL, row = row_period(f, s);
	const bool sums = all_open(s) || row > 0, other = row_error(row, s->softening) > 0.5 * s->accuracy;
	if (!sums)
		snprintf(why, 160, "a %s box", s->periodic ? "periodic" : "walled");
	else if (p->law->vector)
		snprintf(why, 160, "vortices in space");
	else if (field)
		snprintf(why, 160, "the particles carry a field: their volumes fill the mesh to %.1g", s->overlap);
	else if (other)
		snprintf(why, 160, "the softening is that of a row, a mesh differs by %.1g", row_error(row, s->softening));
	else if (a <= b)
		snprintf(why, 160, "%g bodies, pairs cost %.1g of the mesh", s->sources, a / b);
	else
		snprintf(why, 160, "%g bodies, a mesh costs %.1g of the pairs", s->sources, b / a);
	return sums && !field && !p->law->vector && (other || a <= b);
}

void pm_plan_method(const struct pm_frame *f, struct pm_plan *p)
{
	struct pm_method *m = &p->method;
	const struct pm_scales *s = &p->scales;
	*m = (struct pm_method){.dt = NAN, .follow = NAN, .tolerance = NAN, .evaluations = NAN,
		.kernel = p->law->kernel, .order = p->law->order, .scheme = s->second ? "leapfrog" : "rk4"};
	m->pairs = !s->light && (s->kind == PM_MASSES || s->kind == PM_CHARGES || s->kind == PM_VORTICES) && pairs(f, p, m->why_far);
	p->scales.singular = s->kind == PM_VORTICES && f->nmeshes && !is_field(s) && !p->law->vector;
	/* A patch of vorticity stays together, so its mesh may follow it; bodies escape, and the mesh would grow with each: they keep p2m's monopole.
	 * 4: half the widest kernel. */
	m->grow = s->kind == PM_VORTICES && s->edge < 4 * s->h;
	if (s->kind == PM_VORTICES && !m->pairs) {
		m->kernel = "m6prime"; /* m4prime makes spurious vortices (VM-16) */
		m->scheme = "lsrk3";
	}
}

bool pm_plan_nodes(const struct pm_plan *p) { return p->scales.kind == PM_VORTICES && !p->scales.pairs && !p->scales.singular; }

/* ---- the mesh ---- */

struct try {
	const struct pm_atlas_force *row; /* solver, kernel, gradient */
	int factor;                       /* of the cells */
	double error;
};

static bool can(const struct pm_plan *p, const struct pm_atlas_force *r, const char *scene)
{
	return !strcmp(r->scene, scene) && !strncmp(r->solver, "poisson-fft", 11) && (!p->scales.open || strcmp(r->gradient, "spectral"));
}

/* Of the rows that reach the accuracy with `factor` times the cells and cost at most 1.5 times the cheapest of them, the most accurate: smaller differences
 * are timing noise of the atlas. If none reaches it, the most accurate of all. */
static struct try best(const struct pm_plan *p, const char *scene, double h, int factor)
{
	struct try found = {NULL, factor, HUGE_VAL};
	double least = HUGE_VAL;
	for (int pass = 0; pass < 2; pass++)
		for (const struct pm_atlas_force *r = pm_atlas_forces; r->scene; r++) {
			const double e = can(p, r, scene) ? pm_force_error(&p->scales, r, h, factor) : NAN;
			if (!pass && e <= pm_force_allowed(&p->scales))
				least = fmin(least, r->ns);
			else if (pass && e < found.error && (least == HUGE_VAL || (e <= pm_force_allowed(&p->scales) && r->ns <= 1.5 * least)))
				found = (struct try){r, factor, e};
		}
	return found;
}

static double room(const struct pm_scales *s, int factor) { return s->points * pow(factor * (s->open ? 2 : 1), s->dim); }

/* The law's defaults if they are accurate enough; else the choice of the atlas, with as few cells as possible. */
static struct try mesh_try(const struct pm_plan *p, const char *scene, double h)
{
	const struct pm_scales *s = &p->scales;
	char solver[64] = "poisson-fft";
	struct try least = {NULL, 1, HUGE_VAL};
	if (strcmp(p->law->symbol, "spectral"))
		snprintf(solver, sizeof solver, "poisson-fft --symbol %s", p->law->symbol);
	for (const struct pm_atlas_force *r = pm_atlas_forces; r->scene; r++)
		if (can(p, r, scene) && !strcmp(r->solver, solver) && !strcmp(r->kernel, p->law->kernel) && !strcmp(r->gradient, p->law->order))
			least = (struct try){r, 1, pm_force_error(s, r, h, 1)};
	for (int factor = 1; factor <= 8 && !(least.error <= pm_force_allowed(s)) && (factor == 1 || room(s, factor) < 3e7); factor *= 2) {
		const struct try t = best(p, scene, h, factor);
		if (t.row && t.error < 0.8 * least.error) /* more cells only if they reduce the error */
			least = t;
	}
	return least;
}

/* The particles are the nodes of the mesh, so its spacing is fixed; what remeshing costs is the effect remeshing-loss. */
static void vortex_mesh(struct pm_plan *p)
{
	struct pm_scales *s = &p->scales;
	const double hk = s->h * sqrt(s->rough);
	s->mesh_error = pm_atlas_force_error(p->law->vector ? "vortex" : "smooth", "poisson-fft", p->method.kernel, "6", hk);
	s->length = 1 / sqrt(s->rough);
	snprintf(p->method.why_mesh, sizeof p->method.why_mesh, "h k = %.2g, error of the velocity %.1g", hk, s->mesh_error);
}

/* Softened point vortices, m6prime, order 6, --green plummer: error of the velocity against pp of pinit point-vortices -n 20000 by softening/h, from
 * p2m --kernel m6prime --rim 2 -n 128, 256, 512, 1024 | poisson-fft --green plummer | mgrad | m2p; the log of the error is taken as linear in that of h. */
static double point_error(double ratio)
{
	static const double at[] = {0.64, 1.28, 2.56, 5.12}, error[] = {0.12, 0.027, 0.0023, 8e-5};
	int i = 0;
	while (i < 2 && ratio > at[i + 1])
		i++;
	return fmin(1, error[i] * pow(ratio / at[i], log(error[i + 1] / error[i]) / log(2)));
}

static void point_vortices(const struct pm_frame *f, struct pm_plan *p)
{
	struct pm_method *m = &p->method;
	struct pm_scales *s = &p->scales;
	const double row = row_period(f, s);
	int factor = 1;
	while (factor < 64 && point_error(factor * s->softening / s->h) > s->accuracy && room(s, 2 * factor) < 3e7)
		factor *= 2;
	const double error = s->softening > 0 ? fmax(point_error(factor * s->softening / s->h), row_error(row, s->softening)) : 1;
	factor = s->softening > 0 ? factor : 1;
	s->h /= factor, s->points *= pow(factor, s->dim);
	const double dearer = cost_pairs(s) / pm_plan_cost_mesh(s);
	if ((all_open(s) || row > 0) && (dearer <= 1 || (error > s->accuracy && dearer < 20))) {
		m->pairs = s->pairs = true;
		snprintf(m->why_far, sizeof m->why_far, "%g point vortices, the error of a mesh would be %.1g; pairs cost %.2g times as much", s->sources,
			error, dearer);
		return;
	}
	for (int d = 0; d < f->dim && factor > 1; d++)
		m->cells[d] = (size_t)factor * f->meshes[0]->cells[d];
	s->mesh_error = error;
	snprintf(m->why_mesh, sizeof m->why_mesh, "point vortices, softening/h = %.2g: error %.1g%s", s->softening / s->h, error,
		error > s->accuracy ? ", more than asked for" : "");
}

/* Enough cells that the nearest pair is several cells apart (lib/effect/near-field.c), beyond 8 times as many of the frame up to 160 an axis in 3-D. */
void pm_plan_few_bodies(const struct pm_frame *f, struct pm_plan *p)
{
	struct pm_scales *s = &p->scales;
	const double near = s->dim == 1 ? s->spacing : s->nearest; /* the force of sheets does not depend on their distance */
	const double apart = s->softening > 0 ? hypot(near, s->softening) : near;
	int factor = 1;
	if (s->pairs || s->light || !f->nmeshes || !(s->n < 32) || (s->kind != PM_MASSES && s->kind != PM_CHARGES))
		return;
	while (0.25 * pow(s->h / (factor * apart), 2) > 0.5 * s->accuracy && room(s, 2 * factor) < (factor < 8 ? 3e7 : 4.2e6))
		factor *= 2;
	for (int d = 0; d < f->dim && factor > 1; d++)
		p->method.cells[d] = (size_t)factor * f->meshes[0]->cells[d];
	s->h /= factor, s->points *= pow(factor, s->dim);
	snprintf(p->method.why_mesh, sizeof p->method.why_mesh, "the nearest pair is %.2g cells apart", s->nearest / s->h);
}

void pm_plan_mesh(const struct pm_frame *f, struct pm_plan *p)
{
	struct pm_method *m = &p->method;
	struct pm_scales *s = &p->scales;
	const char *scene = all_open(s) ? "clustered" : "smooth";
	if (s->wave > 0 && s->kind != PM_VORTICES)
		/* a coarse mesh folds short waves onto long ones, and the beams of a quiet start onto waves that the density has not */
		s->length = pm_effect_quiet(s) ? s->wave_length : fmin(s->length, s->wave_length);
	const double h = s->h / s->length;
	if (m->pairs || s->light || !f->nmeshes || !(s->length > 0))
		return;
	if (s->kind == PM_VORTICES) {
		if (s->singular)
			point_vortices(f, p);
		else
			vortex_mesh(p);
		return;
	}
	if (s->n < 32)
		return; /* pm_plan_few_bodies */
	if (pm_effect_round_off(s)) { /* no field, so no length of it */
		snprintf(m->why_mesh, sizeof m->why_mesh, "%s: forces cancel on the mesh of the frame", m->kernel);
		return;
	}
	const struct try t = mesh_try(p, scene, h);
	if (!t.row)
		return;
	s->h /= t.factor, s->points *= pow(t.factor, s->dim);
	const double dearer = cost_pairs(s) / pm_plan_cost_mesh(s);
	if (t.error > pm_force_allowed(s) && all_open(s) && dearer < 20) {
		m->pairs = s->pairs = true;
		snprintf(m->why_far, sizeof m->why_far, "%g bodies, the error of a mesh would be %.1g; pairs cost %.2g times as much",
			s->sources, t.error, dearer);
		return;
	}
	s->mesh_error = t.error;
	m->kernel = t.row->kernel, m->order = t.row->gradient;
	const char *symbol = strstr(t.row->solver, "--symbol ") ? strstr(t.row->solver, "--symbol ") + 9 : "spectral";
	m->symbol = strcmp(symbol, p->law->symbol) ? symbol : NULL;
	for (int d = 0; d < f->dim && t.factor > 1; d++)
		m->cells[d] = (size_t)t.factor * f->meshes[0]->cells[d];
	snprintf(m->why_mesh, sizeof m->why_mesh, "%s: force error %.1g at h = %.2g of the length scale%s", m->kernel, t.error, s->h / s->length,
		t.error > pm_force_allowed(s) ? ", more than asked for" : "");
}
