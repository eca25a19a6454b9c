/* The part of a solver's report that does not depend on the solver. SPDX-License-Identifier: GPL-3.0-or-later */
#include <stdio.h>

#include "stage/solver-options.h"

const char *pm_solver_key(const struct pm_problem *p, const char *key, int c, char text[32])
{
	snprintf(text, 32, p->source->components > 1 ? "%s_%d" : "%s", key, c);
	return text;
}

/* Without walls phi exists only if the source and the given fluxes have the same integral. */
static void report_fluxes(struct pm_stage *s, struct pm_frame *f, const struct pm_problem *p, int c, const struct pm_homogeneous *m)
{
	const double all = m->charge_absolute + m->flux.absolute, more = m->charge - m->flux.total;
	const struct pm_grid *g = &m->boundary.grid;
	const double volume = pm_grid_cell(g) * (double)g->cells[0] * (double)g->cells[1] * (double)g->cells[2];
	char key[32];
	pm_report(s, f, pm_solver_key(p, "flux", c, key), m->flux.total);
	pm_report(s, f, pm_solver_key(p, "mean_removed", c, key), p->c != 0 ? more / (p->c * volume) : 0);
	pm_report(s, f, pm_solver_key(p, "incompatible", c, key), all > 0 ? fabs(more) / all : 0);
	if (fabs(more) > 1e-12 * all)
		pm_tell_once(s, "no phi has these fluxes: the integral of c*%s is %.6g, that of the fluxes %.6g; the difference, %.3g of their sizes, was "
			"spread over the box", p->source_name, m->charge, m->flux.total, fabs(more) / all);
}

void pm_solver_report_removed(struct pm_stage *s, struct pm_frame *f, const struct pm_problem *p, int c, double mean, const struct pm_homogeneous *m,
	double incompatible)
{
	char key[32];
	if (m->source) {
		report_fluxes(s, f, p, c, m);
		return;
	}
	pm_report(s, f, pm_solver_key(p, "mean_removed", c, key), mean);
	pm_report(s, f, pm_solver_key(p, "incompatible", c, key), incompatible);
	if (incompatible > 1e-12)
		pm_say(s, "no solution exists for this '%s' in this box: its mean %g, %.2g of its largest value, was removed", p->source_name, mean,
			incompatible);
}
