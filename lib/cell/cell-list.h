/* Cell list: particles in the order of the cells they lie in, and for each cell the ranges of that order that contain every neighbour within reach; with
 * their periodic images and mirror images at faces. SPDX-License-Identifier: GPL-3.0-or-later */
#ifndef PM_CELL_LIST_H
#define PM_CELL_LIST_H

#include "stream/frame.h"

enum { PM_IMAGES_MOST = 65, PM_CELLS_PAD = 8 };

/* An image of a particle along an axis: at side*x + shift. */
struct pm_image {
	double side;  /* 1, or -1 mirrored */
	double shift; /* [length] */
	double sign;  /* of its strength: -1 after an odd number of mirrors that are walls */
};
struct pm_images {
	int n;
	struct pm_image image[PM_IMAGES_MOST]; /* the first is the particle itself */
};

/* The box of the particles, and its faces. */
struct pm_domain {
	int dim;
	double lo[3], hi[3];     /* [length] */
	enum pm_face face[3][2]; /* periodic: images a box apart; wall: odd mirror images; neumann: even ones; any other: none */
};
struct pm_domain pm_domain_of(const struct pm_frame *f);

struct pm_cell_list {
	struct pm_domain domain;
	double reach;           /* [length] partners are no farther than this */
	struct pm_images images[3];
	double lo[3], edge[3];  /* [length] cells begin at lo, a little before the box or the particles: those of a lattice are not on their edges */
	size_t cells[3];
	size_t n;               /* particles */
	size_t *order;          /* order[i]: the particle at place i */
	double *x[3];           /* by place, on periodic axes folded into lo..lo+box; PM_CELLS_PAD more, so that vectors may be loaded at any place */
	size_t occupied;        /* cells with particles */
	uint64_t *key;          /* of these, ascending; x fastest */
	size_t *start;          /* first place of each, and n */
	size_t *first;          /* of every cell: first place at or behind it; NULL where there are too many cells */
	size_t most;            /* upper bound of the number of ranges around a cell */
};

/* The kind of particles in a neighbour range: the particles themselves; periodic images shifted up (along the last axis with a shift) or down; mirror
 * images, also those of two mirrors that change the sign. If an image of q shifted up is a neighbour of p, an image of p shifted down is a neighbour of q,
 * so a method that treats pairs in both directions uses only one of the two. */
enum pm_range_kind { PM_HERE, PM_AHEAD, PM_BEHIND, PM_MIRRORED };

/* Places from..to-1; the separation from a particle at x is side*x + shift - their position. */
struct pm_neighbour_range {
	size_t from, to;
	double side[3], shift[3]; /* [length] */
	double sign;              /* of the strengths there */
	enum pm_range_kind kind;
};

/* The images along one axis that lie within reach of the box; failure if there are more than PM_IMAGES_MOST. */
int pm_images_of(double lo, double hi, const enum pm_face face[2], double reach, struct pm_images *images);

/* n positions; cells have about the given edge, no less than an eighth of reach. Free in any case. */
int pm_cell_list_init(struct pm_cell_list *l, const struct pm_domain *domain, size_t n, const double *const x[], double reach, double edge);
void pm_cell_list_free(struct pm_cell_list *l);
/* The ranges that contain all neighbours of the particles of the c-th occupied cell (and others), including themselves. half: each pair once, so no images
 * shifted down, and no places before the cell's. Returns their number; s has room for l->most. */
size_t pm_cell_list_around(const struct pm_cell_list *l, size_t c, bool half, struct pm_neighbour_range *s);

#endif
