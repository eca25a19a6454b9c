/* poisson-relax: solves lap phi = c*s on a mesh by simple iterations. SPDX-License-Identifier: GPL-3.0-or-later */
#include <stdio.h>

#include "poisson-relax/relaxation.h"
#include "stage/solver-options.h"
#include "world/world.h"

struct config {
	struct pm_problem_names names;
	const char *method;
	double relaxation, tolerance;
	int64_t most, sweeps;
};
struct state {
	struct pm_problem problem;
	struct pm_relaxation_choice choice;
	struct pm_relaxation *solver; /* for one grid */
	bool from;                    /* the target is there, and sweeps begin with it */
};

static const struct pm_option options[] = {
	{.name = "method", .kind = PM_WORD, .fallback = "cg", .choices = pm_relax_names, PM_AT(method), .text = "which iteration"},
	{.name = "relaxation", .kind = PM_REAL, .low = 0.01, .high = 1.9999, PM_AT(relaxation),
		.text = "factor of each step (default: the method's: 1, the best smoother, or Young's optimum for this mesh and its faces)"},
	{.name = "tolerance", .kind = PM_REAL, .fallback = "1e-11", .high = 1, PM_AT(tolerance),
		.text = "tolerance of the residual relative to c*s, both as root mean square"},
	{.name = "max-sweeps", .kind = PM_INTEGER, .fallback = "100000", .low = 1, .high = 1e9, PM_AT(most), .text = "largest number of sweeps; then it fails"},
	{.name = "sweeps", .kind = PM_INTEGER, .low = 1, .high = 1e9, PM_AT(sweeps),
		.text = "just as many, from the target as it is (0 where there is none): relaxation as a piece of multigrid, see mlevel"},
	PM_SOLVER_ROWS,
	{0},
};

static const struct pm_example examples[] = {
	{"the potential in a periodic box by conjugate gradients", "pinit uniform -n 2000 | p2m -n 32 | poisson-relax | sls --report"},
	{"over-relaxation between walls: the radius measured and Young's", "pinit uniform -n 200 --dim 2 --faces wall | p2m -n 64 | poisson-relax --method "
		"sor | sls --report"},
	{"a given relaxation factor", "pinit uniform -n 200 --dim 2 --faces wall | p2m -n 32 | poisson-relax --method red-black-sor --relaxation 1.7 | sls "
		"--report"},
	{0},
};

static int begin(struct pm_stage *s)
{
	const struct config *o = s->config;
	struct state *t = s->state;
	t->choice = (struct pm_relaxation_choice){.method = pm_relax_find(o->method), .factor = o->relaxation, .tolerance = o->tolerance, .most = o->most};
	if (!t->choice.method)
		return -PM_USAGE;
	t->choice.exactly = s->advances = o->sweeps > 0;
	t->choice.most = o->sweeps > 0 ? o->sweeps : o->most;
	if (!isnan(o->relaxation) && !t->choice.method->factor)
		return pm_fail(PM_USAGE, "--method %s has no factor of relaxation (leave --relaxation out, or take --method sor)", o->method);
	return 0;
}

static int declare(struct pm_stage *s, struct pm_frame *f)
{
	const struct config *o = s->config;
	struct state *t = s->state;
	int status = pm_problem_find(f, &o->names, &t->problem);
	if (!status)
		status = pm_relaxation_check(&t->problem.grid, t->choice.method, t->choice.factor);
	if (!status && o->sweeps > 0 && pm_relaxation_open(&t->problem.grid))
		status = pm_fail(PM_DATA, "--sweeps needs faces that give values, but these are open (smod --faces wall, or leave --sweeps out)");
	t->from = !status && o->sweeps > 0 && pm_frame_field(f, t->problem.mesh->name, t->problem.target_name);
	t->problem.keep = t->from;
	if (!status)
		status = pm_problem_declare(f, &t->problem);
	if (!status && t->problem.target->components != t->problem.source->components)
		status = pm_fail(PM_DATA, "'%s' and '%s' have different numbers of components", t->problem.source_name, t->problem.target_name);
	for (int c = 0; !status && c < t->problem.source->components; c++) {
		struct pm_grid g = pm_problem_grid(&t->problem, c);
		status = pm_relaxation_check(&g, t->choice.method, t->choice.factor);
	}
	if (!status)
		t->problem.target->use |= t->from ? 0 : PM_USE_FILL;
	return status;
}

