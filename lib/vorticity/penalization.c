/* Brinkman's penalization of the vorticity equation: in a body chi the flow u is driven to the body's velocity u_s,
 *     d omega/dt += curl b,   b = lambda chi (u_s - u)/(1 + lambda dt chi)
 * which is one implicit Euler step, and with lambda -> infinity b = chi (u_s - u)/dt. chi goes from 1 to 0 with the level phi of the body, phi < 0 inside,
 * over |phi| < w as 1/2 (1 - phi/w - sin(pi phi/w)/pi). The fluid's force on the body is -integral b.
 * Source: Angot, Bruneau, Fabrie 1999, Numer. Math. 81, 497; Coquerelle and Cottet 2008, J. Comput. Phys. 227, 9121; Rasmussen, Cottet, Walther 2011,
 * J. Comput. Phys. 230, 6742. Of order 1 in w and in the step. Cost: one curl and an expression a point. SPDX-License-Identifier: GPL-3.0-or-later */
#include <stdio.h>

#include "fft/axis-transform.h"
#include "law/law.h"
#include "mesh/gradient-parts.h"
#include "stream/declare.h"
#include "stream/limits.h"
#include "vorticity/penalization.h"
#include "world/world.h"

static int vector(struct pm_expression *e, struct pm_frame *f, const char *on, const char *text, const char *option, bool *there)
{
	*there = text != NULL;
	int status = text ? pm_expression_compile(e, f, on, text) : 0;
	if (!status && text && e->nparts != f->dim)
		return pm_fail(PM_USAGE, "--%s '%s' has %d components, and space has %d (one expression each, commas between)", option, text,
			e->nparts, f->dim);
	return status;
}

/* The level, the velocities, and what they act on. */
static int fields(const struct pm_penalization_choice *c, struct pm_frame *f, const struct pm_mesh *mesh, const struct pm_law *law, struct pm_penalization *p)
{
	const struct pm_field *omega = pm_frame_field(f, mesh->name, law->density), *u = pm_frame_field(f, mesh->name, law->field);
	if (!omega || !u)
		return pm_fail(PM_DATA, "no field '%s' on mesh '%s' (run p2m | poisson-fft | mgrad first)", omega ? law->field : law->density, mesh->name);
	p->omega = pm_reads(f, mesh->name, law->density), p->u = pm_reads(f, mesh->name, law->field);
	int status = p->omega && p->u ? pm_expression_compile(&p->body, f, mesh->name, c->body) : -PM_DATA;
	if (!status && p->body.nparts != 1)
		status = pm_fail(PM_USAGE, "--body '%s' has %d components (a level is one number, below 0 inside)", c->body, p->body.nparts);
	if (!status)
		status = vector(&p->velocity, f, mesh->name, c->velocity, "velocity", &p->moves);
	return status ? status : vector(&p->stream, f, mesh->name, c->stream, "stream", &p->streams);
}

int pm_penalization_declare(const struct pm_penalization_choice *c, struct pm_frame *f, struct pm_penalization *p)
{
	char name[PM_NAME];
	const struct pm_law *law = pm_law_of(f);
	const struct pm_mesh *mesh = pm_frame_mesh(f, c->mesh);
	if (!law)
		return -PM_DATA;
	if (law->of_potential != PM_CURL || !law->density || !law->field || f->dim < 2)
		return pm_fail(PM_DATA, "the law '%s' has no vorticity that a body could change (the law vortex has)", law->name);
	if (!mesh)
		return pm_fail(PM_DATA, "no mesh%s%s (p2m -n CELLS makes one)", c->mesh ? " " : "", c->mesh ? c->mesh : "");
	if (!(f->dt > 0))
		return pm_fail(PM_DATA, "the step is %g, and the flow in the body ends within one (smod --dt)", f->dt);
	*p = (struct pm_penalization){.grid = pm_grid_of(f, mesh), .rate = c->rate, .dt = f->dt, .width = c->width * mesh->h[0]};
	int order = pm_order_find(c->order ? c->order : law->order), status = order < 0 ? -PM_USAGE : fields(c, f, mesh, law, p);
	if (!status)
		status = pm_operator_init(&p->curl, &p->grid, PM_OP_CURL, order, f->dim, true);
	if (status)
		return status;
	snprintf(name, sizeof name, "d%.62s", law->density);
	p->change = pm_contributes(f, mesh->name, name, law->strength, p->omega->components, "penalization", c->replace);
	if (!p->change)
		return -PM_DATA;
	pm_field_inherit(p->change, p->omega);
	return 0;
}

