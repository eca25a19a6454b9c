/* Kind, kernel and order of an influence function. SPDX-License-Identifier: GPL-3.0-or-later */
#include <string.h>

#include "mesh/gradient.h"
#include "poisson-fft/influence-choice.h"

int pm_influence_choose(const struct pm_influence_choice *o, const struct pm_law *law, const struct pm_field *source, struct pm_influence *i)
{
	*i = (struct pm_influence){.cloud = o->cloud, .interlaced = source->interlaced};
	while (strcmp(pm_influence_names[i->kind], o->name))
		i->kind++;
	if (i->kind == PM_PLAIN)
		return 0;
	if (i->kind == PM_OPTIMAL && o->symbol)
		return pm_fail(PM_USAGE, "--influence optimal has no --symbol (leave one of them out)");
	i->order = pm_order_find(o->order ? o->order : law->order ? law->order : "2");
	if (!strcmp(source->kernel, "several"))
		return pm_fail(PM_DATA, "'%s' on '%s' comes from fields made with different kernels, and --influence %s corrects for one (leave it out)",
			source->name, source->on, o->name);
	i->kernel = *source->kernel ? pm_kernel_find(source->kernel) : NULL;
	return i->order < 0 || (*source->kernel && !i->kernel) ? -PM_DATA : 0;
}
