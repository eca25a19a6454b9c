/* An expression at every node of a mesh, as bytes: 1 where it is not 0. Cost: one evaluation a node; with ranks a byte a node
 * travels to each. SPDX-License-Identifier: GPL-3.0-or-later */
#include <stdlib.h>
#include <string.h>

#include "expression/mesh-mask.h"
#include "stream/parts.h"
#include "world/world.h"

int pm_mesh_mask_declare(struct pm_frame *f, const struct pm_mesh *m, const char *text)
{
	struct pm_expression e;
	int status = pm_expression_compile(&e, f, m->name, text);
	return status || e.nparts < 2 ? status : pm_fail(PM_USAGE, "--mask takes one expression, which is not 0 inside the body, not %d", e.nparts);
}

/* The nodes from..to-1 of the mesh, which are those here. */
static int evaluate(const struct pm_frame *f, const struct pm_expression *e, size_t from, size_t to, unsigned char *mask)
{
	const size_t n = to - from;
	size_t before = from, *index = pm_alloc(n + 1, sizeof *index);
	double *value = pm_alloc(n + 1, sizeof *value);
	const int status = index && value ? 0 : -PM_DATA;
	for (size_t i = 0; i < f->nfields; i++)
		before = f->fields[i]->here && !strcmp(f->fields[i]->on, e->on) ? 0 : before; /* the values of fields are counted from the first one here */
	for (size_t i = 0; i < n && !status; i++)
		index[i] = before + i;
	if (!status)
		pm_expression_eval_at(e, f, 0, n, index, value);
	for (size_t i = 0; i < n && !status; i++)
		mask[from + i] = value[i] != 0;
	pm_free(index), pm_free(value);
	return status;
}

int pm_mesh_mask(struct pm_frame *f, const struct pm_mesh *m, const char *text, bool shared, unsigned char **mask)
{
	struct pm_expression e;
	size_t n[3];
	int status = pm_expression_compile(&e, f, m->name, text);
	const size_t points = pm_mesh_points(f, m, n), me = shared ? (size_t)pm_world_rank() : 0, ranks = shared ? (size_t)pm_world_size() : 1;
	uint64_t alone[] = {0, points}, *division = shared ? pm_division_new(points, pm_division_grain(f, m->name)) : NULL, *from = shared ? division : alone;
	*mask = status ? NULL : pm_alloc(points + 1, 1);
	status = status ? status : *mask && from ? 0 : pm_failed();
	status = status ? status : evaluate(f, &e, from[me], from[me + 1], *mask);
	status = shared ? pm_world_agree(status) : status;
	for (size_t r = 0; r < ranks && shared && !status; r++)
		status = pm_world_share(status, (int)r, *mask + from[r], from[r + 1] - from[r]);
	free(division);
	return status;
}
