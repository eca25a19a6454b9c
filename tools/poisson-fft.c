/* poisson-fft: solves lap phi = c*s on a mesh by fast transforms. SPDX-License-Identifier: GPL-3.0-or-later */
#include <stdio.h>
#include <string.h>

#include "fft/fftw-plan.h"
#include "mesh/gradient.h"
#include "mesh/planes.h"
#include "poisson-fft/fft-boundary.h"
#include "poisson-fft/influence-choice.h"
#include "stage/plan-option.h"
#include "stage/solver-options.h"
#include "world/world.h"

struct config {
	struct pm_problem_names names;
	double screening, wave, softening, cloud;
	const char *symbol, *green, *influence, *order, *plan, *space;
};
struct state {
	struct pm_problem problem;
	struct pm_poisson_fft_choice choice;
	struct pm_fft_solvers solvers;
};

static const char *const spaces[] = {"doubled", "james", NULL};

static const struct pm_option options[] = {
	{.name = "symbol", .kind = PM_WORD, .choices = pm_symbol_names, PM_AT(symbol),
		.text = "the Laplacian of a wave: -k^2, or that of the centred differences of order 2, 4 or 6 (default: the law's)"},
	{.name = "screening", .kind = PM_REAL, .unit = "1/length", .fallback = "0", .high = 1e150, PM_AT(screening),
		.text = "K in lap phi - K^2 phi = c*s: one over the screening (Debye) length"},
	{.name = "wave-number", .kind = PM_REAL, .unit = "1/length", .fallback = "0", .high = 1e150, PM_AT(wave),
		.text = "a in lap phi + a^2 phi = c*s (Helmholtz): standing waves in a closed box; refused at a resonance"},
	{.name = "green", .kind = PM_WORD, .choices = pm_green_names, PM_AT(green),
		.text = "of open faces (default: hockney; of differences lattice); plummer, softened, for all faces"},
	{.name = "free-space", .kind = PM_WORD, .fallback = "doubled", .choices = spaces, PM_AT(space),
		.text = "open faces on twice the length, or by James' method: two solutions of fd2 between walls and the charge on them"},
	{.name = "softening", .kind = PM_REAL, .unit = "length", .high = 1e150, PM_AT(softening),
		.text = "of plummer (default: the frame's constant softening); of gauss2 to gauss10 delta of the blobs, exp(-(r/delta)^2) for gauss2 "
			"(default or 0: 2 sqrt(2) times the largest spacing of an open axis)"},
	{.name = "influence", .kind = PM_WORD, .fallback = "plain", .choices = pm_influence_names, PM_AT(influence),
		.text = "in periodic boxes: the inverse of the symbol; that divided by the square of the kernel's transform (p2m and m2p); or the influence "
			"function of least force error (Hockney and Eastwood), which has no symbol"},
	{.name = "order", .kind = PM_WORD, .choices = pm_order_names, PM_AT(order),
		.text = "the order of the mgrad that follows, for --influence optimal (default: the law's)"},
	{.name = "cloud", .kind = PM_REAL, .unit = "length", .fallback = "0", .high = 1e150, PM_AT(cloud),
		.text = "compute the force of balls of this diameter (density falling linearly to 0) instead of points; periodic boxes in 3-D"},
	PM_SOLVER_ROWS,
	PM_PLAN_ROW,
	{0},
};

static const struct pm_example examples[] = {
	{"the potential of a cluster in free space", "pinit plummer -n 2000 | p2m -n 32 | poisson-fft | sls"},
	{"the exact inverse of the second-order differences, in a periodic box",
		"pinit uniform -n 2000 | p2m -n 32 | poisson-fft --symbol fd2 | sls"},
	{"a screened plasma between a grounded plate and a plane of symmetry",
		"pinit uniform -n 2000 --faces wall,neumann,periodic,periodic,periodic,periodic | p2m -n 32 | poisson-fft --screening 5 | sls"},
	{"the cluster again, by solutions between walls", "pinit plummer -n 2000 | p2m -n 32 | poisson-fft --free-space james | sls"},
	{"the same cluster, softened as pp softens it", "pinit plummer -n 2000 --softening 0.3 | p2m -n 32 | poisson-fft --green plummer | sls"},
	{0},
};

static int declare(struct pm_stage *s, struct pm_frame *f)
{
	const struct config *o = s->config;
	struct state *t = s->state;
	int status = pm_problem_find(f, &o->names, &t->problem);
	if (status)
		return status;
	const struct pm_green *green = o->green ? pm_green_find(o->green) : NULL;
	const bool james = !strcmp(o->space, spaces[1]);
	const char *symbol = o->symbol ? o->symbol : james || (green && green->differences) ? "fd2"
		: t->problem.given.any ? "fd2" : !green && t->problem.law->symbol ? t->problem.law->symbol : "spectral";
	double softening = !isnan(o->softening) ? o->softening : green && green->factor ? pm_frame_constant(f, "softening", NAN) : 0;
	if (isnan(softening))
		return pm_fail(PM_DATA, "--green %s, and the frame has no softening (--softening LENGTH, or smod --constant softening=LENGTH)", green->name);
	t->choice = (struct pm_poisson_fft_choice){(enum pm_symbol)pm_symbol_find(symbol), o->screening, green, softening, {0}, 0, NULL, o->wave, james};
	const struct pm_influence_choice influence = {.name = o->influence, .symbol = o->symbol, .order = o->order, .cloud = o->cloud};
	status = pm_influence_choose(&influence, t->problem.law, pm_frame_field(f, t->problem.mesh->name, t->problem.source_name), &t->choice.influence);
	if (!status && t->problem.given.any)
		status = pm_poisson_fft_boundary_check(&t->problem.grid, &t->choice);
	if (!status)
		status = pm_poisson_fft_check(&t->problem.grid, &t->choice);
	if (!status)
		status = pm_problem_declare(f, &t->problem);
	if (!status && (o->screening != 0 || o->wave != 0))
		pm_problem_not_of_law(&t->problem);
	if (!status)
		t->problem.target->use |= PM_USE_FILL;
	return status;
}

