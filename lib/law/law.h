/* Laws: which strength makes which mesh field by which equation, and what it adds to the particles. One file per law; signs and factors live
 * here and nowhere else. SPDX-License-Identifier: GPL-3.0-or-later */
#ifndef PM_LAW_H
#define PM_LAW_H

#include <string.h>

#include "mesh/grid.h"

PM_C_BEGIN

struct pm_law_constant {
	const char *name, *unit;
	double otherwise; /* default */
	const char *text;
	bool positive; /* no other value has a meaning */
};

struct pm_law {
	const char *name, *sentence, *source;
	unsigned dims;          /* bit 1u<<dim for each dimension it is defined in */
	const char *strength;   /* particle field deposited: "mass", "charge", "circulation", "alpha"; NULL: none (free, passive) */
	bool vector;            /* the strength, the density and the potential have 3 components */
	const char *density;    /* mesh field p2m makes of it: "rho", "omega" */
	const char *background; /* constant of the frame that p2m adds to the density; NULL none */
	const char *potential;  /* what a solver makes: "phi", "psi" */
	const char *field;      /* what mgrad makes: "g", "E", "u"; dim components */
	int wave;               /* component of the field that waves along x have: 0; 1 for a velocity without divergence, whose u.x cannot vary */
	enum { PM_GRADIENT, PM_CURL } of_potential; /* field = sign * grad(potential), or the curl: (d psi/dy, -d psi/dx) of a scalar */
	double sign;            /* of the gradient: -1 for g and E */
	const char *change, *of;/* what m2p and pp add to: "acc" of "v", "vel" of "x" */
	const char *per;        /* change = (strength/per) * field: "mass" for (q/m) E; NULL: the field itself */
	const char *magnetic;   /* mesh field that m2p interpolates to bfield if the frame has it: "B"; NULL none */
	bool evolves;           /* field and magnetic are states of the mesh, staggered, which a word advances in time (maxwell); no potential */
	bool relativistic;      /* its magnetic kicks advance gamma v, with the constant c */
	double (*coefficient)(const struct pm_frame *f); /* c in lap potential = c * density */
	const char *kernel;     /* defaults of the words' options */
	const char *symbol;     /* of poisson-fft: "spectral", "fd2", "fd4" */
	const char *order;      /* of mgrad: "2", "4", "6", "spectral" */
	const char *mollifier;  /* of pp: "plummer", "krasny" */
	const struct pm_law_constant *constants; /* {0} ends */
	const struct pm_law *in_space; /* the same law where 3-D has other fields; NULL: as above */
};

extern const struct pm_law *const pm_laws[]; /* generated from lib/law/, NULL ends */
extern const char *const pm_law_names[];
const struct pm_law *pm_law_find(const char *name);          /* NULL with a message */
static inline const struct pm_law *pm_law_of(const struct pm_frame *f) /* NULL with a message */
{
	const struct pm_law *law = pm_law_find(f->law);
	return law && law->in_space && f->dim == 3 ? law->in_space : law;
}

/* A constant of the frame, else the law's default for it, else `otherwise`. */
static inline double pm_law_constant(const struct pm_frame *f, const char *name, double otherwise)
{
	const struct pm_law *law = pm_law_of(f);
	for (const struct pm_law_constant *c = law ? law->constants : NULL; c && c->name; c++)
		if (!strcmp(c->name, name))
			otherwise = c->otherwise;
	return pm_frame_constant(f, name, otherwise);
}

PM_C_END

#endif
