/* Where the viscosity comes from, and what is said where it is 0 or negative. SPDX-License-Identifier: GPL-3.0-or-later */
#include <stdlib.h>

#include "stage/viscosity-options.h"
#include "world/world.h"

double pm_viscosity(const struct pm_frame *f, double typed) { return isnan(typed) ? pm_frame_constant(f, "nu", 0) : typed; }

int pm_viscosity_check(struct pm_stage *s, double nu)
{
	if (!(nu >= 0))
		return pm_fail(PM_DATA, "the viscosity nu is %g: negative diffusion has no solution (--nu, or the scene's)", nu);
	return nu == 0 ? pm_idle(s, "the viscosity nu is 0") : 0;
}

static int check_axes(struct pm_stage *s, const struct pm_frame *f, const char *typed, const struct pm_viscosity *v)
{
	bool any = false;
	for (int d = 0; d < f->dim; d++) {
		any = any || v->axis[d] != 0;
		if (!(v->axis[d] >= 0 && v->axis[d] <= 1e300))
			return pm_fail(PM_USAGE, "--nu %s: the viscosity is %g along %c, and negative diffusion has no solution", typed, v->axis[d], "xyz"[d]);
	}
	return any ? 0 : pm_idle(s, "the viscosity nu is 0");
}

int pm_viscosity_typed(const char *typed)
{
	char *end = NULL;
	return typed && strtod(typed, &end) < 0 && !*end ? pm_fail(PM_USAGE, "--nu %s: negative diffusion has no solution", typed) : 0;
}

int pm_viscosity_of(struct pm_stage *s, struct pm_frame *f, const char *on, const char *typed, struct pm_viscosity *v)
{
	const double constant = pm_viscosity(f, NAN);
	*v = (struct pm_viscosity){.axis = {constant, constant, constant}, .least = constant, .ratio = {1, 1, 1}};
	if (!typed)
		return pm_viscosity_check(s, constant);
	if (pm_expression_compile(&v->e, f, on, typed))
		return -PM_USAGE;
	if (v->e.nparts != 1 && v->e.nparts != f->dim)
		return pm_fail(PM_USAGE, "--nu '%s' has %d components: give one, or one for each of the %d axes", typed, v->e.nparts, f->dim);
	v->varies = v->e.nvalues > 0;
	if (v->varies && v->e.nparts > 1)
		return pm_fail(PM_USAGE, "--nu '%s' differs between axes and varies: a tensor takes numbers, what varies is one expression for all axes",
			typed);
	for (int d = 0; d < 3; d++) {
		v->axis[d] = 1;
		if (!v->varies)
			pm_expression_eval(&v->e, f, d < v->e.nparts ? d : 0, 1, &v->axis[d]);
	}
	v->least = fmin(v->axis[0], fmin(v->axis[1], v->axis[2]));
	for (int d = 0; d < 3; d++)
		v->ratio[d] = v->axis[d] / v->least;
	return v->varies ? 0 : check_axes(s, f, typed, v);
}

int pm_viscosity_values(int status, const struct pm_viscosity *v, const struct pm_frame *f, size_t n, double *at, double *least, double *most)
{
	double ends[2] = {0, -HUGE_VAL};
	if (!status)
		pm_expression_eval(&v->e, f, 0, n, at);
	for (size_t i = 0; i < n && !status; i++) {
		ends[0] = fmax(ends[0], at[i]), ends[1] = fmax(ends[1], -at[i]);
		if (!(at[i] >= 0 && at[i] <= 1e300))
			status = pm_fail(PM_DATA, "the viscosity is %g somewhere on '%s': negative diffusion has no solution (--nu 'max(0, ...)')", at[i],
				v->e.on);
	}
	status = pm_world_largest(pm_world_agree(status), 2, ends);
	*most = ends[0], *least = fmax(0, -ends[1]);
	return status;
}
