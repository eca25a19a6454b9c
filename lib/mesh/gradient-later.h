/* The gradient of a potential, or in the plane the curl of a stream function, that is left to be made (stream/later.h): m2p makes of it the nodes that a tile
 * of particles needs, from a potential that is a third or half the size of the gradient and was just written. SPDX-License-Identifier: GPL-3.0-or-later */
#ifndef PM_MESH_GRADIENT_LATER_H
#define PM_MESH_GRADIENT_LATER_H

#include "mesh/gradient-frame.h"
#include "stream/later.h"

struct pm_gradient_later {
	struct pm_later later; /* first member */
	struct pm_operator operator;
	double factor;
	double within;       /* no |gradient| is larger; from the largest potential */
	int axis[3];         /* [component] along which it is differenced; as many components as axes */
	double weight[3][3]; /* [component][pair]: sum over pairs of weight (value so far up its axis - value so far down) is the component at every node */
};

/* In frame(): leaves the target to be made, in a periodic box in the plane or in space where no value can be infinite; *left false: it does not. 0 or
 * failure. */
int pm_gradient_leave(struct pm_gradient *t, bool *left);
double pm_gradient_later_most(const struct pm_gradient_later *l);                   /* the largest |gradient| of all nodes, or a little more: a pass */
const struct pm_gradient_later *pm_gradient_later_of(const struct pm_field *field); /* NULL: its values are there, or of another kind */

#endif
