/* An expression at every node of a mesh, as bytes: 1 where it is not 0. Cost: one evaluation a node. SPDX-License-Identifier: GPL-3.0-or-later */
#include "expression/mesh-mask.h"

int pm_mesh_mask_declare(struct pm_frame *f, const struct pm_mesh *m, const char *text)
{
	struct pm_expression e;
	int status = pm_expression_compile(&e, f, m->name, text);
	return status || e.nparts < 2 ? status : pm_fail(PM_USAGE, "--mask takes one expression, which is not 0 inside the body, not %d", e.nparts);
}

int pm_mesh_mask(struct pm_frame *f, const struct pm_mesh *m, const char *text, unsigned char **mask)
{
	struct pm_expression e;
	size_t n[3];
	int status = pm_expression_compile(&e, f, m->name, text);
	const size_t points = pm_mesh_points(f, m, n);
	double *value = status ? NULL : pm_alloc(points, sizeof *value);
	*mask = value ? pm_alloc(points, 1) : NULL;
	if (*mask)
		pm_expression_eval(&e, f, 0, points, value);
	for (size_t i = 0; i < points && *mask; i++)
		(*mask)[i] = value[i] != 0;
	pm_free(value);
	return status ? status : *mask ? 0 : -PM_DATA;
}
