/* How the effects of a plan are computed: pairs or a mesh, and by the measured atlas kernel, gradient and cells. SPDX-License-Identifier: GPL-3.0-or-later */
#include <string.h>

#include "effect-parts/effect-decision.h"
#include "planner/atlas.h"
#include "planner/plan.h"

/* Nanoseconds of one core: a pair of pp (data/atlas/force.tsv: 7815 for each of 20000); a point of the transform's mesh with all work on it, a particle
 * to the mesh and back (docs/speed.md). */
static const double ns_pair = 0.39, ns_point = 5, ns_particle = 100;

static double cost_pairs(const struct pm_scales *s) { return ns_pair * s->n * s->sources; }

double pm_plan_cost_mesh(const struct pm_scales *s) { return ns_point * s->points * (s->open ? pow(2, s->dim) : 1) + ns_particle * s->n; }

double pm_plan_force_seconds(const struct pm_scales *s) { return 1e-9 * (s->pairs ? cost_pairs(s) : pm_plan_cost_mesh(s)); }

static bool all_open(const struct pm_scales *s) { return s->open && !s->periodic && !s->walls; }

/* Vortices that represent a field: their volumes fill the mesh. */
static bool is_field(const struct pm_scales *s)
{
	return s->kind == PM_VORTICES && s->overlap < 0.3 && s->width > 0.7 * s->h && s->width < 1.4 * s->h;
}

/* pp sums in open space only; particles that represent a field need a mesh. */
static bool pairs(const struct pm_frame *f, const struct pm_plan *p, char why[160])
{
	const struct pm_scales *s = &p->scales;
	const bool field = is_field(s);
	const double a = cost_pairs(s), b = f->nmeshes ? pm_plan_cost_mesh(s) : HUGE_VAL;
	if (!all_open(s))
		snprintf(why, 160, "a %s box", s->periodic ? "periodic" : "walled");
	else if (field)
		snprintf(why, 160, "the particles carry a field: their volumes fill the mesh to %.1g", s->overlap);
	else if (a <= b)
		snprintf(why, 160, "%g bodies, pairs cost %.1g of the mesh", s->sources, a / b);
	else
		snprintf(why, 160, "%g bodies, a mesh costs %.1g of the pairs", s->sources, b / a);
	return all_open(s) && !field && a <= b;
}

