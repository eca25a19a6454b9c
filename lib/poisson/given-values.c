/* Boundary values from expressions. A name for all faces of a kind is overridden by that of one face. SPDX-License-Identifier: GPL-3.0-or-later */
#include <string.h>

#include "mesh/given-faces.h"
#include "poisson/boundary-sum.h"
#include "poisson/given-values.h"

const char *const pm_given_open_names[] = {"free", "sum", NULL};

/* The text of a face, and what cannot be. */
static int face_text(const struct pm_given_names *o, const struct pm_grid *g, int d, int side, const char **text)
{
	enum pm_face face = g->face[d][side];
	const char *own = o->face[d][side];
	if (own && (d >= g->dim || face == PM_PERIODIC || face == PM_ABSORBING))
		return pm_fail(PM_USAGE, "--%s: %s (values are given on wall, neumann and open faces)", pm_face_places[d][side],
			d >= g->dim ? "this mesh has no such face" : face == PM_PERIODIC ? "this face is periodic" : "this face is absorbing");
	*text = own ? own : d >= g->dim ? NULL : face == PM_WALL || face == PM_OPEN ? o->dirichlet : face == PM_NEUMANN ? o->flux : NULL;
	return 0;
}

static int sums(const struct pm_frame *f, const struct pm_law *law, const struct pm_grid *g, struct pm_given_values *v)
{
	for (int a = 0; a < 2 * g->dim; a++)
		if (g->face[a / 2][a % 2] != PM_OPEN || v->text[a / 2][a % 2])
			return pm_fail(PM_DATA, "--open-faces sum needs a box that is open on all faces, and no other values (leave it out: they are then "
				"free space)");
	if (!law->strength || !law->coefficient || !(law->dims >> f->dim & 1))
		return pm_fail(PM_DATA, "the law %s has no sum over particles in %d-D (leave out --open-faces sum)", law->name, f->dim);
	if (law->background && pm_frame_constant(f, law->background, 0) != 0)
		return pm_fail(PM_DATA, "--open-faces sum is over particles, and this frame has a uniform background too (smod --constant %s=0)",
			law->background);
	v->any = v->sum = true;
	return 0;
}

int pm_given_find(const struct pm_given_names *o, const struct pm_frame *f, const struct pm_law *law, struct pm_grid *g, struct pm_given_values *v)
{
	int walls = 0, fluxes = 0, status = 0;
	memset(v, 0, sizeof *v);
	for (int a = 0; a < 6 && !status; a++) {
		status = face_text(o, g, a / 2, a % 2, &v->text[a / 2][a % 2]);
		v->any |= v->text[a / 2][a % 2] != NULL;
		walls += a / 2 < g->dim && (g->face[a / 2][a % 2] == PM_WALL || g->face[a / 2][a % 2] == PM_OPEN);
		fluxes += a / 2 < g->dim && g->face[a / 2][a % 2] == PM_NEUMANN;
	}
	if (!status && ((o->dirichlet && !walls) || (o->flux && !fluxes)))
		return pm_fail(PM_USAGE, "--%s: no face of the box is %s (pinit --faces or smod --faces makes one)",
			o->dirichlet && !walls ? "dirichlet" : "flux", o->dirichlet && !walls ? "a wall or open" : "neumann");
	if (!status && o->open && !strcmp(o->open, "sum"))
		status = sums(f, law, g, v);
	for (int a = 0; a < 2 * g->dim && !status; a++) {
		enum pm_face *face = &g->face[a / 2][a % 2];
		v->inside[a / 2][a % 2] = v->text[a / 2][a % 2] && *face != PM_OPEN;
		v->opened |= v->text[a / 2][a % 2] && *face == PM_OPEN;
		if (*face == PM_OPEN && (v->sum || v->text[a / 2][a % 2]))
			*face = PM_WALL;
	}
	return status;
}

int pm_given_declare(struct pm_given_values *v, struct pm_frame *f, const char *mesh, const struct pm_law *law, const struct pm_field *density)
{
	int status = v->sum ? pm_boundary_sum_declare(f, law, density) : 0;
	for (int a = 0; a < 6 && !status; a++) {
		struct pm_expression *e = &v->e[a / 2][a % 2];
		const char *text = v->text[a / 2][a % 2];
		status = text ? pm_expression_compile(e, f, mesh, text) : 0;
		if (!status && text && e->nparts != 1 && e->nparts != density->components)
			status = pm_fail(PM_USAGE, "'%s' has %d parts for a field of %d components (one for all, or one each with commas between)", text,
				e->nparts, density->components);
	}
	return status;
}

/* Each rank takes the nodes that it has. */
static int evaluate(const struct pm_given_values *v, const struct pm_frame *f, int d, int side, int c, struct pm_boundary *b)
{
	const struct pm_expression *e = &v->e[d][side];
	size_t from, to;
	pm_boundary_here(b, d, side, &from, &to);
	size_t n = to - from, *node = pm_alloc(n + 1, sizeof *node);
	int status = node ? pm_boundary_room(b, d, side) : -PM_DATA;
	for (size_t i = 0; node && i < n; i++)
		node[i] = pm_boundary_node(b, d, side, from + i);
	if (!status)
		pm_expression_eval_at(e, f, e->nparts > 1 ? c : 0, n, node, b->value[d][side] + from);
	if (!status && !pm_finite_few(n, b->value[d][side] + from))
		status = pm_fail(PM_NUMERICS, "'%s' is not finite at a node of the face %s", v->text[d][side], pm_face_places[d][side]);
	pm_free(node);
	return pm_boundary_share(status, b, d, side, b->value[d][side]);
}

int pm_given_evaluate(const struct pm_given_values *v, const struct pm_frame *f, const struct pm_law *law, const struct pm_field *density, int c,
	double coefficient, struct pm_boundary *b)
{
	int status = v->sum ? pm_boundary_sum(f, law, density, c, coefficient, b) : 0;
	for (int a = 0; a < 6 && !status; a++)
		if (v->text[a / 2][a % 2])
			status = evaluate(v, f, a / 2, a % 2, c, b);
	return status;
}
