/* One step: B by half of it, E, B by the other half, so that both are at the time of the frame before and after it. --gauss: lap psi = div E - rho/eps0 with
 * the symbol of the mesh's own differences, E -= grad psi (Boris 1970); then div E = rho/eps0 to round-off, and the other part of E is as it was.
 * --marder: E += d grad(div E - rho/eps0) (Marder 1987), d = 1/K^2 of the shortest waves, K^2 = 4 sum 1/h^2: a pass takes K(k)^2/K^2 of what is wrong in a
 * wave, all of it in the shortest, for a divergence and a gradient instead of a solution. Stable up to twice this d.
 * SPDX-License-Identifier: GPL-3.0-or-later */
#include <stdio.h>
#include <string.h>

#include "law/law.h"
#include "maxwell-parts/yee-waves.h"
#include "maxwell-step/maxwell-frame.h"
#include "stream/declare.h"
#include "world/world.h"

struct pm_yee pm_yee_of(const struct pm_frame *f, const struct pm_mesh *m)
{
	return (struct pm_yee){.grid = pm_grid_of(f, m), .c = pm_frame_constant(f, "c", 1), .eps0 = pm_frame_constant(f, "eps0", 1)};
}

enum where { ON_NODES, AS_E, AS_B };

static void stagger(struct pm_field *field, int dim, enum where where)
{
	for (int c = 0; c < 3; c++)
		for (int d = 0; d < dim; d++)
			field->staggered[c][d] = where != ON_NODES && (c == d) == (where == AS_E);
}

static bool sits(const struct pm_field *field, int dim, enum where where)
{
	struct pm_field want = {.components = 3};
	stagger(&want, dim, where);
	return field->components == 3 && !memcmp(want.staggered, field->staggered, 3 * sizeof *want.staggered);
}

bool pm_yee_staggered(const struct pm_field *field, int dim, bool electric) { return sits(field, dim, electric ? AS_E : AS_B); }

/* E or B of the mesh, to be changed; made of zeros where that is allowed. */
static struct pm_field *take(struct pm_frame *f, const struct pm_maxwell_job *j, const char *name, bool electric, bool make)
{
	const enum where where = j->yee.nodal ? ON_NODES : electric ? AS_E : AS_B;
	struct pm_field *field = pm_frame_field(f, j->mesh->name, name);
	if (!field && !make) {
		pm_fail(PM_DATA, "no field '%s' on mesh '%s' (p2m | maxwell --gauss makes it of the charge)", name, j->mesh->name);
		return NULL;
	}
	if (field && field->uniform && field->components == 3 && field->role == PM_STATE)
		stagger(field, f->dim, where); /* the same anywhere */
	if (field && (field->role != PM_STATE || !sits(field, f->dim, where))) {
		pm_fail(PM_DATA, "'%s' on mesh '%s' is not a state of 3 components %s the nodes (drop it: sel --drop %s; p2m | maxwell "
			"--gauss makes E)", name, j->mesh->name, j->yee.nodal ? "on" : "half a cell off", name);
		return NULL;
	}
	if (field)
		return pm_changes(f, j->mesh->name, name);
	if ((field = pm_makes(f, j->mesh->name, name, 3, PM_STATE)))
		stagger(field, f->dim, where);
	return field;
}

static int take_memory(struct pm_frame *f, struct pm_maxwell_job *j)
{
	const struct pm_grid *g = &j->yee.grid;
	for (int d = 0; d < g->dim; d++) {
		char name[8];
		snprintf(name, sizeof name, "pml_%c", "xyz"[d]);
		if (!pm_yee_open(g->face[d][0]) && !pm_yee_open(g->face[d][1]))
			continue;
		const size_t sides = (size_t)pm_yee_open(g->face[d][0]) + pm_yee_open(g->face[d][1]);
		if (sides * (size_t)j->choice.layers >= g->cells[d])
			return pm_fail(PM_DATA, "absorbing layers of %d cells do not fit %zu cells along %c (--layers N, or more cells)", j->choice.layers,
				g->cells[d], "xyz"[d]);
		const bool there = pm_frame_field(f, j->mesh->name, name);
		j->pml[d] = there ? pm_changes(f, j->mesh->name, name) : pm_makes(f, j->mesh->name, name, PM_PML_FIELDS, PM_STATE);
		if (!j->pml[d])
			return -PM_DATA;
		if (j->pml[d]->components != PM_PML_FIELDS)
			return pm_fail(PM_DATA, "'%s' on '%s' is not the memory of an absorbing layer (drop it)", name, j->mesh->name);
	}
	return 0;
}

