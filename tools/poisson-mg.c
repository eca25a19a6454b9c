/* poisson-mg: solves lap phi = c*s on a mesh by multigrid. SPDX-License-Identifier: GPL-3.0-or-later */
#include <stdio.h>
#include <string.h>

#include "green/green.h"
#include "poisson-mg/mg-medium.h"
#include "poisson-mg/multigrid.h"
#include "stage/solver-options.h"
#include "world/world.h"

struct config {
	struct pm_problem_names names;
	const char *cycle, *order, *smoother, *restriction, *permittivity, *mean, *green, *coarse;
	struct pm_vector smooth;
	double relaxation, tolerance;
	int64_t most;
};
struct state {
	struct pm_problem problem;
	const struct pm_field *eps;
	struct pm_multigrid *solver; /* the hierarchies of grids already seen */
	struct pm_multigrid_choice choice;
	struct pm_mg_record record;
};

static const char *const cycles[] = {"v", "w", "fmg", NULL}; /* in the order of enum pm_mg_cycle */
static const char *const orders[] = {"2", "4", NULL}, *const restrictions[] = {"full", "half", NULL}, *const coarse[] = {"direct", "galerkin", NULL};

static const struct pm_option options[] = {
	{.name = "cycle", .kind = PM_WORD, .fallback = "fmg", .choices = cycles, PM_AT(cycle),
		.text = "V-cycles, W-cycles, or full multigrid and then V-cycles"},
	{.name = "order", .kind = PM_WORD, .fallback = "2", .choices = orders, PM_AT(order), .text = "of the differences: 2, or 4 (compact, Mehrstellen)"},
	{.name = "smoother", .kind = PM_WORD, .choices = pm_mg_smoother_names, PM_AT(smoother),
		.text = "red-black Gauss-Seidel, over-relaxed (sor), Jacobi, or four-colour (default: sor; order 4: four-colour; Galerkin: red-black)"},
	{.name = "smooth", .kind = PM_VECTOR, .unit = "sweeps", .fallback = "2,2", .high = 20, PM_AT(smooth),
		.text = "sweeps before and after the coarse grid"},
	{.name = "relaxation", .kind = PM_REAL, .low = 0.1, .high = 1.9, PM_AT(relaxation),
		.text = "factor of each sweep (default: 1; sor: 1.15; jacobi: 2/3, 4/5, 6/7 in 1-D, 2-D, 3-D, and 2/3, 2/3, 4/7 at order 4)"},
	{.name = "restriction", .kind = PM_WORD, .fallback = "full", .choices = restrictions, PM_AT(restriction),
		.text = "of the residual; half weighting is for comparison"},
	{.name = "coarse", .kind = PM_WORD, .choices = coarse, PM_AT(coarse),
		.text = "coarse operators: the same differences, or P^T A P of the finer one (default: direct; with a permittivity galerkin)"},
	{.name = "permittivity", .kind = PM_TEXT, .unit = "FIELD", PM_AT(permittivity),
		.text = "eps in div(eps grad phi) = c*s, a positive mesh field (default: 1)"},
	{.name = "mean", .kind = PM_WORD, .fallback = "harmonic", .choices = pm_mg_mean_names, PM_AT(mean), .text = "mean of eps between two nodes"},
	{.name = "tolerance", .kind = PM_REAL, .fallback = "1e-11", .high = 1, PM_AT(tolerance),
		.text = "tolerance of the residual relative to c*s, both as root mean square"},
	{.name = "max-cycles", .kind = PM_INTEGER, .fallback = "50", .low = 1, .high = PM_MG_MOST, PM_AT(most), .text = "largest number of cycles"},
	{.name = "green", .kind = PM_WORD, .choices = pm_green_names, PM_AT(green), .text = "refused: Green's functions, softened ones too, are poisson-fft's"},
	PM_SOLVER_ROWS,
	{0},
};

static const struct pm_example examples[] = {
	{"the potential in a periodic box", "pinit uniform -n 2000 | p2m -n 32 | poisson-mg | sls --report"},
	{"order 4, and sizes need not be powers of two nor the cells cubes", "pinit uniform -n 2000 | p2m -n 31x20x7 | poisson-mg --order 4 | sls"},
	{"a layer of high permittivity",
		"pinit uniform -n 99 --dim 2 | p2m -n 64 | scalc --mesh mesh 'eps = x < 0.5 ? 1 : 1e6' | poisson-mg --permittivity eps --tolerance 1e-8 | sls"},
	{0},
};

static int begin(struct pm_stage *s)
{
	const struct config *o = s->config;
	struct state *t = s->state;
	if (o->green)
		return pm_fail(PM_USAGE, "multigrid inverts differences, and has no --green (poisson-fft --green %s)", o->green);
	if (o->smooth.n != 2 || floor(o->smooth.x[0]) != o->smooth.x[0] || floor(o->smooth.x[1]) != o->smooth.x[1])
		return pm_fail(PM_USAGE, "--smooth needs two integers, the sweeps before and after (--smooth 2,2)");
	if (o->smooth.x[0] + o->smooth.x[1] == 0)
		return pm_fail(PM_USAGE, "--smooth 0,0 smooths nothing (--smooth 2,2)");
	if (o->permittivity && o->coarse && !strcmp(o->coarse, coarse[0]))
		return pm_fail(PM_USAGE, "with --permittivity the coarse operators are P^T A P (leave out --coarse direct)");
	t->choice = (struct pm_multigrid_choice){.order = *o->order - '0', .variable = o->permittivity,
		.galerkin = o->coarse && !strcmp(o->coarse, coarse[1]), .mean = strcmp(o->mean, pm_mg_mean_names[0]) != 0,
		.cycle = {.pre = (int)o->smooth.x[0], .post = (int)o->smooth.x[1], .tolerance = o->tolerance, .most = (int)o->most,
			.half_weighting = !strcmp(o->restriction, "half")}};
	while (strcmp(cycles[t->choice.cycle.cycle], o->cycle))
		t->choice.cycle.cycle++;
	t->solver = pm_multigrid_new();
	return !t->solver ? -PM_DATA : pm_multigrid_choose(&t->choice, o->smoother, o->relaxation);
}

