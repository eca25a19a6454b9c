/* How the effects of a plan are computed: pairs or a mesh, kernel, order, scheme, step. SPDX-License-Identifier: GPL-3.0-or-later */
#include <string.h>

#include "stage/plan.h"

/* Nanoseconds of one core (docs/speed.md): a pair of pp; a point of the transform's mesh with all that is done there; a particle to the mesh and back. */
static const double ns_pair = 0.15, ns_point = 15, ns_particle = 60;

static double cost_pairs(const struct pm_scales *s) { return ns_pair * s->n * s->sources; }

static double cost_mesh(const struct pm_scales *s) { return ns_point * s->points * (s->open ? pow(2, s->dim) : 1) + ns_particle * s->n; }

/* pp sums in open space only; particles that carry a field need its mesh. */
static bool pairs(const struct pm_frame *f, const struct pm_plan *p, char why[160])
{
	const struct pm_scales *s = &p->scales;
	const bool all_open = s->open && !s->periodic && !s->walls, field = s->kind == PM_VORTICES && s->overlap < 0.3 && s->width > 0.7 * s->h && s->width < 1.4 * s->h;
	const double a = cost_pairs(s), b = f->nmeshes ? cost_mesh(s) : HUGE_VAL;
	if (!all_open)
		snprintf(why, 160, "a %s box", s->periodic ? "periodic" : "walled");
	else if (field)
		snprintf(why, 160, "the particles carry a field: they cover the mesh to %.1g", s->overlap);
	else if (a <= b)
		snprintf(why, 160, "%g bodies, pairs cost %.1g of the mesh", s->sources, a / b);
	else
		snprintf(why, 160, "%g bodies, a mesh costs %.1g of the pairs", s->sources, b / a);
	return all_open && !field && a <= b;
}

void pm_plan_method(const struct pm_frame *f, struct pm_plan *p)
{
	struct pm_method *m = &p->method;
	const struct pm_scales *s = &p->scales;
	*m = (struct pm_method){.dt = NAN, .kernel = p->law->kernel, .order = p->law->order, .scheme = s->second ? "leapfrog" : "rk4"};
	m->pairs = (s->kind == PM_MASSES || s->kind == PM_CHARGES || s->kind == PM_VORTICES) && pairs(f, p, m->why_far);
	if (s->kind == PM_VORTICES && !m->pairs) {
		m->kernel = "m6prime"; /* m4prime makes vortices that are not there (VM-16) */
		m->scheme = "lsrk3";
	}
	snprintf(m->why_mesh, sizeof m->why_mesh, "mesh and kernel %s as the scene has them", m->kernel);
	snprintf(m->why_step, sizeof m->why_step, "%s, dt = %.3g as the scene has it", m->scheme, f->dt);
}
