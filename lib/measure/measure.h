/* What diag measures: bulk quantities of particles, energies of the field, Lagrangian radii. All sums are compensated and taken over a fixed
 * partition in a fixed order, so that they do not depend on the number of threads.
 * SPDX-License-Identifier: GPL-3.0-or-later */
#ifndef PM_MEASURE_H
#define PM_MEASURE_H

#include "mesh/grid.h"

struct pm_measured { /* one set; arrays of n values */
	size_t n;
	int dim, vdim;               /* components of x and of v; 0: none */
	const double *x[3], *v[3];   /* [length], [length/time] */
	const double *mass;          /* [mass]; NULL none */
	const double *strength;      /* what makes the field; NULL none */
	const double *phi;           /* potential at the particles; NULL none */
	double c;                    /* [length/time] speed of light where momenta and energies are relativistic, else 0 */
	const struct pm_field *field;/* one of them in a divided frame, where n are here and `all` in the set; NULL: n are all */
	size_t all;
};

struct pm_particle_sums {
	double n, mass;              /* [1], [mass] */
	double kinetic;              /* sum m v^2/2; relativistic: sum (gamma - 1) m c^2, and gamma m for m in the next two lines */
	double momentum[3], scale;   /* sum m v; sum m |v| */
	double angular[3];           /* sum m x cross v, about the origin */
	double moment[3];            /* sum m x */
	double movers, square;       /* particles with a velocity; sum v^2 over them */
	double farthest;             /* max |x| */
};
/* Adds the sums of one set to *bulk. Without masses the quantities that need them become NAN. */
void pm_particle_sums_add(const struct pm_measured *b, struct pm_particle_sums *bulk);

/* sum q phi/2 over the particles of a set. */
double pm_energy_at_particles(const struct pm_measured *b);
/* integral of rho phi/2 over a mesh, end nodes with half weight. */
double pm_energy_on_mesh(const struct pm_grid *g, const double *rho, const double *phi);
/* The same of values of a field, which ranks may share. */
double pm_energy_of_field(const struct pm_grid *g, const struct pm_field *field, const double *rho, const double *phi);
/* Direct sum over the pairs of a with b (each once if a == b) of q q' coefficient potential(r^2, softening, dim). Cost n^2. */
double pm_energy_of_pairs(const struct pm_measured *a, const struct pm_measured *b, double coefficient, double softening,
	double (*potential)(double r2, double softening, int dim));

struct pm_shell {
	double r, mass; /* [length], [mass] */
	size_t index;   /* breaks ties */
};
/* Smallest r within which at least each fraction of the mass lies; sorts the shells. NAN if there are none. */
void pm_radii(size_t n, struct pm_shell *shell, int nfractions, const double *fraction, double *radius);

/* The columns of diag. */
enum pm_column {
	PM_STEP, PM_TIME, PM_ENERGY_KINETIC, PM_ENERGY_MESH, PM_ENERGY_PAIR, PM_ENERGY, PM_MOMENTUM, PM_MOMENTUM_SCALE = PM_MOMENTUM + 3, PM_ANGULAR,
	PM_MASS = PM_ANGULAR + 3, PM_PARTICLES, PM_CENTRE, PM_SPEED_RMS = PM_CENTRE + 3, PM_DISTANCE_MAX, PM_VIRIAL_RATIO,
	PM_CROSSING_TIME, PM_COULOMB_LOGARITHM, PM_RELAXATION_TIME,
	PM_CIRCULATION, PM_ALPHA, PM_IMPULSE = PM_ALPHA + 3, PM_ANGULAR_IMPULSE = PM_IMPULSE + 3, PM_ANGULAR_IMPULSE_OF,
	PM_ENSTROPHY = PM_ANGULAR_IMPULSE_OF + 3, PM_PALINSTROPHY, PM_OMEGA_MAX, PM_OMEGA_CENTRE, PM_DISSIPATION, PM_ENERGY_LOSS, PM_DIVERGENCE,
	PM_KOLMOGOROV_LENGTH, PM_KOLMOGOROV_TIME, PM_ENERGY_FLOW, PM_HELICITY,
	PM_RING_CIRCULATION, PM_RING_RADIUS, PM_RING_POSITION, PM_RING_SPEED, PM_DISTORTION,
	PM_CHARGE, PM_ENERGY_COMPONENT, PM_ENERGY_ELECTRIC = PM_ENERGY_COMPONENT + 3, PM_ENERGY_MAGNETIC, PM_GAUSS_RESIDUAL,
	PM_STRENGTH_SCALE, PM_STRENGTH_ABSORBED, PM_STRENGTH_CUT, PM_STRENGTH_OUTSIDE, PM_STRENGTH_GIVEN, PM_OUTSIDE,
	PM_LEVEL_INSIDE, PM_LEVEL_INTERFACE, PM_LEVEL_DIFFERENCE, PM_COLUMNS
};
/* Does it exist in dim dimensions with velocities of vdim components? */
bool pm_column_exists(enum pm_column c, int dim, int vdim);
struct pm_measure;
/* Is it defined under the law: for vortices, or bodies with mass and velocity, in a plasma or not, with a strength or without? */
bool pm_column_suits(enum pm_column c, const struct pm_measure *how);

/* Flux of the field through a box, how far a potential is from its equation, and its field from a gradient (measure-field.c). */
enum pm_field_column { PM_FLUX, PM_FLUX_ENCLOSED, PM_FIELD_RESIDUAL, PM_FIELD_CURL, PM_FIELD_COLUMNS };
/* Then those of the field, and the separation of two sets in position and velocity, which options ask for. */
enum { PM_NAMED_COLUMNS = (int)PM_COLUMNS + (int)PM_FIELD_COLUMNS + 2 };
extern const char *const pm_column_names[PM_NAMED_COLUMNS + 1]; /* NULL ends */
extern const char *const pm_columns_numbered[];                 /* further ones, with a number behind; NULL ends */

