/* The relative error of a force on a mesh: by the measured atlas, and for cold lattices of particles by measurements of their own, since the atlas was
 * measured with forces of one frame, and what a lattice does grows in time. SPDX-License-Identifier: GPL-3.0-or-later */
#include <string.h>

#include "planner/force-error.h"

double pm_force_allowed(const struct pm_scales *s) { return s->accuracy / fmax(1, 0.5 * s->omega * s->time); }

static bool is_lattice(const struct pm_scales *s) { return s->noise * s->effective < 0.1 && s->thermal < 1e-3 * s->omega * s->h; }

/* Sheets of a cold wave of amplitude A are 1 - A as far apart as they were where they are densest, at its largest within the run; waves of masses grow. */
static double squeeze(const struct pm_scales *s)
{
	const double grown = s->kind == PM_MASSES ? cosh(fmin(s->omega * s->time, 50)) : 1;
	return s->wave > 0 && is_lattice(s) ? 1 - fmin(0.9, 2 * s->wave * grown) : 1;
}

/* What a cold lattice of particles in a smooth wave does on a mesh with n of them in a cell along an axis: waves of the lattice fold onto long ones, c n^-q
 * of a wave whose particles swing by 0.036 of a cell, and grow: with t = omega T as (t/5)^g, and as exp(r t), faster the wider the particles swing, to full
 * rate at a seventh of a cell (with spectral gradients; 0.8, 0.7 and 0.5 of it with those of order 6, 4 and 2). Measured with waves of amplitude 0.0005 to
 * 0.45 on 16 to 128 cells, 1.7 to 64 particles in each, to t = 100 (docs/plan.md); 3: what the ratio of particles to cells does. */
static const struct folding {
	const char *kernel;
	double c, q, g, rate;
} foldings[] = {{"ngp", 2, 1, 1, 0.5}, {"cic", 1.2, 2, 1, 0.32}, {"tsc", 0.1, 3, 0.5, 0.2}, {"pcs", 0.02, 4, 0.5, 0.12}, {"m4prime", 0.5, 3.3, 2, 0.39},
	{"lambda-2", 0.5, 3.7, 2, 0.4}, {"m6prime", 0.15, 3.6, 2, 0.4}, {"lambda-4-2", 0.15, 3.6, 2, 0.4}, {"lambda", 1.2, 6, 2, 0.4}};

static const struct folding *folding_of(const char *kernel)
{
	for (size_t i = 0; i < sizeof foldings / sizeof *foldings; i++)
		if (!strncmp(kernel, foldings[i].kernel, strlen(foldings[i].kernel)))
			return &foldings[i];
	return &foldings[1];
}

/* Of a particle, in cells. */
static double swing(const struct pm_scales *s, double h) { return fmax(s->v_rms / s->omega, s->self / (s->omega * s->omega)) / h; }

/* exp(r t) */
static double growth(const struct pm_scales *s, const struct pm_atlas_force *r, double h, double t)
{
	const double part = fmin(1, pow(swing(s, h) / 0.15, 0.75));
	const double order = !strcmp(r->gradient, "spectral") ? 1 : !strcmp(r->gradient, "6") ? 0.8 : !strcmp(r->gradient, "4") ? 0.7 : 0.5;
	return exp(fmin(order * folding_of(r->kernel)->rate * part * fmax(t, 0), 100));
}

static double lattice_error(const struct pm_scales *s, const struct pm_atlas_force *r, int factor)
{
	const struct folding *f = folding_of(r->kernel);
	const double h = s->h / factor, n = pow(s->n / s->points, 1. / s->dim) / factor, t = s->omega * s->time;
	if (!is_lattice(s))
		return 0;
	const double least = fmin(1, f->c * pow(n * (s->kind == PM_MASSES ? 1 : squeeze(s)), -f->q));
	if (s->kind == PM_MASSES)
		return least; /* all waves of cold masses grow alike */
	return fmin(1, 3 * least * 0.036 / swing(s, h) * fmax(pow(fmax(t / 5, 1), f->g), 0.1 * growth(s, r, h, t)));
}

double pm_force_error(const struct pm_scales *s, const struct pm_atlas_force *r, double h, int factor)
{
	const double atlas = pm_atlas_force_error(r->scene, r->solver, r->kernel, r->gradient, h / squeeze(s) / factor);
	/* the mesh's own error of a steep wave makes new waves, which grow as those of the lattice */
	const double steep = 1 - squeeze(s), t = s->omega * s->time;
	if (is_lattice(s) && s->kind == PM_CHARGES)
		return fmin(1, atlas * (1 + steep * steep * growth(s, r, s->h / factor, t - 5)) + lattice_error(s, r, factor) / fmax(1, 0.5 * t));
	return atlas + lattice_error(s, r, factor) / fmax(1, 0.5 * s->omega * s->time);
}
