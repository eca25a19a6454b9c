/* mlevel: the pieces of a two-grid cycle: residual, restriction, prolongation (lib/mesh/two-grid.c). SPDX-License-Identifier: GPL-3.0-or-later */
#include <string.h>

#include "mesh/poisson-residual.h"
#include "mesh/two-grid.h"
#include "stage/solver-options.h"
#include "stream/declare.h"

enum piece { RESIDUAL, RESTRICT, PROLONG };

struct config {
	struct pm_problem_names names;
	const char *coarse, *residual, *error;
};
struct state {
	enum piece piece;
	struct pm_problem problem;
	const struct pm_field *phi, *error; /* NULL: 0 */
	struct pm_field *out;               /* residual, on one of the meshes; or phi */
};

static const char *const pieces[] = {"residual", "restrict", "prolong", NULL}; /* in the order of enum piece */

static const struct pm_option options[] = {
	{.name = "coarse", .kind = PM_TEXT, .unit = "NAME", .fallback = "coarse", PM_AT(coarse), .text = "the mesh with half the cells; restrict makes it"},
	{.name = "residual", .kind = PM_TEXT, .unit = "FIELD", .fallback = "residual", PM_AT(residual), .text = "the residual, on the mesh or the coarse one"},
	{.name = "error", .kind = PM_TEXT, .unit = "FIELD", .fallback = "error", PM_AT(error), .text = "the correction on the coarse mesh, for prolong"},
	PM_SOLVER_ROWS,
	{0},
};

static const struct pm_example examples[] = {
	{"a two-grid cycle: relax, solve for the error on the coarse mesh, correct, relax",
		"pinit uniform -n 999 --dim 2 --faces wall | p2m -n 32 | poisson-relax --method weighted-jacobi --sweeps 2 | mlevel restrict | poisson-fft "
		"--symbol fd2 --mesh coarse --coefficient 1 --source residual --target error | mlevel prolong | poisson-relax --method weighted-jacobi "
		"--sweeps 2 | mlevel residual | sls --report"},
	{0},
};

static int begin(struct pm_stage *s)
{
	struct state *t = s->state;
	while (pieces[t->piece] && strcmp(pieces[t->piece], s->args[0]))
		t->piece++;
	s->advances = t->piece == PROLONG;
	return pieces[t->piece] ? 0 : pm_fail(PM_USAGE, "no piece '%s' (residual, restrict, prolong)", s->args[0]);
}

/* The coarse mesh, made if it is not there; NULL with a message. */
static const struct pm_mesh *coarse_mesh(struct pm_frame *f, const char *name, const struct pm_grid *fine, bool make)
{
	const struct pm_grid g = pm_two_grid_coarse(fine);
	const struct pm_mesh *m = pm_frame_mesh(f, name);
	if (!m && make)
		return pm_frame_mesh_new(f, name, g.cells);
	if (!m)
		pm_fail(PM_DATA, "no mesh named %s (mlevel restrict makes it)", name);
	else if (memcmp(m->cells, g.cells, sizeof g.cells)) {
		pm_fail(PM_DATA, "the mesh %s has not half the cells of this one (choose another --coarse)", name);
		return NULL;
	}
	return m;
}