/* Of every set (species-moments.c): particles; kinetic energy; mean velocity x, y, z; covariance of the velocities xx, yy, zz, xy, xz, yz. */
enum pm_moment { PM_MOMENT_PARTICLES, PM_MOMENT_KINETIC, PM_MOMENT_DRIFT, PM_MOMENT_COVARIANCE = PM_MOMENT_DRIFT + 3,
	PM_MOMENTS = PM_MOMENT_COVARIANCE + 6 };
enum { PM_SPECIES_MOST = 16 };

struct pm_measures {
	double value[PM_COLUMNS];       /* NAN where it cannot be computed */
	double radius[PM_COMPONENTS];   /* [length] Lagrangian radii about the centre of mass */
	double mode[PM_COMPONENTS][2];  /* complex amplitude of the modes asked for */
	double separation[2];           /* [length], [length/time] of two sets */
	double field[PM_FIELD_COLUMNS];
	double species[PM_SPECIES_MOST][PM_MOMENTS]; /* of the sets in their order, if asked for */
	double field_most;              /* largest component of the law's field at any point; with modes, else NAN */
};
/* All columns from bulk and field energies (NAN: unknown); field: the law has a field, so the total energy is unknown without the field's energy. */
void pm_measures_of(const struct pm_frame *f, const struct pm_particle_sums *bulk, double mesh, double pair, bool field, struct pm_measures *m);

struct pm_measure { /* what to measure of a frame */
	const char *set;             /* only this one; NULL all */
	const char *strength, *density, *potential; /* names under the frame's law; potential NULL: it has no field */
	double coefficient, softening; /* of the direct sum */
	double (*pair)(double r2, double softening, int dim); /* NULL: no direct sum, the pair energy comes from the particles' potential */
	char unknown[200];           /* why the total energy is not known; "" it is */
	bool vortices;               /* the law is that of vortices */
	bool vector;                 /* in space: strength, density and potential have 3 components */
	double nu;                   /* [length^2/time] viscosity of the frame */
	double centre[2];            /* [length] where omega is looked at */
	bool level;                  /* a set carries a level (level/level-frame.h) */
	double (*exact_level)(const struct pm_frame *f, const double x[], double t); /* of the scene; NULL: it knows none */
	bool outside;                /* count those beyond the mesh, and their energy */
	bool plasma;                 /* the law is electrostatic, or has a background of charge */
	bool evolves;                /* the law's field is a state, with a magnetic one */
	double c, eps0;              /* then the constants of the law; else c is 0 */
	const char *field;           /* of the law on the mesh; NULL none */
	int wave;                    /* component of it that waves along x have */
	int nmodes, modes[PM_COMPONENTS]; /* waves along x */
	int nring_modes;             /* or so many of them around a vortex or a vortex ring in open space */
	const char *separation[2];   /* two sets; NULL: none */
	bool species;                /* the moments of every set */
	bool field_errors;           /* residual and curl */
	const double *flux;          /* [length] corners of a box, nflux numbers; NULL: none */
	int nflux;
	int nradii;
	const double *fraction;      /* of the mass, of each Lagrangian radius */
};
/* In declare(): declares the reads of those fields that exist. */
void pm_measure_reads(const struct pm_measure *how, struct pm_frame *f);
/* Sums over the sets and the mesh of vorticity; the reads of both are declared. */
void pm_vortex_reads(const struct pm_measure *how, struct pm_frame *f);
void pm_vortex_of(const struct pm_measure *how, const struct pm_frame *f, struct pm_measures *m);
/* The same in space. 0, or failure without memory. */
void pm_vortex_space_reads(const struct pm_measure *how, struct pm_frame *f);
int pm_vortex_space_of(const struct pm_measure *how, const struct pm_frame *f, struct pm_measures *m);
/* Charge, energy of the components of the field, modes. 0, or failure without memory. */
void pm_plasma_reads(const struct pm_measure *how, struct pm_frame *f);
int pm_plasma_of(const struct pm_measure *how, const struct pm_frame *f, struct pm_measures *m);
/* Energies of E and B on Yee's mesh, and how far E is from Gauss's law: max |div E - rho/eps0| over max |rho/eps0|, where there is a rho. */
void pm_maxwell_reads(const struct pm_measure *how, struct pm_frame *f);
int pm_maxwell_of(const struct pm_measure *how, const struct pm_frame *f, struct pm_measures *m);
/* The account of the law's strength (stream/strengths.h): sum of its absolute values, and what the words of the run took away or gave, as they report. */
void pm_account_of(const struct pm_measure *how, const struct pm_frame *f, struct pm_measures *m);
/* How many are beyond the open mesh (NAN: no such mesh), and the energy between them and those inside. */
bool pm_measure_has_outside(const struct pm_measure *how, const struct pm_frame *f);
void pm_outside_of_reads(const struct pm_measure *how, struct pm_frame *f);
int pm_outside_of(const struct pm_measure *how, const struct pm_frame *f, double *count, double *energy);
/* Behind the reads: can ranks share them? Not order statistics. */
bool pm_measure_shared(const struct pm_measure *how);
bool pm_measure_divided(const struct pm_frame *f); /* with the data: do they? */
int pm_measure_frame(const struct pm_measure *how, const struct pm_frame *f, struct pm_measures *m);

#endif
