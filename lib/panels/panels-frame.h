/* Solid walls of panels in a frame: what the word panels does. SPDX-License-Identifier: GPL-3.0-or-later */
#ifndef PM_PANELS_FRAME_H
#define PM_PANELS_FRAME_H

#include "expression/expression.h"
#include "panels/panels.h"

struct pm_panels_choice {
	const char *curve;            /* expression "x, y" of s = 0..1, counter-clockwise; NULL: the corners are in the set */
	const char *surface;          /* in space: "x, y, z" of the points x, y, z of the unit sphere; NULL: the corners are in the set */
	size_t n;                     /* panels of the curve or of the surface; 0: PM_PANELS_CURVE, PM_PANELS_SURFACE */
	const char *velocity, *stream; /* of the wall and of the fluid at the panels, "u, v" of x, y (in space "u, v, w" of x, y, z); NULL: 0 */
	const char *name;             /* the set of panels */
	const char *set;              /* the particles that are moved; NULL: all */
	double circulation;           /* [length^2/time] of the sheet of every curve */
	double softening;             /* [length] of the vortices, as the panels feel them; NAN: the frame's constant, else from the volumes */
	bool source, replace;
};

enum { PM_PANELS_CURVE = 200, PM_PANELS_SURFACE = 1280 };

/* From the header to the data. */
struct pm_panels_job {
	struct pm_expression curve, velocity, stream; /* curve: or the surface */
};

/* For surface-frame.c too: whether a set is moved by the panels; an expression of as many parts as there are axes (text NULL: none). */
bool pm_panels_moves(const struct pm_panels_choice *c, const struct pm_frame *f, const struct pm_set *set);
int pm_panels_vector(struct pm_expression *e, struct pm_frame *f, const char *on, const char *text, const char *option);

/* Each 0 or failure. Header: the set of panels, and the change vel of the particles. */
int pm_panels_declare(const struct pm_panels_choice *c, struct pm_frame *f, struct pm_panels_job *job);
/* Data. */
int pm_panels_apply(const struct pm_panels_choice *c, struct pm_frame *f, const struct pm_panels_job *job, struct pm_panels_solver *solver,
	struct pm_panels_solved *done);

/* For words that have such a wall: the set with its expressions, and the geometry now; p->n and p->curve are given. */
int pm_panels_declare_wall(const struct pm_panels_choice *c, struct pm_frame *f, struct pm_panels_job *job);
int pm_panels_wall(const struct pm_panels_choice *c, struct pm_frame *f, const struct pm_panels_job *job, struct pm_panels *p);
/* u += sign times the expression at the n panels. work: n. */
void pm_panels_add_given(const struct pm_expression *e, const struct pm_frame *f, size_t n, double sign, double *work, double *const u[2]);

#endif