static double inside(double phi, double w)
{
	return phi <= -w ? 1 : phi >= w ? 0 : 0.5 * (1 - phi / w - sin(pm_pi * phi / w) / pm_pi);
}

/* The factor of u_s - u, 1/time. */
static double pull(const struct pm_penalization *p, double chi) { return isnan(p->rate) ? chi / p->dt : p->rate * chi / (1 + p->rate * p->dt * chi); }

/* b of every component, from its expressions; *most of the factors. work: 3 n. Sums and most are those of all planes; called by all ranks. */
static int drive(const struct pm_penalization *p, const struct pm_frame *f, size_t n, double *factor, double *b, double force[3], double *most)
{
	double *other = b + (size_t)f->dim * n, cell = 1;
	struct pm_planes planes;
	int status = pm_planes_init(&planes, &p->grid, p->u);
	pm_expression_eval(&p->body, f, 0, n, factor);
	*most = 0;
	for (size_t i = 0; i < n; i++)
		factor[i] = pull(p, inside(factor[i], p->width)), *most = fmax(*most, factor[i]);
	for (int d = 0; d < f->dim; d++)
		cell *= p->grid.h[d];
	for (int d = 0; d < f->dim; d++) {
		double *to = b + (size_t)d * n;
		const double *u = pm_in(p->u, d);
		struct pm_sum sum = {0};
		for (size_t i = 0; i < n; i++)
			to[i] = -u[i];
		for (int k = 0; k < 2; k++) {
			if (!(k ? p->streams : p->moves))
				continue;
			pm_expression_eval(k ? &p->stream : &p->velocity, f, d, n, other);
			for (size_t i = 0; i < n; i++)
				to[i] += k ? -other[i] : other[i];
		}
		for (size_t i = 0; i < n; i++)
			to[i] *= factor[i];
		status = pm_planes_sum(status, &planes, to, NULL, NULL, &sum);
		force[d] = -cell * pm_sum_total(sum);
	}
	pm_planes_free(&planes);
	return pm_world_largest(status, 1, most);
}

int pm_penalization_add(struct pm_penalization *p, struct pm_frame *f, struct pm_fft_plans *plans, double force[3])
{
	const size_t n = p->u->count;
	double *b = pm_alloc((size_t)(f->dim + 2) * n + 1, sizeof *b), most;
	const double *in[3];
	double *out[3];
	int status = pm_world_agree(b ? 0 : -PM_DATA);
	if (plans->n > PM_FFT_PLANS - 3) /* frames of many sizes: empty the collection */
		pm_fft_plans_clear(plans);
	if (!status)
		status = pm_world_agree(pm_operator_plan(&p->curl, plans));
	if (!status)
		status = drive(p, f, n, b + (size_t)(f->dim + 1) * n, b, force, &most);
	if (!status) {
		for (int d = 0; d < 3; d++) {
			in[d] = b + (size_t)(d < f->dim ? d : 0) * n;
			out[d] = pm_out(p->change, d < p->change->components ? d : 0);
		}
		p->curl.add = p->change->nterms > 1;
		status = pm_operator_apply_planes(&p->curl, 1, p->u, in, out, NULL);
		pm_limits_add(p->change, (struct pm_limits){.decay = most});
	}
	pm_free(b);
	return status;
}