/* The solver for a grid, made if there is none; NULL with a message. */
static struct pm_poisson_fft *ready(struct pm_stage *s, struct state *t, const struct pm_grid *g)
{
	struct pm_poisson_fft *solver = pm_fft_solvers_find(&t->solvers, g, &t->choice);
	if (solver)
		return solver;
	struct pm_clock began = pm_clock();
	solver = pm_fft_solvers_add(&t->solvers, g, &t->choice, t->problem.source->components == 1 && !t->problem.given.any);
	pm_setup_since(s, began);
	return solver;
}

/* One component, and what was removed from its source. most is raised to its largest absolute value, or is NAN: not known. */
static int component(struct pm_stage *s, struct pm_frame *f, int c, const struct pm_fft_plans **plans, double *most)
{
	struct state *t = s->state;
	const struct pm_problem *p = &t->problem;
	struct pm_grid g = pm_problem_grid(p, c);
	struct pm_poisson_fft *solver = ready(s, t, &g);
	struct pm_poisson_fft_record r;
	struct pm_homogeneous m;
	const int order = t->choice.symbol == PM_FD2 ? 2 : 0;
	int status = pm_world_agree(solver ? 0 : pm_failed());
	status = status ? status : pm_problem_move(p, f, c, order, NULL, &m);
	if (status)
		return status;
	status = pm_poisson_fft_solve(solver, m.c, m.s, pm_out(p->target, c), &r);
	if (!status && p->given.any && order == 0)
		status = pm_poisson_fft_boundary(&t->solvers, &t->choice, &m.boundary, pm_out(p->target, c));
	*plans = pm_poisson_fft_planner(solver);
	if (!status && pm_poisson_fft_singular(&g, &t->choice))
		pm_solver_report_removed(s, f, p, c, r.mean, &m, r.incompatible);
	*most = p->given.any || isnan(r.most) ? NAN : r.most > *most ? r.most : *most;
	if (t->choice.wave > 0)
		pm_report(s, f, "resonance_distance", pm_poisson_fft_distance(solver));
	pm_homogeneous_close(&m, pm_out(p->target, c));
	return status;
}

static int frame(struct pm_stage *s, struct pm_frame *f)
{
	struct state *t = s->state;
	const struct pm_fft_plans *p = NULL;
	struct pm_planes planes;
	int status = pm_world_agree(pm_planes_init(&planes, &t->problem.grid, t->problem.source));
	t->choice.planes = &planes;
	double most = 0;
	for (int c = 0; c < t->problem.source->components && !status; c++)
		status = component(s, f, c, &p, &most);
	t->choice.planes = NULL;
	pm_planes_free(&planes);
	if (status)
		return status;
	t->problem.target->use |= isfinite(most) ? PM_USE_SEEN : 0;
	t->problem.target->within = isfinite(most) && pm_world_alone() ? most : 0;
	char plan[16]; /* our own transforms are the same on all machines */
	snprintf(plan, sizeof plan, p && p->n ? "fftw %08x" : "own", p ? p->sum : 0);
	pm_report_text(s, f, "plan", plan);
	return 0;
}

static bool divided(const struct pm_stage *s, const struct pm_frame *f) { return f && (f->dim > 1 || !((const struct state *)s->state)->choice.james); }

static void release(struct pm_stage *s) { pm_fft_solvers_clear(&((struct state *)s->state)->solvers); }

const struct pm_tool tool_poisson_fft = {
	.name = "poisson-fft",
	.summary = "solve Poisson's equation on a mesh by fast transforms",
	.about = "Solves lap phi = c*s, or lap phi - K^2 phi = c*s with --screening, with the faces of the box: periodic (Fourier), wall (phi = 0, sines), "
		"neumann (no normal gradient, cosines) or open (free space, on a doubled domain), in any combination, also on opposite faces. If no face "
		"fixes phi, the mean of s is removed and reported, and the mean of phi is zero. A vector is solved component by component. With d open axes "
		"the Green's function is -1/(4 pi r) (d = 3), ln(r)/(2 pi) (2), |x|/2 (1), for means over the other axes.",
	.kind = PM_FILTER,
	.makes = true,
	.reads = "rho (mesh)",
	.changes = "",
	.adds = "phi (mesh)",
	.config = sizeof(struct config),
	.state = sizeof(struct state),
	.options = options,
	.examples = examples,
	.declare = declare,
	.frame = frame,
	.divided = divided,
	.free = release,
};