static int declare(struct pm_stage *s, struct pm_frame *f)
{
	const struct config *o = s->config;
	struct state *t = s->state;
	struct pm_problem *p = &t->problem;
	int status = pm_problem_find(f, &o->names, p);
	if (!status)
		status = pm_two_grid_check(&p->grid);
	const struct pm_mesh *coarse = t->piece == RESIDUAL || status ? NULL : coarse_mesh(f, o->coarse, &p->grid, t->piece == RESTRICT);
	if (status || (t->piece != RESIDUAL && !coarse))
		return status ? status : -PM_DATA;
	p->source = pm_reads(f, p->mesh->name, p->source_name);
	const bool there = pm_frame_field(f, p->mesh->name, p->target_name);
	if (!p->source)
		return -PM_DATA;
	if (t->piece == PROLONG && !there)
		return pm_fail(PM_DATA, "no field '%s' on '%s' to correct (poisson-relax --sweeps 2 makes a first one)", p->target_name, p->mesh->name);
	if (t->piece == PROLONG && !pm_frame_field(f, o->coarse, o->error))
		return pm_fail(PM_DATA, "no field '%s' on '%s' (poisson-fft --symbol fd2 --mesh %s --coefficient 1 --source %s --target %s makes it)",
			o->error, o->coarse, o->coarse, o->residual, o->error);
	if (t->piece == PROLONG) {
		t->error = pm_reads(f, o->coarse, o->error);
		t->out = pm_changes(f, p->mesh->name, p->target_name);
	} else {
		t->phi = there ? pm_reads(f, p->mesh->name, p->target_name) : NULL;
		t->out = pm_makes(f, coarse ? coarse->name : p->mesh->name, o->residual, p->source->components, PM_DERIVED);
	}
	if (!t->out || (t->piece == PROLONG && !t->error) || (there && t->piece != PROLONG && !t->phi))
		return -PM_DATA;
	const struct pm_field *other = t->piece == PROLONG ? t->error : t->phi;
	if ((other && other->components != p->source->components) || t->out->components != p->source->components)
		return pm_fail(PM_DATA, "'%s' and '%s' have different numbers of components", p->source_name, p->target_name);
	return pm_given_declare(&p->given, f, p->mesh->name, p->law, p->source);
}

/* The residual of component c on the mesh, or restricted to the coarse one. */
static int residual(struct state *t, struct pm_frame *f, int c, double *size, double *source)
{
	const struct pm_grid g = pm_problem_grid(&t->problem, c);
	struct pm_homogeneous m;
	double *room = t->piece == RESTRICT ? pm_alloc(pm_grid_size(&g), sizeof *room) : NULL, *r = room ? room : pm_out(t->out, c);
	int status = t->piece == RESTRICT && !room ? -PM_DATA : pm_problem_move(&t->problem, f, c, 2, NULL, &m);
	if (!status) {
		status = pm_poisson_residual(&g, m.c, m.s, t->phi ? pm_in(t->phi, c) : NULL, r, size, source);
		pm_homogeneous_free(&m);
	}
	if (!status && room)
		pm_two_grid_restrict(&g, r, pm_out(t->out, c));
	pm_free(room);
	return status;
}

static int frame(struct pm_stage *s, struct pm_frame *f)
{
	struct state *t = s->state;
	double size = 0, source = 0, one, of;
	for (int c = 0; c < t->problem.source->components; c++) {
		const struct pm_grid g = pm_problem_grid(&t->problem, c);
		if (t->piece == PROLONG)
			pm_two_grid_prolong(&g, pm_in(t->error, c), pm_out(t->out, c));
		else if (residual(t, f, c, &one, &of))
			return -PM_DATA;
		else
			size = hypot(size, one), source = hypot(source, of);
	}
	if (t->piece != PROLONG)
		pm_report(s, f, "residual_rms", size);
	if (t->piece != PROLONG && source > 0)
		pm_report(s, f, "residual", size / source);
	return 0;
}

const struct pm_tool tool_mlevel = {
	.name = "mlevel",
	.summary = "go between two levels of multigrid, by residual, restriction and prolongation",
	.about = "residual: r = c*s - lap phi on the mesh, differences of order 2, phi 0 where there is none yet. restrict: r by full weighting onto a mesh "
		"with half the cells, which it makes. prolong: phi += P e, with linear interpolation of the error e that a solver found there from lap e = r. "
		"With poisson-relax --sweeps these are the pieces of a two-grid cycle; on the coarse mesh again, with --mesh and --coarse, of a V-cycle. "
		"residual and restrict report the residual as root mean square (residual_rms), and relative to c*s (residual). poisson-mg does all of it, "
		"faster.",
	.kind = PM_FILTER,
	.makes = true,
	.reads = "rho, phi (mesh)",
	.changes = "phi (mesh) with prolong",
	.adds = "residual (mesh)",
	.config = sizeof(struct config),
	.state = sizeof(struct state),
	.options = options,
	.arguments = "residual|restrict|prolong",
	.arguments_choices = pieces,
	.arguments_text = "which piece",
	.least = 1,
	.most = 1,
	.examples = examples,
	.begin = begin,
	.declare = declare,
	.frame = frame,
};
