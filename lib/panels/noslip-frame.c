/* The viscous part of a step beside walls: diffusion without flux, then the slip that is left enters the fluid as a flux of vorticity.
 * A wall that turns is a sheet u.t and sources u.n on its panels (Green's identity for the rigid flow within), so the sheet that is solved for is the
 * fluid's own velocity along the wall; less that of the wall it is the slip. Its total closes the circulation of the flow at infinity.
 * Source: Koumoutsakos and Leonard 1995, J. Fluid Mech. 296, 1. SPDX-License-Identifier: GPL-3.0-or-later */
#include <string.h>

#include "law/law.h"
#include "panels/noslip-frame.h"
#include "panels/wall-flux.h"
#include "stream/declare.h"

static int vortices(const struct pm_panels_choice *c, struct pm_frame *f, struct pm_noslip_job *job)
{
	job->on = NULL;
	for (size_t i = 0; i < f->nsets; i++) {
		const struct pm_field *q = pm_frame_field(f, f->sets[i]->name, "circulation");
		if (!q || q->role != PM_STATE || !strcmp(f->sets[i]->name, c->name))
			continue;
		if (job->on)
			return pm_fail(PM_DATA, "the sets '%s' and '%s' have vortices, and noslip is for one set (stack --merge)", job->on, f->sets[i]->name);
		job->on = f->sets[i]->name;
	}
	if (!job->on)
		return pm_fail(PM_DATA, "no particles with circulation (pinit cylinder)");
	return pm_reads(f, job->on, "x") && pm_changes(f, job->on, "circulation") ? 0 : -PM_DATA;
}

int pm_noslip_law(const struct pm_frame *f)
{
	const struct pm_law *law = pm_law_of(f);
	if (!law)
		return -PM_DATA;
	return f->dim == 2 && !strcmp(law->name, "vortex") ? 0 :
		pm_fail(PM_DATA, "noslip is for vortices in the plane, and this frame is of the law '%s' in %d-D", law->name, f->dim);
}

int pm_noslip_declare(const struct pm_panels_choice *c, struct pm_frame *f, struct pm_noslip_job *job)
{
	if (!pm_frame_mesh(f, NULL))
		return pm_fail(PM_DATA, "no mesh whose nodes the particles are (remesh -n CELLS makes one)");
	if (!(f->dt > 0))
		return pm_fail(PM_DATA, "the step is %g, and the slip becomes a flux over a step (smod --dt)", f->dt);
	const int status = vortices(c, f, job);
	return status ? status : pm_panels_declare_wall(c, f, &job->wall);
}

/* Sums over the particles. */
struct moments {
	double circulation, impulse[2], angular; /* sum Gamma, Gamma (y, -x), -Gamma r^2/2 */
	bool any;                                /* is one not 0? */
};

static struct moments moments_of(const struct pm_wall_fluid *w)
{
	struct pm_sum sum[4] = {0};
	bool any = false;
	for (size_t i = 0; i < w->n; i++) {
		const double q = w->circulation[i], x = w->x[0][i], y = w->x[1][i];
		any |= q != 0;
		pm_sum_add(&sum[0], q), pm_sum_add(&sum[1], q * y), pm_sum_add(&sum[2], -q * x), pm_sum_add(&sum[3], -0.5 * q * (x * x + y * y));
	}
	return (struct moments){pm_sum_total(sum[0]), {pm_sum_total(sum[1]), pm_sum_total(sum[2])}, pm_sum_total(sum[3]), any};
}

/* The velocity along the wall, and what of it a translation does not explain enters u by its sources. work: 2 n. */
static void turning(const struct pm_panels *p, double *const wall[2], double *work, double *const u[2], double *along)
{
	const size_t n = p->n;
	double mean[2] = {0}, length = 0, most = 0, out = 0;
	for (size_t i = 0; i < n; i++) {
		mean[0] += wall[0][i] * p->length[i], mean[1] += wall[1][i] * p->length[i], length += p->length[i];
		most = fmax(most, hypot(wall[0][i], wall[1][i]));
	}
	memset(work, 0, 2 * n * sizeof *work);
	for (size_t i = 0; i < n; i++) {
		const double du = wall[0][i] - mean[0] / length, dv = wall[1][i] - mean[1] / length;
		work[i] = du * p->normal[0][i] + dv * p->normal[1][i];
		along[i] = dv * p->normal[0][i] - du * p->normal[1][i];
		out = fmax(out, fabs(work[i]));
		u[0][i] -= mean[0] / length, u[1][i] -= mean[1] / length;
	}
	if (!(out > 1e-12 * most))
		return;
	struct pm_panels sources = *p;
	sources.source = true;
	pm_panels_along(&sources, work, work + n);
	for (size_t i = 0; i < n; i++)
		u[0][i] -= work[n + i] * p->normal[1][i], u[1][i] += work[n + i] * p->normal[0][i];
}