void pm_plan_method(const struct pm_frame *f, struct pm_plan *p)
{
	struct pm_method *m = &p->method;
	const struct pm_scales *s = &p->scales;
	*m = (struct pm_method){.dt = NAN, .follow = NAN, .tolerance = NAN, .evaluations = NAN,
		.kernel = p->law->kernel, .order = p->law->order, .scheme = s->second ? "leapfrog" : "rk4"};
	m->pairs = (s->kind == PM_MASSES || s->kind == PM_CHARGES || s->kind == PM_VORTICES) && pairs(f, p, m->why_far);
	p->scales.singular = s->kind == PM_VORTICES && f->nmeshes && !is_field(s);
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

/* A relative force error d shifts frequencies by d/2 and phases by d omega T/2 within the run, which limits d. */
static double allowed(const struct pm_scales *s) { return s->accuracy / fmax(1, 0.5 * s->omega * s->time); }

struct try {
	const struct pm_atlas_force *row; /* solver, kernel, gradient */
	int factor;                       /* of the cells */
	double error;
};

static bool can(const struct pm_plan *p, const struct pm_atlas_force *r, const char *scene)
{
	return !strcmp(r->scene, scene) && !strncmp(r->solver, "poisson-fft", 11) && (!p->scales.open || strcmp(r->gradient, "spectral"));
}

static bool is_lattice(const struct pm_scales *s) { return s->noise * s->effective < 0.1 && s->thermal < 1e-3 * s->omega * s->h; }

/* Sheets of a cold wave of amplitude A are 1 - A as far apart as they were where they are densest, at its largest within the run; waves of masses grow. */
static double squeeze(const struct pm_scales *s)
{
	const double grown = s->kind == PM_MASSES ? cosh(fmin(s->omega * s->time, 50)) : 1;
	return s->wave > 0 && is_lattice(s) ? 1 - fmin(0.9, 2 * s->wave * grown) : 1;
}

/* What a cold lattice of particles in a smooth wave does on a mesh with n of them in a cell along an axis: waves of the lattice fold onto long ones, c n^-q
 * of a wave whose particles swing by 0.036 of a cell, and grow: with t = omega T as (t/5)^g, and as exp(r t), faster the wider the particles swing, to full
 * rate at a seventh of a cell (with spectral gradients; 0.8, 0.7 and 0.5 of it with those of order 6, 4 and 2). Measured with waves of amplitude 0.0005 to
 * 0.45 on 16 to 128 cells, 1.7 to 64 particles in each, to t = 100 (docs/plan.md); 3: what the ratio of particles to cells does. */
static const struct folding {
	const char *kernel;
	double c, q, g, rate;
} foldings[] = {{"ngp", 2, 1, 1, 0.5}, {"cic", 1.2, 2, 1, 0.32}, {"tsc", 0.1, 3, 0.5, 0.2}, {"pcs", 0.02, 4, 0.5, 0.12}, {"m4prime", 0.5, 3.3, 2, 0.39},
	{"lambda-2", 0.5, 3.7, 2, 0.4}, {"m6prime", 0.15, 3.6, 2, 0.4}, {"lambda-4-2", 0.15, 3.6, 2, 0.4}, {"lambda", 1.2, 6, 2, 0.4}};

static const struct folding *folding_of(const char *kernel)
{
	for (size_t i = 0; i < sizeof foldings / sizeof *foldings; i++)
		if (!strncmp(kernel, foldings[i].kernel, strlen(foldings[i].kernel)))
			return &foldings[i];
	return &foldings[1];
}

/* Of a particle, in cells. */
static double swing(const struct pm_scales *s, double h) { return fmax(s->v_rms / s->omega, s->self / (s->omega * s->omega)) / h; }

/* exp(r t) */
static double growth(const struct pm_scales *s, const struct pm_atlas_force *r, double h, double t)
{
	const double part = fmin(1, pow(swing(s, h) / 0.15, 0.75));
	const double order = !strcmp(r->gradient, "spectral") ? 1 : !strcmp(r->gradient, "6") ? 0.8 : !strcmp(r->gradient, "4") ? 0.7 : 0.5;
	return exp(fmin(order * folding_of(r->kernel)->rate * part * fmax(t, 0), 100));
}

static double lattice_error(const struct pm_scales *s, const struct pm_atlas_force *r, int factor)
{
	const struct folding *f = folding_of(r->kernel);
	const double h = s->h / factor, n = pow(s->n / s->points, 1. / s->dim) / factor, t = s->omega * s->time;
	if (!is_lattice(s))
		return 0;
	const double least = fmin(1, f->c * pow(n * (s->kind == PM_MASSES ? 1 : squeeze(s)), -f->q));
	if (s->kind == PM_MASSES)
		return least; /* all waves of cold masses grow alike */
	return fmin(1, 3 * least * 0.036 / swing(s, h) * fmax(pow(fmax(t / 5, 1), f->g), 0.1 * growth(s, r, h, t)));
}

/* The relative error of a force by a row of the atlas, with `factor` times the cells; h: of the frame's mesh over the length of the field. */
static double row_error(const struct pm_scales *s, const struct pm_atlas_force *r, double h, int factor)
{
	const double atlas = pm_atlas_force_error(r->scene, r->solver, r->kernel, r->gradient, h / squeeze(s) / factor);
	/* the mesh's own error of a steep wave makes new waves, which grow as those of the lattice */
	const double steep = 1 - squeeze(s), t = s->omega * s->time;
	if (is_lattice(s) && s->kind == PM_CHARGES)
		return fmin(1, atlas * (1 + steep * steep * growth(s, r, s->h / factor, t - 5)) + lattice_error(s, r, factor) / fmax(1, 0.5 * t));
	return atlas + lattice_error(s, r, factor) / fmax(1, 0.5 * s->omega * s->time);
}

/* Of the rows that reach the accuracy with `factor` times the cells and cost at most 1.5 times the cheapest of them, the most accurate: smaller differences
 * are timing noise of the atlas. If none reaches it, the most accurate of all. */
static struct try best(const struct pm_plan *p, const char *scene, double h, int factor)
{
	struct try found = {NULL, factor, HUGE_VAL};
	double least = HUGE_VAL;
	for (int pass = 0; pass < 2; pass++)
		for (const struct pm_atlas_force *r = pm_atlas_forces; r->scene; r++) {
			const double e = can(p, r, scene) ? row_error(&p->scales, r, h, factor) : NAN;
			if (!pass && e <= allowed(&p->scales))
				least = fmin(least, r->ns);
			else if (pass && e < found.error && (least == HUGE_VAL || (e <= allowed(&p->scales) && r->ns <= 1.5 * least)))
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
			least = (struct try){r, 1, row_error(s, r, h, 1)};
	for (int factor = 1; factor <= 8 && !(least.error <= allowed(s)) && (factor == 1 || room(s, factor) < 3e7); factor *= 2) {
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
	s->mesh_error = pm_atlas_force_error("smooth", "poisson-fft", p->method.kernel, "6", hk);
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
	int factor = 1;
	while (factor < 64 && point_error(factor * s->softening / s->h) > s->accuracy && room(s, 2 * factor) < 3e7)
		factor *= 2;
	const double error = s->softening > 0 ? point_error(factor * s->softening / s->h) : 1;
	factor = s->softening > 0 ? factor : 1;
	s->h /= factor, s->points *= pow(factor, s->dim);
	const double dearer = cost_pairs(s) / pm_plan_cost_mesh(s);
	if (all_open(s) && (dearer <= 1 || (error > s->accuracy && dearer < 20))) {
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
	const double apart = s->softening > 0 ? hypot(s->nearest, s->softening) : s->nearest;
	int factor = 1;
	if (s->pairs || !f->nmeshes || !(s->n < 32) || (s->kind != PM_MASSES && s->kind != PM_CHARGES))
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
		s->length = fmin(s->length, s->wave_length); /* a coarse mesh folds short waves onto long ones */
	const double h = s->h / s->length;
	if (m->pairs || !f->nmeshes || !(s->length > 0))
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
	if (t.error > allowed(s) && all_open(s) && dearer < 20) {
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
		t.error > allowed(s) ? ", more than asked for" : "");
}