static int ready(struct state *t, int component)
{
	struct pm_grid g = pm_problem_grid(&t->problem, component);
	double lacks = !(t->solver && pm_relaxation_fits(t->solver, &g, t->choice.method) && pm_relaxation_same_planes(t->solver, t->problem.source));
	if (t->problem.source->here && pm_world_largest(0, 1, &lacks)) /* what one rank lacks, all make together */
		return pm_failed();
	if (lacks == 0)
		return 0;
	pm_relaxation_free(t->solver);
	t->solver = pm_relaxation_new_of(&g, t->choice.method, t->problem.source);
	return t->solver ? 0 : -PM_DATA;
}

/* Of the component that took the most sweeps. */
static void report(struct pm_stage *s, struct pm_frame *f, const struct pm_relax *method, bool exactly,
	const struct pm_relaxation_record *r)
{
	const struct { const char *key; double value; } row[] = {{"sweeps", (double)r->sweeps}, {"residual", r->after}, {"relaxation", r->factor},
		{"radius", r->radius}, {method->bound ? "radius_bound" : "radius_expected", r->expected}};
	for (size_t i = 0; i < sizeof row / sizeof *row; i++)
		if (!isnan(row[i].value))
			pm_report(s, f, row[i].key, row[i].value);
	pm_report_text(s, f, "status", exactly ? "sweeps" : r->floor ? "floor" : "converged");
}

static int frame(struct pm_stage *s, struct pm_frame *f)
{
	struct state *t = s->state;
	struct pm_relaxation_record longest = {.sweeps = -1}, r;
	int status = 0;
	for (int c = 0; !status && c < t->problem.source->components; c++) {
		struct pm_homogeneous m = {0};
		double *phi = pm_out(t->problem.target, c);
		t->choice.start = t->from ? phi : NULL;
		if (!(status = pm_world_agree(ready(t, c))) && !(status = pm_problem_move(&t->problem, f, c, 2, NULL, &m)))
			status = pm_relaxation_solve(t->solver, &t->choice, m.c, m.s, phi, &r);
		if (!status && r.singular)
			pm_solver_report_removed(s, f, &t->problem, c, r.mean, &m, r.incompatible);
		pm_homogeneous_close(&m, phi);
		if (status)
			break;
		if (r.sweeps > longest.sweeps)
			longest = r;
	}
	if (!status)
		report(s, f, t->choice.method, t->choice.exactly, &longest);
	return status;
}

static bool divided(const struct pm_stage *s, const struct pm_frame *f)
{
	const struct state *t = s->state;
	return f && pm_relaxation_shares(&t->problem.grid, t->choice.method);
}

static void release(struct pm_stage *s)
{
	struct state *t = s->state;
	t->solver = pm_relaxation_free(t->solver);
}

const struct pm_tool tool_poisson_relax = {
	.name = "poisson-relax",
	.summary = "solve Poisson's equation on a mesh by simple iterations",
	.about = "Solves lap phi = c*s with differences of order 2 on the nodes, for comparison and for teaching: Jacobi, Gauss-Seidel, over-relaxation, "
		"conjugate "
		"gradients. Faces periodic, wall (phi = 0) or neumann (no normal gradient) in any mixture, or open on all axes (free space, by two "
		"solutions). Reports the sweeps, the asymptotic factor by which the residual fell per sweep, and the published formula for it if there is "
		"one. If no "
		"face fixes phi, the mean of s is removed and reported, and the "
		"mean of phi is "
		"zero. It stops at the tolerance or when round-off prevents further reduction (status floor), and fails with exit 3 and the history if it "
		"does neither. poisson-mg "
		"and poisson-fft --symbol fd2 solve the same equation faster.",
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