static int declare(struct pm_stage *s, struct pm_frame *f)
{
	const struct config *o = s->config;
	struct state *t = s->state;
	int status = pm_problem_find(f, &o->names, &t->problem);
	if (!status)
		status = pm_multigrid_check(&t->choice, &t->problem.grid);
	if (!status && o->permittivity)
		status = pm_problem_coefficient(f, &t->problem, o->permittivity, &t->eps);
	if (!status)
		status = pm_problem_declare(f, &t->problem);
	if (!status && t->eps)
		pm_field_inherit(t->problem.target, t->eps), pm_problem_not_of_law(&t->problem);
	return status;
}

/* One component, and its report. */
static int component(struct pm_stage *s, struct pm_frame *f, int c)
{
	struct state *t = s->state;
	const struct pm_problem *p = &t->problem;
	const struct pm_mg_record *r = &t->record;
	struct pm_grid g = pm_problem_grid(p, c);
	char key[32], residuals[12 * (PM_MG_MOST + 1)] = "";
	double *room = NULL;
	const double *eps = NULL;
	struct pm_homogeneous m = {0};
	struct pm_clock began = pm_clock();
	int status = t->eps ? pm_problem_coefficient_values(p, t->eps, &eps, &room) : 0;
	const struct pm_boundary_eps medium = pm_mg_medium(eps, t->choice.mean);
	if (!status)
		status = pm_world_agree(pm_multigrid_prepare(t->solver, &t->choice, &g, eps));
	pm_setup_since(s, began);
	if (!status)
		status = pm_problem_move(p, f, c, t->choice.order, eps ? &medium : NULL, &m);
	t->choice.cycle.known = m.known;
	if (!status)
		status = pm_multigrid_solve(t->solver, &t->choice, &g, eps, m.c, m.s, pm_out(p->target, c), &t->record);
	if (!status && r->singular)
		pm_solver_report_removed(s, f, p, c, r->mean, &m, r->incompatible);
	pm_homogeneous_close(&m, pm_out(p->target, c));
	for (int i = 0, n = 0; i < r->n && !status; i++)
		n += snprintf(residuals + n, sizeof residuals - (size_t)n, "%s%.3e", i ? " " : "", r->history[i]);
	if (!status)
		pm_report_text(s, f, pm_solver_key(p, "residuals", c, key), residuals);
	pm_free(room);
	return status;
}

static int frame(struct pm_stage *s, struct pm_frame *f)
{
	struct state *t = s->state;
	const struct pm_mg_record *r = &t->record;
	double taken = 0, residual = 0, contraction = 0;
	int status = 0, roundoff = 0;
	t->choice.field = t->problem.source;
	for (int c = 0; c < t->problem.source->components && !status; c++) {
		status = component(s, f, c);
		taken = fmax(taken, r->cycles);
		residual = fmax(residual, r->after);
		contraction = fmax(contraction, r->contraction);
		roundoff |= r->floor;
	}
	pm_report(s, f, "cycles", taken), pm_report(s, f, "residual", residual), pm_report(s, f, "contraction", contraction);
	pm_report_text(s, f, "status", roundoff ? "floor" : "converged");
	return status;
}

static bool divided(const struct pm_stage *s, const struct pm_frame *f) { return s && f && f->dim > 1; }
static void release(struct pm_stage *s) { pm_multigrid_free(((struct state *)s->state)->solver); }

const struct pm_tool tool_poisson_mg = {
	.name = "poisson-mg",
	.summary = "solve Poisson's equation on a mesh by multigrid",
	.about = "Solves lap phi = c*s, or div(eps grad phi) = c*s with --permittivity, with differences of order 2 or 4 on the nodes; faces periodic, wall "
		"(phi = 0, or given) or neumann (no normal gradient, or given) in any mixture, or open on all axes (free space, as in poisson-fft); any number "
		"of cells per axis, any ratio of the spacings. V- and W-cycles, full multigrid with cubic interpolation; for a variable eps, "
		"operator-dependent transfers, Galerkin matrices and conjugate gradients, for jumps up to 1e6 and more. "
		"If no face fixes phi, the mean of s is removed and reported, and the mean of phi is zero. It stops at the tolerance (status converged) or "
		"when round-off prevents further reduction (status floor), and fails with exit 3 if it does neither. In a plain box poisson-fft is faster and "
		"solves the same equation with --symbol fd2.",
	.kind = PM_FILTER,
	.makes = true,
	.reads = "rho (mesh)",
	.changes = "",
	.adds = "phi (mesh)",
	.config = sizeof(struct config),
	.state = sizeof(struct state),
	.options = options,
	.examples = examples,
	.begin = begin,
	.declare = declare,
	.frame = frame,
	.divided = divided,
	.free = release,
};