/* Is there any particle whose current would be left out? */
static bool charges(const struct pm_frame *f, const struct pm_law *law)
{
	bool any = false;
	for (size_t i = 0; i < f->nsets; i++)
		any |= f->sets[i]->n && pm_set_moves(f, f->sets[i]) && pm_frame_field(f, f->sets[i]->name, law->strength);
	return any;
}

static int check_faces(const struct pm_frame *f, const struct pm_maxwell_job *j)
{
	for (int d = 0; d < f->dim && !j->method->any_face; d++)
		if (f->face[d][0] != PM_PERIODIC)
			return pm_fail(PM_DATA, "--method %s is made for periodic boxes (--method yee takes all faces)", j->method->name);
	return 0;
}

/* E and B are gathered with the kernel that their source was deposited with. */
static void take_kernel(struct pm_maxwell_job *j, struct pm_field *b, const struct pm_field *source)
{
	snprintf(j->e->kernel, sizeof j->e->kernel, "%s", source->kernel);
	if (b)
		snprintf(b->kernel, sizeof b->kernel, "%s", source->kernel);
}

static int check_step(const struct pm_frame *f, const struct pm_maxwell_job *j)
{
	const double limit = j->method->limit(&j->yee.grid), now = j->yee.c * fabs(f->dt);
	if (!(j->yee.c > 0))
		return pm_fail(PM_DATA, "the speed of light c is %g (smod --constant c=1)", j->yee.c);
	if (f->dt == 0 || !isfinite(f->dt))
		return pm_fail(PM_DATA, "the frame has no time step (smod --dt, or the word dt)");
	if (now > limit * (1 + 1e-12))
		return pm_fail(PM_NUMERICS, "c dt %.6g is %.6g times the limit %.6g of %s on mesh '%s', beyond which the shortest waves grow without bound "
			"(dt up to %.6g, or fewer cells)", now, now / limit, limit, j->method->name, j->mesh->name, limit / j->yee.c);
	return 0;
}

static int declare_advance(struct pm_frame *f, struct pm_maxwell_job *j, const struct pm_law *law)
{
	struct pm_field *current = pm_frame_field(f, j->mesh->name, "J");
	int status = check_step(f, j);
	if (status)
		return status;
	if (!current && charges(f, law))
		return pm_fail(PM_DATA, "no current 'J' on mesh '%s' (p2m --current before maxwell makes it; each J is used once)", j->mesh->name);
	if (current && (current->components != 3 || !pm_yee_staggered(current, f->dim, true)))
		return pm_fail(PM_DATA, "'J' on mesh '%s' does not sit where E does (p2m --current makes it)", j->mesh->name);
	if (current && !pm_reads(f, j->mesh->name, "J"))
		return -PM_DATA;
	j->j = current;
	if (current) {
		take_kernel(j, j->b, current);
		pm_drops(f, current);
	}
	return take_memory(f, j);
}

