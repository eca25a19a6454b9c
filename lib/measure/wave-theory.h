/* The waves that the species of a frame should have along x. SPDX-License-Identifier: GPL-3.0-or-later */
#ifndef PM_MEASURE_WAVE_THEORY_H
#define PM_MEASURE_WAVE_THEORY_H

#include "measure/measure.h"
#include "plasma/magnetised.h"
#include "scene/scene.h"

struct pm_wave_theory {
	enum { PM_NO_THEORY, PM_ELECTROSTATIC, PM_BERNSTEIN, PM_ALONG_FIELD, PM_ORDINARY_WAVE, PM_EXTRAORDINARY_WAVE } kind;
	int n;
	struct pm_gyrating species[PM_SPECIES_MOST];
	double c, field[3]; /* [length/time]; mean magnetic field */
	double spread[2];   /* [length/time] standard deviation of the velocities of the last species along x and, NAN if it has none, across x */
	char why[200];      /* PM_NO_THEORY: why not */
};

/* Header: the reads. */
void pm_wave_theory_reads(struct pm_frame *f);
/* Data: species and magnetic field of this frame, and what waves of that component of E are. k1 [1/length]: the smallest wave number. */
void pm_wave_theory_of(struct pm_wave_theory *t, const struct pm_frame *f, double k1, int component);
/* Is that the plasma of which the scene states gamma and omega, k [1/length] of the wave? In one set, at rest along x, with its plasma frequency (5 %), thermal
 * speeds (10 %, and a wave's velocity) and magnetic field (1 %). */
bool pm_wave_theory_as_made(const struct pm_wave_theory *t, const struct pm_frame *f, const struct pm_scene *scene, double k);
/* Its words, for people. */
const char *pm_wave_theory_name(const struct pm_wave_theory *t);
/* The root nearest to a frequency that was measured, damped by less than half of it; NAN: none, or no memory. */
double complex pm_wave_theory_nearest(const struct pm_wave_theory *t, double k, double omega);
/* The root that Newton's method finds from a measured omega + i gamma, omega >= 0; NAN: none. */
double complex pm_wave_theory_close(const struct pm_wave_theory *t, double k, double complex measured);

#endif
