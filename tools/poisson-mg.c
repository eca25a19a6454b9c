/* poisson-mg: solves lap phi = c*s on a mesh by multigrid. SPDX-License-Identifier: GPL-3.0-or-later */
#include <stdio.h>
#include <string.h>

#include "poisson/mg.h"
#include "poisson/problem.h"
#include "stage/stage.h"

struct config {
	struct pm_problem_names names;
	const char *cycle;
	struct pm_vector smooth;
	double relaxation, tolerance;
	int64_t most;
};
struct state {
	struct pm_problem problem;
	struct pm_mg *solver; /* the hierarchy, for the grid `made` */
	struct pm_grid made;
	struct pm_mg_choice choice;
	struct pm_mg_record record;
};

static const char *const cycles[] = {"v", "w", "fmg", NULL}; /* in the order of enum pm_mg_cycle */

static const struct pm_option options[] = {
	{"cycle", 0, PM_WORD, "", "fmg", 0, 0, cycles, "V-cycles, W-cycles, or full multigrid and then V-cycles", false, offsetof(struct config, cycle)},
	{"smooth", 0, PM_VECTOR, "sweeps", "2,2", 0, 20, NULL, "red-black sweeps before and after the coarse grid", false, offsetof(struct config, smooth)},
	{"relaxation", 0, PM_REAL, "", "1.15", 0.1, 1.9, NULL, "factor of each sweep, 1 is Gauss-Seidel", false, offsetof(struct config, relaxation)},
	{"tolerance", 0, PM_REAL, "", "1e-11", 0, 1, NULL, "of the residual, relative to c*s, both as root of the mean square", false,
		offsetof(struct config, tolerance)},
	{"max-cycles", 0, PM_INTEGER, "", "50", 1, PM_MG_MOST, NULL, "cycles after which it fails", false, offsetof(struct config, most)},
	{"coefficient", 0, PM_REAL, "", NULL, 0, 0, NULL, "c in lap phi = c*s (default: the law's)", false, offsetof(struct config, names.coefficient)},
	{"source", 0, PM_TEXT, "FIELD", NULL, 0, 0, NULL, "s, a mesh field (default: the law's density)", false, offsetof(struct config, names.source)},
	{"target", 0, PM_TEXT, "FIELD", NULL, 0, 0, NULL, "phi, the mesh field to make (default: the law's potential)", false,
		offsetof(struct config, names.target)},
	{"mesh", 0, PM_TEXT, "NAME", NULL, 0, 0, NULL, "the mesh (default: the first)", false, offsetof(struct config, names.mesh)},
	{0},
};

static const struct pm_example examples[] = {
	{"the potential in a periodic box", "pinit uniform -n 2000 | p2m -n 32 | poisson-mg | sls"},
	{"sizes need not be powers of two, and the cells need not be cubes", "pinit uniform -n 2000 | p2m -n 31x20x7 | poisson-mg --smooth 3,3 | sls"},
	{"one pass of full multigrid, as good as the differences themselves", "pinit uniform -n 2000 | p2m -n 64 | poisson-mg --smooth 1,1 --tolerance 0.9 | sls"},
	{0},
};

static int begin(struct pm_stage *s)
{
	const struct config *o = s->config;
	struct state *t = s->state;
	if (o->smooth.n != 2 || floor(o->smooth.x[0]) != o->smooth.x[0] || floor(o->smooth.x[1]) != o->smooth.x[1])
		return pm_fail(PM_USAGE, "--smooth takes two whole numbers, sweeps before and after (--smooth 2,2)");
	if (o->smooth.x[0] + o->smooth.x[1] == 0)
		return pm_fail(PM_USAGE, "--smooth 0,0 smooths nothing (--smooth 2,2)");
	t->choice = (struct pm_mg_choice){.pre = (int)o->smooth.x[0], .post = (int)o->smooth.x[1], .relaxation = o->relaxation,
		.tolerance = o->tolerance, .most = (int)o->most};
	while (strcmp(cycles[t->choice.cycle], o->cycle))
		t->choice.cycle++;
	return 0;
}

static int plan(struct pm_stage *s, struct pm_frame *f)
{
	const struct config *o = s->config;
	struct state *t = s->state;
	int status = pm_problem_find(f, &o->names, &t->problem);
	if (!status)
		status = pm_mg_check(&t->problem.grid);
	return status ? status : pm_problem_declare(f, &t->problem);
}

static int ready(struct state *t)
{
	if (t->solver && pm_mg_fits(t->solver, &t->problem.grid, 2))
		return 0;
	pm_mg_free(t->solver);
	t->solver = pm_mg_new(&t->problem.grid, 2);
	return t->solver ? 0 : -PM_DATA;
}

static int frame(struct pm_stage *s, struct pm_frame *f)
{
	struct state *t = s->state;
	const struct pm_mg_record *r = &t->record;
	double taken = 0, residual = 0, contraction = 0;
	bool roundoff = false;
	int status = ready(t);
	for (int c = 0; !status && c < t->problem.source->components; c++) {
		char key[32] = "mean_removed";
		if (t->problem.source->components > 1)
			snprintf(key, sizeof key, "mean_removed_%d", c);
		status = pm_mg_solve(t->solver, &t->choice, t->problem.c, pm_in(t->problem.source, c), pm_out(t->problem.target, c), &t->record);
		taken = fmax(taken, r->cycles);
		residual = fmax(residual, r->after);
		contraction = fmax(contraction, r->contraction);
		roundoff |= r->floor;
		if (r->singular)
			pm_report(s, f, key, r->mean);
	}
	if (status)
		return status;
	pm_report(s, f, "cycles", taken);
	pm_report(s, f, "residual", residual);
	pm_report(s, f, "contraction", contraction);
	pm_report_text(s, f, "status", roundoff ? "floor" : "converged");
	return 0;
}

static void release(struct pm_stage *s)
{
	struct state *t = s->state;
	t->solver = pm_mg_free(t->solver);
}

const struct pm_tool tool_poisson_mg = {
	.name = "poisson-mg",
	.summary = "solve Poisson's equation on a mesh by multigrid",
	.about = "Solves lap phi = c*s with differences of order 2 on the nodes; faces periodic, wall (phi = 0) or neumann (no normal gradient) in any mixture, "
		"any number of cells per axis, any ratio of the spacings. Red-black Gauss-Seidel, V- and W-cycles, full multigrid with cubic interpolation. Where "
		"no face fixes phi, the mean of s is removed and reported, and the mean of phi is zero. It stops at the tolerance (status converged) or where "
		"round-off keeps the residual above it (status floor), and fails with exit 3 if it does neither. In a plain box poisson-fft is faster and solves the same "
		"equation with --symbol fd2.",
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
	.plan = plan,
	.frame = frame,
	.free = release,
};