int pm_maxwell_declare(const struct pm_maxwell_choice *choice, struct pm_frame *f, struct pm_maxwell_job *j)
{
	const struct pm_law *law = pm_law_of(f);
	*j = (struct pm_maxwell_job){.choice = *choice,
		.method = pm_maxwell_find(choice->method ? choice->method : "yee"), .mesh = pm_frame_mesh(f, choice->mesh)};
	if (!law || !j->method)
		return -PM_DATA;
	if (!law->evolves)
		return pm_fail(PM_DATA, "the law '%s' has no fields that evolve (smod --law electromagnetic)", f->law);
	if (!j->mesh)
		return pm_fail(PM_DATA, "no mesh%s%s (p2m -n CELLS makes one)", choice->mesh ? " " : "", choice->mesh ? choice->mesh : "");
	j->yee = pm_yee_of(f, j->mesh);
	j->yee.layers = choice->layers;
	memcpy(j->yee.drift, choice->drift, sizeof j->yee.drift);
	const struct pm_field *before = pm_frame_field(f, j->mesh->name, law->field);
	j->spectral = j->method->spectral || (choice->gauss && !choice->method && before && pm_yee_spectral(before));
	j->yee.nodal = choice->nodal || (j->spectral && before && !before->uniform && sits(before, f->dim, ON_NODES));
	if (choice->marder && j->spectral)
		return pm_fail(PM_DATA, "--marder has two-point differences, and E on '%s' those of waves (maxwell --gauss is exact there)", j->mesh->name);
	j->e = take(f, j, law->field, true, choice->gauss && !choice->marder);
	if (!j->e || check_faces(f, j))
		return -PM_DATA;
	if (j->spectral && json_object_set_new(j->e->more, PM_DIFFERENCES, json_string("spectral")))
		return pm_fail(PM_DATA, "out of memory");
	if (choice->gauss && !pm_frame_field(f, j->mesh->name, law->magnetic) && !take(f, j, law->magnetic, false, true))
		return -PM_DATA; /* zeros, so that boris has what it needs */
	if (choice->gauss) {
		j->rho = pm_reads(f, j->mesh->name, law->density);
		if (j->rho && !*j->e->kernel && !j->rho->interlaced && strcmp(j->rho->kernel, "several")) /* else as the currents before */
			take_kernel(j, pm_frame_field(f, j->mesh->name, law->magnetic), j->rho);
		return j->rho ? 0 : pm_fail(PM_DATA, "no density '%s' on mesh '%s' (p2m makes it)", law->density, j->mesh->name);
	}
	j->b = take(f, j, law->magnetic, false, true);
	return j->b ? declare_advance(f, j, law) : -PM_DATA;
}

static void fill(struct pm_maxwell_job *j)
{
	for (int c = 0; c < 3; c++) {
		j->yee.e[c] = pm_out(j->e, c);
		j->yee.b[c] = j->b ? pm_out(j->b, c) : NULL;
		j->yee.j[c] = j->j ? pm_in(j->j, c) : NULL;
		for (int k = 0; k < PM_PML_FIELDS; k++)
			j->yee.pml[c][k] = j->pml[c] ? pm_out(j->pml[c], k) : NULL;
	}
}

/* B or E through dt from the curl of the other, which has planes of the neighbours on either side. */
static int advance_planes(int status, struct pm_maxwell_job *j, bool electric, double dt)
{
	struct pm_yee *y = &j->yee;
	double *room = NULL;
	const double *const *of = electric ? (const double *const *)y->b : (const double *const *)y->e;
	status = pm_planes_halo(status, y->planes, j->method->beside, 3, of, y->beside, &room);
	if (!status && electric)
		j->method->electric(y, dt);
	else if (!status)
		j->method->magnetic(y, dt);
	pm_free(room);
	return status;
}

static int step_planes(struct pm_maxwell_job *j, double dt)
{
	struct pm_planes planes;
	int status = pm_planes_init(&planes, &j->yee.grid, j->e);
	j->yee.planes = &planes;
	if (j->method->advance) {
		status = pm_world_agree(status);
		status = status ? status : j->method->advance(&j->yee, dt);
	} else {
		status = advance_planes(status, j, false, 0.5 * dt);
		status = advance_planes(status, j, true, dt);
		status = advance_planes(status, j, false, 0.5 * dt);
	}
	j->yee.planes = NULL;
	pm_planes_free(&planes);
	return status;
}

int pm_maxwell_step(struct pm_maxwell_job *j, double dt)
{
	fill(j);
	if (j->e->here)
		return step_planes(j, dt);
	if (j->method->advance)
		return j->method->advance(&j->yee, dt);
	j->method->magnetic(&j->yee, 0.5 * dt);
	j->method->electric(&j->yee, dt);
	j->method->magnetic(&j->yee, 0.5 * dt);
	return 0;
}

static double largest(size_t n, const double *a)
{
	double most = 0;
	for (size_t i = 0; i < n; i++)
		most = fmax(most, fabs(a[i]));
	return most;
}

static int project_waves(struct pm_maxwell_job *j, double *room, struct pm_gauss_record *r)
{
	const struct pm_grid *g = &j->yee.grid;
	const struct pm_planes *p = j->yee.planes;
	const double end[3][2] = {{1, 1}, {1, 1}, {1, 1}};
	struct pm_sum mean = {0, 0};
	int status = pm_yee_waves_divergence(&j->yee, pm_in(j->rho, 0), room);
	r->before = status ? 0 : largest(p ? p->here * p->size : pm_grid_size(g), room);
	if (p) {
		status = pm_world_largest(status, 1, &r->before);
		status = pm_planes_sum(status, p, room, NULL, end, &mean);
	} else if (!status) {
		pm_sum_of_mesh(g->points, room, NULL, end, &mean);
	}
	r->mean = pm_sum_total(mean) / (double)pm_grid_size(g);
	return status ? status : pm_yee_waves_correct(&j->yee, room);
}