/* Circulation of the fluid about each curve that closes that at infinity. */
static int totals(const struct pm_panels *p, double missing, const double *along, double *total)
{
	double turn = 0, speed = 0, length = 0;
	for (size_t i = 0; i < p->n; i++)
		turn += along[i] * p->length[i], speed += fabs(along[i]) * p->length[i], length += p->length[i];
	if (p->curves > 1 && fabs(turn) > 1e-9 * speed)
		return pm_fail(PM_DATA, "%zu bodies of which some turn: noslip knows the circulation of one (one curve)", p->curves);
	memset(total, 0, p->curves * sizeof *total);
	for (size_t i = 0; i < p->n; i++)
		total[p->curve[i]] += missing * p->length[i] / length;
	return 0;
}

/* sheet: the slip. work: 8 n. */
static int slip(const struct pm_panels_choice *c, struct pm_frame *f, const struct pm_noslip_job *job, const struct pm_wall_fluid *w, const struct pm_panels *p,
	struct pm_panels_solver *solver, double *sheet, double *work)
{
	const size_t n = p->n;
	double *u[2] = {work, work + n}, *wall[2] = {work + 2 * n, work + 3 * n}, *along = work + 4 * n, *total = work + 5 * n;
	const struct pm_panels_flow flow = {.u = {u[0], u[1]}, .total = total};
	struct pm_panels_solved solved;
	memset(work, 0, 8 * n * sizeof *work);
	if (job->wall.velocity.nparts)
		pm_panels_add_given(&job->wall.velocity, f, n, 1, work + 6 * n, wall);
	if (job->wall.stream.nparts)
		pm_panels_add_given(&job->wall.stream, f, n, 1, work + 6 * n, u);
	turning(p, wall, work + 6 * n, u, along);
	pm_wall_slip(w, p, u);
	int status = totals(p, c->circulation - moments_of(w).circulation, along, total);
	if (!status)
		status = pm_panels_solve(p, &flow, solver, sheet, &solved);
	for (size_t i = 0; i < n && !status; i++)
		sheet[i] -= along[i];
	return status;
}

static int step(const struct pm_panels_choice *c, struct pm_frame *f, const struct pm_noslip_job *job, struct pm_panels_solver *solver, struct pm_wall_fluid *w,
	struct pm_panels *p, double *work, struct pm_noslip_done *done)
{
	double *sheet = pm_out(pm_frame_field(f, c->name, "sheet"), 0);
	int status = pm_panels_wall(c, f, &job->wall, p);
	if (!status)
		status = pm_wall_fluid_find(w, p);
	if (status)
		return status;
	const struct moments before = moments_of(w);
	pm_wall_diffuse(w, job->nu, f->dt, work);
	status = slip(c, f, job, w, p, solver, sheet, work);
	if (!status)
		status = pm_wall_flux(w, p, sheet, job->nu, f->dt, !before.any, &done->plain);
	const struct moments after = moments_of(w);
	for (size_t i = 0; i < p->n; i++)
		done->slip = fmax(done->slip, fabs(sheet[i]));
	for (int d = 0; d < 2; d++)
		done->force[d] = (before.impulse[d] - after.impulse[d]) / f->dt;
	done->torque = (before.angular - after.angular) / f->dt;
	done->given = after.circulation - before.circulation;
	return status;
}

int pm_noslip_apply(const struct pm_panels_choice *c, struct pm_frame *f, const struct pm_noslip_job *job, struct pm_panels_solver *solver,
	struct pm_noslip_done *done)
{
	struct pm_field *x = pm_frame_field(f, job->on, "x");
	struct pm_panels p = {.n = pm_frame_set(f, c->name)->n};
	struct pm_wall_fluid w = {.grid = pm_grid_of(f, pm_frame_mesh(f, NULL)), .n = pm_frame_set(f, job->on)->n, .x = {pm_in(x, 0), pm_in(x, 1)},
		.circulation = pm_out(pm_frame_field(f, job->on, "circulation"), 0)};
	double *work = pm_alloc((8 * p.n > w.n ? 8 * p.n : w.n) + 1, sizeof *work);
	*done = (struct pm_noslip_done){0};
	p.curve = pm_zalloc(p.n + 1, sizeof *p.curve);
	w.at = pm_zalloc(pm_grid_size(&w.grid) + 1, sizeof *w.at);
	const int status = work && p.curve && w.at ? step(c, f, job, solver, &w, &p, work, done) : -PM_DATA;
	pm_free(work), pm_free(p.curve), pm_free(w.at);
	return status;
}