/* div E - rho/eps0 of the planes here, and its largest value on the whole mesh. */
static int wrong(int status, struct pm_maxwell_job *j, double *to, double *most)
{
	struct pm_yee *y = &j->yee;
	const struct pm_planes *p = y->planes;
	double *room = NULL;
	const int last = y->grid.dim - 1; /* along the others no neighbour is on another rank */
	for (int d = 0; d < 3 && p; d++)
		y->beside[d] = y->e[d];
	if (p)
		status = pm_planes_halo(status, p, 1, 1, (const double *const *)&y->e[last], &y->beside[last], &room);
	if (!status)
		pm_yee_divergence(y, pm_in(j->rho, 0), to);
	*most = status ? 0 : largest(p ? p->here * p->size : pm_grid_size(&y->grid), to);
	pm_free(room);
	return p ? pm_world_largest(status, 1, most) : status;
}

static int subtract_gradient(int status, struct pm_maxwell_job *j, const double *psi)
{
	double *room = NULL;
	if (j->yee.planes)
		status = pm_planes_halo(status, j->yee.planes, 1, 1, &psi, &psi, &room);
	if (!status)
		pm_yee_subtract_gradient(&j->yee, psi);
	pm_free(room);
	return status;
}

static int project_differences(struct pm_maxwell_job *j, double *psi, struct pm_gauss_record *r)
{
	struct pm_grid g = j->yee.grid;
	const struct pm_poisson_fft_choice choice = {.symbol = PM_FD2, .planes = j->yee.planes};
	struct pm_poisson_fft_record record = {0};
	for (int d = 0; d < g.dim; d++)
		for (int s = 0; s < 2; s++)
			g.face[d][s] = pm_yee_open(g.face[d][s]) ? PM_WALL : g.face[d][s];
	struct pm_poisson_fft *solver = pm_poisson_fft_new(&g, &choice);
	int status = pm_planes_agree(solver ? 0 : pm_failed(), j->yee.planes);
	status = wrong(status, j, psi, &r->before);
	if (!status)
		status = pm_poisson_fft_solve(solver, 1, psi, psi, &record);
	r->mean = record.mean;
	status = subtract_gradient(status, j, psi);
	pm_poisson_fft_free(solver);
	return status;
}

static int relax_differences(struct pm_maxwell_job *j, double *room, struct pm_gauss_record *r)
{
	const struct pm_grid *g = &j->yee.grid;
	const size_t n = j->yee.planes ? j->yee.planes->here * j->yee.planes->size : pm_grid_size(g);
	double shortest = 0, most = 0;
	int status = 0;
	for (int d = 0; d < g->dim; d++)
		shortest += g->cells[d] > 1 ? 4 / (g->h[d] * g->h[d]) : 0;
	for (int pass = 0; pass < j->choice.marder && shortest > 0 && !status; pass++) {
		status = wrong(0, j, room, &most);
		r->before = pass ? r->before : most;
		for (size_t i = 0; i < n; i++)
			room[i] /= -shortest;
		status = subtract_gradient(status, j, room);
	}
	return status;
}

int pm_maxwell_project(struct pm_maxwell_job *j, struct pm_gauss_record *r)
{
	struct pm_planes planes = {.divided = false};
	int status = j->e->here ? pm_planes_init(&planes, &j->yee.grid, j->e) : 0;
	double *room = status ? NULL : pm_alloc(j->e->here ? planes.here * planes.size + 1 : pm_grid_size(&j->yee.grid), sizeof *room);
	*r = (struct pm_gauss_record){0, 0};
	fill(j);
	j->yee.planes = j->e->here ? &planes : NULL;
	status = pm_planes_agree(room ? 0 : pm_failed(), j->yee.planes);
	if (!status && j->choice.marder)
		status = relax_differences(j, room, r);
	else if (!status)
		status = j->spectral ? project_waves(j, room, r) : project_differences(j, room, r);
	j->yee.planes = NULL;
	pm_planes_free(&planes);
	pm_free(room);
	return status;
}
